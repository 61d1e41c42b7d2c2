"""Field solutions of hanging strings in scenes, beside the series where there is one, and beside other theories."""

import numpy as np
import pytest
from click.testing import CliRunner
from mpi4py import MPI
from scipy.optimize import brentq
from scipy.special import j0, j1, y0, y1

from hydroelastic.modal.string.solution import StringSolution
from hydroelastic.scenes.command_line import main
from hydroelastic.scenes.models.string import StringScene
from hydroelastic.scenes.read import read_scene
from hydroelastic.scenes.string.solve import solve_series, solve_string_field

# Of free motions alone.
NO_MOTION = "output.times=[0.0, 0.01]"
SHORT = "output={positions=[0.0, 0.09, 0.36, 0.81, 1.0], times={start=0, stop=1.5, number=16}}"


def scene_of(name: str, *overrides: str) -> StringScene:
    scene = read_scene(name, overrides)
    assert isinstance(scene, StringScene)
    return scene


def field(scene: StringScene) -> StringSolution:
    accuracy = scene.accuracy.model_copy(update={"method": "field"})
    return solve_string_field(scene.model_copy(update={"accuracy": accuracy}), MPI.COMM_WORLD)


@pytest.mark.slow_but("string_ramp-0.001")
@pytest.mark.parametrize("tolerance", [1e-3, 1e-5])
@pytest.mark.parametrize("name", ["string_smooth", "string_ramp", "string_sine"])
def test_field_and_series_agree_within_the_estimate(name: str, tolerance: float) -> None:
    solution = field(scene_of(name, SHORT, f"accuracy.tolerance={tolerance}"))
    assert solution.converged
    exact = solve_series(scene_of(name, SHORT, "accuracy.tolerance=1e-12"))
    error = np.abs(solution.displacement - exact.displacement)[~solution.beside_fronts]
    assert error.max() < tolerance * exact.largest
    # An estimate is never below a third of the true error.
    assert np.all(error <= 3.0 * solution.absolute_error[~solution.beside_fronts] + 1e-13)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["string_step", "string_table"])
def test_field_and_series_agree_on_long_responses(name: str) -> None:
    solution = field(scene_of(name, "accuracy.tolerance=1e-4"))
    exact = solve_series(scene_of(name, "accuracy.tolerance=1e-12"))
    error = np.abs(solution.displacement - exact.displacement)[~solution.beside_fronts]
    assert error.max() < 1e-4 * exact.largest
    assert np.all(error <= 3.0 * solution.absolute_error[~solution.beside_fronts] + 1e-13)


@pytest.mark.slow
def test_smooth_motion_to_seven_digits() -> None:
    solution = field(scene_of("string_smooth", SHORT, "accuracy.tolerance=1e-7"))
    exact = solve_series(scene_of("string_smooth", SHORT, "accuracy.tolerance=1e-12"))
    error = np.abs(solution.displacement - exact.displacement)[~solution.beside_fronts]
    assert error.max() < 1e-7 * exact.largest
    assert solution.converged


def test_free_motions_of_both_methods_are_one_list() -> None:
    # Heavy damping: two aperiodic modes, both of whose roots count.
    overrides = ("string.resistance=0.5", NO_MOTION, "accuracy.tolerance=1e-3", "accuracy.modes=8")
    by_field, by_series = (
        field(scene_of("string_smooth", *overrides)),
        solve_series(scene_of("string_smooth", *overrides)),
    )
    assert np.sum(by_series.free_motions.roots.imag == 0.0) == 4
    assert by_field.free_motions.roots == pytest.approx(by_series.free_motions.roots, rel=1e-11)
    # Mode shapes up to their size: 1 at the free end, where all are largest.
    assert by_field.free_motions.shapes == pytest.approx(by_series.free_motions.shapes, abs=1e-9)


@pytest.mark.slow_on_ranks_but
@pytest.mark.mpi
def test_a_load_on_the_end_changes_frequencies_as_bessel_functions_say() -> None:
    overrides = (
        "string.resistance=0",
        NO_MOTION,
        "accuracy.tolerance=1e-3",
        "accuracy.modes=6",
        "string.tip_mass=0.02",
    )
    found = field(scene_of("string_smooth", *overrides)).free_motions.frequencies
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
    # M ≫ ρl: ω² → g/l (1 + …ρl/M).
    # Waves run along a string so tight in 0.001 s.
    overrides = ("output.times=[0.0, 0.003]", "accuracy.tolerance=1e-3", "accuracy.modes=1", "string.tip_mass=5000.0")
    found = field(scene_of("string_smooth", "string.resistance=0", *overrides)).free_motions.frequencies[0]
    assert found == pytest.approx(np.sqrt(9.81), rel=0.05 / 5000.0)


@pytest.mark.slow
def test_slightly_varied_resistance_is_first_order() -> None:
    # p₁ of λ = λ₀ + ε(x/l − ½)·2: dp = −p ∫(dλ/ρ)φ²/(p + α)∫φ² … ; twice the variation changes p twice as much.
    change = []
    for step in (0.0, 1e-4, 2e-4):
        given = f"string.resistance={{bottom={0.025 - step}, top={0.025 + step}}}"
        change.append(field(scene_of("string_smooth", given, SHORT, "accuracy.tolerance=1e-3")).free_motions.roots[0])
    first, second = change[1] - change[0], change[2] - change[0]
    assert abs(second / first - 2.0) < 1e-2
    # The lower end moves most, so that less resistance there lets the motion last longer.
    assert first.real > 0.0


@pytest.mark.slow
def test_resistance_below_counts_more_than_above() -> None:
    below = field(
        scene_of("string_smooth", "string.resistance={bottom=0.1, top=0.0}", NO_MOTION, "accuracy.tolerance=1e-3")
    )
    above = field(
        scene_of("string_smooth", "string.resistance={bottom=0.0, top=0.1}", NO_MOTION, "accuracy.tolerance=1e-3")
    )
    assert below.free_motions.roots[0].real < 1.5 * above.free_motions.roots[0].real


@pytest.mark.slow
def test_compare_sets_both_side_by_side() -> None:
    asked = ["compare", "string_smooth", "--set", SHORT, "--set", "accuracy.tolerance=1e-4"]
    ran = CliRunner().invoke(main, asked)
    assert ran.exit_code == 0
    # The comparison alone, first of all.
    assert ran.output.splitlines()[1] == "The field solution beside the series"
    assert "Free motions" not in ran.output
    refused = CliRunner().invoke(main, ["compare", "string_with_load"])
    assert refused.exit_code == 2
    assert "no series to compare with" in refused.output


@pytest.mark.slow
@pytest.mark.slow_on_ranks_but
@pytest.mark.mpi
def test_nothing_moves_before_the_front_in_a_field_either() -> None:
    solution = field(scene_of("string_ramp", "output.times=[0.0, 0.1]", "accuracy.tolerance=1e-3"))
    assert solution.converged
    assert np.all(solution.displacement[:, 0] == 0.0)
    assert np.all(solution.displacement[solution.positions < 0.6, 1] == 0.0)


@pytest.mark.slow
def test_values_beside_fronts_alone_are_judged() -> None:
    scene = scene_of(
        "string_step", "string.tip_mass=1.0", "output.positions=[1e-9]", "output.times=[2.0]", "accuracy.tolerance=1e-3"
    )
    beside = scene.string.physical.travel_time * 1.001
    solution = field(scene_of("string_step", "string.tip_mass=1.0", "output.positions=[1e-9]",
                              f"output.times=[{beside!r}]", "accuracy.tolerance=1e-3"))  # fmt: skip
    assert solution.beside_fronts.all()
    assert np.isfinite(solution.absolute_error).all()
    assert not solution.converged


def test_compare_keeps_the_limits_of_the_field() -> None:
    refused = CliRunner().invoke(main, ["compare", "string_ramp", "--set", "output.times=[6000.0]"])
    assert refused.exit_code == 2
    assert "travel times of a wave" in refused.output
