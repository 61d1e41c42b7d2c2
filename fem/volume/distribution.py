"""The mesh of a volume over the processes: whole from gmsh where it is small, else coarse and refined in parallel."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from dolfinx.mesh import Mesh
from mpi4py import MPI

from hydroelastic.fem.cells import owned_cells
from hydroelastic.meshes.compat import coordinate_degree, geometry_dofmap
from hydroelastic.meshes.distribute import TankMesh, distribute_nodes
from hydroelastic.meshes.plan_loops import Mirrors, image_count
from hydroelastic.meshes.refinement import refined_mesh
from hydroelastic.meshes.tagged_mesh import MeshError, MisplacedError, NodedMesh, TooManyCellsError
from hydroelastic.meshes.tetrahedra import FoldedError, VolumeMesh, mesh_integral, mesh_volume, smallest_jacobians
from hydroelastic.meshes.volume import MOST_CELLS, VolumeSizes, depth_over, volume_mesh
from hydroelastic.physics.volume_tank import SurveyedBed, VolumeTank

# Largest multiple of cells around curved walls where they are inverted, and of all where gmsh fails.
_MOST_AROUND = 3
# Most cells around a curved wall that are tried where they are inverted by a refinement.
_MOST_COARSE = 48
# Of the volume's relative error, that of frequencies.
_GEOMETRY = 2.0


def distributed_volume(
    tank: VolumeTank,
    sizes: VolumeSizes,
    mirrors: Mirrors,
    comm: MPI.Comm,
    require: Callable[[NodedMesh, int], None] = lambda _mesh, _refinements: None,
) -> tuple[TankMesh, float]:
    """Return the mesh over the processes, and an estimate of the relative error of ω by its curved walls
    (collective)."""
    made: VolumeMesh | MeshError | None = None
    if comm.rank == 0:
        try:
            made = unfolded_volume(tank, sizes, mirrors)
            require(made.noded, sizes.refinements if made.surfaces else 0)
        except MeshError as error:
            made = error
    if comm.bcast(isinstance(made, MeshError)):
        raise comm.bcast(made)
    whole = made if isinstance(made, VolumeMesh) else None
    volume, surfaces, curved, meshed, straightened = comm.bcast(
        None
        if whole is None
        else (whole.volume, whole.surfaces, whole.curved, mesh_volume(whole.noded), whole.straightened)
    )
    mesh = distribute_nodes(comm, None if whole is None else whole.noded)
    if surfaces:
        del made, whole
        mesh = refined_mesh(mesh, surfaces, sizes.refinements, curved=curved)
        try:
            volume, meshed = _shaped(tank, mesh.mesh, volume)
        except FoldedError:
            if sizes.coarse.around > _MOST_COARSE:
                raise
            return distributed_volume(tank, replace(sizes, around=2 * sizes.around), mirrors, comm, require)
    # What cells lose that are straightened is lost where the wall is curved most: the added mass of a float feels it.
    displaced = [solid.hydrostatics.volume / image_count(mirrors) for solid in tank.floats]
    return mesh, _GEOMETRY * (abs(meshed / volume - 1.0) + straightened / min([volume, *displaced]))


def unfolded_volume(tank: VolumeTank, sizes: VolumeSizes, mirrors: Mirrors, most: float = MOST_CELLS) -> VolumeMesh:
    """A mesh with more cells around curved walls where they would be inverted, and with smaller ones everywhere where
    gmsh fails: large ones beside the thin rim of a hull, whose sides then cross."""
    failure: MeshError | None = None
    for more in range(1, _MOST_AROUND + 1):
        refined = replace(sizes, around=more * sizes.around)
        if failure is not None and not isinstance(failure, FoldedError):
            refined = replace(refined, edge=sizes.edge / more, bulk=sizes.bulk / more)
        try:
            return volume_mesh(tank, refined, mirrors, most)
        except (MisplacedError, TooManyCellsError):
            raise
        except MeshError as error:
            failure = failure or error
    if isinstance(failure, FoldedError) and isinstance(tank.bed, SurveyedBed):
        raise MisplacedError(
            "the smooth bed through the points is too steep between them, or rises to the still level: "
            "cells over it are inverted"
        ) from failure
    assert failure is not None
    raise failure


def _shaped(tank: VolumeTank, mesh: Mesh, volume: float) -> tuple[float, float]:
    """Move the nodes over a bed through points, as in a mesh that is not refined; return the exact volume and that of
    the mesh."""
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
        raise FoldedError("a cell at a curved wall is inverted: ask for a smaller tolerance, or leave a wider gap")
    return volume, mesh.comm.allreduce(mesh_volume(own))


def _of_process(mesh: Mesh) -> NodedMesh:
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
