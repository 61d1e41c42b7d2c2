"""From a scaled scene to the field model: mesh, beams in their dry modes, floats in their motions, coupled pencil."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from mpi4py import MPI

from hydroelastic.fem.bodies.registry import body_model
from hydroelastic.fem.closed.outline import layer_names, zero_on_axis, zero_potential_surfaces
from hydroelastic.fem.liquid import Layer, liquid_space
from hydroelastic.fem.liquid_matrices import liquid_matrices
from hydroelastic.fem.liquid_pencil import build_pencil
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.shape_loads import loads_with_fluxes
from hydroelastic.fem.surfaces import Body, LiquidSurface
from hydroelastic.fem.tank.mesh import check_mesh, make_mesh
from hydroelastic.fem.tank.resolution import Resolution
from hydroelastic.meshes.distribute import TankMesh, distribute_mesh
from hydroelastic.meshes.geometry import FAR_END, FREE_SURFACE, INTERFACE, SYMMETRY_PLANE
from hydroelastic.meshes.tagged_mesh import MeshError, TaggedMesh
from hydroelastic.physics.symmetry import PARITIES, Parity, left_bodies, twin_of
from hydroelastic.physics.tank import Tank


def build_mesh(
    comm: MPI.Comm, tank: Tank, resolution: Resolution, *, half: bool = False, infinite_frequency: bool = False
) -> TankMesh:
    """Mesh a scaled tank, or its left half, with gmsh on rank 0 and distribute it (collective)."""
    return distributed_mesh(comm, lambda: make_mesh(tank, resolution, half=half, infinite_frequency=infinite_frequency))


def distributed_mesh(comm: MPI.Comm, make: Callable[[], TaggedMesh]) -> TankMesh:
    """Make a mesh, in units of the tank, on rank 0 and distribute it (collective)."""
    tagged, problem = None, ""
    if comm.rank == 0:
        try:
            tagged = make()
        except Exception as error:
            # Any error must reach the other processes, which wait for the mesh.
            problem = str(error) or type(error).__name__
    problem = comm.bcast(problem, root=0)
    if problem:
        raise MeshError(problem)
    return distribute_mesh(comm, tagged)


def distributed_user_mesh(comm: MPI.Comm, tank: Tank, tagged: TaggedMesh | None) -> TankMesh:
    """Distribute a user mesh, on rank 0 in units of the tank, after checking that it fits the scene (collective)."""

    def checked() -> TaggedMesh:
        assert tagged is not None
        check_mesh(tank, tagged)
        return tagged

    return distributed_mesh(comm, checked)


def build_field_model(
    mesh: TankMesh, tank: Tank, *, degree: int, shapes: tuple[int, ...], infinite_frequency: bool = False
) -> CoupledPencil:
    """Assemble the coupled problem of a whole tank."""
    (pencil,) = _field_models(mesh, tank, degree, shapes, infinite_frequency, (None,))
    return pencil


def build_half_models(
    mesh: TankMesh,
    tank: Tank,
    *,
    degree: int,
    shapes: tuple[int, ...],
    infinite_frequency: bool = False,
    parities: tuple[Parity, ...] = PARITIES,
) -> tuple[CoupledPencil, ...]:
    """Assemble the symmetric and the antisymmetric problem on the left half of a tank that is its own mirror image."""
    return _field_models(mesh, tank, degree, shapes, infinite_frequency, parities)


def moving_parities(tank: Tank, shapes: tuple[int, ...], *, infinite_frequency: bool) -> tuple[Parity, ...]:
    """Return the symmetries with unknowns: with a lid or at infinite frequency those of the shapes of bodies only."""
    if not infinite_frequency and tank.has_waves:
        return PARITIES
    return tuple(parity for parity in PARITIES if any(body.size for body in half_bodies(tank, shapes, parity)))


def _field_models(
    mesh: TankMesh,
    tank: Tank,
    degree: int,
    shapes: tuple[int, ...],
    infinite_frequency: bool,
    parities: tuple[Parity | None, ...],
) -> tuple[CoupledPencil, ...]:
    surfaces = () if infinite_frequency else moving_surfaces(mesh, tank)
    zero_potential = (
        *zero_potential_surfaces(tank, infinite_frequency=infinite_frequency),
        *zero_on_axis(tank),
        *((FAR_END,) if FAR_END in mesh.facet_names else ()),
    )
    liquid = liquid_space(
        mesh,
        degree,
        zero_potential,
        tank_layers(tank),
        continuous_pressure=infinite_frequency and tank.has_continuous_pressure,
        geometry=tank.geometry,
        condensed=True,
    )
    matrices = liquid_matrices(liquid, surfaces)
    of_parities = []
    alike: dict[str, list[Body]] = {}
    for parity in parities:
        bodies = whole_bodies(tank, shapes) if parity is None else half_bodies(tank, shapes, parity)
        # A float in the middle may have no motion of this parity, and a beam may be fixed.
        of_parities.append(tuple(body for body in bodies if body.size))
        for body in of_parities[-1]:
            alike.setdefault(body.surface, []).append(body)
    loads = {surface: iter(loads_with_fluxes(liquid, own)) for surface, own in alike.items()}
    pencils = []
    for parity, moving in zip(parities, of_parities, strict=True):
        plane = (SYMMETRY_PLANE,) if parity == "antisymmetric" else ()
        part = replace(liquid, zero_potential=liquid.zero_potential + plane)
        of_bodies = [next(loads[body.surface]) for body in moving]
        pencils.append(build_pencil(part, matrices, bodies=moving, of_bodies=of_bodies, surfaces=surfaces))
    return tuple(pencils)


def tank_layers(tank: Tank) -> tuple[Layer, ...]:
    """Return the liquids of a tank as layers of the field model, from the bottom up.

    A and all that is made of the liquid are linear in the densities: these contain the factor c of the geometry.
    """
    return tuple(
        Layer(name=name, density=tank.geometry.measure * layer.density)
        for name, layer in zip(layer_names(tank), tank.layers, strict=True)
    )


def moving_surfaces(mesh: TankMesh, tank: Tank) -> tuple[LiquidSurface, ...]:
    """Return the surfaces of the liquids on which gravity waves travel."""
    surfaces = (
        LiquidSurface(
            surface=FREE_SURFACE if level.above is None else INTERFACE,
            gravity=1.0,
            below=level.below,
            above=level.above,
        )
        for level in tank.levels
        if level.moves
    )
    return tuple(surface for surface in surfaces if surface.surface in mesh.facet_names)


def whole_bodies(tank: Tank, shapes: tuple[int, ...]) -> tuple[Body, ...]:
    """Return every beam of a tank in its first dry modes, every float in its motions, in the order of the tank.

    A beam without dry modes is fixed. ``shapes`` has the number of dry modes of each beam, 0 for floats.
    """
    return tuple(body_model(tank, index).moving(count, None) for index, count in enumerate(shapes))


def half_bodies(tank: Tank, shapes: tuple[int, ...], parity: Parity) -> tuple[Body, ...]:
    """Return the bodies of the left half of a symmetric tank in their shapes of one symmetry, as `whole_bodies`."""
    return tuple(
        body_model(tank, index).moving(shapes[index], parity if twin_of(tank, index) == index else None)
        for index in left_bodies(tank)
    )
