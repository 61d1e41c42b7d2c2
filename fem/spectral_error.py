"""How far a mode's frequency lies above the exact one, read off the decay of its liquid motion with the degree.

Ritz values come from above: with ψ_h the best continuous polynomial of degree p, at unit generalized mass,

    (λ_h − λ)/λ = ρ ∫|∇(ψ − ψ_h)|²    up to terms of higher order,

for the error in ψ is the only one while the surfaces carry every motion of the trace. In each cell ∇ψ_h is written in
orthonormal polynomials; s_k is the energy ∫|∇ψ|² in those of degree k. Beyond p − 1 the s_k go on as they fell before:
by a factor r = s_k/s_{k−1} a degree where ψ is smooth, like a power of k beside a singularity, where r rises towards 1.
Either way the missing part is about s_{p−1} r/(1 − r), summed over the cells. Where ψ is nearly even or odd in a cell,
the s_k of every other degree are small, and pairs of them are compared instead.
"""

from __future__ import annotations

from functools import lru_cache
from math import comb

import basix
import basix.ufl
import numpy as np
from dolfinx import fem
from petsc4py import PETSc

from hydroelastic.fem.cells import cell_corners, cell_jacobians
from hydroelastic.fem.liquid import LiquidSpace, as_functions

LOWEST_DEGREE = 4
"""Four degrees of ∇ψ must be there to see a decay."""

# A continuous polynomial does worse than the cell by cell best one. Measured on 21 tanks with exact frequencies,
# degrees 4 to 9: 0.6 to 2.2 times, 1.75 where the decay is clear.
_CONTINUITY = 2.0
# A step this much steeper than the one before is that of a ψ that is nearly even or odd in the cell.
_UNEVEN = 5.0
# Slowest decay that a few degrees can tell from none: that of r^{1/2} in the cells at its tip at degree 10.
_SLOWEST_DECAY = 0.75


def cell_errors(liquid: LiquidSpace, potentials: list[PETSc.Vec], density: float) -> np.ndarray:
    """Estimate (λ_h − λ)/λ of modes at unit generalized mass, cell by cell.

    Args:
        liquid: space of ψ, of degree `LOWEST_DEGREE` or more, on straight simplices.
        potentials: ψ of each mode.
        density: ρ.

    Returns:
        The part of each owned cell, shape (modes, cells); their sum over all cells and processes is the estimate.

    Raises:
        ValueError: if the degree is too low.
    """
    if liquid.degree < LOWEST_DEGREE:
        raise ValueError(f"errors are seen from degree {LOWEST_DEGREE} on, got {liquid.degree}")
    cell_type = liquid.space.element.basix_element.cell_type
    gradient = _gradient_coefficients(cell_type, liquid.degree)
    jacobian = cell_jacobians(cell_corners(liquid))
    inverse, measure = np.linalg.inv(jacobian), np.abs(np.linalg.det(jacobian))
    dofs = liquid.space.dofmap.list[: len(jacobian)]
    errors = np.empty((len(potentials), len(jacobian)))
    for number, function in enumerate(as_functions(liquid, potentials)):
        errors[number] = density * _missing_energy(function, dofs, gradient, inverse, measure)
    return errors


def _missing_energy(
    function: fem.Function, dofs: np.ndarray, gradient: tuple[np.ndarray, ...], inverse: np.ndarray, measure: np.ndarray
) -> np.ndarray:
    values = function.x.array[dofs]
    last, second, third, fourth = (_energy(values, table, inverse, measure) for table in gradient)
    # Cells at rest have no energy in any degree.
    floor = np.finfo(float).tiny
    step, step_before = last / (second + floor), second / (third + floor)
    two_steps = np.sqrt(last / (third + floor))
    decay = np.where(step > 1.0, two_steps, np.maximum(step, two_steps))
    single = _series(last, np.minimum(decay, _SLOWEST_DECAY))
    pair = _series(last + second, np.minimum((last + second) / (third + fourth + floor), _SLOWEST_DECAY**2))
    return _CONTINUITY * np.where(step_before > _UNEVEN * step, np.maximum(single, pair), single)


def _series(last: np.ndarray, ratio: np.ndarray) -> np.ndarray:
    """What follows the last term of a geometric series."""
    rest: np.ndarray = last * ratio / (1.0 - ratio)
    return rest


def _energy(values: np.ndarray, table: np.ndarray, inverse: np.ndarray, measure: np.ndarray) -> np.ndarray:
    """∫|∇ψ|² of each cell in the polynomials of one degree."""
    dim, polynomials, functions = table.shape
    reference = (values @ table.reshape(-1, functions).T).reshape(-1, dim, polynomials)
    slopes = np.einsum("cde,cdj->cej", inverse, reference)
    energy: np.ndarray = measure * np.square(slopes).sum(axis=(1, 2))
    return energy


@lru_cache(maxsize=16)
def _gradient_coefficients(cell_type: basix.CellType, degree: int) -> tuple[np.ndarray, ...]:
    """Coefficients of the reference gradient of each basis function in orthonormal polynomials of one degree.

    Returns:
        For the degrees p − 1 down to p − 4: shape (dim, polynomials, functions).
    """
    element = basix.ufl.element("Lagrange", cell_type.name, degree).basix_element
    dim = len(basix.topology(cell_type)) - 1
    points, weights = basix.make_quadrature(cell_type, 2 * degree - 2)
    slopes = element.tabulate(1, points)[1:, :, :, 0]
    # Ordered by degree: those of degree k and less come first.
    polynomials = basix.tabulate_polynomials(basix.PolynomialType.legendre, cell_type, degree - 1, points)
    coefficients = np.einsum("jq,q,dqn->djn", polynomials, weights, slopes, optimize=True)
    sizes = [0, *(comb(k + dim, dim) for k in range(degree))]
    return tuple(coefficients[:, sizes[k] : sizes[k + 1]] for k in range(degree - 1, degree - 5, -1))


def cell_diameters(liquid: LiquidSpace) -> np.ndarray:
    """Longest edge of each owned cell that meets its first corner, shape (cells,)."""
    longest: np.ndarray = np.linalg.norm(cell_jacobians(cell_corners(liquid)), axis=1).max(axis=1, initial=0.0)
    return longest
