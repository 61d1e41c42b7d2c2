"""Wavenumbers of the local dispersion relation, by which meshes are chosen."""

from math import tanh

import pytest

from hydroelastic.physics.local_waves import LevelPiece, modes_below, squared_frequency_of_mode


def _water(depth: float, length: float = 1.0) -> LevelPiece:
    return LevelPiece(length=length, beam=None, jump=1.0, restored=True, layers=((1.0, depth),))


@pytest.mark.parametrize("depth", [1e-3, 0.3, 10.0])
@pytest.mark.parametrize("wavenumber", [1e-4, 0.7, 30.0, 1e6])
def test_the_wavenumber_is_that_of_its_frequency(depth: float, wavenumber: float) -> None:
    squared = wavenumber * tanh(wavenumber * depth)
    # In steps of 1e-9; where λ is nearly k² depth, rounding of λ adds less.
    assert _water(depth).wavenumber(squared) == pytest.approx(wavenumber, rel=2e-9)


def test_waves_longer_than_all_tanks_are_left_out_and_short_ones_end() -> None:
    assert _water(1.0).wavenumber(1e-13) == 0.0
    assert _water(1.0).wavenumber(1e30) == pytest.approx(1e12)


@pytest.mark.parametrize("number", [1, 10, 200])
def test_the_frequency_of_a_mode_has_its_waves_below_it(number: int) -> None:
    pieces = (_water(0.5, 0.25), _water(0.5, 0.75))
    squared = squared_frequency_of_mode(pieces, number)
    # λ in steps of 1e-6, and deep-water k is λ; one wave more, for the ends.
    assert modes_below(pieces, squared) == pytest.approx(number + 1, rel=1e-6)
