"""The parts of a problem as one: symmetric and antisymmetric halves, azimuthal orders, classes of symmetry.

Each part is an eigenproblem of its own. Their modes, merged in ascending order, are those of the whole.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from dataclasses import dataclass
from typing import Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.core.modes import HIDDEN, Modes, count_below, lowest_modes
from hydroelastic.fem.core.pencil import Pencil

Key = TypeVar("Key", bound=Hashable)
Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class MergedModes(Generic[Key]):
    """The lowest modes of all parts."""

    parts: Mapping[Key, Modes]  # the modes of each
    # of each mode in ascending order, the growing ones first: its part, and its number there
    origins: tuple[tuple[Key, int], ...]
    growing: int  # number of the growing ones
    complete: bool  # whether no mode lies above these

    @property
    def values(self) -> Array:
        return np.array([self.parts[key].values[number] for key, number in self.origins])

    def of_parts(self, values: Mapping[Key, Array]) -> Array:
        """What is known of the modes of each part, for each mode."""
        return np.array([values[key][number] for key, number in self.origins])

    @property
    def zero_modes(self) -> int:
        return sum(modes.zero_modes for modes in self.parts.values())

    def is_counted(self) -> bool:
        """Whether inertia confirms the number of modes below a gap between the last ones, in each part."""
        values = self.values[self.growing :]
        shift = 2.0 * float(values[-1]) if len(values) else 1.0
        if len(values) > 1:
            last = values[-4:]
            widest = int(np.argmax(last[1:] / last[:-1]))
            shift = float(np.sqrt(last[widest] * last[widest + 1]))
        return all(
            count_below(modes.pencil, shift) == np.count_nonzero(modes.values < shift)
            for modes in self.parts.values()
            if modes.pencil.size
        )


def merged_modes(pencils: Mapping[Key, Pencil], count: int) -> MergedModes[Key]:
    """Find the lowest modes of all parts: of each its share, and more where the shares are not enough (collective)."""
    share = count if len(pencils) == 1 else count // len(pencils) + 2
    shares = dict.fromkeys(pencils, share)
    parts = {key: lowest_modes(pencil, share) for key, pencil in pencils.items()}
    while True:
        limit = _rounding_limit(parts)
        reached = {
            key: limit if modes.complete else min(float(modes.values[-1]), limit) for key, modes in parts.items()
        }
        first = min(reached, key=reached.__getitem__)
        there = sum(
            int(np.count_nonzero((modes.values > 0.0) & (modes.values <= reached[first]))) for modes in parts.values()
        )
        if there >= count or reached[first] >= limit:
            break
        shares[first] += max(4, count - there)
        parts[first] = lowest_modes(pencils[first], shares[first])
    places = [(key, number) for key, modes in parts.items() for number in range(len(modes.values))]
    values = np.array([parts[key].values[number] for key, number in places])
    order = np.argsort(values, kind="stable")
    growing = int(np.count_nonzero(values < 0.0))
    seen = int(np.count_nonzero(values <= limit))
    return MergedModes(
        parts=parts,
        origins=tuple(places[place] for place in order[: min(growing + count, seen)]),
        growing=growing,
        complete=seen <= growing + count and all(modes.complete for modes in parts.values()),
    )


def _rounding_limit(parts: Mapping[Key, Modes]) -> float:
    """λ above which modes are lost in the rounding of the lowest mode of all parts."""
    lowest = [modes.values[modes.values > 0.0][:1] for modes in parts.values()]
    return float(min(np.concatenate(lowest), default=np.inf)) / HIDDEN
