"""The paper's printed formulas fail in the way the errata say, and the corrected ones do not."""

import dataclasses
import math

import pytest

from hydroelastic.modal.beam.added_mass import lid_added_mass
from hydroelastic.modal.beam.dry_modes import free_free_roots
from hydroelastic.modal.beam.floating_beam import FloatingBeam
from hydroelastic.modal.beam.grammel_terms import one_term_root
from hydroelastic.modal.beam.paper_model import (
    ERRATA,
    added_mass,
    free_end_determinant,
    one_term_lid_added_mass,
    one_term_stiffness,
)

BASE = FloatingBeam(
    tank_length=10.0,
    depth=5.0,
    density=1000.0,
    gravity=9.81,
    start=0.0,
    length=4.0,
    flexural_rigidity=5e3,
    mass_per_length=50.0,
    hydrostatic=False,
)


def test_errata_are_numbered_as_in_the_theory() -> None:
    assert [erratum.number for erratum in ERRATA] == list(range(1, 11))
    for erratum in ERRATA:
        assert erratum.printed
        assert erratum.corrected
        assert erratum.consequence


def test_determinant_vanishes_at_the_dry_roots_only_when_corrected() -> None:
    for root in free_free_roots(5):
        value = free_end_determinant(float(root))
        assert value.corrected == pytest.approx(0.0, abs=1e-13)
        assert abs(value.printed) > 1.0
    # Against the definition, where cosh does not overflow.
    b = 3.3
    ch, sh, cos, sin = math.cosh(b), math.sinh(b), math.cos(b), math.sin(b)
    assert free_end_determinant(b).printed == pytest.approx(((ch - cos) ** 2 - (sh - sin) ** 2) / ch, rel=1e-13)
    assert free_end_determinant(b).corrected == pytest.approx(
        ((ch - cos) ** 2 - (sh - sin) * (sh + sin)) / ch, rel=1e-13
    )
    assert math.isfinite(free_end_determinant(1e4).printed)


def test_printed_bracket_depends_on_the_unit_of_length() -> None:
    millimetres = dataclasses.replace(BASE, tank_length=1e4, depth=5e3, length=4e3)
    metres, small = one_term_stiffness(BASE), one_term_stiffness(millimetres)
    # c₁₁ = k tanh(kH) L/2 is a pure number.
    assert small.corrected == pytest.approx(metres.corrected, rel=1e-14)
    assert abs(small.printed / metres.printed - 1) > 0.01
    assert metres.corrected == pytest.approx(math.pi / 2 * math.tanh(math.pi / 2), rel=1e-14)


def test_printed_load_gives_negative_added_mass() -> None:
    for number in (1, 2, 5):
        value = one_term_lid_added_mass(BASE, number)
        assert value.printed == -value.corrected
        assert value.corrected > 0


def test_one_cosine_underestimates_the_lid_added_mass() -> None:
    # The lid series has positive terms 2ρc²/(L l k tanh kH); the one-term value is one of them.
    terms = sum(one_term_lid_added_mass(BASE, number).corrected for number in range(1, 400))
    total = lid_added_mass(BASE)
    assert terms < total
    # The tail after n = 400 is below Σ n⁻³ ~ 3e-6 of the first terms.
    assert terms == pytest.approx(total, rel=2e-5)


def test_printed_added_mass_forgets_hydrostatics() -> None:
    omega = 1.3
    dry = added_mass(BASE, omega)
    assert dry.printed == pytest.approx(dry.corrected, rel=1e-13)
    wet = added_mass(dataclasses.replace(BASE, hydrostatic=True, flexural_rigidity=5.0), omega)
    assert wet.corrected - wet.printed == pytest.approx(1000 * 9.81 / omega**2, rel=1e-13)
    assert wet.printed < 0 < wet.corrected


def test_single_cosine_of_the_paper_misses_the_centred_tone() -> None:
    # Erratum 7: for the centred base beam n = 1 is antisymmetric; its root is not near the tone 4.2305.
    centred = dataclasses.replace(BASE, start=3.0)
    assert one_term_root(centred, 1) == pytest.approx(4.925962, rel=1e-6)
    assert one_term_root(BASE, 1) == pytest.approx(13.593201, rel=1e-6)


def test_added_mass_needs_a_frequency() -> None:
    with pytest.raises(ValueError, match="omega"):
        added_mass(BASE, 0.0)
