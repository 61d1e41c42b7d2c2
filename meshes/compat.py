"""Differences between versions of dolfinx, by probing features; no other module depends on the version."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
from dolfinx import fem, graph
from dolfinx.mesh import GhostMode, create_cell_partitioner
from mpi4py import MPI

try:  # dolfinx >= 0.10
    from dolfinx.io import distribute_entity_data
except ImportError:
    from dolfinx.io.utils import distribute_entity_data

__all__ = [
    "cell_partitioner",
    "collapsed",
    "compiled_form",
    "coordinate_degree",
    "distribute_entity_data",
    "form_in_cells",
    "form_on_facets",
    "geometry_dofmap",
    "given_partition",
]


def geometry_dofmap(mesh: Any) -> Any:
    """Node numbers of each cell's geometry; from 0.11 on a mesh may have several kinds of cells, ours has one."""
    dofmaps = getattr(mesh.geometry, "dofmaps", None)
    return mesh.geometry.dofmap if dofmaps is None or callable(dofmaps) else dofmaps[0]


def coordinate_degree(mesh: Any) -> int:
    """Polynomial degree of the coordinates of a mesh's cells."""
    cmaps = getattr(mesh.geometry, "cmaps", None)
    cmap = mesh.geometry.cmap if cmaps is None or callable(cmaps) else cmaps[0]
    return int(cmap.degree)


def cell_partitioner(mode: GhostMode) -> Any:
    """The partitioner of cells; from 0.11 on it needs the largest number of cells at a facet."""
    try:
        return create_cell_partitioner(mode)
    except TypeError:
        return create_cell_partitioner(mode, 2)


def given_partition(processes: npt.NDArray[np.int32]) -> Any:
    """A partitioner of cells whose processes are known, without ghosts."""
    # A wrapped list from 0.10 on.
    found = graph.adjacencylist(processes[:, None])
    return lambda *_mesh: getattr(found, "_cpp_object", found)


def collapsed(space: Any, part: int) -> tuple[Any, npt.NDArray[np.int32]]:
    """A part of a mixed space as a space of its own, and the places of its unknowns in the mixed one.

    From 0.11 on dolfinx gives the places for each kind of cells; our meshes have one kind.
    """
    own, places = space.sub(part).collapse()
    return own, np.ravel(np.asarray(places, dtype=np.int32))


def compiled_form(comm: MPI.Comm, form: Any, options: dict[str, Any]) -> Any:
    """Compile a form on an abstract mesh (collective)."""
    return fem.compile_form(comm, form, form_compiler_options={"scalar_type": np.float64}, jit_options=options)


def form_on_facets(compiled: Any, spaces: list[Any], mesh: Any, number: int, facets: npt.NDArray[np.int32]) -> Any:
    """A compiled form of exterior facets on a mesh."""
    dim = mesh.topology.dim - 1
    kind = fem.IntegralType.exterior_facet
    mesh.topology.create_connectivity(dim, dim + 1)
    mesh.topology.create_connectivity(dim + 1, dim)
    try:
        entities = fem.compute_integration_domains(kind, mesh.topology, facets, dim)
    except TypeError:  # from 0.11 on
        entities = fem.compute_integration_domains(kind, mesh.topology, facets)
    return fem.create_form(compiled, spaces, mesh, {kind: [(number, entities)]}, {}, {})


def form_in_cells(compiled: Any, spaces: list[Any], mesh: Any, constants: dict[Any, float]) -> Any:
    """A compiled form of all cells on a mesh, with values of its constants."""
    given = {constant: fem.Constant(mesh, value) for constant, value in constants.items()}
    return fem.create_form(compiled, spaces, mesh, {}, {}, given)
