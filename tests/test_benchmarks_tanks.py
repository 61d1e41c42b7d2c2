"""The benchmark's exact frequencies, and the lower bound: the same eigenvalues as the solver's."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from hydroelastic.benchmarks.tank.cases import MODES, TANKS, BenchmarkTank, tank_named
from hydroelastic.modal.beam.gravity_added_mass import gravity_tones

NAMES = [tank.name for tank in TANKS]


@pytest.mark.parametrize("name", NAMES)
def test_tanks_are_those_of_the_reference(tanks: Any, name: str) -> None:
    tank, case = tank_named(name), tanks.cases[name]
    given = case["inputs"]
    beam = tank.beam
    assert (beam.tank_length, beam.depth, beam.start, beam.length) == (given["L"], given["H"], given["x1"], given["l"])
    assert (beam.density, beam.gravity, beam.hydrostatic) == (given["rho"], given["g"], bool(given["s"]))
    assert (beam.flexural_rigidity, beam.mass_per_length) == (given["EI"], given["m"])
    assert len(tank.frequencies) == MODES
    assert tank.frequencies[:8] == tuple(case["omega"])


@pytest.mark.parametrize("name", NAMES)
def test_frequencies_are_those_of_the_surface_operator(name: str) -> None:
    tank = tank_named(name)
    highest = tank.frequencies[-1] ** 2
    tones = gravity_tones(tank.beam, tuple(range(96)), 4.0 * highest)
    errors = np.sqrt(tones.squared_frequencies[:MODES]) / tank.frequencies - 1.0
    # From above; 96 dry shapes leave 2e-10 at the most, in the widest beam (measured).
    assert errors.min() > -1e-13
    assert errors.max() < 4e-10


@pytest.fixture(scope="module")
def lower_bound() -> Any:
    return pytest.importorskip("hydroelastic.benchmarks.tank.lower_bound")


@pytest.mark.parametrize("name", ["base_s0", "base_s1", "offcentre_s0"])
def test_the_lower_bound_finds_the_eigenvalues_of_the_solver(tanks: Any, lower_bound: Any, name: str) -> None:
    solution = tanks.solve(tanks.case_scene(name, modes=MODES, tolerance=1e-4))
    bound = lower_bound.bound_of(solution, tank_named(name))
    own = [solution.omega(mode.eigenvalue) for mode in solution.asked]
    # Both are iterated to rounding; measured 1e-13.
    np.testing.assert_allclose(bound.frequencies, own, rtol=1e-11)
    assert len(bound.work) == len(solution.field.parts)
    answer = lower_bound.solve(bound)
    assert answer.values == bound.frequencies
    assert answer.unknowns > 500
    assert all(10 <= work.steps < 80 for work in bound.work)


@pytest.mark.parametrize("halves", [True, False])
def test_factorizations_agree(tanks: Any, lower_bound: Any, halves: bool) -> None:
    from hydroelastic.benchmarks.tank.bare_pencil import BarePencil
    from hydroelastic.benchmarks.tank.factorizations import available_factorizations

    solution = tanks.solve(tanks.case_scene("base_s0", modes=MODES, tolerance=1e-4), halves=halves)
    pencil = BarePencil.of(lower_bound.pencils_of(solution)[-1])
    load = pencil.coupling @ np.ones(pencil.coupling.shape[1])
    found = available_factorizations()
    assert {"SuperLU", "MUMPS"} <= found.keys()
    for factorize in found.values():
        solve = factorize(pencil.laplace)
        for factor in (1.0, 2.0):
            answer = solve(factor * load)
            # Condition times rounding of graded meshes: measured 1e-12.
            np.testing.assert_allclose(pencil.laplace @ answer, factor * load, atol=1e-9 * np.abs(load).max())


def test_hydroelastic_solves_the_tank_of_its_case(tanks: Any) -> None:
    module = pytest.importorskip("hydroelastic.benchmarks.tank.hydroelastic")
    from hydroelastic.benchmarks.cases import Case

    case = Case(code="hydroelastic", tank="narrow_s1", variant="certified", tolerance=1e-4)
    answer = module.solve(module.prepare(case))
    assert worst(tank_named("narrow_s1"), answer.values) < 1e-4
    assert answer.stages
    assert "estimate" in answer.note


def worst(tank: BenchmarkTank, frequencies: tuple[float, ...]) -> float:
    return float(np.abs(np.array(frequencies) / tank.frequencies - 1.0).max())
