"""Run the scene of a tank in three dimensions: solve, tabulate, write and draw."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path

from hydroelastic.fem.progress import Report
from hydroelastic.output.level_tank.floats import floats_section
from hydroelastic.output.level_tank.quantities import LEVEL_TANK
from hydroelastic.output.level_tank.sample import SampledTank, sample_modes, sample_volume
from hydroelastic.output.level_tank.tables import compared_level_tank, level_tank_cost, level_tank_sections
from hydroelastic.output.outcome import Outcome
from hydroelastic.output.pictures.options import OF_FIELDS, OF_MOTIONS, PictureOptions
from hydroelastic.output.reading import Reading
from hydroelastic.output.sections import Section
from hydroelastic.physics.volume_tank import VolumeTank
from hydroelastic.scenes.level_tank.solve import SolvedLevelTank, solve_level_scene
from hydroelastic.scenes.models.level_tank import LevelTankScene
from hydroelastic.scenes.staged_run import StagedRun


def _sample(solved: SolvedLevelTank, summary: Reading) -> SampledTank:
    from hydroelastic.fem.plan.patches import level_patches

    tank = solved.tank
    is_volume = isinstance(tank.tank, VolumeTank)
    sample = sample_volume(tank) if is_volume else sample_modes(tank, level_patches(tank.tank))
    return SampledTank(solved=solved, sample=sample, summary=summary)


def _write(tank: SampledTank, folder: Path) -> None:
    from hydroelastic.output.level_tank.files import write_level_tank

    write_level_tank(tank, folder)


def _write_parts(tank: SampledTank) -> Callable[[Path], None] | None:
    from hydroelastic.output.level_tank.files import in_parts, write_parts

    return partial(write_parts, tank) if in_parts(tank) else None


def _draw(tank: SampledTank, folder: Path, options: PictureOptions, report: Report) -> None:
    from hydroelastic.output.level_tank.pictures import draw_level_tank

    draw_level_tank(tank, folder, options, report)


run_level_tank = StagedRun(
    solve=solve_level_scene,
    kind=LEVEL_TANK,
    sections=lambda solved, summary: (*floats_section(solved.floats), *level_tank_sections(summary)),
    cost=level_tank_cost,
    sample=_sample,
    write=_write,
    draw=_draw,
    used_options=OF_FIELDS | OF_MOTIONS,
    write_parts=_write_parts,
)


NOTHING_TO_COMPARE = (
    "There is no comparison: estimates are of elastic plates with free edges, closed forms of waves alone in boxes, "
    "cylinders, and cones and canals with walls of 45 degrees, and of sliding plates that cover a box."
)


def compare_level_tank(scene: LevelTankScene, *, report: Report = lambda _message: None) -> Outcome:
    """Solve a tank in three dimensions and compare it with closed forms and estimates; writes nothing (collective)."""
    return beside_estimates(run_level_tank(scene, report=report))


def beside_estimates(outcome: Outcome) -> Outcome:
    """Return an outcome with the tables of the comparison alone."""
    compared = tuple(compared_level_tank(run_level_tank.read(outcome.summary)))
    return replace(outcome, sections=compared or (Section(title="", lines=(NOTHING_TO_COMPARE,)),), notes=True)
