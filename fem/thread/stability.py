"""Thresholds of divergence and flutter of a thread by the factor of its stream.

A parameter is swept, the speed of the stream say. Divergence is where K becomes singular: a real κ of K y = κ M y
changes its sign, whatever the damping. Flutter begins where an oscillating root crosses Im axis, or where two roots on
that axis, or on the real one, meet and leave it: there (λ₁ − λ₂)² passes through zero with a finite slope, though λ
goes like a square root.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import Literal, TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq, linear_sum_assignment

from hydroelastic.fem.solver_error import EigenSolverError
from hydroelastic.fem.thread.eigenpairs import eigenpairs, stiffness_eigenvalues
from hydroelastic.fem.thread.equilibrium import Equilibrium
from hydroelastic.fem.thread.hyperbolicity import IllPosedError, require_real_wave_speeds
from hydroelastic.fem.thread.operators import ThreadOperators, thread_operators

Kind = Literal["divergence", "flutter"]

# Part of a step of the sweep to which it is halved before a root is sought in it.
_HALVINGS = 4
# Of the value of the parameter, for the search of a root.
_TOLERANCE = 1e-11
# By how many of its widths the bracket may be moved to hold the threshold of the coarser mesh.
_WIDENINGS = 3
# A function that changes its sign at a threshold is zero there, relative to its values at the ends of the bracket.
_JUMP = 1e-3
# Of the magnitude of a root: roots that lie this symmetrically about the imaginary axis are those of a system without
# damping.
_MIRRORED = 1e-5
# Times the distance of two roots at the ends of the bracket from where they meet: others are farther.
_REACH = 6.0

_Number = TypeVar("_Number", np.float64, np.complex128)

EquilibriumAt = Callable[[float], Equilibrium]

# Of the smallest frequency: a real part below it may be rounding next to a double root.
_GROWTH = 1e-6
# Of the magnitude: roots that are closer are one, of both directions across a straight thread.
_SAME = 1e-5
# Of the distances between expected and found roots: a preference that decides between equal ones.
_PREFERENCE = 1e-6


@dataclass(frozen=True, kw_only=True)
class Threshold:
    """A threshold of stability."""

    value: float  # of the parameter
    error: float  # estimate of its absolute error; infinite if the coarser mesh shows no threshold nearby
    kind: Kind  # "divergence", K is singular, or "flutter", an oscillating motion begins or ceases to grow
    frequency: float  # Im λ there, rad/s
    growing: tuple[int, int]  # number of growing motions, of those computed, below and above it


@dataclass(frozen=True, kw_only=True)
class Stability:
    """A sweep."""

    values: NDArray[np.float64]  # of the parameter, shape (values,), without those at which the problem is ill-posed
    # λ followed by continuity, 1/s, with conjugates; NaN where one is no longer among the slowest; shape (values,
    # roots)
    roots: NDArray[np.complex128]
    growing: NDArray[np.int64]  # number of growing motions, of those computed, shape (values,)
    thresholds: tuple[Threshold, ...]  # in ascending order
    ill_posed: tuple[float, str] | None  # the first value left out and why, or ``None``


def stability(
    equilibrium_at: EquilibriumAt, coarser_at: EquilibriumAt, values: NDArray[np.float64], *, count: int = 4
) -> Stability:
    """Find the thresholds of stability between values of a parameter.

    A motion that grows only between two neighbouring values is not found.
    """
    values = np.asarray(values, dtype=np.float64)
    if len(values) < 2 or np.any(np.diff(values) <= 0.0):
        raise ValueError(f"values are {values}: they must be two or more, ascending")

    def at(value: float) -> Spectrum:
        return spectrum_at(equilibrium_at, value, count)

    def coarse(value: float) -> Spectrum:
        return spectrum_at(coarser_at, value, count)

    spectra, ill_posed = _sweep(at, values)
    thresholds: list[Threshold] = []
    for low, high in pairwise(spectra):
        thresholds += _between(at, coarse, low, high)
    return Stability(
        values=np.array([spectrum.value for spectrum in spectra]),
        roots=branches(spectra),
        growing=np.array([len(spectrum.growing) for spectrum in spectra], dtype=np.int64),
        thresholds=_different(thresholds),
        ill_posed=ill_posed,
    )


_At: TypeAlias = "Callable[[float], Spectrum]"


def _sweep(at: _At, values: NDArray[np.float64]) -> tuple[list[Spectrum], tuple[float, str] | None]:
    spectra: list[Spectrum] = []
    for value in values:
        try:
            spectra.append(at(float(value)))
        except IllPosedError as problem:
            if len(spectra) < 2:
                raise
            return spectra, (float(value), str(problem))
    return spectra, None


def _between(at: _At, coarse: _At, low: Spectrum, high: Spectrum) -> list[Threshold]:
    found = []
    for kind in _CHANGES:
        for start, end in _brackets(at, low, high, _CHANGES[kind], _HALVINGS):
            change = _divergence(start, end) if kind == "divergence" else _flutter(start, end)
            threshold = _threshold(at, coarse, start, end, kind, change)
            if threshold is not None:
                found.append(threshold)
    return found


_CHANGES: dict[Kind, Callable[[Spectrum], int]] = {
    "divergence": lambda spectrum: spectrum.negative_stiffness_count,
    "flutter": lambda spectrum: len(spectrum.growing_pairs),
}


def _different(thresholds: list[Threshold]) -> tuple[Threshold, ...]:
    """Return thresholds in ascending order, those within their errors of each other as one."""
    different: list[Threshold] = []
    for threshold in sorted(thresholds, key=lambda threshold: threshold.value):
        last = different[-1] if different else None
        if last and last.kind == threshold.kind and threshold.value - last.value <= last.error + threshold.error:
            different[-1] = replace(last, growing=(last.growing[0], threshold.growing[1]))
        else:
            different.append(threshold)
    return tuple(different)


def _brackets(
    at: _At, low: Spectrum, high: Spectrum, number: Callable[[Spectrum], int], halvings: int
) -> list[tuple[Spectrum, Spectrum]]:
    if number(low) == number(high):
        return []
    if halvings == 0:
        return [(low, high)]
    middle = at(0.5 * (low.value + high.value))
    return _brackets(at, low, middle, number, halvings - 1) + _brackets(at, middle, high, number, halvings - 1)


def _threshold(at: _At, coarse: _At, low: Spectrum, high: Spectrum, kind: Kind, change: _Change) -> Threshold | None:
    """The zero of a function that changes its sign; ``None`` if it jumps because a root is no longer among those
    computed."""
    ends = change(low), change(high)
    if not ends[0] * ends[1] < 0.0:
        return None
    value = _zero(lambda x: change(at(x)), low.value, high.value)
    here = at(value)
    if abs(change(here)) > _JUMP * max(map(abs, ends)):
        return None
    rough = _coarse_zero(lambda x: change(coarse(x)), low.value, high.value)
    return Threshold(
        value=value,
        error=abs(value - rough) + 2.0 * _TOLERANCE * abs(value),
        kind=kind,
        frequency=change.frequency(here),
        growing=(len(low.growing), len(high.growing)),
    )


def _zero(function: Callable[[float], float], low: float, high: float) -> float:
    try:
        return float(brentq(function, low, high, xtol=_TOLERANCE * max(abs(low), abs(high)), rtol=_TOLERANCE))
    except IllPosedError:
        raise
    except (ValueError, RuntimeError) as error:
        raise EigenSolverError(f"the threshold between the factors {low:g} and {high:g} was not found") from error


def _coarse_zero(function: Callable[[float], float], low: float, high: float) -> float:
    """The zero on the coarser mesh, next to the bracket of the finer one; infinite if there is none."""
    width = high - low
    for steps in range(_WIDENINGS):
        reach = (2.0**steps - 1.0) * width
        ends = low - reach, high + reach
        try:
            if function(ends[0]) * function(ends[1]) < 0.0:
                return _zero(function, *ends)
        except IllPosedError:
            break
    return np.inf


class _Change:
    """A function of the spectrum that changes its sign at a threshold."""

    def __init__(self, function: Callable[[Spectrum], float], place: complex) -> None:
        self._function, self._place = function, complex(place)

    def __call__(self, spectrum: Spectrum) -> float:
        return self._function(spectrum)

    def frequency(self, spectrum: Spectrum) -> float:
        """Im λ at the place; exactly zero on the real axis, where rounding next to a double root would not be."""
        return 0.0 if self._place.imag == 0.0 else abs(float(spectrum.nearest(self._place, 1)[0].imag))


def _divergence(low: Spectrum, high: Spectrum) -> _Change:
    """The κ that becomes negative, by its place in ascending order."""
    index = min(low.negative_stiffness_count, high.negative_stiffness_count)

    def kappa(spectrum: Spectrum) -> float:
        return float(spectrum.stiffnesses[index]) if index < len(spectrum.stiffnesses) else 0.0

    return _Change(kappa, 0.0)


def _flutter(low: Spectrum, high: Spectrum) -> _Change:
    fewer, more = (low, high) if len(low.growing_pairs) < len(high.growing_pairs) else (high, low)
    root = complex(max(more.growing_pairs, key=lambda pair: min(np.abs(fewer.growing_pairs - pair), default=np.inf)))
    mirrored = float(np.min(np.abs(more.with_conjugates + np.conj(root)))) < _MIRRORED * abs(root)
    if mirrored and abs(root.real) < abs(root.imag):
        return _meeting(1j * root.imag, fewer, more)
    if abs(root.imag) < abs(root.real):
        return _meeting(complex(root.real), fewer, more)
    start, end = (spectrum.nearest(root, 1)[0] for spectrum in (low, high))

    def real_part(spectrum: Spectrum) -> float:
        part = (spectrum.value - low.value) / (high.value - low.value)
        return float(spectrum.nearest(start + part * (end - start), 1)[0].real)

    return _Change(real_part, root)


def _meeting(place: complex, fewer: Spectrum, more: Spectrum) -> _Change:
    """Re (λ₁ − λ₂)² of the two roots at a place; zero where they are equal up to rounding."""
    farthest = max(float(np.max(np.abs(spectrum.nearest(place, 2) - place))) for spectrum in (fewer, more))
    reach = _REACH * farthest

    def square(spectrum: Spectrum) -> float:
        roots = spectrum.nearest(place, 2)
        if len(roots) < 2 or abs(roots[1] - place) > reach:
            return 0.0
        return float(((roots[0] - roots[1]) ** 2).real)

    return _Change(square, place)


class Spectrum:
    """The slowest motions at one value of the parameter, solved for on first access.

    Args:
        count: how many oscillating motions.

    Attributes:
        value: as given.
    """

    def __init__(self, value: float, operators: ThreadOperators, count: int) -> None:
        self.value = value
        self._operators, self._count = operators, count

    @cached_property
    def roots(self) -> NDArray[np.complex128]:
        """λ, 1/s, Im λ ≥ 0, by ascending magnitude (collective)."""
        pairs = eigenpairs(self._operators, self._count)
        roots = np.array([pair.root for pair in pairs], dtype=np.complex128) / self._operators.time_unit
        return self._same_everywhere(roots)

    @cached_property
    def stiffnesses(self) -> NDArray[np.float64]:
        """Real κ of K y = κ M y nearest to zero, 1/s², ascending (collective)."""
        return self._same_everywhere(stiffness_eigenvalues(self._operators, 2 * self._count))

    def _same_everywhere(self, values: NDArray[_Number]) -> NDArray[_Number]:
        """The values of rank 0, exactly: the search for a threshold must branch in the same way on all processes."""
        shared: NDArray[_Number] = self._operators.comm.bcast(values)
        return shared

    @property
    def with_conjugates(self) -> NDArray[np.complex128]:
        """The roots with their conjugates."""
        return np.concatenate([self.roots, np.conj(self.roots[self.roots.imag != 0.0])])

    @property
    def growing(self) -> NDArray[np.complex128]:
        """The roots, Im λ ≥ 0, of motions that grow."""
        threshold = _GROWTH * np.min(np.abs(self.roots[self.roots.imag > 0.0]))
        return self.roots[self.roots.real > threshold]

    @property
    def growing_pairs(self) -> NDArray[np.complex128]:
        """The growing roots that oscillate."""
        growing = self.growing
        return growing[growing.imag > _SAME * np.abs(growing)]

    @property
    def negative_stiffness_count(self) -> int:
        """Number of negative κ."""
        return int(np.count_nonzero(self.stiffnesses < 0.0))

    def nearest(self, place: complex, count: int) -> NDArray[np.complex128]:
        """Up to `count` different roots nearest to a place, conjugates among them."""
        roots = self.with_conjugates[np.argsort(np.abs(self.with_conjugates - place), kind="stable")]
        different: list[complex] = []
        for root in roots:
            if all(abs(root - other) > _SAME * abs(root) for other in different):
                different.append(complex(root))
            if len(different) == count:
                break
        return np.array(different, dtype=np.complex128)


def spectrum_at(equilibrium_at: EquilibriumAt, value: float, count: int) -> Spectrum:
    """Solve at one value of the parameter."""
    equilibrium = equilibrium_at(value)
    require_real_wave_speeds(equilibrium)
    return Spectrum(value, thread_operators(equilibrium), count)


def branches(spectra: list[Spectrum]) -> NDArray[np.complex128]:
    """Follow the roots of the first spectrum through all others.

    Each spectrum is matched with the extrapolation of the last two by the least sum of distances. A pair that meets the
    real axis continues as two real roots, which are equally far from both: that of positive imaginary part continues as
    the larger one, and the larger one as that of positive imaginary part.
    """
    first = spectra[0].with_conjugates
    followed = np.full((len(spectra), len(first)), np.nan, dtype=np.complex128)
    followed[0] = first
    for row in range(1, len(spectra)):
        expected = followed[row - 1]
        if row > 1:
            before, last, here = (spectra[row - step].value for step in (2, 1, 0))
            slope = (followed[row - 1] - followed[row - 2]) / (last - before)
            expected = expected + slope * (here - last)
        alive = np.flatnonzero(~np.isnan(expected))
        roots = spectra[row].with_conjugates
        pairs = expected[alive][:, None] * roots
        distances = np.abs(expected[alive][:, None] - roots) - _PREFERENCE * pairs.imag / np.abs(roots).max()
        rows, columns = linear_sum_assignment(distances)
        followed[row, alive[rows]] = roots[columns]
    return followed
