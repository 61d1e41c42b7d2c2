"""Tables of the results of a thread."""

from __future__ import annotations

from collections.abc import Iterator

from hydroelastic.output.digits import counted, number, with_certain_digits
from hydroelastic.output.provenance import Summary
from hydroelastic.output.sections import Row, Section

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
        yield _motion(motion, summary)


def _equilibrium(summary: Summary) -> Section:
    rest = summary["equilibrium"]
    position_error, tension_error = rest["position_error"], rest["tension_error"]
    rows: list[Row] = []
    for name, position, tension, force in zip(
        "AB", rest["end_positions"], rest["end_tensions"], rest["reactions"], strict=True
    ):
        rows.append((f"end {name} at, m", _certain(position, position_error)))
        rows.append((f"tension at {name}, N", _certain([tension], tension_error)))
        if any(force):
            rows.append((f"force of what holds {name}, N", _certain(force, rest["reaction_error"])))
    rows.append(("smallest tension, N", _certain([rest["smallest_tension"]], tension_error)))
    rows.append(("at, m along the thread", number(rest["smallest_tension_at"])))
    if summary["scene"]["thread"]["flexural_rigidity"]:
        rows.append(("moments at A and B, N·m", _certain(rest["end_moments"], rest["moment_error"])))
    rows.append(("estimated error of positions, m", f"{position_error:.1e}"))
    rows.append(("estimated error of tensions, N", f"{tension_error:.1e}"))
    where = "in a vertical plane" if summary["thread"]["dimension"] == 2 else "in space"
    steps = " + ".join(str(count) for count in rest["newton_steps"])
    start = _STARTS.get(rest["start"], rest["start"])
    meshes = counted(len(rest["newton_steps"]), "mesh")
    line = f"Found {where} by Newton's method, which began with {start}: {steps} steps on {meshes}."
    if summary["scene"]["thread"]["tension"] is not None:
        line = "Straight, with the tension that is given."
    return Section(title="Equilibrium", headings=("quantity", "value"), rows=rows, lines=(line,))


def _certain(values: list[float], error: float) -> str:
    """Return numbers with their certain digits; 0 if smaller than the error."""
    return ", ".join(
        "0" if abs(value) <= error else with_certain_digits(value, max(error / abs(value), 1e-13)) for value in values
    )


def _modes(modes: Summary) -> Section:
    rows = [_mode(str(place), mode) for place, mode in enumerate(modes["oscillating"], 1)]
    overdamped = modes["aperiodic"][: len(rows)]
    rows += [_mode("–", mode) for mode in overdamped]
    headings = ("mode", "Im λ, rad/s", "f, Hz", "−Re λ, 1/s", "damping ratio", "direction", "relative error")
    lines = [] if modes["stable"] else ["The equilibrium is not stable: a motion grows."]
    if modes["aperiodic"]:
        count = len(modes["aperiodic"])
        shown = f"; the {len(overdamped)} slowest are shown" if len(overdamped) < count else ""
        lines.append(
            f"{count} motions up to the magnitude of the last mode do not oscillate: they are overdamped{shown}."
        )
    return Section(title="Free motions about the equilibrium", headings=headings, rows=rows, lines=tuple(lines))


def _mode(name: str, mode: Summary) -> Row:
    share = mode["out_of_plane"]
    direction = "–" if share is None else "across the plane" if share > 0.5 else "in the plane"
    error = max(mode["relative_error"], 1e-12)
    oscillates = mode["damped_omega"] > 0.0
    damped = abs(mode["decay"]) > mode["relative_error"] * mode["omega"]
    return (
        name,
        with_certain_digits(mode["damped_omega"], error) if oscillates else "–",
        f"{mode['frequency_hz']:.6g}" if oscillates else "–",
        number(mode["decay"]) if damped else "0",
        f"{mode['damping_ratio']:.4g}" if damped else "0",
        direction,
        f"{mode['relative_error']:.1e}",
    )


def _stability(sweep: Summary) -> Section:
    rows = [
        (
            threshold["kind"],
            with_certain_digits(threshold["factor"], max(threshold["relative_error"], 1e-12)),
            number(threshold["omega"]),
            f"{threshold['growing_below']} → {threshold['growing_above']}",
            f"{threshold['relative_error']:.1e}",
        )
        for threshold in sweep["thresholds"]
    ]
    first, last = sweep["factors"][0], sweep["factors"][-1]
    lines = [] if rows else [f"No threshold between {number(first)} and {number(last)} times the stream."]
    if sweep["ill_posed_from"] is not None:
        lines.append(f"Ill-posed from {number(sweep['ill_posed_from'])} on: {sweep['ill_posed_reason']}.")
    return Section(
        title=f"Stability, {number(first)} to {number(last)} times the stream",
        headings=("kind", "stream times", "ω, rad/s", "growing motions", "relative error"),
        rows=rows,
        lines=tuple(lines),
    )


def _motion(motion: Summary, summary: Summary) -> Section:
    length = summary["scene"]["thread"]["length"]
    time, place = motion["largest_tension_at"]
    low_time, low_place = motion["smallest_tension_at"]
    error = motion["extreme_tension_error"]
    rows: list[Row] = [
        ("largest tension over all steps, N", _certain([motion["largest_tension"]], error)),
        ("at, s; m along the thread", f"{number(time)}; {number(place)}"),
        ("smallest tension over all steps, N", _certain([motion["smallest_tension"]], error)),
        ("at, s; m along the thread", f"{number(low_time)}; {number(low_place)}"),
    ]
    for name, (low, high) in zip("AB", motion["end_tensions_range"], strict=True):
        rows.append((f"tension at {name} over all steps, N", f"{_certain([low], error)} to {_certain([high], error)}"))
    rows += [
        ("estimated error of these tensions, N", f"{error:.2g}"),
        (
            "energy at the start and at the end, J",
            f"{number(motion['energy_at_start'])}, {number(motion['energy_at_end'])}",
        ),
        ("work of drag, J", number(motion["work_of_drag"])),
        ("last distance from the equilibrium, m", f"{motion['distance_to_rest']:.3g}"),
        ("estimated error of positions, of the length", f"{motion['position_error'] / length:.1e}"),
        ("of steps; of the mesh, m", f"{motion['step_error']:.1e}; {motion['mesh_error']:.1e}"),
        ("estimated error of tensions at the output times, N", f"{motion['tension_error']:.2g}"),
    ]
    return Section(
        title=f"Motion until {motion['until']:.6g} s, {motion['steps']} steps, {motion['nodes']} nodes",
        headings=("quantity", "value"),
        rows=rows,
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
    seconds = ", ".join(f"{stage} {value:.3f}" for stage, value in summary["timing"].items() if value >= 0.0005)
    return f"{what}; seconds: {seconds}; peak memory {summary['memory_peak'] / 2**20:.0f} MiB."
