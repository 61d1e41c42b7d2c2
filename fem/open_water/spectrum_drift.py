"""The mean of the drift force in irregular waves, and of the power that linear damping from outside takes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import count
from math import nan

import numpy as np
from scipy.linalg import block_diag

from hydroelastic.fem.open_water.basin import extent_of_bodies
from hydroelastic.fem.open_water.curves import Curves
from hydroelastic.fem.open_water.drift_errors import drift_errors
from hydroelastic.fem.open_water.drift_of_orders import drift_of_orders, drift_widths, wave_errors
from hydroelastic.fem.open_water.incident_waves import direction_of
from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.open_water.requests import SpectrumRequest
from hydroelastic.fem.open_water.spectrum_rows import estimated_about_peaks
from hydroelastic.physics.irregular_waves import moments, statistics
from hydroelastic.physics.tank import Tank
from hydroelastic.physics.wave_spectrum import WaveSpectrum

# Frequencies over the last one, above which the drift force tells how it may change beyond.
_LAST = 0.7
# Part of the tolerance of the mean drift force that waves of the orders left out may contribute, and the least such
# contribution.
_LEFT_OUT, _LEAST = 0.25, 1e-5


@dataclass(frozen=True, kw_only=True)
class MeanDrift:
    """The mean drift force along x, N/m, or of solids N; NaN about an axis in waves on two levels."""

    force: float  # its mean
    error: float  # by its values at the frequencies and by their distances
    truncation: float  # error by the waves beyond the last frequency


def mean_drift(
    problem: OpenWaterProblem,
    request: SpectrumRequest,
    curves: list[Curves],
    motions: np.ndarray,
    damping: np.ndarray,
    further: Callable[[int], Curves],
) -> MeanDrift:
    """Mean of the drift force along x, 2 ∫ (F/A²) S dω (collective)."""
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
            return MeanDrift(force=nan, error=nan, truncation=nan)
        known = {
            own.order: np.array([one.partial_waves(part)[0] for one, part in zip(own.responses, each, strict=True)])
            for own, each in zip(curves, parts, strict=True)
        }
        forces, errors = _drift_of_orders(
            problem,
            request,
            omegas,
            known,
            {own.order: own for own in curves},
            further,
        )
    else:
        (own,), (moved,) = curves, parts
        units = own.solver.model.basin.units
        scales = np.array(
            [units.density * units.gravity * abs(one.per_elevation(towards)[0]) ** 2 for one in own.responses]
        )
        forces = scales * [one.drift_force(part)[0] for one, part in zip(own.responses, moved, strict=True)]
        errors = scales * drift_errors(own.responses, omegas, estimated_about_peaks(own), own.reduced, damping)[:, 0]
    # F/A² is the square of a transfer function: it is along the waves, for no more waves pass than come.
    roots = np.sqrt(np.abs(forces))[:, None]
    deviations = np.sqrt(roots**2 + errors[:, None]) - roots
    told = statistics(request.spectrum, omegas, roots, deviations, request.duration)
    # Short waves are reflected: the force beyond is as at the end, and changes no more than up to there.
    tail, last = 2.0 * request.spectrum.tail(omegas[-1], 0), np.abs(forces[omegas >= _LAST * omegas[-1]])
    within = 2.0 * float(told.moments[0, 0])
    # Of an amplitude, the relative error is half of that of its square.
    return MeanDrift(
        force=towards * (within + tail * float(last[-1])),
        error=2.0 * float((told.sampling_error + told.transfer_error)[0]) * within,
        truncation=tail * float(np.ptp(last)),
    )


def reflected_drift(tank: Tank, spectrum: WaveSpectrum) -> float:
    """Return the mean drift force of waves that are reflected in full in deep water, N/m, or of solids N."""
    layer = tank.layers[0]
    width = 2.0 * extent_of_bodies(tank)[1] if tank.geometry.is_whole else 1.0
    return layer.density * tank.gravity * spectrum.significant_height**2 / 16.0 * width


def _drift_of_orders(
    problem: OpenWaterProblem,
    request: SpectrumRequest,
    omegas: np.ndarray,
    known: dict[int, np.ndarray],
    moving: dict[int, Curves],
    further: Callable[[int], Curves],
) -> tuple[np.ndarray, np.ndarray]:
    """Drift force along the waves per square of their amplitude about an axis, N/m², and its error, each of shape (n,)
    (collective).

    Bodies of radius a scatter waves in orders up to ka. The force of each pair of orders is less than that of the last
    one: orders are added until all those left out contribute less than a part of the tolerance, or of the error of the
    others, which is told.
    """
    wavenumbers, widths = drift_widths(problem.tank, omegas)
    scattered = wavenumbers * extent_of_bodies(problem.tank)[1]
    least = max(_LEFT_OUT * problem.tolerance, _LEAST)
    waves: list[np.ndarray] = []
    errors: list[np.ndarray] = []

    def mean(forces: np.ndarray) -> float:
        return float(moments(request.spectrum, omegas, np.sqrt(np.abs(forces))[:, None], (0,))[0, 0])

    for order in count():
        own = moving.get(order) or further(order)
        found = known.get(order)
        waves.append(np.array([one.partial_waves()[0, 0] for one in own.responses]) if found is None else found[:, 0])
        errors.append(wave_errors(own.responses, omegas, estimated_about_peaks(own), own.reduced))
        if order < max(1, *known):
            continue
        partial = np.array(waves).T
        forces, error = drift_of_orders(widths, partial, np.stack(errors, axis=1), np.zeros(partial.shape))
        left_out = np.abs(forces[:, -1]) * np.maximum(scattered - order, 1.0)
        # Waves far longer than the bodies leave rounding, which does not fall with the order.
        if mean(left_out) <= max(least * mean(forces.sum(axis=1)), _LEFT_OUT * mean(error)):
            return forces.sum(axis=1), error + left_out
    raise AssertionError


def mean_power(request: SpectrumRequest, curves: list[Curves], motions: np.ndarray) -> float:
    """Mean power that the linear damping of attachments takes, ∫ ω² aᴴBa S dω, W/m or of solids W."""
    models, omegas = [one.solver.model for one in curves], curves[0].omegas
    damping = block_diag(*(model.outside.damping for model in models))
    units = models[0].basin.units
    values, vectors = np.linalg.eigh(damping)
    speeds = omegas[:, None] * (motions @ vectors)
    taken = float(moments(request.spectrum, omegas, speeds, (0,))[0] @ np.maximum(values, 0.0))
    return units.density * units.gravity * units.volume / units.length / units.frequency * taken
