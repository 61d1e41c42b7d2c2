"""Closed-form modes of threads in water at rest and in a stream along them."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from thread_cases import CASES, inputs, results, tolerance

from hydroelastic.modal.thread.axial_flow import AxialFlowBeam, Ends, string_in_axial_flow
from hydroelastic.modal.thread.modes import (
    chain_frequencies,
    irvine_parameter,
    sagging_cable_frequencies,
    tensioned_beam_frequencies,
)


def test_taut_string() -> None:
    given = inputs("M01")
    found = tensioned_beam_frequencies(given["L"], given["T"], given["m"] + given["ma"], 5)
    assert found == pytest.approx(results("M01")["omega"], rel=tolerance("M01"))
    # A beam: ω² = k²(T + EI k²)/m, here k = 1.
    assert tensioned_beam_frequencies(math.pi, 3.0, 2.0, 1, 5.0) == pytest.approx([2.0])


def test_chain_with_a_body() -> None:
    given = inputs("M03")
    found = chain_frequencies(given["L"], given["w"], given["m"] + given["ma"], 4, given["W_tip"], given["M_tip"])
    assert found == pytest.approx(results("M03")["omega"], rel=tolerance("M03"))


def swung(omega: float, weight: float, tip_weight: float, tip_mass: float) -> np.ndarray:
    """Return v up a chain of length 3 and mass 1.5 that swings with ω and v = 1 at the tip, by integration."""

    def slope(height: float, y: np.ndarray) -> list[float]:
        return [y[1] / (tip_weight + weight * height), -1.5 * omega**2 * y[0]]

    # y is v and T dv/dζ, which is −M ω² v at the tip.
    begin, heights = [1.0, -tip_mass * omega**2], np.linspace(0, 3.0, 400)
    solved = solve_ivp(slope, (0, 3.0), begin, "DOP853", rtol=1e-11, atol=1e-13, t_eval=heights)
    return np.asarray(solved.y[0])


@pytest.mark.parametrize(("weight", "tip_weight", "tip_mass"), [(2.0, 1e-2, 3.0), (2.0, 500.0, 0.0), (1e-3, 40.0, 7.0)])
def test_chains_with_light_and_heavy_bodies(weight: float, tip_weight: float, tip_mass: float) -> None:
    for number, omega in enumerate(chain_frequencies(3.0, weight, 1.5, 6, tip_weight, tip_mass)):
        below, above = (swung(omega * (1 + off), weight, tip_weight, tip_mass) for off in (-1e-7, 1e-7))
        assert below[-1] * above[-1] < 0
        # Each mode has one node more than the one below: none is missing.
        assert np.sum(np.diff(np.sign(below)) != 0) == number


def test_chain_without_a_body_is_the_limit_of_a_light_one() -> None:
    bare, light = chain_frequencies(2.0, 3.0, 0.7, 5), chain_frequencies(2.0, 3.0, 0.7, 5, 1e-9, 1e-10)
    assert bare[0] == pytest.approx(2.404825557695773 / 2 * math.sqrt(3 / 1.4), rel=1e-14)
    assert light == pytest.approx(bare, rel=1e-8)


@pytest.mark.parametrize("name", ["M05a", "M05c"])
def test_sagging_cable(name: str) -> None:
    given = inputs(name)
    assert irvine_parameter(1.0, given["w"], given["H"], given["EA"]) == pytest.approx(10.0, rel=1e-12)
    found = sagging_cable_frequencies(1.0, given["H"], given["m"], 10.0, 4)
    assert found == pytest.approx(CASES[name]["checks"]["irvine_caughey_approximation"], rel=tolerance("M05a"))


def test_sagging_cable_is_of_second_order_in_the_sag() -> None:
    found = sagging_cable_frequencies(1.0, 1.0, 1.0, 10.0, 2)
    errors = [np.array(results(name)["omega"][:2]) - found for name in ("M05a", "M05c")]
    # Sag 0.02 and 0.005: a ratio of 4² for the second order; their next one is 16 times smaller.
    assert np.divide(*errors) == pytest.approx([16.0, 16.0], rel=0.02)


def test_limits_of_the_sagging_cable() -> None:
    rigid = sagging_cable_frequencies(1.0, 1.0, 1.0, math.inf, 4)
    assert rigid == pytest.approx([2 * math.pi, 8.98682, 4 * math.pi, 15.45050], abs=6e-6)
    string = tensioned_beam_frequencies(2.0, 5.0, 3.0, 6)
    assert sagging_cable_frequencies(2.0, 5.0, 3.0, 0.0, 6) == pytest.approx(string, rel=1e-14)
    assert sagging_cable_frequencies(2.0, 5.0, 3.0, 9.0, 6, out_of_plane=True) == pytest.approx(string, rel=1e-14)
    # A little stretch raises the first by 4λ²/π⁴ of it at once.
    for irvine in (1e-10, 1e-5):
        found = sagging_cable_frequencies(1.0, 1.0, 1.0, irvine, 1)[0] / math.pi - 1
        assert found == pytest.approx(4 * irvine / math.pi**4, rel=1e-3, abs=1e-15)


@pytest.mark.parametrize("name", ["M07a", "M07c"])
def test_string_in_axial_flow(name: str) -> None:
    given = inputs(name)
    found = string_in_axial_flow(given["L"], given["T"], given["m"], given["M"], given["U"], 2)
    expected = [complex(*pair) for pair in results(name)["lam"]]
    assert found == pytest.approx(expected, rel=1e-12)


def test_string_in_axial_flow_diverges_at_once_and_is_gyroscopic_above() -> None:
    assert (string_in_axial_flow(1.0, 4.0, 1.0, 1.0, 2.0, 5) == 0).all()
    assert (string_in_axial_flow(1.0, 4.0, 1.0, 1.0, 2.5, 5).real == 0).all()
    with pytest.raises(ValueError, match="infinitely fast"):
        string_in_axial_flow(1.0, 8.0, 1.0, 1.0, 4.0, 1)


def beam(ends: Ends, ratio: float, tension: float = 0.0, taper: float = 0.0) -> AxialFlowBeam:
    """Return a beam of length 2 with EI = 3, and m + m_a = 5."""
    return AxialFlowBeam(
        length=2.0,
        flexural_rigidity=3.0,
        mass=5.0 * (1 - ratio),
        added_mass=5.0 * ratio,
        tension=tension,
        ends=ends,
        taper=taper,
    )


def test_flutter_of_a_clamped_free_beam() -> None:
    for ratio in (0.2, 0.5):
        free = beam("clamped-free", ratio)
        speed, omega = free.flutter()
        # Both methods of the reference agree to 8 digits, this one with the determinant to all 12.
        known = results("M09")[f"beta={ratio}"]
        assert [speed / free.speed_unit, omega / free.rate_unit] == pytest.approx(known, rel=2e-12)


@pytest.mark.parametrize(("ratio", "speed"), [(0.1, 6.39412), (0.3, 6.28439), (0.5, 6.30388), (0.8, 6.39072)])
def test_coupled_flutter_of_a_pinned_beam(ratio: float, speed: float) -> None:
    pinned = beam("pinned", ratio)
    assert pinned.flutter()[0] / pinned.speed_unit == pytest.approx(speed, abs=5.5e-6)
    # At β = 0.1 and 0.3 two motions merge that grow without oscillation, at 0.5 and 0.8 two oscillations.
    assert (pinned.flutter()[1] == 0) == (ratio < 0.4)


@pytest.mark.parametrize("ends", ["pinned", "clamped"])
@pytest.mark.parametrize("tension", [0.0, 4.0])
def test_divergence(ends: Ends, tension: float) -> None:
    for ratio in (0.1, 0.7):
        held = beam(ends, ratio, tension)
        speed = held.divergence_speed()
        assert (held.exponents(0.9999 * speed, 3).real < 1e-6 * held.rate_unit).all()
        assert held.exponents(1.0001 * speed, 3).real.max() > 1e-2 * held.rate_unit


def test_beam_without_a_stream() -> None:
    pinned = beam("pinned", 0.4, 4.0)
    expected = tensioned_beam_frequencies(2.0, 4.0, 5.0, 6, 3.0)
    assert pinned.exponents(0.0, 6).imag == pytest.approx(expected, rel=1e-10)
    # cosh κ cos κ = ±1.
    for ends, roots in (
        ("clamped", (4.730040744862704, 7.853204624095838)),
        ("clamped-free", (1.8751040687, 4.6940911)),
    ):
        still = beam(ends, 0.4)  # type: ignore[arg-type]
        assert still.exponents(0.0, 2).imag / still.rate_unit == pytest.approx(np.square(roots), rel=1e-7)


def test_free_end_damps_below_flutter_only_if_it_is_blunt() -> None:
    blunt, tapered = beam("clamped-free", 0.2), beam("clamped-free", 0.2, taper=1.0)
    assert (blunt.exponents(3 * blunt.speed_unit, 3).real < -0.1 * blunt.rate_unit).all()
    assert np.abs(tapered.exponents(0.5 * tapered.speed_unit, 3).real).max() < 1e-9 * tapered.rate_unit


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: tensioned_beam_frequencies(0.0, 1.0, 1.0, 1), "length is 0"),
        (lambda: tensioned_beam_frequencies(1.0, 1.0, 1.0, 0), "count is 0"),
        (lambda: tensioned_beam_frequencies(1.0, 1.0, 1.0, 1, -1.0), "flexural_rigidity is -1"),
        (lambda: chain_frequencies(1.0, -1.0, 1.0, 1), "weight is -1"),
        (lambda: chain_frequencies(1.0, 1.0, 1.0, 1, 0.0, 1.0), "tip_weight is 0"),
        (lambda: chain_frequencies(1.0, 1.0, 1.0, 1, 1.0, -1.0), "tip_mass is -1"),
        (lambda: irvine_parameter(1.0, 1.0, 1.0, 0.0), "axial_rigidity is 0"),
        (lambda: sagging_cable_frequencies(1.0, 1.0, 1.0, -1.0, 1), "irvine is -1"),
        (lambda: string_in_axial_flow(1.0, 0.0, 1.0, 1.0, 1.0, 1), "tension is 0"),
        (lambda: beam("pinned", 1.0), "mass is 0"),
        (lambda: beam("hinged", 0.5), "ends is 'hinged'"),  # type: ignore[arg-type]
        (lambda: beam("pinned", 0.5, taper=2.0), "taper is 2"),
        (lambda: beam("pinned", 0.5).exponents(1.0, 99), "count is 99"),
        (lambda: beam("clamped-free", 0.5).divergence_speed(), "pinned and clamped"),
    ],
)
def test_refuses(make: Callable[[], object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        make()
