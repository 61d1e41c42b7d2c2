"""The wave on the level of infinitely deep liquids at a complex frequency, where it grows or falls along the level."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from hydroelastic.modal.floats.complex_moments import ComplexArray
from hydroelastic.modal.liquid.two_layer import TwoLayers


@dataclass(frozen=True, kw_only=True)
class DeepWaterWave:
    """A wave ψ = e^{±ikx} Z(y) e^{−iωt} with Z = e^{ky} in the lower liquid and −e^{−ky} in the upper one,

        k = ω²(ρ₂ + ρ₁)/(g (ρ₂ − ρ₁)).

    Source: H. Lamb, "Hydrodynamics", art. 231, continued in ω².
    """

    layers: TwoLayers  # the liquids, all of infinite depth
    squared: complex  # λ = ω², rad²/s², complex

    @property
    def wavenumber(self) -> complex:
        """k, 1/m."""
        below, above = self.layers.density_below, self.layers.density_above
        return self.squared * (below + above) / (self.layers.gravity * (below - above))

    @property
    def energy(self) -> complex:
        """N = ∫ρZ² dy = (ρ₂ + ρ₁)/(2k), kg/m, continued from real k."""
        return (self.layers.density_below + self.layers.density_above) / (2.0 * self.wavenumber)

    def profile(self, y: npt.ArrayLike, *, above: npt.ArrayLike = False) -> tuple[ComplexArray, ComplexArray]:
        """Return Z and Z' at some heights.

        Args:
            y: m.
            above: whether a point belongs to the upper liquid.
        """
        sign = np.where(above, -1.0, 1.0)
        rise = np.exp(sign * self.wavenumber * np.asarray(y, dtype=np.float64))
        return sign * rise, self.wavenumber * rise
