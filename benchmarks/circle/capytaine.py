"""The circle on Capytaine, three-dimensional linear potential flow by panels: a long cylinder stands for it.

Values per metre of a finite cylinder keep a part from its ends, which falls slowly with the length. Two lengths remove
what belongs to the ends alone: (A(L) − A(L/2))/(L/2). Both are measured.

What is used of Capytaine: a quarter of the hull in panels, mirrored in both vertical planes, so that four matrices of a
quarter of the size are factorized instead of one, once for both motions; the direct equation, which at Ka = 1 is up to
five times as accurate as the default, indirect one; Gauss' rule of 2 × 2 points on each panel, which costs little and
leaves up to five times smaller errors at Ka = 2.5; rows of panels that are short against the wave (rows of 2 m leave
5e-2 and more at Ka = 2.5).

What was tried besides: a lid against irregular frequencies took twice as long and helped at Ka = 1 alone, by a third or
more. Rows that get shorter towards the ends, circles of equal area and the Green function of Liang, Wu and Noblesse did
not pay. Smooth weights along one cylinder were no better than two lengths at Ka = 1, and worse at Ka = 0.25.
"""

from __future__ import annotations

from importlib.metadata import version
from math import inf

import capytaine
import numpy as np
from numpy.typing import NDArray

from hydroelastic.benchmarks.cases import Answer, Case
from hydroelastic.benchmarks.circle.cases import DENSITY, GRAVITY, RADIUS, circle_frequency, unit_added_mass

Grid = NDArray[np.float64]

_MOTIONS = ("Heave", "Sway")
# Length of the panels over the radius, by the number of panels on a quarter of the circle.
_PANEL_LENGTHS = {4: 1.0, 8: 0.75, 12: 0.5}
# It reads its table from the cache, or makes it: not timed, and shared by all solutions.
_GREEN_FUNCTION = capytaine.Delhommeau()

capytaine.set_logging("ERROR")  # else a warning for each resolution that is coarse against the wave


def versions() -> dict[str, str]:
    """What computes."""
    return {"Capytaine": version("capytaine")}


def solve(case: Case) -> Answer:
    """Make the panels of a case and solve for both motions: mesh to numbers."""
    omega = circle_frequency(case.tank).omega
    forces, panels = _impedance(case.length, case.panels, omega)
    length, unknowns = case.length, panels
    if case.variant == "two lengths":
        shorter, fewer = _impedance(case.length / 2.0, case.panels, omega)
        forces, length, unknowns = forces - shorter, case.length / 2.0, panels + fewer
    per_length = forces / (unit_added_mass() * length * RADIUS)
    return Answer(
        values=tuple(float(part) for value in per_length for part in (value.real, value.imag)), unknowns=unknowns
    )


def _impedance(length: float, panels: int, omega: float) -> tuple[NDArray[np.complex128], int]:
    """Added mass + i damping/ω of heave and of sway, kg, and how many panels the whole hull has."""
    mesh = _hull(length * RADIUS, panels)
    body = capytaine.FloatingBody(mesh, capytaine.rigid_body_dofs(only=_MOTIONS, rotation_center=(0, 0, 0)))
    # A new engine each time: it keeps the last matrices.
    engine = capytaine.DefaultMatrixEngine(green_function=_GREEN_FUNCTION)
    solver = capytaine.BEMSolver(engine=engine, method="direct")
    found = []
    for motion in _MOTIONS:
        problem = capytaine.RadiationProblem(
            body=body, radiating_dof=motion, omega=omega, water_depth=inf, rho=DENSITY, g=GRAVITY
        )
        result = solver.solve(problem, _check_wavelength=False)
        found.append(result.added_masses[motion] + 1j * result.radiation_dampings[motion] / omega)
    return np.array(found), int(mesh.nb_faces)


def _hull(length: float, panels: int) -> capytaine.ReflectionSymmetricMesh:
    """The immersed half cylinder with its end discs, x along it, as a quarter and its mirror images."""
    angles = np.linspace(0.0, np.pi / 2.0, panels + 1)
    rows = round(length / 2.0 / (_PANEL_LENGTHS[panels] * RADIUS))
    along, around = np.meshgrid(np.linspace(0.0, length / 2.0, rows + 1), angles, indexing="ij")
    side = _points(along, np.full_like(along, RADIUS), around)
    radii, around = np.meshgrid(np.linspace(0.0, RADIUS, max(2, panels // 2) + 1), angles, indexing="ij")
    disc = _points(np.full_like(radii, length / 2.0), radii, around)
    vertices = np.vstack([side.reshape(-1, 3), disc.reshape(-1, 3)])
    # Both grids turn outwards if the order of one is the opposite of the other's.
    faces = np.vstack([_faces(side.shape)[:, ::-1], _faces(disc.shape) + side.size // 3])
    quarter = capytaine.Mesh(vertices, faces).with_quadrature("Gauss-Legendre 2")
    half = capytaine.ReflectionSymmetricMesh(quarter, plane="xOz")
    return capytaine.ReflectionSymmetricMesh(half, plane="yOz")


def _points(along: Grid, radii: Grid, around: Grid) -> Grid:
    """Points of a grid; the angle is 0 at the keel."""
    return np.stack([along, radii * np.sin(around), -radii * np.cos(around)], axis=-1)


def _faces(shape: tuple[int, ...]) -> NDArray[np.int64]:
    numbers = np.arange(shape[0] * shape[1]).reshape(shape[:2])
    corners = [numbers[:-1, :-1], numbers[1:, :-1], numbers[1:, 1:], numbers[:-1, 1:]]
    return np.stack(corners, axis=-1).reshape(-1, 4)
