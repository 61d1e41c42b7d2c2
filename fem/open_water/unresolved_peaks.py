"""Peaks of a response between the frequencies at which it was computed, which its curve does not resolve.

Bodies and liquid on the reduced basis of a sweep are a small linear pencil in ω²; its eigenvalues near the real axis
are the frequencies at which the response may change faster than the curve shows. The response there, on the same basis,
is compared with the straight line between the two neighbours on the curve.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import pairwise
from typing import TypeAlias

import numpy as np

from hydroelastic.fem.open_water.results import Complexes, Floats, ResponseTable, UnresolvedPeak

# Least difference of a peak from the line between its neighbours, relative to the largest value of the curve.
_DIFFERS = 0.1

# Name of a quantity, its magnitudes on the curve and at the peaks, and what is large for it.
_Curve: TypeAlias = tuple[str, Floats, Floats, float]


def unresolved_peaks(
    table: ResponseTable, resonances: Complexes, between: Callable[[Floats], ResponseTable]
) -> tuple[UnresolvedPeak, ...]:
    """Return the largest of the peaks between each two frequencies, by ascending frequency."""
    omegas = np.sort(table.omega)
    probed = np.array(list(_narrow(omegas, resonances)))
    if not probed.size:
        return ()
    peaks = between(probed)
    # Peaks of motions replace those of waves between the same frequencies.
    worst = _worst(probed, table.omega, _ratios(table, peaks)) | _worst(probed, table.omega, _motions(table, peaks))
    return tuple(worst[below] for below in sorted(worst))


def _worst(probed: Floats, omegas: Floats, curves: Iterator[_Curve]) -> dict[float, UnresolvedPeak]:
    """The largest peak between each two frequencies, by the lower one."""
    order = np.argsort(omegas)
    ordered = omegas[order]
    changes: dict[float, float] = {}
    worst: dict[float, UnresolvedPeak] = {}
    for quantity, shown, found, scale in curves:
        drawn = np.interp(probed, ordered, shown[order])
        for omega, value, line in zip(probed, found, drawn, strict=True):
            place = int(np.searchsorted(ordered, omega))
            below, above = float(ordered[place - 1]), float(ordered[place])
            change = abs(value - line) / max(scale, value)
            if change > changes.get(below, _DIFFERS):
                changes[below] = change
                worst[below] = UnresolvedPeak(
                    below=below,
                    above=above,
                    omega=float(omega),
                    quantity=quantity,
                    value=float(value),
                    drawn=float(line),
                )
    return worst


def _narrow(omegas: Floats, resonances: Complexes) -> Iterator[float]:
    """Frequencies of resonances that are narrower than the distance of their neighbours on the curve."""
    for below, above in pairwise(omegas):
        inside = (resonances.real > below) & (resonances.real < above) & (np.abs(resonances.imag) < above - below)
        yield from np.unique(resonances.real[inside])


def _motions(table: ResponseTable, peaks: ResponseTable) -> Iterator[_Curve]:
    turns = np.array([dof.is_rotation for dof in table.dofs], dtype=bool)
    sizes = np.abs(table.amplitudes)
    for incident, wave in enumerate(table.waves):
        for place, dof in enumerate(table.dofs):
            # Motions are compared with the largest one of the same unit.
            scale = float(sizes[:, incident, turns == turns[place]].max())
            found = np.abs(peaks.amplitudes[:, incident, place])
            yield dof + _of(table, wave), sizes[:, incident, place], found, scale


def _ratios(table: ResponseTable, peaks: ResponseTable) -> Iterator[_Curve]:
    if table.reflection is None or table.transmission is None:
        return
    assert peaks.reflection is not None
    assert peaks.transmission is not None
    for name, shown, found in (
        ("|R|", np.abs(table.reflection), np.abs(peaks.reflection)),
        ("|T|", np.abs(table.transmission), np.abs(peaks.transmission)),
    ):
        for incident, wave in enumerate(table.waves):
            for outgoing, left in enumerate(table.waves):
                label = f"{name} {left}{_of(table, wave)}" if len(table.waves) > 1 else name
                curve = shown[:, incident, outgoing]
                yield label, curve, found[:, incident, outgoing], float(curve.max())


def _of(table: ResponseTable, wave: str) -> str:
    return f" in {wave} waves" if len(table.waves) > 1 else ""
