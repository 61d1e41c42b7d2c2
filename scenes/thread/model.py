"""From the scene of a thread to what `modal` and `fem` take."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from math import inf
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.stream import (
    ShearedStream,
    Stream,
    TabulatedStream,
    UniformStream,
    VeeringStream,
)
from hydroelastic.physics.thread import PointLoad, Thread, ThreadEnd
from hydroelastic.physics.thread_load import ThreadLoad
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.models.thread_parts import CarriedBody, FixedEnd, FreeEnd, SurfaceEnd
from hydroelastic.scenes.thread.frame import Frame

Array = NDArray[np.float64]


@dataclass(frozen=True)
class _StreamInFrame:
    """A stream in the coordinates of a model, of which those across its plane are zero."""

    stream: Stream
    frame: Frame

    @property
    def breaks(self) -> tuple[float, ...]:
        return self.stream.breaks

    @cached_property
    def _axes(self) -> Array:
        return Frame(self.frame.direction, 3).axes

    def velocity_at(self, points: FloatArray) -> FloatArray:
        axes = self._axes
        return np.asarray(self.stream.velocity_at(points @ axes) @ axes.T)

    def gradient_at(self, points: FloatArray) -> FloatArray:
        axes = self._axes
        return np.asarray(axes @ self.stream.gradient_at(points @ axes) @ axes.T)

    def times(self, factor: float) -> _StreamInFrame:
        return replace(self, stream=self.stream.times(factor))


def stream_of(scene: ThreadScene) -> Stream | None:
    """The stream of a scene in (x, y, z); ``None`` if the liquid is at rest or there is none."""
    given = scene.stream
    if given is None or not scene.streams:
        return None

    def flat(velocity: tuple[float, float]) -> tuple[float, float, float]:
        return velocity[0], velocity[1], 0.0

    if given.veer is not None:
        return VeeringStream(given.veer.speed, given.veer.rate)
    if scene.profile is not None:
        levels = tuple(row[0] for row in scene.profile)
        return TabulatedStream(levels, tuple(flat((row[1], row[2])) for row in scene.profile), given.interpolation)
    assert given.velocity is not None
    if given.shear is not None:
        return ShearedStream(flat(given.velocity), flat(given.shear), given.level)
    return UniformStream(flat(given.velocity))


def with_stream_times(scene: ThreadScene, factor: float) -> ThreadScene:
    """The scene with all velocities of its stream multiplied by a factor, 0 for a liquid at rest."""
    given = scene.stream
    if given is None or factor == 1.0:
        return scene
    at_rest = {"velocity": None, "shear": None, "veer": None, "profile": None, "file": None}
    if factor == 0.0:
        return scene.model_copy(update={"stream": given.model_copy(update=at_rest)})
    changed: dict[str, Any] = dict(at_rest)
    if given.veer is not None:
        changed["veer"] = given.veer.model_copy(update={"speed": factor * given.veer.speed})
    elif scene.profile is not None:
        changed["profile"] = tuple((z, factor * x, factor * y) for z, x, y in scene.profile)
    for name in ("velocity", "shear"):
        vector = getattr(given, name)
        changed[name] = None if vector is None else (factor * vector[0], factor * vector[1])
    return scene.model_copy(update={"stream": given.model_copy(update=changed)})


def load_of(scene: ThreadScene) -> ThreadLoad:
    """Weight and drag of the thread at rest, per length."""
    return ThreadLoad(
        weight=scene.weight,
        normal_drag=scene.normal_drag,
        tangential_drag=scene.tangential_drag,
        viscous_drag=scene.thread.viscous_drag,
        stream=stream_of(scene),
    )


def dead_force(body: CarriedBody) -> Array:
    """The force of weight, and of what else is given, on a body, (x, y, z), N."""
    force = np.array([0.0, 0.0, -body.weight])
    if isinstance(body, FreeEnd):
        force += body.force
    elif isinstance(body, SurfaceEnd):
        force[:2] += body.force
    return force


def body_drag(scene: ThreadScene, body: CarriedBody) -> float:
    """The factor k of k|u|u, N·s²/m²."""
    return 0.5 * scene.density * body.drag_area


def model_of(scene: ThreadScene, frame: Frame) -> Thread:
    """The thread as the field solution takes it.

    Args:
        scene: the scene.
        frame: coordinates of the model.
    """
    thread, stream = scene.thread, stream_of(scene)

    def load(body: CarriedBody) -> PointLoad:
        return PointLoad(
            force=frame.inside(dead_force(body)),
            drag=body_drag(scene, body),
            mass=body.mass,
            added_mass=body.added_mass,
        )

    def end(given: FixedEnd | FreeEnd | SurfaceEnd) -> ThreadEnd:
        across = frame.dimension - 1
        if isinstance(given, FixedEnd):
            return ThreadEnd(
                load=PointLoad(force=np.zeros(frame.dimension)),
                held=(True,) * frame.dimension,
                position=frame.inside(np.array(given.position)),
                clamp=None if given.clamp is None else _unit(frame.inside(np.array(given.clamp))),
            )
        level = given.level if isinstance(given, SurfaceEnd) else 0.0
        return ThreadEnd(
            load=load(given),
            held=(False,) * across + (isinstance(given, SurfaceEnd),),
            position=np.array([0.0] * across + [level]),
            taper=given.taper if isinstance(given, FreeEnd) else 0.0,
        )

    return Thread(
        dimension=frame.dimension,
        length=thread.length,
        ends=(end(scene.ends.a), end(scene.ends.b)),
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
        stream=None if stream is None else _StreamInFrame(stream, frame),
        loads={body.at: load(body) for body in scene.load},
    )


def _unit(vector: Array) -> Array:
    return np.asarray(vector / np.linalg.norm(vector))
