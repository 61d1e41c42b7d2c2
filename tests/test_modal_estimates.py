"""All estimates at once: bounds, invariances and hard cases."""

import dataclasses
import functools
import math

import pytest
from base_beam import BASE

from hydroelastic.modal.beam.estimates import all_estimates as uncached_estimates
from hydroelastic.modal.beam.floating_beam import FloatingBeam
from hydroelastic.modal.beam.grammel import term_tones
from hydroelastic.modal.estimate import frequency_from_added_mass

all_estimates = functools.cache(uncached_estimates)

NAMES = {
    "grammel_1",
    "grammel_best",
    "grammel_n",
    "grammel_quotient",
    "rayleigh",
    "rayleigh_dry_mode",
    "rayleigh_lid",
    "rayleigh_pressure_release",
    "deep_water",
    "strip",
    "shallow",
    "paper_no_volume_term",
}


def vary(**changes: float | bool) -> FloatingBeam:
    return dataclasses.replace(BASE, **changes)


HARD = {
    "rigid": vary(flexural_rigidity=1e15, mass_per_length=2000.0, hydrostatic=True),
    "rigid without hydrostatics": vary(flexural_rigidity=1e15),
    "massless": vary(mass_per_length=1e-12),
    "very heavy": vary(mass_per_length=1e9, hydrostatic=True),
    "40 characteristic lengths": vary(flexural_rigidity=1e-3, hydrostatic=True),
    "almost no rigidity": vary(flexural_rigidity=1e-12),
    "tip on the left wall": vary(start=0.0),
    "tip on the right wall": vary(start=6.0),
    "slit": vary(start=1e-6),
    "narrow slit": vary(start=1e-2),
    "full cover": vary(start=0.0, length=10.0),
    "full cover with hydrostatics": vary(start=0.0, length=10.0, hydrostatic=True),
    "full cover, shallow": vary(start=0.0, length=10.0, depth=0.01),
    "shallow": vary(depth=0.1),
    "very shallow": vary(depth=1e-4),
    "deep": vary(depth=1e5),
    "long tank": vary(tank_length=400.0, start=198.0),
    "very long tank": vary(tank_length=4e5, start=198.0),
    "light liquid": vary(density=1e-6),
    "weak gravity": vary(gravity=1e-6),
    "strong gravity": vary(gravity=1e6),
}


@pytest.mark.slow_but(
    "rigid*", "massless", "almost no rigidity", "tip on the left wall", "slit", "full cover, shallow", "deep"
)
@pytest.mark.parametrize("name", HARD)
def test_hard_cases_never_raise(name: str) -> None:
    beam = HARD[name]
    estimates = all_estimates(beam)
    assert set(estimates) == NAMES
    for key, estimate in estimates.items():
        assert estimate.note, key
        if estimate.omega is None:
            assert "No value:" in estimate.note
            assert estimate.added_mass_per_length is None
            assert estimate.bound == "none"
            continue
        assert math.isfinite(estimate.omega)
        assert estimate.omega > 0
        # m_a and ω are two names of one number; m_a + m may cancel, so compare the frequency.
        back = frequency_from_added_mass(beam, estimate.added_mass_per_length)
        assert back == pytest.approx(estimate.omega, rel=1e-8)


def test_base_tank_by_name() -> None:
    # Table of the theory, § 1.4 and § 3.1, to its printed digits.
    expected = {
        "grammel_1": 4.925962,
        "grammel_best": 4.597168,
        "grammel_n": 4.232172,
        "rayleigh": 4.231516,
        "rayleigh_dry_mode": 4.036359,
        "rayleigh_lid": 4.038978,
        "rayleigh_pressure_release": 4.678779,
        "deep_water": 4.172873,
        "strip": 3.303851,
        "paper_no_volume_term": 4.203569,
    }
    estimates = all_estimates(BASE)
    for name, omega in expected.items():
        assert estimates[name].omega == pytest.approx(omega, abs=6e-7), name


@pytest.mark.slow_but("0.7")
@pytest.mark.parametrize("start", [0.0, 0.7])
def test_mirrored_tank_gives_the_same_estimates(start: float) -> None:
    left, right = all_estimates(vary(start=start)), all_estimates(vary(start=6.0 - start))
    for name in NAMES:
        if left[name].omega is None:
            assert right[name].omega is None
        else:
            # The N-term space is the same up to signs; its rank cut leaves 1e-9.
            assert right[name].omega == pytest.approx(left[name].omega, rel=1e-8), name
            assert (right[name].bound, right[name].mode_index) == (left[name].bound, left[name].mode_index)


@pytest.mark.slow_but("False")
@pytest.mark.parametrize("hydrostatic", [False, True])
def test_bounds_against_a_fine_ritz_solution(hydrostatic: bool) -> None:
    beam = vary(start=1.0, hydrostatic=hydrostatic)
    # 96 cosines lie above the exact modes by O(N⁻²), here less than 2e-4 in λ: a bound may miss it by that much.
    fine = term_tones(beam, 96).squared_frequencies
    for name, estimate in all_estimates(beam).items():
        if estimate.bound == "above_mode_index":
            assert estimate.omega**2 > fine[estimate.mode_index - 1] * (1 - 4e-4), name


def test_bound_of_the_dry_mode_counts_the_missing_pitch() -> None:
    # Its space has no pitch, so without hydrostatics tone number 4 bounds mode 3 of those that are not zero only;
    # with hydrostatics there is no zero mode to count.
    assert all_estimates(BASE)["rayleigh_dry_mode"].mode_index == 3
    assert all_estimates(vary(hydrostatic=True))["rayleigh_dry_mode"].mode_index == 8
    # Narrow gaps: its tone is the first, which bounds the zero mode and so nothing.
    assert all_estimates(vary(tank_length=4.4, start=0.2))["rayleigh_dry_mode"].bound == "none"
