"""From a scaled scene to the field model: mesh, bodies in their dry modes, coupled pencil."""

from __future__ import annotations

from functools import partial

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.liquid import liquid_space
from hydroelastic.fem.pencil import CoupledPencil, build_pencil
from hydroelastic.fem.surfaces import Body, FreeSurface
from hydroelastic.meshes.distribute import TankMesh, distribute_mesh
from hydroelastic.meshes.geometry import FREE_SURFACE, body_name
from hydroelastic.meshes.tagged_mesh import MeshError, TaggedMesh
from hydroelastic.modal.dry_modes import free_free_shape, free_free_wavenumber
from hydroelastic.modal.guided_modes import guided_shape, guided_wavenumber
from hydroelastic.scenes.models import Beam
from hydroelastic.scenes.plan import Resolution, ScaledTank
from hydroelastic.scenes.tank_mesh import check_mesh, make_mesh


def build_mesh(comm: MPI.Comm, tank: ScaledTank, resolution: Resolution) -> TankMesh:
    """Mesh a scene with gmsh on rank 0 and distribute it (collective)."""
    tagged, problem = None, ""
    if comm.rank == 0:
        try:
            tagged = make_mesh(tank, resolution)
        except MeshError as error:
            problem = str(error)
    return _distributed(comm, tagged, problem)


def bring_mesh(comm: MPI.Comm, tank: ScaledTank, tagged: TaggedMesh | None, problem: str = "") -> TankMesh:
    """Distribute a mesh that the user brought, already in units of the tank, after checking that it fits the scene.

    Raises:
        MeshError: if a group is missing, or a group does not lie where the scene says.
    """
    if comm.rank == 0 and tagged is not None and not problem:
        try:
            check_mesh(tank, tagged)
        except MeshError as error:
            problem = str(error)
    return _distributed(comm, tagged, problem)


def _distributed(comm: MPI.Comm, tagged: TaggedMesh | None, problem: str) -> TankMesh:
    problem = comm.bcast(problem, root=0)
    if problem:
        raise MeshError(problem)
    return distribute_mesh(comm, tagged)


def build_field_model(
    mesh: TankMesh, tank: ScaledTank, *, degree: int, shapes: tuple[int, ...], pressure_release: bool = False
) -> CoupledPencil:
    """Assemble the coupled problem of a scene.

    Args:
        mesh: the liquid's mesh.
        tank: the scene.
        degree: polynomial degree of ψ.
        shapes: number of dry modes of each beam.
        pressure_release: put ψ = 0 on the water whatever the scene says; the limit of high frequency.

    Returns:
        The dimensionless pencil (collective).
    """
    has_water = FREE_SURFACE in mesh.facet_names
    released = has_water and (pressure_release or tank.top == "pressure_release")
    gravity_surface = has_water and not released
    place = {body: (start, end) for start, end, body in tank.pieces if body is not None}
    bodies = tuple(
        beam_body(beam, body_name(index + 1), place[index], shapes[index]) for index, beam in enumerate(tank.beams)
    )
    return build_pencil(
        liquid_space(mesh, degree, (FREE_SURFACE,) if released else ()),
        bodies=bodies,
        free_surface=FreeSurface(surface=FREE_SURFACE, gravity=1.0) if gravity_surface else None,
        density=1.0,
    )


def beam_body(beam: Beam, name: str, place: tuple[float, float], count: int) -> Body:
    """A beam in its first ``count`` dry modes, rigid ones included; dimensionless."""
    start, end = place
    length = end - start
    guided = beam.ends == "guided"
    wavenumber = guided_wavenumber if guided else free_free_wavenumber
    rigid = ("heave",) if guided else ("heave", "pitch")
    roots = np.array([wavenumber(index) for index in range(count)])
    bending = beam.flexural_rigidity * (roots / length) ** 4 * length
    return Body(
        surface=name,
        shapes=partial(_shape_at, guided, start, length),
        wavenumber=float(roots[-1]) / length,
        labels=(*rigid, *(f"elastic {number}" for number in range(1, count - len(rigid) + 1))),
        stiffness=bending + float(beam.hydrostatic) * length,
        bending_stiffness=bending,
        mass=np.full(count, beam.mass_per_length * length),
    )


def _shape_at(guided: bool, start: float, length: float, points: np.ndarray, number: int) -> np.ndarray:
    # Quadrature points at the tips may miss them by rounding.
    s = np.clip((points[0] - start) / length, 0.0, 1.0)
    return guided_shape(number, s) if guided else free_free_shape(number, s)
