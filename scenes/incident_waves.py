"""Incident waves: what they press against the bodies, and the far field of what the bodies send back.

A wave φ± = e^{±ikx} Z(y) travels to the right or to the left. With the fluxes I(φ) of `fem.far_field` an outgoing
ψ ~ c± e^{±ikx} Z has

    c± = i I(φ∓)/(2kN),    N = ∫ρZ² dy,

and by Green's theorem on the bodies, with g = ∫ρ (∂φ/∂n) q and ∂ψ/∂n = ζ there,

    I(φ) = ∫ρφ ζ − gᵀψ.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hydroelastic.fem.shape_loads import shape_moments
from hydroelastic.fem.surfaces import Body
from hydroelastic.meshes.geometry import body_name
from hydroelastic.modal.travelling_waves import TravellingWave
from hydroelastic.scenes.open_basin import OpenBasin
from hydroelastic.scenes.open_model import OpenModel

RIGHTWARD, LEFTWARD = 1, -1

# A point of a level belongs to the liquid whose outward normal leaves it; points of contours miss it by rounding.
_AT_LEVEL = 1e-12


@dataclass(frozen=True, kw_only=True)
class Plane:
    """A wave that travels to one side, in units of the basin."""

    wave: TravellingWave
    direction: int

    def field(self, points: np.ndarray, above: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """φ and ∇φ at points (..., 2); ``above`` tells which lie in the upper liquid."""
        x, y = points[..., 0], points[..., 1]
        value, slope = self.wave.profile(y, above=above.astype(bool))
        phase = np.exp(1j * self.direction * self.wave.wavenumber * x)
        along = 1j * self.direction * self.wave.wavenumber * value
        return phase * value, np.stack([phase * along, phase * slope], axis=-1)

    @property
    def elevation(self) -> float:
        """Elevation at the surface on which the wave travels, over the ψ to which Z is scaled."""
        return self.wave.top_elevation if self.wave.on_top else self.wave.elevation


def planes(waves: tuple[TravellingWave, ...]) -> list[Plane]:
    """Each wave to the right, then each to the left."""
    return [Plane(wave=wave, direction=direction) for direction in (RIGHTWARD, LEFTWARD) for wave in waves]


@dataclass(frozen=True, kw_only=True)
class Incidence:
    """What some waves do to the bodies.

    Attributes:
        planes: the waves.
        fluxes: g = ∫ρ (∂φ/∂n) q, shape (waves, free unknowns), complex.
        pressures: ∫ρ φ φᵢ over the bodies' surfaces, shape (waves, body unknowns).
        own: ∫ρ φ ∂φ'/∂n over the bodies' surfaces, shape (waves φ, waves φ').
    """

    planes: list[Plane]
    fluxes: np.ndarray
    pressures: np.ndarray
    own: np.ndarray

    @property
    def reversed(self) -> np.ndarray:
        """Places of the waves that run the other way."""
        count = len(self.planes)
        return np.roll(np.arange(count), count // 2)

    @property
    def powers(self) -> np.ndarray:
        """kN of each wave: its power over ½ω³|c|²."""
        return np.array([plane.wave.wavenumber * plane.wave.energy for plane in self.planes])

    @property
    def elevations(self) -> np.ndarray:
        """Elevation of each wave over its c."""
        return np.array([plane.elevation for plane in self.planes])

    def scene_phases(self, basin: OpenBasin) -> np.ndarray:
        """Phase of each wave at the basin's left side if it is zero at x = 0 of the scene, with the other sign.

        A wave e^{±ikx} of the scene is e^{±ikx₀} times that of the basin, whose x begins at x₀.
        """
        origin = basin.origin / basin.units.length
        return np.array([-plane.direction * plane.wave.wavenumber * origin for plane in self.planes])

    def amplitudes(self, fluxes: np.ndarray) -> np.ndarray:
        """c of the waves that leave, from I(φ) of each wave φ, shape (waves, …)."""
        amplitudes: np.ndarray = 0.5j / self.powers[:, None] * fluxes[self.reversed]
        return amplitudes

    def fluxes_of(self, amplitudes: np.ndarray) -> np.ndarray:
        """I(φ) of each wave φ, from c of the waves that leave."""
        fluxes: np.ndarray = (-2j * self.powers[:, None] * amplitudes)[self.reversed]
        return fluxes


def incidence(model: OpenModel, waves: list[Plane]) -> Incidence:
    """Integrate waves over the bodies' surfaces (collective)."""
    pencil = model.pencil
    bodies = [body for body in pencil.bodies if body.size]
    wetted = [_flux_body(body_name(index + 1), waves) for index in range(len(model.basin.tank.bodies))]
    fluxes = sum((pencil.load(body) for body in wetted), np.zeros((2 * len(waves), len(pencil.free))))
    shortest = max(plane.wave.wavenumber for plane in waves)
    count = 2 * len(waves)

    def values(points: np.ndarray, normals: np.ndarray, number: int) -> np.ndarray:
        return _part(waves[number // 2].field(points.T, _above(points, normals))[0], number)

    pressures = [shape_moments(pencil.liquid, body, values, count, shortest) for body in bodies]
    own = sum(
        (shape_moments(pencil.liquid, body, values, count, shortest) for body in wetted), np.zeros((count, count))
    )
    by_shape = np.hstack(pressures) if pressures else np.zeros((count, 0))
    return Incidence(
        planes=waves,
        fluxes=fluxes[::2] + 1j * fluxes[1::2],
        pressures=by_shape[::2] + 1j * by_shape[1::2],
        own=(own[::2, ::2] - own[1::2, 1::2]) + 1j * (own[1::2, ::2] + own[::2, 1::2]),
    )


def _flux_body(surface: str, waves: list[Plane]) -> Body:
    """Normal displacements of the liquid in the waves, real and imaginary parts, as if they were shapes of a body."""

    def fluxes(points: np.ndarray, normals: np.ndarray, number: int) -> np.ndarray:
        gradient = waves[number // 2].field(points.T, _above(points, normals))[1]
        return _part((gradient * normals.T).sum(axis=-1), number)

    size = 2 * len(waves)
    return Body(
        surface=surface,
        shapes=fluxes,
        wavenumber=max(plane.wave.wavenumber for plane in waves),
        labels=("wave",) * size,
        stiffness=np.zeros(size),
        bending_stiffness=np.zeros(size),
        mass=np.zeros(size),
    )


def _part(values: np.ndarray, number: int) -> np.ndarray:
    part: np.ndarray = values.imag if number % 2 else values.real
    return part


def _above(points: np.ndarray, normals: np.ndarray) -> np.ndarray:
    above: np.ndarray = np.where(np.abs(points[1]) > _AT_LEVEL, points[1] > 0.0, normals[1] < 0.0)
    return above
