"""Conversion of the scene of a thread to physical values in SI units."""

from __future__ import annotations

from collections.abc import Sequence
from math import inf

import numpy as np

from hydroelastic.fem.thread.frame import Frame, choose_frame
from hydroelastic.fem.thread.motion_request import MotionRequest
from hydroelastic.physics.stream import ShearedStream, Stream, TabulatedStream, UniformStream, VeeringStream
from hydroelastic.physics.thread import PointLoad, Thread, ThreadEnd
from hydroelastic.physics.thread_motion import EndDisplacement, VortexShedding
from hydroelastic.scenes.models import thread_analyses as analyses
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.models.thread_tables import CarriedBody, FixedEnd, FreeEnd, SurfaceEnd


def thread_of(scene: ThreadScene) -> Thread:
    """The thread of a scene, in space."""
    thread = scene.thread
    return Thread(
        length=thread.length,
        ends=(_end(scene, scene.ends.a), _end(scene, scene.ends.b)),
        weight=scene.weight,
        axial_rigidity=thread.axial_rigidity or inf,
        flexural_rigidity=thread.flexural_rigidity,
        normal_drag=scene.normal_drag,
        tangential_drag=scene.tangential_drag,
        viscous_drag=thread.viscous_drag,
        mass=thread.mass,
        added_mass=scene.added_mass,
        reactive=thread.reactive,
        stretch_drag=thread.stretch_drag,
        stream=_stream(scene),
        loads={body.at: _load(scene, body) for body in scene.load},
        tension=thread.tension,
    )


def _load(scene: ThreadScene, body: CarriedBody, force: Sequence[float] = (0.0, 0.0, 0.0)) -> PointLoad:
    return PointLoad(
        force=np.array(force),
        weight=body.weight,
        drag=0.5 * scene.density * body.drag_area,
        mass=body.mass,
        added_mass=body.added_mass,
    )


def _end(scene: ThreadScene, end: FixedEnd | FreeEnd | SurfaceEnd) -> ThreadEnd:
    if isinstance(end, FixedEnd):
        return ThreadEnd.fixed_at(end.position, end.clamp)
    if isinstance(end, FreeEnd):
        return ThreadEnd.free_with(_load(scene, end, end.force), taper=end.taper)
    return ThreadEnd.at_surface(end.level, _load(scene, end, (*end.force, 0.0)))


def _stream(scene: ThreadScene) -> Stream | None:
    given = scene.stream
    if given is None or not scene.streams:
        return None
    if given.veer is not None:
        return VeeringStream(given.veer.speed, given.veer.rate)
    if scene.profile is not None:
        levels = tuple(row[0] for row in scene.profile)
        return TabulatedStream(levels, tuple((x, y, 0.0) for _, x, y in scene.profile), given.interpolation)
    assert given.velocity is not None
    if given.shear is not None:
        return ShearedStream((*given.velocity, 0.0), (*given.shear, 0.0), given.level)
    return UniformStream((*given.velocity, 0.0))


def motion_request_of(scene: ThreadScene, asked: analyses.ThreadMotion) -> MotionRequest:
    """A motion that a scene asks for."""
    shedding = None
    if asked.vortices is not None:
        diameter = scene.thread.diameter
        assert diameter is not None
        shedding = VortexShedding(
            lift=0.5 * scene.density * diameter * asked.vortices.lift, wave_number=asked.vortices.strouhal / diameter
        )

    def displacements(name: analyses.EndName) -> tuple[EndDisplacement, ...]:
        return tuple(
            EndDisplacement(
                velocity=move.velocity,
                amplitude=move.amplitude,
                omega=move.omega,
                phase=move.phase,
                rise=move.rise,
                table=scene.table_of(move),
            )
            for move in asked.move
            if move.end == name
        )

    def release(name: analyses.EndName) -> float:
        return min((release.time for release in asked.release if release.end == name), default=inf)

    return MotionRequest(
        times=asked.times,
        start=asked.start,
        direction=asked.direction,
        displacements=(displacements("a"), displacements("b")),
        releases=(release("a"), release("b")),
        shedding=shedding,
        spectral_radius=asked.spectral_radius if asked.integrator == "generalized_alpha" else None,
        step=asked.step,
        tolerance=asked.tolerance,
    )


def frame_of(scene: ThreadScene) -> Frame:
    """The coordinates in which a scene is solved: in space if modes are asked for, which go in all directions."""
    motions = [motion_request_of(scene, motion) for motion in scene.motions]
    return choose_frame(thread_of(scene), motions, in_space=len(motions) < len(scene.analysis))


# Of the length: a line that hangs less far below its end lies along the bed there.
_BELOW = 1e-3


def no_sea_bed(scene: ThreadScene, heights: Sequence[float], lowest: float) -> str | None:
    """Say that no sea bed is modelled if a line in a liquid hangs below its lower end, which is fixed as an anchor
    is."""
    length, (lower, upper) = scene.thread.length, sorted(heights)
    end = scene.ends.a if heights[0] == lower else scene.ends.b
    # With a mass and without a liquid it hangs in air, where there is no sea bed.
    in_liquid = scene.stream is not None or scene.thread.weight is not None
    if (
        not in_liquid
        or not isinstance(end, FixedEnd)
        or upper - lower < _BELOW * length
        or lower - lowest < _BELOW * length
    ):
        return None
    return (
        f"No sea bed is modelled: the line hangs down to z = {lowest:.6g} m, {lower - lowest:.4g} m below its lower "
        "fixed end. If that is an anchor on the bed, a part of the real line lies there, and its shape, its tensions "
        "and the forces at its ends differ from these."
    )
