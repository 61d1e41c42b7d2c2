"""Steady streams u(z): uniform, linearly sheared, veering, tabulated. z is up."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal, Protocol, get_args

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import CubicSpline, PchipInterpolator

from hydroelastic.physics.arrays import FloatArray

Vector = tuple[float, float, float]
Interpolation = Literal["linear", "monotone", "spline", "cubic"]


class Stream(Protocol):
    """Velocity u(r) of the undisturbed liquid, steady."""

    @property
    def breaks(self) -> tuple[float, ...]:
        """Heights at which a derivative of u jumps, m, increasing."""

    def velocity_at(self, points: FloatArray) -> FloatArray:
        """Return u, m/s, at points, m, shape (n, 3); shape (n, 3)."""

    def gradient_at(self, points: FloatArray) -> FloatArray:
        """Return ∂uᵢ/∂xⱼ, 1/s, at points, m, shape (n, 3); shape (n, 3, 3)."""

    def times(self, factor: float) -> Stream:
        """Return the field with all velocities multiplied by a dimensionless factor."""


@dataclass(frozen=True)
class ScaledStream:
    """A velocity field in other units of length and time."""

    stream: Stream  # in SI units
    length: float  # unit of length, m
    time: float  # unit of time, s

    @property
    def breaks(self) -> tuple[float, ...]:
        """Heights at which a derivative of u jumps, in the units, increasing."""
        return tuple(height / self.length for height in self.stream.breaks)

    def velocity_at(self, points: FloatArray) -> FloatArray:
        """Return u at points of shape (n, 3), both in the units; shape (n, 3)."""
        return self.stream.velocity_at(points * self.length) * (self.time / self.length)

    def gradient_at(self, points: FloatArray) -> FloatArray:
        """Return ∂uᵢ/∂xⱼ at points of shape (n, 3), both in the units; shape (n, 3, 3)."""
        return self.stream.gradient_at(points * self.length) * self.time

    def times(self, factor: float) -> ScaledStream:
        """Return the field with all velocities multiplied by a dimensionless factor."""
        return replace(self, stream=self.stream.times(factor))


class _OfHeight(ABC):
    """Velocity in space from a profile u(z)."""

    breaks: tuple[float, ...] = ()

    @abstractmethod
    def profile(self, levels: ArrayLike) -> FloatArray:
        """Return u, m/s, at heights, m, shape (n,); shape (n, 3)."""

    @abstractmethod
    def slope(self, levels: ArrayLike) -> FloatArray:
        """Return du/dz, 1/s, at heights, m, shape (n,); shape (n, 3)."""

    def velocity_at(self, points: ArrayLike) -> FloatArray:
        """Return u, m/s, at points, m, shape (n, 3); shape (n, 3)."""
        return self.profile(np.asarray(points, dtype=float)[:, 2])

    def gradient_at(self, points: ArrayLike) -> FloatArray:
        """Return ∂uᵢ/∂xⱼ, 1/s, at points, m, shape (n, 3); shape (n, 3, 3)."""
        places = np.asarray(points, dtype=float)
        gradient = np.zeros((len(places), 3, 3))
        gradient[:, :, 2] = self.slope(places[:, 2])
        return gradient


def _vector(values: Sequence[float], name: str) -> Vector:
    vector = tuple(float(value) for value in values)
    if len(vector) != 3 or not all(map(math.isfinite, vector)):
        raise ValueError(f"{name} is {values}: it must have three finite components, x, y and z")
    return vector


def _times(factor: float, vector: Vector) -> Vector:
    x, y, z = vector
    return factor * x, factor * y, factor * z


def _finite(value: float, name: str) -> None:
    if not math.isfinite(value):
        raise ValueError(f"{name} is {value}: it must be finite")


@dataclass(frozen=True)
class UniformStream(_OfHeight):
    """u = U."""

    velocity: Vector  # U, m/s, three components

    def __post_init__(self) -> None:
        object.__setattr__(self, "velocity", _vector(self.velocity, "velocity"))

    def times(self, factor: float) -> UniformStream:
        """Return the stream with all velocities multiplied by a dimensionless factor."""
        return replace(self, velocity=_times(factor, self.velocity))

    def profile(self, levels: ArrayLike) -> FloatArray:
        """Return u, m/s, at heights, m, shape (n,); shape (n, 3)."""
        return np.tile(self.velocity, (np.size(levels), 1))

    def slope(self, levels: ArrayLike) -> FloatArray:
        """Return du/dz = 0 at heights, shape (n,); shape (n, 3)."""
        return np.zeros((np.size(levels), 3))


@dataclass(frozen=True)
class ShearedStream(_OfHeight):
    """u = U + G (z − z₀)."""

    velocity: Vector  # U, m/s, three components
    gradient: Vector  # G, 1/s, three components
    level: float = 0.0  # z₀, m, where u = U

    def __post_init__(self) -> None:
        object.__setattr__(self, "velocity", _vector(self.velocity, "velocity"))
        object.__setattr__(self, "gradient", _vector(self.gradient, "gradient"))
        _finite(self.level, "level")

    def times(self, factor: float) -> ShearedStream:
        """Return the stream with all velocities multiplied by a dimensionless factor."""
        return replace(self, velocity=_times(factor, self.velocity), gradient=_times(factor, self.gradient))

    def profile(self, levels: ArrayLike) -> FloatArray:
        """Return u, m/s, at heights, m, shape (n,); shape (n, 3)."""
        heights = np.asarray(levels, dtype=float)
        return np.asarray(self.velocity) + np.multiply.outer(heights - self.level, self.gradient)

    def slope(self, levels: ArrayLike) -> FloatArray:
        """Return du/dz, 1/s, at heights, shape (n,); shape (n, 3)."""
        return np.tile(self.gradient, (np.size(levels), 1))


@dataclass(frozen=True)
class VeeringStream(_OfHeight):
    """u = U (cos κz, sin κz, 0)."""

    speed: float  # U, m/s
    rate: float  # κ, rad/m

    def __post_init__(self) -> None:
        _finite(self.speed, "speed")
        _finite(self.rate, "rate")

    def times(self, factor: float) -> VeeringStream:
        """Return the stream with all velocities multiplied by a dimensionless factor."""
        return replace(self, speed=factor * self.speed)

    def profile(self, levels: ArrayLike) -> FloatArray:
        """Return u, m/s, at heights, m, shape (n,); shape (n, 3)."""
        angles = self.rate * np.asarray(levels, dtype=float)
        return self.speed * np.stack([np.cos(angles), np.sin(angles), np.zeros_like(angles)], axis=-1)

    def slope(self, levels: ArrayLike) -> FloatArray:
        """Return du/dz, 1/s, at heights, m, shape (n,); shape (n, 3)."""
        angles = self.rate * np.asarray(levels, dtype=float)
        return self.speed * self.rate * np.stack([-np.sin(angles), np.cos(angles), np.zeros_like(angles)], axis=-1)


@dataclass(frozen=True)
class TabulatedStream(_OfHeight):
    """u between the rows of a table, constant above the highest and below the lowest."""

    levels: tuple[float, ...]  # heights of the rows, m, increasing
    velocities: tuple[Vector, ...]  # u of each row, m/s, three components each
    # ``"linear"``; ``"monotone"``, each component a cubic between rows that does not overshoot them (SciPy's PCHIP),
    # continuous with its first derivative; ``"spline"``, cubics that are continuous with their first two derivatives
    # between the outer rows, where the second is zero, and which may overshoot. ``"cubic"`` is an older name of
    # ``"monotone"``.
    interpolation: Interpolation = "linear"

    def __post_init__(self) -> None:
        levels = tuple(float(level) for level in self.levels)
        velocities = tuple(_vector(row, "velocities") for row in self.velocities)
        if len(levels) < 2 or not np.isfinite(levels).all() or (np.diff(levels) <= 0).any():
            raise ValueError(f"levels is {levels}: it must be two or more increasing heights")
        if len(velocities) != len(levels):
            raise ValueError(
                f"velocities has {len(velocities)} rows: there must be one for each of {len(levels)} levels"
            )
        if self.interpolation not in get_args(Interpolation):
            raise ValueError(f"interpolation is {self.interpolation!r}: it must be one of {get_args(Interpolation)}")
        object.__setattr__(self, "levels", levels)
        object.__setattr__(self, "velocities", velocities)

    @property
    def breaks(self) -> tuple[float, ...]:  # type: ignore[override]
        """The rows: the first derivative jumps there, of monotone cubics the second, of a spline the third."""
        return self.levels

    @cached_property
    def _cubics(self) -> PchipInterpolator | CubicSpline:
        if self.interpolation == "spline":
            return CubicSpline(self.levels, np.asarray(self.velocities), bc_type="natural")
        return PchipInterpolator(self.levels, np.asarray(self.velocities))

    def _held(self, levels: ArrayLike) -> FloatArray:
        return np.clip(np.asarray(levels, dtype=float), self.levels[0], self.levels[-1])

    def times(self, factor: float) -> TabulatedStream:
        """Return the stream with all velocities multiplied by a dimensionless factor."""
        return replace(self, velocities=tuple(_times(factor, row) for row in self.velocities))

    def profile(self, levels: ArrayLike) -> FloatArray:
        """Return u, m/s, at heights, m, shape (n,); shape (n, 3)."""
        heights = self._held(levels)
        if self.interpolation != "linear":
            return np.asarray(self._cubics(heights))
        return np.stack([np.interp(heights, self.levels, column) for column in np.transpose(self.velocities)], axis=-1)

    def slope(self, levels: ArrayLike) -> FloatArray:
        """Return du/dz, 1/s, at heights, m, shape (n,); shape (n, 3); at a break from above."""
        heights = np.asarray(levels, dtype=float)
        if self.interpolation != "linear":
            inside = np.asarray(self._cubics(self._held(heights), 1))
        else:
            rows = np.clip(np.searchsorted(self.levels, heights, side="right") - 1, 0, len(self.levels) - 2)
            inside = (np.diff(self.velocities, axis=0) / np.diff(self.levels)[:, None])[rows]
        within = (heights >= self.levels[0]) & (heights < self.levels[-1])
        return np.where(within[..., None], inside, 0.0)
