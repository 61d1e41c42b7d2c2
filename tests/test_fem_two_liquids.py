"""Two liquids in one tank: waves and beams on their interface, the volumes they keep, and slits across it."""

from __future__ import annotations

import json
from itertools import pairwise
from math import isclose
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from layered_tanks import GRAVITY, PlainProblem, check_processes, frequencies, layered, pencils, rigid, sparse
from petsc4py import PETSc

from hydroelastic.fem.inertia import count_below
from hydroelastic.fem.liquid_matrices import liquid_matrices
from hydroelastic.fem.liquid_pencil import surface_fluxes
from hydroelastic.fem.modes import solve_modes
from hydroelastic.fem.shape_loads import loads_with_fluxes, surface_load
from hydroelastic.modal.liquid.two_layer import InterfacePlate, LayerTop, TwoLayers, tank_modes
from hydroelastic.scenes.models.bodies import Beam
from hydroelastic.scenes.models.tank import TankScene

REFERENCE = json.loads((Path(__file__).parent / "reference" / "two_liquid_beam.json").read_text(encoding="utf-8"))
ROWS: dict[str, dict[str, Any]] = {row["case"]: row for row in REFERENCE["rows"]}

TOPS: tuple[LayerTop, ...] = ("rigid", "free", "pressure_release")
COVER = {"start": 0.0, "length": 1.0, "ends": "guided"}


def interface_beam(**changes: Any) -> Beam:
    """The beam of the public reference."""
    given = {"start": 0.3, "length": 0.4, "mass_per_length": 4.0, "flexural_rigidity": 50.0}
    return Beam(**(given | changes))


def exact(scene: TankScene, plate: InterfacePlate | None = None) -> np.ndarray:
    """ω of a tank without floats whose interface is bare, or wholly covered."""
    below, above = scene.liquid
    layers = TwoLayers(
        density_below=below.density,
        density_above=above.density,
        depth_below=below.depth,
        depth_above=above.depth,
        gravity=GRAVITY,
        top=scene.tank.top,
    )
    modes = tank_modes(layers, scene.tank.length, scene.accuracy.modes, plate)
    return np.array([mode.omega for mode in modes])


def check(tanks: Any, scene: TankScene, omega: np.ndarray, bound: float) -> None:
    """The tolerance asked is kept, and no error exceeds its estimate, nor the bound."""
    solution = tanks.solve(scene)
    assert solution.reasons == ()
    errors = np.abs(tanks.omega(scene) / omega - 1.0)
    assert errors.max() <= bound
    assert np.all(errors <= solution.relative_errors[: len(errors)])


# Thin layers leave a tolerance of 5e-10 to rounding, see `fem/tank/resolution.py`.
DEPTHS = [((0.3, 0.2), 1e-10), ((1.0, 0.01), 1e-9), ((0.01, 1.0), 1e-9)]


@pytest.mark.slow_but("alike-990.0-rigid", "alike-850.0-*", "1 to 100-999.9-free")
@pytest.mark.slow_on_ranks_but("alike-850.0-free")
@pytest.mark.mpi
@pytest.mark.parametrize("top", TOPS)
@pytest.mark.parametrize("density", [990.0, 999.9, 850.0])
@pytest.mark.parametrize(("depths", "tolerance"), DEPTHS, ids=["alike", "1 to 100", "100 to 1"])
def test_waves_of_two_layers_keep_a_tolerance(
    tanks: Any, top: LayerTop, density: float, depths: tuple[float, float], tolerance: float
) -> None:
    scene = layered(densities=(1000.0, density), depths=depths, top=top, tolerance=tolerance, modes=8)
    # Measured: 6e-12 in layers that are alike, 1e-10 in thin ones.
    check(tanks, scene, exact(scene), tolerance)


@pytest.mark.slow_on_ranks_but
@pytest.mark.mpi
@pytest.mark.parametrize("density", [850.0, 100.0])
def test_both_branches_of_a_free_top_are_found(tanks: Any, density: float) -> None:
    scene = layered(densities=(1000.0, density), top="free", tolerance=1e-9, modes=14)
    layers = TwoLayers(
        density_below=1000.0, density_above=density, depth_below=0.3, depth_above=0.2, gravity=GRAVITY, top="free"
    )
    assert {mode.branch for mode in tank_modes(layers, 1.0, 14)} == {"internal", "surface"}
    check(tanks, scene, exact(scene), 1e-9)


@pytest.mark.slow_but("True-*", "False-free")
@pytest.mark.slow_on_ranks_but("True-rigid")
@pytest.mark.mpi
@pytest.mark.parametrize("top", TOPS)
@pytest.mark.parametrize("hydrostatic", [True, False])
def test_a_guided_plate_on_the_interface_keeps_a_tolerance(tanks: Any, top: LayerTop, hydrostatic: bool) -> None:
    beam = interface_beam(**COVER, hydrostatic=hydrostatic)
    scene = layered(beam, top=top, tolerance=1e-9)
    plate = InterfacePlate(flexural_rigidity=50.0, mass_per_length=4.0, hydrostatic=hydrostatic)
    check(tanks, scene, exact(scene, plate), 1e-9)


@pytest.mark.slow_on_ranks_but
@pytest.mark.mpi
@pytest.mark.parametrize("hydrostatic", [True, False])
def test_a_cover_between_two_liquids_has_its_tone_above_the_waves(tanks: Any, hydrostatic: bool) -> None:
    """Far above the waves a free top has ψ = 0; liquids that a cover parts do not move as one."""
    scene = layered(interface_beam(**COVER, hydrostatic=hydrostatic), top="free", tolerance=1e-9)
    plate = InterfacePlate(flexural_rigidity=50.0, mass_per_length=4.0, hydrostatic=hydrostatic)
    (tone,) = tanks.solve(scene).tones
    released = exact(layered(top="pressure_release", modes=1), plate)[0]
    assert tanks.solve(scene).omega(tone.pressure_release) == pytest.approx(released, rel=1e-9)


@pytest.mark.parametrize("name", ROWS)
def test_a_beam_on_the_interface_has_the_public_reference(tanks: Any, name: str) -> None:
    row = ROWS[name]
    beams = (interface_beam(start=row["x0"], length=row["l"]),) if row["m"] else ()
    scene = layered(
        *beams,
        densities=(row["rho2"], row["rho1"]),
        depths=(row["h2_bottom"], row["h1_top"]),
        length=row["L"],
        tolerance=1e-9,
        modes=8,
    )
    expected = [row[f"w{number}"] for number in range(1, 9)]
    # Eight digits are printed, 2e-8 of the last place of 1.2657389 at the least; its two resolutions differ by 1.2e-8.
    assert tanks.solve(scene).reasons == ()
    assert tanks.omega(scene) == pytest.approx(expected, rel=4e-8)


THIN_AIR = {
    "waves": (),
    "beam": (interface_beam(start=0.2),),
    "circle": (rigid("ellipse", 0.4, "heave sway roll", half_width=0.1, half_height=0.1, centre_of_mass=-0.02),),
    "rectangle": (rigid("rectangle", 0.4, "heave sway roll", half_width=0.15, half_height=0.1),),
}


@pytest.mark.slow
@pytest.mark.parametrize("kind", THIN_AIR)
def test_a_lighter_and_lighter_upper_liquid_becomes_air(tanks: Any, kind: str) -> None:
    """ω is a smooth function of ρ₁ up to ρ₁ = 0; the least that is modelled is ρ₁ = 10⁻⁶ ρ₂."""

    def omega(*densities: float) -> np.ndarray:
        return tanks.omega(
            layered(*THIN_AIR[kind], densities=densities, top="free" if len(densities) == 1 else "rigid")
        )

    air = omega(1000.0)
    once, twice = omega(1000.0, 1e-3), omega(1000.0, 2e-3)
    # A liquid of 10⁻⁶ is felt by as much, 1e-6 … 4e-6.
    assert np.abs(once / air - 1.0).max() > 1e-7
    # What is left is of second order, 1e-11, beside errors that are alike on alike meshes but 1e-10 at corners.
    assert 2.0 * once - twice == pytest.approx(air, rel=1e-9)


@pytest.mark.slow_but("free-beam")
@pytest.mark.parametrize("kind", THIN_AIR)
@pytest.mark.parametrize("top", TOPS)
def test_an_upper_liquid_without_density_is_air(tanks: Any, kind: str, top: LayerTop) -> None:
    bodies = THIN_AIR[kind]
    with_air = tanks.omega(layered(*bodies, densities=(1000.0, 0.0), top=top))
    # The same matrices.
    assert with_air == pytest.approx(tanks.omega(layered(*bodies, densities=(1000.0,), top="free")), rel=1e-13)


TWO_BEAMS = layered(interface_beam(start=0.1, length=0.3), interface_beam(start=0.6, length=0.3), modes=8)
SYMMETRIC = {
    "waves": layered(modes=8),
    "beam": layered(interface_beam(), modes=8),
    "free top": layered(interface_beam(), top="free", modes=8),
    "pressure release": layered(interface_beam(), top="pressure_release", modes=8),
    "twins": TWO_BEAMS,
}


@pytest.mark.slow_on_ranks_but
@pytest.mark.slow_but("free top")
@pytest.mark.mpi
@pytest.mark.parametrize("kind", SYMMETRIC)
def test_halves_give_the_modes_of_the_whole_tank(tanks: Any, kind: str) -> None:
    halves, whole = (tanks.solve(SYMMETRIC[kind], halves=which) for which in (True, False))
    assert halves.field.half
    assert not whole.field.half
    assert halves.counted
    assert whole.counted
    found = np.array([[mode.eigenvalue for mode in solution.asked] for solution in (halves, whole)])
    # Two meshes: no nearer than their estimates, some 1e-9 for the asked 1e-8.
    allowed = halves.relative_errors[:8] + whole.relative_errors[:8]
    assert np.all(np.abs(np.sqrt(found[0] / found[1]) - 1.0) <= allowed)
    for one, other in zip(halves.asked, whole.asked, strict=True):
        assert one.energy == pytest.approx(other.energy, abs=1e-3)


@pytest.mark.slow
def test_the_mirror_image_has_the_same_frequencies(tanks: Any) -> None:
    left = layered(interface_beam(start=0.1, length=0.3), interface_beam(start=0.5, length=0.2))
    right = layered(interface_beam(start=0.3, length=0.2), interface_beam(start=0.6, length=0.3))
    assert tanks.omega(left) == pytest.approx(tanks.omega(right), rel=2e-8)


@pytest.mark.slow
@pytest.mark.parametrize(("size", "density"), [(1e-3, 1.0), (1e3, 1.0), (1.0, 10.0), (1e-3, 10.0)])
def test_metres_millimetres_and_heavier_liquids_give_the_same_digits(tanks: Any, size: float, density: float) -> None:
    """ω²L/g is a function of ratios of densities, of lengths, of EI/ρgL⁴ and m/ρL."""
    beam = interface_beam(
        start=0.2 * size,
        length=0.4 * size,
        flexural_rigidity=50.0 * density * size**4,
        mass_per_length=4.0 * density * size,
    )
    scaled = layered(
        beam, densities=(1000.0 * density, 850.0 * density), depths=(0.3 * size, 0.2 * size), length=size, top="free"
    )
    plain = layered(interface_beam(start=0.2), top="free")
    # Rounding of the input may move the nodes of the mesh by its last digits.
    assert tanks.omega(scaled) * np.sqrt(size) == pytest.approx(tanks.omega(plain), rel=1e-10)


@pytest.mark.slow_but("rigid")
@pytest.mark.slow_on_ranks_but("rigid")
@pytest.mark.mpi
@pytest.mark.parametrize(
    ("top", "constraints", "loose"), [("rigid", 1, 1), ("free", 2, 0), ("pressure_release", 1, 0)], ids=TOPS
)
def test_one_volume_follows_from_the_other_in_a_closed_tank(
    tanks: Any, top: LayerTop, constraints: int, loose: int
) -> None:
    """What enters the lower liquid through the interface leaves the upper one, which can give it to a free top."""
    float_ = rigid("ellipse", 0.6, half_width=0.1, half_height=0.1)
    for bodies in ((), (interface_beam(),), (float_,)):
        (pencil,) = pencils(layered(*bodies, top=top))
        assert len(pencil.constraints) == constraints
        assert pencil.laplace.comm.tompi4py().allreduce(len(pencil.free_constants)) == loose


@pytest.mark.slow_but("free")
@pytest.mark.slow_on_ranks_but("free")
@pytest.mark.mpi
@pytest.mark.parametrize("top", TOPS)
def test_each_liquid_keeps_its_volume(top: LayerTop) -> None:
    bodies = (interface_beam(start=0.1, length=0.3), rigid("ellipse", 0.7, half_width=0.1, half_height=0.1))
    (pencil,) = pencils(layered(*bodies, top=top))
    ones, taken = pencil.coupling.createVecLeft(), pencil.coupling.createVecRight()
    for mode in solve_modes(pencil, 6).modes:
        for layer in (0, 1):
            ones.array[:] = pencil.liquid.owned_layer_of == layer
            pencil.coupling.multTranspose(ones, taken)
            moved = taken.dot(mode.displacement)
            size = mode.displacement.norm(PETSc.NormType.NORM_INFINITY)
            if top == "pressure_release" and layer == 1:
                continue  # ψ = 0 on its top, through which it gives way
            # Against ∫|ζ| of about |ζ|·1; the projection rounds to 1e-13.
            assert abs(moved) <= 1e-11 * size


LOADED = {
    "waves": (),
    "beam": (interface_beam(),),
    "loose beam": (interface_beam(hydrostatic=False),),
    "float": (rigid("rectangle", 0.4, "heave sway roll", half_width=0.15, half_height=0.1),),
    "slit": (rigid("parabola", 0.4, half_width=0.01, half_height=0.1, boundary="thin"),),
    "beam on top": (interface_beam(at="surface"), rigid("ellipse", 0.6, half_width=0.05, half_height=0.1)),
}


@pytest.mark.slow_but("loose beam-rigid", "slit-free", "float-pressure_release")
@pytest.mark.slow_on_ranks_but("slit-free")
@pytest.mark.mpi
@pytest.mark.parametrize("top", TOPS)
@pytest.mark.parametrize("kind", LOADED)
def test_between_two_modes_the_inertia_counts_those_below(top: LayerTop, kind: str) -> None:
    (pencil,) = pencils(layered(*LOADED[kind], top=top))
    values = solve_modes(pencil, 7, shapes=0).eigenvalues
    assert count_below(pencil, 0.5 * values[0]) == 0
    for number, (lower, upper) in enumerate(pairwise(values), 1):
        assert count_below(pencil, float(np.sqrt(lower * upper))) == number


@pytest.mark.slow_but("waves-pressure_release", "beam-rigid", "loose beam-free", "float-free", "slit-pressure_release")
@pytest.mark.parametrize("top", TOPS)
@pytest.mark.parametrize("kind", LOADED)
def test_modes_are_those_of_the_full_matrices(top: LayerTop, kind: str) -> None:
    """Constraints, constants of ψ and condensed motions against a basis of all motions that keep the volumes."""
    (pencil,) = pencils(layered(*LOADED[kind], top=top))
    modes = solve_modes(pencil, 8, shapes=0)
    values = PlainProblem(pencil).eigenvalues(8 + modes.zero_modes)
    # Rounding: of λ + 1 some 1e-13, where the lowest λ is 0.02.
    assert np.abs(values[: modes.zero_modes]).max(initial=0.0) <= 1e-11
    assert values[modes.zero_modes :] == pytest.approx(modes.eigenvalues, rel=1e-9)


SLIT = layered(rigid("parabola", 0.4, half_width=0.01, half_height=0.1, boundary="thin"))


@pytest.mark.mpi
def test_unknowns_of_the_two_sides_of_a_slit_are_told_apart() -> None:
    """Where a slit crosses the interface there are two unknowns at one point, left and right, below and above each.

    A wrong pairing couples η of one side of the slit with ψ of the other: C of a node then has a wider reach.
    """
    (pencil,) = pencils(SLIT)
    body = pencil.body_size if pencil.stiffness.comm.rank == 0 else 0
    points = pencil.liquid.unknown_positions()
    dofs = pencil.liquid.surface_dofs(("interface",), 0)
    # Positions are sums of products, rounded as the linear algebra at hand does it.
    at_slit = np.flatnonzero(np.all(np.abs(points[dofs] - [0.4, 0.0]) < 1e-12, axis=1))
    comm = pencil.liquid.tank.mesh.comm
    assert comm.allreduce(len(at_slit)) == 2
    unit, load = pencil.stiffness.createVecRight(), pencil.coupling.createVecLeft()
    from_slit = points[:, 0] - 0.4
    starts = np.array(comm.allgather(unit.getOwnershipRange()[0] + body))
    for rank in range(comm.size):
        for node in comm.bcast(at_slit, root=rank):
            unit.set(0.0)
            unit.setValue(int(starts[rank] + node), 1.0)
            unit.assemble()
            pencil.coupling.mult(unit, load)
            # ∫φ(x − 0.4) of one side has the sign of the side: the same part goes in below and out above.
            sides = [
                comm.allreduce(float(load.array_r[chosen] @ from_slit[chosen]))
                for chosen in (pencil.liquid.owned_layer_of == layer for layer in (0, 1))
            ]
            assert sides[0] != 0.0
            assert sides[1] == pytest.approx(-sides[0], rel=1e-12)


@pytest.mark.slow
def test_a_slit_beside_the_tip_of_a_beam_is_paired_too(tanks: Any) -> None:
    """A thin float that touches nothing else: the two halves of a tank with the slit in the middle, and the whole."""
    scene = layered(rigid("parabola", 0.5, half_width=0.01, half_height=0.1, boundary="thin"), modes=7)
    halves, whole = (
        frequencies(np.array([mode.eigenvalue for mode in tanks.solve(scene, halves=which).asked]), scene)
        for which in (True, False)
    )
    assert halves == pytest.approx(whole, rel=1e-8)


def test_momentum_is_the_coupling_times_the_density() -> None:
    (pencil,) = pencils(layered(rigid("ellipse", 0.6, half_width=0.1, half_height=0.1)))
    densities = np.array([layer.density for layer in pencil.liquid.layers])[pencil.liquid.owned_layer_of]
    assert isclose(densities.min(), 0.85)
    assert isclose(densities.max(), 1.0)
    assert np.array_equal(sparse(pencil.momentum).toarray(), densities[:, None] * sparse(pencil.coupling).toarray())


@pytest.mark.slow_on_ranks_but("free")
@pytest.mark.only_on_ranks
@pytest.mark.mpi
@pytest.mark.parametrize("top", TOPS)
def test_two_processes_find_what_one_finds(top: LayerTop) -> None:
    beams = (interface_beam(start=0.1, length=0.2), interface_beam(start=0.2, length=0.3, at="surface"))
    check_processes(layered(*beams[: 1 if top == "rigid" else 2], top=top))


def test_the_flux_of_an_elevation_is_that_of_the_surface_in_both_liquids() -> None:
    (pencil,) = pencils(layered(interface_beam(start=0.2), top="free"))
    liquid, names = pencil.liquid, ("body_1", "interface", "free_surface")
    of_bodies = tuple(loads_with_fluxes(liquid, (body,))[0][-1] for body in pencil.bodies)
    fluxes = surface_fluxes(liquid, liquid_matrices(liquid, pencil.surfaces), pencil.surfaces, of_bodies)
    assert fluxes == pytest.approx(surface_load(liquid, names), abs=1e-15)


def test_the_flux_of_a_float_is_that_of_its_contour() -> None:
    (pencil,) = pencils(layered(rigid("ellipse", 0.6, half_width=0.1, half_height=0.1)))
    (body,) = pencil.bodies
    ((*_, flux),) = loads_with_fluxes(pencil.liquid, (body,))
    # The measure of a curved facet is no polynomial: measured 1.9e-9 between the two quadratures, of at most 0.017.
    assert flux == pytest.approx(surface_load(pencil.liquid, (body.surface,)), abs=5e-9)
