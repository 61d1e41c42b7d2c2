"""The answer to the scene of a hanging string as one JSON-ready value."""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING, Any

import numpy as np

from hydroelastic.modal.string.resonance import nearest_resonance
from hydroelastic.scenes.models.string import SineMotion
from hydroelastic.scenes.output.provenance import Summary, framed_summary
from hydroelastic.scenes.string.fronts import BESIDE
from hydroelastic.scenes.string.results import StringMotions, StringSolution
from hydroelastic.scenes.string.series import closed_form

if TYPE_CHECKING:
    from mpi4py import MPI


def summarize_string(solution: StringSolution, comm: MPI.Comm, *, import_seconds: float) -> Summary:
    """Build the summary of a solved scene (collective: peak memory is summed over processes).

    Args:
        solution: the motion.
        comm: the processes.
        import_seconds: time spent importing libraries.

    Returns:
        The content of ``summary.json``.
    """
    scene = solution.scene
    content = {
        "method": scene.method,
        "string": _string(solution),
        "modes": modes(solution.motions),
        "response": _response(solution),
        "steady": _steady(solution),
    }
    return framed_summary(solution, content, solution.size, comm, import_seconds)


def _string(solution: StringSolution) -> dict[str, Any]:
    """What is known beforehand; the criterion of oscillation is that of a uniform string with a free end."""
    string = solution.scene.string
    found: dict[str, Any] = {
        "travel_time": string.travel_time,
        "damping": string.damping,
        "apparent_gravity": string.apparent_gravity,
        "first_oscillating_mode": None,
        "critical_resistance": None,
    }
    if string.has_closed_form:
        exact = closed_form(solution.scene)
        found["first_oscillating_mode"] = exact.first_oscillating_mode()
        found["critical_resistance"] = exact.least_damping_without_oscillation(1) * string.inertia
    return found


def modes(motions: StringMotions) -> list[dict[str, Any]]:
    """Return one entry for each free motion."""
    return [
        {
            "omega": float(frequency),
            "frequency_hz": float(root.imag) / (2.0 * pi),
            "damped_omega": float(root.imag),
            "decay": float(-root.real),
            "kind": "oscillating" if root.imag > 0.0 else "aperiodic",
            "relative_error": float(error / abs(root)),
        }
        for root, frequency, error in zip(motions.roots, motions.frequencies, motions.errors, strict=True)
    ]


def _response(solution: StringSolution) -> dict[str, Any]:
    sizes = np.where(solution.trusted, np.abs(solution.displacement), -1.0)
    row, column = np.unravel_index(int(sizes.argmax()), sizes.shape)
    beside = solution.beside_fronts
    return {
        "largest_displacement": float(solution.displacement[row, column]),
        "at_position": float(solution.positions[row]),
        "at_time": float(solution.times[column]),
        "until": float(solution.times[-1]),
        "points": int(solution.displacement.size),
        "absolute_error": float(solution.absolute_error[solution.judged].max()),
        "relative_error": solution.relative_error,
        "beside_fronts": {
            "within": BESIDE[solution.scene.method],
            "points": int(beside.sum()),
            "absolute_error": float(solution.absolute_error[beside].max(initial=0.0)),
        },
    }


def _steady(solution: StringSolution) -> dict[str, Any] | None:
    """The amplitude A(x) of the steady motion under a sine; infinite in resonance without damping, there null."""
    scene = solution.scene
    if not isinstance(scene.motion, SineMotion) or not scene.string.has_closed_form:
        return None
    string, given = closed_form(scene), scene.motion
    amplitude = abs(given.amplitude) * string.amplitude(given.omega, solution.positions)
    resonance = nearest_resonance(string, given.omega)
    return {
        "positions": solution.positions.tolist(),
        "amplitude": [_finite(value) for value in amplitude],
        "nearest_resonance": {
            "mode": resonance.mode,
            "omega": _finite(resonance.peak_frequency),
            "amplitude": _finite(abs(given.amplitude) * resonance.peak_amplitude),
        },
    }


def _finite(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None
