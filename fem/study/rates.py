"""Observed rates of convergence, fitted, with the error of the fit and the rate of theory."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby
from math import exp, inf, log

import numpy as np

from hydroelastic.fem.study.row import Family, StudyRow
from hydroelastic.fem.study.singular_points import sharpest_of, symmetries_apart
from hydroelastic.fem.study.theory import expected_order, expected_remainders, gain_along_a_ray
from hydroelastic.meshes.grading import Grading
from hydroelastic.physics.symmetry import Parity
from hydroelastic.physics.tank import Tank

DIFFERENCE = 0.1
"""An order that differs from theory by more than this part of it is flagged: not yet asymptotic."""

GAIN_FACTOR = 1.4
"""A gain per degree that differs from theory by more than this factor is flagged as well."""

# Frequencies with a larger relative error are not resolved by the mesh.
_COARSE = 0.05
# Number of rows of a fit: the finest above rounding, since coarser ones are not in the asymptotic range.
_POINTS = 3


@dataclass(frozen=True, kw_only=True)
class Rate:
    """An observed order q, error ~ hᵠ, of one degree on meshes of one kind.

    Attributes:
        family: the kind of mesh.
        degree: polynomial degree of ψ.
        grading: β; 1 on uniform meshes.
        symmetry: symmetry of the modes among which the one below is chosen; ``None`` where all have the same order.
        mode: number of the mode, from 1: the lowest whose error is above rounding on the finest mesh.
        sizes: sizes of elements of the fitted meshes, in tank lengths.
        observed: fitted q.
        deviation: standard error of the fit.
        expected: q of theory.
    """

    family: Family
    degree: int
    grading: float
    symmetry: Parity | None
    mode: int
    sizes: tuple[float, ...]
    observed: float
    deviation: float
    expected: float

    @property
    def agrees(self) -> bool:
        """Whether the relative difference from theory is at most `DIFFERENCE`."""
        return abs(self.observed - self.expected) <= DIFFERENCE * self.expected


@dataclass(frozen=True, kw_only=True)
class Gain:
    """Factor by which each degree reduces the error on geometric rings.

    Attributes:
        degrees: degrees of the fit.
        symmetry: symmetry of the modes with the sharpest singular point; ``None`` where all modes have it.
        mode: number of the mode, from 1; chosen as for a rate.
        observed: fitted factor.
        deviation: standard error of its logarithm.
        expected: factor of the best polynomials of these degrees on one ring; ``None`` where ψ is smooth.
        along_a_ray: ((1 + √σ)/(1 − √σ))², their factor on sectors of zero angle.
    """

    degrees: tuple[int, ...]
    symmetry: Parity | None
    mode: int
    observed: float
    deviation: float
    expected: float | None
    along_a_ray: float

    @property
    def agrees(self) -> bool:
        """Whether it differs from theory, if there is one, by at most a factor `GAIN_FACTOR`."""
        return self.expected is None or abs(log(self.observed / self.expected)) <= log(GAIN_FACTOR)


def fitted_rates(tank: Tank, rows: Sequence[StudyRow], parities: Sequence[Parity | None]) -> tuple[Rate, ...]:
    """Fit the order of every degree on uniform and algebraic meshes that has three meshes above rounding.

    Where symmetric and antisymmetric modes have different singularities, each symmetry has its own order.
    """
    series = [row for row in rows if row.family in ("uniform", "algebraic")]
    symmetries = symmetries_apart(tank) or (None,)
    rates = []
    for (family, degree), group in groupby(series, key=lambda row: (row.family, row.degree)):
        meshes = list(group)
        for symmetry in symmetries:
            used = _asymptotic(meshes, _of(symmetry, parities, meshes))
            if used is not None:
                rates.append(_rate(tank, family, degree, symmetry, *used))
    return tuple(rates)


def _rate(tank: Tank, family: Family, degree: int, symmetry: Parity | None, mode: int, meshes: list[StudyRow]) -> Rate:
    sizes = [row.element_size for row in meshes]
    slope, deviation = fitted_slope(np.log(sizes), np.log([abs(row.errors[mode]) for row in meshes]))
    grading = meshes[-1].grading or 1.0
    return Rate(
        family=family,
        degree=degree,
        grading=grading,
        symmetry=symmetry,
        mode=mode + 1,
        sizes=tuple(sizes),
        observed=slope,
        deviation=deviation,
        expected=expected_order(tank, degree, grading, symmetry),
    )


def fitted_gain(tank: Tank, rows: Sequence[StudyRow], parities: Sequence[Parity | None]) -> Gain | None:
    """Fit the gain per degree on geometric rings; ``None`` with fewer than three degrees above rounding."""
    symmetry = min(symmetries_apart(tank), key=lambda parity: sharpest_of(tank, parity) or inf, default=None)
    series = [row for row in rows if row.family == "geometric"]
    used = _asymptotic(series, _of(symmetry, parities, series))
    if used is None:
        return None
    mode, fitted = used
    degrees = [row.degree for row in fitted]
    x = np.array(degrees, dtype=float)
    slope, deviation = fitted_slope(x, np.log([abs(row.errors[mode]) for row in fitted]))
    left = expected_remainders(tank, degrees, symmetry)
    return Gain(
        degrees=tuple(degrees),
        symmetry=symmetry,
        mode=mode + 1,
        observed=exp(-slope),
        deviation=deviation,
        expected=None if left is None else exp(-fitted_slope(x, np.log(left))[0]),
        along_a_ray=gain_along_a_ray(Grading.ring_ratio),
    )


def _is_used(row: StudyRow, mode: int) -> bool:
    return row.floor < abs(row.errors[mode]) < _COARSE


def _of(symmetry: Parity | None, parities: Sequence[Parity | None], series: list[StudyRow]) -> list[int]:
    """Indices of the modes of one symmetry, or of all modes, that are in every row."""
    shared = min((len(row.errors) for row in series), default=0)
    return [mode for mode in range(shared) if symmetry is None or parities[mode] == symmetry]


def _asymptotic(series: list[StudyRow], modes: list[int]) -> tuple[int, list[StudyRow]] | None:
    """The lowest of the modes whose error is above rounding on the finest meshes, and the last rows above rounding."""
    best: tuple[int, int, list[StudyRow]] | None = None
    for mode in modes:
        places = [place for place, row in enumerate(series) if _is_used(row, mode)][-_POINTS:]
        is_unbroken = len(places) == _POINTS and places[-1] - places[0] == _POINTS - 1
        if is_unbroken and (best is None or places[-1] > best[0]):
            best = places[-1], mode, [series[place] for place in places]
    return None if best is None else best[1:]


def fitted_slope(x: np.ndarray, y: np.ndarray) -> tuple[float, float]:
    """Return the slope of a least-squares line through three points or more, shape (points,), and its standard
    error."""
    slope, start = np.polyfit(x, y, 1)
    misfit = y - start - slope * x
    deviation = np.sqrt(misfit @ misfit / (len(x) - 2) / np.square(x - x.mean()).sum())
    return float(slope), float(deviation)
