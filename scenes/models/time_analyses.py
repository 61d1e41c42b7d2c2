"""Analyses of open water over time as frozen values: impulse responses, and motions in waves. SI units."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any, Literal, TypeAlias

from pydantic import BeforeValidator, Field, SerializerFunctionWrapHandler, Strict, model_serializer, model_validator

from hydroelastic.fem.open_water.requests import ImpulseResponseRequest, MotionRequest, RegularWave
from hydroelastic.physics.irregular_waves import wave_components
from hydroelastic.physics.wave_spectrum import PeakedSpectrum
from hydroelastic.scenes.models.problems import problem
from hydroelastic.scenes.models.scene_model import AnyNumber, PositiveNumber, SceneModel, SparseModel
from hydroelastic.scenes.models.values import (
    DISTINCT,
    MOST_SWEPT,
    MOST_VALUES,
    OR_SWEEP,
    ElasticModes,
    NumberFromZero,
    OrElse,
    ascending_values,
)


class Release(SceneModel):
    """Displacement from which a float is released at rest."""

    heave: AnyNumber = Field(default=0.0, description="upwards, m")
    roll: AnyNumber = Field(default=0.0, description="of a section, anticlockwise, rad")
    pitch: AnyNumber = Field(default=0.0, description="of a solid, with its top towards −x, rad")

    @model_validator(mode="after")
    def _is_somewhere(self) -> Release:
        if not any(self.amounts.values()):
            raise problem("the float is released from its equilibrium", allowed="a heave or a roll other than 0")
        return self

    @model_serializer(mode="wrap")
    def _as_given(self, write: SerializerFunctionWrapHandler) -> dict[str, Any]:
        return {key: value for key, value in write(self).items() if key in ("heave", "roll") or value}

    @property
    def amounts(self) -> dict[str, float]:
        """The displacement of each motion, m or rad."""
        return {key: float(getattr(self, key)) for key in type(self).model_fields}


class Offset(Release):
    """Displacement from which a float begins to move, sideways too where moorings pull it back."""

    sway: AnyNumber = Field(default=0.0, description="of a section, to the right, m")
    surge: AnyNumber = Field(default=0.0, description="of a solid, along x, m")


def _as_heave(value: Any) -> Any:
    return {"heave": value} if not isinstance(value, dict | Release) else value


Displacement: TypeAlias = Annotated[Release, BeforeValidator(_as_heave), OrElse({"type": "number"})]
"""A release; a number is a heave."""


class ImpulseResponse(SceneModel):
    """Impulse response functions of radiation, and added mass and damping back from them."""

    kind: Literal["impulse_response"] = Field(default="impulse_response", description="kind of the analysis")
    times: Annotated[tuple[NumberFromZero, ...], *DISTINCT] = Field(description=f"times, s, {OR_SWEEP}")
    elastic_modes: ElasticModes = Field(default=4, description="how many elastic shapes of each beam are reported")

    @property
    def request(self) -> ImpulseResponseRequest:
        """What the solver is asked for."""
        return ImpulseResponseRequest(times=self.times, elastic_modes=self.elastic_modes)


class IncidentWave(SceneModel):
    """A regular wave that comes from afar."""

    omega: PositiveNumber = Field(description="angular frequency, rad/s")
    amplitude: PositiveNumber = Field(description="half the height from trough to crest, m")
    phase: AnyNumber = Field(
        default=0.0, description="phase, rad; the crest passes the middle of the first body at t = phase/omega"
    )


class RandomWaves(SceneModel):
    """Irregular waves of a spectrum, as a sum of regular waves of random phases."""

    waves: Literal["pierson_moskowitz", "jonswap"] = Field(default="jonswap", description="spectrum of the waves")
    significant_height: PositiveNumber = Field(description="significant height of the waves, m")
    peak_period: PositiveNumber = Field(description="period of the peak, s")
    peak_enhancement: Annotated[float, Strict(), Field(ge=1, le=20)] = Field(
        default=3.3, description="enhancement γ of the peak of JONSWAP"
    )
    seed: Annotated[int, Strict(), Field(ge=0, le=2**32 - 1)] = Field(
        description="seed of the random phases; the same one gives the same waves"
    )
    number: Annotated[int, Strict(), Field(ge=1, le=2000)] = Field(
        default=200, description="how many regular waves, of equal energy"
    )

    @model_validator(mode="after")
    def _has_its_peak(self) -> RandomWaves:
        if self.waves != "jonswap" and self.peak_enhancement != type(self).model_fields["peak_enhancement"].default:
            raise problem(f'peak_enhancement does not belong to waves = "{self.waves}"', remedy="Leave it out")
        return self

    @property
    def words(self) -> str:
        """Description of the waves."""
        name = f"JONSWAP, γ = {self.peak_enhancement:g}" if self.waves == "jonswap" else "Pierson and Moskowitz"
        return (
            f"{self.number} waves of random phases, seed {self.seed}, of {name}, Hs = {self.significant_height:g} m, "
            f"Tp = {self.peak_period:g} s"
        )

    @property
    def components(self) -> Iterator[RegularWave]:
        """The regular waves."""
        enhancement = self.peak_enhancement if self.waves == "jonswap" else 1.0
        spectrum = PeakedSpectrum(height=self.significant_height, period=self.peak_period, enhancement=enhancement)
        for omega, amplitude, phase in zip(*wave_components(spectrum, self.number, self.seed), strict=True):
            yield RegularWave(omega=float(omega), amplitude=float(amplitude), phase=float(phase))


class Motion(SparseModel):
    """Motions over time in waves that begin at t = 0, from rest, or after a release with or without waves."""

    kind: Literal["motion"] = Field(default="motion", description="kind of the analysis")
    times: Annotated[tuple[NumberFromZero, ...], *ascending_values(MOST_SWEPT)] = Field(
        description=f"times, s, ascending, {OR_SWEEP}"
    )
    waves: Annotated[tuple[IncidentWave, ...], Field(max_length=MOST_VALUES)] = Field(
        default=(), description="the incident waves, tables {omega, amplitude, phase}"
    )
    random_waves: RandomWaves | None = Field(
        default=None, description="irregular waves in place of these, a table of a spectrum with a seed"
    )
    displacement: Annotated[Offset, BeforeValidator(_as_heave), OrElse({"type": "number"})] | None = Field(
        default=None,
        description="displacement from which a float is released at t = 0: heave in m, or a table {heave, sway, roll}, "
        "of solids {heave, surge, pitch}, in m and rad; without it waves are needed",
    )
    body: Annotated[int, Strict(), Field(ge=1, le=1000)] | None = Field(
        default=None, description="number of the float that is released, from 1; by default the first body"
    )
    waves_from: Literal["left", "right"] = Field(default="left", description="the side from which waves come")
    ramp: NumberFromZero = Field(default=0.0, description="time in which the waves grow to their height, s")
    elastic_modes: ElasticModes = Field(default=4, description="how many elastic shapes of each beam move")

    @model_validator(mode="after")
    def _has_waves(self) -> Motion:
        if self.waves and self.random_waves is not None:
            raise problem("it needs waves or random_waves, and not both", remedy="Give one of them")
        if self.is_in_still_water and self.displacement is None:
            raise problem("nothing moves the bodies", remedy="Give waves, random_waves, or a displacement")
        return self

    @property
    def is_in_still_water(self) -> bool:
        """Whether no waves come."""
        return not self.waves and self.random_waves is None

    @property
    def words(self) -> str:
        """Description of the waves."""
        if self.random_waves is not None:
            return self.random_waves.words
        return "a regular wave" if len(self.waves) == 1 else f"{len(self.waves)} waves"

    @property
    def request(self) -> MotionRequest:
        """What the solver is asked for."""
        start = self.displacement
        regular = (RegularWave(**wave.model_dump()) for wave in self.waves)
        return MotionRequest(
            times=self.times,
            waves=tuple(self.random_waves.components if self.random_waves is not None else regular),
            waves_from=self.waves_from,
            ramp=self.ramp,
            elastic_modes=self.elastic_modes,
            body=(self.body or 1) - 1,
            displacement=start.amounts if start else {},
        )
