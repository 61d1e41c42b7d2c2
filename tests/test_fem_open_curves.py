"""Curves between the requested frequencies: they meet the tables, and solutions at frequencies of their own."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from solids_at_sea import problem_of, solved

from hydroelastic.fem.open_water.plan_waves import plan_waves
from hydroelastic.fem.open_water.requests import ResponseRequest
from hydroelastic.fem.open_water.results import ResponseTable

TOLERANCE = 1e-3
# A spar on a plate pitches with next to no damping, between two of these frequencies.
SPAR: dict[str, Any] = {
    "shape": "cylinder",
    "radius": 1.0,
    "draught": 4.0,
    "vertical_centre_of_gravity": -2.5,
    "radius_of_gyration": 2.0,
}
OMEGAS = tuple(np.linspace(0.6, 2.4, 7))


def response(*omegas: float, **further: Any) -> ResponseTable:
    (found,) = solved([SPAR], 20.0, TOLERANCE, ResponseRequest(omega=omegas, **further)).response
    return found


@pytest.fixture(scope="module")
def table() -> ResponseTable:
    return response(*OMEGAS)


def test_curves_of_all_orders_are_joined(table: ResponseTable) -> None:
    """At the frequencies asked for they are the table; halfway between two of theirs they are a solution there."""
    curve = table.curve
    assert curve is not None
    assert curve.dofs == table.dofs
    assert curve.partial_waves is not None
    assert table.partial_waves is not None
    own = np.searchsorted(curve.omega, table.omega)
    np.testing.assert_array_equal(curve.omega[own], table.omega)
    largest = np.abs(curve.amplitudes[:, 0]).max(axis=0)
    # Both have the error of the reduced basis, a tenth of the tolerance, or none.
    for one, other in ((curve.amplitudes, table.amplitudes), (curve.partial_waves, table.partial_waves)):
        np.testing.assert_allclose(one[own], other, atol=TOLERANCE * np.abs(other).max())
    middles = 0.5 * (curve.omega[[20, 60]] + curve.omega[[21, 61]])
    between = response(*middles)
    drawn = [np.interp(middles, curve.omega, one) for one in np.abs(curve.amplitudes[:, 0]).T]
    # Splines through the curve miss a thousandth of the largest, straight lines some thousandths.
    missed = np.abs(np.array(drawn).T - np.abs(between.amplitudes[:, 0]))
    assert (missed < 0.01 * largest).all()


def test_no_resonance_is_cut_off(table: ResponseTable) -> None:
    """The curve reaches the peak of pitch, which no frequency of the table shows."""
    assert table.curve is not None
    pitch = table.dofs.index("pitch")
    (peak,) = {round(peak.omega, 6): peak for peak in table.missed_peaks if peak.quantity == "pitch"}.values()
    heights = [np.abs(one.amplitudes[:, 0, pitch]).max() for one in (table, table.curve)]
    assert heights[0] < 0.5 * peak.value
    # The peak is told about where it is highest: the curve has the height within one part in twenty.
    assert heights[1] == pytest.approx(peak.value, rel=0.05)


def test_few_frequencies_have_no_curve() -> None:
    assert response(*OMEGAS[:2]).curve is None


def test_plan_views_are_of_the_frequencies_asked_for(table: ResponseTable) -> None:
    """Of two there are two files; of none, that of the largest motion."""
    asked = response(*OMEGAS[:2], fields_at=OMEGAS[:2])
    plans = list(plan_waves(problem_of([SPAR], 20.0, TOLERANCE), asked, 2))
    assert [(plan.name, plan.omega) for plan in plans] == [("response_2_001", OMEGAS[0]), ("response_2_002", OMEGAS[1])]
    # Nothing but the dispersion relation ω² = gk tanh kH tells the length of the waves.
    for plan in plans:
        k = plan.wavenumber
        assert plan.omega**2 == pytest.approx(9.81 * k * np.tanh(20.0 * k), rel=1e-12)
