"""Checks of the consistency of a motion of a thread in time."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from math import dist, hypot

from pydantic_core import InitErrorDetails

from hydroelastic.scenes.models.problems import problem_at
from hydroelastic.scenes.models.thread_analyses import EndMotion, ThreadMotion
from hydroelastic.scenes.models.thread_parts import ThreadParts
from hydroelastic.scenes.models.thread_tables import FixedEnd, SurfaceEnd

LEAST_MOTION_ROWS, MOST_MOTION_ROWS = 4, 20_000


def motion_can_be_followed(
    scene: ThreadParts, motion: ThreadMotion, where: tuple[str | int, ...]
) -> Iterator[InitErrorDetails]:
    """Only fixed ends are moved or released; a straight start needs a free end."""
    ends = {"a": scene.ends.a, "b": scene.ends.b}
    named = [("move", place, move.end) for place, move in enumerate(motion.move)]
    named += [("release", place, release.end) for place, release in enumerate(motion.release)]
    for name, place, end in named:
        if not isinstance(ends[end], FixedEnd):
            yield problem_at((*where, name, place, "end"), end, "this end is not fixed", allowed="a fixed end")
    for place, move in enumerate(motion.move):
        yield from _table(scene, motion, move, (*where, "move", place, "file"))
    if motion.times[-1] == 0.0:
        yield problem_at((*where, "times"), 0.0, "nothing moves by then", allowed="a last time > 0")
    yield from _releases(scene, motion, where)
    yield from _integrator(scene, motion, where)
    if motion.vortices is not None and (scene.stream is None or scene.normal_drag == 0.0):
        yield problem_at((*where, "vortices"), None, "it takes a liquid and drag across the thread", remedy="Give both")
    if motion.start == "straight":
        yield from _straight_start(scene, motion, where)


def _releases(scene: ThreadParts, motion: ThreadMotion, where: tuple[str | int, ...]) -> Iterator[InitErrorDetails]:
    """Each end is released once, within the motion; reactive models do not admit a release."""
    ends = [release.end for release in motion.release]
    for place, release in enumerate(motion.release):
        key = (*where, "release", place)
        if release.end in ends[:place]:
            yield problem_at((*key, "end"), release.end, "it is let go twice", allowed="each end once")
        if release.time >= motion.times[-1]:
            yield problem_at(
                (*key, "time"), release.time, "the motion ends before", allowed=f"less than {motion.times[-1]:.12g} s"
            )
        if scene.thread.reactive != "none":
            yield problem_at(
                (*key, "end"), release.end, "an end is released with a reactive model", allowed='reactive = "none"'
            )


def _integrator(scene: ThreadParts, motion: ThreadMotion, where: tuple[str | int, ...]) -> Iterator[InitErrorDetails]:
    """Generalised α damps fast stretching, and does not include the momentum of the liquid."""
    if motion.integrator != "generalized_alpha":
        return
    key = (*where, "integrator")
    if scene.thread.axial_rigidity is None:
        yield problem_at(
            key,
            motion.integrator,
            "the thread does not stretch, and has no fast stretching to damp",
            allowed='"midpoint", or axial_rigidity',
        )
    elif scene.thread.reactive == "lighthill":
        yield problem_at(key, motion.integrator, "Lighthill's momentum needs the midpoint rule", allowed='"midpoint"')


def _straight_start(
    scene: ThreadParts, motion: ThreadMotion, where: tuple[str | int, ...]
) -> Iterator[InitErrorDetails]:
    a, b = scene.ends.a, scene.ends.b
    size = hypot(*motion.direction)
    if size == 0.0:
        yield problem_at((*where, "direction"), None, "it has no direction", allowed="a vector other than 0")
        return
    if isinstance(a, FixedEnd) and isinstance(b, FixedEnd):
        allowed = '"equilibrium" or "still_liquid"'
        yield problem_at((*where, "start"), motion.start, "both ends are fixed", allowed=allowed)
        return
    way = [part / size for part in motion.direction]
    for held, other, sign in ((a, b, 1.0), (b, a, -1.0)):
        if not isinstance(held, FixedEnd):
            continue
        level = held.position[2] + sign * scene.thread.length * way[2]
        if isinstance(other, SurfaceEnd) and abs(level - other.level) > 1e-6 * scene.thread.length:
            yield problem_at(
                (*where, "direction"),
                None,
                f"it puts the other end at z = {level:.12g} m",
                allowed=f"a direction by which it is at its level, {other.level:.12g} m",
            )
        if held.clamp is not None and dist(way, [part / hypot(*held.clamp) for part in held.clamp]) > 1e-6:
            yield problem_at((*where, "direction"), None, "the end is clamped in another", allowed="that of the clamp")


def _table(
    scene: ThreadParts, motion: ThreadMotion, move: EndMotion, key: tuple[str | int, ...]
) -> Iterator[InitErrorDetails]:
    """The motion of an end by a table begins at t = 0 and covers the requested times."""
    if move.file is None:
        return
    value = str(move.file)
    try:
        rows = scene.table_of(move)
    except ValueError as error:
        yield problem_at(key, value, str(error))
        return
    if not LEAST_MOTION_ROWS <= len(rows) <= MOST_MOTION_ROWS:
        allowed = f"{LEAST_MOTION_ROWS} to {MOST_MOTION_ROWS} rows"
        yield problem_at(key, value, f"it holds {len(rows)} rows", allowed=allowed)
        return
    times = [row[0] for row in rows]
    if any(after <= before for before, after in pairwise(times)):
        yield problem_at(key, value, "its times do not go up", allowed="times that go up")
    elif times[0] != 0.0 or times[-1] < motion.times[-1]:
        yield problem_at(
            key,
            value,
            f"its times go from {times[0]:.12g} to {times[-1]:.12g} s",
            allowed=f"from 0 to {motion.times[-1]:.12g} s at least",
        )
