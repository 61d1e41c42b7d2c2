"""Curves of responses over the frequency that miss nothing, from the reduced basis of a sweep.

Frequencies begin at those of the sweep and about each resonance of bodies and liquid together, and the intervals
between them are halved until cubic splines through the motions meet the next ones.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from scipy.interpolate import CubicSpline

from hydroelastic.fem.bodies.round_plate import LOWEST_BENT
from hydroelastic.fem.open_water.frequency import OpenResponse
from hydroelastic.fem.open_water.incident_waves import RIGHTWARD
from hydroelastic.fem.open_water.radiation import between
from hydroelastic.fem.open_water.solver import OpenSolver
from hydroelastic.fem.open_water.sweep import SHARE, Problem, Swept, sweep

# Most frequencies in the end.
_MOST = 1500
# Frequencies about a resonance ω − iγ, in γ from ω.
_ABOUT = (-4.0, -2.0, -1.0, 0.0, 1.0, 2.0, 4.0)
# Bending of round plates per elevation below which a distance of it from the spline is not compared with its own size.
_SMALL = 1e-2
# Least distance of a motion from the spline, relative to the largest motion, that counts as missed.
_LEAST_MISSED = 1e-6


@dataclass(frozen=True, kw_only=True)
class Curves:
    """Responses at many frequencies."""

    solver: OpenSolver  # by which they were found
    omegas: np.ndarray  # ascending, rad/s, shape (n,)
    responses: list[OpenResponse]  # at these
    errors: np.ndarray  # estimated relative errors, shape (n,)
    reduced: np.ndarray  # those by the reduced basis alone, shape (n,)
    incident: list[int]  # indices of the incident waves
    swept: Swept[OpenResponse]  # the last sweep, which tells the error of the basis

    def at(self, omegas: np.ndarray, tolerance: float) -> Curves:
        """Return the responses at all these frequencies and further ones (collective)."""
        union = np.union1d(self.omegas, omegas)
        places = [int(place) for place in np.searchsorted(union, self.omegas)]
        meshed, reduced = (between(union, places, own) for own in (self.errors - self.reduced, self.reduced))
        found = dict(zip(places, self.responses, strict=True))
        for place in sorted(set(range(len(union))) - set(places)):
            found[place], residual = self.solver.response_between(float(union[place]), self.incident)
            reduced[place] = self.swept.ratio * residual**2
        responses = [found[place] for place in range(len(union))]
        known = replace(self, omegas=union, responses=responses, reduced=reduced).certified(tolerance)
        return replace(known, errors=meshed + known.reduced)

    def certified(self, tolerance: float) -> Curves:
        """Return the same on a basis that is accurate at all of the frequencies, with its errors alone (collective).

        Between the frequencies of a sweep waves may change that are much shorter than the bodies.
        """
        if self.reduced.max() <= SHARE * tolerance:
            return replace(self, errors=self.reduced)
        swept = self.swept.again(self.omegas)
        return replace(self, responses=swept.solutions, errors=swept.errors, reduced=swept.errors, swept=swept)

    @property
    def order(self) -> int:
        """Azimuthal order, 0 of sections."""
        return self.solver.model.basin.tank.geometry.order

    @property
    def motions(self) -> np.ndarray:
        """Motions per elevation of the only incident wave, shape (n, body unknowns)."""
        return np.array([_motions_of(response)[0] for response in self.responses])


def certified_curves(
    solver: OpenSolver, incident: list[int], omegas: np.ndarray, problem: Problem[OpenResponse], tolerance: float
) -> Curves:
    """Return refined curves by a reduced basis that is accurate at all of their frequencies (collective)."""
    swept = sweep(problem, omegas, tolerance)
    return refined_curves(solver, incident, omegas, swept, tolerance).certified(tolerance)


def refined_curves(
    solver: OpenSolver, incident: list[int], omegas: np.ndarray, swept: Swept[OpenResponse], missed: float
) -> Curves:
    """Add frequencies to a sweep until splines meet the next ones (collective)."""
    found = {float(omega): one for omega, one in zip(omegas, swept.solutions, strict=True)}
    errors = {float(omega): float(error) for omega, error in zip(omegas, swept.errors, strict=True)}
    turns = np.array([dof.is_rotation for dof in solver.model.scale.dofs])

    def added(asked: Iterable[float]) -> None:
        for omega in asked:
            if omega not in found:
                found[omega], residual = solver.response_between(omega, incident)
                errors[omega] = swept.ratio * residual**2

    added(_about(solver.resonances_between(), np.sort(omegas)))
    intervals = list(zip(sorted(found), sorted(found)[1:], strict=False))
    while intervals and len(found) < _MOST:
        known = np.array(sorted(found))
        motions = np.array([_motions_of(found[omega]) for omega in known])
        sizes = np.abs(motions).max(axis=(0, 1))
        # Of beams few shapes matter: motions of one unit are compared with the largest of them.
        largest = np.array([sizes[turns == turn].max() for turn in turns])
        if solver.model.basin.tank.geometry.order >= LOWEST_BENT:
            # Small ones that follow from an accurate basis beside the incident wave would be refined without end.
            largest = np.maximum(largest, _SMALL)
        middles = [float(0.5 * (low + high)) for low, high in intervals]
        expected = CubicSpline(known, motions)(middles)
        added(middles)
        halves = []
        for (low, high), middle, guess in zip(intervals, middles, expected, strict=True):
            if np.any(np.abs(_motions_of(found[middle]) - guess) > max(missed, _LEAST_MISSED) * largest):
                halves += [(low, middle), (middle, high)]
        intervals = halves
    known = np.array(sorted(found))
    reduced = np.array([errors[omega] for omega in known])
    return Curves(
        solver=solver,
        omegas=known,
        responses=[found[omega] for omega in known],
        errors=reduced,
        reduced=reduced,
        incident=incident,
        swept=swept,
    )


def _motions_of(response: OpenResponse) -> np.ndarray:
    motions: np.ndarray = response.motions * response.per_elevation(RIGHTWARD)[:, None]
    return motions


def _about(resonances: np.ndarray, omegas: np.ndarray) -> Iterator[float]:
    """Frequencies about resonances that the others may not resolve."""
    for resonance in resonances:
        width = abs(resonance.imag)
        place = int(np.searchsorted(omegas, resonance.real))
        if 0 < place < len(omegas) and 0.0 < width < omegas[place] - omegas[place - 1]:
            near = [float(resonance.real + factor * width) for factor in _ABOUT]
            yield from (omega for omega in near if omegas[0] < omega < omegas[-1])
