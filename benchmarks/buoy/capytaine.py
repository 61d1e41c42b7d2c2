"""A heaving buoy on Capytaine, linear potential flow by panels, with its symmetry of rotation.

One wedge of panels is turned about the axis, so that the matrices are block circulant. The panels of a cylinder get
smaller towards its edge, where the velocity is infinite; the direct equation is up to a third more accurate here than
the default, indirect one. A lid on the water inside, with panels like those of the hull, removes irregular
frequencies.
"""

from __future__ import annotations

from importlib.metadata import version

import capytaine
import numpy as np
from numpy.typing import NDArray

from hydroelastic.benchmarks.buoy.cases import DENSITY, GRAVITY, RADIUS, Buoy, buoy_named
from hydroelastic.benchmarks.cases import Answer, Case

# It reads its table from the cache, or makes it: not timed, and shared by all solutions.
_GREEN_FUNCTION = capytaine.Delhommeau()

capytaine.set_logging("ERROR")  # else a warning for each resolution that is coarse against the wave


def versions() -> dict[str, str]:
    """What computes."""
    return {"Capytaine": version("capytaine")}


def solve(case: Case) -> Answer:
    """Make the panels of a case and solve for heave: mesh to numbers."""
    buoy = buoy_named(case.tank)
    around = 4 * case.panels
    hull = capytaine.RotationSymmetricMesh.from_profile_points(_profile(buoy, case.panels), n=around)
    lid = None
    if case.variant == "with lid":
        radii = np.linspace(0.0, RADIUS, case.panels // 2 + 1)
        disc = np.stack([radii, np.zeros_like(radii), np.zeros_like(radii)], axis=1)
        lid = capytaine.RotationSymmetricMesh.from_profile_points(disc, n=around)
    body = capytaine.FloatingBody(hull, capytaine.rigid_body_dofs(only=("Heave",)), lid_mesh=lid)
    # A new engine each time: it keeps the last matrices.
    engine = capytaine.DefaultMatrixEngine(green_function=_GREEN_FUNCTION)
    solver = capytaine.BEMSolver(engine=engine, method="direct")
    problem = capytaine.RadiationProblem(
        body=body, radiating_dof="Heave", omega=buoy.omega, water_depth=buoy.depth, rho=DENSITY, g=GRAVITY
    )
    result = solver.solve(problem, _check_wavelength=False)
    return Answer(
        values=(float(result.added_masses["Heave"]), float(result.radiation_dampings["Heave"]) / buoy.omega),
        unknowns=int(hull.nb_faces) + (0 if lid is None else int(lid.nb_faces)),
    )


def _profile(buoy: Buoy, panels: int) -> NDArray[np.float64]:
    """Points from the axis to the water line, shape (panels + 1, 3)."""
    if buoy.draught is None:
        angles = np.linspace(0.0, np.pi / 2.0, panels + 1)
        r, z = np.sin(angles), -np.cos(angles)
    else:
        under = 2 * panels // 3
        inwards, upwards = (np.linspace(0.0, np.pi / 2.0, count + 1) for count in (under, panels - under))
        r = np.concatenate([np.sin(inwards), np.ones(panels - under)])
        z = buoy.draught * np.concatenate([-np.ones(under + 1), -np.cos(upwards[1:])])
    return np.stack([RADIUS * r, np.zeros_like(r), z], axis=1)
