"""Incident waves: their pressures on the bodies, and amplitudes of radiated and scattered waves far away.

A wave φ± = e^{±ikx} Z(y) travels to the right or to the left. with the fluxes I(φ) of `field_model` an outgoing
ψ ~ c± e^{±ikx} Z has

    c± = i I(φ∓)/(2kN),    N = ∫ρZ² dy,

and by Green's theorem on the bodies, with g = ∫ρ (∂φ/∂n) q and ∂ψ/∂n = ζ there,

    I(φ) = ∫ρφ ζ − gᵀψ.

About an axis the order n has the regular wave φ = J_n(kr) Z(z) in place of both, and ψ ~ C H_n(kr) Z far away, with

    C = i I(φ)/P,    P = (2/π) c_n N,    Im H = P |C|²,

where I contains the factor c_n of the geometry. A plane wave of elevation A cos(kx − ωt) is the sum of εₙ iⁿ φ cos nθ
with ε₀ = 1 and else εₙ = 2.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import pi, sqrt
from typing import Literal, TypeAlias

import numpy as np
from scipy.special import jv

from hydroelastic.fem.open_water.basin import OpenBasin
from hydroelastic.fem.open_water.field_model import OpenModel
from hydroelastic.modal.liquid.deep_water_wave import DeepWaterWave
from hydroelastic.modal.liquid.travelling_waves import TravellingWave
from hydroelastic.physics.geometry import Geometry

RIGHTWARD, LEFTWARD = 1, -1

# Part of the basin's length, and of the gradient of a wave, that is rounding.
_ROUNDING = 1e-13


@dataclass(frozen=True, kw_only=True)
class Plane:
    """A wave that travels to the right (direction 1) or to the left (−1), in units of the basin."""

    wave: TravellingWave
    direction: int

    def field(self, points: np.ndarray, layers: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return φ, shape (...), and ∇φ, shape (..., 2), complex, at points (..., 2) of layers (...), 0 for the lower
        one."""
        x, y = points[..., 0], points[..., 1]
        value, slope = self.wave.profile(y, above=layers > 0)
        phase = np.exp(1j * self.direction * self.wave.wavenumber * x)
        along = 1j * self.direction * self.wave.wavenumber * value
        return phase * value, np.stack([phase * along, phase * slope], axis=-1)

    @property
    def elevation(self) -> float:
        """Elevation of the surface on which the wave travels, for c = 1."""
        return elevation(self.wave)

    @property
    def plane_elevation(self) -> float:
        """Elevation of the plane wave that it is, for c = 1."""
        return self.elevation

    @property
    def power(self) -> float:
        """kN, its power over ½ω³|c|²."""
        return self.wave.wavenumber * self.wave.energy


@dataclass(frozen=True, kw_only=True)
class Standing:
    """A standing wave, even or odd about the middle of the basin, in its units.

    (φ₊ ± φ₋)/√2 of plane waves with phase 0 there, evaluated without cancellation where both are large.
    """

    wave: DeepWaterWave
    odd: bool

    def field(self, points: np.ndarray, layers: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """See `Plane.field`."""
        value, slope = self.wave.profile(points[..., 1], above=layers > 0)
        wavenumber = self.wave.wavenumber
        away = points[..., 0] - 0.5
        x = wavenumber * np.where(np.abs(away) < _ROUNDING, 0.0, away)
        cosine, sine = sqrt(2.0) * np.cos(x), sqrt(2.0) * np.sin(x)
        phase, along = (1j * sine, 1j * wavenumber * cosine) if self.odd else (cosine, -wavenumber * sine)
        return phase * value, np.stack([along * value, phase * slope], axis=-1)


@dataclass(frozen=True, kw_only=True)
class Circular:
    """The regular wave J_n(kr) Z(z) cos nθ about an axis, in units of the basin."""

    wave: TravellingWave
    geometry: Geometry

    def field(self, points: np.ndarray, layers: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """See `Plane.field`."""
        value, slope = self.wave.profile(points[..., 1], above=layers > 0)
        k, order = self.wave.wavenumber, self.geometry.order
        x = k * points[..., 0]
        # J_n and its derivative from both neighbours.
        after = jv(order + 1, x)
        before = -after if order == 0 else jv(order - 1, x)
        radial = jv(0, x) if order == 0 else x * (before + after) / (2.0 * order)
        along = 0.5 * k * (before - after)
        return (radial * value).astype(complex), np.stack([along * value, radial * slope], axis=-1).astype(complex)

    @property
    def elevation(self) -> float:
        """See `Plane.elevation`."""
        return elevation(self.wave)

    @property
    def plane_elevation(self) -> float:
        """Elevation of the plane wave that has it as its part, for c = 1: η̂/εₙ."""
        return self.elevation / self._factor

    @property
    def _factor(self) -> float:
        return 2.0 if self.geometry.order else 1.0

    @property
    def power(self) -> float:
        """P, by which Im H = P |C|²."""
        return 2.0 / pi * self.geometry.measure * self.wave.energy

    def part(self, direction: int, basin: OpenBasin) -> complex:
        """Return εₙ iⁿ of a plane wave towards +x (1), or of one towards −x (−1), with its phase at `phase_at`."""
        order, origin = self.geometry.order, basin.phase_at / basin.units.length
        phase = np.exp(-1j * direction * self.wave.wavenumber * origin)
        return complex(self._factor * (direction * 1j) ** order * phase)


Wave: TypeAlias = Plane | Circular


def elevation(wave: TravellingWave) -> float:
    """Return the elevation of the surface on which a wave travels, for Z as it is scaled."""
    return wave.top_elevation if wave.on_top else wave.elevation


def incident_waves(waves: tuple[TravellingWave, ...], geometry: Geometry) -> list[Wave]:
    """Return each wave to the right, then each to the left; about an axis each wave once."""
    if geometry.is_revolved:
        return [Circular(wave=wave, geometry=geometry) for wave in waves]
    return [Plane(wave=wave, direction=direction) for direction in (RIGHTWARD, LEFTWARD) for wave in waves]


def direction_of(waves_from: Literal["left", "right"]) -> int:
    """Return the direction of waves from a side: `RIGHTWARD` or `LEFTWARD`."""
    return RIGHTWARD if waves_from == "left" else LEFTWARD


@dataclass(frozen=True, kw_only=True)
class Incidence:
    """Integrals of incident waves over the surfaces of the bodies."""

    planes: Sequence[Wave]  # the waves, in units of the basin as all integrals
    fluxes: np.ndarray  # g = ∫ρ (∂φ/∂n) q, dimensionless, shape (waves, free unknowns), complex
    pressures: np.ndarray  # ∫ρ φ φᵢ over the bodies' surfaces, shape (waves, body unknowns)
    own: np.ndarray  # ∫ρ φ ∂φ'/∂n over the bodies' surfaces, shape (waves φ, waves φ')

    @property
    def reversed(self) -> np.ndarray:
        """Index of the wave of opposite direction for each wave, shape (waves,)."""
        count = len(self.planes)
        return np.roll(np.arange(count), count // self.directions)

    @property
    def directions(self) -> int:
        """In how many directions each wave of the dispersion relation is among the waves: two, or one about an axis."""
        return 1 if isinstance(self.planes[0], Circular) else 2

    @property
    def incoming(self) -> float:
        """Amplitude of the incoming part of a wave: J_n is half of an incoming and half of an outgoing wave."""
        return 0.5 * self.directions

    @property
    def powers(self) -> np.ndarray:
        """Power of each outgoing wave over ½ω³|c|², shape (waves,)."""
        return np.array([plane.power for plane in self.planes])

    @property
    def elevations(self) -> np.ndarray:
        """Elevation of each wave over its c, shape (waves,)."""
        return np.array([plane.elevation for plane in self.planes])

    def phases_at_origin(self, basin: OpenBasin) -> np.ndarray:
        """Return the negative phase, rad, that each wave of zero phase at `OpenBasin.phase_at` has at the left side of
        the basin, shape (waves,).

        A wave e^{±ik(x − xₚ)} of the open water is e^{±ik(x₀ − xₚ)} times that of the basin, whose x begins at x₀.
        """
        origin = (basin.origin - basin.phase_at) / basin.units.length
        directions = [plane.direction if isinstance(plane, Plane) else 0 for plane in self.planes]
        wavenumbers = np.array([plane.wave.wavenumber for plane in self.planes])
        phases: np.ndarray = -np.array(directions) * wavenumbers * origin
        return phases

    def heights(self, basin: OpenBasin, amplitude: float) -> np.ndarray:
        """Return |c| of each wave that belongs to plane waves of an amplitude, m, shape (waves,)."""
        return amplitude / basin.units.length / np.array([plane.plane_elevation for plane in self.planes])

    def plane_forces(self, basin: OpenBasin, values: np.ndarray) -> np.ndarray:
        """Forces per elevation of plane waves with phase 0 at x = 0 of the open water."""
        scaled = values * (np.exp(-1j * self.phases_at_origin(basin)) / self.elevations)[:, None]
        if self.directions == 2:
            return scaled.reshape(2, len(scaled) // 2, -1)
        parts = [
            [plane.part(way, basin) for plane in self.planes if isinstance(plane, Circular)]
            for way in (RIGHTWARD, LEFTWARD)
        ]
        forces: np.ndarray = np.array(parts)[..., None] * scaled
        return forces

    def amplitudes(self, fluxes: np.ndarray) -> np.ndarray:
        """c of the outgoing waves, from I(φ) of each wave φ, both of shape (waves, …)."""
        amplitudes: np.ndarray = 1j / (self.directions * self.powers[:, None]) * fluxes[self.reversed]
        return amplitudes

    def fluxes_of(self, amplitudes: np.ndarray) -> np.ndarray:
        """I(φ) of each wave φ, from c of the outgoing waves, both of shape (waves, …)."""
        fluxes: np.ndarray = (-1j * self.directions * self.powers[:, None] * amplitudes)[self.reversed]
        return fluxes


def incidence(model: OpenModel, waves: Sequence[Wave]) -> Incidence:
    """Integrate waves over the surfaces of the bodies (collective)."""
    fluxes, pressures, own = surface_integrals(model, waves)
    return Incidence(planes=waves, fluxes=fluxes, pressures=pressures, own=own)


def surface_integrals(model: OpenModel, waves: Sequence[Wave | Standing]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Integrate waves over the bodies' surfaces: fluxes, pressures and own of `Incidence` (collective)."""
    pencil = model.pencil
    fluxes = np.zeros((len(waves), len(pencil.free)), dtype=complex)
    own = np.zeros((len(waves), len(waves)), dtype=complex)
    pressures = [np.zeros((len(waves), 0), dtype=complex)]
    for surface in model.wetted:
        fields = [plane.field(surface.points, surface.layers) for plane in waves]
        values = np.array([value for value, _ in fields])
        gradients = np.array([gradient for _, gradient in fields])
        flux = (gradients * surface.normals).sum(axis=2)
        # An even wave has no flux through a slit in the middle; its rounding would grow with the wave.
        flux[np.abs(flux) < _ROUNDING * np.linalg.norm(gradients, axis=2)] = 0.0
        fluxes += surface.loads(flux)[:, pencil.free]
        own += surface.integrals(values, flux)
        pressures.append(surface.integrals(values, surface.shapes))
    return fluxes, np.hstack(pressures), own
