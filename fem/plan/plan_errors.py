"""Errors of modes on a plan by the space of ψ and by the poles of the depth."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from petsc4py import PETSc

from hydroelastic.fem.direct import direct_solver
from hydroelastic.fem.mode_set import Mode
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.plan.plan_pencil import PlanLiquid, PlanSpace, PoleOperator
from hydroelastic.fem.spectral_error import cell_errors
from hydroelastic.modal.liquid.vertical_poles import surface_response

# Of a function's norm, what others must leave of it to count as a new one.
_INDEPENDENT = 1e-9
# The quadrature shows 0.77 to 0.99 of the part of the poles, measured.
_SAFETY = 1.5


def liquid_and_pole_errors(
    pencil: CoupledPencil[PlanLiquid], modes: list[Mode], depth: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Estimate (λ_h − λ)/λ by the space of ψ and by the poles (collective).

    At unit generalized mass the first one is

        Σ_j c_j ∫|∇(ψ_j − ψ_jh)|² + d_j (ψ_j − ψ_jh)²

    of which the part of the gradients follows from the decay of each pole's ∇ψ_j with the polynomial degree. The second
    one is ∫(f − f_h)dμ, with the measure μ of the squares of ζ over k². Galerkin's method in ζ and all ψ_j gives a few
    k² and weights, a quadrature over μ that is exact for f_h, and for f, a sum of 1/(k² + d), from below.
    """
    operator = pencil.solver
    assert isinstance(operator, PoleOperator)
    poles = pencil.liquid.poles
    errors, missing = np.zeros(len(modes)), np.zeros(len(modes))
    potentials: list[PETSc.Vec] = []
    places = []
    load, height = pencil.coupling.createVecLeft(), pencil.coupling.createVecLeft()
    mass = direct_solver(pencil.liquid.space.mass)
    space = pencil.liquid.space
    for number, mode in enumerate(modes):
        pencil.coupling.mult(mode.displacement, load)
        parts = operator.parts(load.array_r)
        for pole, part in parts:
            potentials.append(PETSc.Vec().createWithArray(space.expanded(part), comm=PETSc.COMM_SELF))
            places.append((number, pole))
        mass.solve(load, height)
        shared = [part for own in operator.comm.allgather(parts) for _, part in own]
        squares, weights = _quadrature(space, np.array([height.array, *shared]))
        wavenumbers = np.sqrt(squares)
        missing[number] = weights @ np.maximum(surface_response(wavenumbers, depth) - poles.values(wavenumbers), 0.0)
    if potentials:
        energies = space.images * cell_errors(space.liquid, potentials).sum(axis=1)
        for energy, (number, pole) in zip(energies, places, strict=True):
            errors[number] += poles.weights[pole] * energy
    return np.asarray(operator.comm.allreduce(errors)), _SAFETY * missing


def _quadrature(space: PlanSpace, functions: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """k² and weights of Galerkin's method for the measure of the first of some functions (functions, unknowns)."""
    image = space.mass.createVecLeft()
    vector = space.mass.createVecRight()

    def product(matrix: PETSc.Mat, values: NDArray[np.float64]) -> NDArray[np.float64]:
        vector.array[:] = values
        matrix.mult(vector, image)
        return image.array.copy()

    basis: NDArray[np.float64] = np.empty((0, space.size))
    images: NDArray[np.float64] = np.empty((0, space.size))
    for function in functions:
        rest, size = function, np.sqrt(function @ product(space.mass, function))
        for _ in range(2):
            rest = rest - (images @ rest) @ basis
        left = np.sqrt(rest @ product(space.mass, rest))
        if left > _INDEPENDENT * size:
            basis = np.vstack([basis, rest / left])
            images = np.vstack([images, product(space.mass, rest / left)])
    squares, turn = np.linalg.eigh(basis @ np.array([product(space.stiffness, one) for one in basis]).T)
    return squares, (images[0] @ functions[0] * turn[0]) ** 2
