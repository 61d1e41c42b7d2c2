"""Tanks that are their own mirror image: modes are symmetric or antisymmetric, and half a tank holds either kind.

On the mirror plane symmetric modes have ∂ψ/∂x = 0 and antisymmetric ones ψ = 0. Half the unknowns are solved for
twice, and modes that nearly coincide by symmetry can no longer be confused.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from hydroelastic.scenes.models import Beam
from hydroelastic.scenes.scaled_tank import MIDDLE, ROUNDING, Piece, ScaledTank

if TYPE_CHECKING:
    from hydroelastic.scenes.model_bodies import Motion

Parity = Literal["symmetric", "antisymmetric"]

PARITIES: tuple[Parity, Parity] = ("symmetric", "antisymmetric")


def is_mirror_image(tank: ScaledTank) -> bool:
    """Whether a scaled tank is its own mirror image."""
    return all(
        abs(piece.start - (1.0 - image.end)) <= ROUNDING
        and abs(piece.end - (1.0 - image.start)) <= ROUNDING
        and _alike(tank, piece, image)
        for level in tank.levels
        for piece, image in zip(level.pieces, reversed(level.pieces), strict=True)
    )


def _alike(tank: ScaledTank, one: Piece, other: Piece) -> bool:
    if one.body is None or other.body is None:
        return one.body is other.body
    return _material(tank, one.body) == _material(tank, other.body)


def _material(tank: ScaledTank, index: int) -> object:
    """What must be equal in two bodies for one to be the other's mirror image, but for the place."""
    body = tank.bodies[index]
    if isinstance(body, Beam):
        return body.flexural_rigidity, body.mass_per_length, body.hydrostatic, body.ends
    # Contours need SciPy's root finders, which take a while to import.
    from hydroelastic.scenes.scaled_float import is_symmetric

    return body.given.model_copy(update={"position": 0.0}) if is_symmetric(body) else object()


def twin_of(tank: ScaledTank, body: int) -> int:
    """The body that is the mirror image of one of a symmetric tank's: itself where the mirror plane cuts it."""
    bodies = [piece.body for piece in tank.level_of(body).pieces if piece.body is not None]
    return bodies[-1 - bodies.index(body)]


def left_bodies(tank: ScaledTank) -> tuple[int, ...]:
    """The bodies of a symmetric tank that lie, wholly or with one half, left of the mirror plane."""
    return tuple(piece.body for piece in tank.pieces if piece.body is not None and _is_left(piece))


def _is_left(piece: Piece) -> bool:
    # A thin float in the middle has no length, and counts.
    return piece.start < MIDDLE or piece.start == piece.end == MIDDLE


def shape_parity(number: int) -> Parity:
    """Symmetry of a dry mode about the middle of its beam: heave is even, pitch odd, and so on in turn."""
    return PARITIES[number % 2]


def motion_parity(motion: Motion) -> Parity:
    """Symmetry of a float's motion about its middle."""
    return "symmetric" if motion == "heave" else "antisymmetric"


def shapes_of_twins(tank: ScaledTank, shapes: tuple[int, ...]) -> tuple[int, ...]:
    """Numbers of dry modes, the same for both of two twins: their lengths may differ in the last place."""
    return tuple(max(count, shapes[twin_of(tank, body)]) for body, count in enumerate(shapes))
