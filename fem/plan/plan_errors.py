"""Errors of modes on a plan: the space of ψ pole by pole, the poles of the depth, the geometry."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from petsc4py import PETSc

from hydroelastic.fem.direct import direct_solver
from hydroelastic.fem.modes import Mode
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.plan.plan_pencil import PlanLiquid, PoleOperator
from hydroelastic.fem.spectral_error import cell_errors


def liquid_errors(pencil: CoupledPencil[PlanLiquid], modes: list[Mode]) -> NDArray[np.float64]:
    """Estimate (λ_h − λ)/λ by the space of ψ (collective).

        Σ_j c_j ∫|∇(ψ_j − ψ_jh)|² + d_j (ψ_j − ψ_jh)²        at unit generalized mass

    from the decay of each pole's ∇ψ_j with the polynomial degree.

    Args:
        pencil: the problem.
        modes: some of its modes.

    Returns:
        The estimate for each mode, shape (modes,).
    """
    operator = pencil.solver
    assert isinstance(operator, PoleOperator)
    potentials: list[PETSc.Vec] = []
    weights = []
    load = pencil.coupling.createVecLeft()
    for number, mode in enumerate(modes):
        pencil.coupling.mult(mode.displacement, load)
        for pole, part in operator.parts(load.array_r):
            potential = load.duplicate()
            potential.array[:] = part
            potentials.append(potential)
            weights.append((number, pencil.liquid.poles.weights[pole]))
    errors = np.zeros(len(modes))
    if potentials:
        energies = cell_errors(pencil.liquid.space.liquid, potentials).sum(axis=1)
        for energy, (number, weight) in zip(energies, weights, strict=True):
            errors[number] += weight * energy
    return np.asarray(operator.comm.allreduce(errors))


def pole_errors(pencil: CoupledPencil[PlanLiquid], modes: list[Mode]) -> NDArray[np.float64]:
    """Bound (λ_h − λ)/λ by the poles: with f_h ≤ f ≤ f_h + ε(1 + (k/k_w)²) f and ψ = f_h ζ

        (λ_h − λ)/λ ≤ ε ∫ζψ + (ε/k_w²) ∫k²ζψ,    k²ζ = M₂⁻¹K₂ζ        at unit generalized mass

    up to the square of the left-hand side. Shape (modes,).
    """
    liquid = pencil.liquid
    load, potential = pencil.coupling.createVecLeft(), pencil.coupling.createVecLeft()
    image, height = load.duplicate(), load.duplicate()
    solver = direct_solver(liquid.space.mass)
    errors = []
    for mode in modes:
        pencil.coupling.mult(mode.displacement, load)
        pencil.solver.solve(load, potential)
        solver.solve(load, height)
        liquid.space.stiffness.mult(potential, image)
        errors.append(
            liquid.poles.error * (load.dot(potential) + image.dot(height) / liquid.poles.wavenumber**2)
        )
    return np.array(errors)
