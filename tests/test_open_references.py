"""The references of open water are true: against published values, energy, limits, other methods, and themselves."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import open_circle
import pytest

FOLDER = Path(__file__).parent / "reference"


def stored(name: str) -> dict[str, Any]:
    content: dict[str, Any] = json.loads((FOLDER / name).read_text(encoding="utf-8"))
    return content


PUBLISHED = stored("open_water.json")
CIRCLE = stored("open_circle.json")


@pytest.mark.parametrize("row", PUBLISHED["cylinder"]["rows"], ids=lambda row: f"Ka={row['Ka']}")
def test_circle_as_published(row: dict[str, Any]) -> None:
    heave, sway = (open_circle.radiation(row["Ka"], motion, 80).impedance for motion in open_circle.MOTIONS)
    found = [heave.real, heave.imag, sway.real, sway.imag]
    # The rows have an absolute error of 1e-6; measured: 1.4e-7.
    np.testing.assert_allclose(found, [row[key] for key in ("heave_a", "heave_b", "sway_a", "sway_b")], atol=3e-7)


@pytest.mark.parametrize("row", CIRCLE["radiation"], ids=lambda row: f"Ka={row['Ka']}")
def test_stored_circle_is_made_anew(row: dict[str, Any]) -> None:
    assert row["error"] <= 3e-12
    for motion in open_circle.MOTIONS:
        result = open_circle.radiation(row["Ka"], motion, 160)
        # Measured: 2e-10 at Ka = 10 (sway).
        assert result.impedance == pytest.approx(complex(row[f"{motion}_a"], row[f"{motion}_b"]), abs=1e-9)
        # The waves carry what the motion loses.
        assert result.impedance.imag == pytest.approx(result.flux_damping, abs=1e-9)


def test_circle_at_high_frequency() -> None:
    # ψ = 0 on the water: a' = 1 and 4/π²; the next term is of the order 1/Ka.
    heave, sway = (open_circle.radiation(400.0, motion, 400).impedance for motion in open_circle.MOTIONS)
    assert heave.real == pytest.approx(1.0, abs=2 / 400)
    assert sway.real == pytest.approx(4 / math.pi**2, abs=2 / 400)


def test_circle_at_low_frequency() -> None:
    # a' + (8/π²) ln Ka tends to a constant, like Ka ln² Ka.
    sums = [
        open_circle.radiation(ka, "heave", 40).impedance.real + 8 / math.pi**2 * math.log(ka) for ka in (1e-6, 1e-5)
    ]
    assert sums[0] == pytest.approx(sums[1], abs=1e-3)


def test_resonance_of_the_circle() -> None:
    resonance = CIRCLE["resonance"]
    found = open_circle.resonance(80)
    assert found == pytest.approx(complex(resonance["omega"], -resonance["gamma"]), abs=1e-10)


def test_released_circle() -> None:
    times, values = np.array(CIRCLE["release"]["t"]), np.array(CIRCLE["release"]["s"])
    found = open_circle.release(np.concatenate([[0.0, 0.02], times]), 32)
    # Measured with 32 multipoles: 8e-10. s(0) = 1 is the energy balance, s''(0) = −c/(m + a(∞)) = −2/π.
    np.testing.assert_allclose(found[2:], values, atol=5e-9)
    assert found[0] == pytest.approx(1.0, abs=5e-9)
    assert (found[1] - 1) * 2 / 0.02**2 == pytest.approx(-2 / math.pi, abs=1e-4)
    # Ursell 1964: −(4/π)/t², the next term is of the order ln t/t⁴.
    assert values[-1] * times[-1] ** 2 == pytest.approx(-4 / math.pi, rel=1e-3)


def test_release_is_its_resonance_and_its_tail() -> None:
    omega = open_circle.resonance(80)
    slope = (_deficit_of_release(omega + 1e-4) - _deficit_of_release(omega - 1e-4)) / 2e-4
    times = np.array([10.0, 20.0, 30.0])
    # The residue of c/(ω D(ω)), D = c − ω²(1 + h), at both resonances ±ω − iγ; the rest is the algebraic tail.
    oscillation = -2 * np.real(4 / math.pi / (omega * slope) * np.exp(-1j * omega * times))
    rest = open_circle.release(times, 32) - oscillation
    np.testing.assert_allclose(rest * times**2, -4 / math.pi, rtol=1e-3)


def _deficit_of_release(omega: complex) -> complex:
    return 4 / math.pi - omega**2 * (1 + open_circle.radiation(omega**2, "heave", 80).impedance)
