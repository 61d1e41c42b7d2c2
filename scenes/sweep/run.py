"""Sweep a scene: solve all points of a grid, from the journal where they were solved before."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mpi4py import MPI

from hydroelastic.fem.progress import Report
from hydroelastic.output.quantities import Group
from hydroelastic.scenes.errors import Problem, SceneError, shown_value
from hydroelastic.scenes.kinds import runner_of
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.read import Scene, SceneSource, scene_source
from hydroelastic.scenes.sweep.axes import Grid, point_text
from hydroelastic.scenes.sweep.journal import Journal, open_journal
from hydroelastic.scenes.sweep.point import PointOptions, SolvedPoint, Task, failed, point_key
from hydroelastic.scenes.sweep.quantities import columns, quantities, shown_columns
from hydroelastic.scenes.sweep.workers import solved_tasks

if TYPE_CHECKING:
    from hydroelastic.scenes.sweep.lines import Line

Point = Mapping[str, Any]

# Points that may be added for following modes, for each point of the grid.
_ADDED = 4


@dataclass(frozen=True, kw_only=True)
class SweepOptions:
    """How a sweep is made.

    Attributes:
        jobs: number of processes that solve points at the same time.
        estimates: whether the estimates of older theories are made at each point.
        pictures: whether each point has a result folder with its pictures.
        follow: whether the modes of closed tanks are followed along the first key.
        refinements: largest number of points that are added for following them; ``None`` is four for each of the grid.
        show: quantities that are asked for; the first solved point must have them.
    """

    jobs: int = 1
    estimates: bool = False
    pictures: bool = False
    follow: bool = True
    refinements: int | None = None
    show: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if self.jobs < 1:
            raise SceneError(self._jobs_refused("it is too small", allowed="1 or more"))
        if self.jobs > 1 and MPI.COMM_WORLD.size > 1:
            raise SceneError(self._jobs_refused("under MPI all ranks solve each point together", allowed="1"))

    def _jobs_refused(self, wrong: str, *, allowed: str) -> Problem:
        return Problem(key="jobs", value=shown_value(self.jobs), wrong=wrong, allowed=allowed, argument=True)


@dataclass(frozen=True, kw_only=True)
class SolvedSweep:
    """All points of a sweep.

    Attributes:
        scene: the first scene that is valid, with the values of its point.
        file: the scene file; ``None`` if it was made in Python.
        grid: the varied keys.
        points: in the order of the grid.
        kind: the declared quantities of this kind of scene.
        lines: followed modes along the first key, one for each combination of the values of the others.
        resumed: number of points that an earlier sweep had solved.
    """

    scene: Scene
    file: Path | None
    grid: Grid
    points: tuple[SolvedPoint, ...]
    kind: Group
    lines: tuple[Line, ...]
    resumed: int

    @property
    def status(self) -> str:
        """The worst status of all points, "unconverged" at best where followed modes are not resolved."""
        found = {point.status for point in self.points} | ({"unconverged"} if self.unresolved else set())
        return next((status for status in ("failed", "unconverged") if status in found), "ok")

    @property
    def complaints(self) -> list[str]:
        """A line for each point that failed or missed its tolerance."""
        return [
            f"{point_text(values)}: {point.status}: {'; '.join(point.reasons)}"
            for values, point in zip(self.grid.points, self.points, strict=True)
            if point.status != "ok"
        ]

    @property
    def unresolved(self) -> list[str]:
        """A line for each encounter of followed modes that the points do not resolve, and where more were wanted."""
        from hydroelastic.scenes.sweep.lines import place_of

        axis = self.grid.axes[0]
        return [
            f"{point_text({axis.key: place_of(one, axis)} | line.others)}: modes not resolved at ω = {one.omega:.6g}: "
            f"{one.reason}"
            for line in self.lines
            for one in line.encounters
            if one.kind == "unresolved"
        ] + ["following the modes needs more points than were allowed"] * any(
            line.followed.exhausted for line in self.lines
        )

    @property
    def reasons(self) -> list[str]:
        """Why the status is not "ok"."""
        return self.complaints + self.unresolved


class _Solver:
    """Solves points of one scene, and knows those that are solved already."""

    def __init__(
        self, source: SceneSource, grid: Grid, overrides: Iterable[str], journal: Journal, options: SweepOptions
    ) -> None:
        self.source, self.grid, self.overrides = source, grid, tuple(overrides)
        self.journal, self.options = journal, options
        self._scenes: dict[str, Scene | SceneError] = {}
        self.resumed = 0

    def scene(self, point: Point) -> Scene | SceneError:
        """The scene of a point, or the error of its values; made once."""
        values = repr(point)
        if values not in self._scenes:
            try:
                self._scenes[values] = self.source.scene(self.overrides, point)
            except SceneError as error:
                self._scenes[values] = error
        return self._scenes[values]

    def solved(self, points: Sequence[Point], of_points: PointOptions, report: Report) -> list[SolvedPoint]:
        """Solve points, each at once kept in the journal (collective)."""
        scenes = [self.scene(point) for point in points]
        keys: list[str] = []
        tasks: dict[str, Task] = {}
        for number, scene in enumerate(scenes, 1):
            if isinstance(scene, SceneError):
                keys.append("")
                continue
            keys.append(point_key(scene, of_points))
            # Different values may give one scene.
            if keys[-1] not in self.journal:
                tasks[keys[-1]] = Task(key=keys[-1], scene=scene, name=f"{number:04d}")
        self.resumed += sum(key in self.journal for key in keys)
        for number, (task, point) in enumerate(solved_tasks(list(tasks.values()), of_points, self.options.jobs), 1):
            if point_key(task.scene, of_points) != task.key:
                wrong = "a file that the scene names has changed while the sweep was running"
                remedy = "Start the sweep again: it solves all points with the new file"
                raise SceneError(Problem(wrong=wrong, remedy=remedy), file=self.source.file)
            self.journal.add(task.key, point)
            if number == 1 and point.summary is not None:
                kind = runner_of(task.scene).kind
                shown_columns(columns(quantities([point.summary], [point.arrays], kind)), self.options.show)
            report(f"{number} of {len(tasks)} points")
        return [
            failed(scene) if isinstance(scene, SceneError) else self.journal[key]
            for scene, key in zip(scenes, keys, strict=True)
        ]


def solve_sweep(
    scene: Scene | str | Path,
    grid: Grid,
    *,
    overrides: Iterable[str] = (),
    options: SweepOptions = SweepOptions(),
    out: Path | None = None,
    report: Report = lambda _message: None,
) -> SolvedSweep:
    """Solve a scene at all points of a grid (collective).

    Args:
        scene: the scene, or the name or file of one.
        grid: the values of the varied keys.
        overrides: replacements of the option --set, before those of the grid.
        options: how it is made.
        out: result folder, in which the journal of the points is kept; ``None`` keeps them in memory.
        report: called with the number of points solved.

    Raises:
        SceneError: if no point has a valid scene, or the folder cannot be written.
    """
    source = scene_source(scene)
    first = _first_scene(source, overrides, grid)
    journal_folder = out if MPI.COMM_WORLD.rank == 0 else None
    with open_journal(journal_folder, scene_file=source.file) as journal:
        journal.share()
        solver = _Solver(source, grid, overrides, journal, options)
        folder = Path(os.path.realpath(out)) / "points" if options.pictures and out is not None else None
        points = solver.solved(
            grid.points, PointOptions(estimates=options.estimates, follow=options.follow, pictures=folder), report
        )
        lines = _followed(first, solver, points, report) if options.follow else ()
    return SolvedSweep(
        scene=first,
        file=source.file,
        grid=grid,
        points=tuple(points),
        kind=runner_of(first).kind,
        lines=lines,
        resumed=solver.resumed,
    )


def _followed(first: Scene, solver: _Solver, points: list[SolvedPoint], report: Report) -> tuple[Line, ...]:
    """Follow the modes of a closed tank (collective)."""
    if not isinstance(first, TankScene) or first.is_open:
        return ()

    def solve(more: list[dict[str, Any]]) -> list[SolvedPoint]:
        return solver.solved(more, PointOptions(), lambda message: report(f"following modes, {message} between"))

    from hydroelastic.scenes.sweep.lines import followed_lines

    asked = solver.options.refinements
    most = _ADDED * len(points) if asked is None else asked
    return followed_lines(solver.grid, points, solve, count=first.accuracy.modes, most=most)


def _first_scene(source: SceneSource, overrides: Iterable[str], grid: Grid) -> Scene:
    """The first valid scene of a grid; where there is none, the error of the first point is that of the sweep."""
    problem = None
    for point in grid.points:
        try:
            return source.scene(overrides, point)
        except SceneError as error:
            problem = problem or error
    assert problem is not None
    raise problem
