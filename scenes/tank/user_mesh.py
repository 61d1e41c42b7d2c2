"""A user mesh: read, and checked against the scene."""

from __future__ import annotations

from mpi4py import MPI

from hydroelastic.fem.tank.mesh import check_mesh
from hydroelastic.meshes.tagged_mesh import MeshError, TaggedMesh
from hydroelastic.scenes.errors import Problem, SceneError, cannot_be_meshed
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.tank_parts import TankParts


def read_user_mesh(scene: TankParts) -> TaggedMesh | None:
    """Return the user mesh of a scene, in m; ``None`` without one."""
    if scene.mesh is None:
        return None
    from hydroelastic.meshes.files import load_mesh  # meshio takes a while to import
    from hydroelastic.meshes.inner_walls import opened_along_baffles

    try:
        mesh = opened_along_baffles(load_mesh(scene.mesh.file), scene.mesh.file.name)
        check_mesh(physical_tank(scene).scaled(), mesh.scaled(1.0 / scene.tank.length))
    except MeshError as error:
        raise mesh_refused(scene, error) from error
    return mesh


def user_mesh(scene: TankParts, comm: MPI.Comm) -> TaggedMesh | None:
    """Return the user mesh of a scene on rank 0, in m; ``None`` elsewhere, and without one (collective)."""
    if scene.mesh is None:
        return None
    mesh, refused = None, None
    if comm.rank == 0:
        try:
            mesh = read_user_mesh(scene)
        except SceneError as error:
            refused = error
        except Exception as error:
            # Any error must reach the other processes, which wait for the mesh.
            refused = mesh_refused(scene, error)
    refused = comm.bcast(refused, root=0)
    if refused is not None:
        raise refused
    return mesh


def mesh_refused(scene: TankParts, error: Exception) -> SceneError:
    """Return the error for a mesh that cannot be used, the user's or the built-in one."""
    if scene.mesh is None:
        return cannot_be_meshed(error, scene)
    problem = Problem(
        key='[mesh], key "file"',
        value=f'"{scene.mesh.file}"',
        wrong=str(error) or type(error).__name__,
        remedy="Correct the mesh, or leave [mesh] out to use the built-in one",
    )
    return SceneError(problem, file=scene.source)
