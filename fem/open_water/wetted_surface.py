"""Quadrature on the wetted surface of a body, for loads and integrals of fields that depend on the frequency."""

from __future__ import annotations

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.facets import facet_groups
from hydroelastic.fem.liquid import LiquidSpace
from hydroelastic.fem.shape_loads import facet_quadrature, potential_basis, singular_corner
from hydroelastic.fem.surfaces import Body


class WettedSurface:
    """Quadrature on one body, for fields up to a wavenumber.

    Args:
        liquid: space of ψ.
        body: the body; its shapes are evaluated once.
        wavenumber: largest wavenumber of the fields, in units of the mesh.

    Attributes:
        points: quadrature points of this process, shape (points, gdim).
        normals: outward unit normals of the liquid there, of the same shape.
        layers: index of the layer at each point, shape (points,).
        shapes: normal displacement of each shape of the body, shape (shapes, points).
    """

    def __init__(self, liquid: LiquidSpace, body: Body, wavenumber: float) -> None:
        """Find the points (collective)."""
        self._liquid = liquid
        self._groups: list[tuple[np.ndarray, int]] = []
        points, normals, weights, layers, unknowns = [], [], [], [], []
        for group in facet_groups(liquid, body.surface):
            # Other basis functions vanish on the facet.
            places = liquid.facet_dofs(group.place)
            at_corner = singular_corner(body, group)
            for corner in np.unique(at_corner):
                own = group.subset(at_corner == corner)
                quadrature = facet_quadrature(liquid, own, body.wavenumber + wavenumber, int(corner))
                dofs = liquid.space.dofmap.list[own.cells]
                self._groups.append((potential_basis(liquid, quadrature.reference)[:, places], len(dofs)))
                unknowns.append(dofs[:, places].ravel())
                points.append(quadrature.points.T)
                normals.append(quadrature.normals.T)
                weights.append(quadrature.weights.ravel())
                layers.append(np.repeat(liquid.layer_of[dofs[:, 0]], quadrature.weights.shape[1]))
        self._unknowns = np.concatenate([np.empty(0, dtype=np.int32), *unknowns])
        dim = liquid.tank.mesh.geometry.dim
        self.points = np.vstack([np.empty((0, dim)), *points])
        self.normals = np.vstack([np.empty((0, dim)), *normals])
        self.layers = np.concatenate([np.empty(0, dtype=np.int8), *layers])
        densities = np.array([layer.density for layer in liquid.layers])
        self._weights = np.concatenate([np.empty(0), *weights]) * densities[self.layers]
        columns, upright = self.points.T, self.normals.T
        # Shapes are not asked for at no points, where a process has none.
        self.shapes = body.shapes(columns, upright) if len(self.points) else np.empty((body.size, 0))

    def loads(self, fluxes: np.ndarray) -> np.ndarray:
        """Return ∫ρ f q of complex functions f, shape (functions, points), on own unknowns: shape (functions, unknowns)
        (collective)."""
        parts = np.vstack([fluxes.real, fluxes.imag]) * self._weights
        local, first = [np.zeros((len(parts), 0))], 0
        for basis, facets in self._groups:
            count = facets * len(basis)
            own = parts[:, first : first + count].reshape(len(parts), facets, -1) @ basis
            local.append(own.reshape(len(parts), -1))
            first += count
        size = len(self._liquid.layer_of)
        # Of no values NumPy returns integers, into which nothing can be summed.
        loads = np.array([np.bincount(self._unknowns, values, size) for values in np.hstack(local)], dtype=float)
        summed = self._liquid.numbering.summed(loads)
        complex_loads: np.ndarray = summed[: len(fluxes)] + 1j * summed[len(fluxes) :]
        return complex_loads

    def integrals(self, one: np.ndarray, other: np.ndarray) -> np.ndarray:
        """Return ∫ρ f g of functions f and g, shapes (functions, points), without conjugation: shape (functions f,
        functions g) (collective)."""
        total = ((one * self._weights) @ other.T).astype(complex)
        self._liquid.tank.mesh.comm.Allreduce(MPI.IN_PLACE, total)
        return np.asarray(total)
