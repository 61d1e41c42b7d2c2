"""Tanks that are their own mirror image: modes are symmetric or antisymmetric, and half a tank holds either kind.

On the mirror plane symmetric modes have ∂ψ/∂x = 0 and antisymmetric ones ψ = 0. Half the unknowns are solved for
twice, and modes that nearly coincide by symmetry can no longer be confused.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from hydroelastic.modal.beam.jointed_beam import alike
from hydroelastic.scenes.models.tank import Beam
from hydroelastic.scenes.tank.beam_shapes import beam_shapes, jointed_beam
from hydroelastic.scenes.tank.scaled_tank import MIDDLE, ROUNDING, Piece, ScaledTank

if TYPE_CHECKING:
    from hydroelastic.scenes.models.bodies import Motion

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
    if one.body in tank.beams and other.body in tank.beams:
        return _beams_alike(tank.beams[one.body], tank.beams[other.body])
    return _material(tank, one.body) == _material(tank, other.body)


def _beams_alike(beam: Beam, image: Beam) -> bool:
    """Whether one beam is the mirror image of another, but for the place."""
    if (beam.hydrostatic, beam.ends) != (image.hydrostatic, image.ends):
        return False
    if beam.is_uniform and image.is_uniform:
        return _uniform(beam) == _uniform(image)
    return alike(jointed_beam(beam), jointed_beam(image).reversed)


def _uniform(beam: Beam) -> tuple[float, float]:
    return beam.flexural_rigidity, beam.mass_per_length


def _material(tank: ScaledTank, index: int) -> object:
    """What must be equal in two floats for one to be the other's mirror image, but for the place."""
    body = tank.floats.get(index)
    if body is None:
        return object()
    # Contours need SciPy's root finders, which take a while to import.
    from hydroelastic.scenes.tank.scaled_float import is_symmetric

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


def shape_parities(beam: Beam, count: int) -> tuple[Parity, ...]:
    """Symmetry of the first shapes of a beam about its middle: heave is even, pitch odd, and so on.

    Twins that are no mirror images of their own have shapes that are mirror images of each other's: all count as even.
    """
    return tuple("symmetric" if sign > 0 else "antisymmetric" for sign in beam_shapes(beam, count).parities)


def motion_parity(motion: Motion) -> Parity:
    """Symmetry of a float's motion about its middle."""
    return "symmetric" if motion == "heave" else "antisymmetric"


def shapes_of_twins(tank: ScaledTank, shapes: tuple[int, ...]) -> tuple[int, ...]:
    """Numbers of dry modes, the same for both of two twins: their lengths may differ in the last place."""
    return tuple(max(count, shapes[twin_of(tank, body)]) for body, count in enumerate(shapes))
