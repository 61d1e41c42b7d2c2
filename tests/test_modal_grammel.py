"""Grammel's and Rayleigh's quotients, and the one-term root."""

import dataclasses
import itertools
import math

import numpy as np
import pytest
from base_beam import BASE
from scipy.linalg import eigh

from hydroelastic.modal.beam.grammel import beam_quotients, one_term_root, quotients, term_tones


def _pencil(size: int, seed: int) -> tuple[np.ndarray, np.ndarray, np.random.Generator]:
    generator = np.random.default_rng(seed)
    root = generator.normal(size=(size, size))
    stiffness = root @ root.T + 0.1 * np.eye(size)
    root = generator.normal(size=(size, size))
    return stiffness, root @ root.T + 0.1 * np.eye(size), generator


@pytest.mark.parametrize("seed", range(5))
def test_order_holds_for_any_trial_space(seed: int) -> None:
    # Cauchy–Schwarz and min–max; strict for a random trial, so rounding of 1e-10 is no excuse.
    stiffness, mass, generator = _pencil(9, seed)
    exact = eigh(stiffness, mass, eigvals_only=True)
    for count in (1, 3):
        pair = quotients(stiffness, mass, generator.normal(size=(9, count)))
        assert np.all(exact[:count] < pair.grammel * (1 + 1e-10))
        assert np.all(pair.grammel < pair.rayleigh)


def test_single_trial_is_the_textbook_quotient() -> None:
    stiffness, mass, generator = _pencil(6, 7)
    f = generator.normal(size=6)
    load = mass @ f
    pair = quotients(stiffness, mass, f)
    assert pair.rayleigh[0] == pytest.approx((f @ stiffness @ f) / (f @ load), rel=1e-12)
    assert pair.grammel[0] == pytest.approx((f @ load) / (load @ np.linalg.solve(stiffness, load)), rel=1e-10)


def test_grammel_gains_most_of_what_rayleigh_loses() -> None:
    # One inverse iteration: for the base tank the excess over exact drops from 1.5e-3 to 3.3e-5 in ω.
    result = beam_quotients(BASE)
    assert result.index == 1
    loss = [math.sqrt(value / result.exact) - 1 for value in (result.grammel, result.rayleigh)]
    assert loss[0] == pytest.approx(3.29e-5, rel=0.02)
    assert loss[1] == pytest.approx(1.470e-3, rel=0.01)


def test_one_term_skips_poles_that_decouple() -> None:
    # Centred beam, odd n: symmetric shapes do not couple, so the root may pass their dry frequencies; the theory
    # gives 30.127 against the dry 13.983 for narrow gaps. Even n must stay below the first dry frequency.
    narrow = dataclasses.replace(BASE, tank_length=4.4, start=0.2)
    assert one_term_root(narrow, 1) == pytest.approx(30.12721, rel=1e-6)
    assert one_term_root(narrow, 2) < 13.983


@pytest.mark.parametrize("hydrostatic", [False, True])
def test_more_terms_never_raise_a_tone(hydrostatic: bool) -> None:
    # Nested Ritz spaces; the cut of the rank may cost 1e-8.
    beam = dataclasses.replace(BASE, start=1.3, hydrostatic=hydrostatic)
    spectra = [term_tones(beam, terms).squared_frequencies[:5] for terms in (12, 16, 24, 40)]
    for coarse, fine in itertools.pairwise(spectra):
        assert np.all(fine < coarse * (1 + 1e-8))
