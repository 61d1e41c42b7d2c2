"""The answer to the scene of a hanging string as one JSON-ready value."""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING, Any

import numpy as np

from hydroelastic.modal.string.closed_form import first_oscillating_mode, natural_frequency, steady_amplitude
from hydroelastic.modal.string.resonance import nearest_resonance
from hydroelastic.modal.string.solution import FreeMotions, StringSolution
from hydroelastic.output.provenance import Summary, complete_summary
from hydroelastic.physics.string import HangingString
from hydroelastic.scenes.models.string import StringScene
from hydroelastic.scenes.models.string_parts import SineMotion
from hydroelastic.scenes.string.results import StringResult

if TYPE_CHECKING:
    from mpi4py import MPI


def summarize_string(result: StringResult, comm: MPI.Comm, *, import_seconds: float) -> Summary:
    """Build the summary of a solved scene (collective: peak memory is summed over processes).

    Args:
        result: the solved scene.
        comm: the processes.
        import_seconds: time spent importing libraries.

    Returns:
        The content of ``summary.json``.
    """
    scene, solution = result.scene, result.solution
    content = {
        "method": scene.method,
        "string": _string(solution.string),
        "modes": modes(solution.free_motions),
        "response": _response(solution),
        "steady": _steady(scene, solution),
    }
    return complete_summary(result, content, solution.size, comm, import_seconds)


def _string(string: HangingString) -> dict[str, Any]:
    """Properties of the string; the criterion of oscillation is that of a uniform string with a free end."""
    found: dict[str, Any] = {
        "travel_time": string.travel_time,
        "damping": string.damping,
        "apparent_gravity": string.apparent_gravity,
        "first_oscillating_mode": None,
        "critical_resistance": None,
    }
    if string.has_closed_form:
        found["first_oscillating_mode"] = first_oscillating_mode(string)
        found["critical_resistance"] = natural_frequency(string, 1) * string.inertia
    return found


def modes(motions: FreeMotions) -> list[dict[str, Any]]:
    """Return one entry for each free motion."""
    return [
        {
            "omega": float(frequency),
            "frequency_hz": float(root.imag) / (2.0 * pi),
            "damped_omega": float(root.imag),
            "decay": float(-root.real),
            "kind": "oscillating" if root.imag > 0.0 else "aperiodic",
            "relative_error": float(error),
        }
        for root, frequency, error in zip(motions.roots, motions.frequencies, motions.relative_errors, strict=True)
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
            "within": solution.front_margin,
            "points": int(beside.sum()),
            "absolute_error": float(solution.absolute_error[beside].max(initial=0.0)),
        },
    }


def _steady(scene: StringScene, solution: StringSolution) -> dict[str, Any] | None:
    """The amplitude A(x) of the steady motion under a sine; infinite in resonance without damping, there null."""
    string, given = solution.string, scene.motion
    if not isinstance(given, SineMotion) or not string.has_closed_form:
        return None
    amplitude = abs(given.amplitude) * steady_amplitude(string, given.omega, solution.positions)
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
