"""ψ = 0 on the water beside plates: the liquid under the plates alone, by conjugate gradients.

With A = k tanh kH of the whole plan, ψ of a load on the plates is A⁻¹ of it among the functions that vanish on the
water. On them A is as large as k tanh kH of the plates' own plan with ψ = 0 at their edges, but for a factor of order
one: both are norms of H^{1/2} (Lions and Magenes). Its inverse P as preconditioner leaves 15 to 25 steps on any mesh.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from petsc4py import PETSc
from scipy.linalg import eigh

from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.plan.box_pencil import BoxLiquid, BoxStiffness, box_pencil
from hydroelastic.fem.plan.rectangle_body import RectangleBody
from hydroelastic.modal.liquid.vertical_poles import surface_response
from hydroelastic.physics.arrays import FloatArray

_MOST_STEPS, _RESIDUAL = 200, 1e-11


@dataclass(kw_only=True)
class ReleasedOperator:
    """A⁺ with ψ = 0 on the water.

    Attributes:
        free: unknowns that are zero on the water.
        apply: A among them.
        precondition: P among them.
        solves: how many loads were answered.
    """

    free: np.ndarray
    apply: Callable[[FloatArray], FloatArray]
    precondition: Callable[[FloatArray], FloatArray]
    solves: int = 0

    def solve(self, load: PETSc.Vec, potential: PETSc.Vec) -> None:
        """See `LiquidOperator.solve`."""
        rest = load.array_r[self.free]
        answer = np.zeros_like(rest)
        step = near = self.precondition(rest)
        size = first = float(rest @ near)
        for _ in range(_MOST_STEPS):
            if size <= _RESIDUAL**2 * first:
                break
            image = self.apply(step)
            length = size / float(step @ image)
            answer += length * step
            rest = rest - length * image
            near = self.precondition(rest)
            size, before = float(rest @ near), size
            step = near + size / before * step
        potential.set(0.0)
        potential.array[self.free] = answer
        self.solves += 1


def released_box_pencil(liquid: BoxLiquid, plates: tuple[RectangleBody, ...]) -> CoupledPencil[BoxLiquid]:
    """Return the coupled problem of a symmetry class of a box in which the plates move."""
    pencil = box_pencil(liquid, plates, waves=False)
    assert pencil is not None
    return replace(pencil, solver=_released_box(liquid, plates), constraints=())


def _released_box(liquid: BoxLiquid, plates: tuple[RectangleBody, ...]) -> ReleasedOperator:
    """P by the standing waves under each plate with ψ = 0 at its edges."""
    numbers = np.arange(liquid.size).reshape(liquid.shape)
    blocks = []
    for plate in plates:
        own, squares, waves = [], [], []
        for space, (start, end) in zip(liquid.spaces, plate.extents, strict=True):
            under = space.between(start, end)
            inside = np.setdiff1d(space.unknowns_of(under), space.unknowns_of(np.setdiff1d(space.cells, under)))
            mass, stiffness = (matrix[np.ix_(inside, inside)] for matrix in (space.mass, space.stiffness))
            shift = 1.0 / (end - start) ** 2
            inverses, vectors = eigh(mass, stiffness + shift * mass)
            own.append(inside)
            squares.append(np.maximum(1.0 / np.maximum(inverses, 1e-300) - shift, 0.0))
            waves.append(vectors / np.sqrt(np.maximum(inverses, 1e-300)))
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

    return ReleasedOperator(free=free, apply=apply, precondition=precondition)
