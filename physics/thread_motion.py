"""How the ends of a thread are moved, and vortices that it sheds. SI units."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from math import isfinite, sin

import numpy as np
from scipy.interpolate import CubicSpline

from hydroelastic.physics.arrays import FloatArray

Vector = tuple[float, float, float]


@dataclass(frozen=True, kw_only=True)
class EndDisplacement:
    """Displacement of an end from its initial position, R(t)(V t + A (sin(ωt + φ) − sin φ) + x(t) − x(0)).

    R rises from 0 to 1 with two continuous derivatives, x(t) is a cubic spline through a table.
    """

    velocity: Vector = (0.0, 0.0, 0.0)  # V, m/s
    amplitude: Vector = (0.0, 0.0, 0.0)  # A, m
    omega: float = 1.0  # ω, rad/s
    phase: float = 0.0  # φ, rad
    rise: float = 0.0  # time in which R rises, s
    table: tuple[tuple[float, ...], ...] = ()  # rows of time, s, and x, y, z, m; empty without one

    def __call__(self, time: float) -> FloatArray:
        """Return the displacement, m, shape (3,), at a time, s."""
        turned = sin(self.omega * time + self.phase) - sin(self.phase)
        way = np.array(self.velocity) * time + np.array(self.amplitude) * turned
        if self._spline is not None:
            way = way + self._spline(time)
        return np.asarray(_smooth_rise(time, self.rise) * way)

    def directions(self) -> Iterator[tuple[float, float]]:
        """Yield horizontal vectors (x, y) that span all displacements."""
        yield from ((vector[0], vector[1]) for vector in (self.velocity, self.amplitude))
        yield from ((row[1], row[2]) for row in self.table)

    @cached_property
    def _spline(self) -> CubicSpline | None:
        rows = np.array(self.table)
        return CubicSpline(rows[:, 0], rows[:, 1:] - rows[0, 1:]) if len(rows) else None


def _smooth_rise(time: float, duration: float) -> float:
    if time >= duration:
        return 1.0
    part = max(time, 0.0) / duration
    return part**3 * (10.0 + part * (6.0 * part - 15.0))


@dataclass(frozen=True, kw_only=True)
class VortexShedding:
    """Vortices that a thread sheds, with the force c|u_n|² sin(2π n ∫|u_n|dt + ψ) across stream and thread."""

    lift: float  # c = ρ d C_L/2, kg/m²
    wave_number: float  # n = St/d, cycles per metre that the liquid passes, 1/m
    phase: float = 0.0  # ψ, rad

    def __post_init__(self) -> None:
        for name in ("lift", "wave_number", "phase"):
            if not isfinite(getattr(self, name)):
                raise ValueError(f"{name} is {getattr(self, name)}: it must be finite")
