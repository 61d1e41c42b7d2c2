"""A heaving cylinder on OpenFLASH, matched eigenfunction expansions of heaving stepped cylinders over a bed."""

from __future__ import annotations

from importlib.metadata import version

import numpy as np
from openflash import BasicRegionGeometry, MEEMEngine, MEEMProblem
from openflash.multi_equations import wavenumber

from hydroelastic.benchmarks.buoy.cases import DENSITY, RADIUS, buoy_named
from hydroelastic.benchmarks.cases import Answer, Case


def versions() -> dict[str, str]:
    """What computes."""
    return {"OpenFLASH": version("open-flash")}


def solve(case: Case) -> Answer:
    """Match the expansions of a case: geometry to numbers."""
    buoy = buoy_named(case.tank)
    geometry = BasicRegionGeometry.from_vectors(
        np.array([RADIUS]), np.array([buoy.draught]), buoy.depth, [case.terms] * 2, heaving_map=[True]
    )
    problem = MEEMProblem(geometry)
    engine = MEEMEngine([problem])
    number = wavenumber(buoy.omega, buoy.depth)
    found = engine.compute_hydrodynamic_coefficients(
        problem, engine.solve_linear_system_multi(problem, number), number, rho=DENSITY
    )[0]
    return Answer(values=(float(found["real"]), float(found["imag"]) / buoy.omega), unknowns=3 * case.terms)
