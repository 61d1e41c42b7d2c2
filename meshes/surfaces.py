"""Surfaces of CAD that have a closed form: planes, cylinders, cones and spheres, to which nodes are moved.

They are found from points and normals of a face, so that a few numbers of each are all that other processes need.
"""

from __future__ import annotations

from dataclasses import dataclass

import gmsh
import numpy as np

from hydroelastic.physics.arrays import FloatArray

# Points along each parameter of a face from which its surface is found.
_POINTS = 6
# Newton's steps to the common line or point of several surfaces; they converge quadratically.
_STEPS = 6
# Normals of surfaces that touch are dependent up to this, and curves are circles.
_DEPENDENT = 1e-6


@dataclass(frozen=True, kw_only=True)
class Surface:
    """A sphere, or a surface of revolution with a straight generatrix.

    Its points have (ρ − R) cos α = z sin α, with ρ the distance from the axis and z along it: α = 0 is a cylinder,
    R = 0 a cone, and R = 0 with α = π/2 a plane. A sphere has |x − c| = R.
    """

    point: FloatArray  # c, on the axis
    axis: FloatArray | None  # unit vector along it; ``None`` of a sphere
    radius: float  # R
    slope: tuple[float, float] = (1.0, 0.0)  # cos α and sin α

    def distances(self, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the signed distances of points (n, 3), shape (n,), and their gradients (n, 3)."""
        away = points - self.point
        along = np.zeros(len(points)) if self.axis is None else away @ self.axis
        axis = np.zeros(3) if self.axis is None else self.axis
        outwards = away - np.outer(along, axis)
        radii = np.linalg.norm(outwards, axis=1)
        # On the axis every direction is as good: the gradient of a plane does not have it.
        outwards /= np.maximum(radii, np.finfo(float).tiny)[:, None]
        cosine, sine = self.slope
        return cosine * (radii - self.radius) - sine * along, cosine * outwards - sine * axis


def surface_of(face: int) -> Surface | None:
    """Return the surface of a face of gmsh's current model; ``None`` if it has no closed form here."""
    kind = gmsh.model.getType(2, face)
    if kind not in ("Plane", "Sphere", "Cylinder", "Cone"):
        return None
    ranges = np.transpose(gmsh.model.getParametrizationBounds(2, face))
    # Off the ends, where a cone has no normal.
    inside = (np.arange(_POINTS) + 0.5) / _POINTS
    grid = np.stack(np.meshgrid(*(low + inside * (high - low) for low, high in ranges)), axis=-1).reshape(-1)
    points = np.reshape(gmsh.model.getValue(2, face, grid), (-1, 3))
    normals = np.reshape(gmsh.model.getNormal(face, grid), (-1, 3))
    if kind == "Plane":
        return Surface(point=points[0], axis=normals[0], radius=0.0, slope=(0.0, 1.0))
    if kind == "Sphere":
        # x − R n = c
        unknowns = np.column_stack([np.tile(np.eye(3), (len(points), 1)), normals.ravel()])
        *middle, radius = np.linalg.lstsq(unknowns, points.ravel(), rcond=None)[0]
        return Surface(point=np.array(middle), axis=None, radius=abs(radius))
    if kind == "Cylinder":
        axis = np.linalg.svd(normals)[2][-1]
        across = np.eye(3) - np.outer(axis, axis)
        unknowns = np.column_stack([np.tile(across, (len(points), 1)), normals.ravel()])
        *middle, radius = np.linalg.lstsq(unknowns, (points @ across).ravel(), rcond=None)[0]
        return Surface(point=np.array(middle), axis=axis, radius=abs(radius))
    # Of a cone n·a is the same everywhere, and all tangential planes meet in the tip.
    axis = np.linalg.lstsq(normals, np.ones(len(normals)), rcond=None)[0]
    axis /= np.linalg.norm(axis)
    tip = np.linalg.lstsq(normals, (normals * points).sum(axis=1), rcond=None)[0]
    axis *= np.sign((points - tip).mean(axis=0) @ axis)
    sine = float(abs(normals @ axis).mean())
    return Surface(point=tip, axis=axis, radius=0.0, slope=(np.sqrt(1.0 - sine**2), sine))


def circle_of(curve: int) -> Surface | None:
    """Return the cylinder through a circle of gmsh's current model; ``None`` of another curve."""
    (low,), (high,) = gmsh.model.getParametrizationBounds(1, curve)
    points = np.reshape(gmsh.model.getValue(1, curve, np.linspace(low, high, _POINTS)), (-1, 3))
    middle = points.mean(axis=0)
    across = np.linalg.svd(points - middle)[2][:2]
    # |x|² = 2 c·x + (R² − |c|²) in the plane of the circle
    plane = (points - middle) @ across.T
    *centre, rest = np.linalg.lstsq(
        np.column_stack([2.0 * plane, np.ones(_POINTS)]), (plane**2).sum(axis=1), rcond=None
    )[0]
    found = Surface(
        point=middle + np.array(centre) @ across,
        axis=np.cross(*across),
        radius=float(np.sqrt(rest + np.dot(centre, centre))),
    )
    return found if np.abs(found.distances(points)[0]).max() < _DEPENDENT * found.radius else None


def moved_to(surfaces: list[Surface], points: FloatArray, lies_on: np.ndarray) -> FloatArray:
    """Move points to the surfaces that they lie on, to the common line or point of several."""
    moved = points.copy()
    kinds, of_points = np.unique(lies_on, axis=0, return_inverse=True)
    for number, kind in enumerate(kinds):
        own = [surfaces[one] for one in np.flatnonzero(kind)]
        chosen = np.flatnonzero(of_points.ravel() == number)
        for _ in range(_STEPS if own else 0):
            distances, gradients = zip(*(one.distances(moved[chosen]) for one in own), strict=True)
            steps = (
                np.linalg.pinv(np.stack(gradients, axis=1), rcond=_DEPENDENT) @ np.stack(distances, axis=1)[..., None]
            )
            moved[chosen] -= steps[..., 0]
    return moved
