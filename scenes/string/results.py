"""What is found of a hanging string."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import inf

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.kept_tolerance import kept_tolerance
from hydroelastic.scenes.models.string import StringScene
from hydroelastic.scenes.string.fronts import BESIDE, front_distance

Floats = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class StringMotions:
    """Free motions e^{pt}.

    Attributes:
        roots: p, 1/s, of conjugate pairs the one above the real axis, shape (motions,).
        errors: estimated absolute errors of the roots, 1/s.
        shapes: at the positions of the scene, largest real value 1, shape (motions, positions).
    """

    roots: NDArray[np.complex128]
    errors: Floats
    shapes: Floats

    @property
    def frequencies(self) -> Floats:
        """|p|, which is Ω where a mode of a uniformly damped string oscillates, 1/s."""
        return np.abs(self.roots)


@dataclass(frozen=True, kw_only=True)
class StringSolution:
    """The motion of a hanging string.

    Attributes:
        scene: the scene.
        displacement: U, m, shape (positions, times).
        absolute_error: estimated error of each value, m, of the same shape.
        motions: free motions, by ascending magnitude.
        size: cells, dofs, degree and steps of a field solution; terms of a series.
        seconds: time by stage.
    """

    scene: StringScene
    displacement: Floats
    absolute_error: Floats
    motions: StringMotions
    size: dict[str, int]
    seconds: dict[str, float]

    @cached_property
    def positions(self) -> Floats:
        """Heights above the free end at rest, m."""
        return np.array(self.scene.positions)

    @cached_property
    def times(self) -> Floats:
        """Times, s."""
        return np.array(self.scene.times)

    @cached_property
    def beside_fronts(self) -> NDArray[np.bool_]:
        """Which values lie so close to a wave front that they are not judged by the tolerance."""
        distance = front_distance(self.scene.string, self.positions, self.times)
        beside: NDArray[np.bool_] = distance < BESIDE[self.scene.method]
        return beside

    @cached_property
    def judged(self) -> NDArray[np.bool_]:
        """Which values the tolerance is asked of: those away from fronts, or all if there are no such values."""
        away = ~self.beside_fronts
        return away if away.any() else np.ones_like(away)

    @cached_property
    def trusted(self) -> NDArray[np.bool_]:
        """Values that are judged, and those beside a front that keep the tolerance all the same."""
        largest = np.abs(self.displacement[self.judged]).max(initial=0.0)
        kept: NDArray[np.bool_] = self.judged | (self.absolute_error <= self.scene.accuracy.tolerance * largest)
        return kept

    @property
    def largest(self) -> float:
        """Largest |U| that can be trusted, m: waves of a step focus to no bound."""
        return float(np.abs(self.displacement[self.trusted]).max(initial=0.0))

    @property
    def relative_error(self) -> float:
        """Largest error of the values that are judged, of the largest displacement; 0 where nothing moves."""
        error = float(self.absolute_error[self.judged].max())
        if not error:
            return 0.0
        return error / self.largest if self.largest else inf

    @property
    def mode_error(self) -> float:
        """Largest relative error of the roots."""
        return float((self.motions.errors / np.abs(self.motions.roots)).max(initial=0.0))

    @property
    def reasons(self) -> tuple[str, ...]:
        """Why the solution does not keep what was asked; empty if it does."""
        tolerance = self.scene.accuracy.tolerance
        reasons = []
        if self.relative_error > tolerance:
            reasons.append(
                f"the displacement has an estimated error of {self.relative_error:.1e} of the largest one, above the "
                f"tolerance {tolerance:g}; {kept_tolerance(self.relative_error)}"
            )
        if self.mode_error > tolerance:
            reasons.append(
                f"the free motions have an estimated relative error of {self.mode_error:.1e}, above the tolerance "
                f"{tolerance:g}"
            )
        return tuple(reasons)
