"""A beam whose flexural rigidity and mass vary along it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Self, TypeAlias

import numpy as np

from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.beams import Beam
from hydroelastic.physics.scales import Scales

AlongBeam: TypeAlias = Callable[[FloatArray], FloatArray]
"""A property of a beam at distances from its left end."""

# Points of each section at which beams are compared, and the relative difference allowed for rounding.
_SAMPLES, _ALIKE = 9, 1e-12


@dataclass(frozen=True, kw_only=True)
class VaryingBeam(Beam):
    """A beam whose EI(x) and m(x) are smooth within each section; they or their slopes may jump between two.

    The sections hold their lengths, the flexural rigidity as flexible on the whole and the mean mass: enough for what
    only needs to know about how stiff the beam is, such as the choice of a mesh.
    """

    # EI at distances from the left end, N·m per metre of width; at the end of two sections it is asked for a little
    # inside of each
    rigidity: AlongBeam
    mass: AlongBeam  # m there, kg/m²

    @property
    def is_uniform(self) -> bool:
        """It has no closed form."""
        return False

    @property
    def has_uniform_mass(self) -> bool:
        """It is not known to have one."""
        return False

    def rigidity_of(self, span: int, fractions: FloatArray) -> FloatArray:
        """EI at fractions of the length of a span, 0 < fraction < 1, N·m."""
        return self.rigidity(self._places(span, fractions))

    def mass_of(self, span: int, fractions: FloatArray) -> FloatArray:
        """m at fractions of the length of a span, kg/m²."""
        return self.mass(self._places(span, fractions))

    def _places(self, span: int, fractions: FloatArray) -> FloatArray:
        left, right = self.edges[span : span + 2]
        return left + (right - left) * fractions

    def scaled(self, units: Scales, start: float, end: float) -> Self:
        """Return the beam in other units, between given ends in these units."""
        stretch = (end - start) / self.length
        rigidity, mass = self.rigidity, self.mass
        return replace(
            super().scaled(units, start, end),
            rigidity=lambda x: rigidity(x / stretch) / units.flexural_rigidity,
            mass=lambda x: mass(x / stretch) / units.mass_per_length,
        )

    def with_uniform_mass(self) -> Self:
        """Return the beam with a mass per length of 1 everywhere, and its left end at the origin."""
        return replace(super().with_uniform_mass(), mass=np.ones_like)

    @cached_property
    def reversed(self) -> Self:
        """The beam seen from the other side, in its place."""
        rigidity, mass, length = self.rigidity, self.mass, self.length
        return replace(super().reversed, rigidity=lambda x: rigidity(length - x), mass=lambda x: mass(length - x))

    def is_mirror_image_of(self, other: object) -> bool:
        """Whether it is the mirror image of another body up to rounding, wherever both float."""
        if not isinstance(other, VaryingBeam) or not super().is_mirror_image_of(other):
            return False
        image = other.reversed
        return all(
            np.allclose(own, its, rtol=_ALIKE, atol=0.0)
            for own, its in zip(self._samples(), image._samples(), strict=True)
        )

    def _samples(self) -> tuple[FloatArray, FloatArray]:
        fractions = (np.arange(_SAMPLES) + 0.5) / _SAMPLES
        spans = range(len(self.edges) - 1)
        return (
            np.concatenate([self.rigidity_of(span, fractions) for span in spans]),
            np.concatenate([self.mass_of(span, fractions) for span in spans]),
        )
