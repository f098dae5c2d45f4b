"""Loops over samples that numpy cannot do; compiled."""

from roller_sim_ros.sensors.kernels.interpolation import HALF_WIDTH, interpolate
from roller_sim_ros.sensors.kernels.recursion import recurse_one, recurse_two

__all__ = ["HALF_WIDTH", "interpolate", "recurse_one", "recurse_two"]
