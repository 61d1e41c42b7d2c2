"""Errors of modes on a plan by the space of ψ and by the poles of the depth."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from petsc4py import PETSc
from scipy.optimize import linprog

from hydroelastic.fem.direct import direct_solver
from hydroelastic.fem.modes import Mode
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.plan.plan_pencil import PlanLiquid, PoleOperator
from hydroelastic.fem.spectral_error import cell_errors
from hydroelastic.modal.liquid.vertical_poles import VerticalPoles, surface_response

# Samples of k in the bound, and the largest of them in units of the last pole's.
_SAMPLES, _REACH = 500, 1e2
# The linear program keeps two digits of the plain bound.
_LEAST = 1e-2


def liquid_and_pole_errors(
    pencil: CoupledPencil[PlanLiquid], modes: list[Mode], depth: float, lowest: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Estimate (λ_h − λ)/λ by the space of ψ, and bound it by the poles (collective).

    At unit generalized mass the first one is

        Σ_j c_j ∫|∇(ψ_j − ψ_jh)|² + d_j (ψ_j − ψ_jh)²

    of which the part of the gradients follows from the decay of each pole's ∇ψ_j with the polynomial degree. The second
    one is ∫(f − f_h)dμ, with the measure μ of the squares of ζ over k². Of μ the moments ∫dμ/(k² + d_j) and ∫dμ are
    known, the energies of the poles and ∫ζ²: it is at most the smallest combination of them that is nowhere less than
    f − f_h, a linear program.

    Args:
        pencil: the problem.
        modes: some of its modes.
        depth: H.
        lowest: a lower bound of the wavenumbers of the plan.

    Returns:
        The part of the gradients and the bound, of each mode, shape (modes,).
    """
    operator = pencil.solver
    assert isinstance(operator, PoleOperator)
    poles = pencil.liquid.poles
    errors, moments = np.zeros(len(modes)), np.zeros((len(modes), len(poles.shifts) + 1))
    potentials: list[PETSc.Vec] = []
    places = []
    load, height = pencil.coupling.createVecLeft(), pencil.coupling.createVecLeft()
    mass = direct_solver(pencil.liquid.space.mass)
    space = pencil.liquid.space
    for number, mode in enumerate(modes):
        pencil.coupling.mult(mode.displacement, load)
        for pole, part in operator.parts(load.array_r):
            potentials.append(PETSc.Vec().createWithArray(space.expanded(part), comm=PETSc.COMM_SELF))
            places.append((number, pole))
            moments[number, pole] = load.array_r @ part
        mass.solve(load, height)
        moments[number, -1] = load.dot(height) / operator.comm.size
    if potentials:
        energies = space.images * cell_errors(space.liquid, potentials).sum(axis=1)
        for energy, (number, pole) in zip(energies, places, strict=True):
            errors[number] += poles.weights[pole] * energy
    errors, moments = operator.comm.allreduce(errors), operator.comm.allreduce(moments)
    return np.asarray(errors), _largest_missing(poles, moments, depth, lowest)


def _largest_missing(
    poles: VerticalPoles, moments: NDArray[np.float64], depth: float, lowest: float
) -> NDArray[np.float64]:
    """Bound ∫(f − f_h)dμ by the moments of each mode, shape (modes,)."""
    wavenumbers = np.geomspace(lowest, _REACH * np.sqrt(poles.shifts[-1]), _SAMPLES)
    exact = surface_response(wavenumbers, depth)
    allowed = exact * (1.0 + (wavenumbers / poles.wavenumber) ** 2) * poles.error
    missing = np.maximum(exact - poles.values(wavenumbers), 0.0) / allowed
    functions = (
        np.column_stack([1.0 / (wavenumbers[:, None] ** 2 + poles.shifts), np.ones(_SAMPLES)]) / allowed[:, None]
    )
    sizes = functions.max(axis=0)
    # The bound of the poles themselves, ε(1 + (k/k_w)²) f_h, which is always there.
    plain = np.append(
        poles.weights * (1.0 - poles.shifts / poles.wavenumber**2), poles.weights.sum() / poles.wavenumber**2
    )
    bounds = poles.error * (moments @ plain)
    for number, moment in enumerate(moments):
        # In units of the plain bound, for the program's tolerances are absolute.
        found = linprog(moment / sizes, A_ub=-functions / sizes, b_ub=-missing, bounds=(-1e6, 1e6), method="highs")
        if found.status == 0:
            bounds[number] = min(bounds[number], max(float(found.fun), _LEAST * bounds[number]))
    return bounds
