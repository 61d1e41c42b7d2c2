"""Exterior complex scaling: outgoing waves as decaying ones, so that a mesh of finite size holds open water.

Beyond the sides of a basin the coordinate normal to the side is rotated into the complex plane, x̃ = x₀ + s (x − x₀)
with s = e^{iα}. An outgoing wave e^{ikx} becomes e^{ikx₀} e^{iks(x − x₀)} and decays like e^{−k (x − x₀) sin α}; within
the basin nothing changes. With s_i the factor of the axis i in a cell (s where that axis is rotated, else 1),

    A = ∫ρ Σᵢ (det/sᵢ²) ∂ᵢψ ∂ᵢq,    S = ∫(det/s_n) ψ q over surfaces of normal n,    det = Πsᵢ

are complex symmetric and do not depend on the frequency. Source: B. Simon, Phys. Lett. A 71 (1979) 211; for water waves
C. Hazard and M. Lenoir, SIAM J. Math. Anal. 24 (1993) 1458.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import ufl
from dolfinx import fem
from dolfinx.mesh import Mesh
from petsc4py import PETSc

from hydroelastic.fem.cells import CURVED_QUADRATURE, cell_corners, is_straight, owned_cells
from hydroelastic.fem.kernels import NO_ENTITIES, assembled, chosen_measure, compiled_form
from hydroelastic.fem.liquid import LiquidSpace


@dataclass(frozen=True, kw_only=True)
class ComplexScaling:
    """Region and angle of the complex scaling.

    Attributes:
        angle: angle α of the rotation, rad.
        low: lower bounds of the basin, shape (gdim,).
        high: upper bounds, shape (gdim,).
    """

    angle: float
    low: tuple[float, ...]
    high: tuple[float, ...]

    def turned(self, mesh: Mesh) -> np.ndarray:
        """Whether each axis is rotated in each cell of this process, shape (cells, gdim)."""
        cells = mesh.topology.index_map(mesh.topology.dim)
        middles = cell_corners(mesh, np.arange(cells.size_local + cells.num_ghosts, dtype=np.int32)).mean(axis=1)
        outside: np.ndarray = (middles < np.array(self.low)) | (middles > np.array(self.high))
        return outside

    def power(self, exponents: np.ndarray, *, derivative: bool) -> np.ndarray:
        """Return sⁿ with s = e^{iα}, or its derivative in sⁿ with respect to α; shape of the exponents n."""
        powers: np.ndarray = np.exp(1j * self.angle * exponents)
        return 1j * exponents * powers if derivative else powers


@dataclass(frozen=True, kw_only=True)
class ComplexMatrix:
    """Real and imaginary part of a complex matrix, with the same parallel layout."""

    real: PETSc.Mat
    imaginary: PETSc.Mat


def scaled_laplace(liquid: LiquidSpace, scaling: ComplexScaling, *, derivative: bool = False) -> ComplexMatrix:
    """Assemble A, or its derivative with respect to α, on all unknowns, ρ included (collective)."""
    turned = scaling.turned(liquid.tank.mesh).astype(float)
    exponents = turned.sum(axis=1, keepdims=True) - 2.0 * turned
    weights = _densities(liquid)[:, None] * scaling.power(exponents, derivative=derivative)
    return _both_parts(liquid, weights, np.zeros(len(turned)), NO_ENTITIES)


def scaled_surface_mass(
    liquid: LiquidSpace, scaling: ComplexScaling, name: str, *, derivative: bool = False
) -> ComplexMatrix:
    """Assemble S over a named horizontal surface, or its derivative with respect to α, on all unknowns (collective)."""
    along = scaling.turned(liquid.tank.mesh)[:, :-1].sum(axis=1)
    weights = scaling.power(along, derivative=derivative)
    axes = np.zeros((len(along), liquid.tank.mesh.geometry.dim))
    return _both_parts(liquid, axes, weights, liquid.tank.facets(name))


def _densities(liquid: LiquidSpace) -> np.ndarray:
    """ρ of each cell of this process."""
    cells = liquid.space.dofmap.list
    return np.array([layer.density for layer in liquid.layers])[liquid.layer_of[cells[:, 0]]]


def _both_parts(liquid: LiquidSpace, axes: np.ndarray, surface: np.ndarray, facets: np.ndarray) -> ComplexMatrix:
    cells = owned_cells(liquid.tank.mesh) if np.any(axes) else NO_ENTITIES
    parts = (assembled(_weighted_form(liquid, cells, facets, part(axes), part(surface))) for part in (np.real, np.imag))
    real, imaginary = parts
    return ComplexMatrix(real=real, imaginary=imaginary)


def compile_scaled_form(liquid: LiquidSpace) -> None:
    """Compile the form of a space on rank 0, unless the cache of dolfinx has it (collective)."""
    count = len(liquid.space.dofmap.list)
    _weighted_form(liquid, NO_ENTITIES, NO_ENTITIES, np.zeros((count, liquid.tank.mesh.geometry.dim)), np.zeros(count))


def _weighted_form(
    liquid: LiquidSpace, cells: np.ndarray, facets: np.ndarray, axes: np.ndarray, surface: np.ndarray
) -> fem.Form:
    """Σᵢ ∫wᵢ ∂ᵢψ ∂ᵢq over some cells + ∫w ψ q over some facets; the weights are those of cells."""
    mesh, space = liquid.tank.mesh, liquid.space
    constants = fem.functionspace(mesh, ("DG", 0))
    weights = []
    for values in (*axes.T, surface):
        weight = fem.Function(constants)
        weight.x.array[constants.dofmap.list[:, 0]] = values
        weights.append(weight)
    potential, test = ufl.TrialFunction(space), ufl.TestFunction(space)
    more = 0 if is_straight(mesh) else CURVED_QUADRATURE
    dx = chosen_measure("dx", mesh, mesh.topology.dim, cells, 2 * liquid.degree - 2 + more)
    ds = chosen_measure("ds", mesh, mesh.topology.dim - 1, facets, 2 * liquid.degree + more)
    energy = sum(weight * potential.dx(axis) * test.dx(axis) for axis, weight in enumerate(weights[:-1]))
    return compiled_form(energy * dx + weights[-1] * potential * test * ds)


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
