"""The scene of a flexible thread in a stream: its model with all checks."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from math import dist, hypot

from pydantic import model_validator
from pydantic_core import InitErrorDetails

from hydroelastic.scenes.models.limits import is_at_least
from hydroelastic.scenes.models.problems import problem_at, require_fit
from hydroelastic.scenes.models.thread_analyses import EndMotion, ThreadMotion, ThreadStability
from hydroelastic.scenes.models.thread_parts import ThreadParts
from hydroelastic.scenes.models.thread_tables import CarriedBody, FixedEnd, SurfaceEnd

MOST_PROFILE_ROWS = 10_000
MOST_LOADS = 100
LEAST_DISTANCE = 1e-6
"""Of the length: bodies that are closer are at one place."""

LEAST_SLACK = 1e-9
"""Of the distance of the ends: a thread that does not stretch and is longer by less is straight."""

_WAYS = "velocity (and shear), veer, profile or file"

LEAST_MOTION_ROWS, MOST_MOTION_ROWS = 4, 20_000


class ThreadScene(ThreadParts):
    """A flexible thread in a stream.

    Raises:
        SceneError: if a value is not allowed or the parts do not fit together.
    """

    @model_validator(mode="after")
    def _parts_fit(self) -> ThreadScene:
        require_fit(self, STAGES)
        return self


def stream_is_given_once(scene: ThreadParts) -> Iterator[InitErrorDetails]:
    """The stream is given in one way, and its profile can be read."""
    stream = scene.stream
    if stream is None:
        return
    ways = [name for name in ("velocity", "veer", "profile", "file") if getattr(stream, name) is not None]
    if len(ways) > 1:
        yield problem_at(("stream", ways[1]), None, f"it is given beside {ways[0]}", allowed=f"one of {_WAYS}")
        return
    if stream.shear is not None and stream.velocity is None:
        yield problem_at(
            ("stream", "shear"), None, "there is no velocity that it adds to", remedy="Give velocity, if only [0, 0]"
        )
    if not ways or ways[0] not in ("profile", "file"):
        return
    key, value = ("stream", ways[0]), str(stream.file) if stream.file is not None else None
    try:
        rows = scene.profile
    except ValueError as error:
        yield problem_at(key, value, str(error))
        return
    assert rows is not None
    if not 2 <= len(rows) <= MOST_PROFILE_ROWS:
        yield problem_at(key, value, f"it holds {len(rows)} rows", allowed=f"2 to {MOST_PROFILE_ROWS} rows")
    for number, (below, above) in enumerate(pairwise(rows), start=2):
        if above[0] <= below[0]:
            yield problem_at(
                key, value, f"row {number} does not lie above that before it", allowed="heights that go up"
            )
            return


def liquid_acts_on_something(scene: ThreadParts) -> Iterator[InitErrorDetails]:
    """Coefficients of the liquid need a liquid and a diameter."""
    thread = scene.thread
    if thread.viscous_drag > 0.0 and scene.stream is None:
        yield problem_at(("thread", "viscous_drag"), thread.viscous_drag, "there is no liquid", remedy="Give [stream]")
    for name in ("normal_drag", "tangential_drag", "added_mass"):
        value = getattr(thread, name)
        if value == 0.0:
            continue
        if scene.stream is None:
            yield problem_at(
                ("thread", name), value, "there is no liquid", remedy="Give [stream] with its density, or leave it out"
            )
        elif thread.diameter is None:
            yield problem_at(
                ("thread", "diameter"), None, f"it is missing, and {name} needs it", allowed="a diameter in m"
            )
    bodies: list[tuple[tuple[str | int, ...], CarriedBody]] = []
    bodies += [(("load", place), body) for place, body in enumerate(scene.load)]
    bodies += [(("ends", name), end) for name, end in (("a", scene.ends.a), ("b", scene.ends.b)) if end.kind != "fixed"]
    for where, body in bodies:
        for name in ("drag_area", "added_mass"):
            if getattr(body, name) > 0.0 and scene.stream is None:
                yield problem_at((*where, name), getattr(body, name), "there is no liquid", remedy="Give [stream]")
    if thread.reactive != "none" and (thread.added_mass == 0.0 or not scene.streams):
        yield problem_at(
            ("thread", "reactive"),
            thread.reactive,
            "it takes a stream and an added mass",
            allowed='"none", or a stream and added_mass > 0',
        )
    if thread.stretch_drag == "volume" and thread.axial_rigidity is None:
        yield problem_at(
            ("thread", "stretch_drag"), thread.stretch_drag, "the thread does not stretch", allowed='"none" here'
        )


def bodies_lie_on_the_thread(scene: ThreadParts) -> Iterator[InitErrorDetails]:
    """Bodies and places of the report lie on the thread, bodies at places of their own."""
    length = scene.thread.length
    places = [load.at for load in scene.load]
    for number, place in enumerate(places):
        if place >= length:
            yield problem_at(
                ("load", number, "at"),
                place,
                "it does not lie between the ends",
                allowed=f"less than length = {length:.12g} m",
                remedy="What hangs on an end belongs to [ends]",
            )
        elif not is_at_least(min(place, length - place), LEAST_DISTANCE * length, beside=length):
            yield problem_at(
                ("load", number, "at"),
                place,
                "it is as good as at an end",
                allowed=f"{LEAST_DISTANCE:g} of the length from the ends at least",
                remedy="What hangs on an end belongs to [ends]",
            )
        elif any(abs(place - other) < LEAST_DISTANCE * length for other in places[:number]):
            yield problem_at(("load", number, "at"), place, "another body is there", remedy="Add the two up")
    if len(places) > MOST_LOADS:
        yield problem_at(("load",), len(places), "there are too many", allowed=f"up to {MOST_LOADS} bodies")
    if scene.positions[-1] > length:
        yield problem_at(
            ("output", "positions"),
            scene.positions[-1],
            "it lies beyond end B",
            allowed=f"0 to length = {length:.12g} m",
        )


def clamps_need_rigidity(scene: ThreadParts) -> Iterator[InitErrorDetails]:
    """A thread that does not resist bending cannot be clamped."""
    for name, end in (("a", scene.ends.a), ("b", scene.ends.b)):
        if end.kind != "fixed" or end.clamp is None:
            continue
        if scene.thread.flexural_rigidity == 0.0:
            yield problem_at(
                ("ends", name, "clamp"),
                None,
                "a thread without flexural rigidity turns freely at its ends",
                remedy="Give flexural_rigidity, or leave the clamp out",
            )
        elif hypot(*end.clamp) == 0.0:
            yield problem_at(("ends", name, "clamp"), None, "it has no direction", allowed="a vector other than 0")


def one_end_is_fixed(scene: ThreadParts) -> Iterator[InitErrorDetails]:
    """A thread without a fixed end would drift."""
    if scene.ends.a.kind != "fixed" and scene.ends.b.kind != "fixed":
        yield problem_at(
            ("ends", "a"),
            None,
            "neither end is fixed: the thread drifts off and has no equilibrium",
            allowed='kind = "fixed" for one end at least',
        )


def tension_is_determined(scene: ThreadParts) -> Iterator[InitErrorDetails]:
    """Two fixed ends of a thread that does not stretch must leave it longer than their distance."""
    a, b = scene.ends.a, scene.ends.b
    if a.kind != "fixed" or b.kind != "fixed" or scene.thread.axial_rigidity is not None:
        return
    chord, length = dist(a.position, b.position), scene.thread.length
    if scene.thread.tension is not None and abs(length - chord) <= 1e-10 * chord:
        return
    allowed = f"{chord * (1.0 + 2.0 * LEAST_SLACK):.12g} m or more, or axial_rigidity"
    if length < chord * (1.0 - 1e-12):
        yield problem_at(
            ("thread", "length"),
            length,
            f"the ends are {chord:.12g} m apart and the thread does not stretch",
            allowed=allowed,
        )
    elif length <= chord * (1.0 + LEAST_SLACK):
        yield problem_at(
            ("thread", "length"),
            length,
            f"it is within {LEAST_SLACK:g} of the distance of the fixed ends, {chord:.12g} m: a straight thread that "
            "does not stretch has no determined tension",
            allowed=f"{allowed}, or the key tension with a length equal to that distance",
        )


def given_tension_is_needed(scene: ThreadParts) -> Iterator[InitErrorDetails]:
    """A tension is given only where it is otherwise undetermined, and where no motion starts from another state."""
    given = scene.thread.tension
    if given is None:
        return
    a, b = scene.ends.a, scene.ends.b
    straight = (
        isinstance(a, FixedEnd)
        and isinstance(b, FixedEnd)
        and scene.thread.axial_rigidity is None
        and abs(dist(a.position, b.position) - scene.thread.length) <= 1e-10 * scene.thread.length
    )
    if not straight:
        yield problem_at(
            ("thread", "tension"),
            given,
            "the equilibrium determines the tension",
            allowed="a thread between fixed ends, as far apart as it is long, without axial_rigidity",
        )
    elif scene.motions:
        yield problem_at(
            ("thread", "tension"),
            given,
            "in a large motion of a straight thread that does not stretch no tension is determined",
            allowed='analyses "modes" and "stability", or axial_rigidity',
        )


def slack_thread_is_loaded(scene: ThreadParts) -> Iterator[InitErrorDetails]:
    """The shape of a slack thread without flexural rigidity is determined by its load."""
    if scene.thread.flexural_rigidity > 0.0:
        return
    dragged = scene.streams and scene.normal_drag + scene.tangential_drag + scene.thread.viscous_drag > 0.0
    if scene.weight != 0.0 or dragged or any(_pulls(scene, load) for load in scene.load):
        yield from _slack_along_a_line(scene)
        return
    a, b = scene.ends.a, scene.ends.b
    if isinstance(a, FixedEnd) and isinstance(b, FixedEnd):
        if dist(a.position, b.position) < scene.thread.length:
            yield problem_at(
                ("thread", "weight"),
                scene.weight,
                "nothing loads the thread, and between its ends it is slack: its shape is undetermined",
                remedy="Give weight, a stream that drags, a shorter length or flexural_rigidity",
            )
        return
    for name, end in (("a", a), ("b", b)):
        if not isinstance(end, FixedEnd) and not _pulls(scene, end) and not any(end.force):
            yield problem_at(
                ("ends", name),
                None,
                "nothing pulls at this end or along the thread: its shape is undetermined",
                remedy="Give a force or a weight",
            )


def _pulls(scene: ThreadParts, body: object) -> bool:
    weight, area = getattr(body, "weight", 0.0), getattr(body, "drag_area", 0.0)
    return bool(weight != 0.0 or (area > 0.0 and scene.streams))


def _slack_along_a_line(scene: ThreadParts) -> Iterator[InitErrorDetails]:
    """A slack thread whose whole load acts along the chord folds: part of it has no tension, and its shape is
    undetermined."""
    a, b = scene.ends.a, scene.ends.b
    if not isinstance(a, FixedEnd) or not isinstance(b, FixedEnd) or scene.load:
        return
    if dist(a.position, b.position) >= scene.thread.length:
        return
    x, y, z = (last - first for first, last in zip(a.position, b.position, strict=True))
    stream = scene.stream
    if stream is not None and stream.velocity is not None and stream.shear is None and scene.weight == 0.0:
        if z == 0.0 and stream.velocity[0] * y == stream.velocity[1] * x:
            yield problem_at(
                ("thread", "length"),
                scene.thread.length,
                "the stream runs along the line between the ends, and the downstream part of a slack thread without "
                "weight has no tension there: its shape is indeterminate",
                remedy="Give weight, flexural_rigidity, a stream at an angle, or a length below the ends' distance",
            )
    elif not scene.streams and x == y == 0.0:
        yield problem_at(
            ("thread", "length"),
            scene.thread.length,
            "both ends lie on one vertical, and the thread folds at its lowest point with no tension there",
            remedy="Give flexural_rigidity, or set the ends apart",
        )


def reactive_tail_is_stiff(scene: ThreadParts) -> Iterator[InitErrorDetails]:
    """A tail without tension in a stream along it has a reactive model only if it resists bending."""
    if scene.thread.reactive == "none" or scene.thread.flexural_rigidity > 0.0:
        return
    for name, end in (("a", scene.ends.a), ("b", scene.ends.b)):
        if end.kind == "free" and not _pulls(scene, end) and not any(end.force):
            yield problem_at(
                ("thread", "reactive"),
                scene.thread.reactive,
                f"near the free end {name.upper()} the tension falls below that required by the moving liquid: without "
                "flexural rigidity the problem is ill-posed",
                allowed='"none", or flexural_rigidity > 0, or a force on the end',
            )


def analyses_can_be_done(scene: ThreadParts) -> Iterator[InitErrorDetails]:
    """Motions need mass, stability a stream."""
    for number, analysis in enumerate(scene.analysis):
        if isinstance(analysis, ThreadStability) and not scene.streams:
            yield problem_at(
                ("analysis", number, "kind"), analysis.kind, "there is no stream", allowed='"modes" or "motion"'
            )
        if isinstance(analysis, ThreadStability) and len(analysis.factors) < 2:
            yield problem_at(
                ("analysis", number, "factors"), analysis.factors[0], "there is one", allowed="two or more factors"
            )
        if isinstance(analysis, ThreadMotion):
            yield from motion_can_be_followed(scene, analysis, ("analysis", number))
    if scene.analysis and scene.thread.mass == 0.0:
        yield problem_at(("thread", "mass"), 0.0, f"the analysis {scene.analysis[0].kind} needs it", allowed="> 0")


STAGES = (
    (stream_is_given_once, bodies_lie_on_the_thread),
    (liquid_acts_on_something, clamps_need_rigidity, one_end_is_fixed),
    (
        tension_is_determined,
        given_tension_is_needed,
        slack_thread_is_loaded,
        reactive_tail_is_stiff,
        analyses_can_be_done,
    ),
)
"""Checks in stages: a later one needs what the earlier ones have found in order."""


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
