"""Quantities of a hanging string whose upper end is moved."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import pi
from typing import Any, Protocol

import numpy as np

from hydroelastic.modal.string.closed_form import first_oscillating_mode, natural_frequency, steady_amplitude
from hydroelastic.modal.string.resonance import nearest_resonance
from hydroelastic.modal.string.solution import StringSolution
from hydroelastic.output.provenance import PROCESSES
from hydroelastic.output.quantities import Group, Quantity, array
from hydroelastic.physics.string_motions import Motion, Sine


class MovedString(Protocol):
    """What the quantities are taken from."""

    @property
    def solution(self) -> StringSolution:
        """Displacements and free motions."""

    @property
    def method(self) -> str:
        """The word "series", or "field"."""

    @property
    def motion(self) -> Motion:
        """Motion of the upper end."""


@dataclass(frozen=True, kw_only=True)
class FreeMotion:
    """One free motion e^{pt}: its root p, 1/s, |p|, and the estimated relative error of both."""

    root: complex
    omega: float
    relative_error: float


def _free_motions(result: MovedString) -> Iterator[FreeMotion]:
    motions = result.solution.free_motions
    for root, size, error in zip(motions.roots, motions.frequencies, motions.relative_errors, strict=True):
        yield FreeMotion(root=complex(root), omega=float(size), relative_error=float(error))


def _response(result: MovedString) -> Mapping[str, Any]:
    solution = result.solution
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


def _steady(result: MovedString) -> Mapping[str, Any] | None:
    """The amplitude A(x) of the steady motion under a sine; infinite in resonance without damping, there null."""
    string, motion = result.solution.string, result.motion
    if not isinstance(motion, Sine) or not string.has_closed_form:
        return None
    positions = result.solution.positions
    amplitude = abs(motion.amplitude) * steady_amplitude(string, motion.omega, positions)
    resonance = nearest_resonance(string, motion.omega)
    return {
        "positions": positions,
        "amplitude": [_finite(value) for value in amplitude],
        "nearest_resonance": {
            "mode": resonance.mode,
            "omega": _finite(resonance.peak_frequency),
            "amplitude": _finite(abs(motion.amplitude) * resonance.peak_amplitude),
        },
    }


def _finite(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None


# fmt: off
# A table: as many arguments on a line as fit.
STRING = Group("string", "the string", (
    TRAVEL_TIME := Quantity("travel_time", "time that a wave takes along the string", "s", "R"),
    DAMPING := Quantity("damping", "mean damping", "1/s", "α"),
    Quantity("apparent_gravity", "apparent gravity", "m/s^2", "g(ρ − ρ_d)/(ρ + m_a)"),
    FIRST_OSCILLATING_MODE := Quantity("first_oscillating_mode", "first mode that oscillates", "1",
        value=lambda string: first_oscillating_mode(string) if string.has_closed_form else None,
        note="of a string with a free end and a uniform resistance, else `null`"),
    CRITICAL_RESISTANCE := Quantity("critical_resistance", "critical resistance of the first mode", "kg/(m s)",
        value=lambda string: natural_frequency(string, 1) * string.inertia if string.has_closed_form else None,
        note="of a string with a free end and a uniform resistance, else `null`"),
), record=lambda result: result.solution.string)
MODES = Group("modes", "free motions e^{pt} by ascending magnitude, one of each conjugate pair", (
    MODE_OMEGA := Quantity("omega", "magnitude of the root of a free motion", "rad/s", "|p|", error="relative_error",
        digits=12, variable="omega", note="the natural frequency Ω of a mode that oscillates with uniform damping"),
    Quantity("frequency_hz", "frequency of a free motion", "Hz", "f", value=lambda mode: mode.root.imag / (2.0 * pi),
        shown=".6g"),
    Quantity("damped_omega", "angular frequency of a free motion", "rad/s", "Im p", value=lambda mode: mode.root.imag),
    Quantity("decay", "rate at which a free motion decays", "1/s", "−Re p", value=lambda mode: -mode.root.real),
    KIND := Quantity("kind", "kind", value=lambda mode: "oscillating" if mode.root.imag > 0.0 else "aperiodic",
        note='`"oscillating"` or `"aperiodic"`'),
    Quantity("relative_error", "relative error", "1", shown=".1e", note="estimated, of the root", contract=False),
), record=_free_motions, dimension="mode", prefix="mode")
BESIDE_FRONTS = Group("beside_fronts",
    "values beside wave fronts, where the displacement or a derivative of it jumps", (
    WITHIN := Quantity("within", "distance from a front up to which a value is beside it, in travel times", "1"),
    POINTS := Quantity("points", "number of values beside fronts", "1"),
    BESIDE_ERROR := Quantity("absolute_error", "estimated error beside fronts", "m", shown=".1e", contract=False),
))
RESPONSE = Group("response", "displacements at the heights and times asked", (
    LARGEST_DISPLACEMENT := Quantity("largest_displacement", "largest displacement at the heights and times asked", "m",
        error="relative_error",
        note="of all values away from fronts, and of those beside fronts that meet the tolerance"),
    AT_POSITION := Quantity("at_position", "height of the largest displacement", "m"),
    AT_TIME := Quantity("at_time", "time of the largest displacement", "s"),
    UNTIL := Quantity("until", "last time", "s", shown=".6g", printed=False),
    Quantity("points", "values", "1"),
    Quantity("absolute_error", "estimated error away from fronts", "m", printed=False, contract=False),
    Quantity("relative_error", "estimated error, of the largest", "1", shown=".1e", note="away from fronts",
        contract=False),
    BESIDE_FRONTS,
), record=_response)
STEADY = Group("steady", "steady motion under a sine", (
    POSITIONS := Quantity("positions", "heights above the free end", "m", dimensions=("position",), variable=""),
    AMPLITUDE := Quantity("amplitude", "amplitude of the steady motion", "m", "A(x)", dimensions=("position",),
        note="`null` if infinite"),
    NEAREST_RESONANCE := Group("nearest_resonance", "the nearest resonance of the free end", (
        RESONANT_MODE := Quantity("mode", "mode near which the free end moves most", "1"),
        RESONANT_OMEGA := Quantity("omega", "ω of the largest steady motion", "rad/s",
            note="`null` where drag leaves no peak"),
        RESONANT_AMPLITUDE := Quantity("amplitude", "largest steady amplitude of the free end", "m",
            note="`null` if infinite"),
    )),
), record=_steady, note="`null` for other motions, and without a closed form")
_ARRAYS = (
    array("position", "height above the free end at rest", "m", "position", lambda it: it.solution.positions),
    array("time", "time", "s", "time", lambda it: it.solution.times),
    array("mode", "number of the mode", None, "mode", lambda it: np.arange(1, len(it.solution.free_motions.roots) + 1)),
    array("displacement", "displacement to the side", "m", "position time", lambda it: it.solution.displacement),
    array("absolute_error", "estimated error of the displacement", "m", "position time",
        lambda it: it.solution.absolute_error, contract=False),
    array("beside_front", "whether a wave front is near", None, "position time", lambda it: it.solution.beside_fronts),
    array("root", "root p of a free motion e^{pt}", "1/s", "mode", lambda it: it.solution.free_motions.roots),
    array("mode_shape", "shape of a free motion, its largest value 1", "1", "mode position",
        lambda it: it.solution.free_motions.shapes),
)
HANGING_STRING = Group("", "a hanging string whose upper end is moved", (
    METHOD := Quantity("method", "method of solution", note='`"series"` or `"field"`'),
    STRING, MODES, RESPONSE, STEADY,
    SIZE := Group("size", "size of the problem", (
        TERMS := Quantity("terms", "largest number of terms of a series", "1"),
        CELLS := Quantity("cells", "number of cells of a field solution", "1"),
        DEGREE := Quantity("degree", "degree of its polynomials", "1"),
        DOFS := Quantity("dofs", "number of its unknowns", "1"),
        STEPS := Quantity("steps", "number of its steps in time", "1"),
        PROCESSES,
    ), record=lambda result: result.solution.size, contract=False),
    *_ARRAYS,
))
