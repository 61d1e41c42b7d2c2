"""Tanks that are their own mirror image: modes are symmetric or antisymmetric, and half a tank holds either kind.

On the mirror plane symmetric modes have ∂ψ/∂x = 0 and antisymmetric ones ψ = 0. Two problems of half the size are
solved, and nearly equal frequencies of different symmetry are separated.
"""

from __future__ import annotations

from typing import Literal

from hydroelastic.physics.dofs import Motion
from hydroelastic.physics.tank import MIDDLE, ROUNDING, Piece, Tank

Parity = Literal["symmetric", "antisymmetric"]

PARITIES: tuple[Parity, Parity] = ("symmetric", "antisymmetric")


def is_mirror_image(tank: Tank) -> bool:
    """Whether a tank of unit length is its own mirror image; a half-plane of revolution is not."""
    return (
        not tank.geometry.is_revolved
        and tank.bed is None
        and all(
            abs(piece.start - (1.0 - image.end)) <= ROUNDING
            and abs(piece.end - (1.0 - image.start)) <= ROUNDING
            and (piece.body is image.body is None or _mirrored(tank, piece, image))
            for level in tank.levels
            for piece, image in zip(level.pieces, reversed(level.pieces), strict=True)
        )
    )


def _mirrored(tank: Tank, piece: Piece, image: Piece) -> bool:
    """Whether on both pieces bodies lie that are each other's mirror image."""
    return (
        piece.body is not None
        and image.body is not None
        and tank.bodies[piece.body].is_mirror_image_of(tank.bodies[image.body])
    )


def twin_of(tank: Tank, body: int) -> int:
    """The body that is the mirror image of one of a symmetric tank's: the body itself where the mirror plane cuts
    it."""
    bodies = [piece.body for piece in tank.level_of(body).pieces if piece.body is not None]
    return bodies[-1 - bodies.index(body)]


def left_bodies(tank: Tank) -> tuple[int, ...]:
    """The bodies of a symmetric tank that lie, wholly or with one half, left of the mirror plane."""
    return tuple(piece.body for piece in tank.pieces if piece.body is not None and _is_left(piece))


def _is_left(piece: Piece) -> bool:
    # A thin float in the middle has no length, and counts.
    return piece.start < MIDDLE or piece.start == piece.end == MIDDLE


def motion_parity(motion: Motion) -> Parity:
    """Symmetry of a float's motion about its middle."""
    return "symmetric" if motion == "heave" else "antisymmetric"


def shapes_of_twins(tank: Tank, shapes: tuple[int, ...]) -> tuple[int, ...]:
    """Numbers of dry modes, the same for both of two twins: their lengths may differ in the last place."""
    return tuple(max(count, shapes[twin_of(tank, body)]) for body, count in enumerate(shapes))
