"""Strings and beams in a stream along them: frequencies, divergence and flutter.

EI w⁗ − (T − m_a U²) w″ + 2 m_a U ẇ′ + (m + m_a) ẅ = 0.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Literal

import numpy as np
from numpy.polynomial import Legendre, legendre
from numpy.typing import NDArray
from scipy.linalg import eigvals, solve
from scipy.optimize import brentq, root

from hydroelastic.physics.arrays import FloatArray

ComplexArray = NDArray[np.complex128]
Ends = Literal["pinned", "clamped", "clamped-free"]

# Order of the zero of the displacement at the upstream and at the downstream end.
_ZEROS: dict[Ends, tuple[int, int]] = {"pinned": (1, 1), "clamped": (2, 2), "clamped-free": (2, 0)}
# Polynomials in the Galerkin solution: from 14 on, flutter speeds do not change in 8 digits.
_POLYNOMIALS = 20
# Modes among which flutter is looked for: rounding of the highest would be taken for growth.
_LOWEST = 8
# In units of √(EI/(m + m_a))/L²: slower oscillation, and slower growth of one, is rounding of a double root.
_LEAST_RATE = 1e-3
# Of u, past the merging of two modes.
_PAST = 1e-8
_SPEED_STEP = 0.05
_HIGHEST_SPEED = 40.0


def string_in_axial_flow(
    length: float, tension: float, mass: float, added_mass: float, speed: float, count: int
) -> ComplexArray:
    """Return the exponents λ of a fixed-fixed string, ω_n = (nπ/L)(T − m_a U²)/√((m + m_a)T − m m_a U²), λ = iω.

    At m_a U² = T all modes diverge at once; up to T(m + m_a)/m the motion is then gyroscopic; above, modes grow at
    rates in proportion to n, and the problem is ill-posed.

    Args:
        length: L, m.
        tension: T, N.
        mass: m, kg/m.
        added_mass: m_a, kg/m.
        speed: U, m/s.
        count: how many, from 1.

    Returns:
        λ, 1/s, with positive imaginary part, or growing, shape (count,).
    """
    for name, value in (("length", length), ("tension", tension), ("mass", mass), ("added_mass", added_mass)):
        if not (math.isfinite(value) and value > 0):
            raise ValueError(f"{name} is {value}: it must be finite and positive")
    if count < 1:
        raise ValueError(f"count is {count}: it must be 1 or more")
    push = added_mass * speed**2
    inertia = (mass + added_mass) * tension - mass * push
    if inertia == 0:
        raise ValueError(f"speed is {speed}: there modes grow infinitely fast, m_a U² = T(m + m_a)/m")
    rate = abs(tension - push) / math.sqrt(abs(inertia)) * (1j if inertia > 0 else 1.0)
    return np.asarray(np.arange(1, count + 1) * math.pi / length * rate)


@dataclass(frozen=True, kw_only=True)
class AxialFlowBeam:
    """A beam in a stream along it, straight at rest."""

    length: float  # L, m
    flexural_rigidity: float  # EI, N m²
    mass: float  # m, kg/m
    added_mass: float  # m_a, kg/m
    tension: float = 0.0  # T, N, constant; at a free end a dead force
    ends: Ends = "pinned"  # both pinned, both clamped, or clamped upstream and free downstream
    # f, of a free end: 0 blunt, no force at the end (the same as a pipe that ejects); 1 ideally tapered
    taper: float = 0.0

    def __post_init__(self) -> None:
        for name in ("length", "flexural_rigidity", "mass", "added_mass"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0):
                raise ValueError(f"{name} is {value}: it must be finite and positive")
        if not (math.isfinite(self.tension) and self.tension >= 0):
            raise ValueError(f"tension is {self.tension}: it must be finite and not negative")
        if self.ends not in ("pinned", "clamped", "clamped-free"):
            raise ValueError(f"ends is {self.ends!r}: it must be 'pinned', 'clamped' or 'clamped-free'")
        if not 0 <= self.taper <= 1:
            raise ValueError(f"taper is {self.taper}: it must lie between 0 and 1")

    @property
    def mass_ratio(self) -> float:
        """β = m_a/(m + m_a)."""
        return self.added_mass / (self.mass + self.added_mass)

    @property
    def tension_parameter(self) -> float:
        """Γ = T L²/EI."""
        return self.tension * self.length**2 / self.flexural_rigidity

    @property
    def speed_unit(self) -> float:
        """√(EI/m_a)/L, m/s: U of u = 1."""
        return math.sqrt(self.flexural_rigidity / self.added_mass) / self.length

    @property
    def rate_unit(self) -> float:
        """√(EI/(m + m_a))/L², 1/s: the frequency of 1."""
        return math.sqrt(self.flexural_rigidity / (self.mass + self.added_mass)) / self.length**2

    def divergence_speed(self) -> float:
        """Return the lowest speed of divergence, m/s: u = √(π² + Γ) pinned, √(4π² + Γ) clamped, for any β."""
        if self.ends == "clamped-free":
            raise ValueError("ends is 'clamped-free': divergence is known of pinned and clamped beams")
        wavenumber = math.pi if self.ends == "pinned" else 2 * math.pi
        return math.hypot(wavenumber, math.sqrt(self.tension_parameter)) * self.speed_unit

    def exponents(self, speed: float, count: int) -> ComplexArray:
        """Return the λ of smallest |λ| with Im λ ≥ 0, by Galerkin's method with polynomials.

        Args:
            speed: U, m/s.
            count: how many, from 1 to 20; the last ones are less accurate.

        Returns:
            λ, 1/s, by rising |λ|, shape (count,).
        """
        if not 1 <= count <= _POLYNOMIALS:
            raise ValueError(f"count is {count}: it must be from 1 to {_POLYNOMIALS}")
        found = self._exponents(speed / self.speed_unit)
        upper = found[found.imag >= 0]
        return np.asarray(upper[np.argsort(np.abs(upper))][:count] * self.rate_unit)

    def flutter(self) -> tuple[float, float]:
        """Return the lowest speed at which oscillations grow, m/s, and their frequency there, 1/s.

        Where both ends are held, or the free one is ideally tapered, two modes merge: to about 1e-8, with the
        frequency 0 if both of them grow already without oscillation. Else a mode loses its damping at the free end:
        from the exact determinant, to rounding.
        """
        speeds = np.arange(_SPEED_STEP, _HIGHEST_SPEED, _SPEED_STEP)
        for low, high in pairwise(speeds.tolist()):
            if self._growth(high) > 0:
                speed = float(brentq(self._growth, low, high, xtol=1e-13))
                omega = self._fastest(speed + _PAST).imag
                if not self._neutral:
                    speed, omega = self._polished(speed, omega)
                elif omega < 10 * _LEAST_RATE:
                    omega = 0.0
                return speed * self.speed_unit, omega * self.rate_unit
        raise ValueError(f"the beam does not flutter below u = {_HIGHEST_SPEED}")

    @cached_property
    def _matrices(self) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Return, of functions on [0, 1], mass, damping of √β u, and stiffness: of EI and tension, and of u²."""
        left, right = _ZEROS[self.ends]
        factor = Legendre.fromroots([0.0] * left + [1.0] * right, domain=[0, 1])
        functions = [factor * Legendre.basis(k, domain=[0, 1]) for k in range(_POLYNOMIALS)]
        rule = legendre.leggauss(_POLYNOMIALS + 4)
        x, weights = 0.5 * (1 + rule[0]), 0.5 * rule[1]
        values, slopes, bends = (np.array([f.deriv(k)(x) for f in functions]) for k in (0, 1, 2))
        scale = 1 / np.sqrt(bends**2 @ weights)[:, None]
        values, slopes, bends = values * scale, slopes * scale, bends * scale
        end = np.array([f(1.0) for f in functions]) * scale[:, 0]
        end_slope = np.array([f.deriv()(1.0) for f in functions]) * scale[:, 0]
        cross = (values * weights) @ slopes.T
        return (
            (values * weights) @ values.T,
            cross - cross.T + (1 - self.taper) * np.outer(end, end),
            (bends * weights) @ bends.T + self.tension_parameter * (slopes * weights) @ slopes.T,
            -(slopes * weights) @ slopes.T + (1 - self.taper) * np.outer(end, end_slope),
        )

    @property
    def _neutral(self) -> bool:
        """Whether energy is conserved, so that stable oscillations neither decay nor grow."""
        return self.ends != "clamped-free" or self.taper == 1

    def _exponents(self, speed: float) -> ComplexArray:
        mass, gyroscopic, bending, push = self._matrices
        stiffness = bending + speed**2 * push
        damping = math.sqrt(self.mass_ratio) * speed * gyroscopic
        count = len(mass)
        # In 1/λ: large exponents, which are not accurate anyway, do not spoil small ones.
        companion = np.block(
            [
                [-solve(stiffness, damping), -solve(stiffness, mass)],
                [np.eye(count), np.zeros((count, count))],
            ]
        )
        return np.asarray(1 / eigvals(companion))

    def _fastest(self, speed: float) -> complex:
        """Return the λ that grows fastest among the lowest that oscillate."""
        found = self._exponents(speed)
        oscillating = found[found.imag > _LEAST_RATE]
        lowest = oscillating[np.argsort(np.abs(oscillating))][:_LOWEST]
        return complex(lowest[np.argmax(lowest.real)])

    def _growth(self, speed: float) -> float:
        return self._fastest(speed).real - (_LEAST_RATE if self._neutral else 0.0)

    def _polished(self, speed: float, omega: float) -> tuple[float, float]:
        """Return u and ω at which the exact determinant vanishes, near those of Galerkin's method."""
        size = abs(self._determinant(speed * 1.01, omega))

        def parts(x: FloatArray) -> FloatArray:
            value = self._determinant(x[0], x[1]) / size
            return np.array([value.real, value.imag])

        found = root(parts, np.array([speed, omega]), options={"xtol": 1e-14})
        return float(found.x[0]), float(found.x[1])

    def _determinant(self, speed: float, omega: float) -> complex:
        """Return the determinant of w = Σ aⱼ e^{pⱼx} at the ends of a clamped-free beam, λ = iω.

        It is divided by the product of all pⱼ − pₖ, with which it vanishes where two pⱼ meet.
        """
        drift = math.sqrt(self.mass_ratio) * speed * 1j * omega
        p = np.roots([1.0, 0.0, speed**2 - self.tension_parameter, 2 * drift, -(omega**2)])
        end = np.exp(p)
        shear = p**3 - self.tension_parameter * p + self.taper * (drift + speed**2 * p)
        matrix = np.stack([np.ones(4), p, p**2 * end, shear * end])
        differences = (p[:, None] - p[None, :])[np.triu_indices(4, 1)]
        return complex(np.linalg.det(matrix) / np.prod(differences))
