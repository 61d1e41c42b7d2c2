"""Circle and buoys on Capytaine, three-dimensional linear potential flow by panels.

The direct equation is up to five times as accurate here as the default, indirect one.

A long cylinder stands for the circle: a quarter of the hull in panels, mirrored in both vertical planes, with Gauss'
rule of 2 × 2 points on each panel, which costs little and leaves up to five times smaller errors at Ka = 2.5; rows of
panels that are short against the wave. Values per metre keep a part from the ends, which falls slowly with the length;
two lengths remove what belongs to the ends alone: (A(L) − A(L/2))/(L/2). What was tried besides: a lid against
irregular frequencies took twice as long and helped at Ka = 1 alone, by a third or more. Rows that get shorter towards
the ends, circles of equal area and the Green function of Liang, Wu and Noblesse did not pay.

Of a buoy one wedge of panels is turned about the axis, so that the matrices are block circulant. The panels of a
cylinder get smaller towards its edge, where the velocity is infinite. A lid on the water inside, with panels like those
of the hull, removes irregular frequencies.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import inf
from typing import Any

import capytaine
import numpy as np

Array = Any

# It reads its table from the cache, or makes it: not timed, and shared by all solutions.
_GREEN_FUNCTION = capytaine.Delhommeau()
# Length of the panels over the radius, by the number of panels on a quarter of the circle.
_PANEL_LENGTHS = {4: 1.0, 8: 0.75, 12: 0.5}

capytaine.set_logging("ERROR")  # else a warning for each resolution that is coarse against the wave


def circle(given: Mapping[str, float], length: float, panels: int, two: bool = False) -> tuple[Array, int]:
    """Return a + ib/ω of heave and sway by length, kg/m, and the number of panels."""
    hull = _hull(length, panels)
    body = capytaine.FloatingBody(hull, capytaine.rigid_body_dofs(only=("Heave", "Sway"), rotation_center=(0, 0, 0)))
    forces, unknowns = _radiation(body, given, inf, ("Heave", "Sway")), int(hull.nb_faces)
    if not two:
        return forces / length, unknowns
    shorter, fewer = circle(given, length / 2.0, panels)
    return (forces - shorter * length / 2.0) / (length / 2.0), unknowns + fewer


def buoy(given: Mapping[str, Any], panels: int, lid: bool = False) -> tuple[Array, int]:
    """Return a + ib/ω of heave, kg, and the number of panels."""
    hull = capytaine.RotationSymmetricMesh.from_profile_points(_profile(given["draught"], panels), n=4 * panels)
    cover: Any = None
    if lid:
        radii = np.linspace(0.0, 1.0, panels // 2 + 1)
        disc = np.stack([radii, np.zeros_like(radii), np.zeros_like(radii)], axis=1)
        cover = capytaine.RotationSymmetricMesh.from_profile_points(disc, n=4 * panels)
    body = capytaine.FloatingBody(hull, capytaine.rigid_body_dofs(only=("Heave",)), lid_mesh=cover)
    return _radiation(body, given, given["depth"], ("Heave",)), int(hull.nb_faces) + (int(cover.nb_faces) if lid else 0)


def _radiation(body: Any, given: Mapping[str, float], depth: float, motions: tuple[str, ...]) -> Array:
    # A new engine each time: it keeps the last matrices.
    engine = capytaine.DefaultMatrixEngine(green_function=_GREEN_FUNCTION)
    solver = capytaine.BEMSolver(engine=engine, method="direct")
    found = []
    for motion in motions:
        problem = capytaine.RadiationProblem(
            body=body, radiating_dof=motion, omega=given["omega"], water_depth=depth, rho=1000.0, g=9.81
        )
        result = solver.solve(problem, _check_wavelength=False)
        found.append(result.added_masses[motion] + 1j * result.radiation_dampings[motion] / given["omega"])
    return np.array(found)


def _hull(length: float, panels: int) -> Any:
    """The immersed half cylinder of radius 1 m with its end discs, x along it, as a quarter and its mirror images."""
    angles = np.linspace(0.0, np.pi / 2.0, panels + 1)
    rows = round(length / 2.0 / _PANEL_LENGTHS[panels])
    along, around = np.meshgrid(np.linspace(0.0, length / 2.0, rows + 1), angles, indexing="ij")
    side = _points(along, np.ones_like(along), around)
    radii, around = np.meshgrid(np.linspace(0.0, 1.0, max(2, panels // 2) + 1), angles, indexing="ij")
    disc = _points(np.full_like(radii, length / 2.0), radii, around)
    # Both grids turn outwards if the order of one is the opposite of the other's.
    faces = np.vstack([_faces(side.shape)[:, ::-1], _faces(disc.shape) + side.size // 3])
    vertices = np.vstack([side.reshape(-1, 3), disc.reshape(-1, 3)])
    quarter = capytaine.Mesh(vertices, faces).with_quadrature("Gauss-Legendre 2")
    return capytaine.ReflectionSymmetricMesh(capytaine.ReflectionSymmetricMesh(quarter, plane="xOz"), plane="yOz")


def _points(along: Array, radii: Array, around: Array) -> Array:
    """Points of a grid; the angle is 0 at the keel."""
    return np.stack([along, radii * np.sin(around), -radii * np.cos(around)], axis=-1)


def _faces(shape: tuple[int, ...]) -> Array:
    numbers = np.arange(shape[0] * shape[1]).reshape(shape[:2])
    return np.stack([numbers[:-1, :-1], numbers[1:, :-1], numbers[1:, 1:], numbers[:-1, 1:]], axis=-1).reshape(-1, 4)


def _profile(draught: float | None, panels: int) -> Array:
    """Points from the axis to the water line, shape (panels + 1, 3)."""
    if draught is None:
        angles = np.linspace(0.0, np.pi / 2.0, panels + 1)
        r, z = np.sin(angles), -np.cos(angles)
    else:
        under = 2 * panels // 3
        inwards, upwards = (np.linspace(0.0, np.pi / 2.0, count + 1) for count in (under, panels - under))
        r = np.concatenate([np.sin(inwards), np.ones(panels - under)])
        z = draught * np.concatenate([-np.ones(under + 1), -np.cos(upwards[1:])])
    return np.stack([r, np.zeros_like(r), z], axis=1)
