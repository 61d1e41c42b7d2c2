"""Analyses of open water as frozen values: radiation, response to waves, resonances, decay after release. SI units."""

from __future__ import annotations

from typing import Annotated, Any, Literal, TypeAlias

from pydantic import (
    Discriminator,
    Field,
    SerializerFunctionWrapHandler,
    Strict,
    Tag,
    model_serializer,
)

from hydroelastic.fem.open_water.requests import (
    DecayRequest,
    RadiationRequest,
    ResonanceRequest,
    ResponseRequest,
)
from hydroelastic.scenes.models.scene_model import PositiveNumber, SceneModel
from hydroelastic.scenes.models.sea_states import Spectrum
from hydroelastic.scenes.models.time_analyses import Displacement, ImpulseResponse, Motion
from hydroelastic.scenes.models.values import (
    DISTINCT,
    MOST_VALUES,
    OR_SWEEP,
    ElasticModes,
    NumberFromZero,
    ZeroOrMoreOrInfinite,
    kind_of,
)

MOST_FIELDS = 20
"""Frequencies of one analysis whose fields are written and drawn."""


class Radiation(SceneModel):
    """Added mass, radiation damping and excitation forces."""

    kind: Literal["radiation"] = Field(default="radiation", description="kind of the analysis")
    omega: Annotated[tuple[ZeroOrMoreOrInfinite, ...], *DISTINCT] = Field(
        description=f"frequencies, rad/s, {OR_SWEEP}; 0 for very long waves, inf for the limit of infinite frequency"
    )
    elastic_modes: ElasticModes = Field(default=4, description="how many elastic shapes of each beam are reported")
    fields_at: Annotated[tuple[PositiveNumber, ...], Field(max_length=MOST_FIELDS)] = Field(
        default=(),
        description="frequencies, rad/s, at which fields of sections are written and drawn; by default where the "
        "damping of each motion is largest",
    )

    @property
    def request(self) -> RadiationRequest:
        """What the solver is asked for."""
        return RadiationRequest(omega=self.omega, elastic_modes=self.elastic_modes, fields_at=self.fields_at)

    @model_serializer(mode="wrap")
    def _as_given(self, write: SerializerFunctionWrapHandler) -> dict[str, Any]:
        return {key: value for key, value in write(self).items() if key != "fields_at" or value}


class Response(SceneModel):
    """Motions, reflection and transmission in incident waves."""

    kind: Literal["response"] = Field(default="response", description="kind of the analysis")
    omega: Annotated[tuple[PositiveNumber, ...], *DISTINCT] = Field(description=f"frequencies, rad/s, {OR_SWEEP}")
    waves_from: Literal["left", "right"] = Field(default="left", description="the side from which waves come")
    positions: Annotated[int, Strict(), Field(ge=2, le=MOST_VALUES)] = Field(
        default=101, description="points along each beam at which its deflection is reported"
    )
    wave_amplitude: PositiveNumber | None = Field(
        default=None,
        description="amplitude of the waves, m; needed beside quadratic damping, without effect elsewhere",
    )
    hull_pressures: Annotated[bool, Strict()] = Field(
        default=False, description="whether pressures along the hulls of floats are reported, and the drift by them"
    )
    fields_at: Annotated[tuple[PositiveNumber, ...], Field(max_length=MOST_FIELDS)] = Field(
        default=(),
        description="frequencies, rad/s, at which fields of sections are written and drawn, or waves around solids are "
        "drawn in plan; by default where a motion is largest",
    )

    @property
    def request(self) -> ResponseRequest:
        """What the solver is asked for."""
        return ResponseRequest(
            omega=self.omega,
            waves_from=self.waves_from,
            positions=self.positions,
            elevation=self.wave_amplitude or 0.0,
            hull_pressures=self.hull_pressures,
            fields_at=self.fields_at,
        )

    @model_serializer(mode="wrap")
    def _as_given(self, write: SerializerFunctionWrapHandler) -> dict[str, Any]:
        further = ("wave_amplitude", "hull_pressures", "fields_at")
        return {key: value for key, value in write(self).items() if key not in further or value}


class Resonance(SceneModel):
    """Complex frequencies of damped free motions."""

    kind: Literal["resonance"] = Field(default="resonance", description="kind of the analysis")
    count: Annotated[int, Strict(), Field(ge=1, le=200)] = Field(
        default=4, description="how many, from the smallest |ω|; of those below a frequency, if one is given, at most"
    )
    below: PositiveNumber | None = Field(
        default=None, description="frequency, rad/s; all whose Re ω is below it are asked for"
    )
    largest_damping: Annotated[float, Strict(), Field(ge=1e-6, le=2)] = Field(
        default=0.5, description="largest −Im ω/Re ω of the search; above 0.7 all depths must be infinite"
    )

    @property
    def request(self) -> ResonanceRequest:
        """What the solver is asked for."""
        return ResonanceRequest(count=self.count, below=self.below, largest_damping=self.largest_damping)


class Decay(SceneModel):
    """The motion of a released float."""

    kind: Literal["decay"] = Field(default="decay", description="kind of the analysis")
    displacement: Displacement = Field(
        description="displacement from which the float is released: heave in m, or a table {heave, roll} in m and rad"
    )
    body: Annotated[int, Strict(), Field(ge=1, le=1000)] = Field(
        default=1, description="number of the float among the bodies, from 1"
    )
    times: Annotated[tuple[NumberFromZero, ...], *DISTINCT] = Field(description=f"times, s, {OR_SWEEP}")

    @property
    def request(self) -> DecayRequest:
        """What the solver is asked for; bodies are counted from 0."""
        start = self.displacement
        return DecayRequest(body=self.body - 1, heave=start.heave, roll=start.roll or start.pitch, times=self.times)


Analysis: TypeAlias = Annotated[
    Annotated[Radiation, Tag("radiation")]
    | Annotated[Response, Tag("response")]
    | Annotated[Resonance, Tag("resonance")]
    | Annotated[Decay, Tag("decay")]
    | Annotated[Spectrum, Tag("spectrum")]
    | Annotated[ImpulseResponse, Tag("impulse_response")]
    | Annotated[Motion, Tag("motion")],
    Discriminator(kind_of),
]
"""Any analysis: the key ``kind`` tells which."""
