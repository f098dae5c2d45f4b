# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The loaded rectangle, seen from its centre: how much of the load lies at each distance.

Lengths are in units of sqrt(BL): b = B/sqrt(BL) = alpha^-1/2, l = alpha^1/2. The stress is parabolic
across b and constant along l. Of a unit load, m(r) r dr lies between the distances r and r + dr:

    m(r) = int q(r, theta) d theta
         = 3/2 [(theta2 - theta1) P - (r^2/4b^2)(sin 2 theta2 - sin 2 theta1)],   P = 1 - r^2/2b^2,
    theta1 = arccos min(1, b/r),    theta2 = arcsin min(1, l/r),

up to the corner r^2 = b^2 + l^2. Written as a sum over the two pairs of sides, at the distance c = b
and c = l from the centre, it is psi P + mu t with t^2 = r^2 - c^2 and psi an arc tangent of t/c.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from roller_sim_ros.half_space.point_load import FloatArray
from roller_sim_ros.half_space.static import influence_integral


@dataclass(frozen=True)
class Side:
    """The part of m(r) that belongs to one pair of sides.

    Attributes
    ----------
    distance : float
        c, distance of the side from the centre, in units of sqrt(BL).
    half_width : float
        b, in the same unit.
    grows : bool
        Whether psi = arccos(c/r), zero up to r = c; otherwise arcsin(c/r), pi/2 up to r = c.
    edge : float
        mu, the factor of t.
    scale : float
        3/2 or -3/2, the factor of the whole.
    """

    distance: float
    half_width: float
    grows: bool
    edge: float
    scale: float

    @property
    def sense(self) -> float:
        """Return sigma of d psi/du = sigma c/(2 u t), with u = r^2."""
        return 1.0 if self.grows else -1.0

    @property
    def constants(self) -> tuple[float, float, float, float, float]:
        """Return c, b, sigma, mu and scale, for kernels."""
        return self.distance, self.half_width, self.sense, self.edge, self.scale

    def tangent(self, u: FloatArray) -> FloatArray:
        """Return t at u = r^2: zero inside the circle that touches the side."""
        return np.sqrt(np.maximum(u - self.distance**2, 0.0))

    def angle(self, t: FloatArray) -> FloatArray:
        """Return psi."""
        angle = np.arctan2(t, self.distance)
        return angle if self.grows else 0.5 * math.pi - angle

    def weight(self, u: FloatArray) -> FloatArray:
        """Return this part of m at u = r^2."""
        t = self.tangent(u)
        parabola = 1.0 - u / (2.0 * self.half_width**2)
        return self.scale * (self.angle(t) * parabola + self.edge * t)


def sides(aspect_ratio: float) -> tuple[Side, Side]:
    """Return the two pairs of sides, the ones at the distance b first."""
    b, length = aspect_ratio**-0.5, aspect_ratio**0.5
    return (
        Side(distance=b, half_width=b, grows=False, edge=0.5 / b, scale=1.5),
        Side(distance=length, half_width=b, grows=True, edge=0.5 * length / (b * b), scale=-1.5),
    )


def static_weight(aspect_ratio: float) -> float:
    """Return int m(r) dr up to the corner, which is 3 I(alpha)/(2 sqrt(alpha))."""
    return 1.5 * influence_integral(aspect_ratio) / math.sqrt(aspect_ratio)
