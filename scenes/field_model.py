"""From a scaled scene to the field model: mesh, bodies in their dry modes, coupled pencil."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.liquid import liquid_matrices, liquid_space
from hydroelastic.fem.pencil import CoupledPencil, build_pencil
from hydroelastic.fem.surfaces import Body, LiquidSurface
from hydroelastic.meshes.distribute import TankMesh, distribute_mesh
from hydroelastic.meshes.geometry import FREE_SURFACE, SYMMETRY_PLANE, body_name
from hydroelastic.meshes.tagged_mesh import MeshError, TaggedMesh
from hydroelastic.modal.dry_modes import free_free_shape, free_free_wavenumber
from hydroelastic.modal.guided_modes import guided_shape, guided_wavenumber
from hydroelastic.scenes.plan import Resolution, ScaledTank
from hydroelastic.scenes.symmetry import PARITIES, Parity, left_bodies, shape_parity, twin_of
from hydroelastic.scenes.tank_mesh import check_mesh, make_mesh


def build_mesh(comm: MPI.Comm, tank: ScaledTank, resolution: Resolution, *, half: bool = False) -> TankMesh:
    """Mesh a scene, or its left half, with gmsh on rank 0 and distribute it (collective)."""
    return distributed_mesh(comm, lambda: make_mesh(tank, resolution, half=half))


def distributed_mesh(comm: MPI.Comm, make: Callable[[], TaggedMesh]) -> TankMesh:
    """Make a mesh, in units of the tank, on rank 0 and distribute it (collective).

    Raises:
        MeshError: on all ranks, if ``make`` fails.
    """
    tagged, problem = None, ""
    if comm.rank == 0:
        try:
            tagged = make()
        except Exception as error:
            # Whatever it is, the other processes wait to hear of it.
            problem = str(error) or type(error).__name__
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
    """Assemble the coupled problem of a whole tank.

    Args:
        mesh: the liquid's mesh.
        tank: the scene.
        degree: polynomial degree of ψ.
        shapes: number of dry modes of each beam.
        pressure_release: put ψ = 0 on the water whatever the scene says; the limit of high frequency.

    Returns:
        The dimensionless pencil (collective).
    """
    (pencil,) = _field_models(mesh, tank, degree, shapes, pressure_release, (None,))
    return pencil


def build_half_models(
    mesh: TankMesh, tank: ScaledTank, *, degree: int, shapes: tuple[int, ...], pressure_release: bool = False
) -> tuple[CoupledPencil, CoupledPencil]:
    """Assemble the symmetric and the antisymmetric problem on the left half of a tank that is its own mirror image.

    Args:
        mesh: the mesh of the half.
        tank: the whole scene.
        degree: polynomial degree of ψ.
        shapes: number of dry modes of each beam of the whole tank.
        pressure_release: put ψ = 0 on the water whatever the scene says.

    Returns:
        A pencil for each of `PARITIES`, with energies of half the tank (collective). A beam that the mirror plane
        cuts keeps its dry modes of that parity; of two beams that are mirror images the left one is there.
    """
    one, other = _field_models(mesh, tank, degree, shapes, pressure_release, PARITIES)
    return one, other


def _field_models(
    mesh: TankMesh,
    tank: ScaledTank,
    degree: int,
    shapes: tuple[int, ...],
    pressure_release: bool,
    parities: tuple[Parity | None, ...],
) -> tuple[CoupledPencil, ...]:
    has_water = FREE_SURFACE in mesh.facet_names
    released = has_water and (pressure_release or tank.top == "pressure_release")
    surfaces = (LiquidSurface(surface=FREE_SURFACE, gravity=1.0),) if has_water and not released else ()
    liquid = liquid_space(mesh, degree, (FREE_SURFACE,) if released else ())
    matrices = liquid_matrices(liquid, tuple(surface.surface for surface in surfaces))
    pencils = []
    for parity in parities:
        plane = (SYMMETRY_PLANE,) if parity == "antisymmetric" else ()
        bodies = whole_bodies(tank, shapes) if parity is None else _half_bodies(tank, shapes, parity)
        pencils.append(
            build_pencil(
                replace(liquid, grounded=liquid.grounded + plane),
                matrices,
                bodies=bodies,
                surfaces=surfaces,
            )
        )
    return tuple(pencils)


def whole_bodies(tank: ScaledTank, shapes: tuple[int, ...]) -> tuple[Body, ...]:
    """Every beam of a tank in its first dry modes."""
    return tuple(_beam_body(tank, index, count, None) for index, count in enumerate(shapes))


def _half_bodies(tank: ScaledTank, shapes: tuple[int, ...], parity: Parity) -> tuple[Body, ...]:
    return tuple(
        _beam_body(tank, index, shapes[index], parity if twin_of(tank, index) == index else None)
        for index in left_bodies(tank)
    )


def _beam_body(tank: ScaledTank, index: int, count: int, parity: Parity | None) -> Body:
    """A beam in its first ``count`` dry modes, rigid ones included; dimensionless.

    With a parity, only the shapes of that parity about its middle, and the energies of half the beam.
    """
    beam = tank.beams[index]
    start, end = next((start, end) for start, end, body in tank.pieces if body == index)
    length = end - start
    part = 1.0 if parity is None else 0.5
    guided = beam.ends == "guided"
    numbers = [number for number in range(count) if parity in (None, shape_parity(number))]
    wavenumber = guided_wavenumber if guided else free_free_wavenumber
    roots = np.array([wavenumber(number) for number in numbers])
    bending = part * beam.flexural_rigidity * (roots / length) ** 4 * length
    return Body(
        surface=body_name(index + 1),
        shapes=partial(_shape_at, guided, start, length, numbers),
        wavenumber=float(roots[-1]) / length,
        labels=tuple(_label(guided, number) for number in numbers),
        stiffness=bending + part * float(beam.hydrostatic) * length,
        bending_stiffness=bending,
        mass=np.full(len(numbers), part * beam.mass_per_length * length),
    )


def _label(guided: bool, number: int) -> str:
    rigid = ("heave",) if guided else ("heave", "pitch")
    return rigid[number] if number < len(rigid) else f"elastic {number - len(rigid) + 1}"


def _shape_at(
    guided: bool, start: float, length: float, numbers: list[int], points: np.ndarray, normals: np.ndarray, place: int
) -> np.ndarray:
    # Quadrature points at the tips may miss them by rounding.
    s = np.clip((points[0] - start) / length, 0.0, 1.0)
    deflection = guided_shape(numbers[place], s) if guided else free_free_shape(numbers[place], s)
    upwards: np.ndarray = deflection * normals[1]
    return upwards
