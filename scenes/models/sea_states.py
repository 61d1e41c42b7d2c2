"""The analysis of bodies in irregular waves, as frozen values. SI units."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import Field, Strict, ValidationError, model_validator
from pydantic_core import InitErrorDetails

from hydroelastic.fem.open_water.requests import AirGapPoint, SpectrumRequest
from hydroelastic.physics.wave_spectrum import PeakedSpectrum, TabulatedSpectrum
from hydroelastic.scenes.models.problems import problem_at
from hydroelastic.scenes.models.scene_model import LARGEST, AnyNumber, PositiveNumber, SceneModel, SparseModel
from hydroelastic.scenes.models.values import MOST_VALUES

if TYPE_CHECKING:
    from hydroelastic.physics.wave_spectrum import WaveSpectrum

MOST_POINTS = 50
"""Points of bodies in one analysis: each has three rows in the tables."""

_NotNegative = Annotated[float, Strict(), Field(ge=0, le=LARGEST)]
_PEAK = ("significant_height", "peak_period")
_TABLE = ("omega", "density")


class SeaPoint(SceneModel):
    """A point that moves with a body."""

    body: Annotated[int, Strict(), Field(ge=1, le=1000)] = Field(default=1, description="number of the body, from 1")
    at: tuple[AnyNumber, AnyNumber] = Field(description="[x, y] of the point at rest, m")


class AirGap(SparseModel):
    """A point over the water, fixed or on a body, of which the smallest height above the waves is asked."""

    at: tuple[AnyNumber, AnyNumber] = Field(description="[x, y] of the point at rest, m, above a free surface")
    across: AnyNumber = Field(default=0.0, description="its distance from the plane of x and y, m; of solids alone")
    body: Annotated[int, Strict(), Field(ge=1, le=1000)] | None = Field(
        default=None, description="number of the body with which it moves, from 1; by default it is fixed"
    )


class Spectrum(SparseModel):
    """Motions, accelerations and loads in irregular waves."""

    kind: Literal["spectrum"] = Field(default="spectrum", description="kind of the analysis")
    waves: Literal["pierson_moskowitz", "jonswap", "table"] = Field(
        default="jonswap", description="spectrum of the waves"
    )
    significant_height: PositiveNumber | None = Field(
        default=None, description="significant height of the waves, m; not of a table"
    )
    peak_period: PositiveNumber | None = Field(default=None, description="period of the peak, s; not of a table")
    peak_enhancement: Annotated[float, Strict(), Field(ge=1, le=20)] = Field(
        default=3.3, description="enhancement γ of the peak of JONSWAP"
    )
    omega: tuple[PositiveNumber, ...] = Field(
        default=(), max_length=MOST_VALUES, description="ascending frequencies of a table, rad/s"
    )
    density: tuple[_NotNegative, ...] = Field(
        default=(), max_length=MOST_VALUES, description="S(ω) of a table, linear between the frequencies, m²·s/rad"
    )
    waves_from: Literal["left", "right"] = Field(default="left", description="the side from which waves come")
    duration: PositiveNumber = Field(default=10800.0, description="duration of the sea state, s")
    highest_omega: PositiveNumber | None = Field(
        default=None, description="highest frequency, rad/s; by default four times that of the peak"
    )
    points: tuple[SeaPoint, ...] = Field(
        default=(), max_length=MOST_POINTS, description=f"up to {MOST_POINTS} points whose motions are reported"
    )
    air_gaps: tuple[AirGap, ...] = Field(
        default=(), max_length=MOST_POINTS, description=f"up to {MOST_POINTS} points whose air gap is reported"
    )
    positions: Annotated[int, Strict(), Field(ge=2, le=MOST_VALUES)] = Field(
        default=51, description="points along each beam at which its loads are reported"
    )
    thickness: PositiveNumber | None = Field(
        default=None, description="thickness of the beams, m, for their stresses 6M/h²; none are reported without it"
    )

    @property
    def spectrum(self) -> WaveSpectrum:
        """The spectrum."""
        if self.waves == "table":
            return TabulatedSpectrum(omega=self.omega, values=self.density)
        assert self.significant_height is not None
        assert self.peak_period is not None
        enhancement = self.peak_enhancement if self.waves == "jonswap" else 1.0
        return PeakedSpectrum(height=self.significant_height, period=self.peak_period, enhancement=enhancement)

    @property
    def words(self) -> str:
        """Description of the waves."""
        if self.waves == "table":
            return f"a table of {len(self.omega)} frequencies"
        name = f"JONSWAP, γ = {self.peak_enhancement:g}" if self.waves == "jonswap" else "Pierson and Moskowitz"
        return f"{name}, Hs = {self.significant_height:g} m, Tp = {self.peak_period:g} s"

    @property
    def request(self) -> SpectrumRequest:
        """What the solver is asked for; bodies are counted from 0."""
        return SpectrumRequest(
            spectrum=self.spectrum,
            words=self.words,
            waves_from=self.waves_from,
            duration=self.duration,
            highest=self.highest_omega,
            points=tuple((point.body - 1, point.at) for point in self.points),
            positions=self.positions,
            thickness=self.thickness,
            air_gaps=tuple(
                AirGapPoint(at=gap.at, across=gap.across, body=gap.body and gap.body - 1) for gap in self.air_gaps
            ),
        )

    @model_validator(mode="after")
    def _keys_fit(self) -> Spectrum:
        problems = list(_problems_of(self))
        if problems:
            raise ValidationError.from_exception_data(type(self).__name__, problems)
        return self


def _problems_of(sea: Spectrum) -> Iterator[InitErrorDetails]:
    needed, idle = (_TABLE, _PEAK) if sea.waves == "table" else (_PEAK, _TABLE)
    for key in needed:
        if not getattr(sea, key):
            description = Spectrum.model_fields[key].description
            yield problem_at(
                (key,), None, f'it is missing, and waves = "{sea.waves}" need it', allowed=f"{description}"
            )
    enhanced = () if sea.waves == "jonswap" else ("peak_enhancement",)
    for key in (*idle, *enhanced):
        # What a scene is written with has all defaults.
        if getattr(sea, key) != Spectrum.model_fields[key].default:
            yield problem_at((key,), None, f'it does not belong to waves = "{sea.waves}"', remedy="Leave it out")
    if sea.waves != "table" or not (sea.omega and sea.density):
        return
    if len(sea.omega) != len(sea.density):
        yield problem_at(
            ("density",), None, f"it has {len(sea.density)} values for {len(sea.omega)} frequencies", allowed="as many"
        )
    elif len(sea.omega) < 2 or any(low >= high for low, high in pairwise(sea.omega)):
        yield problem_at(("omega",), None, "they do not ascend", allowed="two frequencies or more, each above the last")
    elif not any(sea.density):
        yield problem_at(("density",), None, "the sea is at rest", allowed="a value other than 0")
