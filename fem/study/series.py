"""The series of solutions of a study, each an iterator of rows."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from typing import Literal

from mpi4py import MPI

from hydroelastic.fem.solver_error import EigenSolverError
from hydroelastic.fem.study.meshes import coarsest_size, full_order_gradings, nested_meshes
from hydroelastic.fem.study.row import StudyRow
from hydroelastic.fem.study.rows import mesh_row, tolerance_row
from hydroelastic.fem.study.singular_points import has_curved_contours, sharpest_of
from hydroelastic.fem.study.steady import steadily_timed
from hydroelastic.fem.study.studied_tank import StudiedTank
from hydroelastic.fem.tank.field_model import build_mesh, distributed_mesh
from hydroelastic.fem.tank.mesh import unknown_count
from hydroelastic.fem.tank.resolution import SMALLEST_TIP
from hydroelastic.meshes.grading import Grading

_mesh_row, _tolerance_row = steadily_timed(mesh_row), steadily_timed(tolerance_row)


def nested_rows(
    studied: StudiedTank,
    family: Literal["uniform", "algebraic"],
    degrees: Sequence[int],
    *,
    halvings: int,
    most_unknowns: int,
) -> Iterator[StudyRow]:
    """Solve on meshes with repeatedly halved elements, while errors are above rounding (collective)."""
    tank = studied.tank
    if has_curved_contours(tank) or (family == "algebraic" and sharpest_of(tank) is None):
        return
    meshes = nested_meshes(tank, half=studied.half)
    first = distributed_mesh(MPI.COMM_WORLD, partial(meshes.mesh, 0))
    points = first.mesh.topology.index_map(0).size_global
    parts = 2 if studied.half else 1
    for degree in degrees:
        uniform = (1.0,) * len(meshes.graded_points)
        gradings = full_order_gradings(tank, meshes, degree) if family == "algebraic" else uniform
        solved = False
        for halved in range(halvings + 1):
            unknowns = parts * unknown_count(points, first.cell_count, degree * 2**halved)
            if unknowns > most_unknowns or meshes.innermost_ring(halved, gradings) < SMALLEST_TIP:
                break
            try:
                row = _mesh_row(
                    studied,
                    family,
                    replace(studied.finest, degree=degree),
                    partial(distributed_mesh, MPI.COMM_WORLD, partial(meshes.mesh, halved, gradings)),
                    element_size=coarsest_size(tank) / 2**halved,
                    # At the sharpest singular point.
                    grading=max(gradings, default=1.0),
                )
            except EigenSolverError:
                # The mesh has hardly as many nodes at the top as there are requested modes.
                if solved:
                    raise
                continue
            if row is not None:
                solved = True
                yield row


def geometric_rows(studied: StudiedTank, degrees: Sequence[int]) -> Iterator[StudyRow]:
    """Solve on one mesh with geometric rings around the tips at each degree (collective)."""
    for degree in degrees:
        # The same ratio of rings for all tanks, so that their gains can be compared.
        resolution = replace(studied.finest, degree=degree, ring_ratio=Grading.ring_ratio)
        row = _mesh_row(
            studied,
            "geometric",
            resolution,
            partial(build_mesh, MPI.COMM_WORLD, studied.tank, resolution, half=studied.half),
            element_size=max(resolution.surface_sizes),
        )
        if row is not None:
            yield row


def tolerance_rows(studied: StudiedTank, tolerances: Sequence[float]) -> Iterator[StudyRow]:
    """Solve to each of some relative tolerances (collective)."""
    return (_tolerance_row(studied, tolerance) for tolerance in tolerances)
