"""Run the scene of a tank of revolution: solve, tabulate, write and draw, as any tank in three dimensions."""

from __future__ import annotations

from pathlib import Path

from hydroelastic.fem.progress import Report
from hydroelastic.output.level_tank.quantities import LEVEL_TANK
from hydroelastic.output.level_tank.sample import SampledTank, sample_modes
from hydroelastic.output.level_tank.tables import level_tank_cost, level_tank_sections
from hydroelastic.output.outcome import Outcome
from hydroelastic.output.reading import Reading
from hydroelastic.scenes.level_tank.run import beside_estimates, run_level_tank
from hydroelastic.scenes.level_tank.solve import SolvedLevelTank
from hydroelastic.scenes.models.round_tank import OrderedTankScene
from hydroelastic.scenes.round_tank.solve import solve_round_scene
from hydroelastic.scenes.staged_run import StagedRun


def _sample(solved: SolvedLevelTank, summary: Reading) -> SampledTank:
    from hydroelastic.fem.plan.patches import level_patches

    return SampledTank(
        solved=solved, sample=sample_modes(solved.tank, level_patches(solved.tank.tank)), summary=summary
    )


def _write(tank: SampledTank, folder: Path) -> None:
    from hydroelastic.output.level_tank.files import write_modes, write_surface

    write_modes(tank, folder)
    (folder / "fields").mkdir()
    write_surface(tank.sample, folder / "fields" / "surface.vtu")


run_round_tank: StagedRun[OrderedTankScene, SolvedLevelTank] = StagedRun(
    solve=solve_round_scene,
    kind=LEVEL_TANK,
    sections=lambda _solved, summary: level_tank_sections(summary),
    cost=level_tank_cost,
    sample=_sample,
    write=_write,
    draw=run_level_tank.draw,
    used_options=run_level_tank.used_options,
)


def compare_round_tank(scene: OrderedTankScene, *, report: Report = lambda _message: None) -> Outcome:
    """See `compare_level_tank`."""
    return beside_estimates(run_round_tank(scene, report=report))
