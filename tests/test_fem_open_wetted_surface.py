"""Loads by quadrature on the surface of a body equal those of the matrices, however processes share the mesh."""

from __future__ import annotations

import numpy as np
import pytest
from mpi4py import MPI
from open_cases import problem_of

from hydroelastic.fem.open_water.field_model import Band
from hydroelastic.fem.open_water.model_building import first_resolution, open_model
from hydroelastic.scenes.models import SeaScene


@pytest.mark.mpi
def test_each_process_has_the_loads_of_its_unknowns() -> None:
    """Of some of these discs one of two processes has no facet, but the unknown at the edge."""
    comm, is_bare = MPI.COMM_WORLD, False
    for depth in (6.0, 7.0, 12.0, 24.0, 26.0):
        plate = {"kind": "plate", "outline": "disc", "radius": 250.0, "mass_per_area": 500.0}
        scene = SeaScene(
            liquid=[{"density": 1000.0, "depth": depth}],
            body=[plate | {"youngs_modulus": 1e10, "thickness": 2.0, "poisson_ratio": 0.3}],
            accuracy={"tolerance": 1e-4},
        )
        problem, band = problem_of(scene).of_order(0), Band(lowest=0.45, highest=0.45)
        model = open_model(problem, band, first_resolution(problem.tank, 1e-4, band))
        (surface,) = model.wetted
        is_bare |= 0 in comm.allgather(len(surface.points))
        found = surface.loads(surface.shapes.astype(complex))[:, model.pencil.free]
        # Two ways to the same integrals: rounding remains.
        np.testing.assert_allclose(found, model.pencil.loads, atol=1e-14)
    assert is_bare == (comm.size > 1)
