"""The field model of open water for a range of frequencies: basin, absorbing layer, mesh, pencil, errors."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from math import cos, exp, isfinite, pi, sin

import numpy as np
from mpi4py import MPI
from scipy.linalg import block_diag

from hydroelastic.fem.cells import cell_corners, cells_at, owned_cells
from hydroelastic.fem.liquid import LiquidSpace, liquid_space
from hydroelastic.fem.open_water.basin import (
    CUT,
    AbsorbingLayer,
    OpenBasin,
    extent_of_bodies,
    open_basin,
    sized_absorbing_layer,
)
from hydroelastic.fem.open_water.complex_scaling import ComplexScaling, gradient_weights
from hydroelastic.fem.open_water.far_field import FarField
from hydroelastic.fem.open_water.motion_scale import MotionScale, motion_scale
from hydroelastic.fem.open_water.outside import outside_of
from hydroelastic.fem.open_water.pencil import OpenPencil, build_open_pencil
from hydroelastic.fem.open_water.plate_modes import PlateModes
from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.open_water.wetted_surface import WettedSurface
from hydroelastic.fem.spectral_error import cell_errors, gradient_coefficients
from hydroelastic.fem.tank.error_estimates import FrequencyErrors, boundary_error
from hydroelastic.fem.tank.field_model import distributed_mesh, moving_surfaces, tank_layers, whole_bodies
from hydroelastic.fem.tank.mesh import graded_outline, tip_points
from hydroelastic.fem.tank.outline import zero_on_axis, zero_potential_surfaces
from hydroelastic.fem.tank.resolution import (
    Resolution,
    radians,
    resolution_for,
    rounding_error,
    sharpest_exponent,
    workable_tolerance,
)
from hydroelastic.meshes.distribute import TankMesh
from hydroelastic.meshes.geometry import FAR_END
from hydroelastic.meshes.open_sea import extended, with_far_ends
from hydroelastic.meshes.tagged_mesh import TaggedMesh
from hydroelastic.modal.liquid.travelling_waves import travelling_waves
from hydroelastic.modal.tank_estimates import two_layers
from hydroelastic.physics.attachments import Attachment, OutsideForces
from hydroelastic.physics.local_waves import moving_parts
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

# Where only one coordinate is rotated, polynomials in a layer of cells converge more slowly.
_GROWTH_OVER_A_BED = 2.0

NO_WATER = 1e-6
"""Added mass below this part of the mass of a body is not resolved."""

# Weight of the energy error of cells in the absorbing layer. ψ oscillates there about as fast as it decays, and errors
# of opposite phase cancel. Measured on circles at Ka from 0.05 to 10 at three tolerances: the energy error is 9 to 140
# times the error of H.
LAYER_WEIGHT = 0.2
# Innermost rings at the corners of sections over those of tanks: errors there are relative to the waves, which move
# bodies by up to several times their height. Measured on a barge at tolerances from 1e-3 to 1e-5, its resonance
# included: 0.7 to 2 tolerances with those of tanks, a twelfth of it with these.
_TIPS = 0.25
# An upper liquid deeper than this, in radians of an interface wave, decouples its surface from that wave.
_DECOUPLED = 20.0


@dataclass(frozen=True, kw_only=True)
class Band:
    """A range of frequencies, in rad/s.

    Attributes:
        lowest: smallest |ω|, positive.
        highest: largest |ω|.
        reach: smallest and largest x between which the surface of the water is asked for, m; ``None`` for none.
    """

    lowest: float
    highest: float
    reach: tuple[float, float] | None = None

    def wavenumbers(self, water: Tank) -> tuple[float, float]:
        """Smallest and largest wavenumber of the outgoing waves, 1/m."""
        layers = two_layers(water)
        found = [wave.wavenumber for omega in (self.lowest, self.highest) for wave in travelling_waves(layers, omega)]
        return min(found), max(found)


@dataclass(frozen=True, kw_only=True)
class OpenModel:
    """The assembled problem of open water.

    Attributes:
        basin: the water around the bodies.
        resolution: resolution of the basin.
        absorbing_layer: dimensions of the absorbing layer.
        shortest: largest wavenumber of the outgoing waves, in units of the basin.
        tolerance: largest relative error that is accepted.
        pencil: the dimensionless problem, in units of the basin.
        attachments: springs and dampers that hold the bodies, in SI units.
    """

    basin: OpenBasin
    resolution: Resolution
    absorbing_layer: AbsorbingLayer
    shortest: float
    tolerance: float
    pencil: OpenPencil
    attachments: tuple[Attachment, ...] = ()

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
        return gradient_weights(self.pencil.liquid, _scaling(self.basin, self.absorbing_layer))

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

    def energies_missed(
        self, potentials: np.ndarray, layer_weight: np.ndarray | float = LAYER_WEIGHT
    ) -> tuple[np.ndarray, np.ndarray]:
        """Estimate the energy error ∫ρ|∇(ψ − ψ_h)|² of potentials ψ in cells away from tips and at tips (collective).

        Args:
            potentials: complex ψ on own free unknowns, shape (potentials, free unknowns).
            layer_weight: weight of cells in the absorbing layer, for all ψ or of shape (potentials,).

        Returns:
            Both energies, dimensionless, each of shape (potentials,).
        """
        return self.summed_over_cells(self.cells_missed(potentials, layer_weight))

    def cells_missed(self, potentials: np.ndarray, layer_weight: np.ndarray | float = LAYER_WEIGHT) -> np.ndarray:
        """The same in each own cell, shape (potentials, cells)."""
        pencil, outside = self.pencil, self.in_absorbing_layer
        vectors = [pencil.vector(part) for psi in potentials for part in (psi.real, psi.imag)]
        cells = cell_errors(pencil.liquid, vectors).reshape(len(potentials), 2, len(outside)).sum(axis=1)
        weighed: np.ndarray = cells * np.where(outside, np.reshape(layer_weight, (-1, 1)), 1.0)
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
        low, high = self.basin.bounds
        middles = cell_corners(mesh, owned_cells(mesh)).mean(axis=1)
        outside: np.ndarray = np.any((middles < np.array(low)) | (middles > np.array(high)), axis=1)
        return outside

    @property
    def cut(self) -> float:
        """Relative error of truncating the absorbing layer at both ends."""
        return 2.0 * CUT * self.tolerance

    def reflected(self, wavenumber: float) -> float:
        """Part of the power of outgoing waves of one wavenumber, in units of the basin, that both ends of the absorbing
        layer reflect: of waves e^{−2kX sin α}, of the slowest evanescent mode e^{−πX cos α/H} between a bed and a free
        top, of ψ ~ 1/(kX) in deep liquids the energy (kX)⁻². Measured on beams: at both ends the first ones are 1.0 to
        2 times the error, the last one 20 times; they count one and a half times and by half."""
        layer, depths = self.absorbing_layer, self.basin.depths
        reach, bounded = wavenumber * layer.farthest, sum(depth for depth in depths if isfinite(depth))
        evanescent = exp(-pi * layer.farthest * cos(layer.angle) / bounded) if bounded else 0.0
        deep = 0.0 if all(isfinite(depth) for depth in depths) else reach**-2
        return 3.0 * (exp(-2.0 * reach * sin(layer.angle)) + evanescent) + deep

    def compared(self, added: np.ndarray) -> np.ndarray:
        """Return the scale of errors of H of each body unknown, shape (body unknowns,): |H|, or a small part of the
        inertia where hardly any water moves, as beside a circle that rotates about its centre."""
        own: np.ndarray = np.maximum(added, NO_WATER * np.diag(self.mass))
        return own

    def errors(self, potentials: np.ndarray, responses: np.ndarray) -> FrequencyErrors:
        """Relative errors of H of each body unknown, by cause (collective).

        Args:
            potentials: ψ radiated by a unit of each body unknown, shape (body unknowns, free unknowns).
            responses: diagonal of |H|, shape (body unknowns,).
        """
        away, at_tips = self.energies_missed(potentials)
        scale = self.compared(np.abs(responses))
        tank = self.basin.tank
        count = len(responses)
        return FrequencyErrors(
            liquid=away / scale + boundary_error(self.pencil.liquid.tank, tank) + self.cut,
            tips=at_tips / scale,
            truncation=np.zeros(count),
            rounding=np.full(count, 2.0 * rounding_error(self.resolution.degree, min(tank.depth, 1.0))),
        )


def _scaling(basin: OpenBasin, absorbing_layer: AbsorbingLayer) -> ComplexScaling:
    low, high = basin.bounds
    return ComplexScaling(angle=absorbing_layer.angle, low=low, high=high)


def first_resolution(water: Tank, tolerance: float, band: Band, *, drawn: float | None = None) -> Resolution:
    """Return the initial resolution of open water, or of the length of a picture.

    Args:
        water: open water in SI units.
        tolerance: largest relative error that is accepted.
        band: the frequencies.
        drawn: see `open_basin`.
    """
    basin = open_basin(water, band.wavenumbers(water)[1], drawn=drawn, reach=band.reach)
    tank = basin.tank
    length = basin.units.length
    shortest = {wave.branch: wave.wavenumber * length for wave in travelling_waves(basin.layers, band.highest)}
    squared = (band.highest / basin.units.frequency) ** 2
    meshed, flexural = [], []
    for level in tank.levels:
        own = max(shortest.values())
        if level.below == 1 and own * tank.layers[1].depth > _DECOUPLED:
            own = shortest.get("surface", 0.0)
        for piece in level.pieces:
            bent = max((moving.wavenumber(squared) for moving in moving_parts(tank, level, piece)), default=0.0)
            flexural.append(bent if piece.body is not None else 0.0)
            # Waves scattered under a beam are as short as the incident ones.
            meshed.append(0.0 if piece.body in tank.hulls else max(own, flexural[-1]))
    tolerance = workable_tolerance(tolerance, tank.depth)
    exponent = sharpest_exponent(tank, infinite_frequency=False)
    # The dry modes of a beam follow from its flexural waves alone.
    shapes = resolution_for(tank, tolerance, tuple(flexural), exponent=exponent).shapes
    resolution = resolution_for(tank, tolerance, tuple(meshed), exponent=exponent)
    if exponent < 1.0 and not tank.geometry.is_revolved:
        resolution = resolution.with_tips(_TIPS)
    return replace(resolution, shapes=shapes)


def open_model(
    problem: OpenWaterProblem,
    band: Band,
    resolution: Resolution,
    *,
    angle: float | None = None,
    drawn: float | None = None,
) -> OpenModel:
    """Mesh and assemble open water (collective).

    Args:
        problem: the open water.
        band: the frequencies.
        resolution: resolution of the basin.
        angle: angle α of the complex scaling, rad; by default that of the depth.
        drawn: see `open_basin`.
    """
    basin, absorbing_layer = _laid(problem.tank, problem.tolerance, band, resolution, angle=angle, drawn=drawn)
    tank, watch = basin.tank, problem.watch
    with watch.stage("mesh"):
        mesh = distributed_mesh(problem.comm, lambda: open_mesh(basin, resolution, absorbing_layer))
    liquid = _liquid(basin, resolution, mesh)
    with watch.stage("assemble"):
        pencil = build_open_pencil(
            liquid,
            _scaling(basin, absorbing_layer),
            bodies=whole_bodies(tank, resolution.shapes),
            surfaces=moving_surfaces(mesh, tank),
        )
    return OpenModel(
        basin=basin,
        resolution=resolution,
        absorbing_layer=absorbing_layer,
        shortest=band.wavenumbers(problem.tank)[1] * basin.units.length,
        tolerance=problem.tolerance,
        pencil=pencil,
        attachments=problem.tank.attachments,
    )


def first_mesh(water: Tank, tolerance: float, band: Band, resolution: Resolution, *, angle: float) -> TaggedMesh:
    """Return the mesh of `open_model`, on the calling process.

    Args:
        water: open water in SI units.
        tolerance: largest relative error that is accepted.
        band: the frequencies.
        resolution: resolution of the basin.
        angle: angle α of the complex scaling, rad.
    """
    basin, absorbing_layer = _laid(water, tolerance, band, resolution, angle=angle, drawn=None)
    return open_mesh(basin, resolution, absorbing_layer)


def _laid(
    water: Tank, tolerance: float, band: Band, resolution: Resolution, *, angle: float | None, drawn: float | None
) -> tuple[OpenBasin, AbsorbingLayer]:
    """Return the basin and its absorbing layer."""
    wavenumbers = band.wavenumbers(water)
    basin = open_basin(water, wavenumbers[1], drawn=drawn, reach=band.reach)
    length = basin.units.length
    tolerance = workable_tolerance(tolerance, basin.tank.depth)
    has_bed = any(isfinite(depth) for depth in basin.depths)
    if angle is None:
        angle = ANGLE_OVER_A_BED if has_bed else ANGLE
    absorbing_layer = sized_absorbing_layer(
        basin,
        (wavenumbers[0] * length, wavenumbers[1] * length),
        first=radians(resolution.degree, tolerance),
        growth=_GROWTH_OVER_A_BED if has_bed else GROWTH,
        angle=angle,
        tolerance=tolerance,
    )
    return basin, absorbing_layer


def _liquid(basin: OpenBasin, resolution: Resolution, mesh: TankMesh) -> LiquidSpace:
    tank = basin.tank
    zero_potential = (FAR_END, *zero_potential_surfaces(tank, infinite_frequency=False), *zero_on_axis(tank))
    return liquid_space(mesh, resolution.degree, zero_potential, tank_layers(tank), geometry=tank.geometry)


def open_mesh(
    basin: OpenBasin, resolution: Resolution, absorbing_layer: AbsorbingLayer, *, infinite_frequency: bool = False
) -> TaggedMesh:
    """Return the mesh of the basin by gmsh with its absorbing layer, on the calling process.

    Args:
        basin: the basin.
        resolution: resolution of the basin.
        absorbing_layer: dimensions of the absorbing layer.
        infinite_frequency: whether it is for the infinite-frequency limit, see `Tank.has_continuous_pressure`.
    """
    from hydroelastic.meshes.build import build_mesh

    curved = any(not hull.is_thin for hull in basin.tank.hulls.values())
    mesh = build_mesh(
        graded_outline(basin.tank, resolution, half=False, infinite_frequency=infinite_frequency),
        bulk_size=resolution.bulk_size,
        ring_ratio=resolution.ring_ratio,
        geometry_degree=resolution.degree if curved else 1,
    )
    for sides, stage in absorbing_layer.stages(basin):
        mesh = extended(mesh, sides, stage)
    return with_far_ends(mesh, basin.far_sides)
