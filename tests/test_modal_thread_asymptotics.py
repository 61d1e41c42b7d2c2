"""Asymptotic and exact solutions of a thread, and their orders, against integration along it."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_bvp
from thread_cases import CASES, inputs, load_of, tolerance, worst_difference

from hydroelastic.modal.thread.asymptotics import NoAsymptoticError
from hydroelastic.modal.thread.clamp_layer import ClampLayer
from hydroelastic.modal.thread.critical import (
    critical_angle,
    critical_line,
    nearly_critical_tail,
    towed_body_exponent,
)
from hydroelastic.modal.thread.drag_dominated import drag_dominated
from hydroelastic.modal.thread.march import march_back, march_tail
from hydroelastic.modal.thread.tension_at_height import tension_dominated_at_height
from hydroelastic.modal.thread.tension_dominated import pulled_up_in_uniform_stream, tension_dominated
from hydroelastic.modal.thread.weightless import weightless_thread
from hydroelastic.physics.stream import ShearedStream, TabulatedStream, UniformStream, VeeringStream
from hydroelastic.physics.thread_load import ThreadLoad

HALVES = np.array([0.1, 0.05, 0.025])


def order_of(small: np.ndarray, errors: list[float]) -> float:
    return float(np.polyfit(np.log(small), np.log(errors), 1)[0])


def tension_load(small: float) -> ThreadLoad:
    """Return the load of A02 for another ratio to the end force 1."""
    known, part = load_of("A02"), small / 0.05
    return ThreadLoad(
        weight=part * known.weight,
        normal_drag=part * known.normal_drag,
        tangential_drag=part * known.tangential_drag,
        stream=known.stream,
    )


def test_tension_dominated_orders_of_a_known_case() -> None:
    for order in (1, 2):
        known = CASES["A02"]["checks"][f"order_{order}"]
        found = tension_dominated(load_of("A02"), 1.0, inputs("A02")["F_B"], [0.0, 1.0], order=order).shape
        # Quadrature to rounding: as many digits as there are.
        assert found.positions[1] == pytest.approx(known["rB"], rel=1e-12, abs=1e-12)
        assert found.forces[0] == pytest.approx(known["N_A"], rel=1e-12, abs=1e-12)


@pytest.mark.slow_but("20.0")
@pytest.mark.parametrize("axial_rigidity", [math.inf, 20.0])
def test_tension_dominated_orders(axial_rigidity: float) -> None:
    errors: dict[int, list[float]] = {0: [], 1: [], 2: []}
    for small in HALVES:
        force = inputs("A02")["F_B"]
        rigidity = axial_rigidity * 0.1 / small
        exact = march_back(tension_load(small), 1.0, force, axial_rigidity=rigidity, tolerance=1e-12)
        for order, list_of_errors in errors.items():
            found = tension_dominated(
                tension_load(small), 1.0, force, [0.0, 0.5, 1.0], order=order, axial_rigidity=rigidity
            )
            place = exact.at([0.5, 1.0])
            off = np.linalg.norm(found.shape.positions[1:] - place.positions, axis=1).max()
            list_of_errors.append(float(off))
            # What is said to be left out is so within a factor of three.
            assert 1 / 3 < off / found.position_truncation < 3
            assert np.linalg.norm(found.shape.forces[0] - exact.forces[0]) < 3 * found.force_truncation
    assert [order_of(HALVES, errors[order]) for order in (0, 1, 2)] == pytest.approx([1, 2, 3], abs=0.1)


@pytest.mark.slow
def test_tension_dominated_in_a_table_and_in_a_veer() -> None:
    # A table with its break on the thread is as good as the exact profile of the two parts: errors of third order.
    table = TabulatedStream((0.0, 0.43, 1.0), ((0.6, 0.0, 0.0), (0.9, 0.1, 0.0), (0.2, 0.5, 0.0)))
    for stream in (table, VeeringStream(0.8, 2.0)):
        errors = []
        for small in HALVES:
            load = ThreadLoad(weight=small / 2, normal_drag=small, tangential_drag=0.1 * small, stream=stream)
            exact = march_back(load, 1.0, (0.2, 0.1, 1.0), tolerance=1e-11)
            found = tension_dominated(load, 1.0, (0.2, 0.1, 1.0), [1.0]).shape
            errors.append(float(np.linalg.norm(found.positions[0] - exact.positions[-1])))
        assert order_of(HALVES, errors) == pytest.approx(3.0, abs=0.15)


def test_integrals_are_cut_where_the_thread_meets_a_break() -> None:
    stream = TabulatedStream((0.0, 0.43, 1.0), ((0.0, 0.0, 0.0), (0.9, 0.1, 0.0), (0.0, 0.5, 0.0)))
    load = ThreadLoad(weight=0.05, normal_drag=0.1, stream=stream)
    alone = tension_dominated(load, 1.0, (0.6, 0.0, 0.8), [1.0]).shape.positions[-1]
    # A place that is asked for is a knot in any case.
    cut = tension_dominated(load, 1.0, (0.6, 0.0, 0.8), [0.43 / 0.8, 1.0]).shape.positions[-1]
    assert alone == pytest.approx(cut, rel=1e-15, abs=1e-15)


def test_elementary_formula_of_a_large_pull() -> None:
    errors, force_errors = [], []
    for small in HALVES:
        load = ThreadLoad(weight=0.7 * small, normal_drag=0.5 * small, stream=UniformStream((1.0, 0.0, 0.0)))
        exact = march_back(load, 2.0, (0.0, 0.0, 1.0), tolerance=1e-12)
        place, force = pulled_up_in_uniform_stream(0.7 * small, 0.5 * small, 2.0, 1.0)
        errors.append(float(np.linalg.norm(exact.positions[-1] - place)))
        force_errors.append(float(np.linalg.norm(exact.forces[0] - force)))
    assert order_of(HALVES, errors) == pytest.approx(3.0, abs=0.1)
    assert order_of(HALVES, force_errors) == pytest.approx(3.0, abs=0.1)


def field(place: NDArray[np.floating]) -> NDArray[np.floating]:
    """Return an end force that depends on where the end is: a spring, and a lift that falls."""
    x, y = place[:2]
    return np.array([0.5 - 0.3 * x + 0.1 * y, 0.2 + 0.15 * x * y, 1.2 - 0.2 * x**2])


def test_thread_that_ends_at_a_height_in_a_field_of_force() -> None:
    errors: dict[str, list[float]] = {"place": [], "force": []}
    stream = TabulatedStream((-1.0, 0.4, 2.0), ((0.5, 0.2, 0.0), (0.9, 0.0, 0.0), (0.9, 0.6, 0.0)))
    for small in HALVES:
        load = ThreadLoad(weight=0.5 * small, normal_drag=small, tangential_drag=0.1 * small, stream=stream)
        found = tension_dominated_at_height(load, 1.0, field, [0.0, 0.7, 1.0])
        # Were the length not right to first order, neither would be the height of the end.
        exact = march_back(load, found.length, field, tolerance=1e-9)
        errors["place"].append(float(np.linalg.norm(found.positions[-1] - exact.positions[-1])))
        errors["force"].append(float(np.linalg.norm(found.forces[0] - exact.forces[0])))
        assert errors["place"][-1] < 3 * found.position_truncation
        assert errors["force"][-1] < 3 * found.force_truncation
    for name, values in errors.items():
        assert order_of(HALVES, values) == pytest.approx(2.0, abs=0.15), name


def drag_case(weight: float) -> tuple[ThreadLoad, list[float]]:
    known = load_of("A04")
    load = ThreadLoad(
        weight=weight, normal_drag=known.normal_drag, tangential_drag=known.tangential_drag, stream=known.stream
    )
    return load, inputs("A04")["F_B"]


def test_drag_dominated_orders_of_a_known_case() -> None:
    for order in (0, 1):
        known = CASES["A04"]["checks"][f"order_{order}"]
        shape = drag_dominated(*drag_case(-0.05), height=1.0, order=order).shape
        found = [shape.tensions[0], math.atan2(shape.forces[0, 2], shape.forces[0, 0]), shape.positions[-1, 0]]
        assert [*found, shape.s[-1]] == pytest.approx([known[key] for key in ("T", "f", "x", "s")], rel=1e-9)


@pytest.mark.slow_but("length")
@pytest.mark.parametrize("given", ["height", "length"])
def test_drag_dominated_orders(given: str) -> None:
    errors: dict[int, list[float]] = {0: [], 1: []}
    for weight in HALVES:
        load, force = drag_case(weight)
        for order, list_of_errors in errors.items():
            found = drag_dominated(load, force, **{given: 1.0}, order=order)  # type: ignore[arg-type]
            exact = march_back(load, float(found.shape.s[-1]), force, tolerance=1e-9)
            off = float(np.linalg.norm(found.shape.positions[-1] - exact.positions[-1]))
            list_of_errors.append(off)
            assert off < 3 * found.position_truncation
    assert order_of(HALVES, errors[0]) == pytest.approx(1.0, abs=0.15)
    assert order_of(HALVES, errors[1]) == pytest.approx(2.0, abs=0.15)


def test_drag_dominated_without_weight_is_exact_also_upside_down() -> None:
    load = load_of("S05")
    found = drag_dominated(load, inputs("S05")["F_B"], length=100.0, order=0).shape
    assert worst_difference("S05", rB=found.positions[-1], N_A=found.forces[0], T_A=found.tensions[0]) < 1e-9
    down = drag_dominated(load, np.multiply(inputs("S05")["F_B"], (1, 1, -1)), length=100.0, order=0).shape
    assert down.positions == pytest.approx(found.positions * [1, 1, -1], rel=1e-12)
    known = load_of("A04")
    mirrored = ThreadLoad(
        weight=0.05, normal_drag=1.0, tangential_drag=0.05, stream=ShearedStream((0.5, 0.0, 0.0), (-1.0, 0.0, 0.0))
    )
    below = drag_dominated(mirrored, (0.3, 0.0, -1.2), height=1.0).shape
    above = drag_dominated(known, (0.3, 0.0, 1.2), height=1.0).shape
    assert below.positions == pytest.approx(above.positions * [1, 1, -1], rel=1e-12)


def test_critical_line() -> None:
    load, length = load_of("S08"), inputs("S08")["L"]
    line = critical_line(load, length, [0.0, length / 2, length])
    values = {"rB": line.positions[2], "N_A": line.forces[0], "r_mid": line.positions[1], "T_A": line.tensions[0]}
    assert worst_difference("S08", **values) < tolerance("S08")
    normal = load.normal_drag * 4
    assert critical_angle(load.weight, normal) == pytest.approx(0.4028989545145, rel=1e-12)
    assert critical_angle(CASES["S07"]["inputs"]["w"], 13.299375 * 6.25) == pytest.approx(0.3240531664353, rel=1e-12)
    assert critical_angle(1.0, 0.0) == pytest.approx(math.pi / 2)
    # Nearly level, f² = w/Rₙ.
    assert critical_angle(1e-18, 1.0) == pytest.approx(1e-9, rel=1e-12)


def test_towed_body_exponent() -> None:
    load, given = load_of("S07"), inputs("S07")
    angle, normal = critical_angle(load.weight, load.normal_drag * 6.25), load.normal_drag * 6.25
    exponent = towed_body_exponent(load.weight, normal, load.tangential_drag * 6.25)
    thread = march_back(load, 4 * given["L"], 0.3 * np.array(given["F_B"]), tolerance=1e-13)
    near = thread.at([0.1 * given["L"], 1.1 * given["L"]])
    off = np.abs(angle + np.arctan2(near.forces[:, 2], near.forces[:, 0]))
    assert np.diff(np.log(off)) / np.diff(np.log(near.tensions)) == pytest.approx(exponent, rel=2e-3)


@pytest.mark.slow_but("8.89")
@pytest.mark.parametrize("weight", [8.89, -8.89])
def test_nearly_uniform_stream_over_a_free_tail(weight: float) -> None:
    errors: dict[str, list[float]] = {"angle": [], "zero": [], "tension": [], "across": []}
    side = math.copysign(1.0, weight)
    for small in HALVES:
        # The tail is at the level 0 of the stream, A 20 m above it; below for a buoyant thread.
        stream = ShearedStream((2.0, 0.0, 0.0), (side * 2.0 * small / 20, 0.0, 0.0))
        load = ThreadLoad(weight=weight, normal_drag=13.3, tangential_drag=0.28, stream=stream)
        tail = nearly_critical_tail(weight, 13.3 * 4, 0.28 * 4, [small / 20], [0.0, 10.0, 20.0])
        thread = march_tail(load, float(tail.lengths[-1]), start=(0, 0, side * 20.0), tolerance=1e-8)
        # The length is of first order: the level of A, and so the stream there, is off by the second.
        moved = thread.positions[-1] - thread.positions[0]
        errors["across"].append(abs(moved[0] - tail.across[-1]) / 20)
        errors["tension"].append(abs(thread.tensions[0] / tail.tensions[-1] - 1))
        angle = -side * math.atan2(thread.forces[0, 2], thread.forces[0, 0])
        errors["angle"].append(abs(angle - tail.angles[-1]))
        errors["zero"].append(abs(angle - critical_angle(weight, 13.3 * 4)))
        assert errors["angle"][-1] < 3 * tail.angle_truncation
    assert order_of(HALVES, errors["zero"]) == pytest.approx(1.0, abs=0.1)
    for name in ("angle", "tension", "across"):
        assert order_of(HALVES, errors[name]) == pytest.approx(2.0, abs=0.15), name


@pytest.mark.slow_but("force1")
@pytest.mark.parametrize("force", [(-0.4, 0.0, 1.5), (0.3, 0.8, -0.2), (-1.0, 0.2, 0.0)])
def test_weightless_thread_is_exact(force: tuple[float, float, float]) -> None:
    places = np.linspace(0, 1.5, 7)
    for velocity in ((1.0, 0.0, 0.0), (0.3, -0.4, 0.6), (1e-7, 0.0, 0.0)):
        load = ThreadLoad(weight=0.0, normal_drag=2.0, stream=UniformStream(velocity))
        exact = march_back(load, 1.5, force, tolerance=1e-12).at(places)
        found = weightless_thread(load, 1.5, force, places)
        assert found.positions == pytest.approx(exact.positions, abs=1e-10)
        assert found.forces == pytest.approx(exact.forces, abs=1e-10)


def clamped_moment(layer: ClampLayer, load: float) -> float:
    """Return the moment at the clamp by collocation.

    A thread along x under a load across it: N = (T, load (1 − s)), EI φ″ = Nₓ sin φ − N_z cos φ, free at s = 1.
    """
    outer = math.atan(load / layer.tension)
    clamp = outer + layer.angle

    def slope(s: np.ndarray, y: np.ndarray) -> np.ndarray:
        turned = layer.tension * np.sin(y[0]) - load * (1 - s) * np.cos(y[0])
        return np.stack([y[1], turned / layer.flexural_rigidity])

    s = 1 - np.cos(0.5 * math.pi * np.linspace(0, 1, 200))
    guess = np.arctan(load * (1 - s) / layer.tension) + layer.angles(s)
    solved = solve_bvp(
        slope,
        lambda a, b: np.array([a[0] - clamp, b[1]]),
        s,
        np.stack([guess, np.gradient(guess, s)]),
        tol=1e-9,
        max_nodes=50000,
    )
    assert solved.success
    return float(abs(solved.y[1, 0]) * layer.flexural_rigidity)


def test_clamp_layer() -> None:
    errors, lengths = [], np.array([0.04, 0.02, 0.01])
    for length in lengths:
        # T at the clamp is √(1 + load²) of that at the end.
        tension, load = 1.0, 0.3
        layer = ClampLayer(flexural_rigidity=length**2 * tension, tension=tension, angle=0.8, length=1.0)
        at_clamp = ClampLayer(
            flexural_rigidity=length**2 * tension, tension=math.hypot(tension, load), angle=0.8, length=1.0
        )
        moment = clamped_moment(layer, load)
        errors.append(abs(at_clamp.moment / moment - 1))
        assert errors[-1] < at_clamp.small
        assert at_clamp.decay_length == pytest.approx(length / math.sqrt(math.hypot(1, load)))
    assert order_of(lengths, errors) == pytest.approx(1.0, abs=0.15)


STREAM = UniformStream((1.0, 0.0, 0.0))
DRAG = ThreadLoad(weight=0.1, normal_drag=1.0, stream=STREAM)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: tension_dominated(DRAG, 1.0, (0, 0, 0.5), [0.0]), "of the tension"),
        (lambda: tension_dominated(DRAG, 1.0, (0, 0, 0), [0.0]), "no force"),
        (lambda: tension_dominated(DRAG, 1.0, (0, 0, 9), [0.0], order=3), "order is 3"),
        (lambda: pulled_up_in_uniform_stream(1.0, 1.0, 1.0, 1.0), "below 0.5"),
        (lambda: tension_dominated_at_height(DRAG, -1.0, field, [0.0]), "height is -1"),
        (lambda: tension_dominated_at_height(DRAG, 1.0, lambda p: (0, 0, -1.0), [0.0]), "pull up"),
        (lambda: tension_dominated_at_height(DRAG, 1.0, lambda p: (0, 0, 0.1), [0.0]), "of the tension"),
        # Φ_p = p Φ_z/H: a straight thread in any direction.
        (
            lambda: tension_dominated_at_height(DRAG, 1.0, lambda p: (9 * p[0], 9 * p[1], 9.0), [0.0]),
            "neutrally stable",
        ),
        (lambda: drag_dominated(DRAG, (0, 0, 1)), "one of them"),
        (lambda: drag_dominated(DRAG, (0, 0, 1), height=-1.0), "height is -1"),
        (lambda: drag_dominated(DRAG, (0, 1, 1), height=1.0), "plane of the stream"),
        (lambda: drag_dominated(DRAG, (1, 0, 0), height=1.0), "not be level"),
        (lambda: drag_dominated(ThreadLoad(weight=1.0, normal_drag=1.0), (1, 0, 1), height=1.0), "no stream"),
        (
            lambda: drag_dominated(ThreadLoad(weight=5.0, normal_drag=1.0, stream=STREAM), (0.5, 0, 1), height=1.0),
            "weight changes",
        ),
        (
            lambda: drag_dominated(
                ThreadLoad(weight=0.0, normal_drag=1.0, stream=VeeringStream(1.0, 1.0)), (0, 0, 1), height=1.0
            ),
            "one direction",
        ),
        (
            lambda: critical_line(ThreadLoad(weight=1.0, stream=ShearedStream((1, 0, 0), (1, 0, 0))), 1.0, [0.0]),
            "uniform stream only",
        ),
        (lambda: nearly_critical_tail(1.0, 1.0, 0.0, [1.0], [0.0, 1.0]), "stream changes"),
        (lambda: nearly_critical_tail(0.0, 1.0, 0.1, [0.1], [0.0, 1.0]), "not inclined"),
        (lambda: towed_body_exponent(0.0, 1.0, 0.0), "nothing pulls"),
        (lambda: critical_angle(0.0, 0.0), "no critical angle"),
        (lambda: weightless_thread(DRAG, 1.0, (0, 0, 1), [0.0]), "nothing else"),
        (lambda: ClampLayer(flexural_rigidity=1.0, tension=1.0, angle=0.1, length=1.0), "layer is"),
        (lambda: ClampLayer(flexural_rigidity=1.0, tension=-1.0, angle=0.1, length=1.0), "tension is"),
    ],
)
def test_conditions(make: Callable[[], object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        make()


def test_conditions_that_do_not_hold_are_told_from_bad_arguments() -> None:
    with pytest.raises(NoAsymptoticError):
        tension_dominated(DRAG, 1.0, (0, 0, 0.5), [0.0])
