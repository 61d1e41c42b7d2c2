"""Description of the model of a thread before anything is solved."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator

import numpy as np

from hydroelastic.fem.cost import cost
from hydroelastic.modal.thread.fixed_end_estimates import catenary_of
from hydroelastic.modal.thread.shape import NoAsymptoticError, NoTensionError
from hydroelastic.output.digits import number
from hydroelastic.output.sections import Row, Section
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.models.thread_analyses import ThreadModes, ThreadMotion, ThreadStability
from hydroelastic.scenes.models.thread_tables import FixedEnd, FreeEnd, SurfaceEnd
from hydroelastic.scenes.thread.physics import frame_of, no_sea_bed, thread_of

# Of a usual mesh; solutions at rest, for each mode, factor of the stream and step; steps, s/√m. Measured.
_ELEMENTS, _DEGREE = 40, 5
_AT_REST, _OF_MODES, _OF_FACTORS, _OF_STEPS, _STEP = 40.0, 5.0, 30.0, 0.5, 0.006
# Of the catenary, whose lowest point lies between two of them.
_PLACES = 1001


def check_thread(scene: ThreadScene) -> Iterator[Section]:
    """Yield the equations, unknown fields, stream, ends and loads, and analyses."""
    yield Section(title="Equations", lines=tuple(_thread(scene)))
    yield Section(title="Unknown fields", headings=("field", "where", "why"), rows=tuple(_unknowns(scene)))
    yield Section(title="Stream", lines=tuple(_stream(scene)))
    yield Section(title="Ends and loads", lines=tuple(_held(scene)))
    yield Section(title="What is asked", lines=tuple(_asked(scene)))


def _unknowns(scene: ThreadScene) -> Iterator[Row]:
    thread = scene.thread
    where = "in a vertical plane, in which all loads lie" if frame_of(scene).dimension == 2 else "in space"
    yield "r", "thread", f"position, {where}; displacements and turns of any size"
    if thread.tension is not None:
        yield "T: none", "thread", "the tension is given"
    elif thread.axial_rigidity is None:
        yield "T", "thread", "tension, the force that keeps |r_s| = 1"
    else:
        yield "T", "thread", "tension, which stretches the thread by Hooke's law"
    if thread.flexural_rigidity:
        yield "moment", "thread", "EI times the curvature, and the shear force that goes with it"
    else:
        yield "moment: none", "thread", "the thread does not resist bending"
    if scene.stream is not None:
        yield "liquid: none", "around the thread", "its stream is given, and acts by drag and added mass at each place"


def _thread(scene: ThreadScene) -> Iterator[str]:
    thread = scene.thread
    yield "N_s + q = 0, N = Tτ" + (" + shear of bending" if thread.flexural_rigidity else "") + ", τ = r_s/|r_s|."
    stretch = (
        "|r_s| = 1 (it does not stretch)"
        if thread.axial_rigidity is None
        else f"|r_s| = 1 + T/EA, EA = {number(thread.axial_rigidity)} N"
    )
    bend = f"; EI = {number(thread.flexural_rigidity)} N·m²" if thread.flexural_rigidity else "; no bending stiffness"
    yield f"{stretch}{bend}."
    yield f"Length {number(thread.length)} m, weight in the liquid {number(scene.weight)} N/m."
    if thread.reactive != "none":
        model = {"moving_load": "a load that moves with the stream", "lighthill": "Lighthill's momentum"}
        yield f"The added mass {number(scene.added_mass)} kg/m is {model[thread.reactive]}."


def _stream(scene: ThreadScene) -> Iterator[str]:
    stream = scene.stream
    if stream is None:
        yield "No liquid."
        return
    kind = "at rest"
    if stream.veer is not None:
        kind = f"of {number(stream.veer.speed)} m/s that turns by {number(stream.veer.rate)} rad/m"
    elif scene.profile is not None:
        kind = f"by a table of {len(scene.profile)} heights, {stream.interpolation} between them"
    elif stream.velocity is not None:
        x, y = stream.velocity
        kind = f"({number(x)}, {number(y)}) m/s"
        if stream.shear is not None:
            x, y = stream.shear
            kind += f" + ({number(x)}, {number(y)}) 1/s × (z − {number(stream.level)} m)"
    yield f"Stream {kind}; density {number(stream.density)} kg/m³."
    parts = [
        f"{label} = {number(value)} {unit}"
        for label, value, unit in (
            ("kn", scene.normal_drag, "N·s²/m³"),
            ("kt", scene.tangential_drag, "N·s²/m³"),
            ("nv", scene.thread.viscous_drag, "N·s/m²"),
        )
        if value
    ]
    yield f"Drag kn|u_n|u_n + kt|u_t|u_t τ: {', '.join(parts)}." if parts else "No drag."


def _held(scene: ThreadScene) -> Iterator[str]:
    for name, end in (("A", scene.ends.a), ("B", scene.ends.b)):
        yield f"End {name}: {_end(end)}."
    yield from _bed(scene)
    if scene.load:
        yield f"{len(scene.load)} bodies on the thread, at {', '.join(number(load.at) for load in scene.load)} m."


def _bed(scene: ThreadScene) -> Iterator[str]:
    """Whether the line alone, a catenary, hangs below its anchor; of a stream or bodies on it only a run knows."""
    if scene.stream is None and scene.thread.weight is None:
        return
    words = None
    if not scene.load:
        thread, a, b = thread_of(scene), scene.ends.a, scene.ends.b
        with contextlib.suppress(NoAsymptoticError, NoTensionError):
            shape = catenary_of(thread, np.linspace(0.0, thread.length, _PLACES))
            assert isinstance(a, FixedEnd)
            assert isinstance(b, FixedEnd)
            words = no_sea_bed(scene, (a.position[2], b.position[2]), float(shape.positions[:, 2].min()))
    yield words or "No sea bed is modelled."


def _end(end: FixedEnd | FreeEnd | SurfaceEnd) -> str:
    if isinstance(end, FixedEnd):
        place = ", ".join(number(value) for value in end.position)
        return f"fixed at ({place}) m, " + ("turns freely" if end.clamp is None else "clamped")
    carried = [f"weight {number(end.weight)} N"] if end.weight else []
    carried += [f"force ({', '.join(number(value) for value in end.force)}) N"] if any(end.force) else []
    carried += [f"drag of C A = {number(end.drag_area)} m²"] if end.drag_area else []
    held = f"kept at z = {number(end.level)} m, drifting" if isinstance(end, SurfaceEnd) else "free"
    return f"{held}, with {' and '.join(carried)}" if carried else held


def _asked(scene: ThreadScene) -> Iterator[str]:
    dimension = frame_of(scene).dimension
    where = "in a vertical plane" if dimension == 2 else "in space"
    yield f"Equilibrium {where}: {scene.accuracy.tolerance:g} of length and largest tension asked."
    solutions = _AT_REST
    for analysis in scene.analysis:
        if isinstance(analysis, ThreadModes):
            damping = "" if analysis.velocity_damping else ", without the damping by the stream"
            solutions += _OF_MODES * analysis.count
            yield f"Modes: {analysis.count} that oscillate{damping}."
        elif isinstance(analysis, ThreadStability):
            solutions += _OF_FACTORS * len(analysis.factors)
            first, last = analysis.factors[0], analysis.factors[-1]
            yield f"Stability: the stream times {number(first)} to {number(last)}, {len(analysis.factors)} steps."
        else:
            assert isinstance(analysis, ThreadMotion)
            step = analysis.step or _STEP * scene.thread.length**0.5
            solutions += _OF_STEPS * analysis.times[-1] / step
            steps = "adaptive steps" if analysis.step is None else f"steps of {number(analysis.step)} s"
            rule = {"midpoint": "the midpoint rule", "generalized_alpha": "generalised-α"}[analysis.integrator]
            asked = f"{analysis.tolerance:g} of length asked"
            yield f"Motion until {number(analysis.times[-1])} s by {rule}, {steps}; {asked}."
    yield str(cost(_ELEMENTS * _DEGREE * (dimension + 1), _DEGREE, solutions, "thread"))
