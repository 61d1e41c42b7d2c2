"""Two frequencies that approach each other: where, and how close they come.

Near an approach two modes exchange their shapes, and all others stay apart. With λ = ω² and a parameter p,

    λ₂ − λ₁ = √(g² + s²(p − p₀)²),    tan 2φ = s (p − p₀)/g

φ is the angle by which the two shapes are turned into each other. So (s(p − p₀), g) is a vector of length λ₂ − λ₁ that
turns by 2φ, and its end runs along a straight line at the distance g from the origin. Two points of that line, which
two solutions give, determine all of it. g = 0 is a crossing.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, cos, hypot, sin

import numpy as np


@dataclass(frozen=True, kw_only=True)
class Approach:
    """The nearest approach of two frequencies.

    Attributes:
        at: p₀.
        gap: g, the smallest λ₂ − λ₁.
        slope: s, the rate at which λ₂ − λ₁ changes far from p₀.
    """

    at: float
    gap: float
    slope: float

    @property
    def half_width(self) -> float:
        """Distance from p₀ at which the shapes are turned by half of their angle at p₀."""
        return self.gap / self.slope


def approach(ends: tuple[float, float], gaps: tuple[float, float], products: np.ndarray) -> Approach | None:
    """Return the approach of two frequencies from two values of the parameter."""
    turned = 2.0 * atan2(hypot(products[0, 1], products[1, 0]), hypot(products[0, 0], products[1, 1]))
    along = gaps[0] - gaps[1] * cos(turned), -gaps[1] * sin(turned)
    length = hypot(*along)
    if length == 0.0:
        return None
    part = gaps[0] * along[0] / length**2
    step = ends[1] - ends[0]
    return Approach(at=ends[0] + part * step, gap=abs(gaps[0] * along[1]) / length, slope=length / abs(step))


def nearest(values: np.ndarray, gaps: np.ndarray) -> Approach:
    """Return the approach of three points around the smallest gap, whose square is a parabola."""
    middle = values[1]
    curvature, slope, square = np.polyfit(values - middle, gaps**2, 2)
    if curvature <= 0.0:
        return Approach(at=float(middle), gap=float(gaps[1]), slope=0.0)
    shift = -0.5 * slope / curvature
    least = square - 0.25 * slope**2 / curvature
    return Approach(at=float(middle + shift), gap=float(np.sqrt(max(least, 0.0))), slope=float(np.sqrt(curvature)))
