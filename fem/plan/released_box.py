"""ψ = 0 on the water of a box; see `released`."""

from __future__ import annotations

import numpy as np
from scipy.linalg import eigh

from hydroelastic.fem.level_bed.interval import IntervalSpace
from hydroelastic.fem.plan.box_pencil import BoxLiquid, BoxStiffness, plate_loads
from hydroelastic.fem.plan.rectangle_body import RectangleBody
from hydroelastic.fem.plan.released import ReleasedProblem
from hydroelastic.modal.liquid.vertical_poles import surface_response
from hydroelastic.physics.arrays import FloatArray


def released_box(liquid: BoxLiquid, plates: tuple[RectangleBody, ...]) -> ReleasedProblem:
    """Return the problem of a symmetry class of a box in which the plates move.

    P is that of the standing waves under each plate with ψ = 0 at its edges.
    """
    numbers = np.arange(liquid.size).reshape(liquid.shape)
    blocks = []
    for plate in plates:
        own, squares, waves = [], [], []
        for space, (start, end) in zip(liquid.spaces, plate.extents, strict=True):
            under = space.between(start, end)
            inside = np.setdiff1d(space.unknowns_of(under), space.unknowns_of(np.setdiff1d(space.cells, under)))
            own.append(inside)
            found = _dirichlet_waves(space, inside, end - start)
            squares.append(found[0])
            waves.append(found[1])
        wavenumbers = np.sqrt(np.add.outer(*squares))
        responses = surface_response(np.maximum(wavenumbers, 0.5 / liquid.depth), liquid.depth) / liquid.images
        blocks.append((numbers[np.ix_(*own)], waves, responses))
    free = np.concatenate([block.ravel() for block, _, _ in blocks])
    operator = BoxStiffness(liquid)

    def apply(values: FloatArray) -> FloatArray:
        whole = np.zeros(liquid.size)
        whole[free] = values
        return operator.product(whole)[free]

    def precondition(values: FloatArray) -> FloatArray:
        found, first = np.empty_like(values), 0
        for block, (along, across), responses in blocks:
            part = values[first : first + block.size].reshape(block.shape)
            found[first : first + block.size] = (along @ (responses * (along.T @ part @ across)) @ across.T).ravel()
            first += block.size
        return found

    moving = tuple(plate for plate in plates if plate.body.size)
    loads = np.concatenate([plate_loads(liquid, plate, plate.coefficients) for plate in moving])
    return ReleasedProblem(
        bodies=tuple(plate.body for plate in moving),
        free=free,
        loads=loads[:, free],
        apply=apply,
        precondition=precondition,
    )


def _dirichlet_waves(space: IntervalSpace, inside: np.ndarray, side: float) -> tuple[FloatArray, FloatArray]:
    """k² and the standing waves of a side of a plate that are zero at its edges."""
    mass, stiffness = (matrix[np.ix_(inside, inside)] for matrix in (space.mass, space.stiffness))
    shift = 1.0 / side**2
    inverses, vectors = eigh(mass, stiffness + shift * mass)
    inverses = np.maximum(inverses, 1e-300)
    return np.maximum(1.0 / inverses - shift, 0.0), vectors / np.sqrt(inverses)
