"""How a level of open water, the surface or the interface of two liquids, answers a load: symbol, waves, kernel.

A load p(x) on the level (downwards on the liquid, N/m) and its elevation w obey p̂ = (S(k) − c) ŵ, e^{-iωt}, where
S(k) = ω² Σ ± ρψ/w is the pressure of the liquids per elevation and c = Δρ g. So w = −p/c − ∫ Q(x − ξ) p(ξ) dξ with
Q̂ = 1/(c − S) − 1/c, whose poles on the real axis are the waves; the contour passes below them for k > 0.

Nothing of the package is imported.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.optimize import brentq
from scipy.special import sici

Symbol = Callable[[np.ndarray], np.ndarray]


@dataclass(frozen=True, kw_only=True)
class Level:
    """A level of open water at one frequency.

    Attributes:
        omega: ω, rad/s.
        stiffness: c = Δρ g, N/m³.
        symbol: S(k), N/m³, even in k.
        deep: ω² Σρ/c, 1/m: S = c deep/|k| but for parts that fall like e^{-2k ``depth``}.
        depth: of the shallowest liquid beside the level, m, may be infinite.
        wave_numbers: of the waves, 1/m, ascending.
    """

    omega: float
    stiffness: float
    symbol: Symbol
    deep: float
    depth: float
    wave_numbers: np.ndarray

    @property
    def residues(self) -> np.ndarray:
        """Of Q̂ at the waves, m²/N: the energy flux of elevation A is ω|A|²/(4 residue)."""
        step = 1e-20
        slopes = self.symbol(self.wave_numbers + 1j * step).imag / step
        return np.asarray(-1 / slopes)

    def kernel(self, absorbing_layer: float) -> Callable[[np.ndarray], np.ndarray]:
        """c Q(x) for 0 < x <= ``reach``, 1/m: that of deep liquids in closed form, the rest by polynomials."""
        if math.isinf(self.depth):
            return self._deep_kernel
        count = math.ceil(absorbing_layer / min(self.depth, 3 / self.wave_numbers[-1], 3 / self.deep))
        width, nodes = absorbing_layer / count, np.polynomial.chebyshev.chebpts1(24)
        samples = self._correction(
            (np.arange(count)[:, None] * width + width / 2 * (nodes + 1)).ravel(), absorbing_layer
        )
        orders = np.arange(24)
        to_series = 2 / 24 * np.cos(orders[:, None] * np.arccos(nodes))
        to_series[0] /= 2
        series = samples.reshape(count, 24) @ to_series.T

        def both(x: np.ndarray) -> np.ndarray:
            panel = np.minimum((x / width).astype(int), count - 1)
            angle = np.arccos(np.clip(2 * (x / width - panel) - 1, -1, 1))
            rest = np.sum(series[panel] * np.cos(angle[..., None] * orders), axis=-1)
            return np.asarray(self._deep_kernel(x) + rest)

        return both

    def _deep_kernel(self, x: np.ndarray) -> np.ndarray:
        """(deep/π) ∫ cos kx/(k − deep) dk."""
        u = self.deep * x
        sine, cosine = sici(u)
        real = -np.cos(u) * cosine - np.sin(u) * (sine - math.pi / 2)
        return np.asarray(self.deep / math.pi * (real + 1j * math.pi * np.exp(1j * u)))

    def _correction(self, x: np.ndarray, absorbing_layer: float) -> np.ndarray:
        """(1/π) ∫ cos kx (c Q̂ − deep/(k − deep)) dk, below the real axis by 2/``reach`` at most."""
        dip, end = 2 / absorbing_layer, 20 / self.depth
        graded = np.concatenate([[0], dip * 2.0 ** np.arange(-24, 1)])
        edges = np.concatenate([graded * (1 - 1j), np.linspace(dip, end, 2 + int(end / dip))[1:] - 1j * dip])
        nodes, weights = np.polynomial.legendre.leggauss(20)
        total = np.zeros(len(x), complex)
        for low, high in pairwise(edges):
            k = (low + high) / 2 + (high - low) / 2 * nodes
            density = self.stiffness / (self.stiffness - self.symbol(k)) - 1 - self.deep / (k - self.deep)
            total += np.cos(np.outer(x, k)) @ (density * weights) * (high - low) / 2
        return np.asarray(total / math.pi)


def one_liquid(omega: float, *, density: float, depth: float, gravity: float = 9.81) -> Level:
    """The surface of one liquid, S = ρω² coth kH/k.

    Args:
        omega: ω, rad/s.
        density: ρ, kg/m³.
        depth: H, m, may be infinite.
        gravity: g, m/s².
    """
    deep = omega**2 / gravity
    wave = brentq(
        lambda k: k * math.tanh(k * depth) - deep, deep, 1.01 * deep + 2 * math.sqrt(deep / depth), xtol=1e-300
    )
    return Level(
        omega=omega,
        stiffness=density * gravity,
        symbol=lambda k: density * omega**2 / (k * np.tanh(k * depth)),
        deep=deep,
        depth=depth,
        wave_numbers=np.array([wave]),
    )
