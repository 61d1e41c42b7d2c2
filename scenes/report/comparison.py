"""Comparisons in a report: estimates of older theories, the other method of solution."""

from __future__ import annotations

from collections.abc import Iterator

from hydroelastic.output.outcome import Outcome
from hydroelastic.output.provenance import SECONDS
from hydroelastic.output.sections import Section
from hydroelastic.output.tank.quantities import EXACT
from hydroelastic.scenes.level_tank.run import NOTHING_TO_COMPARE
from hydroelastic.scenes.models.level_tank import LevelTankScene
from hydroelastic.scenes.models.round_tank import OrderedTankScene
from hydroelastic.scenes.models.sea import SeaScene
from hydroelastic.scenes.models.string import StringScene
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.read import Scene


def comparison_of(scene: Scene, outcome: Outcome) -> tuple[Section, ...] | str:
    """Return the tables of comparisons, or the reason why there are none, on this process only."""
    if isinstance(scene, TankScene) or scene.kind == "sea":
        return _section(scene, outcome)
    if isinstance(scene, LevelTankScene | OrderedTankScene):
        found = tuple(section for section in outcome.sections if section.compares)
        return found or NOTHING_TO_COMPARE
    if isinstance(scene, StringScene):
        return _string(scene, outcome)
    if isinstance(scene, ThreadScene):
        return tuple(_thread(scene, outcome))
    return "The solution is a closed form."


def _section(scene: TankScene | SeaScene, outcome: Outcome) -> tuple[Section, ...] | str:
    found = tuple(section for section in outcome.sections if section.compares)
    if found:
        return found
    if scene.is_open:
        return "There is no comparison with older theories: those of floats do not fit these bodies and analyses."
    if EXACT.records(outcome.solution):
        return "The modes have an exact solution; how far they are from it is said below their table."
    return (
        "There is no comparison with older theories: they apply to a beam with free ends beside a free surface, and to "
        "the heave of floats."
    )


def _string(scene: StringScene, outcome: Outcome) -> tuple[Section, ...] | str:
    if not scene.string.physical.has_closed_form:
        return "With a tip mass or a resistance that varies there is no series to compare with."
    if scene.method == "series":
        return (
            "This is the closed form; the field solution beside it, which takes far longer than all of this report, is "
            "given by the command hydroelastic compare."
        )
    from hydroelastic.scenes.string.compare import compared, comparison_section
    from hydroelastic.scenes.string.solve import solve_series

    return (comparison_section(compared(outcome.solution.solution, solve_series(scene))),)


def _thread(scene: ThreadScene, outcome: Outcome) -> Iterator[Section]:
    from hydroelastic.output.thread.comparison_tables import comparison_sections
    from hydroelastic.scenes.thread.compare import thread_differences
    from hydroelastic.scenes.thread.estimates import thread_estimates

    seconds = outcome.summary[SECONDS.key]
    yield from comparison_sections(thread_differences(outcome.solution, tuple(thread_estimates(scene)), seconds))
