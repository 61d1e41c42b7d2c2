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

import basix
import basix.ufl
import numpy as np
import ufl
from dolfinx import fem
from dolfinx.mesh import Mesh
from petsc4py import PETSc

from hydroelastic.fem.cell_matrices import TRANSVERSE_QUADRATURE
from hydroelastic.fem.cells import CURVED_QUADRATURE, cell_corners, cell_positions, is_straight, owned_cells
from hydroelastic.fem.kernels import NO_ENTITIES, assembled, chosen_measure, compiled_form
from hydroelastic.fem.liquid import LiquidSpace

# Step of the derivatives with respect to α, rad: their error of fourth order is that of rounding.
_STEP = 5e-4


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
    turned = scaling.turned(liquid.tank.mesh).astype(float)
    det = turned.sum(axis=1, keepdims=True)
    # Exponents of s in the terms ∂₁ψ∂₁q, ∂₂ψ∂₂q and ψq, shape (cells, 1, terms).
    exponents = np.hstack([det - 2.0 * turned, det])[:, None]
    densities, geometry = _densities(liquid)[:, None, None], liquid.geometry
    abscissas = cell_positions(liquid.tank.mesh, np.arange(len(turned)), _points(liquid))[..., 0]

    def values(s: complex) -> np.ndarray:
        powers = s**exponents * np.array([1.0, 1.0, geometry.transverse])
        if geometry.is_revolved:
            radii = np.where(turned[:, :1] > 0.0, _turned(abscissas, scaling.high[0], s), abscissas)
            powers = powers * np.stack([radii, radii, 1.0 / radii], axis=-1)
        return np.asarray(densities * powers)

    weights = scaling.weights(values, derivative=derivative)
    return _both_parts(liquid, owned_cells(liquid.tank.mesh), weights, np.zeros((len(turned), 2)), NO_ENTITIES)


def scaled_surface_mass(
    liquid: LiquidSpace, scaling: ComplexScaling, name: str, *, derivative: bool = False
) -> ComplexMatrix:
    """Assemble S over a named horizontal surface, or its derivative with respect to α, on all unknowns (collective)."""
    along = scaling.turned(liquid.tank.mesh)[:, 0].astype(float)

    def values(s: complex) -> np.ndarray:
        """The weight as a constant and a multiple of x in each cell."""
        power = s**along
        if not liquid.geometry.is_revolved:
            return np.stack([power, np.zeros_like(power)], axis=1)
        return np.stack([power * (1.0 - power) * np.where(along, scaling.high[0], 0.0), power**2], axis=1)

    weights = scaling.weights(values, derivative=derivative)
    return _both_parts(liquid, NO_ENTITIES, np.zeros((len(along), 1, 3)), weights, liquid.tank.facets(name))


def _turned(abscissas: np.ndarray, edge: float, s: complex) -> np.ndarray:
    """x̃ at abscissas beyond the edge of the basin."""
    return np.asarray(edge + s * (abscissas - edge))


def _densities(liquid: LiquidSpace) -> np.ndarray:
    """ρ of each cell of this process."""
    cells = liquid.space.dofmap.list
    return np.array([layer.density for layer in liquid.layers])[liquid.layer_of[cells[:, 0]]]


def _both_parts(
    liquid: LiquidSpace, cells: np.ndarray, terms: np.ndarray, surface: np.ndarray, facets: np.ndarray
) -> ComplexMatrix:
    form, weights = _weighted_form(liquid, cells, facets, terms, surface)
    matrices = []
    for part in (np.real, np.imag):
        for function, values in weights:
            function.x.array[function.function_space.dofmap.list] = part(values)
        matrices.append(assembled(form))
    return ComplexMatrix(real=matrices[0], imaginary=matrices[1])


def compile_scaled_form(liquid: LiquidSpace) -> None:
    """Compile the form of a space on rank 0, unless the cache of dolfinx has it (collective)."""
    count = len(liquid.space.dofmap.list)
    _weighted_form(liquid, NO_ENTITIES, NO_ENTITIES, np.zeros((count, 1, 3)), np.zeros((count, 2)))


def _quadrature_degree(liquid: LiquidSpace) -> int:
    more = 0 if is_straight(liquid.tank.mesh) else CURVED_QUADRATURE
    return 2 * liquid.degree - 2 + more + (0 if liquid.geometry.kind == "plane" else TRANSVERSE_QUADRATURE)


def _points(liquid: LiquidSpace) -> np.ndarray:
    """Quadrature points of the reference cell, shape (points, dim); one of them where weights are those of cells."""
    points, _ = basix.make_quadrature(liquid.space.element.basix_element.cell_type, _quadrature_degree(liquid))
    return points if liquid.geometry.is_revolved else points[:1]


def _weighted_form(
    liquid: LiquidSpace, cells: np.ndarray, facets: np.ndarray, terms: np.ndarray, surface: np.ndarray
) -> tuple[fem.Form, list[tuple[fem.Function, np.ndarray]]]:
    """Return the form ∫(w₁ ∂₁ψ ∂₁q + w₂ ∂₂ψ ∂₂q + w₃ ψq) over some cells + ∫(v₀ + v₁ x) ψq over some facets, and the
    functions in it that stand for w and v, each with its complex values on the unknowns of each cell.

    Args:
        liquid: space of ψ.
        cells: the cells.
        facets: the facets.
        terms: w of each cell, or at its quadrature points, shape (cells, points, 3). In a plane there is no w₃.
        surface: v of each cell, shape (cells, 2); v₁ is that of revolution only.
    """
    mesh, space, geometry = liquid.tank.mesh, liquid.space, liquid.geometry
    degree = _quadrature_degree(liquid)
    constants = fem.functionspace(mesh, ("DG", 0))
    varying = constants
    if geometry.is_revolved:
        varying = fem.functionspace(mesh, basix.ufl.quadrature_element(mesh.topology.cell_name(), degree=degree))

    weights = []

    def weight(where: fem.FunctionSpace, values: np.ndarray) -> fem.Function:
        function = fem.Function(where)
        weights.append((function, values))
        return function

    potential, test = ufl.TrialFunction(space), ufl.TestFunction(space)
    dx = chosen_measure("dx", mesh, mesh.topology.dim, cells, degree)
    ds = chosen_measure("ds", mesh, mesh.topology.dim - 1, facets, degree + 2)
    energy = sum(weight(varying, terms[..., axis]) * potential.dx(axis) * test.dx(axis) for axis in range(2))
    trace = weight(constants, surface[:, :1])
    if geometry.kind != "plane":
        energy += weight(varying, terms[..., 2]) * potential * test
    if geometry.is_revolved:
        trace += weight(constants, surface[:, 1:]) * ufl.SpatialCoordinate(mesh)[0]
    return compiled_form(energy * dx + trace * potential * test * ds), weights


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
