"""Wetted parts of rigid bodies of any shape: hydrostatics by the divergence theorem over the wetted surface.

With the normal n out of the body and z from the still level, in which the waterplane adds nothing to the volume's
moments,

    V = ∫z n_z dS,    ∫z dV = ∫½z² n_z dS,    ∫(x, y) dV = ∫(x, y) z n_z dS,

and the waterplane closes the surface, so that ∫f(x, y) dA = −∫f(x, y) n_z dS for each f.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.plate import Point, scaled_point


@dataclass(frozen=True, kw_only=True)
class Hydrostatics:
    """What follows from the wetted part of a solid, in powers of m."""

    volume: float  # V
    buoyancy: float  # z_B
    waterplane: float
    second: Point  # I_x = ∫y² and I_y = ∫x² of the waterplane about the vertical axis through the centre of buoyancy
    axis: Point = (0.0, 0.0)  # x and y of that axis, from the origin of the solid
    first: Point = (0.0, 0.0)  # ∫x and ∫y of the waterplane about it
    product: float = 0.0  # ∫xy of the waterplane about it

    def scaled(self, length: float) -> Hydrostatics:
        """Return it in units of a length."""
        return Hydrostatics(
            volume=self.volume / length**3,
            buoyancy=self.buoyancy / length,
            waterplane=self.waterplane / length**2,
            second=scaled_point(self.second, length**4),
            axis=scaled_point(self.axis, length),
            first=scaled_point(self.first, length**3),
            product=self.product / length**4,
        )


def hydrostatics_of_surface(points: FloatArray, areas: FloatArray) -> Hydrostatics:
    """Integrate over a wetted surface.

    Args:
        points: of a quadrature, z from the still level, shape (n, 3).
        areas: n dS at them, out of the body, shape (n, 3).
    """
    x, y, z = points.T
    upwards = areas[:, 2]
    volume = float(z @ upwards)
    centre = np.array([x * z @ upwards, y * z @ upwards]) / volume
    x, y = x - centre[0], y - centre[1]
    area, first_x, first_y, about_x, about_y, product = (
        -float(values @ upwards) for values in (np.ones_like(x), x, y, y**2, x**2, x * y)
    )
    return Hydrostatics(
        volume=volume,
        buoyancy=float(0.5 * z**2 @ upwards) / volume,
        waterplane=area,
        second=(about_x, about_y),
        axis=(float(centre[0]), float(centre[1])),
        first=(first_x, first_y),
        product=product,
    )


@dataclass(frozen=True, kw_only=True)
class WettedHull:
    """The wetted part of a hull that a file describes."""

    file: Path  # solid of CAD, or triangles (*.stl) of its surface; in m
    level: float  # z of the still level in the file, m
    low: tuple[float, float, float]  # least x, y and z of the wetted part from the file's origin at the still level, m
    high: tuple[float, float, float]  # the largest ones
    hydrostatics: Hydrostatics  # of the wetted part, from that origin
    # whether it is known to be its own mirror image, in planes normal to x and to y through the centre of buoyancy
    symmetric: tuple[bool, bool]
    metres: float = 1.0  # the unit of all lengths but ``level``, m
    # area of the waterplane just above horizontal faces in the still level, m²; ``None`` without such a face
    waterplane_above: float | None = None

    @property
    def is_triangulated(self) -> bool:
        """Whether the file holds triangles."""
        return self.file.suffix.lower() == ".stl"

    def scaled(self, length: float) -> WettedHull:
        """Return it in units of a length."""
        low, high = ((point[0] / length, point[1] / length, point[2] / length) for point in (self.low, self.high))
        return replace(
            self, low=low, high=high, hydrostatics=self.hydrostatics.scaled(length), metres=self.metres * length
        )


class OpenSurfaceError(ValueError):
    """Triangles that are not the closed surface of a body."""


# Part of the extent: corners this close to a level are in it.
_LEVEL = 1e-7


@dataclass(frozen=True, kw_only=True)
class Triangles:
    """A surface of plane triangles."""

    points: FloatArray  # its corners, shape (points, 3)
    corners: NDArray[np.int64]  # numbers of the corners of each triangle, shape (triangles, 3)

    def below(self, level: float) -> Triangles:
        """Return the part below a level, which becomes z = 0; triangles in that level are left out."""
        points = self.points - np.array([0.0, 0.0, level])
        points[np.abs(points[:, 2]) < _LEVEL * np.ptp(self.points, axis=0).max(), 2] = 0.0
        height = points[:, 2]
        added: dict[tuple[int, int], int] = {}
        more: list[FloatArray] = []

        def crossing(one: int, other: int) -> int:
            low, high = sorted((one, other))
            if (low, high) not in added:
                added[low, high] = len(points) + len(more)
                part = height[low] / (height[low] - height[high])
                more.append(np.append((points[low] + part * (points[high] - points[low]))[:2], 0.0))
            return added[low, high]

        signs = np.sign(height)[self.corners]
        kept = [self.corners[(signs.max(axis=1) <= 0.0) & (signs.min(axis=1) < 0.0)]]
        for triangle in self.corners[(signs.max(axis=1) > 0.0) & (signs.min(axis=1) < 0.0)]:
            corners = []
            for one, other in zip(triangle, np.roll(triangle, -1), strict=True):
                if height[one] <= 0.0:
                    corners.append(one)
                if height[one] * height[other] < 0.0:
                    corners.append(crossing(int(one), int(other)))
            kept.append(np.array([(corners[0], *pair) for pair in pairwise(corners[1:])]))
        corners = np.concatenate(kept).astype(np.int64)
        used, numbers = np.unique(corners, return_inverse=True)
        every = np.concatenate([points, np.array(more).reshape(-1, 3)])
        return Triangles(points=every[used], corners=numbers.reshape(-1, 3))

    def require_closed(self) -> None:
        """Refuse the part below a level if only it and the level do not close a body, all triangles turned alike."""
        if not len(self.corners):
            raise OpenSurfaceError("does not reach below the still level")
        sides = np.stack([self.corners, np.roll(self.corners, -1, axis=1)], axis=2).reshape(-1, 2)
        edges, number, counts = np.unique(np.sort(sides, axis=1), axis=0, return_inverse=True, return_counts=True)
        turned = np.bincount(number.ravel(), weights=np.where(sides[:, 0] < sides[:, 1], 1.0, -1.0))
        in_level = np.all(self.points[edges, 2] == 0.0, axis=1)
        for wrong, said in (
            ((counts == 1) & ~in_level, "is not closed: {count} of its edges below the still level have one triangle"),
            (counts > 2, "is no surface: {count} of its edges have more than two triangles"),
            ((counts == 2) & (turned != 0.0), "has neighbours that are not turned alike at {count} edges"),
        ):
            if wrong.any():
                x, y, z = self.points[edges[wrong][0]].mean(axis=0)
                where = f", the first one at x = {x:.4g}, y = {y:.4g} m, {-z:.4g} m below the level"
                raise OpenSurfaceError(said.format(count=int(wrong.sum())) + where)

    def hydrostatics(self) -> Hydrostatics:
        """Those of the part below z = 0, whichever way all triangles are turned."""
        corners = self.points[self.corners]
        areas = 0.5 * np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        # The middles of the sides are exact for the second degree, of which z, z², xz and x² are.
        middles = 0.5 * (corners + np.roll(corners, -1, axis=1))
        areas = np.repeat(areas / 3.0, 3, axis=0)
        sign = np.sign(middles.reshape(-1, 3)[:, 2] @ areas[:, 2])
        return hydrostatics_of_surface(middles.reshape(-1, 3), sign * areas)
