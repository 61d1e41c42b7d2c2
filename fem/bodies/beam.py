"""A beam as a body of the field model: its dry modes as normal displacements of the line on which it floats."""

from __future__ import annotations

from functools import lru_cache, partial
from typing import NamedTuple

import numpy as np

from hydroelastic.fem.bodies.model import BodyModel
from hydroelastic.fem.closed.discretization import expected_tone
from hydroelastic.fem.core.bodies import dry_mode_count
from hydroelastic.fem.surfaces import Body
from hydroelastic.modal.beam.beam_shapes import BeamShapes, beam_shapes
from hydroelastic.physics.beams import Beam
from hydroelastic.physics.dofs import Dof, body_name
from hydroelastic.physics.symmetry import Parity


class BeamModel(BodyModel):
    """A beam in its first dry modes."""

    @property
    def beam(self) -> Beam:
        """The beam."""
        return self.tank.beams[self.index]

    def moving(self, count: int, parity: Parity | None) -> Body:
        """See `BodyModel.moving`."""
        tank, beam = self.tank, self.beam
        piece, jump = tank.piece_of(self.index), tank.level_of(self.index).jump
        part = 1.0 if parity is None else 0.5
        shapes = beam_shapes(beam, count)
        # Two asymmetric beams that are mirror images have mirrored shapes: all count as even.
        own = _of_parity(shapes.dofs, shapes.parities, parity)
        bending = part * shapes.bending[own.numbers]
        return Body(
            surface=body_name(self.index + 1),
            shapes=partial(_shapes_at, shapes, piece.start, piece.length, own.numbers),
            wavenumber=shapes.wavenumber,
            dofs=own.dofs,
            parities=own.parities,
            motions=own.identity,
            stiffness=bending + part * float(beam.hydrostatic) * jump * piece.length,
            bending_stiffness=bending,
            mass=part * shapes.mass[own.numbers[:, None], own.numbers],
        )

    def dry_mode_count(self, wavenumber: float, tolerance: float) -> int:
        """See `fem.core.bodies.dry_mode_count`."""
        return dry_mode_count(self.beam, wavenumber, tolerance)

    @property
    def has_tone(self) -> bool:
        """See `BodyModel.has_tone`; asked for each of many beams, it needs no estimate."""
        return True

    def expected_tones(self) -> tuple[float, ...]:
        """See `fem.closed.discretization.expected_tone`."""
        return (expected_tone(self.tank, self.index),)


class _Shapes(NamedTuple):
    """Some shapes of a beam: their numbers, degrees of freedom, parities and the identity of their number."""

    numbers: np.ndarray
    dofs: tuple[Dof, ...]
    parities: tuple[Parity, ...]
    identity: np.ndarray


@lru_cache(maxsize=64)
def _of_parity(dofs: tuple[Dof, ...], signs: tuple[int, ...], parity: Parity | None) -> _Shapes:
    parities: list[Parity] = ["symmetric" if sign > 0 else "antisymmetric" for sign in signs]
    numbers = np.array([number for number, own in enumerate(parities) if parity in (None, own)], dtype=int)
    identity = np.eye(len(numbers))
    for kept in (numbers, identity):
        kept.flags.writeable = False
    return _Shapes(
        numbers, tuple(dofs[number] for number in numbers), tuple(parities[number] for number in numbers), identity
    )


def _shapes_at(
    shapes: BeamShapes,
    start: float,
    length: float,
    numbers: np.ndarray,
    points: np.ndarray,
    normals: np.ndarray,
) -> np.ndarray:
    # Quadrature points at the tips may miss them by rounding.
    upwards: np.ndarray = shapes.deflections(np.clip(points[0] - start, 0.0, length))[numbers] * normals[1]
    return upwards
