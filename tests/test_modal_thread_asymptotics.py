"""Asymptotic and exact solutions of a thread, and their orders, against integration along it."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
from thread_cases import CASES, inputs, load_of, tolerance, worst_difference

from hydroelastic.modal.thread.critical import critical_line
from hydroelastic.modal.thread.drag_dominated import drag_dominated
from hydroelastic.modal.thread.march import march_back
from hydroelastic.modal.thread.shape import NoAsymptoticError
from hydroelastic.modal.thread.tension_dominated import tension_dominated
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


STREAM = UniformStream((1.0, 0.0, 0.0))
DRAG = ThreadLoad(weight=0.1, normal_drag=1.0, stream=STREAM)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: tension_dominated(DRAG, 1.0, (0, 0, 0.5), [0.0]), "of the tension"),
        (lambda: tension_dominated(DRAG, 1.0, (0, 0, 0), [0.0]), "no force"),
        (lambda: tension_dominated(DRAG, 1.0, (0, 0, 9), [0.0], order=3), "order is 3"),
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
    ],
)
def test_conditions(make: Callable[[], object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        make()


def test_conditions_that_do_not_hold_are_told_from_bad_arguments() -> None:
    with pytest.raises(NoAsymptoticError):
        tension_dominated(DRAG, 1.0, (0, 0, 0.5), [0.0])
