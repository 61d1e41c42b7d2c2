"""Layers of a thread: where it is clamped, and where it comes to the critical line away from a towed body."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from math import acos

import numpy as np
from mpi4py import MPI

from hydroelastic.modal.thread.clamp_layer import ClampLayer
from hydroelastic.modal.thread.critical import critical_direction, towed_body_exponent
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.stream import UniformStream
from hydroelastic.scenes.errors import UnsolvedError
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.models.thread_analyses import EndName
from hydroelastic.scenes.models.thread_parts import FixedEnd, FreeEnd
from hydroelastic.scenes.thread.equilibrium import find_equilibrium
from hydroelastic.scenes.thread.estimate import (
    Found,
    Inapplicable,
    Measured,
    ValueEstimate,
    attempted,
    require,
    require_bare_thread,
)
from hydroelastic.scenes.thread.frame import frame_of
from hydroelastic.scenes.thread.model import load_of, stream_of
from hydroelastic.scenes.thread.results import ThreadSolutionOfScene
from hydroelastic.scenes.thread.starts import force_on

_CLAMP, _TOWED = "layer at the clamp {end}", "approach to the critical line"
# Angle to the critical line above which it is not near, rad.
_NEAR = 0.05
# Times the error of an angle: nearer to the line its logarithm has no digits.
_CERTAIN = 100.0


def clamp_estimates(scene: ThreadScene, comm: MPI.Comm) -> Iterator[Found]:
    """Yield the moment of each clamp from the thread without bending stiffness, which is solved for (collective)."""
    names: tuple[EndName, ...] = ("a", "b")
    clamped = [name for name in names if getattr(getattr(scene.ends, name), "clamp", None) is not None]
    if not clamped:
        return
    frame, loose = frame_of(scene), _without_bending(scene)
    try:
        profile = find_equilibrium(comm, loose, frame).solution.profile
    except UnsolvedError as error:
        yield from (Inapplicable(_CLAMP.format(end=name.upper()), f"without bending: {error}") for name in clamped)
        return
    forces = frame.outside(profile.contact_force(profile.nodes[[0, -1]]))
    for name in clamped:
        force = forces[names.index(name)]
        yield attempted(_CLAMP.format(end=name.upper()), partial(_clamp, scene, name, force))


def _without_bending(scene: ThreadScene) -> ThreadScene:
    ends = {
        name: end.model_copy(update={"clamp": None}) if isinstance(end, FixedEnd) else end
        for name, end in (("a", scene.ends.a), ("b", scene.ends.b))
    }
    return scene.model_copy(
        update={
            "thread": scene.thread.model_copy(update={"flexural_rigidity": 0.0}),
            "ends": scene.ends.model_copy(update=ends),
        }
    )


def _clamp(scene: ThreadScene, name: EndName, force: FloatArray) -> ValueEstimate:
    end, place = getattr(scene.ends, name), 0 if name == "a" else 1
    clamp, tension = np.array(end.clamp), float(np.linalg.norm(force))
    require(tension > 0.0, "without bending there is no tension at the clamp")
    cosine = float(clamp @ force) / (float(np.linalg.norm(clamp)) * tension)
    layer = ClampLayer(
        flexural_rigidity=scene.thread.flexural_rigidity,
        tension=tension,
        angle=acos(min(1.0, max(-1.0, cosine))),
        length=scene.thread.length,
    )

    def measure(solution: ThreadSolutionOfScene, _values: FloatArray) -> Measured:
        return Measured(solution.rest.end_moments[[place]], np.array([solution.rest.moment_error]))

    return ValueEstimate(
        name=_CLAMP.format(end=name.upper()),
        order=0,
        parameter="√(EI/T)/L",
        small=layer.small,
        quantity=f"moment at {name.upper()}, N·m",
        values=np.array([layer.moment]),
        left_out=np.array([layer.small * layer.moment]),
        measure=measure,
    )


def towed_estimates(scene: ThreadScene) -> Iterator[Found]:
    """Yield the exponent with which a thread in a uniform stream comes to its critical line, or why there is none."""
    yield attempted(_TOWED, partial(_towed, scene))


def _towed(scene: ThreadScene) -> ValueEstimate:
    require(isinstance(scene.ends.a, FixedEnd) and isinstance(scene.ends.b, FreeEnd), "A is not fixed, or B not free")
    assert isinstance(scene.ends.b, FreeEnd)
    require_bare_thread(scene, stretch=False)
    require(bool(np.any(force_on(scene, scene.ends.b)(np.zeros(3)))), "no force and no body pulls at the end")
    stream, load = stream_of(scene), load_of(scene)
    require(isinstance(stream, UniformStream), "there is no uniform stream")
    assert isinstance(stream, UniformStream)
    require(load.viscous_drag == 0.0, "the drag is not quadratic")
    require(scene.weight != 0.0, "without weight the critical line is level")
    speed = float(np.linalg.norm(stream.velocity))
    exponent = towed_body_exponent(scene.weight, load.normal_drag * speed**2, load.tangential_drag * speed**2)
    direction, _ = critical_direction(load, np.zeros(3))

    def measure(solution: ThreadSolutionOfScene, _values: FloatArray) -> Measured:
        return _measured_exponent(solution, direction)

    return ValueEstimate(
        name=_TOWED,
        order=0,
        parameter="angle to the critical line",
        small=_NEAR,
        quantity="exponent k of angle ∝ Tᵏ",
        values=np.array([exponent]),
        left_out=np.array([_NEAR * abs(exponent)]),
        measure=measure,
    )


def _measured_exponent(solution: ThreadSolutionOfScene, direction: FloatArray) -> Measured:
    """The slope of the logarithms between the two places nearest to the critical line that still have digits."""
    rest = solution.rest
    tangents = rest.forces / np.linalg.norm(rest.forces, axis=1, keepdims=True)
    angles = np.arcsin(np.minimum(np.linalg.norm(np.cross(tangents, direction), axis=1), 1.0))
    error = rest.tension_error / rest.tensions
    certain = np.flatnonzero((angles > _CERTAIN * error) & (angles < _NEAR))
    if len(certain) < 2:
        return Measured(np.array([np.nan]), np.array([np.nan]))
    first, second = certain[:2]
    stretch = float(np.log(rest.tensions[first] / rest.tensions[second]))
    slope = float(np.log(angles[first] / angles[second])) / stretch
    wrong = (error[first] / angles[first] + error[second] / angles[second]) / abs(stretch)
    return Measured(np.array([slope]), np.array([wrong]))
