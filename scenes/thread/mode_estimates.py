"""Free motions and thresholds of stability of a thread by closed forms, where it is straight or sags little."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from math import hypot, inf, sqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hydroelastic.modal.thread.asymptotics import NoAsymptoticError
from hydroelastic.modal.thread.axial_flow import AxialFlowBeam, Ends, string_in_axial_flow
from hydroelastic.modal.thread.modes import (
    chain_frequencies,
    irvine_parameter,
    sagging_cable_frequencies,
    tensioned_beam_frequencies,
)
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.stream import UniformStream
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.models.thread_analyses import ThreadModes, ThreadStability
from hydroelastic.scenes.models.thread_parts import FixedEnd, FreeEnd
from hydroelastic.scenes.thread.estimate import (
    Found,
    Measured,
    ValueEstimate,
    attempted,
    nearest,
    require,
    require_bare_thread,
)
from hydroelastic.scenes.thread.held_estimates import catenary_of, fixed_ends
from hydroelastic.scenes.thread.model import stream_of
from hydroelastic.scenes.thread.results import ThreadSolutionOfScene

_OMEGA, _LAMBDA = "ω, rad/s", "λ, 1/s"
_STRING, _BEAM, _CHAIN = "taut string", "pinned beam under tension", "hanging chain"
_CABLE, _AXIAL = "Irvine and Caughey's cable", "thread in a stream along it"
# Sag to span above which a cable does not sag little.
_LARGEST_SAG = 0.125
# Of sag², the next terms, relative: measured 0.02 to 3.85, the largest of the first antisymmetric mode in the plane.
_NEXT_IN_SAG = 4.0
# Angles below this, and lengths of the chord, are rounding of what was written in the scene.
_ROUNDING = 1e-9
# Of the Galerkin solution of a beam, relative: where two modes merge, and of the lowest modes.
_MERGED, _GALERKIN = 1e-8, 1e-9
_MOST_GALERKIN = 6


def mode_estimates(scene: ThreadScene) -> Iterator[Found]:
    """Yield what is known of the modes and thresholds that a scene asks for, or why it is not."""
    place = threshold = 0
    for analysis in scene.analysis:
        if isinstance(analysis, ThreadModes):
            yield from _modes(scene, analysis, place)
            place += 1
        elif isinstance(analysis, ThreadStability):
            for kind in ("divergence", "flutter"):
                yield attempted(f"{_AXIAL}: {kind}", partial(_threshold, scene, threshold, kind))
            threshold += 1


def _modes(scene: ThreadScene, asked: ThreadModes, place: int) -> Iterator[Found]:
    count = asked.count
    yield attempted(_STRING, partial(_taut_string, scene, count, place))
    yield attempted(_BEAM, partial(_beam, scene, count, place))
    yield attempted(_CHAIN, partial(_chain, scene, count, place))
    for out_of_plane in (False, True):
        where = "out of its plane" if out_of_plane else "in its plane"
        yield attempted(f"{_CABLE}, {where}", partial(_cable, scene, count, place, out_of_plane))
    yield attempted(_AXIAL, partial(_axial, scene, count, place))


def _frequencies(
    place: int, out_of_plane: bool | None = None
) -> Callable[[ThreadSolutionOfScene, FloatArray], Measured]:
    """What finds ω of the field solution: all of them, those in the plane, or those out of it."""

    def measure(solution: ThreadSolutionOfScene, values: FloatArray) -> Measured:
        roots = solution.modes[place].oscillating
        chosen = np.ones(len(roots.values), dtype=bool)
        if out_of_plane is not None:
            chosen = (roots.out_of_plane > 0.5) == out_of_plane
        return nearest(values, roots.values[chosen].imag, roots.errors[chosen])

    return measure


def _line(scene: ThreadScene) -> tuple[float, float]:
    """Tension of a thread that is stretched straight between its ends, N, and the length of it, of the unstretched."""
    a, b = fixed_ends(scene)
    require(scene.weight == 0.0 and not scene.load, "weight bends the thread")
    rigidity, given = scene.thread.axial_rigidity, scene.thread.tension
    if given is not None:
        return given, 1.0
    stretch = float(np.linalg.norm(b - a)) / scene.thread.length
    require(rigidity is not None and stretch >= 1.0 - _ROUNDING, "the thread is not stretched between its ends")
    assert rigidity is not None
    return max(rigidity * (stretch - 1.0), 0.0), stretch


def _still(scene: ThreadScene) -> None:
    """Refuse what moves or damps the liquid beyond its added mass."""
    require(not scene.streams, "the liquid streams")
    require(scene.thread.viscous_drag == 0.0, "the viscous drag damps the motion")


def _taut_string(scene: ThreadScene, count: int, place: int) -> ValueEstimate:
    tension, stretch = _line(scene)
    require_bare_thread(scene, stretch=True)
    _still(scene)
    mass = scene.thread.mass + scene.added_mass
    # Over the unstretched length waves run at √(T/(g m)), g = |r_s|.
    values = tensioned_beam_frequencies(scene.thread.length, tension / stretch, mass, count)
    return ValueEstimate(
        name=_STRING,
        order=None,
        quantity=_OMEGA,
        values=values,
        left_out=np.zeros(count),
        measure=_frequencies(place),
    )


def _beam(scene: ThreadScene, count: int, place: int) -> ValueEstimate:
    require(scene.thread.flexural_rigidity > 0.0, "the thread does not resist bending")
    tension, stretch = _line(scene)
    _still(scene)
    require(_ends_of(scene) == "pinned", "the ends are clamped")
    mass = scene.thread.mass + scene.added_mass
    values = tensioned_beam_frequencies(
        scene.thread.length, tension / stretch, mass, count, scene.thread.flexural_rigidity
    )
    return ValueEstimate(
        name=_BEAM,
        order=0,
        parameter="T/EA",
        small=stretch - 1.0,
        quantity=_OMEGA,
        values=values,
        left_out=abs(stretch - 1.0) * values,
        measure=_frequencies(place),
    )


def _chain(scene: ThreadScene, count: int, place: int) -> ValueEstimate:
    a, b = scene.ends.a, scene.ends.b
    free = a if isinstance(a, FreeEnd) else b
    require({a.kind, b.kind} == {"fixed", "free"}, "not one end is fixed and the other one free")
    assert isinstance(free, FreeEnd)
    require_bare_thread(scene, stretch=False)
    _still(scene)
    require(not any(free.force), "a dead force pulls at the end")
    require(scene.weight != 0.0, "the thread has no weight")
    pull = free.weight * np.sign(scene.weight)
    require(pull >= 0.0, "the body pulls against the weight of the thread")
    mass, tip = scene.thread.mass + scene.added_mass, free.mass + free.added_mass
    values = chain_frequencies(scene.thread.length, abs(scene.weight), mass, count, pull, tip)
    return ValueEstimate(
        name=_CHAIN,
        order=None,
        quantity=_OMEGA,
        values=values,
        left_out=np.zeros(count),
        measure=_frequencies(place),
    )


def _cable(scene: ThreadScene, count: int, place: int, out_of_plane: bool) -> ValueEstimate:
    a, b = fixed_ends(scene)
    require_bare_thread(scene, stretch=True)
    _still(scene)
    require(scene.weight != 0.0, "the thread has no weight, and does not sag")
    span = hypot(*(b - a)[:2])
    require(abs((b - a)[2]) <= _ROUNDING * span, "one end is higher than the other")
    level = float(np.hypot(*catenary_of(scene, np.zeros(1)).forces[0, :2]))
    sag = abs(scene.weight) * span / (8.0 * level)
    require(sag < _LARGEST_SAG, f"the sag is {sag:.3g} of the span: it must be below {_LARGEST_SAG}")
    irvine = irvine_parameter(span, abs(scene.weight), level, scene.thread.axial_rigidity or inf)
    mass = scene.thread.mass + scene.added_mass
    values = sagging_cable_frequencies(span, level, mass, irvine, count, out_of_plane)
    return ValueEstimate(
        name=f"{_CABLE}, {'out of its plane' if out_of_plane else 'in its plane'}",
        order=0,
        parameter="sag/span",
        small=sag,
        quantity=_OMEGA,
        values=values,
        left_out=_NEXT_IN_SAG * sag**2 * values,
        measure=_frequencies(place, out_of_plane),
    )


@dataclass(frozen=True)
class _Along:
    """A straight thread in a uniform stream along it.

    Attributes:
        scene: the scene.
        tension: T, N.
        stretch: |r_s| − 1, which the theory takes as small.
        ends: how they are held.
        speed: U, m/s.
    """

    scene: ThreadScene
    tension: float
    stretch: float
    ends: Ends
    speed: float

    @property
    def bends(self) -> bool:
        """Whether it resists bending."""
        return self.scene.thread.flexural_rigidity > 0.0

    @property
    def order(self) -> dict[str, Any]:
        """Of an estimate: exact unless the thread stretches."""
        return {"order": 0, "parameter": "T/EA", "small": self.stretch} if self.stretch else {"order": None}

    @property
    def beam(self) -> AxialFlowBeam:
        """The thread as a beam."""
        thread, free = self.scene.thread, self.scene.ends.b
        return AxialFlowBeam(
            length=thread.length,
            flexural_rigidity=thread.flexural_rigidity,
            mass=thread.mass,
            added_mass=self.scene.added_mass,
            tension=self.tension,
            ends=self.ends,
            taper=free.taper if isinstance(free, FreeEnd) else 0.0,
        )


def _ends_of(scene: ThreadScene) -> Ends:
    """How two fixed ends are held, along the chord if clamped."""
    a, b = scene.ends.a, scene.ends.b
    chord = np.subtract(*reversed(fixed_ends(scene)))
    assert isinstance(a, FixedEnd)
    assert isinstance(b, FixedEnd)
    clamps = [clamp for clamp in (a.clamp, b.clamp) if clamp is not None]
    require(len(clamps) != 1, "one end alone is clamped")
    for clamp in clamps:
        require(_same_way(np.array(clamp), chord), "a clamp bends the thread")
    return "clamped" if clamps else "pinned"


def _same_way(one: FloatArray, other: FloatArray) -> bool:
    size = float(np.linalg.norm(one) * np.linalg.norm(other))
    return bool(np.linalg.norm(np.cross(one, other)) <= _ROUNDING * size and one @ other > 0.0)


def _along(scene: ThreadScene) -> _Along:
    """The straight thread of a scene in a stream along it.

    Raises:
        NoAsymptoticError: with the reason why it is none.
    """
    require(scene.thread.reactive != "none", "no reaction of a liquid that streams along the thread is modelled")
    stream = stream_of(scene)
    require(isinstance(stream, UniformStream), "the stream is not uniform")
    assert isinstance(stream, UniformStream)
    require(scene.tangential_drag == scene.thread.viscous_drag == 0.0, "friction changes the tension, or the damping")
    require(scene.weight == 0.0 and not scene.load, "weight bends the thread")
    velocity = np.array(stream.velocity)
    speed = float(np.linalg.norm(velocity))
    a, b = scene.ends.a, scene.ends.b
    if isinstance(a, FixedEnd) and isinstance(b, FixedEnd):
        tension, stretch = _line(scene)
        way = np.subtract(b.position, a.position)
        require(_same_way(way, velocity) or _same_way(-way, velocity), "the stream does not go along the thread")
        return _Along(scene, tension, abs(stretch - 1.0), _ends_of(scene), speed)
    require(isinstance(a, FixedEnd) and isinstance(b, FreeEnd), "the upstream end A is not fixed, or B not free")
    assert isinstance(a, FixedEnd)
    assert isinstance(b, FreeEnd)
    require(a.clamp is not None and _same_way(np.array(a.clamp), velocity), "end A is not clamped along the stream")
    require(b.mass == b.added_mass == b.weight == b.drag_area == 0.0, "there is a body at the free end")
    force = np.array(b.force)
    require(not force.any() or _same_way(force, velocity), "the force on the free end is not along the stream")
    return _Along(scene, float(np.linalg.norm(force)), 0.0, "clamped-free", speed)


def _axial(scene: ThreadScene, count: int, place: int) -> ValueEstimate:
    thread = _along(scene)
    if thread.bends:
        values = thread.beam.exponents(thread.speed, min(count, _MOST_GALERKIN))
    else:
        values = string_in_axial_flow(
            scene.thread.length, thread.tension, scene.thread.mass, scene.added_mass, thread.speed, count
        )
    return ValueEstimate(
        name=_AXIAL,
        **thread.order,
        quantity=_LAMBDA,
        values=values,
        left_out=(thread.stretch + (_GALERKIN if thread.bends else 0.0)) * np.abs(values),
        measure=_exponents(place),
    )


def _exponents(place: int) -> Callable[[ThreadSolutionOfScene, NDArray[np.complex128]], Measured]:
    def measure(solution: ThreadSolutionOfScene, values: NDArray[np.complex128]) -> Measured:
        parts = (solution.modes[place].oscillating, solution.modes[place].aperiodic)
        roots, errors = (np.concatenate([getattr(part, name) for part in parts]) for name in ("values", "errors"))
        return nearest(values, roots, errors)

    return measure


def _threshold(scene: ThreadScene, place: int, kind: str) -> ValueEstimate:
    thread = _along(scene)
    asked = [analysis for analysis in scene.analysis if isinstance(analysis, ThreadStability)][place]
    speed = _threshold_speed(thread, kind)
    low, high = (factor * thread.speed for factor in (asked.factors[0], asked.factors[-1]))
    require(low <= speed <= high, f"at {speed:.6g} m/s, beyond the streams that are asked for")
    merged = thread.bends and kind == "flutter" and (thread.ends != "clamped-free" or thread.beam.taper == 1.0)

    def measure(solution: ThreadSolutionOfScene, values: FloatArray) -> Measured:
        found = [threshold for threshold in solution.stability[place].thresholds if threshold.kind == kind]
        if not found:
            return Measured(np.full(len(values), np.nan), np.full(len(values), np.nan))
        speeds = thread.speed * np.array([threshold.value for threshold in found])
        errors = thread.speed * np.array([threshold.error for threshold in found])
        return nearest(values, speeds, errors)

    return ValueEstimate(
        name=f"{_AXIAL}: {kind}",
        **thread.order,
        quantity=f"speed of {kind}, m/s",
        values=np.array([speed]),
        left_out=np.array([(thread.stretch + (_MERGED if merged else 0.0)) * speed]),
        measure=measure,
    )


def _threshold_speed(thread: _Along, kind: str) -> float:
    if not thread.bends:
        require(kind == "divergence", "a string in a stream diverges before it flutters")
        return sqrt(thread.tension / thread.scene.added_mass)
    if kind == "divergence":
        require(thread.ends != "clamped-free", "of a beam with a free end it is not known in closed form")
        return thread.beam.divergence_speed()
    try:
        return thread.beam.flutter()[0]
    except ValueError as error:
        raise NoAsymptoticError(str(error)) from error
