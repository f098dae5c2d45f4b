"""The construction site: where the roller is and what ground is there."""

from roller_sim_ros.site.site import Position, Site, UniformSite

__all__ = ["Position", "Site", "UniformSite"]
