# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""East, north and up around a point of the WGS 84 ellipsoid as latitude, longitude and height, and back."""

from __future__ import annotations

import math
from typing import NamedTuple

SEMI_MAJOR_M = 6378137.0
FLATTENING = 1.0 / 298.257223563
_ECCENTRICITY_2 = FLATTENING * (2.0 - FLATTENING)


class Geodetic(NamedTuple):
    """A place on WGS 84: degrees, degrees, metres above the ellipsoid."""

    latitude_deg: float
    longitude_deg: float
    altitude_m: float


def to_ecef(place: Geodetic) -> tuple[float, float, float]:
    """Return earth-centred, earth-fixed coordinates, m."""
    latitude, longitude = math.radians(place.latitude_deg), math.radians(place.longitude_deg)
    normal = SEMI_MAJOR_M / math.sqrt(1.0 - _ECCENTRICITY_2 * math.sin(latitude) ** 2)
    level = (normal + place.altitude_m) * math.cos(latitude)
    return (
        level * math.cos(longitude),
        level * math.sin(longitude),
        (normal * (1.0 - _ECCENTRICITY_2) + place.altitude_m) * math.sin(latitude),
    )


def from_ecef(x: float, y: float, z: float) -> Geodetic:
    """Return the place of earth-centred, earth-fixed coordinates; by fixed-point iteration, to a micrometre."""
    level = math.hypot(x, y)
    latitude = math.atan2(z, level * (1.0 - _ECCENTRICITY_2))
    for _ in range(8):
        sine = math.sin(latitude)
        normal = SEMI_MAJOR_M / math.sqrt(1.0 - _ECCENTRICITY_2 * sine**2)
        latitude = math.atan2(z + _ECCENTRICITY_2 * normal * sine, level)
    sine, cosine = math.sin(latitude), math.cos(latitude)
    normal = SEMI_MAJOR_M / math.sqrt(1.0 - _ECCENTRICITY_2 * sine**2)
    altitude = level * cosine + z * sine - normal * (1.0 - _ECCENTRICITY_2 * sine**2)
    return Geodetic(math.degrees(latitude), math.degrees(math.atan2(y, x)), altitude)


def place_of(origin: Geodetic, east_m: float, north_m: float, up_m: float) -> Geodetic:
    """Return the place at an offset from an origin, in its tangent plane."""
    latitude, longitude = math.radians(origin.latitude_deg), math.radians(origin.longitude_deg)
    sine, cosine = math.sin(latitude), math.cos(latitude)
    sine_l, cosine_l = math.sin(longitude), math.cos(longitude)
    x, y, z = to_ecef(origin)
    level = cosine * up_m - sine * north_m
    return from_ecef(
        x + level * cosine_l - sine_l * east_m,
        y + level * sine_l + cosine_l * east_m,
        z + sine * up_m + cosine * north_m,
    )


def offset_of(origin: Geodetic, place: Geodetic) -> tuple[float, float, float]:
    """Return east, north and up of a place in an origin's tangent plane, m."""
    latitude, longitude = math.radians(origin.latitude_deg), math.radians(origin.longitude_deg)
    sine, cosine = math.sin(latitude), math.cos(latitude)
    sine_l, cosine_l = math.sin(longitude), math.cos(longitude)
    x, y, z = (there - here for there, here in zip(to_ecef(place), to_ecef(origin), strict=True))
    outward = cosine_l * x + sine_l * y
    return (
        cosine_l * y - sine_l * x,
        cosine * z - sine * outward,
        cosine * outward + sine * z,
    )
