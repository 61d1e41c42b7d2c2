"""Solve the scene of a rolling ship."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from pydantic import ValidationError

from hydroelastic.fem.progress import Report
from hydroelastic.modal.roll.quadratic import RollIntegrationError
from hydroelastic.modal.roll.solution import roll_solution
from hydroelastic.scenes.errors import UnsolvedError
from hydroelastic.scenes.models.problems import require_fit
from hydroelastic.scenes.models.roll import RollScene
from hydroelastic.scenes.models.roll_checks import motion_can_be_followed, rates_are_comparable
from hydroelastic.scenes.roll.physics import rolling_ship, wave_train
from hydroelastic.scenes.roll.results import RollResult
from hydroelastic.scenes.roll.section_file import solved_section
from hydroelastic.scenes.validation_errors import scene_error

if TYPE_CHECKING:
    from mpi4py import MPI


def solve_roll(scene: RollScene, comm: MPI.Comm, report: Report = lambda _message: None) -> RollResult:
    """Solve for the motion of the ship (collective if there is a section)."""
    section = solved_section(scene, comm, report) if scene.roll.section is not None else None
    ship = rolling_ship(scene, section)
    if section is not None:
        _check_with(scene, ship.natural_frequency)
    report("roll")
    try:
        solution = roll_solution(
            ship,
            wave_train(scene),
            np.array(scene.times(ship.natural_frequency)),
            angle=scene.roll.angle,
            rate=scene.roll.rate,
            tolerance=scene.accuracy.tolerance,
            relative_ship_error=None if section is None else section.relative_error,
        )
    except RollIntegrationError as error:
        raise UnsolvedError(f"the motion with quadratic damping was not found: {error}") from error
    return RollResult(scene=scene, solution=solution, section=section)


def _check_with(scene: RollScene, natural_frequency: float) -> None:
    """Check the requests of the scene, now that k is known."""
    ship = scene.roll.model_copy(update={"section": None, "natural_frequency": natural_frequency})
    known = scene.model_copy(update={"roll": ship})
    try:
        require_fit(known, [(rates_are_comparable, motion_can_be_followed)])
    except ValidationError as error:
        raise scene_error(error, RollScene) from error
