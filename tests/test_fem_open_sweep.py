"""A sweep over frequencies is as accurate as a solution at each, and causal."""

from __future__ import annotations

import math

import numpy as np
import open_circle
import pytest
from open_cases import (
    DENSITY,
    DISPLACED,
    RADIUS,
    SLOW,
    TOO_SMALL,
    circle,
    circle_omega,
    radiation,
)

from hydroelastic.fem.open_water.radiation import RadiationSolution
from hydroelastic.fem.open_water.solver import OpenSolver
from hydroelastic.fem.stopwatch import Stopwatch


@pytest.fixture(scope="module")
def swept() -> RadiationSolution:
    """64 frequencies of the circle on a reduced basis, equal ratios of Ka."""
    return radiation(circle(1e-6), *map(float, np.geomspace(circle_omega(0.01), circle_omega(10.0), 64)), math.inf)


@SLOW
def test_sweep_is_as_accurate_as_it_says(swept: RadiationSolution) -> None:
    table = swept.table
    omegas = table.omega[:-1]
    matrices = (table.added_mass + 1j * table.radiation_damping / table.omega[:, None, None])[:-1] / DISPLACED
    order = [table.dofs.index(motion) for motion in ("heave", "sway")]
    found = np.diagonal(matrices, axis1=1, axis2=2)[:, order]
    exact = np.array(
        [
            [
                open_circle.radiation(float(omega) ** 2 * RADIUS / 9.81, motion, 80).impedance
                for motion in ("heave", "sway")
            ]
            for omega in omegas
        ]
    )
    errors = np.abs(found / exact - 1.0).max(axis=1)
    assert errors.max() <= 1e-6
    # Measured: 1.05.
    assert np.all(errors <= TOO_SMALL * table.relative_error[:-1])
    assert table.factorizations < 40


@SLOW
def test_sweep_is_what_is_found_in_full(swept: RadiationSolution) -> None:
    assert swept.model is not None
    solver = OpenSolver(swept.model, Stopwatch())
    table = swept.table
    for place in range(0, 64, 3):
        full = solver.frequency(float(table.omega[place]))
        matrix = swept.model.scale.masses(full.hydrodynamic)
        found = table.added_mass[place] + 1j * table.radiation_damping[place] / table.omega[place]
        # The reduced basis is given a tenth of the tolerance by its estimate: measured 1.06 of that.
        assert np.abs(found - matrix).max() <= 1.5e-7 * np.abs(matrix).max()


@SLOW
def test_added_mass_is_the_hilbert_transform_of_damping(swept: RadiationSolution) -> None:
    table = swept.table
    omegas = table.omega[:-1]
    for motion in (0, 1):
        limit = table.added_mass[-1, motion, motion]
        damping = table.radiation_damping[:-1, motion, motion]
        for place in range(16, 48, 6):
            own = omegas[place]
            # PV∫dω'/(ω'² − ω²) = 0 takes the pole away; b = 0 at ω = 0, and above it falls by a power.
            rest = hilbert_rest(omegas, damping, place, 4.0 * DENSITY * RADIUS**2 if motion == 0 else 0.0)
            # Both tails: measured 6e-4 of the displaced mass.
            assert table.added_mass[place, motion, motion] - limit == pytest.approx(rest, abs=1e-3 * DISPLACED), own


def hilbert_rest(omegas: np.ndarray, damping: np.ndarray, place: int, limit: float) -> float:
    """(2/π)∫₀^∞ (b(ω') − b(ω))/(ω'² − ω²) dω' from b at some frequencies, and from the limit of b/ω at ω = 0."""
    from scipy.interpolate import CubicSpline

    own, value = omegas[place], damping[place]
    spline = CubicSpline(np.log(omegas), damping)
    nodes, weights = np.polynomial.legendre.leggauss(8)
    edges = np.log(omegas)
    half = np.diff(edges)[:, None] / 2.0
    u = (edges[:-1, None] + half * (1.0 + nodes)).ravel()
    x = np.exp(u)
    inner = (half * weights).ravel() * x @ ((spline(u) - value) / (x**2 - own**2))
    low, high = omegas[0], omegas[-1]
    # Below: b/ω goes to its limit like ω². Above: b ~ b(high) (ω/high)^(−p).
    t, w = (nodes + 1.0) / 2.0, weights / 2.0
    slope = limit + (damping[0] / low - limit) * t**2
    below = low * (w @ ((slope * low * t - value) / ((low * t) ** 2 - own**2)))
    power = -math.log(damping[-1] / damping[-2]) / math.log(omegas[-1] / omegas[-2])
    above = high * (w @ ((damping[-1] * t**power - value) / (high**2 - (own * t) ** 2)))
    return float(2.0 / math.pi * (inner + below + above))
