"""Thresholds of divergence and flutter of a thread by the factor of its stream.

A parameter is swept, the speed of the stream say. Divergence is where K becomes singular: a real κ of K y = κ M y
changes its sign, whatever the damping. Flutter begins where an oscillating root crosses Im axis, or where two roots on
that axis, or on the real one, meet and leave it: there (λ₁ − λ₂)² passes through zero with a finite slope, though λ
goes like a square root.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from hydroelastic.fem.solver_error import EigenSolverError
from hydroelastic.fem.thread.hyperbolicity import IllPosedError
from hydroelastic.fem.thread.spectrum import EquilibriumAt, Spectrum, branches, spectrum_at

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


_At = Callable[[float], Spectrum]


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
