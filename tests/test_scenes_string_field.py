"""Field solutions of hanging strings in scenes, beside the series where there is one, and beside other theories."""

from functools import cache
from typing import Any

import numpy as np
import pytest
import xarray
from command import run_command
from scipy.optimize import brentq
from scipy.special import j0, j1, y0, y1

import hydroelastic as he

# Of free motions alone.
NO_MOTION = "output.times=[0.0, 0.01]"
SHORT = "output={positions=[0.0, 0.09, 0.36, 0.81, 1.0], times={start=0, stop=1.5, number=16}}"


@cache
def solved(name: str, *overrides: str, method: str = "field") -> he.Result:
    return he.solve(he.read(name, [*overrides, f"accuracy.method={method}"]))


def series(name: str, *overrides: str) -> he.Result:
    return solved(name, *overrides, "accuracy.tolerance=1e-12", method="series")


def omegas(result: he.Result) -> Any:
    return np.array([mode["omega"] for mode in result.summary["modes"]])


def compared(field: xarray.Dataset, exact: xarray.Dataset) -> tuple[Any, Any]:
    """Errors and their estimates, but beside fronts, where the estimate is infinite or a value is not judged."""
    error = np.abs(field.displacement.values - exact.displacement.values)
    judged = ~field.beside_front.values.astype(bool)
    assert judged.mean() > 0.5
    return error[judged], field.absolute_error.values[judged]


CASES = [
    *(("string_smooth", SHORT, tolerance) for tolerance in (1e-3, 1e-5, 1e-7)),
    *((name, SHORT, tolerance) for name in ("string_ramp", "string_sine") for tolerance in (1e-3, 1e-5)),
    *((name, "output.frames=0", 1e-4) for name in ("string_step", "string_table")),
]


@pytest.mark.slow_but("string_ramp-*-0.001")
@pytest.mark.parametrize(("name", "output", "tolerance"), CASES)
def test_field_and_series_agree_within_the_estimate(name: str, output: str, tolerance: float) -> None:
    field = solved(name, output, f"accuracy.tolerance={tolerance}")
    exact = series(name, output)
    assert field.summary["status"] == "ok"
    error, estimate = compared(field.dataset, exact.dataset)
    assert error.max() < tolerance * np.abs(exact.dataset.displacement.values).max()
    # An estimate is never below a third of the true error.
    assert np.all(error <= 3.0 * estimate + 1e-13)


def test_free_motions_of_both_methods_are_one_list() -> None:
    # Heavy damping: two aperiodic modes, both of whose roots count.
    overrides = ("string.resistance=0.5", NO_MOTION, "accuracy.modes=8")
    field = solved("string_smooth", *overrides, "accuracy.tolerance=1e-3")
    exact = series("string_smooth", *overrides)
    for key in ("omega", "damped_omega", "decay"):
        rows = [[mode[key] for mode in result.summary["modes"]] for result in (field, exact)]
        assert rows[0] == pytest.approx(rows[1], rel=1e-11)


@pytest.mark.slow_on_ranks_but
@pytest.mark.mpi
def test_a_load_on_the_end_changes_frequencies_as_bessel_functions_say() -> None:
    overrides = ("string.resistance=0", NO_MOTION, "accuracy.tolerance=1e-3", "accuracy.modes=6")
    found = omegas(solved("string_smooth", *overrides, "string.tip_mass=0.02"))
    # φ = A J₀(z) + B Y₀(z), z = 2ω√((x + M/ρ)/g): zero above, and −ω²Mφ = Mg φ' at the load.
    length, gravity, shift = 1.0, 9.81, 0.02 / 0.05

    def determinant(omega: float) -> float:
        top, bottom = (2.0 * omega * np.sqrt((x + shift) / gravity) for x in (length, 0.0))
        slope = omega / np.sqrt(shift * gravity)
        load = [omega**2 * f(bottom) + gravity * (-slope) * g(bottom) for f, g in ((j0, j1), (y0, y1))]
        return float(load[0] * y0(top) - load[1] * j0(top))

    places = np.linspace(0.5, 60.0, 4000)
    values = [determinant(place) for place in places]
    exact = [
        brentq(determinant, places[k], places[k + 1], xtol=1e-14)
        for k in range(len(places) - 1)
        if values[k] * values[k + 1] < 0.0
    ]
    assert found == pytest.approx(exact[:6], rel=1e-10)


@pytest.mark.slow
def test_a_heavy_load_swings_like_a_pendulum() -> None:
    # M ≫ ρl: ω² → g/l (1 + …ρl/M). Waves run along a string so tight in 0.001 s.
    overrides = ("output.times=[0.0, 0.003]", "accuracy.tolerance=1e-3", "accuracy.modes=1", "string.tip_mass=5000.0")
    found = omegas(solved("string_smooth", "string.resistance=0", *overrides))[0]
    assert found == pytest.approx(np.sqrt(9.81), rel=0.05 / 5000.0)


def decay(resistance: str, output: str) -> float:
    result = solved("string_smooth", f"string.resistance={resistance}", output, "accuracy.tolerance=1e-3")
    return float(result.summary["modes"][0]["decay"])


@pytest.mark.slow
def test_slightly_varied_resistance_is_first_order() -> None:
    # Of λ = λ₀ + ε(x/l − ½)·2: twice the variation changes the root twice as much.
    rates = [decay(f"{{bottom={0.025 - step}, top={0.025 + step}}}", SHORT) for step in (0.0, 1e-4, 2e-4)]
    first, second = rates[1] - rates[0], rates[2] - rates[0]
    assert abs(second / first - 2.0) < 1e-2
    # The lower end moves most, so that less resistance there lets the motion last longer.
    assert first < 0.0
    assert decay("{bottom=0.1, top=0.0}", NO_MOTION) > 1.5 * decay("{bottom=0.0, top=0.1}", NO_MOTION)


@pytest.mark.slow
def test_compare_sets_both_side_by_side() -> None:
    ran = run_command("compare", "string_smooth", "--set", SHORT, "--set", "accuracy.tolerance=1e-4")
    assert ran.exit_code == 0
    # The comparison alone, first of all.
    assert ran.output.splitlines()[1] == "The field solution beside the series"
    refused = run_command("compare", "string_with_load")
    assert refused.exit_code == 2
    assert "no series to compare with" in refused.output


@pytest.mark.slow
@pytest.mark.slow_on_ranks_but
@pytest.mark.mpi
def test_nothing_moves_before_the_front_in_a_field_either() -> None:
    result = solved("string_ramp", "output.times=[0.0, 0.1]", "accuracy.tolerance=1e-3")
    assert result.summary["status"] == "ok"
    moved = result.dataset.displacement
    assert np.all(moved.sel(time=0.0) == 0.0)
    assert np.all(moved.sel(time=0.1).values[result.dataset.position.values < 0.6] == 0.0)


def test_compare_keeps_the_limits_of_the_field() -> None:
    refused = run_command("compare", "string_ramp", "--set", "output.times=[6000.0]")
    assert refused.exit_code == 2
    assert "travel times of a wave" in refused.output
