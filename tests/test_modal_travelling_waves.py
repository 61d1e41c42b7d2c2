"""Travelling waves of one liquid or two: conditions of their profiles, their energy, the speed at which it moves."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss

from hydroelastic.modal.liquid.travelling_waves import TravellingWave, travelling_waves
from hydroelastic.modal.liquid.two_layer import TwoLayers, interface_frequencies

DEEP = math.inf
LIQUIDS = {
    "deep": TwoLayers(density_below=1000.0, depth_below=DEEP, gravity=9.81),
    "shallow": TwoLayers(density_below=1025.0, depth_below=0.3, gravity=9.81),
    "lid": TwoLayers(density_below=1000.0, density_above=800.0, depth_below=2.0, depth_above=0.5, gravity=9.81),
    "deep below a lid": TwoLayers(
        density_below=1000.0, density_above=900.0, depth_below=DEEP, depth_above=0.4, gravity=9.81
    ),
    "both deep": TwoLayers(density_below=1000.0, density_above=500.0, depth_below=DEEP, depth_above=DEEP, gravity=9.81),
    "free top": TwoLayers(
        density_below=1000.0, density_above=500.0, depth_below=1.2, depth_above=0.5, gravity=9.81, top="free"
    ),
    "almost equal": TwoLayers(
        density_below=1000.0, density_above=999.0, depth_below=1.0, depth_above=0.4, gravity=9.81, top="free"
    ),
    "free top, deep": TwoLayers(
        density_below=1000.0, density_above=700.0, depth_below=DEEP, depth_above=0.6, gravity=9.81, top="free"
    ),
}
OMEGAS = (0.3, 1.5, 6.0)


def waves() -> list[object]:
    found = []
    for name, layers in LIQUIDS.items():
        for omega in OMEGAS:
            for wave in travelling_waves(layers, omega):
                found.append(pytest.param(wave, id=f"{name}-{omega}-{wave.branch}"))
    return found


WAVES = pytest.mark.parametrize("wave", waves())


def scale_of(wave: TravellingWave) -> float:
    """The largest slope of a profile, at one of the levels that move."""
    two = wave.layers.density_above > 0.0 and math.isfinite(wave.layers.depth_above)
    return max(abs(wave.elevation), abs(wave.top_elevation) if two else 0.0)


@WAVES
def test_surfaces_move_as_pressure_tells(wave: TravellingWave) -> None:
    layers, squared = wave.layers, wave.omega**2
    below, slope_below = (float(part) for part in wave.profile(0.0))
    above, slope_above = (float(part) for part in wave.profile(0.0, above=True)) if layers.density_above else (0.0, 0.0)
    restoring = (layers.density_below - layers.density_above) * layers.gravity
    forces = squared * (layers.density_below * below - layers.density_above * above)
    # Of liquids almost equal both sides are small differences of what belongs to one of them.
    magnitude = squared * layers.density_below * max(abs(below), abs(above)) + restoring * abs(slope_below)
    assert restoring * slope_below == pytest.approx(forces, abs=1e-12 * magnitude)
    if layers.density_above:
        assert slope_above == pytest.approx(slope_below, abs=1e-13 * scale_of(wave))
    if layers.density_above and math.isfinite(layers.depth_above):
        top, top_slope = (float(part) for part in wave.profile(layers.depth_above, above=True))
        expected = squared * top / layers.gravity if layers.top == "free" else 0.0
        assert top_slope == pytest.approx(expected, abs=1e-12 * scale_of(wave))
    if math.isfinite(layers.depth_below):
        assert wave.profile(-layers.depth_below)[1] == pytest.approx(0.0, abs=1e-13 * scale_of(wave))


@WAVES
def test_profile_is_harmonic(wave: TravellingWave) -> None:
    # Z'' = k²Z by Gauss–Legendre: the change of Z' is k²∫Z, and that of Z is ∫Z'.
    for low, high, above in parts(wave):
        y, weights = gauss(low, high, wave.wavenumber)
        value, slope = wave.profile(y, above=above)
        ends = [wave.profile(edge, above=above) for edge in (low, high)]
        unit = np.abs(value).max()
        assert ends[1][0] - ends[0][0] == pytest.approx(weights @ slope, abs=1e-12 * unit)
        change = wave.wavenumber**2 * (weights @ value)
        assert ends[1][1] - ends[0][1] == pytest.approx(change, abs=1e-12 * unit * wave.wavenumber * len(y))


@WAVES
def test_energy_is_its_integral(wave: TravellingWave) -> None:
    total = 0.0
    for low, high, above in parts(wave):
        y, weights = gauss(low, high, wave.wavenumber)
        density = wave.layers.density_above if above else wave.layers.density_below
        total += density * (weights @ wave.profile(y, above=above)[0] ** 2)
    # Closed form: differences of products of the order of N lose few digits.
    assert wave.energy == pytest.approx(total, rel=1e-11)


@WAVES
def test_energy_moves_with_the_group_velocity(wave: TravellingWave) -> None:
    layers, k = wave.layers, wave.wavenumber
    potential = (layers.density_below - layers.density_above) * layers.gravity * wave.elevation**2
    if layers.density_above and layers.top == "free":
        potential += layers.density_above * layers.gravity * wave.top_elevation**2
    # The mean energy is twice the mean potential energy; the power is ½ω³kN.
    speed = wave.omega**3 * k * wave.energy / potential
    step = 1e-3 * k
    ahead = [float(interface_frequencies(layers, k + part * step)[wave.branch]) for part in (-2, -1, 1, 2)]
    # Central differences of the fourth order: 1e-12 of truncation, 1e-12 of rounding.
    slope = (ahead[0] - 8.0 * ahead[1] + 8.0 * ahead[2] - ahead[3]) / (12.0 * step)
    assert speed == pytest.approx(slope, rel=1e-9)


@pytest.mark.parametrize("name", LIQUIDS)
def test_as_many_waves_as_surfaces(name: str) -> None:
    layers = LIQUIDS[name]
    found = travelling_waves(layers, 2.0)
    assert [wave.branch for wave in found] == list(layers.branches)
    for wave in found:
        assert float(interface_frequencies(layers, wave.wavenumber)[wave.branch]) == pytest.approx(2.0, rel=1e-14)


def test_no_waves_at_rest() -> None:
    with pytest.raises(ValueError, match="omega"):
        travelling_waves(LIQUIDS["deep"], 0.0)


def parts(wave: TravellingWave) -> list[tuple[float, float, bool]]:
    """Stretches of y; an infinitely deep liquid to where e^{−2ky} is rounding."""
    layers = wave.layers
    far = 20.0 / wave.wavenumber
    found = [(-min(layers.depth_below, far) if math.isinf(layers.depth_below) else -layers.depth_below, 0.0, False)]
    if layers.density_above:
        found.append((0.0, far if math.isinf(layers.depth_above) else layers.depth_above, True))
    return found


def gauss(low: float, high: float, k: float) -> tuple[np.ndarray, np.ndarray]:
    nodes, weights = leggauss(20)
    edges = np.linspace(low, high, 2 + int(k * (high - low) / 2.0))
    half = np.diff(edges)[:, None] / 2.0
    return (edges[:-1, None] + half * (1.0 + nodes)).ravel(), (half * weights).ravel()
