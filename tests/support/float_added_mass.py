"""Added mass of floats at the highest frequencies, by harmonic trial functions fitted to the boundary.

There neither interface nor surface restores: the pressure ρψ is the same on both sides of the interface, and zero on
a free surface. Potentials are fitted by least squares (Gopal & Trefethen 2019); the added mass follows from

    a = Σ ρ (2∮ ψ ζ − ∮ ψ ∂ψ/∂n) + what makes it stationary where ψ is given,

so that its error is that of the fit squared. Nothing of the package is imported.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from float_reference import hull_displacement
from float_tanks import Fineness, FloatTank, Liquid, Side, discretized
from harmonic_trial import Boundary


@dataclass(frozen=True, kw_only=True)
class AddedMass:
    """The matrix of all motions, floats from left to right, kg/m and so on, and the largest residual of the fit."""

    matrix: np.ndarray
    residual: float


@dataclass(frozen=True, kw_only=True)
class _Traces:
    """ψ and ∂ψ/∂n of all trial functions at the nodes of one side of one liquid."""

    values: np.ndarray
    slopes: np.ndarray


def high_frequency_added_mass(tank: FloatTank, fineness: Fineness | None = None) -> AddedMass:
    """The added mass of floats without beams.

    Args:
        tank: the tank.
        fineness: how finely it is resolved.

    Returns:
        The matrix.
    """
    _, liquids = discretized(tank, replace(fineness or Fineness(), halves=True))
    motions = [(number, motion) for number, (_, moving) in enumerate(tank.sections) for motion in moving]
    traces = _all_traces(liquids)
    rows, right = [], []
    scale = min(tank.depths)
    for liquid, parts in zip(liquids, traces, strict=True):
        for side, trace in zip(liquid.sides, parts, strict=True):
            weight = np.sqrt(side.boundary.weights)[:, None]
            load = _load(tank, side, motions)
            if side.kind != "level":
                rows.append(weight * scale * trace.slopes)
                right.append(weight * scale * load)
            elif len(tank.touching(tank.levels[side.number])) == 1:
                rows.append(weight * trace.values)
                right.append(0.0 * weight * load)
    if "interface" in tank.levels:
        below, above = (
            next(trace for side, trace in zip(liquid.sides, parts, strict=True) if side.kind == "level")
            for liquid, parts in zip(liquids, traces, strict=True)
        )
        boundary = next(side.boundary for side in liquids[0].sides if side.kind == "level")
        weight = np.sqrt(boundary.weights)[:, None]
        lower, upper = (liquid.density / liquids[0].density for liquid in liquids)
        rows += [weight * (lower * below.values - upper * above.values), weight * scale * (below.slopes + above.slopes)]
        right += [np.zeros((len(weight), len(motions)))] * 2
    matrix, target = np.vstack(rows), np.vstack(right)
    norms = np.linalg.norm(matrix, axis=0)
    solution = np.linalg.lstsq(matrix / norms, target, rcond=1e-14)[0] / norms[:, None]
    residual = np.linalg.norm(matrix @ solution - target) / np.linalg.norm(target)
    return AddedMass(matrix=_energy(tank, liquids, traces, solution, motions), residual=float(residual))


def _all_traces(liquids: list[Liquid]) -> list[list[_Traces]]:
    """Of the trial functions of all liquids, and a constant each, side by side."""
    sizes, found = [], []
    for liquid in liquids:
        boundary = Boundary.joined([side.boundary for side in liquid.sides])
        values, slopes = liquid.trial.values(boundary)
        values, slopes = (
            np.hstack([np.full((len(part), 1), one), part]) for part, one in ((values, 1.0), (slopes, 0.0))
        )
        stops = np.cumsum([len(side.boundary.points) for side in liquid.sides])[:-1]
        found.append(
            [_Traces(values=v, slopes=s) for v, s in zip(np.split(values, stops), np.split(slopes, stops), strict=True)]
        )
        sizes.append(values.shape[1])
    before = np.concatenate([[0], np.cumsum(sizes)])

    def placed(part: np.ndarray, number: int) -> np.ndarray:
        return np.pad(part, ((0, 0), (before[number], before[-1] - before[number + 1])))

    return [
        [_Traces(values=placed(part.values, number), slopes=placed(part.slopes, number)) for part in parts]
        for number, parts in enumerate(found)
    ]


def _load(tank: FloatTank, side: Side, motions: list[tuple[int, str]]) -> np.ndarray:
    load = np.zeros((len(side.boundary.points), len(motions)))
    for column, (number, motion) in enumerate(motions):
        if side.kind == "hull" and number == side.number:
            load[:, column] = hull_displacement(tank, side, motion)
    return load


def _energy(
    tank: FloatTank,
    liquids: list[Liquid],
    traces: list[list[_Traces]],
    solution: np.ndarray,
    motions: list[tuple[int, str]],
) -> np.ndarray:
    """Σ ρ (∮ψζ + ∮ζψ − ∮ψ ∂ψ/∂n) + 2∮ψ ∂ψ/∂n where ψ is 0, + 2∮(Σ±ρψ) ∂ψ/∂n, the mean of both, at the interface."""
    total = np.zeros((len(motions), len(motions)))
    jumps, means = [], []
    for liquid, parts in zip(liquids, traces, strict=True):
        for side, trace in zip(liquid.sides, parts, strict=True):
            values, slopes = trace.values @ solution, trace.slopes @ solution
            weighed = liquid.density * side.boundary.weights[:, None] * values
            total += weighed.T @ (2.0 * _load(tank, side, motions) - slopes)
            if side.kind == "level":
                if len(tank.touching(tank.levels[side.number])) == 1:
                    total += 2.0 * weighed.T @ slopes
                else:
                    jumps.append(side.sign * weighed)
                    means.append(side.sign * slopes / 2.0)
    if jumps:
        total += 2.0 * sum(jumps).T @ sum(means)
    return (total + total.T) / 2.0
