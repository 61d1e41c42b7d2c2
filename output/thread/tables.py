"""Tables of the results of a thread."""

from __future__ import annotations

from collections.abc import Iterator

from hydroelastic.output.digits import counted, number
from hydroelastic.output.provenance import SCENE, spent
from hydroelastic.output.quantity_tables import columns, headings, listed
from hydroelastic.output.reading import Reading
from hydroelastic.output.sections import Section
from hydroelastic.output.thread import quantities as thread

# Words for names of starts; others are printed as they are.
_STARTS = {
    "march": "the thread integrated from its free end",
    "taut": "a taut thread",
    "catenary": "a catenary",
    "hanging catenary": "a catenary without drag",
    "stretched catenary": "a stretched catenary",
}


def thread_sections(summary: Reading) -> Iterator[Section]:
    """Yield the tables of the equilibrium and of all analyses."""
    yield _equilibrium(summary)
    for modes in summary[thread.MODES]:
        yield _modes(modes)
    for sweep in summary[thread.STABILITY]:
        yield _stability(sweep)
    for motion in summary[thread.MOTION]:
        yield _motion(motion)


def _equilibrium(summary: Reading) -> Section:
    rest, scene = summary[thread.EQUILIBRIUM], summary[SCENE]
    # Without bending stiffness there are no moments.
    shown = rest if scene["thread"]["flexural_rigidity"] else rest.without(thread.END_MOMENTS, thread.MOMENT_ERROR)
    where = "in a vertical plane" if summary[thread.DERIVED][thread.DIMENSION] == 2 else "in space"
    steps = " + ".join(map(str, rest[thread.NEWTON_STEPS]))
    start = _STARTS.get(rest[thread.START], rest[thread.START])
    meshes = counted(len(rest[thread.NEWTON_STEPS]), "mesh")
    line = f"Found {where} by Newton's method, which began with {start}: {steps} steps on {meshes}."
    if scene["thread"]["tension"] is not None:
        line = "Straight, with the tension that is given."
    return Section(title="Equilibrium", headings=("quantity", "value"), rows=listed(shown), lines=(line,))


def _modes(modes: Reading) -> Section:
    oscillating, aperiodic = modes[thread.OSCILLATING], modes[thread.APERIODIC]
    overdamped = aperiodic[: len(oscillating)]
    names = [*(str(place) for place in range(1, len(oscillating) + 1)), *("–" * len(overdamped))]
    cells = columns([_shown(mode) for mode in (*oscillating, *overdamped)])
    lines = [] if modes[thread.STABLE] else ["The equilibrium is not stable: a motion grows."]
    if aperiodic:
        shown = f"; the {len(overdamped)} slowest are shown" if len(overdamped) < len(aperiodic) else ""
        lines.append(
            f"{len(aperiodic)} motions up to the magnitude of the last mode do not oscillate: they are "
            f"overdamped{shown}."
        )
    return Section(
        title="Free motions about the equilibrium",
        headings=("mode", *headings(thread.OSCILLATING)),
        rows=[(name, *row) for name, row in zip(names, cells, strict=True)],
        lines=tuple(lines),
    )


def _shown(mode: Reading) -> Reading:
    """A free motion as it is shown: no frequency without oscillation, no decay below its error, words of direction."""
    share = mode[thread.OUT_OF_PLANE]
    direction = None if share is None else "across the plane" if share > 0.5 else "in the plane"
    found = mode | {thread.OUT_OF_PLANE: direction}
    if not mode[thread.DAMPED_OMEGA] > 0.0:
        found |= {thread.DAMPED_OMEGA: None, thread.FREQUENCY: None}
    if abs(mode[thread.DECAY]) <= mode[thread.ROOT_ERROR] * mode[thread.ROOT_OMEGA]:
        found |= {thread.DECAY: 0.0, thread.DAMPING_RATIO: 0.0}
    return found


def _stability(sweep: Reading) -> Section:
    first, last = number(sweep[thread.FACTORS][0]), number(sweep[thread.FACTORS][-1])
    found = sweep[thread.THRESHOLDS]
    lines = [] if found else [f"No threshold between {first} and {last} times the stream."]
    if sweep[thread.ILL_POSED_FROM] is not None:
        lines.append(f"Ill-posed from {sweep.cell(thread.ILL_POSED_FROM)} on: {sweep[thread.ILL_POSED_REASON]}.")
    return Section(
        title=f"Stability, {first} to {last} times the stream",
        headings=headings(thread.THRESHOLDS),
        rows=columns(found),
        lines=tuple(lines),
    )


def _motion(motion: Reading) -> Section:
    size = f"{motion[thread.MOTION_STEPS]} steps, {motion[thread.MOTION_NODES]} nodes"
    return Section(
        title=f"Motion until {motion.cell(thread.UNTIL)} s, {size}",
        headings=("quantity", "value"),
        rows=listed(motion),
        lines=tuple(_slack(motion[thread.SLACK])),
    )


def _slack(times: list[Reading]) -> Iterator[str]:
    if not times:
        return
    worst = min(times, key=lambda entry: float(entry[thread.SLACK_TENSION]))
    yield (
        f"SLACK: {len(times)} times the thread would be in compression, first at {times[0].cell(thread.SLACK_FROM)} s; "
        f"worst {worst.cell(thread.SLACK_TENSION)} N at {worst.cell(thread.SLACK_AT)} m. A thread without bending "
        "stiffness folds there: later results are unreliable. Give it flexural_rigidity."
    )


def thread_cost(summary: Reading) -> str:
    """Return size and cost of the solution."""
    size = summary[thread.SIZE]
    steps = f", {size[thread.STEPS]} steps in time" if thread.STEPS in size else ""
    what = f"{size[thread.CELLS]} cells, degree {size[thread.DEGREE]}, {size[thread.DOFS]} unknowns{steps}"
    return f"{what}{spent(summary)}"
