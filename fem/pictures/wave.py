"""A motion e^{−iωt} of liquids and bodies to be drawn: instants of it, and its largest values."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from hydroelastic.fem.pictures.mode import Array, FloatSection, ModePicture, SurfaceCurve


@dataclass(frozen=True, kw_only=True)
class WavePicture:
    """Both parts of a complex motion, of the same tank.

    Attributes:
        real: the motion at t = 0.
        imaginary: a quarter of a period later.
    """

    real: ModePicture
    imaginary: ModePicture

    def at(self, part: float) -> ModePicture:
        """The real part of the motion after a part of a period."""
        cosine, sine = np.cos(2.0 * np.pi * part), np.sin(2.0 * np.pi * part)
        return self._joined(lambda real, imaginary: cosine * real + sine * imaginary)

    @property
    def largest(self) -> ModePicture:
        """The largest values that everything reaches in a period, which give the scales of all its instants."""
        return self._joined(np.hypot)

    def _joined(self, joined: Callable[[Array, Array], Array]) -> ModePicture:
        real, imaginary = self.real, self.imaginary

        def curve(one: SurfaceCurve, other: SurfaceCurve) -> SurfaceCurve:
            return replace(one, displacement=joined(one.displacement, other.displacement))

        def section(one: FloatSection, other: FloatSection) -> FloatSection:
            return replace(one, displacement=joined(one.displacement, other.displacement))

        return replace(
            real,
            potential=joined(real.potential, imaginary.potential),
            displacement=joined(real.displacement, imaginary.displacement),
            surfaces=tuple(map(curve, real.surfaces, imaginary.surfaces)),
            floats=tuple(map(section, real.floats, imaginary.floats)),
        )
