"""The scene of a flexible thread in a stream. SI units."""

from __future__ import annotations

from functools import cached_property
from math import pi
from typing import Annotated, Literal

from pydantic import Field, Strict

from hydroelastic.scenes.models.folder import SceneInFolder
from hydroelastic.scenes.models.number_files import read_columns
from hydroelastic.scenes.models.scene_model import SceneModel
from hydroelastic.scenes.models.thread_analyses import EndMotion, ThreadAnalysis, ThreadMotion
from hydroelastic.scenes.models.thread_tables import Ends, FlexibleThread, LiquidStream, PointOnThread
from hydroelastic.scenes.models.values import OR_SWEEP, NumberFromZero, Sweep, Title, ascending_values

MOST_POSITIONS = 100_000
DEFAULT_POSITIONS = 101


class ThreadOutput(SceneModel):
    """Positions at which the thread is reported."""

    positions: Annotated[tuple[NumberFromZero, ...], *ascending_values(MOST_POSITIONS)] | None = Field(
        default=None,
        description=f"distances from end A along the thread, m, {OR_SWEEP}; by default {DEFAULT_POSITIONS} of them",
    )
    frames: Annotated[int, Strict(), Field(ge=0, le=1000)] = Field(
        default=12, description="pictures of a motion, evenly spread over its times; 0 for none"
    )


class ThreadAccuracy(SceneModel):
    """Requested accuracy."""

    tolerance: Annotated[float, Strict(), Field(ge=1e-11, le=1e-1)] = Field(
        default=1e-6,
        description="asked error of positions relative to the length, of tensions relative to the largest one, and of "
        "frequencies",
    )


class ThreadParts(SceneInFolder):
    """The parts of the scene of a thread in a stream, each valid by itself; `ThreadScene` checks their consistency."""

    kind: Literal["thread"] = Field(default="thread", description="kind of the scene")
    title: Title = Field(default="", description="title of tables and images")
    thread: FlexibleThread = Field(description="the thread")
    stream: LiquidStream | None = Field(default=None, description="the liquid; none in empty space")
    load: tuple[PointOnThread, ...] = Field(default=(), description="bodies on the thread")
    ends: Ends = Field(description="how the ends are held")
    analysis: tuple[ThreadAnalysis, ...] = Field(default=(), description="what is asked besides the equilibrium")
    output: ThreadOutput = Field(default=ThreadOutput(), description="where the thread is reported")
    accuracy: ThreadAccuracy = Field(default=ThreadAccuracy(), description="what is asked of the answer")

    @property
    def density(self) -> float:
        """Density of the liquid, kg/m³; 0 in empty space."""
        return 0.0 if self.stream is None else self.stream.density

    @property
    def displaced_mass(self) -> float:
        """Mass of the liquid in the place of the thread, per length, kg/m."""
        diameter = self.thread.diameter or 0.0
        return self.density * pi * diameter**2 / 4.0

    @property
    def weight(self) -> float:
        """w, weight per length in the liquid, N/m, down positive."""
        if self.thread.weight is not None:
            return self.thread.weight
        return (self.thread.mass - self.displaced_mass) * self.thread.gravity

    @property
    def normal_drag(self) -> float:
        """kn = ρ Cn d/2, N·s²/m³."""
        return 0.5 * self.density * self.thread.normal_drag * (self.thread.diameter or 0.0)

    @property
    def tangential_drag(self) -> float:
        """kt = ρ π Ct d/2, N·s²/m³."""
        return 0.5 * self.density * pi * self.thread.tangential_drag * (self.thread.diameter or 0.0)

    @property
    def added_mass(self) -> float:
        """Added mass across the thread per length, kg/m."""
        return self.thread.added_mass * self.displaced_mass

    @property
    def profile(self) -> tuple[tuple[float, ...], ...] | None:
        """Rows of height, m, and (x, y) of the velocity, m/s, of a stream by a table; else ``None``.

        Raises:
            ValueError: if its file cannot be read.
        """
        if self.stream is None or (self.stream.file is None and self.stream.profile is None):
            return None
        return self.stream.profile if self.stream.profile is not None else self._rows_of_file

    @cached_property
    def _rows_of_file(self) -> tuple[tuple[float, ...], ...]:
        assert self.stream is not None
        assert self.stream.file is not None
        return tuple(read_columns(self._folder / self.stream.file, 3))

    def table_of(self, move: EndMotion) -> tuple[tuple[float, ...], ...]:
        """Return the rows of time, s, and displacement (x, y, z), m, of an end's motion; empty without a file.

        Raises:
            ValueError: if the file cannot be read.
        """
        return () if move.file is None else tuple(read_columns(self._folder / move.file, 4))

    @property
    def motions(self) -> tuple[ThreadMotion, ...]:
        """The requested motions in time."""
        return tuple(analysis for analysis in self.analysis if isinstance(analysis, ThreadMotion))

    @property
    def streams(self) -> bool:
        """Whether the liquid moves."""
        stream = self.stream
        given = None if stream is None else (stream.velocity, stream.shear, stream.veer, stream.profile, stream.file)
        return given is not None and any(part is not None for part in given)

    @property
    def positions(self) -> tuple[float, ...]:
        """Arc lengths from end A at which the thread is reported, m."""
        if self.output.positions is not None:
            return self.output.positions
        return Sweep(start=0.0, stop=self.thread.length, number=DEFAULT_POSITIONS).values
