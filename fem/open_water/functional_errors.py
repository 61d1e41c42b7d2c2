"""Errors that the mesh leaves in motions, deflections and loads in waves, by the dual problem of each.

A quantity J that is linear in the motions a and the scattered waves ψ, J = m·a + λ∫ρ g ψ over the bodies, as the
deflection or the bending moment at a point, has the error of the Galerkin method

    J_h − J = λ A_λ(ψ_y − ψ_yh, ψ − ψ_h),    ψ_y = Σ yᵢ ψᵢ,    y = γ + D⁻¹ m,    D = K − iωB − λ(M_b + H),

with the coefficients γ of g in the shapes of the bodies and ψᵢ radiated by a unit of each: A_λ(·, ψ − ψ_h) vanishes on
the trial functions, D is symmetric, and D δa = λ A_λ(Ψ − Ψ_h, ψ − ψ_h). y are the motions of the free bodies under the
load of J. Hence |J_h − J| ≤ λ Σ √(E_y E), summed over the cells, with the energy errors E_y of ψ_y and E of ψ in each:
ψ_y is rough where the functional jumps, which costs nothing where ψ is smooth. In long waves a body follows the surface
and scatters next to nothing, E is small, and so are the errors of loads, however small the loads are.

The part r of the power of outgoing waves that the ends of the absorbing layer reflect, `AbsorbingLayer.reflected`,
changes J likewise by r λ √(P_y P), P = Σ kN|c|² of the waves of ψ_y and of ψ.

Source: the dual of a goal functional, R. Becker, R. Rannacher, Acta Numerica 10 (2001), § 2.
"""

from __future__ import annotations

import numpy as np

from hydroelastic.fem.open_water.frequency import OpenResponse


def functional_errors(response: OpenResponse, dual: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Estimate errors of functionals J in each incident wave away from tips, with the absorbing layer, and at tips
    (collective)."""
    model, squared = response.model, abs(response.squared)
    loaded = model.cells_missed(response.radiated_by(dual))
    away, tips = model.summed_over_cells(np.sqrt(loaded[:, None] * response.missed))
    radiated = response.incidence.amplitudes((response.incidence.pressures - response.equations.radiated) @ dual.T)
    powers = response.incidence.powers @ np.abs(radiated) ** 2
    reflected = response.reflected * np.sqrt(np.outer(powers, response.scattered_powers))
    return squared * (away + reflected), squared * tips


def dual_motions(response: OpenResponse, of_motions: np.ndarray) -> np.ndarray:
    """Return D⁻¹ m of functionals m·a of the motions, both of shape (functionals, body unknowns)."""
    dual: np.ndarray = np.linalg.solve(response.equations.dynamic, of_motions.T).T
    return dual
