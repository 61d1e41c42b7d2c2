"""Analyses of open water over time as frozen values: impulse responses, and motions in waves. SI units."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field, Strict, model_validator

from hydroelastic.fem.open_water.requests import ImpulseResponseRequest, MotionRequest, RegularWave
from hydroelastic.scenes.models.bodies import AnyNumber, PositiveNumber, SceneModel, SparseModel
from hydroelastic.scenes.models.problems import problem
from hydroelastic.scenes.models.values import (
    DISTINCT,
    MOST_SWEPT,
    MOST_VALUES,
    OR_SWEEP,
    ElasticModes,
    NumberFromZero,
    ascending_values,
)


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
        # SciPy's quadrature is slow to import.
        from hydroelastic.physics.wave_components import wave_components
        from hydroelastic.physics.wave_spectrum import PeakedSpectrum

        enhancement = self.peak_enhancement if self.waves == "jonswap" else 1.0
        spectrum = PeakedSpectrum(height=self.significant_height, period=self.peak_period, enhancement=enhancement)
        for omega, amplitude, phase in zip(*wave_components(spectrum, self.number, self.seed), strict=True):
            yield RegularWave(omega=float(omega), amplitude=float(amplitude), phase=float(phase))


class Motion(SparseModel):
    """Motions over time in waves that begin at t = 0, from rest."""

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
    waves_from: Literal["left", "right"] = Field(default="left", description="the side from which waves come")
    ramp: NumberFromZero = Field(default=0.0, description="time in which the waves grow to their height, s")
    elastic_modes: ElasticModes = Field(default=4, description="how many elastic shapes of each beam move")

    @model_validator(mode="after")
    def _has_waves(self) -> Motion:
        if bool(self.waves) == (self.random_waves is not None):
            raise problem("it needs waves or random_waves, and not both", remedy="Give one of them")
        return self

    @property
    def words(self) -> str:
        """Description of the waves."""
        if self.random_waves is not None:
            return self.random_waves.words
        return "a regular wave" if len(self.waves) == 1 else f"{len(self.waves)} waves"

    @property
    def request(self) -> MotionRequest:
        """What the solver is asked for."""
        regular = (RegularWave(**wave.model_dump()) for wave in self.waves)
        return MotionRequest(
            times=self.times,
            waves=tuple(self.random_waves.components if self.random_waves is not None else regular),
            waves_from=self.waves_from,
            ramp=self.ramp,
            elastic_modes=self.elastic_modes,
        )
