"""Tanks that are their own mirror image: modes are symmetric or antisymmetric, and half a tank holds either kind.

On the mirror plane symmetric modes have ∂ψ/∂x = 0 and antisymmetric ones ψ = 0. Half the unknowns are solved for
twice, and modes that nearly coincide by symmetry can no longer be confused.
"""

from __future__ import annotations

from typing import Literal

from hydroelastic.scenes.models import Beam
from hydroelastic.scenes.plan import ScaledTank

Parity = Literal["symmetric", "antisymmetric"]

PARITIES: tuple[Parity, Parity] = ("symmetric", "antisymmetric")

# Lengths that decimal input means to be equal differ by a few units of the last place.
_ROUNDING = 1e-14


def is_mirror_image(tank: ScaledTank) -> bool:
    """Whether a scaled tank is its own mirror image."""
    return all(
        abs(start - (1.0 - mirrored_end)) <= _ROUNDING
        and abs(end - (1.0 - mirrored_start)) <= _ROUNDING
        and _alike(tank, body, mirrored_body)
        for (start, end, body), (mirrored_start, mirrored_end, mirrored_body) in zip(
            tank.pieces, reversed(tank.pieces), strict=True
        )
    )


def _alike(tank: ScaledTank, one: int | None, other: int | None) -> bool:
    if one is None or other is None:
        return one is other
    return _material(tank.beams[one]) == _material(tank.beams[other])


def _material(beam: Beam) -> tuple[float, float, bool, str]:
    return beam.flexural_rigidity, beam.mass_per_length, beam.hydrostatic, beam.ends


def twin_of(tank: ScaledTank, body: int) -> int:
    """The beam that is the mirror image of one of a symmetric tank's: itself where the mirror plane cuts it."""
    bodies = [index for _, _, index in tank.pieces if index is not None]
    return bodies[-1 - bodies.index(body)]


def left_bodies(tank: ScaledTank) -> tuple[int, ...]:
    """The beams of a symmetric tank that lie, wholly or with one half, left of the mirror plane."""
    return tuple(index for start, _, index in tank.pieces if index is not None and start < 0.5)


def shape_parity(number: int) -> Parity:
    """Symmetry of a dry mode about the middle of its beam: heave is even, pitch odd, and so on in turn."""
    return PARITIES[number % 2]


def shapes_of_twins(tank: ScaledTank, shapes: tuple[int, ...]) -> tuple[int, ...]:
    """Numbers of dry modes, the same for both of two twins: their lengths may differ in the last place."""
    return tuple(max(count, shapes[twin_of(tank, body)]) for body, count in enumerate(shapes))
