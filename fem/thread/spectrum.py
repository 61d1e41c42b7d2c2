"""The slowest motions of a thread at one value of a parameter, and their continuation to other values."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from hydroelastic.fem.thread.eigenpairs import eigenpairs, stiffness_eigenvalues
from hydroelastic.fem.thread.equilibrium import Equilibrium
from hydroelastic.fem.thread.hyperbolicity import require_real_wave_speeds
from hydroelastic.fem.thread.operators import ThreadOperators, thread_operators

_Number = TypeVar("_Number", np.float64, np.complex128)

EquilibriumAt = Callable[[float], Equilibrium]

# Of the smallest frequency: a real part below it may be rounding next to a double root.
_GROWTH = 1e-6
# Of the magnitude: roots that are closer are one, of both directions across a straight thread.
_SAME = 1e-5
# Of the distances between expected and found roots: a preference that decides between equal ones.
_PREFERENCE = 1e-6


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
