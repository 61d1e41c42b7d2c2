"""Boxes with rectangular plates against references of two methods, closed forms and the orders of strips."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from plan_tanks import CASES, WATER, frequencies, reference_tank

from hydroelastic.fem.inertia import count_below
from hydroelastic.fem.level_bed.choice import LevelModel
from hydroelastic.fem.level_bed.interval import IntervalSpace
from hydroelastic.fem.modes import solve_modes
from hydroelastic.fem.plan.box import BoxModel, BoxSolution, solve_box
from hydroelastic.fem.plan.box_resolution import BoxResolution, graded_nodes
from hydroelastic.fem.plan.classes import SymmetryClass
from hydroelastic.fem.plan.solve import solve_smallest_model
from hydroelastic.physics.level_tank import Box, Cylinder, LevelTank
from hydroelastic.physics.plate import Disc, Plate, Rectangle, Strip
from hydroelastic.physics.tank import Top

RECTANGLES = [name for name, case in CASES.items() if case["family"] == "box_rectangle"]
STRIPS = [name for name, case in CASES.items() if case["family"] == "box_strip" and case["inputs"]["kind"] == "plate"]

MODELS: tuple[LevelModel, ...] = ("orders", "box")


@cache
def _solved(tank: LevelTank, tolerance: float, count: int) -> tuple[BoxSolution, np.ndarray]:
    solution = solve_box(tank.scaled(), tolerance=tolerance, count=count)
    return solution, np.sqrt(solution.modes.eigenvalues[:count]) * tank.units.frequency


def _assert_kept(name: str, tolerance: float, *, certain: float) -> None:
    """True errors keep the tolerance and come from above; the largest estimate is 1 to 30 times the largest error."""
    tank, exact = reference_tank(name), frequencies(name)[:12]
    solution, omega = _solved(tank, tolerance, len(exact))
    errors = omega / exact - 1.0
    assert solution.counted
    assert errors.max() < tolerance
    # Ritz values come from above; references have their own digits.
    assert errors.min() > -certain
    estimate = solution.relative_errors[: len(exact)].max()
    assert estimate < tolerance
    assert estimate > errors.max() - certain
    if errors.max() > certain:
        assert estimate < 30.0 * errors.max()


@pytest.mark.slow_but("rectangle_base_s0")
@pytest.mark.parametrize("name", RECTANGLES)
def test_rectangles_keep_a_tolerance_of_1e_6(name: str) -> None:
    _assert_kept(name, 1e-6, certain=10.0 ** -CASES[name]["digits"])


@pytest.mark.slow
@pytest.mark.parametrize("name", RECTANGLES)
def test_rectangles_keep_a_tolerance_of_1e_8(name: str) -> None:
    _assert_kept(name, 1e-8, certain=10.0 ** -CASES[name]["digits"])


@pytest.mark.slow_but("strip_at_wall")
@pytest.mark.parametrize("name", STRIPS)
def test_strips_as_rectangles_have_the_modes_of_their_orders(name: str) -> None:
    _assert_kept(name, 1e-6, certain=1e-10)


def test_a_sliding_cover_has_its_closed_form() -> None:
    tank = reference_tank("cover_box_s0", edge="sliding")
    solution, omega = _solved(tank, 1e-8, 12)
    # Rounding of a plate whose stiffest shape is 10⁹ times as stiff as its softest: measured 3e-11.
    assert omega == pytest.approx(frequencies("cover_box_s0"), rel=1e-10)
    assert np.all(np.abs(omega / frequencies("cover_box_s0") - 1.0) < solution.relative_errors[:12])


def test_classes_are_those_of_the_modes() -> None:
    tank = reference_tank("rectangle_base_s0")
    solution, _ = _solved(tank, 1e-6, 12)
    labels = [solution.modes.classes[number].label for number, _ in solution.modes.origins[:12]]
    assert labels == CASES["rectangle_base_s0"]["label"]


def test_a_tank_without_symmetry_has_the_same_modes() -> None:
    tank = reference_tank("rectangle_base_s0")
    plate = tank.plates[0]
    outline = plate.outline
    assert isinstance(outline, Rectangle)
    moved = replace(tank, plates=(replace(plate, outline=replace(outline, position=(5.0 + 2e-8, 4.0 - 2e-8))),))
    _, whole = _solved(moved, 1e-3, 6)
    # The tolerance asked; measured 4e-4.
    assert whole == pytest.approx(frequencies("rectangle_base_s0")[:6], rel=1e-3)


def _strips(*rigidities: float, hydrostatic: bool, top: Top) -> LevelTank:
    plates = tuple(
        Plate(
            outline=Strip(start=0.7 + 3.2 * number, length=2.0, width=1.5),
            flexural_rigidity=rigidity,
            mass_per_area=50.0,
            hydrostatic=hydrostatic,
        )
        for number, rigidity in enumerate(rigidities)
    )
    return LevelTank(plan=Box(length=10.0, width=1.5), depth=2.0, plates=plates, top=top, **WATER)


def test_plates_of_unlike_stiffness_have_the_released_tones_of_their_orders() -> None:
    """Those of the stiffer ones lie above rigid motions and shorter waves of the softer ones."""
    tank = _strips(5e2, 5e4, 5e3, hydrostatic=True, top="free")
    exact, found = (solve_smallest_model(tank, tolerance=1e-3, modes=1, model=model).tones for model in MODELS)
    for one, own in zip(found, exact, strict=True):
        assert one.pressure_release is not None
        assert one.pressure_release_error is not None
        assert own.pressure_release is not None
        assert own.pressure_release_error is not None
        error = abs(np.sqrt(one.pressure_release / own.pressure_release) - 1.0)
        assert error < one.pressure_release_error + own.pressure_release_error < 2e-3


@pytest.mark.parametrize(
    ("hydrostatic", "model"),
    [
        (False, "box"),
        pytest.param(True, "box", marks=pytest.mark.slow),
        pytest.param(True, "plan", marks=pytest.mark.slow),
    ],
)
def test_modes_with_a_released_surface_are_those_of_orders(*, hydrostatic: bool, model: LevelModel) -> None:
    if model == "box":
        tank = _strips(5e2, 5e4, hydrostatic=hydrostatic, top="pressure_release")
    else:
        plate = Plate(outline=Disc(radius=2.0), flexural_rigidity=5e3, mass_per_area=50.0, hydrostatic=hydrostatic)
        tank = LevelTank(plan=Cylinder(radius=5.0), depth=2.0, plates=(plate,), top="pressure_release", **WATER)
    exact = solve_smallest_model(tank, tolerance=1e-6, modes=4, tones=False)
    values = np.sort([one.mode.eigenvalue for one in exact.modes for _ in range(one.problem.multiplicity)])[:4]
    found = solve_smallest_model(tank, tolerance=1e-3, modes=4, model=model, tones=False)
    estimates = np.array([one.relative_error for one in found.modes])
    errors = np.sqrt([one.mode.eigenvalue for one in found.modes] / values) - 1.0
    # Measured: 1e-5 to 5e-5.
    assert np.all(np.abs(errors) < estimates)
    assert estimates.max() < min(1e-3, 30.0 * np.abs(errors).max())
    assert found.counted
    assert found.zero_modes == (0 if hydrostatic else 4)


def test_the_inertia_of_a_dense_problem_counts_as_many_modes() -> None:
    from hydroelastic.fem.plan.box import box_problem

    tank = reference_tank("rectangle_soft_s1")
    solution, _ = _solved(tank, 1e-4, 8)
    one = solution.modes.classes[0]
    pencil, _ = box_problem(tank.scaled(), solution.resolution.coarser(), one.parity, dense=True)
    assert pencil is not None
    for index in range(1, 3):
        shift = float(np.sqrt(one.modes.eigenvalues[index] * one.modes.eigenvalues[index - 1]))
        assert count_below(pencil, shift) == index


def test_a_heavy_rigid_cover_does_not_move_and_leaves_no_mode() -> None:
    # With the volume kept a rigid cover can only tilt; hydrostatic pressure restores it.
    plate = Plate(
        outline=Rectangle(position=(1.0, 0.5), size=(2.0, 1.0)),
        flexural_rigidity=np.inf,
        mass_per_area=100.0,
    )
    tank = LevelTank(plan=Box(length=2.0, width=1.0), depth=1.0, plates=(plate,), **WATER)
    solution, omega = _solved(tank, 1e-8, 3)
    # Heave would change the volume; pitch and roll are left, with ψ of w = x: Σ over odd cosines in closed form.
    assert len(omega) == 2
    expected = []
    for length, width in ((2.0, 1.0), (1.0, 2.0)):
        k = np.pi * np.arange(1, 40001, 2) / length
        inertia = 1000.0 * width * (2.0 / length) * np.sum((2.0 / k**2) ** 2 / (k * np.tanh(k)))
        moment = width * length**3 / 12.0
        expected.append(np.sqrt(9810.0 * moment / (inertia + 100.0 * moment)))
    assert omega == pytest.approx(sorted(expected), rel=1e-9)
    assert solution.modes.classes[0].modes.zero_modes == 0


@pytest.mark.slow
def test_a_plate_a_millimetre_from_a_wall_keeps_its_tolerance() -> None:
    plate = Plate(outline=Rectangle(position=(1.501, 3.0), size=(3.0, 2.0)), flexural_rigidity=5e3, mass_per_area=50.0)
    tank = LevelTank(plan=Box(length=10.0, width=6.0), depth=2.0, plates=(plate,), **WATER)
    _, fine = _solved(tank, 1e-9, 8)
    coarse, omega = _solved(tank, 1e-6, 8)
    errors = omega / fine - 1.0
    # The largest one: of the lowest mode, 4e-10, the estimate shows a quarter.
    assert errors.max() < coarse.relative_errors[:8].max() < 1e-6


@pytest.mark.parametrize("odd", [False, True])
def test_thin_layers_leave_long_waves_their_digits(odd: bool) -> None:
    # The nodes beside 0.37 lie 1e-9 from it, where hats of neighbours would cancel: they left 1e-7.
    nodes = graded_nodes(0.0, 1.0, (0.37,), largest=0.25, layers=13)
    squares, _ = IntervalSpace(nodes=nodes, degree=10, zero_at_end=odd).waves
    expected = np.pi * (np.arange(1, 6) - (0.5 if odd else 0.0))
    np.testing.assert_allclose(np.sqrt(squares[int(not odd) :][:5]), expected, rtol=1e-12)


def test_the_error_of_a_clamped_plate_is_that_of_more_polynomials() -> None:
    # The energy in the last polynomials shows 0.1 of it, beside corners between a clamped and a free edge.
    outline = Rectangle(position=(2.5, 2.0), size=(5.0, 1.5))
    plate = Plate(outline=outline, flexural_rigidity=1.0, mass_per_area=20.0, edge="clamped")
    tank = LevelTank(plan=Box(length=10.0, width=4.0), depth=0.5, plates=(plate,), **WATER).scaled()
    model, coarse = BoxModel(tank=tank), BoxResolution(degree=5, largest=0.1, layers=1, polynomials=(12,))
    values = []
    for resolution in (coarse, replace(coarse, polynomials=(26,))):
        pencil, plates = model.problem(resolution, (None, 0))
        assert pencil is not None
        modes = solve_modes(pencil, 4, shapes=0)
        values.append(modes.eigenvalues[:4])
        if resolution is coarse:
            one = SymmetryClass(parity=(None, 0), pencil=pencil, modes=modes)
            _, estimates = model.errors(resolution, one, plates, [modes.completed(place) for place in range(4)])
    errors = 0.5 * (values[0] / values[1] - 1.0)
    assert errors.max() < estimates.max() < 4.0 * errors.max()
