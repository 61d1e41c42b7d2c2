"""ψ = 0 on the water beside plates: the liquid under the plates alone, and their first elastic tones.

With A = k tanh kH of the whole plan, ψ of a load on the plates is A⁻¹ of it among the functions that vanish on the
water. On them A is as large as k tanh kH of the plates' own plan with ψ = 0 at their edges, but for a factor of order
one: both are norms of H^{1/2} (Lions and Magenes). Its inverse P preconditions Davidson's method, in which A is never
inverted: with p = Mv + Cᵀψ the motions of the plates (v, ψ) solve

    [M; C] K⁻¹ p = (1/λ) (Mv, Aψ)

and the residual of a tone, by P, is the next vector: ten of them on any mesh.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import block_diag, eigh

from hydroelastic.fem.level_bed.interval import IntervalSpace
from hydroelastic.fem.plan.box_pencil import BoxLiquid, BoxStiffness, plate_loads
from hydroelastic.fem.plan.rectangle_body import RectangleBody
from hydroelastic.fem.surfaces import Body
from hydroelastic.modal.liquid.vertical_poles import surface_response
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.dofs import FIRST_ELASTIC

_MOST_STEPS = 40
# Part of 1/λ by which the residual of a tone changes it at most, if the next mode is as far as another 1/λ.
_RESIDUAL = 1e-9
# The softest shapes of each plate, with which the method starts.
_START = 6


@dataclass(frozen=True, kw_only=True)
class ReleasedProblem:
    """A symmetry class with ψ = 0 on the water, in the unknowns of ψ that are zero there.

    Attributes:
        bodies: the plates that move in it.
        loads: ∫φq of their shapes, shape (shapes, unknowns).
        apply: A.
        precondition: P.
    """

    bodies: tuple[Body, ...]
    loads: FloatArray
    apply: Callable[[FloatArray], FloatArray]
    precondition: Callable[[FloatArray], FloatArray]


@dataclass(frozen=True, kw_only=True)
class _Motions:
    """Vectors (v, ψ) with their momentum p and Aψ, one in each row."""

    shapes: FloatArray
    potentials: FloatArray
    momentum: FloatArray
    images: FloatArray

    def combined(self, weights: FloatArray) -> _Motions:
        return _Motions(
            shapes=weights @ self.shapes,
            potentials=weights @ self.potentials,
            momentum=weights @ self.momentum,
            images=weights @ self.images,
        )

    def beside(self, other: _Motions) -> _Motions:
        return _Motions(
            shapes=np.vstack([self.shapes, other.shapes]),
            potentials=np.vstack([self.potentials, other.potentials]),
            momentum=np.vstack([self.momentum, other.momentum]),
            images=np.vstack([self.images, other.images]),
        )


def released_tones(problem: ReleasedProblem, places: Sequence[int]) -> tuple[FloatArray, FloatArray]:
    """Return the first elastic tones of some plates.

    Free rigid motions have no momentum: all vectors are projected so, along those that P gives of them.

    Args:
        problem: with ψ = 0 on the water.
        places: of the plates among its bodies.

    Returns:
        λ of each, and the part of it by which its residual may change it, each of shape (plates,).
    """
    bodies = problem.bodies
    stiffness, mass = np.concatenate([body.stiffness for body in bodies]), block_diag(*[body.mass for body in bodies])
    firsts = np.cumsum([0, *(body.size for body in bodies)])
    wanted = np.array([firsts[place] + bodies[place].dofs.index(FIRST_ELASTIC) for place in places])
    free = np.flatnonzero(stiffness == 0.0)
    compliance = np.divide(1.0, stiffness, out=np.zeros_like(stiffness), where=stiffness > 0.0)

    def motions(shapes: FloatArray, loads: FloatArray) -> _Motions:
        """The vectors that P gives of residuals, at unit energy."""
        potentials = np.array([problem.precondition(load) for load in loads])
        images = np.array([problem.apply(potential) for potential in potentials])
        found = _Motions(
            shapes=shapes,
            potentials=potentials,
            momentum=shapes @ mass + potentials @ problem.loads.T,
            images=images,
        )
        if len(turned):
            held = rigid.combined(-found.momentum[:, free] @ turned)
            both = found.beside(held)
            count = len(shapes)
            found = both.combined(np.hstack([np.eye(count), np.eye(count)]))
        return found.combined(np.diag(1.0 / np.sqrt(np.diagonal(_energies(found, mass)))))

    turned = np.empty((0, 0))
    if len(free):
        rigid = motions(np.eye(len(stiffness))[free], problem.loads[free])
        turned = np.linalg.inv(rigid.momentum[:, free])
    softest = np.concatenate(
        [first + np.argsort(body.stiffness)[:_START] for first, body in zip(firsts, bodies, strict=False)]
    )
    softest = np.setdiff1d(np.union1d(softest, wanted), free)
    basis = motions(np.eye(len(stiffness))[softest], problem.loads[softest])
    for _ in range(_MOST_STEPS):
        values, vectors = eigh((basis.momentum * compliance) @ basis.momentum.T, _energies(basis, mass))
        momentum = vectors.T @ basis.momentum
        # Of each mode the part of the potential energy that a plate's first elastic shape has.
        parts = compliance[wanted] * momentum[:, wanted] ** 2 / ((compliance * momentum**2).sum(axis=1))[:, None]
        chosen = parts.argmax(axis=0)
        inverses, tones = values[chosen], basis.combined(vectors[:, chosen].T)
        amplitudes = tones.momentum * compliance
        shapes = amplitudes - inverses[:, None] * tones.shapes
        rests = amplitudes @ problem.loads - inverses[:, None] * tones.images
        answers = motions(shapes, rests)
        # Σ over the unit vectors of the answers: the energy of the residual in the norm of P.
        errors = ((shapes @ mass) * answers.shapes).sum(axis=1) + (rests * answers.potentials).sum(axis=1)
        errors = (errors / inverses) ** 2
        if errors.max() <= _RESIDUAL:
            break
        basis = basis.beside(answers.combined(np.eye(len(errors))[errors > _RESIDUAL]))
    return 1.0 / inverses, errors


def _energies(vectors: _Motions, mass: FloatArray) -> FloatArray:
    whole = vectors.shapes @ mass @ vectors.shapes.T + vectors.potentials @ vectors.images.T
    return np.asarray(0.5 * (whole + whole.T))


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
        bodies=tuple(plate.body for plate in moving), loads=loads[:, free], apply=apply, precondition=precondition
    )


def _dirichlet_waves(space: IntervalSpace, inside: np.ndarray, side: float) -> tuple[FloatArray, FloatArray]:
    """k² and the standing waves of a side of a plate that are zero at its edges."""
    mass, stiffness = (matrix[np.ix_(inside, inside)] for matrix in (space.mass, space.stiffness))
    shift = 1.0 / side**2
    inverses, vectors = eigh(mass, stiffness + shift * mass)
    inverses = np.maximum(inverses, 1e-300)
    return np.maximum(1.0 / inverses - shift, 0.0), vectors / np.sqrt(inverses)
