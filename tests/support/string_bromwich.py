"""The motion of a hanging string by a numerical Bromwich integral: neither zeros of J₀ nor residues.

U(x, t) = (1/π) ∫₀^∞ Re[F(p) h(x, p) e^{pt}] w(y) dy, p = c + iy, h = I₀(zr)/I₀(z), z = R√(p² + 2αp). The trapezoidal
rule of step 2π/T adds U(t + nT) e^{−cnT}, n ≥ 1: e^{−37} here. The window w = ½ erfc(6 (2y/Y − 1)) leaves the integral
where it is at a distance d R from fronts, but for e^{−(dRY/24)²}.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from scipy.special import erfc, ive

Transform = Callable[[NDArray[np.complex128]], NDArray[np.complex128]]
PERIODS = 12.0


def ramp_image(speed: float) -> Transform:
    """V/p²."""
    return lambda p: speed / p**2


def step_image(amplitude: float) -> Transform:
    """Δ/p."""
    return lambda p: amplitude / p


def sine_image(amplitude: float, omega: float) -> Transform:
    """Δω/(p² + ω²)."""
    return lambda p: amplitude * omega / (p**2 + omega**2)


def smooth_image(amplitude: float, rate: float) -> Transform:
    """2Δβ²/(p(p + β)(p + 2β))."""
    return lambda p: 2 * amplitude * rate**2 / (p * (p + rate) * (p + 2 * rate))


def bromwich(
    image: Transform,
    *,
    length: float,
    damping: float,
    gravity: float,
    position: float,
    time: float,
    highest: float = 0.0,
) -> float:
    """Return U(x, t).

    Args:
        image: F(p) of the upper end's motion.
        length: l, m.
        damping: α, 1/s.
        gravity: g, m/s².
        position: x, m.
        time: t, s, after the front.
        highest: frequency of the upper end, 1/s, or 0.
    """
    travel, ratio = 2 * math.sqrt(length / gravity), math.sqrt(position / length)
    phase = time / travel
    distance = min(abs(phase - odd - sign * ratio) for sign in (-1, 1) for odd in (2 * round((phase + way) / 2) + 1
                   for way in (-2, -1, 0, 1)))  # fmt: skip
    period = PERIODS * time
    contour = 37 / period
    last = max(24 * 6.2 / (distance * travel), 20 * max(damping, highest), 40 * contour)
    y = 2 * math.pi / period * np.arange(int(last * period / (2 * math.pi)) + 1)
    p = contour + 1j * y
    z = travel * np.sqrt(p * (p + 2 * damping))
    transfer = ive(0, z * ratio) / ive(0, z) * np.exp(-z.real * (1 - ratio))
    terms = (image(p) * transfer * np.exp(p * time)).real * erfc(6 * (2 * y / last - 1)) / 2
    terms[0] /= 2
    return float(terms.sum() * 2 / period)
