"""The mesh of a volume over the processes: whole from gmsh where it is small, else coarse and refined in parallel."""

from __future__ import annotations

from dataclasses import replace
from math import ceil, log, pi

import numpy as np
from dolfinx.mesh import Mesh
from mpi4py import MPI

from hydroelastic.fem.cells import owned_cells
from hydroelastic.meshes.compat import coordinate_degree, geometry_dofmap
from hydroelastic.meshes.distribute import NodedMesh, TankMesh, distribute_nodes
from hydroelastic.meshes.plan_loops import Mirrors
from hydroelastic.meshes.refinement import refined_mesh
from hydroelastic.meshes.tagged_mesh import MeshError
from hydroelastic.meshes.tetrahedra import FoldedError, VolumeMesh, mesh_integral, mesh_volume, smallest_jacobians
from hydroelastic.meshes.volume import VolumeSizes, depth_over, volume_mesh
from hydroelastic.physics.level_tank import FilePlan
from hydroelastic.physics.volume_tank import SurveyedBed, VolumeTank

LARGEST_MESH = 100_000
"""Up to so many cells gmsh makes the mesh; it makes 27,000 in a second, on one process."""

# Largest multiple of cells around curved walls, where they are inverted.
_MOST_AROUND = 3
# Of the volume's relative error, that of frequencies.
_GEOMETRY = 2.0
# Cells of edge h in a volume over that over h³, and growing from edges of plates over their length over h; measured.
_OF_VOLUME, _OF_EDGES = 8.5, 37.0
_MOST_REFINEMENTS = 4


def with_refinements(tank: VolumeTank, sizes: VolumeSizes, mirrors: Mirrors) -> VolumeSizes:
    """Return sizes with as many refinements that gmsh makes no more than about `LARGEST_MESH` cells."""
    if isinstance(tank.plan, FilePlan) and tank.plan.file.suffix.lower() == ".msh":
        return sizes
    levels = ceil(log(expected_cells(tank, sizes, mirrors) / LARGEST_MESH, 8))
    return replace(sizes, refinements=min(max(0, levels), _MOST_REFINEMENTS))


def expected_cells(tank: VolumeTank, sizes: VolumeSizes, mirrors: Mirrors) -> float:
    """Return about the number of cells of a mesh between planes of symmetry, without making it."""
    lengths = [4.0 * plate.outline.area**0.5 for plate in tank.plates]
    lengths += [pi * sum(solid.size) / 2.0 for solid in tank.floats]
    cells = _OF_VOLUME * tank.plan.area * tank.depth / sizes.bulk**3 + _OF_EDGES * sum(lengths) / sizes.edge
    return float(cells / 2 ** sum(mirror is not None for mirror in mirrors))


def distributed_volume(
    tank: VolumeTank, sizes: VolumeSizes, mirrors: Mirrors, comm: MPI.Comm
) -> tuple[TankMesh, float]:
    """Return the mesh over the processes, and an estimate of the relative error of ω by its curved walls (collective).

    Raises:
        MeshError: if the volume cannot be meshed.
    """
    made: VolumeMesh | MeshError | None = None
    if comm.rank == 0:
        try:
            made = unfolded_volume(tank, sizes, mirrors)
        except MeshError as error:
            made = error
    if comm.bcast(isinstance(made, MeshError)):
        raise comm.bcast(made)
    whole = made if isinstance(made, VolumeMesh) else None
    volume, surfaces, curved, meshed = comm.bcast(
        whole and (whole.volume, whole.surfaces, whole.curved, mesh_volume(whole.noded))
    )
    mesh = distribute_nodes(comm, whole and whole.noded)
    if surfaces:
        del made, whole
        mesh = refined_mesh(mesh, surfaces, sizes.refinements, curved=curved)
        volume, meshed = _shaped(tank, mesh.mesh, volume)
    return mesh, _GEOMETRY * abs(meshed / volume - 1.0)


def unfolded_volume(tank: VolumeTank, sizes: VolumeSizes, mirrors: Mirrors) -> VolumeMesh:
    """A mesh with more cells around curved walls where they would be inverted."""
    for more in range(1, _MOST_AROUND + 1):
        try:
            return volume_mesh(tank, replace(sizes, around=more * sizes.around), mirrors)
        except FoldedError:
            if more == _MOST_AROUND:
                raise
    raise AssertionError


def _shaped(tank: VolumeTank, mesh: Mesh, volume: float) -> tuple[float, float]:
    """Move the nodes over a bed through points, as in a mesh that is not refined; return the exact volume and that of
    the mesh.

    Raises:
        FoldedError: if a cell is inverted.
    """
    own = _of_process(mesh)
    if isinstance(tank.bed, SurveyedBed):
        bed = depth_over(tank)
        stretched = mesh_integral(own, lambda places: np.asarray(bed(places[:, :2]) / tank.depth))
        level, deep = mesh.comm.allreduce(np.array([mesh_volume(own), stretched]))
        volume *= deep / level
        points = mesh.geometry.x
        points[:, 2] *= bed(points[:, :2]) / tank.depth
        own = _of_process(mesh)
    if mesh.comm.allreduce(smallest_jacobians(own).min(initial=1.0), op=MPI.MIN) <= 0.0:
        raise FoldedError("a cell at a curved wall is inverted: ask for smaller cells")
    return volume, mesh.comm.allreduce(mesh_volume(own))


def _of_process(mesh: Mesh) -> NodedMesh:
    """The cells of this process as arrays, without groups."""
    return NodedMesh(
        cell="tetrahedron",
        degree=coordinate_degree(mesh),
        points=mesh.geometry.x,
        cells=geometry_dofmap(mesh)[owned_cells(mesh)].astype(np.int64),
        cell_tags=np.empty(0, np.int32),
        facets=np.empty((0, 3), np.int64),
        facet_tags=np.empty(0, np.int32),
        cell_names={},
        facet_names={},
    )
