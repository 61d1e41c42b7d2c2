"""Far-field fluxes, from ψ in a band of cells between the bodies and the sides of the basin.

For a solution φ of Laplace's equation that satisfies all boundary conditions of the liquids without bodies, as an
incident wave does, the integral

    I(φ) = ∫ρ (φ ∂ψ/∂n − ψ ∂φ/∂n)

is the same over all surfaces around the bodies. With a function χ that is 1 at the bodies and 0 at the basin's sides it
becomes an integral over the band in which χ varies, I(φ) = ∫ρ ∇χ·(φ∇ψ − ψ∇φ). χ is linear in the cells, and the
integral converges as fast as energies do. The force of the waves on the bodies is such an integral too.
"""

from __future__ import annotations

from collections.abc import Callable

import basix
import numpy as np
from mpi4py import MPI

from hydroelastic.fem.cells import CURVED_QUADRATURE, cell_corners, cell_jacobians, cell_positions, owned_cells
from hydroelastic.fem.facets import facet_groups
from hydroelastic.fem.liquid import as_functions
from hydroelastic.fem.open_water.pencil import OpenPencil
from hydroelastic.fem.shape_loads import potential_basis
from hydroelastic.meshes.geometry import FREE_SURFACE

Field = Callable[[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray]]
"""Function of points (..., gdim) and the layer of each (...): complex φ (...) and its gradient (..., gdim)."""


class FarField:
    """Integrals over a band of cells around the bodies, at the sides of a box.

    Args:
        low: lower bounds of the box, within the basin, shape (gdim,); −∞ where that ends at a bed.
        high: upper bounds, shape (gdim,); ∞ where it ends at a top.
    """

    def __init__(self, pencil: OpenPencil, low: tuple[float, ...], high: tuple[float, ...]) -> None:
        """Find the cells of the band (collective)."""
        liquid, mesh = pencil.liquid, pencil.liquid.tank.mesh
        cells = owned_cells(mesh)
        corners = cell_corners(mesh, cells)
        inside = np.all((corners > np.array(low)) & (corners < np.array(high)), axis=2)
        band = inside.any(axis=1) & ~inside.all(axis=1)
        self._pencil = pencil
        self._cells = cells[band]
        element = liquid.space.element.basix_element
        points, self._weights = basix.make_quadrature(element.cell_type, 2 * liquid.degree + CURVED_QUADRATURE)
        table = element.tabulate(1, points)[..., 0]
        self._basis, self._slopes = table[0], table[1:]
        self._points = cell_positions(mesh, self._cells, points)
        jacobians = cell_jacobians(mesh, self._cells, points)
        self._inverse = np.broadcast_to(np.linalg.inv(jacobians), (*self._points.shape[:2], *jacobians.shape[2:]))
        self._measure = np.abs(np.linalg.det(jacobians)) * liquid.geometry.weight(self._points[..., 0])
        # The corners of straight cells; those at the basin's sides lie on straight ones.
        reference = basix.geometry(element.cell_type)
        linear = np.vstack([np.ones(len(reference)), reference.T])
        gradients = np.linalg.inv(linear)[:, 1:]
        chi = np.einsum("cv,vd->cd", inside[band].astype(float), gradients)
        self._chi = np.einsum("cqde,cd->cqe", self._inverse, chi)
        self._layers = liquid.layer_of[liquid.space.dofmap.list[self._cells, 0]]
        self._densities = np.array([layer.density for layer in liquid.layers])[self._layers]

    def fluxes(self, potentials: np.ndarray, fields: list[Field]) -> np.ndarray:
        """Return I(φ) of every ψ (collective)."""
        total = np.zeros((len(fields), len(potentials)), dtype=complex)
        values = [self._values(potential) for potential in potentials]
        layers = np.broadcast_to(self._layers[:, None], self._points.shape[:2])
        weights = self._measure * self._weights * self._densities[:, None]
        for row, field in enumerate(fields):
            phi, gradient = field(self._points, layers)
            for column, (psi, slope) in enumerate(values):
                flux = (self._chi * (phi[..., None] * slope - psi[..., None] * gradient)).sum(axis=2)
                total[row, column] = np.sum(weights * flux)
        self._pencil.comm.Allreduce(MPI.IN_PLACE, total)
        return total

    def drift_force(self, squared: float, potential: np.ndarray, field: Field) -> float:
        """Return the mean force along x on all that the band surrounds, dimensionless, in one liquid (collective).

        The momentum of the liquid that it surrounds does not change in the mean, so that with ω² = λ, Ψ of all waves
        and η = λΨ on the free surface

            F = ½λ ∫ρ (Re Ψ_x ∇Ψ̄ − ½|∇Ψ|² e_x)·∇χ + ¼ ∫ρg |η|² χ_x dx.

        No corner of a hull lies in the band, at which |∇Ψ|² is not bounded: the integral converges as energies do.

        Source: X.-B. Chen, J. Eng. Math. 59 (2007) 61, of a control surface at some distance.
        """
        layers = np.broadcast_to(self._layers[:, None], self._points.shape[:2])
        gradient = self._values(potential)[1] + field(self._points, layers)[1]
        flux = (gradient[..., :1] * gradient.conj()).real - 0.5 * (np.abs(gradient) ** 2).sum(axis=2, keepdims=True) * [
            1.0,
            0.0,
        ]
        weights = self._measure * self._weights * self._densities[:, None]
        force = 0.5 * squared * float(np.sum(weights * (flux * self._chi).sum(axis=2)))
        values = self._with_ghosts(potential)
        liquid = self._pencil.liquid
        for group in facet_groups(liquid, FREE_SURFACE):
            place = np.searchsorted(self._cells, group.cells)
            known = np.flatnonzero(np.append(self._cells, -1)[place] == group.cells)
            own = group.subset(known)
            local, weight = basix.make_quadrature(group.facet_type, 2 * liquid.degree + CURVED_QUADRATURE)
            reference = own.reference_points(local)
            points, dofs = own.physical_points(reference), liquid.space.dofmap.list[own.cells]
            psi = values[dofs] @ potential_basis(liquid, reference).T
            psi += field(points, np.broadcast_to(liquid.layer_of[dofs[:, :1]], psi.shape))[0]
            slopes = self._chi[place[known], :1, 0] * self._densities[place[known], None]
            force += 0.25 * squared**2 * float(np.sum(own.normals(reference)[1] * weight * slopes * np.abs(psi) ** 2))
        return float(self._pencil.comm.allreduce(force, op=MPI.SUM))

    def _values(self, potential: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """ψ and ∇ψ at the points of the band."""
        local = self._with_ghosts(potential)[self._pencil.liquid.space.dofmap.list[self._cells]]
        reference = np.einsum("dqn,cn->cqd", self._slopes, local, optimize=True)
        return local @ self._basis.T, np.einsum("cqde,cqd->cqe", self._inverse, reference, optimize=True)

    def _with_ghosts(self, potential: np.ndarray) -> np.ndarray:
        parts = [self._pencil.vector(part) for part in (potential.real, potential.imag)]
        real, imaginary = (function.x.array for function in as_functions(self._pencil.liquid, parts))
        whole: np.ndarray = real + 1j * imaginary
        return whole
