"""The field model of open water for a range of frequencies: basin, absorbing layer, mesh, pencil, errors.

Far-field fluxes, from ψ in a band of cells between the bodies and the sides of the basin.

For a solution φ of Laplace's equation that satisfies all boundary conditions of the liquids without bodies, as an
incident wave does, the integral

    I(φ) = ∫ρ (φ ∂ψ/∂n − ψ ∂φ/∂n)

is the same over all surfaces around the bodies. With a function χ that is 1 at the bodies and 0 at the basin's sides it
becomes an integral over the band in which χ varies, I(φ) = ∫ρ ∇χ·(φ∇ψ − ψ∇φ). χ is linear in the cells, and the
integral converges as fast as energies do. The force of the waves on the bodies is such an integral too.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from math import pi

import basix
import numpy as np
from mpi4py import MPI
from scipy.linalg import block_diag

from hydroelastic.fem.cells import (
    CURVED_QUADRATURE,
    cell_corners,
    cell_jacobians,
    cell_positions,
    cells_at,
    owned_cells,
)
from hydroelastic.fem.facets import facet_groups
from hydroelastic.fem.liquid import as_functions
from hydroelastic.fem.open_water.basin import (
    CUT,
    AbsorbingLayer,
    OpenBasin,
    extent_of_bodies,
)
from hydroelastic.fem.open_water.complex_scaling import ComplexScaling, gradient_weights
from hydroelastic.fem.open_water.motion_scale import MotionScale, motion_scale
from hydroelastic.fem.open_water.outside import outside_of
from hydroelastic.fem.open_water.pencil import OpenPencil
from hydroelastic.fem.open_water.plate_modes import PlateModes
from hydroelastic.fem.open_water.wetted_surface import WettedSurface
from hydroelastic.fem.shape_loads import potential_basis
from hydroelastic.fem.spectral_error import cell_errors, gradient_coefficients
from hydroelastic.fem.tank.error_estimates import FrequencyErrors, boundary_error
from hydroelastic.fem.tank.mesh import tip_points
from hydroelastic.fem.tank.resolution import (
    Resolution,
    rounding_error,
)
from hydroelastic.meshes.geometry import FREE_SURFACE
from hydroelastic.modal.liquid.travelling_waves import travelling_waves
from hydroelastic.modal.tank_estimates import two_layers
from hydroelastic.physics.attachments import Attachment, OutsideForces
from hydroelastic.physics.round_plates import RoundPlate
from hydroelastic.physics.tank import Tank

ANGLE = pi / 3.0
"""α of the complex scaling in deep water. Measured on circles at Ka from 0.05 to 10: 60 degrees is as good as 45 or
better."""

ANGLE_OVER_A_BED = pi / 4.0
"""α where a liquid has a finite depth: at 60 degrees e^{−κx} oscillates faster than it decays, and needs more
cells."""

GROWTH = 3.0
"""Ratio of the distances of successive layers of cells; 2 costs half as much again, 4 needs a higher degree."""

NO_WATER = 1e-6
"""Added mass below this part of the mass of a body is not resolved."""

# Weight of the energy error of cells in the absorbing layer. ψ oscillates there about as fast as it decays, and errors
# of opposite phase cancel. Measured on circles at Ka from 0.05 to 10 at three tolerances: the energy error is 9 to 140
# times the error of H.
LAYER_WEIGHT = 0.2

Field = Callable[[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray]]
"""Function of points (..., gdim) and the layer of each (...): complex φ (...) and its gradient (..., gdim)."""


@dataclass(frozen=True, kw_only=True)
class Band:
    """A range of frequencies, in rad/s."""

    lowest: float  # smallest |ω|, positive
    highest: float  # largest |ω|
    # smallest and largest x between which the surface of the water is asked for, m; ``None`` for none
    reach: tuple[float, float] | None = None

    def wavenumbers(self, water: Tank) -> tuple[float, float]:
        """Smallest and largest wavenumber of the outgoing waves, 1/m."""
        layers = two_layers(water)
        found = [wave.wavenumber for omega in (self.lowest, self.highest) for wave in travelling_waves(layers, omega)]
        return min(found), max(found)


@dataclass(frozen=True, kw_only=True)
class OpenModel:
    """The assembled problem of open water."""

    basin: OpenBasin  # the water around the bodies
    resolution: Resolution  # resolution of the basin
    absorbing_layer: AbsorbingLayer  # dimensions of the absorbing layer
    shortest: float  # largest wavenumber of the outgoing waves, in units of the basin
    tolerance: float  # largest relative error that is accepted
    pencil: OpenPencil  # the dimensionless problem, in units of the basin
    attachments: tuple[Attachment, ...] = ()  # springs and dampers that hold the bodies, in SI units

    def squared_frequency(self, omega: complex) -> complex:
        """Dimensionless λ = ω² of an ω in rad/s."""
        return complex(omega / self.basin.units.frequency) ** 2

    @cached_property
    def wetted(self) -> tuple[WettedSurface, ...]:
        """The bodies' surfaces, for the waves of the band (collective)."""
        return tuple(WettedSurface(self.pencil.liquid, body, self.shortest) for body in self.pencil.bodies)

    @cached_property
    def plate_modes(self) -> dict[int, PlateModes]:
        """The dry modes of each round plate, by its index among the bodies (collective)."""
        plates = [index for index, body in enumerate(self.basin.tank.bodies) if isinstance(body, RoundPlate)]
        return {one: PlateModes(self.basin, self.pencil, self.attachments, self.shortest, one) for one in plates}

    @cached_property
    def scale(self) -> MotionScale:
        """Conversion of body unknowns to motions in SI units."""
        return motion_scale(self.basin, self.pencil.bodies)

    @cached_property
    def gradient_coefficients(self) -> Callable[[np.ndarray], list[np.ndarray]]:
        """Coefficients of ∇ψ in the last degrees, see `spectral_error`."""
        return gradient_coefficients(self.pencil.liquid)

    @cached_property
    def gradient_weights(self) -> np.ndarray:
        """Weights of (∂ᵢψ)² in A in each own cell, see `complex_scaling`, shape (cells, gdim)."""
        return gradient_weights(self.pencil.liquid, scaling_of(self.basin, self.absorbing_layer))

    @cached_property
    def far_field(self) -> FarField:
        """Far-field fluxes, from which the amplitudes of outgoing waves follow (collective)."""
        return FarField(self.pencil, *self.basin.bounds)

    @cached_property
    def near_field(self) -> FarField:
        """The same half as far from the bodies (collective)."""
        left, right, bottom, top = extent_of_bodies(self.basin.tank)
        low, high = 0.5 * np.add(self.basin.bounds, ((left, bottom), (right, top)))
        return FarField(self.pencil, (low[0], low[1]), (high[0], high[1]))

    @cached_property
    def stiffness(self) -> np.ndarray:
        """K of the bodies and of what holds them, shape (body unknowns, body unknowns)."""
        own = np.diag(np.concatenate([body.stiffness for body in self.pencil.bodies]))
        stiffness: np.ndarray = own + self.outside.stiffness
        return stiffness

    @cached_property
    def outside(self) -> OutsideForces:
        """Forces from outside on the body unknowns."""
        return outside_of(self.basin, self.pencil.bodies, self.attachments)

    def restoring(self, squared: complex) -> np.ndarray:
        """K − iωB at λ = ω², Re ω ≥ 0, with the damping B from outside, shape (body unknowns, body unknowns)."""
        restoring: np.ndarray = self.stiffness - 1j * np.sqrt(complex(squared)) * self.outside.damping
        return restoring

    @cached_property
    def mass(self) -> np.ndarray:
        """M_b of the bodies, shape (body unknowns, body unknowns)."""
        matrix: np.ndarray = block_diag(*(body.mass for body in self.pencil.bodies))
        return matrix

    def energies_missed(self, potentials: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Estimate the energy error ∫ρ|∇(ψ − ψ_h)|² of potentials ψ in cells away from tips and at tips
        (collective)."""
        return self.summed_over_cells(self.cells_missed(potentials))

    def cells_missed(self, potentials: np.ndarray) -> np.ndarray:
        """The same in each own cell, shape (potentials, cells)."""
        pencil, outside = self.pencil, self.in_absorbing_layer
        vectors = [pencil.vector(part) for psi in potentials for part in (psi.real, psi.imag)]
        cells = cell_errors(pencil.liquid, vectors).reshape(len(potentials), 2, len(outside)).sum(axis=1)
        weighed: np.ndarray = cells * np.where(outside, LAYER_WEIGHT, 1.0)
        return weighed

    def summed_over_cells(self, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Sum values of own cells, on the last axis, away from tips and at tips (collective)."""
        mesh, corners = self.pencil.liquid.tank.mesh, tip_points(self.basin.tank, half=False)
        tips = cells_at(mesh, corners) if len(corners) else np.zeros(values.shape[-1], dtype=bool)
        away, at_tips = (mesh.comm.allreduce(values[..., own].sum(axis=-1), op=MPI.SUM) for own in (~tips, tips))
        return away, at_tips

    @cached_property
    def in_absorbing_layer(self) -> np.ndarray:
        """Whether each own cell lies in the absorbing layer, shape (cells,)."""
        mesh = self.pencil.liquid.tank.mesh
        low, high = map(np.array, self.basin.bounds)
        middles = cell_corners(mesh, owned_cells(mesh)).mean(axis=1)
        # Within a radian of the shortest wave ψ does not oscillate: errors in layers around small bodies add up.
        axis = 0.0 if self.basin.tank.geometry.is_revolved else 0.5 * (low[0] + high[0])
        centre = np.array([axis, high[1]])
        radian = 1.0 / self.shortest
        low, high = np.minimum(low, centre - radian), np.maximum(high, centre + radian)
        outside: np.ndarray = np.any((middles < low) | (middles > high), axis=1)
        return outside

    @property
    def cut(self) -> float:
        """Largest relative error of truncating the absorbing layer at both ends, at any frequency."""
        return 2.0 * CUT * self.tolerance

    def compared(self, added: np.ndarray) -> np.ndarray:
        """Return the scale of errors of H of each body unknown, shape (body unknowns,): |H|, or a small part of the
        inertia where hardly any water moves, as beside a circle that rotates about its centre."""
        own: np.ndarray = np.maximum(added, NO_WATER * np.diag(self.mass))
        return own

    def errors(
        self, potentials: np.ndarray, responses: np.ndarray, truncation: np.ndarray | None = None
    ) -> FrequencyErrors:
        """Relative errors of H of each body unknown, by cause (collective)."""
        away, at_tips = self.energies_missed(potentials)
        scale = self.compared(np.abs(responses))
        tank = self.basin.tank
        count = len(responses)
        return FrequencyErrors(
            liquid=away / scale
            + boundary_error(self.pencil.liquid.tank, tank)
            + (self.cut if truncation is None else truncation),
            tips=at_tips / scale,
            truncation=np.zeros(count),
            rounding=np.full(count, 2.0 * rounding_error(self.resolution.degree, min(tank.depth, 1.0))),
        )


def scaling_of(basin: OpenBasin, absorbing_layer: AbsorbingLayer) -> ComplexScaling:
    """Return region and angle of the complex scaling of a basin and its absorbing layer."""
    low, high = basin.bounds
    return ComplexScaling(angle=absorbing_layer.angle, low=low, high=high)


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
