"""Free motions and thresholds of stability of a thread by closed forms, where it is straight or sags little."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from math import hypot, inf, sqrt
from typing import Any, Literal

import numpy as np

from hydroelastic.modal.thread.axial_flow import AxialFlowBeam, Ends, string_in_axial_flow
from hydroelastic.modal.thread.estimate import (
    Found,
    ValueEstimate,
    estimate_or_reason,
    require,
    require_bare_thread,
)
from hydroelastic.modal.thread.fixed_end_estimates import catenary_of, fixed_ends
from hydroelastic.modal.thread.modes import (
    chain_frequencies,
    irvine_parameter,
    sagging_cable_frequencies,
    tensioned_beam_frequencies,
)
from hydroelastic.modal.thread.shape import NoAsymptoticError
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.stream import UniformStream
from hydroelastic.physics.thread import Thread

_Kind = Literal["divergence", "flutter"]

_OMEGA, _LAMBDA = "ω, rad/s", "λ, 1/s"
_STRING, _BEAM, _CHAIN = "taut string", "pinned beam under tension", "hanging chain"
_CABLE, _AXIAL = "Irvine and Caughey's cable", "thread in a stream along it"
# Largest ratio of sag to span.
_LARGEST_SAG = 0.125
# Next terms of the series, relative to sag²: measured 0.02 to 3.85, that of the first antisymmetric mode in the plane.
_NEXT_IN_SAG = 4.0
# Angles below this, and lengths of the chord, are rounding of the input.
_ROUNDING = 1e-9
# Of the Galerkin solution of a beam, relative: where two modes merge, and of the lowest modes.
_MERGED, _GALERKIN = 1e-8, 1e-9
_MOST_GALERKIN = 6


def mode_estimates(thread: Thread, count: int, analysis: int = 0) -> Iterator[Found]:
    """Yield estimates of the frequencies and roots of a thread, or why there are none.

    Args:
        thread: in space, SI units.
        count: number of modes.
        analysis: number of the analysis of modes, from 0.
    """
    yield estimate_or_reason(_STRING, partial(_taut_string, thread, count, analysis))
    yield estimate_or_reason(_BEAM, partial(_beam, thread, count, analysis))
    yield estimate_or_reason(_CHAIN, partial(_chain, thread, count, analysis))
    for out_of_plane in (False, True):
        where = "out of its plane" if out_of_plane else "in its plane"
        yield estimate_or_reason(f"{_CABLE}, {where}", partial(_cable, thread, count, analysis, out_of_plane))
    yield estimate_or_reason(_AXIAL, partial(_axial, thread, count, analysis))


def stability_estimates(thread: Thread, factors: Sequence[float], analysis: int = 0) -> Iterator[Found]:
    """Yield estimates of the speeds at which a thread in a stream along it diverges and flutters, or why not.

    Args:
        thread: in space, SI units.
        factors: of the stream, increasing, between which thresholds are looked for.
        analysis: number of the analysis of stability, from 0.
    """
    kinds: tuple[_Kind, ...] = ("divergence", "flutter")
    for kind in kinds:
        yield estimate_or_reason(f"{_AXIAL}: {kind}", partial(_threshold, thread, factors, analysis, kind))


def _line(thread: Thread) -> tuple[float, float]:
    """Tension of a thread stretched straight between its ends, N, and its length relative to the unstretched one."""
    a, b = fixed_ends(thread)
    require(thread.weight == 0.0 and not thread.loads, "weight bends the thread")
    rigidity, given = thread.axial_rigidity, thread.tension
    if given is not None:
        return given, 1.0
    stretch = float(np.linalg.norm(b - a)) / thread.length
    require(rigidity < inf and stretch >= 1.0 - _ROUNDING, "the thread is not stretched between its ends")
    return max(rigidity * (stretch - 1.0), 0.0), stretch


def _still(thread: Thread) -> None:
    require(thread.stream is None, "the liquid streams")
    require(thread.viscous_drag == 0.0, "the viscous drag damps the motion")


def _taut_string(thread: Thread, count: int, analysis: int) -> ValueEstimate:
    tension, stretch = _line(thread)
    require_bare_thread(thread, stretch=True)
    _still(thread)
    mass = thread.mass + thread.added_mass
    # Over the unstretched length waves run at √(T/(g m)), g = |r_s|.
    values = tensioned_beam_frequencies(thread.length, tension / stretch, mass, count)
    return ValueEstimate(
        name=_STRING,
        order=None,
        quantity="frequency",
        label=_OMEGA,
        values=values,
        truncation=np.zeros(count),
        analysis=analysis,
    )


def _beam(thread: Thread, count: int, analysis: int) -> ValueEstimate:
    require(thread.flexural_rigidity > 0.0, "the thread does not resist bending")
    tension, stretch = _line(thread)
    _still(thread)
    require(_ends_of(thread) == "pinned", "the ends are clamped")
    mass = thread.mass + thread.added_mass
    values = tensioned_beam_frequencies(thread.length, tension / stretch, mass, count, thread.flexural_rigidity)
    return ValueEstimate(
        name=_BEAM,
        order=0,
        parameter="T/EA",
        small=stretch - 1.0,
        quantity="frequency",
        label=_OMEGA,
        values=values,
        truncation=abs(stretch - 1.0) * values,
        analysis=analysis,
    )


def _chain(thread: Thread, count: int, analysis: int) -> ValueEstimate:
    a, b = thread.ends
    require((a.is_fixed and b.is_free) or (a.is_free and b.is_fixed), "not one end is fixed and the other one free")
    body = a.load if a.is_free else b.load
    require_bare_thread(thread, stretch=False)
    _still(thread)
    require(not body.force.any(), "a dead force pulls at the end")
    require(thread.weight != 0.0, "the thread has no weight")
    pull = body.weight * np.sign(thread.weight)
    require(pull >= 0.0, "the body pulls against the weight of the thread")
    mass, tip = thread.mass + thread.added_mass, body.mass + body.added_mass
    values = chain_frequencies(thread.length, abs(thread.weight), mass, count, pull, tip)
    return ValueEstimate(
        name=_CHAIN,
        order=None,
        quantity="frequency",
        label=_OMEGA,
        values=values,
        truncation=np.zeros(count),
        analysis=analysis,
    )


def _cable(thread: Thread, count: int, analysis: int, out_of_plane: bool) -> ValueEstimate:
    a, b = fixed_ends(thread)
    require_bare_thread(thread, stretch=True)
    _still(thread)
    require(thread.weight != 0.0, "the thread has no weight, and does not sag")
    span = hypot(*(b - a)[:2])
    require(abs((b - a)[2]) <= _ROUNDING * span, "one end is higher than the other")
    level = float(np.hypot(*catenary_of(thread, np.zeros(1)).forces[0, :2]))
    sag = abs(thread.weight) * span / (8.0 * level)
    require(sag < _LARGEST_SAG, f"the sag is {sag:.3g} of the span: it must be below {_LARGEST_SAG}")
    irvine = irvine_parameter(span, abs(thread.weight), level, thread.axial_rigidity)
    mass = thread.mass + thread.added_mass
    values = sagging_cable_frequencies(span, level, mass, irvine, count, out_of_plane)
    return ValueEstimate(
        name=f"{_CABLE}, {'out of its plane' if out_of_plane else 'in its plane'}",
        order=0,
        parameter="sag/span",
        small=sag,
        quantity="frequency out of the plane" if out_of_plane else "frequency in the plane",
        label=_OMEGA,
        values=values,
        truncation=_NEXT_IN_SAG * sag**2 * values,
        analysis=analysis,
    )


@dataclass(frozen=True)
class _Along:
    """A straight thread in a uniform stream along it."""

    thread: Thread  # in space, SI units
    tension: float  # T, N
    stretch: float  # |r_s| − 1, which the theory takes as small
    ends: Ends  # how they are held
    speed: float  # U, m/s

    @property
    def order(self) -> dict[str, Any]:
        """Order and small parameter of an estimate: exact unless the thread stretches."""
        return {"order": 0, "parameter": "T/EA", "small": self.stretch} if self.stretch else {"order": None}

    @property
    def beam(self) -> AxialFlowBeam:
        """The thread as a beam."""
        thread = self.thread
        return AxialFlowBeam(
            length=thread.length,
            flexural_rigidity=thread.flexural_rigidity,
            mass=thread.mass,
            added_mass=thread.added_mass,
            tension=self.tension,
            ends=self.ends,
            taper=thread.ends[1].taper,
        )


def _ends_of(thread: Thread) -> Ends:
    """Return how two fixed ends are held; clamps must be along the chord."""
    chord = np.subtract(*reversed(fixed_ends(thread)))
    clamps = [end.clamp for end in thread.ends if end.clamp is not None]
    require(len(clamps) != 1, "one end alone is clamped")
    for clamp in clamps:
        require(_same_way(clamp, chord), "a clamp bends the thread")
    return "clamped" if clamps else "pinned"


def _same_way(one: FloatArray, other: FloatArray) -> bool:
    size = float(np.linalg.norm(one) * np.linalg.norm(other))
    return bool(np.linalg.norm(np.cross(one, other)) <= _ROUNDING * size and one @ other > 0.0)


def _along(thread: Thread) -> _Along:
    """Return a straight thread in a stream along it."""
    require(thread.reactive != "none", "no reaction of a liquid that streams along the thread is modelled")
    stream = thread.stream
    require(isinstance(stream, UniformStream), "the stream is not uniform")
    assert isinstance(stream, UniformStream)
    require(thread.tangential_drag == thread.viscous_drag == 0.0, "friction changes the tension, or the damping")
    require(thread.weight == 0.0 and not thread.loads, "weight bends the thread")
    velocity = np.array(stream.velocity)
    speed = float(np.linalg.norm(velocity))
    a, b = thread.ends
    if a.is_fixed and b.is_fixed:
        tension, stretch = _line(thread)
        way = b.position - a.position
        require(_same_way(way, velocity) or _same_way(-way, velocity), "the stream does not go along the thread")
        return _Along(thread, tension, abs(stretch - 1.0), _ends_of(thread), speed)
    require(a.is_fixed and b.is_free, "the upstream end A is not fixed, or B not free")
    require(a.clamp is not None and _same_way(a.clamp, velocity), "end A is not clamped along the stream")
    body = b.load
    require(body.mass == body.added_mass == body.weight == body.drag == 0.0, "there is a body at the free end")
    require(
        not body.force.any() or _same_way(body.force, velocity), "the force on the free end is not along the stream"
    )
    return _Along(thread, float(np.linalg.norm(body.force)), 0.0, "clamped-free", speed)


def _axial(thread: Thread, count: int, analysis: int) -> ValueEstimate:
    straight = _along(thread)
    if thread.bends:
        values = straight.beam.exponents(straight.speed, min(count, _MOST_GALERKIN))
    else:
        values = string_in_axial_flow(
            thread.length, straight.tension, thread.mass, thread.added_mass, straight.speed, count
        )
    return ValueEstimate(
        name=_AXIAL,
        **straight.order,
        quantity="root",
        label=_LAMBDA,
        values=values,
        truncation=(straight.stretch + (_GALERKIN if thread.bends else 0.0)) * np.abs(values),
        analysis=analysis,
    )


def _threshold(thread: Thread, factors: Sequence[float], analysis: int, kind: _Kind) -> ValueEstimate:
    straight = _along(thread)
    speed = _threshold_speed(straight, kind)
    low, high = (factor * straight.speed for factor in (factors[0], factors[-1]))
    require(low <= speed <= high, f"at {speed:.6g} m/s, beyond the streams that are asked for")
    merged = thread.bends and kind == "flutter" and (straight.ends != "clamped-free" or straight.beam.taper == 1.0)
    return ValueEstimate(
        name=f"{_AXIAL}: {kind}",
        **straight.order,
        quantity="divergence speed" if kind == "divergence" else "flutter speed",
        label=f"speed of {kind}, m/s",
        values=np.array([speed]),
        truncation=np.array([(straight.stretch + (_MERGED if merged else 0.0)) * speed]),
        analysis=analysis,
    )


def _threshold_speed(straight: _Along, kind: _Kind) -> float:
    if not straight.thread.bends:
        require(kind == "divergence", "a string in a stream diverges before it flutters")
        return sqrt(straight.tension / straight.thread.added_mass)
    if kind == "divergence":
        require(straight.ends != "clamped-free", "of a beam with a free end it is not known in closed form")
        return straight.beam.divergence_speed()
    try:
        return straight.beam.flutter()[0]
    except ValueError as error:
        raise NoAsymptoticError(str(error)) from error
