"""Waves of a frequency on open water and in plates, and the polynomials of plates that resolve them."""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil, log10, pi

from hydroelastic.fem.level_bed.resolution import moving_piece
from hydroelastic.physics.level_tank import LevelTank

MOST_POLYNOMIALS = 40
"""Along each direction of a plate on a plan."""


def polynomial_counts(
    tank: LevelTank, wavenumbers: Sequence[float], tolerance: float, *, most: int = MOST_POLYNOMIALS
) -> tuple[int, ...]:
    """Return the number of polynomials of each plate: those that resolve its waves, and more for each digit."""
    digits = -log10(tolerance)
    return tuple(
        min(ceil(1.1 * wavenumber * plate.outline.extent / pi + 1.2 * digits) + 4, most)
        for plate, wavenumber in zip(tank.plates, wavenumbers, strict=True)
    )


def more_polynomials(counts: tuple[int, ...], excess: float, *, most: int = MOST_POLYNOMIALS) -> tuple[int, ...]:
    """Return the next numbers of polynomials where their error is ``excess`` > 1 times the one that is accepted."""
    factor = min(max(1.2 * excess ** (1.0 / 8.0), 1.2), 2.0)
    return tuple(min(ceil(factor * count), most) for count in counts)


def water_wavenumber(tank: LevelTank, eigenvalue: float) -> float:
    """Return the wavenumber of waves of a λ on open water."""
    return moving_piece(tank, 1.0, None).wavenumber(eigenvalue)


def plate_wavenumbers(tank: LevelTank, eigenvalue: float) -> list[float]:
    """Return the wavenumber of waves of a λ in each plate on water; 0 of a rigid one."""
    return [
        moving_piece(tank, 1.0, index).wavenumber(eigenvalue) if plate.is_elastic else 0.0
        for index, plate in enumerate(tank.plates)
    ]
