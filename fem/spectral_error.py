"""Frequency error of a mode from the decay of its liquid motion with the polynomial degree.

Ritz values come from above: with ψ_h the best continuous polynomial of degree p, at unit generalized mass,

    (λ_h − λ)/λ = ρ ∫|∇(ψ − ψ_h)|²    up to terms of higher order,

because the error in ψ is the only one while the surface unknowns represent every boundary value of ψ. In each cell ∇ψ_h
is written in
orthonormal polynomials; s_k is the energy ∫|∇ψ|² in those of degree k. Beyond p − 1 the decay of s_k is extrapolated:
by a factor r = s_k/s_{k−1} a degree where ψ is smooth, like a power of k beside a singularity, where r rises towards 1.
Either way the missing part is about s_{p−1} r/(1 − r), summed over the cells. Where ψ is nearly even or odd in a cell,
the s_k of every other degree are small, and pairs of them are compared instead.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import lru_cache
from math import comb

import basix
import basix.ufl
import numpy as np
from petsc4py import PETSc

from hydroelastic.fem.cells import CURVED_QUADRATURE, cell_jacobians, is_straight, owned_cells
from hydroelastic.fem.liquid import LiquidSpace, cell_values

LOWEST_DEGREE = 4
"""Four degrees of ∇ψ must be there to see a decay."""

# A continuous polynomial has a larger error than the best one of each cell. Measured on 21 tanks with exact
# frequencies,
# degrees 4 to 9: 0.6 to 2.2 times, 1.75 where the decay is clear.
_CONTINUITY = 2.0
# A step this much steeper than the one before is that of a ψ that is nearly even or odd in the cell.
_UNEVEN = 5.0
# Slowest decay that a few degrees can tell from none: that of r^{1/2} in the cells at its tip at degree 10.
_SLOWEST_DECAY = 0.75
# Curved cells are treated so many at once; of more potentials than these the coefficients of all functions come first.
_AT_ONCE, _MANY = 64, 10


def cell_errors(liquid: LiquidSpace, potentials: list[PETSc.Vec], exponents: np.ndarray | None = None) -> np.ndarray:
    """Estimate (λ_h − λ)/λ of modes at unit generalized mass, cell by cell."""
    if liquid.degree < LOWEST_DEGREE:
        raise ValueError(f"errors are seen from degree {LOWEST_DEGREE} on, got {liquid.degree}")
    mesh = liquid.tank.mesh
    cells = owned_cells(mesh)
    if not potentials:
        return np.empty((0, len(cells)))
    energies = _straight_energies(liquid) if is_straight(mesh) else _curved_energies(liquid)
    of_degrees = energies(cell_values(liquid, potentials))
    missing = missing_energy(*of_degrees)
    if exponents is not None:
        missing = np.maximum(missing, _CONTINUITY * liquid.degree / (4.0 * exponents) * of_degrees[0])
    errors: np.ndarray = liquid.energy_densities() * missing
    return errors


def missing_energy(last: np.ndarray, second: np.ndarray, third: np.ndarray, fourth: np.ndarray) -> np.ndarray:
    """Energy of ∇ψ in the degrees from p on, from that in p − 1 … p − 4."""
    # Cells at rest have no energy in any degree.
    floor = np.finfo(last.dtype).tiny
    step, step_before = last / (second + floor), second / (third + floor)
    two_steps = np.sqrt(last / (third + floor))
    decay = np.where(step > 1.0, two_steps, np.maximum(step, two_steps))
    single = _series(last, np.minimum(decay, _SLOWEST_DECAY))
    pair = _series(last + second, np.minimum((last + second) / (third + fourth + floor), _SLOWEST_DECAY**2))
    missing: np.ndarray = _CONTINUITY * np.where(step_before > _UNEVEN * step, np.maximum(single, pair), single)
    return missing


def _series(last: np.ndarray, ratio: np.ndarray) -> np.ndarray:
    rest: np.ndarray = last * ratio / (1.0 - ratio)
    return rest


Energies = Callable[[np.ndarray], list[np.ndarray]]
"""From values of ψ in each cell (potentials, cells, functions) to ∫|∇ψ|² (potentials, cells) in the degrees p − 1 …
p − 4."""


def _straight_energies(liquid: LiquidSpace) -> Energies:
    coefficients, starts = straight_coefficients(liquid)

    def energies(values: np.ndarray) -> list[np.ndarray]:
        squares = np.square(coefficients(values))
        polynomials = squares.shape[3]
        # A product of matrices sums over axes and polynomials of a degree.
        of_degree = np.repeat(np.eye(4), np.diff([0, *starts, polynomials]), axis=0)
        sums = squares.reshape(-1, squares.shape[2] * polynomials) @ np.tile(of_degree, (squares.shape[2], 1))
        return list(np.moveaxis(sums.reshape(*values.shape[:2], 4), 2, 0))

    return energies


def straight_coefficients(liquid: LiquidSpace) -> tuple[Callable[[np.ndarray], np.ndarray], np.ndarray]:
    """On straight cells ∇ψ is a polynomial, and one table turns unknowns into its coefficients."""
    inverse, measure = liquid.cells.straight
    scaled = inverse.transpose(0, 2, 1) * np.sqrt(measure)[:, None, None]
    table, starts = _gradient_coefficients(liquid.space.element.basix_element.cell_type, liquid.degree)

    def coefficients(values: np.ndarray) -> np.ndarray:
        # One product of matrices for all potentials and cells.
        reference: np.ndarray = np.tensordot(values, table, (2, 2))
        return scaled @ reference

    return coefficients, starts


def gradient_coefficients(liquid: LiquidSpace) -> Callable[[np.ndarray], list[np.ndarray]]:
    """Return `straight_coefficients`, or the same on curved cells: of each axis in turn."""
    if is_straight(liquid.tank.mesh):
        straight, starts = straight_coefficients(liquid)

        def by_degree(values: np.ndarray) -> list[np.ndarray]:
            split = np.split(straight(values), starts, axis=-1)
            # In full, because −1 stands for nothing where a process has no cells.
            return [part.reshape(*values.shape[:2], part.shape[2] * part.shape[3]) for part in split]

        return by_degree
    parts, sizes = _curved_parts(liquid)

    def coefficients(values: np.ndarray) -> list[np.ndarray]:
        whole = np.concatenate([found for _, found in parts(values)]) if values.shape[1] else np.zeros((0, 0, 0, 0))
        count, dim = sizes[-1], liquid.tank.mesh.topology.dim
        turned = whole.reshape(values.shape[1], count, dim, len(values)).transpose(3, 0, 2, 1)
        return [
            turned[..., first:last].reshape(*values.shape[:2], dim * (last - first))
            for first, last in zip(sizes[-2::-1], sizes[:0:-1], strict=True)
        ]

    return coefficients


def _curved_energies(liquid: LiquidSpace) -> Energies:
    parts, sizes = _curved_parts(liquid)

    def energies(values: np.ndarray) -> list[np.ndarray]:
        squares = np.empty((*values.shape[:2], sizes[-1]))
        for some, coefficients in parts(values):
            squares[:, some] = np.square(coefficients).sum(axis=2).transpose(2, 0, 1)
        return [squares[:, :, first:last].sum(axis=2) for first, last in zip(sizes[-2::-1], sizes[:0:-1], strict=True)]

    return energies


def _curved_parts(
    liquid: LiquidSpace,
) -> tuple[Callable[[np.ndarray], Iterator[tuple[slice, np.ndarray]]], list[int]]:
    """On curved cells √(det J) ∇ψ is nearly a polynomial, and its coefficients come from quadrature; ∫|∇ψ|² stays
    exact."""
    mesh = liquid.tank.mesh
    element = liquid.space.element.basix_element
    points, weights = basix.make_quadrature(element.cell_type, 2 * liquid.degree + CURVED_QUADRATURE)
    slopes = element.tabulate(1, points)[1:, :, :, 0]
    jacobian = cell_jacobians(mesh, owned_cells(mesh), points)
    # Points of the cell first: one product of matrices for each of them.
    scaled = np.sqrt(np.abs(np.linalg.det(jacobian)))[..., None, None] * np.linalg.inv(jacobian)
    polynomials, sizes = _polynomials(element.cell_type, liquid.degree - 1, points)
    lowest = sizes[liquid.degree - 4]
    weighted = (polynomials * weights)[lowest:]

    def parts(values: np.ndarray) -> Iterator[tuple[slice, np.ndarray]]:
        for first in range(0, values.shape[1], _AT_ONCE):
            some = slice(first, first + _AT_ONCE)
            own, turned = values[:, some].transpose(1, 2, 0), scaled[some]
            cells, count = len(own), turned.shape[1]
            if len(values) > _MANY:
                fields = np.einsum("cqde,dqn->cqen", turned, slopes)
                table = weighted @ fields.reshape(cells, count, -1)
                found = table.reshape(cells, -1, own.shape[1]) @ own
            else:
                reference = slopes.reshape(-1, slopes.shape[2]) @ own
                fields = np.einsum("cqde,cdqm->cqem", turned, reference.reshape(cells, -1, count, len(values)))
                found = weighted @ fields.reshape(cells, count, -1)
            yield some, found.reshape(cells, len(weighted), -1, len(values))

    return parts, [size - lowest for size in sizes[liquid.degree - 4 : liquid.degree + 1]]


def _polynomials(cell_type: basix.CellType, degree: int, points: np.ndarray) -> tuple[np.ndarray, list[int]]:
    """Orthonormal polynomials at points, shape (polynomials, points), and where those of each degree begin."""
    dim = len(basix.topology(cell_type)) - 1
    # Ordered by degree: those of degree k and less come first.
    table = basix.tabulate_polynomials(basix.PolynomialType.legendre, cell_type, degree, points)
    return table, [0, *(comb(k + dim, dim) for k in range(degree + 1))]


@lru_cache(maxsize=16)
def _gradient_coefficients(cell_type: basix.CellType, degree: int) -> tuple[np.ndarray, np.ndarray]:
    """Coefficients of the reference gradient of each basis function in orthonormal polynomials."""
    element = basix.ufl.element("Lagrange", cell_type.name, degree).basix_element
    points, weights = basix.make_quadrature(cell_type, 2 * degree - 2)
    slopes = element.tabulate(1, points)[1:, :, :, 0]
    polynomials, sizes = _polynomials(cell_type, degree - 1, points)
    coefficients = np.einsum("jq,q,dqn->djn", polynomials, weights, slopes, optimize=True)
    degrees = range(degree - 1, degree - 5, -1)
    table = np.concatenate([coefficients[:, sizes[k] : sizes[k + 1]] for k in degrees], axis=1)
    return table, np.cumsum([sizes[k + 1] - sizes[k] for k in degrees])[:-1]
