"""The mesh, the degree or the number of terms of a result, and the tolerance that determined them."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from hydroelastic.output.digits import counted
from hydroelastic.output.level_tank import quantities as level_tank
from hydroelastic.output.open_water import quantities as water
from hydroelastic.output.provenance import Summary
from hydroelastic.output.quantities import Quantity
from hydroelastic.output.reading import Reading
from hydroelastic.output.roll import quantities as roll
from hydroelastic.output.sections import Section
from hydroelastic.output.string import quantities as string
from hydroelastic.output.tank import quantities as tank
from hydroelastic.output.thread import quantities as thread
from hydroelastic.scenes.report.families import Family, family_of, reading_of


def resolved(summary: Summary) -> Section:
    """Return the refinements by which the result reached the tolerance, and their reasons."""
    lines = _LINES[family_of(summary)]
    return Section(title="How the answer was found", lines=tuple(lines(reading_of(summary))))


def _tank(summary: Reading) -> Iterator[str]:
    size, solver = summary[tank.SIZE], summary[tank.SOLVER]
    yield f"{size[tank.CELLS]} cells of degree {size[tank.DEGREE]}; {size[tank.DOFS]} unknowns of ψ."
    yield from _confirmed(solver, tank.COUNT_CONFIRMED, tank.LARGEST_RESIDUAL)


def _level_tank(summary: Reading) -> Iterator[str]:
    size, solver = summary[level_tank.SIZE], summary[level_tank.SOLVER]
    model = solver[level_tank.MODEL]
    yield f"{model[:1].upper()}{model[1:]}."
    poles = f", {size[level_tank.POLES]} poles of the depth" if size[level_tank.POLES] else ""
    yield (
        f"{counted(size[level_tank.PROBLEMS], 'problem')}: degree {size[level_tank.DEGREE]}, "
        f"{size[level_tank.LAYERS]} layers at each edge{poles}; {size[level_tank.DOFS]} unknowns."
    )
    yield from _confirmed(solver, level_tank.COUNT_CONFIRMED, level_tank.LARGEST_RESIDUAL)


def _confirmed(solver: Reading, count_confirmed: Quantity, residual: Quantity) -> Iterator[str]:
    if solver[count_confirmed]:
        yield "An independent count, by the inertia of the matrices, confirms that no mode is missing."
    yield f"Largest residual of the modes: {solver.cell(residual)}."


def _open_water(summary: Reading) -> Iterator[str]:
    size = summary[water.SIZE]
    yield (
        "Each analysis starts from the elements that its shortest wave asks for; its answer is judged by its estimated "
        "error, and refined where that comes from."
    )
    yield f"In the end: {size[water.CELLS]} cells of degree {size[water.DEGREE]}, {size[water.DOFS]} unknowns."


def _string(summary: Reading) -> Iterator[str]:
    size = summary[string.SIZE]
    if summary[string.METHOD] == "series":
        yield f"{size[string.TERMS]} terms of the series: the rest is a hundredth of the tolerance, or rounding."
        return
    yield (
        f"{size[string.CELLS]} elements of degree {size[string.DEGREE]}, {size[string.STEPS]} steps in time: both were "
        "refined until the estimated errors, away from fronts, kept the tolerance."
    )


def _thread(summary: Reading) -> Iterator[str]:
    size, steps = summary[thread.SIZE], summary[thread.EQUILIBRIUM][thread.NEWTON_STEPS]
    if steps:
        yield (
            f"{counted(len(steps), 'mesh')}, each finer than the one before: the difference of the last two estimates "
            "the error."
        )
    yield f"{size[thread.CELLS]} cells of degree {size[thread.DEGREE]}, {size[thread.DOFS]} unknowns."


def _roll(summary: Reading) -> Iterator[str]:
    if summary[roll.SHIP][roll.QUADRATIC_DAMPING]:
        yield "Integrated at two tolerances: their difference estimates the error."
    else:
        yield "The closed form is exact: its error is that of rounding, and of the field solution of a section if any."


_LINES: dict[Family, Callable[[Reading], Iterator[str]]] = {
    "tank": _tank,
    "level tank": _level_tank,
    "open water": _open_water,
    "string": _string,
    "thread": _thread,
    "roll": _roll,
}
