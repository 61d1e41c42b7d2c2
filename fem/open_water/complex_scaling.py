"""Exterior complex scaling: outgoing waves as decaying ones, so that a mesh of finite size holds open water.

Beyond the sides of a basin the coordinate normal to the side is rotated into the complex plane, x̃ = x₀ + s (x − x₀)
with s = e^{iα}. An outgoing wave e^{ikx} becomes e^{ikx₀} e^{iks(x − x₀)} and decays like e^{−k (x − x₀) sin α}; within
the basin nothing changes. With s_i the factor of the axis i in a cell (s where that axis is rotated, else 1),

    A = ∫ρ [Σᵢ (det/sᵢ²) ∂ᵢψ ∂ᵢq + det m² ψq] w,    S = ∫(det/s_n) ψ q w over surfaces of normal n,    det = Πsᵢ

are complex symmetric and do not depend on the frequency. The weight w and m² are those of `physics.geometry`: in a
half-plane of revolution w = r̃ and m² = n²/r̃² vary within the cells. Source: B. Simon, Phys. Lett. A 71 (1979) 211;
for water waves C. Hazard and M. Lenoir, SIAM J. Math. Anal. 24 (1993) 1458.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from dolfinx.mesh import Mesh
from petsc4py import PETSc

from hydroelastic.fem.cell_matrices import TOGETHER
from hydroelastic.fem.cells import cell_corners, cell_positions, owned_cells
from hydroelastic.fem.liquid import LiquidSpace
from hydroelastic.fem.liquid_matrices import surface_mass_matrix

# Step of the derivatives with respect to α, rad: their error of fourth order is that of rounding.
_STEP = 5e-4


@dataclass(frozen=True, kw_only=True)
class ComplexScaling:
    """Region and angle of the complex scaling."""

    angle: float  # angle α of the rotation, rad
    low: tuple[float, ...]  # lower bounds of the basin, shape (gdim,)
    high: tuple[float, ...]  # upper bounds, shape (gdim,)

    def turned(self, mesh: Mesh) -> np.ndarray:
        """Whether each axis is rotated in each cell of this process, shape (cells, gdim)."""
        cells = mesh.topology.index_map(mesh.topology.dim)
        middles = cell_corners(mesh, np.arange(cells.size_local + cells.num_ghosts, dtype=np.int32)).mean(axis=1)
        outside: np.ndarray = (middles < np.array(self.low)) | (middles > np.array(self.high))
        return outside

    def weights(self, values: Callable[[complex], np.ndarray], *, derivative: bool) -> np.ndarray:
        """Return an analytic function of s = e^{iα}, or its derivative with respect to α."""
        if not derivative:
            return values(np.exp(1j * self.angle))
        steps = {-2: 1.0, -1: -8.0, 1: 8.0, 2: -1.0}
        parts = (factor * values(np.exp(1j * (self.angle + step * _STEP))) for step, factor in steps.items())
        return np.asarray(sum(parts)) / (12.0 * _STEP)


@dataclass(frozen=True, kw_only=True)
class ComplexMatrix:
    """Real and imaginary part of a complex matrix, with the same parallel layout."""

    real: PETSc.Mat
    imaginary: PETSc.Mat


def scaled_laplace(liquid: LiquidSpace, scaling: ComplexScaling, *, derivative: bool = False) -> ComplexMatrix:
    """Assemble A, or its derivative with respect to α, on all unknowns, ρ included (collective)."""
    mesh, geometry = liquid.tank.mesh, liquid.geometry
    cells = owned_cells(mesh)
    turned = scaling.turned(mesh)[cells].astype(float)
    det = turned.sum(axis=1, keepdims=True)
    # Exponents of s in the terms ∂₁ψ∂₁q, ∂₂ψ∂₂q and ψq, shape (cells, 1, terms).
    exponents = np.hstack([det - 2.0 * turned, *([det] if geometry.transverse else [])])[:, None]
    densities = liquid.cell_densities()[:, None, None]
    abscissas = cell_positions(mesh, cells, liquid.cells.points)[..., 0]

    def values(s: complex) -> np.ndarray:
        weights = geometry.weight(np.where(turned[:, :1] > 0.0, _turned(abscissas, scaling.high[0], s), abscissas))
        transverse = (geometry.transverse / weights,) if geometry.transverse else ()
        return np.asarray(densities * s**exponents * np.stack([weights, weights, *transverse], axis=-1))

    weights = scaling.weights(values, derivative=derivative)

    def part(chosen: np.ndarray, values: np.ndarray) -> PETSc.Mat:
        some = [slice(first, first + TOGETHER) for first in range(0, len(chosen), TOGETHER)]
        dofs = liquid.space.dofmap.list[chosen]
        return liquid.numbering.assembled(
            [(dofs[few], liquid.cells.integrals(chosen[few], values[few])) for few in some]
        )

    beyond = np.flatnonzero(det[:, 0] > 0.0)
    return ComplexMatrix(real=part(cells, weights.real), imaginary=part(beyond, weights[beyond].imag))


def scaled_surface_mass(
    liquid: LiquidSpace, scaling: ComplexScaling, name: str, *, derivative: bool = False
) -> ComplexMatrix:
    """Assemble S over a named horizontal surface, or its derivative with respect to α, on all unknowns (collective)."""
    turned = scaling.turned(liquid.tank.mesh)[:, 0].astype(float)

    def weights(cells: np.ndarray, abscissas: np.ndarray) -> np.ndarray:
        along = turned[cells, None]

        def values(s: complex) -> np.ndarray:
            radii = np.where(along > 0.0, _turned(abscissas, scaling.high[0], s), abscissas)
            return np.asarray(s**along * liquid.geometry.weight(radii))

        return scaling.weights(values, derivative=derivative)

    return ComplexMatrix(
        real=surface_mass_matrix(liquid, (name,), lambda *where: weights(*where).real),
        imaginary=surface_mass_matrix(liquid, (name,), lambda *where: weights(*where).imag),
    )


def _turned(abscissas: np.ndarray, edge: float, s: complex) -> np.ndarray:
    return np.asarray(edge + s * (abscissas - edge))


def gradient_weights(liquid: LiquidSpace, scaling: ComplexScaling) -> np.ndarray:
    """Return ρ (det/sᵢ²) w of the terms (∂ᵢψ)² of A in the middle of each owned cell, complex, shape (cells, gdim)."""
    mesh, s = liquid.tank.mesh, np.exp(1j * scaling.angle)
    cells = owned_cells(mesh)
    turned = scaling.turned(mesh)[cells].astype(float)
    middles = cell_corners(mesh, cells)[..., 0].mean(axis=1)
    radii = np.where(turned[:, 0] > 0.0, _turned(middles, scaling.high[0], s), middles)
    factors = s ** (turned.sum(axis=1, keepdims=True) - 2.0 * turned)
    return np.asarray((liquid.cell_densities() * liquid.geometry.weight(radii))[:, None] * factors)


def complex_product(matrix: ComplexMatrix, vector: np.ndarray) -> np.ndarray:
    """Return the product of a complex matrix and a complex vector of own entries, shape (own rows,) (collective)."""
    real, imaginary = (_real_product(part, vector) for part in (matrix.real, matrix.imaginary))
    product: np.ndarray = real + 1j * imaginary
    return product


def _real_product(matrix: PETSc.Mat, vector: np.ndarray) -> np.ndarray:
    source, target = matrix.createVecs()
    parts = []
    for part in (vector.real, vector.imag):
        source.array[:] = part
        matrix.mult(source, target)
        parts.append(target.array_r.copy())
    product: np.ndarray = parts[0] + 1j * parts[1]
    return product
