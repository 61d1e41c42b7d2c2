"""The series of a study, each an iterator of rows."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial

from mpi4py import MPI

from hydroelastic.fem.modes import EigenSolverError
from hydroelastic.fem.tank.field_model import build_mesh, distributed_mesh
from hydroelastic.fem.tank.mesh import unknown_count
from hydroelastic.fem.tank.resolution import SMALLEST_TIP
from hydroelastic.meshes.grading import Grading
from hydroelastic.meshes.nested import NestedMeshes
from hydroelastic.scenes.study.corners import has_curved_contours
from hydroelastic.scenes.study.meshes import coarsest_size, full_order_gradings, nested_meshes
from hydroelastic.scenes.study.plan import Family, StudyPlan
from hydroelastic.scenes.study.rows import StudiedTank, StudyRow, mesh_row, tolerance_row
from hydroelastic.scenes.study.steady import steadily_timed
from hydroelastic.scenes.study.theory import singular_exponent

_mesh_row, _tolerance_row = steadily_timed(mesh_row), steadily_timed(tolerance_row)


def _uniform(studied: StudiedTank, plan: StudyPlan) -> Iterator[StudyRow]:
    """Elements of one size, halved again and again; none along curved contours."""
    if has_curved_contours(studied.tank):
        return
    meshes = nested_meshes(studied.tank, half=studied.half)
    for degree in plan.degrees:
        yield from _halved(studied, plan, "uniform", degree, meshes, (1.0,) * len(meshes.corners))


def _algebraic(studied: StudiedTank, plan: StudyPlan) -> Iterator[StudyRow]:
    """The same meshes drawn towards the corners, so far that the full order is expected; none where ψ is smooth."""
    if has_curved_contours(studied.tank) or singular_exponent(studied.scene) is None:
        return
    meshes = nested_meshes(studied.tank, half=studied.half)
    for degree in plan.degrees:
        gradings = full_order_gradings(studied.tank, meshes, degree)
        yield from _halved(studied, plan, "algebraic", degree, meshes, gradings)


def _halved(
    studied: StudiedTank,
    plan: StudyPlan,
    family: Family,
    degree: int,
    meshes: NestedMeshes,
    gradings: tuple[float, ...],
) -> Iterator[StudyRow]:
    """One degree on one mesh after the other, while they stay within the plan's unknowns and above rounding."""
    first = distributed_mesh(MPI.COMM_WORLD, partial(meshes.mesh, 0))
    points = first.mesh.topology.index_map(0).size_global
    parts = 2 if studied.half else 1
    solved = False
    for halvings in range(plan.halvings + 1):
        unknowns = parts * unknown_count(points, first.cell_count, degree * 2**halvings)
        if unknowns > plan.most_unknowns or meshes.innermost_ring(halvings, gradings) < SMALLEST_TIP:
            return
        try:
            row = _mesh_row(
                studied,
                family,
                replace(studied.finest, degree=degree),
                partial(distributed_mesh, MPI.COMM_WORLD, partial(meshes.mesh, halvings, gradings)),
                element_size=coarsest_size(studied.tank) / 2**halvings,
                # At the sharpest corner.
                grading=max(gradings, default=1.0),
            )
        except EigenSolverError:
            # On a mesh with hardly as many nodes at the top as modes are asked for.
            if solved:
                raise
            continue
        if row is not None:
            solved = True
            yield row


def _geometric(studied: StudiedTank, plan: StudyPlan) -> Iterator[StudyRow]:
    """One mesh with geometric rings around the tips, degree by degree."""
    for degree in plan.geometric_degrees:
        # One ratio for all scenes, whatever a solution would choose, so that their gains can be compared.
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


def _tolerance(studied: StudiedTank, plan: StudyPlan) -> Iterator[StudyRow]:
    """What the solver makes of a tolerance."""
    for tolerance in plan.tolerances:
        yield _tolerance_row(studied, tolerance)


SERIES: dict[Family, Callable[[StudiedTank, StudyPlan], Iterator[StudyRow]]] = {
    "uniform": _uniform,
    "algebraic": _algebraic,
    "geometric": _geometric,
    "tolerance": _tolerance,
}
"""What solves each family of a plan (collective)."""
