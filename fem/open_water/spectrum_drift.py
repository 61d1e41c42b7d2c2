"""The mean of the drift force in irregular waves, and of the power that linear damping from outside takes."""

from __future__ import annotations

from collections.abc import Callable
from itertools import count
from math import nan

import numpy as np
from scipy.linalg import block_diag

from hydroelastic.fem.open_water.basin import extent_of_bodies
from hydroelastic.fem.open_water.curves import Curves
from hydroelastic.fem.open_water.incident_waves import direction_of, drift_of_orders, drift_widths
from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.open_water.requests import SpectrumRequest
from hydroelastic.physics.irregular_waves import moments, statistics

# Frequencies over the last one, above which the drift force tells how it may change beyond.
_LAST = 0.7
# Part of the tolerance of the mean drift force that waves of the orders left out may contribute, and the least such
# contribution.
_LEFT_OUT, _LEAST = 0.25, 1e-5


def mean_drift(
    problem: OpenWaterProblem,
    request: SpectrumRequest,
    curves: list[Curves],
    motions: np.ndarray,
    further: Callable[[int], Curves],
) -> tuple[float, float]:
    """Mean of the drift force along x, 2 ∫ (F/A²) S dω, and its error, N/m or of solids N (collective).

    Args:
        problem: the open water.
        request: the request.
        curves: the transfer functions of the orders that move.
        motions: per elevation, with the damping in place of drag, shape (n, unknowns).
        further: gives the waves of orders that do not move.
    """
    omegas, towards = curves[0].omegas, direction_of(request.waves_from)
    starts = np.cumsum([0, *(len(one.solver.model.mass) for one in curves)])
    # Motions per c of the incident wave.
    parts = [
        [
            row[None] / one.per_elevation(towards)[0]
            for row, one in zip(motions[:, first:last], own.responses, strict=True)
        ]
        for own, first, last in zip(curves, starts, starts[1:], strict=False)
    ]
    if problem.tank.geometry.is_revolved:
        if len(curves[0].responses[0].incidence.planes) > 1:
            return nan, nan
        known = {
            own.order: np.array([one.partial_waves(part)[0] for one, part in zip(own.responses, each, strict=True)])
            for own, each in zip(curves, parts, strict=True)
        }
        forces, errors = _drift_of_orders(
            problem,
            request,
            omegas,
            known,
            {own.order: own.errors for own in curves},
            further,
        )
    else:
        units = curves[0].solver.model.basin.units
        forces, errors = (
            units.density
            * units.gravity
            * np.array(
                [
                    np.hstack([one.drift_force(part), one.drift_error(float(error), part)])
                    * abs(one.per_elevation(towards)[0]) ** 2
                    for one, part, error in zip(curves[0].responses, parts[0], curves[0].errors, strict=True)
                ]
            ).T
        )
    # F/A² is the square of a transfer function: it is along the waves, for no more waves pass than come.
    roots = np.sqrt(np.abs(forces))[:, None]
    deviations = np.sqrt(roots**2 + errors[:, None]) - roots
    told = statistics(request.spectrum, omegas, roots, deviations, request.duration)
    # Short waves are reflected: the force beyond is as at the end, and changes no more than up to there.
    tail, last = 2.0 * request.spectrum.tail(omegas[-1], 0), np.abs(forces[omegas >= _LAST * omegas[-1]])
    within = 2.0 * float(told.moments[0, 0])
    # Of an amplitude, the relative error is half of that of its square.
    error = 2.0 * float((told.sampling_error + told.transfer_error)[0]) * within + tail * float(np.ptp(last))
    return towards * (within + tail * float(last[-1])), error


def _drift_of_orders(
    problem: OpenWaterProblem,
    request: SpectrumRequest,
    omegas: np.ndarray,
    known: dict[int, np.ndarray],
    certain: dict[int, np.ndarray],
    further: Callable[[int], Curves],
) -> tuple[np.ndarray, np.ndarray]:
    """Drift force along the waves per square of their amplitude about an axis, N/m², and its error, each of shape (n,)
    (collective).

    Bodies of radius a scatter waves in orders up to ka. The force of each pair of orders is less than that of the last
    one: orders are added until all those left out contribute less than a part of the tolerance, which is told.
    """
    wavenumbers, widths = drift_widths(problem.tank, omegas)
    scattered = wavenumbers * extent_of_bodies(problem.tank)[1]
    least = max(_LEFT_OUT * problem.tolerance, _LEAST)
    waves: list[np.ndarray] = []
    errors: list[np.ndarray] = []

    def mean(forces: np.ndarray) -> float:
        return float(moments(request.spectrum, omegas, np.sqrt(np.abs(forces))[:, None], (0,))[0, 0])

    for order in count():
        own = None if order in known else further(order)
        waves.append(
            known[order][:, 0] if own is None else np.array([one.partial_waves()[0, 0] for one in own.responses])
        )
        errors.append(certain[order] if own is None else own.errors)
        if order < max(1, *known):
            continue
        found, uncertain = np.array(waves).T, np.array(errors).T
        forces, off = drift_of_orders(widths, found, uncertain, np.zeros_like(uncertain))
        left_out = np.abs(forces[:, -1]) * np.maximum(scattered - order, 1.0)
        if mean(left_out) <= least * mean(forces.sum(axis=1)):
            return forces.sum(axis=1), off.sum(axis=1) + left_out
    raise AssertionError


def mean_power(request: SpectrumRequest, curves: list[Curves], motions: np.ndarray) -> float:
    """Mean power that the linear damping of attachments takes, ∫ ω² aᴴBa S dω, W/m or of solids W.

    Args:
        request: the request.
        curves: the transfer functions of the orders that move.
        motions: per elevation, with the damping in place of drag, shape (n, unknowns).
    """
    models, omegas = [one.solver.model for one in curves], curves[0].omegas
    damping = block_diag(*(model.outside.damping for model in models))
    units = models[0].basin.units
    values, vectors = np.linalg.eigh(damping)
    speeds = omegas[:, None] * (motions @ vectors)
    taken = float(moments(request.spectrum, omegas, speeds, (0,))[0] @ np.maximum(values, 0.0))
    return units.density * units.gravity * units.volume / units.length / units.frequency * taken
