"""What is refined follows from where the error comes from, and what rounding forbids is not tried."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from hydroelastic.fem.tank.error_estimates import FrequencyErrors, refined
from hydroelastic.fem.tank.resolution import (
    HIGHEST_DEGREE,
    Resolution,
    initial_resolution,
    rounding_error,
    workable_tolerance,
)
from hydroelastic.scenes.models.physical import physical_tank

TOLERANCE = 1e-6
LAST = Resolution(
    degree=6,
    surface_sizes=(0.1, 0.1),
    bulk_size=0.5,
    tip_size=1e-4,
    shapes=(20, 30),
    modes=10,
    reaches_tones=(True, True),
)


def errors(**causes: float) -> FrequencyErrors:
    every = {"liquid": 1e-9, "tips": 1e-9, "truncation": 1e-9, "rounding": 1e-12} | causes
    return FrequencyErrors(**{cause: np.array([1e-10, value]) for cause, value in every.items()})


def next_after(causes: FrequencyErrors, last: Resolution = LAST, **changes: bool) -> Resolution | None:
    return refined(last, causes, TOLERANCE, **({"exponent": 1.0, "remesh": True} | changes))


def changed(finer: Resolution | None, last: Resolution = LAST) -> set[str]:
    assert finer is not None
    return {name for name in vars(last) if getattr(finer, name) != getattr(last, name)}


def test_each_cause_is_met_by_its_own_remedy() -> None:
    assert changed(next_after(errors(liquid=1e-5))) == {"degree"}
    assert changed(next_after(errors(truncation=1e-5))) == {"shapes"}
    assert changed(next_after(errors(tips=1e-5))) == {"tip_size"}
    assert changed(next_after(errors(tips=1e-5, truncation=1e-5))) == {"tip_size", "shapes"}


def test_the_remedy_is_as_strong_as_the_error_asks() -> None:
    slight, strong = next_after(errors(liquid=5e-7)), next_after(errors(liquid=1e-3))
    assert slight is not None
    assert strong is not None
    assert (slight.degree, strong.degree) == (7, 9)
    many = next_after(errors(truncation=1e-5))
    assert many is not None
    # The tail falls like N⁻⁷: 30 times too much needs 30^(1/7) = 1.63 times the shapes, and some.
    assert 1.63 * 20 < many.shapes[0] < 2.2 * 20
    ring, sharp = next_after(errors(tips=1e-5)), next_after(errors(tips=1e-5), exponent=0.5)
    assert ring is not None
    assert sharp is not None
    # r ln r counts like the square of the ring, r^{1/2} like the ring.
    assert LAST.tip_size is not None
    assert ring.tip_size == pytest.approx(0.3 * LAST.tip_size / np.sqrt(30.0))
    assert sharp.tip_size == pytest.approx(0.3 * LAST.tip_size / 30.0)


def test_beyond_the_highest_degree_elements_shrink_and_rings_multiply() -> None:
    highest = LAST.with_degree(10)
    assert highest.degree == HIGHEST_DEGREE
    assert changed(next_after(errors(liquid=1e-5), highest), highest) == {"surface_sizes", "bulk_size", "ring_ratio"}


def test_a_mesh_of_the_users_own_is_not_changed() -> None:
    assert changed(next_after(errors(liquid=1e-5, tips=1e-5), remesh=False)) == {"degree"}
    assert next_after(errors(liquid=1e-5), LAST.with_degree(10), remesh=False) is None


def test_nothing_is_tried_against_rounding() -> None:
    assert next_after(errors(rounding=2e-6)) is None


def test_a_tolerance_beyond_double_precision_is_not_worked_towards() -> None:
    assert workable_tolerance(1e-8, depth=0.5) == 1e-8
    assert 1e-11 < workable_tolerance(1e-12, depth=0.5) < 1e-10
    # A thin layer holds little energy of a long wave in each cell.
    assert workable_tolerance(1e-12, depth=1e-3) == pytest.approx(1e3 * workable_tolerance(1e-12, depth=0.5))


def test_the_degree_leaves_room_for_rounding_in_thin_layers(tanks: Any) -> None:
    def degree(depth: float) -> int:
        scene = tanks.scene(tanks.beam(), depth=depth, tolerance=1e-8)
        return initial_resolution(physical_tank(scene).scaled(), scene.accuracy.tolerance, modes=8).degree

    assert degree(0.01) < degree(5.0)
    assert rounding_error(degree(5.0), 0.5) < 1e-8
