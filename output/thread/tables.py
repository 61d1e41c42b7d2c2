"""Tables of the results of a thread."""

from __future__ import annotations

from collections.abc import Iterator

from hydroelastic.output.digits import counted, number
from hydroelastic.output.provenance import Summary, spent
from hydroelastic.output.quantity_tables import columns, headings, listed
from hydroelastic.output.sections import Section
from hydroelastic.output.thread.quantities import EQUILIBRIUM, MODES, MOTION, THRESHOLDS

# Words for names of starts; others are printed as they are.
_STARTS = {
    "march": "the thread integrated from its free end",
    "taut": "a taut thread",
    "catenary": "a catenary",
    "hanging catenary": "a catenary without drag",
    "stretched catenary": "a stretched catenary",
}


def thread_sections(summary: Summary) -> Iterator[Section]:
    """Yield the tables of the equilibrium and of all analyses."""
    yield _equilibrium(summary)
    for modes in summary["modes"]:
        yield _modes(modes)
    for sweep in summary["stability"]:
        yield _stability(sweep)
    for motion in summary["motion"]:
        yield _motion(motion)


def _equilibrium(summary: Summary) -> Section:
    rest, thread = summary["equilibrium"], summary["scene"]["thread"]
    # Without bending stiffness there are no moments.
    absent = () if thread["flexural_rigidity"] else ("end_moments", "moment_error")
    shown = {key: value for key, value in rest.items() if key not in absent}
    where = "in a vertical plane" if summary["thread"]["dimension"] == 2 else "in space"
    steps = " + ".join(str(count) for count in rest["newton_steps"])
    start = _STARTS.get(rest["start"], rest["start"])
    meshes = counted(len(rest["newton_steps"]), "mesh")
    line = f"Found {where} by Newton's method, which began with {start}: {steps} steps on {meshes}."
    if thread["tension"] is not None:
        line = "Straight, with the tension that is given."
    return Section(title="Equilibrium", headings=("quantity", "value"), rows=listed(EQUILIBRIUM, shown), lines=(line,))


def _modes(modes: Summary) -> Section:
    oscillating, aperiodic = modes["oscillating"], modes["aperiodic"]
    overdamped = aperiodic[: len(oscillating)]
    names = [*(str(place) for place in range(1, len(oscillating) + 1)), *("–" * len(overdamped))]
    cells = columns(MODES["oscillating"], [_shown(mode) for mode in (*oscillating, *overdamped)])
    lines = [] if modes["stable"] else ["The equilibrium is not stable: a motion grows."]
    if aperiodic:
        shown = f"; the {len(overdamped)} slowest are shown" if len(overdamped) < len(aperiodic) else ""
        lines.append(
            f"{len(aperiodic)} motions up to the magnitude of the last mode do not oscillate: they are "
            f"overdamped{shown}."
        )
    return Section(
        title="Free motions about the equilibrium",
        headings=("mode", *headings(MODES["oscillating"])),
        rows=[(name, *row) for name, row in zip(names, cells, strict=True)],
        lines=tuple(lines),
    )


def _shown(mode: Summary) -> Summary:
    """A free motion as it is shown: no frequency without oscillation, no decay below its error, words of direction."""
    share = mode["out_of_plane"]
    direction = None if share is None else "across the plane" if share > 0.5 else "in the plane"
    found = mode | {"out_of_plane": direction}
    if not mode["damped_omega"] > 0.0:
        found |= {"damped_omega": None, "frequency_hz": None}
    if abs(mode["decay"]) <= mode["relative_error"] * mode["omega"]:
        found |= {"decay": 0.0, "damping_ratio": 0.0}
    return found


def _stability(sweep: Summary) -> Section:
    first, last = sweep["factors"][0], sweep["factors"][-1]
    found = sweep["thresholds"]
    lines = [] if found else [f"No threshold between {number(first)} and {number(last)} times the stream."]
    if sweep["ill_posed_from"] is not None:
        lines.append(f"Ill-posed from {number(sweep['ill_posed_from'])} on: {sweep['ill_posed_reason']}.")
    return Section(
        title=f"Stability, {number(first)} to {number(last)} times the stream",
        headings=headings(THRESHOLDS),
        rows=columns(THRESHOLDS, found),
        lines=tuple(lines),
    )


def _motion(motion: Summary) -> Section:
    return Section(
        title=f"Motion until {motion['until']:.6g} s, {motion['steps']} steps, {motion['nodes']} nodes",
        headings=("quantity", "value"),
        rows=listed(MOTION, motion),
        lines=tuple(_slack(motion["slack"])),
    )


def _slack(times: list[Summary]) -> Iterator[str]:
    """Return a warning where the thread would be in compression."""
    if not times:
        return
    worst = min(times, key=lambda entry: float(entry["tension"]))
    yield (
        f"SLACK: {len(times)} times the thread would be in compression, first at {number(times[0]['from'])} s; worst "
        f"{number(worst['tension'])} N at {number(worst['at'])} m. A thread without bending stiffness folds there: "
        "later results are unreliable. Give it flexural_rigidity."
    )


def thread_cost(summary: Summary) -> str:
    """Return size and cost of the solution."""
    size = summary["size"]
    steps = f", {size['steps']} steps in time" if "steps" in size else ""
    what = f"{size['cells']} cells, degree {size['degree']}, {size['dofs']} unknowns{steps}"
    return f"{what}{spent(summary)}"
