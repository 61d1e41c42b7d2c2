"""Plans of triangles, the depth by its poles: references, closed forms, other models of the same tank, and ranks."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from mpi4py import MPI
from plan_tanks import CASES, WATER, frequencies, reference_tank

from hydroelastic.fem.level_bed.choice import NotTreatedError, level_model
from hydroelastic.fem.plan import plan
from hydroelastic.fem.plan.plan import PlanSolution, solve_plan
from hydroelastic.fem.plan.solve import solve_smallest_model
from hydroelastic.physics.level_tank import Box, Cylinder, LevelTank, PolygonPlan
from hydroelastic.physics.plate import Disc, Plate, Polygon, Rectangle, Strip

OUTLINES = [
    "rectangle_base_s0",
    "rectangle_soft_s1",
    "rectangle_rigid_s1",
    "disc_base_s0",
    "disc_rigid_s0",
    "disc_shallow_s1",
    "disc_full_s0",
    "annulus_s0",
    "rectangle_full_s0",
]


@cache
def _solved(tank: LevelTank, tolerance: float, count: int, alone: bool = False) -> tuple[PlanSolution, np.ndarray]:
    comm = MPI.COMM_SELF if alone else MPI.COMM_WORLD
    solution = solve_plan(tank.scaled(), tolerance=tolerance, count=count, comm=comm)
    return solution, np.sqrt(solution.modes.eigenvalues[:count]) * tank.units.frequency


def _assert_kept(name: str, tolerance: float, count: int) -> None:
    tank, exact = reference_tank(name), frequencies(name)[:count]
    certain = 10.0 ** -CASES[name].get("digits", 12)
    solution, omega = _solved(tank, tolerance, count)
    errors = omega / exact - 1.0
    assert solution.counted
    assert errors.max() < tolerance
    # From above: the poles do not exceed the depth's response. References have their own digits.
    assert errors.min() > -certain
    # Measured 1.2 to 15.
    assert 1.0 <= solution.relative_errors[:count].max() / errors.max() < 30.0


@pytest.mark.slow_but("rectangle_base_s0", "disc_full_s0", "disc_rigid_s0")
@pytest.mark.parametrize("name", OUTLINES)
def test_outlines_keep_a_tolerance_of_1e_4(name: str) -> None:
    # The low modes of a soft plate and of water alone are far better than their estimates.
    if name == "rectangle_soft_s1":
        solution, omega = _solved(reference_tank(name), 1e-4, 12)
        errors = np.abs(omega / frequencies(name)[:12] - 1.0)
        assert np.all(errors < solution.relative_errors[:12])
    else:
        _assert_kept(name, 1e-4, 12)


@pytest.mark.slow
@pytest.mark.parametrize("name", OUTLINES)
def test_outlines_keep_a_tolerance_of_1e_6(name: str) -> None:
    _assert_kept(name, 1e-6, 12)


@pytest.mark.slow_but("slosh_triangle")
@pytest.mark.parametrize("name", ["slosh_triangle", "slosh_cylinder"])
def test_sloshing_has_its_closed_form(name: str) -> None:
    solution, omega = _solved(reference_tank(name), 1e-6, 9)
    exact = frequencies(name)[:9]
    # Double frequencies are found twice; smooth ψ is better than the tolerance: measured 2e-9.
    assert omega == pytest.approx(exact, rel=1e-8)
    assert np.all(np.abs(omega / exact - 1.0) < solution.relative_errors[:9])


def test_a_basin_with_a_reentrant_corner_has_the_known_wavenumber() -> None:
    corners = ((0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0))
    tank = LevelTank(plan=PolygonPlan(points=corners), depth=0.5, **WATER)
    solution, omega = _solved(tank, 1e-5, 3)
    # Lowest Neumann eigenvalue of the L-shaped domain, Dauge's benchmark of Maxwell eigenvalues, 11 digits.
    k = np.sqrt(1.47562182408)
    error = omega[0] / np.sqrt(9.81 * k * np.tanh(0.5 * k)) - 1.0
    assert 0.0 < error < solution.relative_errors[0] < 1e-5


def test_a_rectangle_is_a_polygon_and_the_poles_are_the_depth() -> None:
    tank = reference_tank("rectangle_base_s0")
    corners = ((3.0, 2.5), (7.0, 2.5), (7.0, 5.5), (3.0, 5.5))
    polygon = replace(tank, plates=(replace(tank.plates[0], outline=Polygon(points=corners)),))
    assert level_model(tank) == "box"
    assert level_model(polygon) == "plan"
    found = solve_smallest_model(polygon, tolerance=1e-4, modes=8)
    omega = np.array([found.omega(one.mode.eigenvalue) for one in found.modes])
    assert not found.reasons
    errors = np.abs(omega / frequencies("rectangle_base_s0")[:8] - 1.0)
    assert np.all(errors < [one.relative_error for one in found.modes])


@pytest.mark.slow
def test_a_disc_beside_the_axis_approaches_the_one_on_it() -> None:
    tank = reference_tank("disc_heavy_s1")
    moved = replace(tank, plates=(replace(tank.plates[0], outline=Disc(radius=2.0, position=(1e-6, 0.0))),))
    assert level_model(tank) == "orders"
    assert level_model(moved) == "plan"
    _, omega = _solved(moved, 1e-3, 4)
    assert omega == pytest.approx(frequencies("disc_heavy_s1")[:4], rel=1e-3)
    # Moved by a third of the gap the modes are others: the position is used.
    away = replace(tank, plates=(replace(tank.plates[0], outline=Disc(radius=2.0, position=(1.0, 0.0))),))
    _, far = _solved(away, 1e-3, 4)
    assert np.abs(far / omega - 1.0).max() > 3e-3


@pytest.mark.slow_but("box")
@pytest.mark.parametrize("count", [1, 2], ids=["box", "plan"])
def test_elevations_of_the_water_are_those_of_its_potential(count: int) -> None:
    plates = (
        Plate(outline=Rectangle(position=(2.5, 3.0), size=(3.0, 2.0)), flexural_rigidity=5e3, mass_per_area=50.0),
        Plate(outline=Disc(position=(7.0, 3.2), radius=1.2), flexural_rigidity=1e4, mass_per_area=80.0),
    )
    tank = LevelTank(plan=Box(length=10.0, width=6.0), depth=2.0, plates=plates[:count], **WATER)
    solution = solve_smallest_model(tank, tolerance=1e-3, modes=3)
    # The third place is under no plate, the second one under the rectangle.
    x, y = np.array([0.52, 0.25, 0.05]), np.array([0.30, 0.34, 0.55])
    for one in solution.modes:
        sampled = one.problem.sampled(one.mode, x, y, second=False)
        pressure = one.mode.eigenvalue * sampled.potential(0.0, solution.tank.depth)
        # Standing waves of less than 1e-7 of the largest one are left out.
        assert sampled.elevation[[0, 2]] == pytest.approx(pressure[[0, 2]], rel=1e-5, abs=1e-5)
        assert abs(sampled.elevation[1] / pressure[1] - 1.0) > 1e-4
        # ψ_z = 0 on the bed.
        step = 1e-3 * solution.tank.depth
        values = [sampled.potential(z - solution.tank.depth, solution.tank.depth) for z in (0.0, step)]
        assert values[1] == pytest.approx(values[0], rel=1e-4, abs=1e-6)


@pytest.mark.parametrize(
    ("plates", "word"),
    [
        (((Strip(start=1.0, length=2.0, width=6.0)), Disc(position=(7.0, 3.0), radius=1.0)), "strip"),
        ((Polygon(points=((0.0, 0.0), (2.0, 0.0), (1.0, 1.0))),), "touches a wall"),
    ],
)
def test_what_no_model_takes_is_refused_in_words(plates: tuple[Strip | Disc | Polygon, ...], word: str) -> None:
    bodies = tuple(Plate(outline=outline, flexural_rigidity=1e4, mass_per_area=10.0) for outline in plates)
    tank = LevelTank(plan=Box(length=10.0, width=6.0), depth=2.0, plates=bodies, **WATER)
    with pytest.raises(NotTreatedError, match=word):
        level_model(tank)


@pytest.mark.only_on_ranks
@pytest.mark.mpi
def test_processes_share_the_poles() -> None:
    plate = Plate(outline=Disc(radius=0.8, position=(0.4, 0.2)), flexural_rigidity=200.0, mass_per_area=10.0)
    tank = LevelTank(plan=Cylinder(radius=2.0), depth=1.0, plates=(plate,), **WATER)
    shared, together = _solved(tank, 1e-3, 5)
    _, alone = _solved(tank, 1e-3, 5, True)
    # The order of the sum over the poles alone differs.
    assert together == pytest.approx(alone, rel=1e-11)
    solver = shared.modes.classes[0].pencil.solver
    assert len(solver._solvers) <= -(-len(shared.poles.shifts) // MPI.COMM_WORLD.size)  # type: ignore[attr-defined]


@pytest.mark.slow
def test_two_refinements_of_a_tank_with_two_plates_agree() -> None:
    plates = (
        Plate(outline=Rectangle(position=(2.5, 3.0), size=(3.0, 2.0)), flexural_rigidity=5e3, mass_per_area=50.0),
        Plate(outline=Disc(position=(7.0, 3.2), radius=1.2), flexural_rigidity=1e4, mass_per_area=80.0),
    )
    tank = LevelTank(plan=Box(length=10.0, width=6.0), depth=2.0, plates=plates, **WATER)
    coarse, first = _solved(tank, 1e-4, 8)
    _, second = _solved(tank, 1e-7, 8)
    assert np.all(np.abs(first / second - 1.0) < coarse.relative_errors[:8] + 1e-7)


@pytest.mark.parametrize("inner", [0.0, 0.3])
def test_shapes_of_a_disc_lie_about_its_centre(inner: float) -> None:
    from hydroelastic.fem.plan.plates import plan_plate

    outline = Disc(radius=0.8, inner_radius=inner, position=(2.0, -1.0))
    plate = Plate(outline=outline, flexural_rigidity=1e3, mass_per_area=7.0)
    body = plan_plate(LevelTank(plan=Cylinder(radius=5.0), depth=1.0, plates=(plate,), **WATER), 0, 8, (None, None))
    points, weights = np.polynomial.legendre.leggauss(24)
    radius = inner + 0.5 * (0.8 - inner) * (1.0 + points)
    angle = 2.0 * np.pi * np.arange(40) / 40.0
    places = np.array([2.0 + np.outer(radius, np.cos(angle)).ravel(), -1.0 + np.outer(radius, np.sin(angle)).ravel()])
    measure = np.outer(0.5 * (0.8 - inner) * weights * radius, np.full(40, np.pi / 20.0)).ravel()
    shapes = body.deflection(places)
    mass = body.body.mass
    # Products of polynomials and trigonometric functions are integrated exactly.
    assert 7.0 * (shapes * measure) @ shapes.T == pytest.approx(mass, abs=1e-9 * np.abs(mass).max())
    names = list(body.body.dofs)
    for name, wanted in (("heave", np.ones(960)), ("pitch", (places[0] - 2.0) / 0.8), ("roll", places[1] + 1.0)):
        assert shapes[names.index(name)] == pytest.approx(wanted, abs=1e-10)


def test_parts_of_a_plan_have_the_modes_of_the_whole(monkeypatch: pytest.MonkeyPatch) -> None:
    corners = ((-1.0, 0.0), (0.0, -0.8), (1.0, 0.0), (0.0, 0.8))
    plate = Plate(outline=Polygon(points=corners), flexural_rigidity=300.0, mass_per_area=20.0)
    tank = LevelTank(plan=Cylinder(radius=2.0), depth=1.0, plates=(plate,), **WATER)
    parts, omega = _solved(tank, 1e-3, 8)
    assert len(parts.modes.classes) == 4
    monkeypatch.setattr(plan, "mirrors_of", lambda _wall, _plates: (None, None))
    whole = solve_plan(tank.scaled(), tolerance=1e-3, count=8)
    monkeypatch.undo()
    expected = np.sqrt(whole.modes.eigenvalues[:8]) * tank.units.frequency
    assert np.all(np.abs(omega / expected - 1.0) < parts.relative_errors[:8] + whole.relative_errors[:8])
    # Energies are those of the whole tank, and a mode has the parity of its class on all of it.
    assert parts.modes.completed(0).energy.sum() == pytest.approx(1.0)
    found = solve_smallest_model(tank, tolerance=1e-3, modes=4, tones=False)
    x, y = np.array([0.3, -0.3, 0.7, -0.7]), np.array([0.1, 0.1, -0.3, -0.3])
    for one in found.modes:
        sampled = one.problem.sampled(one.mode, x, y, second=False)
        sign = -1.0 if "xA" in one.problem.symmetry else 1.0
        for values in (sampled.elevation, sampled.potential(-0.1, found.tank.depth)):
            assert values[1::2] == pytest.approx(sign * values[::2], abs=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("tolerance", [1e-3, 1e-5])
def test_a_plate_with_a_reentrant_corner_keeps_its_tolerance(tolerance: float) -> None:
    corners = ((2.0, 1.5), (8.0, 1.5), (8.0, 3.5), (5.0, 3.5), (5.0, 6.0), (2.0, 6.0))
    plate = Plate(outline=Polygon(points=corners), flexural_rigidity=5e3, mass_per_area=50.0)
    tank = LevelTank(plan=Box(length=10.0, width=8.0), depth=3.0, plates=(plate,), **WATER)
    solution, omega = _solved(tank, tolerance, 8)
    _, finer = _solved(tank, 1e-7, 8)
    errors = omega / finer - 1.0
    assert errors.min() > -1e-7
    assert 1.0 <= solution.relative_errors[:8].max() / errors.max() < 30.0


def test_tones_of_a_disc_and_a_strip_are_those_of_their_orders() -> None:
    for name, model in (("disc_base_s0", "plan"), ("strip_base_s1", "box")):
        tank = reference_tank(name)
        (exact,) = solve_smallest_model(tank, tolerance=1e-5, modes=4).tones
        # Above the one mode that is asked for.
        (tone,) = solve_smallest_model(tank, tolerance=1e-3, modes=1, model=model).tones
        for value, error, own in (
            (tone.eigenvalue, tone.relative_error, exact.eigenvalue),
            (tone.pressure_release, tone.pressure_release_error, exact.pressure_release),
        ):
            assert value is not None
            assert error is not None
            assert own is not None
            assert abs(np.sqrt(value / own) - 1.0) < error < 2e-3
        assert tone.tone is not None
        assert exact.tone is not None
        assert tone.tone.participation == pytest.approx(exact.tone.participation, rel=2e-2)
        assert tone.stiffness / tone.squares == pytest.approx(exact.stiffness / exact.squares, rel=1e-6)
