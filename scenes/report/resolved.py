"""The mesh, the degree or the number of terms of a result, and the tolerance that determined them."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from hydroelastic.output.provenance import Summary
from hydroelastic.output.sections import Section
from hydroelastic.scenes.report.families import Family, family_of


def resolved(summary: Summary) -> Section:
    """Return the refinements by which the result reached the tolerance, and their reasons.

    Args:
        summary: content of ``summary.json``.
    """
    lines = _LINES[family_of(summary)]
    return Section(title="How the answer was found", lines=tuple(lines(summary)))


def _tank(summary: Summary) -> Iterator[str]:
    size = summary["size"]
    half = " in half the tank, for the scene is its own mirror image" if size["halves"] else ""
    yield from _modes(summary, f"{size['cells']} cells of degree {size['degree']}{half}; {size['dofs']} unknowns of ψ.")


def _level_tank(summary: Summary) -> Iterator[str]:
    size, model = summary["size"], summary["solver"]["model"]
    yield f"{model[:1].upper()}{model[1:]}."
    poles = f", {size['poles']} poles of the depth" if size["poles"] else ""
    problems = f"{size['problems']} problem{'s' * (size['problems'] != 1)}"
    yield from _modes(
        summary,
        f"{problems}: degree {size['degree']}, {size['layers']} layers at each edge{poles}; {size['dofs']} unknowns.",
    )


def _modes(summary: Summary, size: str) -> Iterator[str]:
    """How often the modes were solved, the size of the last attempt, and what confirms them."""
    solver = summary["solver"]
    attempts = solver["attempts"]
    if attempts == 1:
        yield (
            "One attempt: its estimated errors are within the tolerance." if not summary["reasons"] else "One attempt."
        )
    else:
        yield f"{attempts} attempts: after each one, what had the largest part in the estimated error was refined."
    yield size
    if solver["count_confirmed_by_inertia"]:
        yield "An independent count, by the inertia of the matrices, confirms that no mode is missing."
    yield f"Largest residual of the modes: {solver['largest_residual']:.1e}."


def _open_water(summary: Summary) -> Iterator[str]:
    size = summary["size"]
    yield (
        "Each analysis starts from the elements that its shortest wave asks for; its answer is judged by its estimated "
        "error, and refined where that comes from."
    )
    yield f"In the end: {size['cells']} cells of degree {size['degree']}, {size['dofs']} unknowns."


def _string(summary: Summary) -> Iterator[str]:
    size = summary["size"]
    if summary["method"] == "series":
        yield f"{size['terms']} terms of the series: the rest is a hundredth of the tolerance, or rounding."
        return
    yield (
        f"{size['cells']} elements of degree {size['degree']}, {size['steps']} steps in time: both were refined until "
        "the estimated errors, away from fronts, kept the tolerance."
    )


def _thread(summary: Summary) -> Iterator[str]:
    size, rest = summary["size"], summary["equilibrium"]
    if rest["newton_steps"]:
        meshes = len(rest["newton_steps"])
        yield (
            f"{meshes} {'mesh' if meshes == 1 else 'meshes'}, each finer than the one before: the difference of the "
            "last two estimates the error."
        )
    yield f"{size['cells']} cells of degree {size['degree']}, {size['dofs']} unknowns."


def _roll(summary: Summary) -> Iterator[str]:
    if summary["ship"]["quadratic_damping"]:
        yield "Integrated at two tolerances: their difference estimates the error."
    else:
        yield "The closed form is exact: its error is that of rounding, and of the field solution of a section if any."


_LINES: dict[Family, Callable[[Summary], Iterator[str]]] = {
    "tank": _tank,
    "level tank": _level_tank,
    "open water": _open_water,
    "string": _string,
    "thread": _thread,
    "roll": _roll,
}
