"""Strips in boxes, discs and rings in cylinders, and waves alone, against references and closed forms."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from math import inf, pi, tanh

import numpy as np
import pytest
from level_tanks import CASES, SEPARATED, reference_tank, solved

from hydroelastic.fem.added_mass import body_added_mass
from hydroelastic.fem.level_bed.orders import lower_bound, order_problem, plate_line, solve_order, solve_orders
from hydroelastic.fem.level_bed.plate_tone import plate_tone
from hydroelastic.fem.level_bed.resolution import line_resolution
from hydroelastic.fem.level_bed.separation import separated
from hydroelastic.fem.level_bed.solve import solve_level_tank
from hydroelastic.modal.plate.closed_forms import exact_frequencies
from hydroelastic.modal.plate.estimates import plate_estimates
from hydroelastic.modal.plate.line_modes import lowest_dry
from hydroelastic.physics.level_tank import Box, Cylinder, LevelTank
from hydroelastic.physics.plate import Disc, Plate, Strip
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.tank.solve import solve_scene


def errors(name: str, tolerance: float) -> np.ndarray:
    """ω/ω_reference − 1 of the twelve lowest modes."""
    solution = solved(name, tolerance)
    omega = [solution.omega(one.mode.eigenvalue) for one in solution.modes]
    return np.array(omega) / CASES[name]["omega"] - 1.0


@pytest.mark.slow_but("annulus_s0", "disc_base_s0", "disc_full_s0", "disc_rigid_s0", "strip_at_wall", "strip_slats_s1")
@pytest.mark.mpi
@pytest.mark.slow_on_ranks_but("disc_base_s0")
@pytest.mark.parametrize("name", SEPARATED)
def test_frequencies_keep_the_tolerance_and_its_estimate(name: str) -> None:
    found, estimates = errors(name, 1e-6), np.array([one.relative_error for one in solved(name, 1e-6).modes])
    assert solved(name, 1e-6).reasons == ()
    assert np.abs(found).max() <= 1e-6
    # The references have 9 digits at least, and 11 of strips; below that nothing can be told.
    known = np.abs(found) > 10.0 ** (2 - CASES[name]["digits"])
    ratio = estimates[known] / np.abs(found[known])
    assert np.all((ratio >= 1.0) & (ratio <= 30.0))
    # Ritz values come from above, but for the reference's own digits.
    assert found.min() >= -(10.0 ** (1 - CASES[name]["digits"]))


@pytest.mark.slow_but("disc_heavy_s1", "strip_shallow", "strip_slats_s1")
@pytest.mark.parametrize("name", SEPARATED)
def test_frequencies_keep_a_narrow_tolerance(name: str) -> None:
    tank = reference_tank(name).scaled()
    separation = separated(tank)
    assert separation is not None
    highest = (CASES[name]["omega"][11] / reference_tank(name).units.frequency) ** 2
    orders = solve_orders(tank, separation, line_resolution(tank, separation, 1e-10, highest), 12)
    values = np.sort(np.concatenate([one.modes.eigenvalues for one in orders]))[:12]
    omega = np.sqrt(values) * reference_tank(name).units.frequency
    # Measured: 6e-12, below the digits of the references of discs.
    assert np.abs(omega / CASES[name]["omega"] - 1.0).max() < 5e-11


def test_orders_and_pairs_are_those_of_the_reference() -> None:
    for name in ("annulus_s0", "strip_at_wall"):
        modes = solved(name, 1e-6).modes
        assert [f"n{one.problem.order}" for one in modes] == CASES[name]["label"]
        assert [one.problem.multiplicity for one in modes] == CASES[name]["multiplicity"]


@pytest.mark.parametrize("name", ["slosh_box", "slosh_cylinder", "cover_box_s0"])
def test_closed_forms_are_met(name: str) -> None:
    # Rounding: 1e-12 measured at most.
    assert np.abs(errors(name, 1e-8)).max() < 1e-11
    exact = [one.omega for one in exact_frequencies(reference_tank(name), 12)]
    assert exact == pytest.approx(CASES[name]["omega"], rel=1e-13)


def test_a_covered_cylinder_is_closed_for_order_zero() -> None:
    solution = solve_level_tank(reference_tank("cover_cylinder_s0"), tolerance=1e-8, modes=12)
    found = [solution.omega(one.mode.eigenvalue) for one in solution.modes if one.problem.order == 0]
    assert found == pytest.approx(CASES["cover_cylinder_s0"]["omega"][: len(found)], rel=1e-10)
    assert len(found) >= 2


@pytest.mark.slow_but("False")
@pytest.mark.parametrize("slats", [False, True])
def test_a_strip_without_cross_waves_is_the_beam_of_the_section(slats: bool) -> None:
    stiffness, mass = 5e3, 50.0
    strip = Strip(start=3.0, length=4.0, width=0.5)
    plate = Plate(outline=strip, flexural_rigidity=stiffness, mass_per_area=mass, slats=slats)
    tank = LevelTank(plan=Box(length=10.0, width=0.5), depth=5.0, density=1000.0, gravity=9.81, plates=(plate,))
    beam = {"start": 3.0, "length": 4.0, "flexural_rigidity": stiffness, "mass_per_length": mass}
    section = TankScene(
        tank={"length": 10.0},
        liquid=[{"density": 1000.0, "depth": 5.0}],
        body=[beam],
        accuracy={"tolerance": 1e-10, "modes": 4},
    )
    two = solve_scene(section)
    scaled, separation = tank.scaled(), separated(tank.scaled())
    assert separation is not None
    (order, *_) = solve_orders(scaled, separation, line_resolution(scaled, separation, 1e-10, 10.0), 4)
    sections = [two.omega(mode.eigenvalue) for mode in two.asked]
    strips = np.sqrt(order.modes.eigenvalues[:4]) * tank.units.frequency
    # Two discretizations with nothing in common but the eigenproblem: 1e-10, the tolerance of the section.
    assert strips == pytest.approx(sections, rel=1e-10)


def test_the_search_over_orders_finds_a_rigid_plate_s_pitch_below_its_heave() -> None:
    """λ = 0.46 of order 1 is below 0.58 of order 0, and that below the waves of order 1, k tanh kH ≥ tanh 1 = 0.76."""
    plate = Plate(outline=Disc(radius=0.5), flexural_rigidity=inf, mass_per_area=2.0)
    tank = LevelTank(plan=Cylinder(radius=1.0), depth=1.0, density=1.0, gravity=1.0, plates=(plate,))
    (heave, *_), (pitch, *_) = (solve_orders_of(tank, 1, order) for order in (0, 1))
    assert pitch < heave < tanh(1.0)
    assert solve_orders_of(tank, 1) == pytest.approx([pitch], rel=1e-12)


@pytest.mark.parametrize("hydrostatic", [False, True])
def test_slats_have_no_mode_below_the_bound_of_an_order(hydrostatic: bool) -> None:
    """Without hydrostatic restoring heave and pitch of each slat have no stiffness, in each order."""
    strip = Strip(start=0.3, length=0.4, width=0.4)
    plate = Plate(outline=strip, flexural_rigidity=5e-5, mass_per_area=5e-3, slats=True, hydrostatic=hydrostatic)
    tank = LevelTank(plan=Box(length=1.0, width=0.4), depth=0.5, density=1.0, gravity=1.0, plates=(plate,))
    separation = separated(tank)
    assert separation is not None
    bounds = [lower_bound(tank, separation, order) for order in range(2, 6)]
    lowest = [solve_orders_of(tank, 1, order)[0] for order in range(2, 6)]
    assert np.all(np.diff(bounds) > 0.0)
    # Measured: 0.71 to 0.92.
    assert all(0.6 * value < bound <= value for bound, value in zip(bounds, lowest, strict=True))


@pytest.mark.parametrize(("order", "limit"), [(0, 4.0 / 3.0), (1, 8.0 / 45.0)])
def test_added_mass_of_a_rigid_disc_on_deep_wide_water_is_lamb_s(order: int, limit: float) -> None:
    """Heave 4/3 ρa³ and pitch 8/45 ρa⁵ with ψ = 0 beside the disc."""
    a = 0.02
    plate = Plate(outline=Disc(radius=a), flexural_rigidity=inf, mass_per_area=0.0)
    tank = LevelTank(plan=Cylinder(radius=1.0), depth=1.0, density=1.0, gravity=1.0, plates=(plate,))
    separation = separated(tank)
    assert separation is not None
    resolution = line_resolution(tank, separation, 1e-5, 1.0, exponent=0.5)
    problem = order_problem(tank, separation, resolution, order, pressure_release=True)
    assert problem is not None
    pencil, shapes = problem
    # Shapes have unit mean square with weight r: ∫W² r dr = 1.
    amplitude = shapes[0].values(np.array([a]))[0, 0] / (1.0 if order == 0 else a)
    added = body_added_mass(pencil)[0, 0] / amplitude**2
    # The walls change heave by about (a/R)³, measured 2e-5; the discretization 1e-5.
    assert added / a ** (3 + 2 * order) == pytest.approx(limit, rel=1e-4)


@pytest.mark.parametrize(("order", "motion", "name"), [(0, "heave", "rigid_heave"), (1, "pitch", "rigid_pitch")])
def test_a_rigid_strip_or_disc_on_deep_wide_water_has_the_estimated_frequency(
    order: int, motion: str, name: str
) -> None:
    """With ψ = 0 beside them; of a strip both motions are of order 0."""
    disc, strip = Disc(radius=0.02), Strip(start=0.49, length=0.02, width=0.1)
    for outline, plan in ((disc, Cylinder(radius=1.0)), (strip, Box(length=1.0, width=0.1))):
        plate = Plate(outline=outline, flexural_rigidity=inf, mass_per_area=1e-3)
        tank = LevelTank(plan=plan, depth=1.0, density=1.0, gravity=1.0, top="pressure_release", plates=(plate,))
        (estimate,) = [one for one in plate_estimates(tank) if one.name == name]
        separation = separated(tank)
        assert separation is not None
        resolution = line_resolution(tank, separation, 1e-5, 100.0, exponent=0.5)
        solved_order = solve_order(tank, separation, resolution, order if outline is disc else 0, 2)
        assert solved_order is not None
        assert estimate.motion == motion
        # Walls and bed change the added mass by about (a/R)³ of a disc and (l/L)² of a strip, 4e-4 at most.
        distances = np.abs(np.sqrt(solved_order.modes.eigenvalues) / estimate.omega - 1.0)
        assert distances.min() < 2e-4


@pytest.mark.parametrize("name", ["disc_heavy_s1", "strip_base_s1"])
def test_rayleigh_s_estimate_is_the_quotient_of_the_field_with_level_water(name: str) -> None:
    tank = reference_tank(name)
    (estimate,) = [one for one in plate_estimates(tank) if one.name == "rayleigh_lid"]
    scaled, separation = tank.scaled(), separated(tank.scaled())
    assert separation is not None
    order, _ = lowest_dry(partial(plate_line, scaled, separation, 0))
    problem = order_problem(scaled, separation, line_resolution(scaled, separation, 1e-5, 5.0), order)
    assert problem is not None
    pencil, shapes = problem
    (body,) = pencil.bodies
    first = shapes[0].rigid
    added = body_added_mass(pencil)[first, first]
    quotient = body.stiffness[first] / (body.mass[first, first] + added)
    # 400 standing waves leave about 1e-5 of the added mass.
    assert estimate.omega == pytest.approx(np.sqrt(quotient) * tank.units.frequency, rel=2e-5)


def test_frequencies_do_not_depend_on_units() -> None:
    tank = reference_tank("disc_base_s0")
    (plate,) = tank.plates
    small = replace(
        tank,
        plan=Cylinder(radius=5e-3),
        depth=3e-3,
        plates=(replace(plate, outline=Disc(radius=2e-3), mass_per_area=0.05, flexural_rigidity=5e3 * 1e-12),),
    )
    solution = solve_level_tank(small, tolerance=1e-6, modes=6)
    found = [one.mode.eigenvalue for one in solution.modes]
    assert found == pytest.approx([one.mode.eigenvalue for one in solved("disc_base_s0", 1e-6).modes[:6]], rel=1e-12)


def test_two_concentric_plates_and_an_inner_cylinder_are_solved() -> None:
    """Plates that are as one with water: D and m that vanish leave waves, whose modes are those of the ring."""
    outlines = [Disc(radius=3.0, inner_radius=2.0), Disc(radius=4.5, inner_radius=3.5)]
    plates = tuple(Plate(outline=outline, flexural_rigidity=1e-6, mass_per_area=0.0) for outline in outlines)
    plan = Cylinder(radius=5.0, inner_radius=1.0)
    bare = LevelTank(plan=plan, depth=3.0, density=1000.0, gravity=9.81)
    waves = solve_level_tank(bare, tolerance=1e-8, modes=3)
    soft = solve_orders_of(replace(bare, plates=plates), 3)
    # A plate without stiffness and mass is water, but its bending of D/(ρgL⁴) = 2e-13 is not none.
    assert soft == pytest.approx([one.mode.eigenvalue for one in waves.modes], rel=1e-6)


def solve_orders_of(tank: LevelTank, count: int, order: int | None = None) -> np.ndarray:
    """The lowest λ of all orders, or of one."""
    scaled, separation = tank.scaled(), separated(tank.scaled())
    assert separation is not None
    resolution = line_resolution(scaled, separation, 1e-5, 4.0)
    if order is None:
        orders = solve_orders(scaled, separation, resolution, count)
    else:
        orders = tuple(filter(None, [solve_order(scaled, separation, resolution, order, count)]))
    return np.sort(np.concatenate([one.modes.eigenvalues for one in orders]))[:count]


def test_pressure_release_tone_is_the_limit_of_thin_layers() -> None:
    tank = reference_tank("disc_base_s0").scaled()
    separation = separated(tank)
    assert separation is not None
    coarse, fine = (plate_tone(tank, separation, 0, tolerance) for tolerance in (1e-4, 1e-8))
    assert coarse.pressure_release_error is not None
    assert fine.pressure_release_error is not None
    # Without the limit three refinements leave 1e-6.
    assert fine.pressure_release_error < 1e-8
    assert coarse.pressure_release == pytest.approx(fine.pressure_release, rel=2.0 * coarse.pressure_release_error)


HARD = {
    "shallow": {"depth": 0.05},
    "deep": {"depth": 50.0},
    "soft": {"flexural_rigidity": 1.0},
    "stiff": {"flexural_rigidity": 1e9},
    "narrow ring": {"outline": Disc(radius=4.9, inner_radius=4.8)},
    "small hole": {"outline": Disc(radius=4.0, inner_radius=0.05)},
    "nearly covered": {"outline": Disc(radius=4.999)},
    "clamped": {"outline": Disc(radius=5.0), "edge": "clamped"},
    "hinged": {"outline": Disc(radius=5.0), "edge": "hinged"},
}


@pytest.mark.slow_but("clamped")
@pytest.mark.parametrize("case", HARD)
def test_hard_tanks_keep_their_tolerance(case: str) -> None:
    base = reference_tank("disc_base_s0")
    changes = dict(HARD[case])
    depth = changes.pop("depth", base.depth)
    tank = replace(base, depth=depth, plates=(replace(base.plates[0], **changes),))
    solution = solve_level_tank(tank, tolerance=1e-5, modes=8)
    assert solution.reasons == ()
    finer = solve_level_tank(tank, tolerance=1e-8, modes=8)
    found, exact = ([one.mode.eigenvalue for one in each.modes] for each in (solution, finer))
    assert found == pytest.approx(exact, rel=2e-5)


def test_potential_below_the_surface_is_harmonic() -> None:
    solution = solved("disc_base_s0", 1e-6)
    (one,) = [one for one in solution.modes if one.problem.order == 1][:1]
    x, y, z, step = 0.3, 0.1, -0.2, 1e-2
    moves = [(0, 0, 0), (1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    values = [
        float(
            one.problem.sampled(one.mode, np.array([x + i * step]), np.array([y + j * step]), second=False).potential(
                z + k * step, solution.tank.depth
            )[0]
        )
        for i, j, k in moves
    ]
    laplacian = (sum(values[1:]) - 6.0 * values[0]) / step**2
    # Central differences leave step²/12 times fourth derivatives, of k⁴ψ with k up to 3.
    assert abs(laplacian) < 1e-2 * abs(values[0]) * pi**2
