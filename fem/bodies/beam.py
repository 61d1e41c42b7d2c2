"""A beam as a body of the field model: its dry modes as normal displacements of the line on which it floats."""

from __future__ import annotations

from functools import partial

import numpy as np

from hydroelastic.fem.surfaces import Body
from hydroelastic.modal.beam.beam_shapes import BeamShapes, beam_shapes
from hydroelastic.physics.dofs import body_name
from hydroelastic.physics.symmetry import Parity
from hydroelastic.physics.tank import Tank


def beam_body(tank: Tank, index: int, count: int, parity: Parity | None) -> Body:
    """A beam in its first ``count`` shapes, rigid ones included; dimensionless.

    With a parity, only the shapes of that parity about its middle, and the energies of half the beam.
    """
    beam, piece, jump = tank.beams[index], tank.piece_of(index), tank.level_of(index).jump
    part = 1.0 if parity is None else 0.5
    shapes = beam_shapes(beam, count)
    # Twins that are not symmetric themselves have shapes that mirror each other's: all count as even.
    parities: tuple[Parity, ...] = tuple("symmetric" if sign > 0 else "antisymmetric" for sign in shapes.parities)
    numbers = [number for number, own in enumerate(parities) if parity in (None, own)]
    bending = part * shapes.bending[numbers]
    return Body(
        surface=body_name(index + 1),
        shapes=partial(_shape_at, shapes, piece.start, piece.length, numbers),
        wavenumber=shapes.wavenumber,
        dofs=tuple(shapes.dofs[number] for number in numbers),
        parities=tuple(parities[number] for number in numbers),
        motions=np.eye(len(numbers)),
        stiffness=bending + part * float(beam.hydrostatic) * jump * piece.length,
        bending_stiffness=bending,
        mass=part * shapes.mass[np.ix_(numbers, numbers)],
    )


def _shape_at(
    shapes: BeamShapes,
    start: float,
    length: float,
    numbers: list[int],
    points: np.ndarray,
    normals: np.ndarray,
    place: int,
) -> np.ndarray:
    # Quadrature points at the tips may miss them by rounding.
    upwards: np.ndarray = shapes.deflection(numbers[place], np.clip(points[0] - start, 0.0, length)) * normals[1]
    return upwards
