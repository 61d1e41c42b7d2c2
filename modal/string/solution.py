"""Motion of a hanging string with its errors as plain values, and its solution by series."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import inf

import numpy as np
from numpy.typing import NDArray

from hydroelastic.modal.string.closed_form import free_roots, mode_shape
from hydroelastic.modal.string.response import string_response
from hydroelastic.physics.string import HangingString
from hydroelastic.physics.string_motions import Motion

Floats = NDArray[np.float64]

SERIES_FRONT_MARGIN = 0.02
"""`StringSolution.front_margin` of the series."""

# The series is summed to a smaller error than is asked, for it costs next to nothing.
_SHARE = 0.01
_LEAST_TOLERANCE = 1e-13
_ROUNDINGS = 4.0


@dataclass(frozen=True, kw_only=True)
class FreeMotions:
    """Free motions e^{pt} of a string."""

    roots: NDArray[np.complex128]  # p, 1/s, of conjugate pairs the one above the real axis, shape (motions,)
    errors: Floats  # estimated absolute errors of the roots, 1/s, shape (motions,)
    shapes: Floats  # at positions along the string, largest real value 1, shape (motions, positions)

    @property
    def frequencies(self) -> Floats:
        """|p|, 1/s, which is Ω where a mode of a uniformly damped string oscillates."""
        return np.abs(self.roots)

    @property
    def relative_errors(self) -> Floats:
        """Estimated errors of the roots over |p|."""
        return self.errors / np.abs(self.roots)


@dataclass(frozen=True, kw_only=True)
class StringSolution:
    """Motion of a hanging string whose upper end is moved, by series or as a field."""

    string: HangingString
    positions: Floats  # heights above the free end at rest, m, shape (positions,)
    times: Floats  # s, shape (times,)
    displacement: Floats  # U, m, shape (positions, times)
    absolute_error: Floats  # estimated error of each displacement, m, of the same shape
    free_motions: FreeMotions  # by ascending magnitude of their roots, with shapes at the positions
    tolerance: float  # asked, relative to the largest displacement, and to each frequency
    # part of R from a wave front within which displacements are not judged by the tolerance: a jump has no value, and a
    # series or a field solution only a blurred one
    front_margin: float
    size: dict[str, int]  # terms of a series; cells, degree, dofs and steps of a field solution

    @cached_property
    def beside_fronts(self) -> NDArray[np.bool_]:
        """Which displacements lie within the margin of a wave front, shape (positions, times)."""
        return np.asarray(self.string.front_distance(self.positions, self.times) < self.front_margin)

    @cached_property
    def judged(self) -> NDArray[np.bool_]:
        """Which displacements the tolerance is asked of: those away from fronts, or all if there are none."""
        away = ~self.beside_fronts
        return away if away.any() else np.ones_like(away)

    @cached_property
    def trusted(self) -> NDArray[np.bool_]:
        """Displacements that are judged, and those beside a front that keep the tolerance all the same."""
        largest = np.abs(self.displacement[self.judged]).max(initial=0.0)
        return np.asarray(self.judged | (self.absolute_error <= self.tolerance * largest))

    @property
    def largest(self) -> float:
        """Largest |U| that can be trusted, m: waves of a step focus to no bound."""
        return float(np.abs(self.displacement[self.trusted]).max(initial=0.0))

    @property
    def relative_error(self) -> float:
        """Largest error of the displacements that are judged, over the largest displacement; 0 where nothing moves."""
        error = float(self.absolute_error[self.judged].max())
        if not error:
            return 0.0
        return error / self.largest if self.largest else inf

    @property
    def frequency_error(self) -> float:
        """Largest relative error of the roots of the free motions."""
        return float(self.free_motions.relative_errors.max(initial=0.0))

    @property
    def converged(self) -> bool:
        """Whether both errors are estimated below the tolerance."""
        return max(self.relative_error, self.frequency_error) <= self.tolerance


def series_solution(
    string: HangingString, motion: Motion, positions: Floats, times: Floats, *, tolerance: float, modes: int
) -> StringSolution:
    """Sum the series of a uniform string without a tip mass.

    Args:
        positions: heights x above the free end, m, shape (positions,).
        times: t, s, shape (times,).
        tolerance: asked error of the displacement, relative to the largest one.
        modes: number of free motions.
    """
    aim = max(_SHARE * tolerance, _LEAST_TOLERANCE)
    response = string_response(string, motion, positions, times, tolerance=aim)
    free_motions = series_free_motions(string, modes, positions)
    return StringSolution(
        string=string,
        positions=positions,
        times=times,
        displacement=response.values,
        absolute_error=response.errors,
        free_motions=free_motions,
        tolerance=tolerance,
        front_margin=SERIES_FRONT_MARGIN,
        size={"terms": response.terms},
    )


def series_free_motions(string: HangingString, count: int, positions: Floats) -> FreeMotions:
    """Return the free motions of smallest |p|: one for each mode that oscillates, two for an aperiodic one."""
    pairs = free_roots(string, count)
    aperiodic = pairs[:, 1].imag == 0.0
    numbers = np.concatenate([np.arange(1, count + 1), np.flatnonzero(aperiodic) + 1])
    roots = np.concatenate([pairs[:, 0], pairs[aperiodic, 1]])
    order = np.argsort(np.abs(roots), kind="stable")[:count]
    return FreeMotions(
        roots=roots[order],
        errors=_ROUNDINGS * np.finfo(float).eps * np.abs(roots[order]),
        shapes=np.array([mode_shape(string, int(number), positions) for number in numbers[order]]),
    )
