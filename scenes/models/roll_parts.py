"""The scene of a ship that rolls on a swell whose waves differ in period and slope. SI units, angles in radians."""

from __future__ import annotations

from functools import cached_property
from math import pi
from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field, Strict

from hydroelastic.scenes.models.folder import SceneInFolder
from hydroelastic.scenes.models.number_files import read_columns
from hydroelastic.scenes.models.scene_model import AnyNumber, PositiveNumber, SceneModel
from hydroelastic.scenes.models.values import OR_SWEEP, NumberFromZero, Sweep, Title, ascending_values

MOST_TIMES = 1_000_000
DEFAULT_TIMES_PER_PERIOD = 60
DEFAULT_FREE_PERIODS = 3.0
"""How long the free motion after the last wave is followed if no times are given, in natural periods."""


class ShipRoll(SceneModel):
    """The ship: φ'' + 2nφ' + d|φ'|φ' + k²φ = k² × slope of the wave."""

    natural_period: PositiveNumber | None = Field(
        default=None, description="natural period 2π/k without damping, s; or one of the next two"
    )
    natural_frequency: PositiveNumber | None = Field(
        default=None, description="natural frequency k without damping, rad/s"
    )
    section: Path | None = Field(
        default=None,
        description="scene of a float that may roll, from which k, and in open water n, are computed; "
        "relative to the folder of the scene",
    )
    damping: NumberFromZero | None = Field(
        default=None, description="damping n, 1/s; or damping_ratio, by default none"
    )
    damping_ratio: NumberFromZero | None = Field(default=None, description="n/k, 1 is critical")
    quadratic_damping: NumberFromZero = Field(default=0.0, description="quadratic damping, d of d|φ'|φ', 1/rad")
    angle: AnyNumber = Field(default=0.0, description="angle φ at t = 0, rad")
    rate: AnyNumber = Field(default=0.0, description="rate φ' at t = 0, rad/s")


class SwellWave(SceneModel):
    """One wave, a period of a sine; the next one begins where it ends."""

    period: PositiveNumber = Field(description="period of the wave, s")
    slope: AnyNumber = Field(description="largest slope of the wave, rad")


class SwellTable(SceneModel):
    """A train of waves from a table."""

    file: Path = Field(
        description="text file with two columns, period in s and slope in rad; relative to the folder of the scene"
    )


class RollOutput(SceneModel):
    """Times at which the motion is reported, and levels of angle."""

    times: Annotated[tuple[NumberFromZero, ...], *ascending_values(MOST_TIMES)] | None = Field(
        default=None,
        description=f"times, s, {OR_SWEEP}; by default {DEFAULT_TIMES_PER_PERIOD} in each natural period, until "
        f"{DEFAULT_FREE_PERIODS:g} periods after the last wave",
    )
    levels: tuple[PositiveNumber, ...] = Field(
        default=(), description="angles, rad; the swings that exceed each are counted"
    )


class RollAccuracy(SceneModel):
    """Requested accuracy."""

    tolerance: Annotated[float, Strict(), Field(ge=1e-12, le=1e-1)] = Field(
        default=1e-8, description="asked error of the angle, relative to the largest one"
    )


class RollParts(SceneInFolder):
    """The parts of the scene of a ship on a swell, each valid by itself; `RollScene` checks their consistency."""

    kind: Literal["roll"] = Field(default="roll", description="kind of the scene")
    title: Title = Field(default="", description="title of tables and images")
    roll: ShipRoll = Field(description="the ship, and how its roll begins")
    wave: tuple[SwellWave, ...] = Field(default=(), description="the waves, in order; without any the roll is free")
    train: SwellTable | None = Field(default=None, description="the waves from a table, in place of [[wave]]")
    output: RollOutput = Field(default=RollOutput(), description="when the motion is reported")
    accuracy: RollAccuracy = Field(default=RollAccuracy(), description="what is asked of the answer")

    @property
    def section_file(self) -> Path | None:
        """Path of the scene of the section; a name without such a file is that of a shipped scene."""
        if self.roll.section is None:
            return None
        beside = self._folder / self.roll.section
        return beside if beside.exists() else self.roll.section

    @cached_property
    def waves(self) -> tuple[tuple[float, float], ...]:
        """Period, s, and slope, rad, of the waves.

        Raises:
            ValueError: if a table cannot be read.
        """
        if self.train is None:
            return tuple((wave.period, wave.slope) for wave in self.wave)
        return tuple((row[0], row[1]) for row in read_columns(self._folder / self.train.file, 2))

    @property
    def natural_frequency(self) -> float | None:
        """k, rad/s; ``None`` if it comes from a section."""
        if self.roll.natural_period is not None:
            return 2.0 * pi / self.roll.natural_period
        return self.roll.natural_frequency

    def damping(self, natural_frequency: float) -> float | None:
        """Return n, 1/s, of a ship of natural frequency k, rad/s; ``None`` if the scene does not give it."""
        if self.roll.damping_ratio is not None:
            return self.roll.damping_ratio * natural_frequency
        return self.roll.damping

    def times(self, natural_frequency: float) -> tuple[float, ...]:
        """Return when the motion of a ship of natural frequency k, rad/s, is reported, s."""
        if self.output.times is not None:
            return self.output.times
        last = self.last_time(natural_frequency)
        shortest = min([2.0 * pi / natural_frequency, *(wave[0] for wave in self.waves)])
        number = min(round(DEFAULT_TIMES_PER_PERIOD * last / shortest) + 1, MOST_TIMES)
        return Sweep(start=0.0, stop=last, number=number).values

    def last_time(self, natural_frequency: float) -> float:
        """Return until when the motion of a ship of natural frequency k, rad/s, is followed, s."""
        if self.output.times is not None:
            return self.output.times[-1]
        return sum(wave[0] for wave in self.waves) + DEFAULT_FREE_PERIODS * 2.0 * pi / natural_frequency
