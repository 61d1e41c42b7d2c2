"""A liquid that many bodies share: a point of a family is the single problem, to rounding, and its bound is checked.

The single problem is that of the same matrices, solved whole: the tolerances are rounding of λ, 1e-12, of a sum of some
hundred products, and of error estimates, which the directions that are left out may change by 2√(ε · 1e-14)/ε, 1e-2 for
the smallest of them here.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from tanks import Tanks

from hydroelastic.fem import modes, shared_answer
from hydroelastic.fem.inertia import count_below, shared_counts
from hydroelastic.fem.liquid_answer import LiquidAnswer
from hydroelastic.fem.modes import solve_modes
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.shared_answer import SharedAnswer
from hydroelastic.fem.shared_modes import LiquidErrors
from hydroelastic.fem.spectral_error import cell_errors
from hydroelastic.fem.tank import solve, together
from hydroelastic.fem.tank.error_estimates import frequency_errors
from hydroelastic.fem.tank.field_solution import PartPencils, solve_parts
from hydroelastic.fem.tank.liquids import SharedLiquids
from hydroelastic.fem.tank.solve import shared_liquids, solve_tank
from hydroelastic.fem.tank.together import attempt_together
from hydroelastic.physics.tank import Tank
from hydroelastic.scenes.models.physical import physical_tank

RIGIDITIES = (300.0, 3000.0, 30000.0)
TOLERANCE = 1e-5
COUNT = 8


def tank_of(tanks: Tanks, rigidity: float, start: float) -> Tank:
    return physical_tank(tanks.scene(tanks.beam(flexural_rigidity=rigidity, start=start), modes=4, tolerance=TOLERANCE))


def family(tanks: Tanks, start: float) -> SharedLiquids:
    ends = [tank_of(tanks, rigidity, start) for rigidity in (RIGIDITIES[0], RIGIDITIES[-1])]
    return shared_liquids(ends, tolerance=TOLERANCE, modes=4)


def pencils(tanks: Tanks, liquids: SharedLiquids, rigidity: float) -> PartPencils:
    solution = solve_tank(tank_of(tanks, rigidity, 3.0), tolerance=TOLERANCE, modes=4, liquids=liquids)
    return {part.parity: part.pencil for part in solution.field.parts}


@pytest.fixture(scope="module")
def liquids(tanks: Tanks) -> SharedLiquids:
    return family(tanks, 3.0)


@pytest.mark.parametrize("rigidity", RIGIDITIES)
def test_a_point_of_a_family_is_the_whole_problem(tanks: Tanks, liquids: SharedLiquids, rigidity: float) -> None:
    for pencil in pencils(tanks, liquids, rigidity).values():
        answer = pencil.answer
        assert isinstance(answer, SharedAnswer)
        assert answer.liquid_errors is not None
        # The same matrices as those of a single tank, which knows nothing of a family.
        alone = replace(pencil, answer=replace_by_plain(answer))
        found, whole = solve_modes(pencil, COUNT), solve_modes(alone, COUNT)
        assert found.projection is not None
        assert whole.projection is None
        assert found.projection.max() < modes.PROJECTED
        assert found.eigenvalues == pytest.approx(whole.eigenvalues, rel=1e-12)
        # Of the whole problem, not of the projected one.
        assert 0.0 < max(mode.residual for mode in found.modes) < 1e-5
        # Between neighbours a shift close to either is told apart.
        for below, (lower, upper) in enumerate(pairwise(whole.eigenvalues), 1):
            for shift in (lower + 1e-3 * (upper - lower), upper - 1e-3 * (upper - lower)):
                assert count_below(pencil, float(shift)) == below
        errors = answer.liquid_errors(np.column_stack([mode.values for mode in found.modes]))
        direct = cell_errors(pencil.liquid, [mode.potential for mode in whole.modes])
        assert errors.sum(axis=1) == pytest.approx(direct.sum(axis=1), rel=1e-2)


def replace_by_plain(answer: SharedAnswer) -> LiquidAnswer:
    return LiquidAnswer(
        potentials=answer.potentials, added_mass=answer.added_mass, root=answer.root, scaled=answer.scaled
    )


def test_where_the_bound_is_too_large_the_whole_problem_is_solved(
    tanks: Tanks, liquids: SharedLiquids, monkeypatch: pytest.MonkeyPatch
) -> None:
    pencil = next(iter(pencils(tanks, liquids, 3000.0).values()))
    answer = pencil.answer
    assert isinstance(answer, SharedAnswer)
    whole = solve_modes(pencil, COUNT).eigenvalues
    # A basis of three gravity modes and the static part of the others is too small for eight modes: its λ are too high,
    # and the bound says so.
    monkeypatch.setattr(shared_answer, "_STEP", 1)
    monkeypatch.setattr(shared_answer, "_TERMS", 1)
    small = replace(answer, _projections={}).projection(2)
    monkeypatch.setattr(SharedAnswer, "projection", lambda *_: small)
    found = solve_modes(pencil, COUNT)
    assert found.projection is None
    assert found.eigenvalues == pytest.approx(whole, rel=1e-12)
    monkeypatch.setattr(modes, "PROJECTED", np.inf)
    coarse = solve_modes(pencil, COUNT)
    assert coarse.projection is not None
    # Kato and Temple: an upper bound of what is measured, where that is small; 1e-14 is rounding.
    errors = coarse.eigenvalues / whole - 1.0
    small_ones = errors < 1e-2
    assert np.all(errors[small_ones] <= coarse.projection[small_ones] + 1e-14)
    assert errors[small_ones].max() > 1e-6
    assert np.all(coarse.projection[~small_ones] > 1e-3)


def test_directions_of_a_point_do_not_change_the_estimates_of_another(tanks: Tanks) -> None:
    single = family(tanks, 2.0)
    tank = tank_of(tanks, 3000.0, 2.0)
    first = solve_tank(tank, tolerance=TOLERANCE, modes=4, liquids=single)
    for rigidity in RIGIDITIES:
        solve_tank(tank_of(tanks, rigidity, 2.0), tolerance=TOLERANCE, modes=4, liquids=single)
    again = solve_tank(tank, tolerance=TOLERANCE, modes=4, liquids=single)
    assert first.counted
    # To the last digit: a sweep that goes on after an interruption writes the same files.
    assert np.array_equal(again.relative_errors, first.relative_errors, equal_nan=True)


def test_a_tank_of_the_sample_is_solved_once_and_is_its_point(tanks: Tanks, liquids: SharedLiquids) -> None:
    sampled, between = (tank_of(tanks, rigidity, 3.0) for rigidity in RIGIDITIES[:2])
    known = solve_tank(sampled, tolerance=TOLERANCE, modes=4, liquids=liquids)
    assert known is solve_tank(sampled, tolerance=TOLERANCE, modes=4, liquids=liquids)
    assert liquids.known(between, TOLERANCE, 4) is None
    # What was asked for counts too.
    assert liquids.known(sampled, TOLERANCE, 5) is None
    again = solve_tank(sampled, tolerance=TOLERANCE, modes=4, liquids=replace(liquids, solved={}))
    assert again is not known
    assert again.modes.eigenvalues == pytest.approx(known.modes.eigenvalues, rel=1e-12)
    assert again.relative_errors == pytest.approx(known.relative_errors, rel=1e-2, nan_ok=True)


def test_tanks_that_are_attempted_together_are_those_attempted_alone(
    tanks: Tanks, liquids: SharedLiquids, monkeypatch: pytest.MonkeyPatch
) -> None:
    # Some have more modes below their tone than others, and some no hydrostatic restoring; the order is not theirs.
    given = [
        physical_tank(
            tanks.scene(
                tanks.beam(flexural_rigidity=rigidity, start=3.0, hydrostatic=hydrostatic), modes=4, tolerance=TOLERANCE
            )
        )
        for rigidity, hydrostatic in ((2e4, True), (500.0, True), (4e3, False), (1e3, False), (9e3, True))
    ]
    alone = [solve_tank(tank, tolerance=TOLERANCE, modes=4, liquids=liquids) for tank in given]
    attempt_together(liquids, given, tolerance=TOLERANCE, modes=4)
    begun = list(liquids.begun.values())
    assert all(attempt.field is not None and attempt.counted for attempt in begun)
    # They are gone on with: nothing is solved, counted or estimated again.
    for name in ("solve_field", "count_is_confirmed"):
        monkeypatch.setattr(solve, name, None)
    monkeypatch.setattr(LiquidErrors, "estimate_together", staticmethod(lambda _asked: None))
    for tank, expected in zip(given, alone, strict=True):
        found = solve_tank(tank, tolerance=TOLERANCE, modes=4, liquids=liquids)
        assert found.modes.eigenvalues == pytest.approx(expected.modes.eigenvalues, rel=1e-12)
        # Sums in single precision, in another order.
        assert found.relative_errors == pytest.approx(expected.relative_errors, rel=1e-4, nan_ok=True)
        assert [one.pressure_release for one in found.tones] == pytest.approx(
            [one.pressure_release for one in expected.tones], rel=1e-13
        )
        assert found.reasons == expected.reasons
    assert not liquids.begun


def test_a_count_that_disagrees_with_modes_solved_together_is_told(
    tanks: Tanks, liquids: SharedLiquids, monkeypatch: pytest.MonkeyPatch
) -> None:
    def one_more(*given: Any) -> list[int | None]:
        return [None if count is None else count + 1 for count in shared_counts(*given)]

    monkeypatch.setattr(together, "shared_counts", one_more)
    tank = tank_of(tanks, 2e3, 3.0)
    attempt_together(liquids, [tank], tolerance=TOLERANCE, modes=4)
    assert liquids.first_attempt(tank, TOLERANCE, 4).counted is False


def test_what_a_small_basis_loses_is_in_the_error_estimate(
    tanks: Tanks, liquids: SharedLiquids, monkeypatch: pytest.MonkeyPatch
) -> None:
    tank = tank_of(tanks, 2e3, 3.0)
    whole = solve_tank(tank, tolerance=TOLERANCE, modes=4, liquids=liquids)
    # Few gravity modes and the static part of the others, whatever they lose.
    for name, value in (("_STEP", 1), ("_KEPT", 0.25), ("_TERMS", 1)):
        monkeypatch.setattr(shared_answer, name, value)
    monkeypatch.setattr(modes, "PROJECTED", np.inf)
    small = {part.parity: replace(part.pencil, answer=with_another_basis(part.pencil)) for part in whole.field.parts}
    coarse = solve_parts(whole.field.mesh, whole.tank, whole.resolution.shapes, small, 4)
    found = [coarse.modes.completed(number) for number in range(4)]
    estimates = frequency_errors(coarse, found, coarse.origins, whole.resolution, whole.tank).total
    errors = np.sqrt(coarse.modes.eigenvalues / whole.modes.eigenvalues[:4]) - 1.0
    # More than all else that is estimated.
    assert errors.max() > 10.0 * np.nanmax(whole.relative_errors)
    assert np.all(estimates >= errors)


def with_another_basis(pencil: CoupledPencil) -> SharedAnswer:
    assert isinstance(pencil.answer, SharedAnswer)
    return replace(pencil.answer, _projections={})


def test_where_one_tank_cannot_be_attempted_each_is_attempted_alone(
    tanks: Tanks, liquids: SharedLiquids, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object) -> None:
        raise np.linalg.LinAlgError

    tank = tank_of(tanks, 2e3, 3.0)
    expected = solve_tank(tank, tolerance=TOLERANCE, modes=4, liquids=liquids)
    with monkeypatch.context() as patched:
        patched.setattr(together, "solved_together", fail)
        attempt_together(liquids, [tank], tolerance=TOLERANCE, modes=4)
    assert not liquids.begun
    found = solve_tank(tank, tolerance=TOLERANCE, modes=4, liquids=liquids)
    assert np.array_equal(found.modes.eigenvalues, expected.modes.eigenvalues)
