"""Solve the scene of a rolling ship: closed form, or integration where damping is quadratic."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from pydantic import ValidationError

from hydroelastic.fem.kept_tolerance import kept_tolerance
from hydroelastic.fem.stopwatch import Report, Stopwatch
from hydroelastic.modal.roll.knots import RollPath, roll_knots
from hydroelastic.modal.roll.motion import Roll, RollMotion, WaveTrain, roll_path
from hydroelastic.modal.roll.quadratic import QuadraticRollPath, quadratic_roll_path
from hydroelastic.modal.roll.statistics import RollStatistics, roll_statistics
from hydroelastic.scenes.errors import UnsolvedError, scene_error
from hydroelastic.scenes.models.problems import require_fit
from hydroelastic.scenes.models.roll import RollScene
from hydroelastic.scenes.models.roll_checks import motion_can_be_followed, rates_are_comparable
from hydroelastic.scenes.roll.section_file import solved_section

if TYPE_CHECKING:
    from mpi4py import MPI

    from hydroelastic.scenes.roll.section import SectionRoll

# Roundings in the closed form, of the largest angle; and those of the phase kt besides.
_ROUNDINGS = 20.0
# Times at which motions are compared.
_PER_PERIOD = 16


@dataclass(frozen=True, kw_only=True)
class RollSolution:
    """The motion of a ship on a swell.

    Attributes:
        scene: the scene.
        roll: k and n, those of the section included.
        train: the waves.
        motion: angle, rate and acceleration at the times of the scene.
        statistics: from t = 0 to the last of these times.
        angle_error: estimated largest absolute error of the angle, rad.
        section: what the field solution of the section says; ``None`` without one.
        section_error: the part of the error that comes from it, rad.
        reasons: why the solution does not keep what was asked; empty if it does.
        seconds: time by stage.
    """

    scene: RollScene
    roll: Roll
    train: WaveTrain
    motion: RollMotion
    statistics: RollStatistics
    angle_error: float
    section: SectionRoll | None
    section_error: float
    reasons: tuple[str, ...]
    seconds: dict[str, float]


def solve_roll(scene: RollScene, comm: MPI.Comm, report: Report = lambda _message: None) -> RollSolution:
    """Solve for the motion of the ship (collective if there is a section).

    Args:
        scene: the scene.
        comm: MPI communicator.
        report: told what is being done.

    Raises:
        SceneError: if the section's scene cannot be used, or what is asked is impossible with its natural frequency.
        UnsolvedError: if the section, or a motion with quadratic damping, cannot be solved to its tolerance.
    """
    watch = Stopwatch()
    section = solved_section(scene, comm, watch, report) if scene.roll.section is not None else None
    roll = _ship(scene, section)
    if section is not None:
        _check_with(scene, roll.natural_frequency)
    train = _train(scene)
    times = np.array(scene.times(roll.natural_frequency))
    report("roll")
    with watch.stage("solve"):
        path = _path(scene, roll, train, float(times[-1]))
        motion = path.motion(times)
    with watch.stage("statistics"):
        statistics = roll_statistics(path, float(times[-1]))
    error = _error(path, float(times[-1]), abs(statistics.largest_angle))
    section_error = 0.0
    if section is not None:
        with watch.stage("errors"):
            section_error = _carried(scene, section, roll, train, float(times[-1]))
    return RollSolution(
        scene=scene,
        roll=roll,
        train=train,
        motion=motion,
        statistics=statistics,
        angle_error=error + section_error,
        section=section,
        section_error=section_error,
        reasons=_reasons(scene, error, section_error, abs(statistics.largest_angle)),
        seconds=dict(watch.seconds),
    )


def _ship(scene: RollScene, section: SectionRoll | None) -> Roll:
    """k and n; in open water what the scene says of n comes on top of the waves that the section makes."""
    frequency = scene.natural_frequency if section is None else section.natural_frequency
    assert frequency is not None
    waves = 0.0 if section is None or section.damping is None else section.damping
    return Roll(frequency, (scene.damping(frequency) or 0.0) + waves)


def _train(scene: RollScene) -> WaveTrain:
    waves = np.array(scene.waves).reshape(-1, 2)
    return WaveTrain(waves[:, 0], waves[:, 1])


def _check_with(scene: RollScene, natural_frequency: float) -> None:
    """See that what the scene asks is possible, now that k is known.

    Raises:
        SceneError: if not.
    """
    ship = scene.roll.model_copy(update={"section": None, "natural_frequency": natural_frequency})
    known = scene.model_copy(update={"roll": ship})
    try:
        require_fit(known, [(rates_are_comparable, motion_can_be_followed)])
    except ValidationError as error:
        raise scene_error(error, RollScene) from error


def _path(scene: RollScene, roll: Roll, train: WaveTrain, end: float) -> RollPath:
    given = scene.roll
    if given.quadratic_damping == 0.0:
        return roll_path(roll, train, given.angle, given.rate)
    try:
        return quadratic_roll_path(
            roll,
            given.quadratic_damping,
            train,
            end,
            angle=given.angle,
            rate=given.rate,
            tolerance=min(scene.accuracy.tolerance, 0.01),
        )
    except ValueError as error:
        raise UnsolvedError(f"the motion with quadratic damping was not found: {error}") from error


def _error(path: RollPath, end: float, largest: float) -> float:
    """The largest error of the angle, rad: of the integration, or by rounding."""
    if isinstance(path, QuadraticRollPath):
        return path.angle_error
    roundings = _ROUNDINGS + path.roll.natural_frequency * end
    return roundings * float(np.finfo(float).eps) * largest


def _carried(scene: RollScene, section: SectionRoll, roll: Roll, train: WaveTrain, end: float) -> float:
    """What an error of the section's inertia and damping does to the angle, to first order, rad.

    Quadratic damping, which would only lessen it, is left out.
    """
    change = section.relative_error
    others = (
        Roll(roll.natural_frequency * (1.0 + change), roll.damping),
        Roll(roll.natural_frequency, roll.damping + change * roll.natural_frequency),
    )
    times = roll_knots(roll, train, 0.0, end, _PER_PERIOD)
    angle, *changed = (
        roll_path(ship, train, scene.roll.angle, scene.roll.rate).motion(times).angle for ship in (roll, *others)
    )
    return sum(float(np.abs(other - angle).max()) for other in changed)


def _reasons(scene: RollScene, error: float, section_error: float, largest: float) -> tuple[str, ...]:
    tolerance = scene.accuracy.tolerance
    relative = (error + section_error) / largest if largest else 0.0
    if relative <= tolerance:
        return ()
    cause = "; most of it comes from the section: ask for a smaller tolerance there" if section_error > error else ""
    return (
        f"the angle has an estimated error of {relative:.1e} of the largest one, above the tolerance {tolerance:g}; "
        f"{kept_tolerance(relative)}{cause}",
    )
