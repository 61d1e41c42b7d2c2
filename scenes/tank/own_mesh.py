"""The mesh that the user brings: read, and checked against the scene."""

from __future__ import annotations

from mpi4py import MPI

from hydroelastic.fem.tank.mesh import check_mesh
from hydroelastic.meshes.files import load_mesh
from hydroelastic.meshes.tagged_mesh import MeshError, TaggedMesh
from hydroelastic.scenes.errors import Problem, SceneError
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.tank import TankScene


def read_own_mesh(scene: TankScene) -> TaggedMesh | None:
    """Return the mesh that a scene names, m; ``None`` if it names none.

    Raises:
        SceneError: if it cannot be read, or does not fit the scene.
    """
    if scene.mesh is None:
        return None
    try:
        mesh = load_mesh(scene.mesh.file)
        check_mesh(physical_tank(scene).scaled(), mesh.scaled(1.0 / scene.tank.length))
    except MeshError as error:
        raise mesh_refused(scene, str(error)) from error
    return mesh


def own_mesh(scene: TankScene, comm: MPI.Comm) -> TaggedMesh | None:
    """Return the mesh that a scene names, on rank 0; ``None`` elsewhere, and if it names none (collective).

    Raises:
        SceneError: on all processes, if it cannot be read, or does not fit the scene.
    """
    if scene.mesh is None:
        return None
    mesh, refused = None, None
    if comm.rank == 0:
        try:
            mesh = read_own_mesh(scene)
        except SceneError as error:
            refused = error
        except Exception as error:
            # Whatever it is, the other processes wait to hear of it.
            refused = mesh_refused(scene, str(error) or type(error).__name__)
    refused = comm.bcast(refused, root=0)
    if refused is not None:
        raise refused
    return mesh


def mesh_refused(scene: TankScene, wrong: str) -> SceneError:
    """Return what is said of a mesh that cannot be used, the user's or the built-in one."""
    if scene.mesh is None:
        return SceneError(Problem(wrong=f"no mesh could be made: {wrong}", remedy="Please report this scene"))
    problem = Problem(
        key='[mesh], key "file"',
        value=f'"{scene.mesh.file}"',
        wrong=wrong,
        remedy="Correct the mesh, or leave [mesh] out to use the built-in one",
    )
    return SceneError(problem, file=scene.source)
