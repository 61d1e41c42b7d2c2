"""A heavy string that hangs at rest in a resisting liquid: modes, roots, fronts and steady motion.

ρ U_tt = −2λ U_t + (ρ g x U_x)_x with x up from the free lower end, U(l, t) = f(t). With α = λ/ρ, the travel time
R = 2√(l/g), r = √(x/l) and the zeros μ_k of J₀ the modes are J₀(μ_k r) with Ω_k = μ_k/R, and the motion of the upper
end reaches x in Laplace images by I₀(z r)/I₀(z), z = R√(p² + 2αp).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import i0e, ive, j0, j1

from hydroelastic.modal.bessel_zeros import bessel_zeros

# Fraction of μ below which J₀ near its zero is rounding alone.
AT_A_ZERO = 4 * np.finfo(float).eps


@dataclass(frozen=True, kw_only=True)
class HangingString:
    """A uniform heavy string, fixed to a moving upper end, free below.

    Attributes:
        length: l, m.
        damping: α = λ/ρ, 1/s, with 2λ the drag per unit of length and velocity and ρ the mass per unit of length.
        gravity: g, m/s².

    Raises:
        ValueError: if the length or gravity is not positive and finite, or the damping negative or not finite.
    """

    length: float
    damping: float = 0.0
    gravity: float = 9.81

    def __post_init__(self) -> None:
        """Refuse what no string can be."""
        for name in ("length", "gravity"):
            value = getattr(self, name)
            if not (value > 0 and math.isfinite(value)):
                raise ValueError(f"{name} is {value}: it must be positive and finite")
        if not (self.damping >= 0 and math.isfinite(self.damping)):
            raise ValueError(f"damping is {self.damping}: it must be finite and not negative")

    @property
    def travel_time(self) -> float:
        """R = 2√(l/g), s: a front goes once along the string."""
        return 2 * math.sqrt(self.length / self.gravity)

    def zeros(self, count: int) -> NDArray[np.float64]:
        """Return the first zeros μ_k of J₀, shape (count,)."""
        _check_count(count)
        return bessel_zeros(count)

    def frequencies(self, count: int) -> NDArray[np.float64]:
        """Return the undamped frequencies Ω_k = μ_k/R of the first modes, 1/s, shape (count,)."""
        return np.divide(self.zeros(count), self.travel_time)

    def roots(self, count: int) -> NDArray[np.complex128]:
        """Return the roots of p² + 2αp + Ω_k² for the first modes, 1/s, shape (count, 2).

        −α ± i√(Ω_k² − α²); beyond critical damping the slow root −Ω_k²/(α + s) first, then the fast −(α + s), with
        s = √(α² − Ω_k²); both −α at critical damping.
        """
        frequencies = self.frequencies(count)
        excess = (frequencies - self.damping) * (frequencies + self.damping)
        root = np.sqrt(np.abs(excess))
        under = -self.damping + np.outer(root, [1j, -1j])
        fast = self.damping + root
        slow = np.divide(frequencies**2, fast, out=np.zeros_like(fast), where=fast > 0)
        return np.where((excess > 0)[:, None], under, -np.stack([slow, fast], axis=1))

    def first_oscillating_mode(self) -> int:
        """Return the number of the lowest mode that oscillates: Ω_{k−1} ≤ α < Ω_k, counted from 1.

        Higher modes oscillate too: no damping suppresses the oscillation of all.
        """
        # Ω_k > π(k − 1/4)/R, so that no mode above this one is aperiodic.
        enough = int(self.damping * self.travel_time / math.pi + 2)
        return int(np.searchsorted(self.frequencies(enough), self.damping, side="right")) + 1

    def least_damping_without_oscillation(self, number: int) -> float:
        """Return the least damping at which modes 1 … number are aperiodic, Ω_number, 1/s (critical for the last)."""
        _check_mode(number)
        return float(self.frequencies(number)[-1])

    def mode_shape(self, number: int, positions: ArrayLike) -> NDArray[np.float64]:
        """Return J₀(μ_k √(x/l)) of mode k = number, counted from 1, at the positions (m)."""
        _check_mode(number)
        return np.asarray(j0(self.zeros(number)[-1] * self.relative_roots(positions)))

    def relative_roots(self, positions: ArrayLike) -> NDArray[np.float64]:
        """Return r = √(x/l) at positions x (m) above the lower end.

        Raises:
            ValueError: if a position is not on the string.
        """
        positions = np.asarray(positions, dtype=float)
        wrong = ~((positions >= 0) & (positions <= self.length))
        if wrong.any():
            raise ValueError(
                f"positions has {positions[wrong].flat[0]}: from 0, the free lower end, to {self.length} m is allowed"
            )
        return np.sqrt(positions / self.length)

    def front_time(self, positions: ArrayLike) -> NDArray[np.float64]:
        """Return t_f = 2(√l − √x)/√g, s, before which x is at rest, at the positions (m)."""
        return self.travel_time * (1 - self.relative_roots(positions))

    def front_jump(self, positions: ArrayLike) -> NDArray[np.float64]:
        """Return the height (l/x)^{1/4} e^{−α t_f} of the front of a unit step at positions x, m; infinite at 0."""
        ratios = self.relative_roots(positions)
        with np.errstate(divide="ignore"):
            return np.asarray(np.exp(-self.damping * self.travel_time * (1 - ratios)) / np.sqrt(ratios))

    def transfer(self, exponents: ArrayLike, positions: ArrayLike) -> NDArray[np.complex128]:
        """Return h = I₀(z r)/I₀(z), z = R√(p² + 2αp): the string moves as h e^{pt} under f = e^{pt}.

        Args:
            exponents: p, 1/s, complex, shape (exponents,) or one.
            positions: x, m, shape (positions,) or one.

        Returns:
            h, shape (positions, exponents).
        """
        exponents = np.atleast_1d(np.asarray(exponents, dtype=complex))
        radicands = exponents * (exponents + 2 * self.damping)
        return bessel_ratio(
            np.sqrt(radicands) * complex(self.travel_time), np.atleast_1d(self.relative_roots(positions))
        )

    def amplitude(self, omega: float, positions: ArrayLike) -> NDArray[np.float64]:
        """Return A(x)/Δ = |J₀(μ r)/J₀(μ)|, μ = R√(ω² − 2iαω), of the steady motion under f = Δ sin ωt.

        Args:
            omega: ω, 1/s, not negative.
            positions: x, m, shape (positions,) or one.

        Returns:
            The ratio of amplitudes, shape (positions,). Infinite below the upper end without damping at ω = Ω_k, where
            the motion grows with time.

        Raises:
            ValueError: if ω is negative or a position is not on the string.
        """
        if not (omega >= 0 and math.isfinite(omega)):
            raise ValueError(f"omega is {omega}: it must be finite and not negative")
        ratios = np.atleast_1d(self.relative_roots(positions))
        argument = self.travel_time * omega
        if self.damping == 0 and abs(j0(argument)) <= AT_A_ZERO * argument * abs(j1(argument)):
            return np.where(ratios < 1, math.inf, 1.0)
        return np.asarray(np.abs(self.transfer(1j * omega, positions)[:, 0]))


def participations(zeros: NDArray[np.float64], ratios: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return B_k = 2J₀(μ_k r)/(μ_k J₁(μ_k)), of sum 1 for r < 1: how modes take part in a motion of the upper end.

    Args:
        zeros: μ_k, shape (modes,).
        ratios: r, from 0 to 1, shape (positions,).

    Returns:
        B_k, shape (positions, modes).
    """
    return np.asarray(j0(np.outer(ratios, zeros)) * (2 / (zeros * j1(zeros))))


def bessel_ratio(arguments: NDArray[np.complex128], ratios: NDArray[np.float64]) -> NDArray[np.complex128]:
    """Return I₀(z r)/I₀(z), shape (ratios, arguments), without overflow.

    Args:
        arguments: z, complex, with real part from 0, shape (arguments,).
        ratios: r, from 0 to 1, shape (ratios,).
    """
    scaled = np.exp(-np.multiply.outer(1 - ratios, np.abs(arguments.real)))
    return scaled * _scaled_bessel(np.multiply.outer(ratios, arguments)) / _scaled_bessel(arguments)


def _scaled_bessel(arguments: NDArray[np.complex128]) -> NDArray[np.complex128]:
    """Return I₀(z) e^{−|Re z|}; on the axes by the real functions, which hold for any size."""
    if not arguments.imag.any():
        return i0e(arguments.real).astype(complex)
    if not arguments.real.any():
        return j0(arguments.imag).astype(complex)
    return np.asarray(ive(0, arguments))


def _check_count(count: int) -> None:
    if count < 0:
        raise ValueError(f"count is {count}: it must not be negative")


def _check_mode(number: int) -> None:
    if number < 1:
        raise ValueError(f"number is {number}: modes are counted from 1")
