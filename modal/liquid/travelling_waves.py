"""Waves that travel in open water at a given frequency: wavenumber and vertical profile of ψ, in one liquid or two."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt
from scipy.optimize import brentq

from hydroelastic.modal.liquid.two_layer import Branch, TwoLayers, interface_frequencies
from hydroelastic.physics.arrays import FloatArray


@dataclass(frozen=True, kw_only=True)
class TravellingWave:
    """A wave ψ = e^{±ikx} Z(y) e^{−iωt}.

    Z = 1 in the lower liquid at y = 0; for the surface wave over two liquids at the top of the upper one.
    """

    layers: TwoLayers  # the liquids
    branch: Branch  # which of the waves of its frequency it is
    omega: float  # ω, rad/s
    wavenumber: float  # k, 1/m

    @property
    def on_top(self) -> bool:
        """Whether it is the wave of the free top of two liquids."""
        return self.branch == "surface" and self.layers.density_above > 0.0

    def profile(self, y: npt.ArrayLike, *, above: npt.ArrayLike = False) -> tuple[FloatArray, FloatArray]:
        """Return Z and Z' at some heights.

        Args:
            y: m.
            above: whether a point belongs to the upper liquid.
        """
        y = np.asarray(y, dtype=np.float64)
        lower = self._lower(np.minimum(y, 0.0))
        if not self.layers.density_above:
            return lower
        upper = self._upper(np.maximum(y, 0.0))
        return np.where(above, upper[0], lower[0]), np.where(above, upper[1], lower[1])

    @cached_property
    def energy(self) -> float:
        """N = ∫ρZ² dy, kg/m, in closed form: the wave carries the power ½ω³ k N |ψ|².

        With Z'' = k²Z the integrand of ∫Z² = [ZZ']/(2k²) + ½ ∫(Z² − Z'²/k²) dy is constant in each layer.
        """
        below = self._layer_integral(-self.layers.depth_below, 0.0, above=False)
        total = self.layers.density_below * below
        if self.layers.density_above:
            total += self.layers.density_above * self._layer_integral(0.0, self.layers.depth_above, above=True)
        return total

    @property
    def elevation(self) -> float:
        """Elevation of the level y = 0 over the ψ to which Z is scaled: Z'(0), 1/m."""
        return float(self.profile(0.0)[1])

    @property
    def top_elevation(self) -> float:
        """Elevation of the top of the upper of two liquids over the same ψ, 1/m."""
        return float(self.profile(self.layers.depth_above, above=True)[1])

    @cached_property
    def _tanh_below(self) -> float:
        return math.tanh(self.wavenumber * self.layers.depth_below)

    @cached_property
    def _upper_parts(self) -> tuple[float, float]:
        """P and Q of Z = P e^{k(y − h₁)} + Q e^{−ky} in the upper liquid.

        Their ratio follows from the top, or from the interface: from the one at which the wave is small, so that
        nothing cancels where it is large.
        """
        k, depth = self.wavenumber, self.layers.depth_above
        decay = math.exp(-k * depth)
        if self.on_top:
            lower, upper, g = self.layers.density_below, self.layers.density_above, self.layers.gravity
            # (ρ₂ − ρ₁) g Z' = ω²(ρ₂Z₂ − ρ₁Z₁) at y = 0, with Z₂ = Z'/(k tanh kh₂).
            jump = (lower - upper) * g * k / self.omega**2 - lower / self._tanh_below
            ratio = (jump + upper) / (jump - upper)
            return 1.0 / (1.0 + ratio * decay**2), ratio * decay / (1.0 + ratio * decay**2)
        growing, decaying = self._top_coefficients()
        factor = self._tanh_below / (growing * decay**2 - decaying)
        return factor * growing * decay, factor * decaying

    def _top_coefficients(self) -> tuple[float, float]:
        if math.isinf(self.layers.depth_above):
            return 0.0, 1.0
        if self.layers.top == "rigid":
            return 1.0, 1.0
        if self.layers.top == "pressure_release":
            return -1.0, 1.0
        q = self.omega**2 / (self.layers.gravity * self.wavenumber)
        return 1.0 + q, 1.0 - q

    def _upper(self, y: FloatArray) -> tuple[FloatArray, FloatArray]:
        k = self.wavenumber
        growing, decaying = self._upper_parts
        rise = growing * np.exp(k * (y - self.layers.depth_above)) if growing else 0.0 * y
        fall = decaying * np.exp(-k * y)
        return rise + fall, k * (rise - fall)

    def _lower(self, y: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Z ~ cosh k(y + h₂), without overflow, to fit the elevation of the upper liquid."""
        k, depth = self.wavenumber, self.layers.depth_below
        scale = 1.0
        if self.on_top:
            scale = float(self._upper(np.array(0.0))[1]) / (k * self._tanh_below)
        rise = np.exp(k * y)
        image = np.exp(-k * (y + 2.0 * depth)) if math.isfinite(depth) else 0.0 * y
        scale /= 1.0 + math.exp(-2.0 * k * depth)
        return scale * (rise + image), scale * k * (rise - image)

    def _layer_integral(self, bottom: float, top: float, *, above: bool) -> float:
        k = self.wavenumber
        ends = []
        for y in (bottom, top):
            value, slope = self.profile(y, above=above) if math.isfinite(y) else (0.0, 0.0)
            ends.append((float(value), float(slope)))
        (low, low_slope), (high, high_slope) = ends
        integral = (high * high_slope - low * low_slope) / (2.0 * k**2)
        if math.isinf(top - bottom):
            return integral
        # At a bed, where Z' = 0, nothing cancels.
        constant = (low - low_slope / k) * (low + low_slope / k)
        return integral + 0.5 * (top - bottom) * constant


def travelling_waves(layers: TwoLayers, omega: float) -> tuple[TravellingWave, ...]:
    """Return the waves that travel at a frequency, the shortest first.

    Args:
        layers: the liquids; depths may be infinite.
        omega: ω > 0, rad/s.

    Source: H. Lamb, "Hydrodynamics", art. 231; dispersion as in `two_layer.interface_frequencies`.
    """
    if not omega > 0.0:
        raise ValueError(f"omega is {omega}; it must be positive")
    return tuple(
        TravellingWave(layers=layers, branch=branch, omega=omega, wavenumber=_wavenumber(layers, branch, omega))
        for branch in layers.branches
    )


def _wavenumber(layers: TwoLayers, branch: Branch, omega: float) -> float:
    def excess(logarithm: float) -> float:
        return math.log(float(interface_frequencies(layers, math.exp(logarithm))[branch]) / omega)

    low = high = math.log(omega**2 / layers.gravity)
    while excess(low) > 0.0:
        low -= 2.0
    while excess(high) < 0.0:
        high += 2.0
    if low == high:
        return math.exp(low)
    return math.exp(brentq(excess, low, high, xtol=1e-15, rtol=4 * np.finfo(float).eps))
