"""A heaving cylinder on OpenFLASH, matched eigenfunction expansions of heaving stepped cylinders over a bed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from openflash import BasicRegionGeometry, MEEMEngine, MEEMProblem
from openflash.multi_equations import wavenumber


def buoy(given: Mapping[str, Any], terms: int) -> tuple[Any, int]:
    """Return a + ib/ω of heave, kg, and the number of unknowns."""
    geometry = BasicRegionGeometry.from_vectors(
        np.array([1.0]), np.array([given["draught"]]), given["depth"], [terms] * 2, heaving_map=[True]
    )
    problem = MEEMProblem(geometry)
    engine = MEEMEngine([problem])
    number = wavenumber(given["omega"], given["depth"])
    solution = engine.solve_linear_system_multi(problem, number)
    found = engine.compute_hydrodynamic_coefficients(problem, solution, number, rho=1000.0)[0]
    return np.array([found["real"] + 1j * found["imag"] / given["omega"]]), 3 * terms
