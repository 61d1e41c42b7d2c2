"""Forces from outside on the body unknowns of a basin, dimensionless; see `physics/attachments.py`."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from hydroelastic.fem.bodies.round_plate import RoundShapes
from hydroelastic.fem.open_water.basin import OpenBasin
from hydroelastic.fem.surfaces import Body
from hydroelastic.modal.beam.beam_shapes import beam_shapes
from hydroelastic.physics.attachments import Attachment, OutsideForces, outside_forces
from hydroelastic.physics.round_plates import RoundPlate


def outside_of(basin: OpenBasin, bodies: tuple[Body, ...], attachments: tuple[Attachment, ...]) -> OutsideForces:
    """Return the forces from outside on all body unknowns."""
    paths = list(attachment_paths(basin, bodies, attachments))
    return outside_forces(paths, [one.scaled(basin.units) for one in attachments], sum(body.size for body in bodies))


def attachment_paths(
    basin: OpenBasin, bodies: tuple[Body, ...], attachments: tuple[Attachment, ...]
) -> Iterator[np.ndarray]:
    """Yield the displacement (heave, sway, roll) that each attachment follows, of its body less that of the other, by a
    unit of each body unknown, shape (3, unknowns)."""
    starts = np.cumsum([0, *(body.size for body in bodies)])
    for attachment in attachments:
        path = np.zeros((3, starts[-1]))
        for index, sign in ((attachment.body, 1.0), (attachment.other, -1.0)):
            if index is not None:
                path[:, starts[index] : starts[index + 1]] += sign * displacement_at(
                    basin, bodies[index], index, attachment.point
                )
        yield path


def displacement_at(basin: OpenBasin, body: Body, index: int, point: tuple[float, float]) -> np.ndarray:
    """Return heave, sway and rotation of a point that moves with a body, by a unit of each of its unknowns, shape
    (3, unknowns)."""
    length = basin.units.length
    x, y = (point[0] - basin.origin) / length, point[1] / length
    plate = basin.tank.bodies[index]
    if isinstance(plate, RoundPlate):
        # What holds a plate is on its axis.
        shapes = RoundShapes(plate, body.size)
        deflection, slope = (shapes.values(np.zeros(1), derivative)[:, 0] for derivative in (0, 1))
        return np.array([deflection, np.zeros(body.size), slope])
    if plate.is_elastic:
        beam, piece = basin.tank.beams[index], basin.tank.piece_of(index)
        place = np.array([min(max(x - piece.start, 0.0), piece.length)])
        along = beam_shapes(beam, body.size)
        deflection, slope = (along.tabulated(place, derivative)[:, 0] for derivative in (0, 1))
        return np.array([deflection, np.zeros(body.size), slope])
    placed = basin.tank.floats[index]
    moved = [placed.displacement(motion, np.array([[x], [y]]))[:, 0] for motion in placed.motions]
    rows = np.array([[up, right, float(dof.is_rotation)] for (right, up), dof in zip(moved, body.dofs, strict=True)])
    displacement: np.ndarray = rows.T @ body.motions
    return displacement
