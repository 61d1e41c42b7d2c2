"""The scene of the open sea with floating bodies: its model with all checks. SI units, per metre of width."""

from __future__ import annotations

from functools import cached_property
from typing import Annotated, Any, Literal

from pydantic import Discriminator, Field, SerializerFunctionWrapHandler, Tag, model_serializer, model_validator

from hydroelastic.scenes.models.attachments import Attachment
from hydroelastic.scenes.models.bodies import MOST_BODIES, Beam, Float, Shape
from hydroelastic.scenes.models.body_kinds import AnyBody, AnyFloat, kind_of_sea_body
from hydroelastic.scenes.models.export import Export
from hydroelastic.scenes.models.export_checks import export_is_possible
from hydroelastic.scenes.models.floats import float_contour
from hydroelastic.scenes.models.open_analyses import Analysis
from hydroelastic.scenes.models.open_checks import azimuthal_orders_can_be_solved, drag_is_heeded
from hydroelastic.scenes.models.problems import problem, require_fit
from hydroelastic.scenes.models.revolved_floats import RevolvedFloat
from hydroelastic.scenes.models.round_plate_checks import round_plates_are_in_range, round_plates_keep_apart
from hydroelastic.scenes.models.round_plates import SeaPlate
from hydroelastic.scenes.models.scene_model import LARGEST, AnyNumber, PositiveNumber, SceneModel
from hydroelastic.scenes.models.sea_checks import attachments_hold_bodies
from hydroelastic.scenes.models.tank_checks import STAGES
from hydroelastic.scenes.models.tank_parts import Accuracy, Liquids, Tank, TankParts
from hydroelastic.scenes.models.values import Title
from hydroelastic.scenes.models.varying_beam import VaryingBeam

# Width of what is drawn to each side of the bodies, in lengths that these take up.
_DRAWN = 1.5


class Sea(SceneModel):
    """Gravity, the top of the upper liquid, the origin of phases, and what is drawn."""

    gravity: PositiveNumber = Field(default=9.81, description="acceleration of gravity, m/s²")
    top: Literal["free", "rigid", "pressure_release"] = Field(
        default="free", description="the top beside the bodies: free surface with waves; of two liquids also a lid"
    )
    phase_at: AnyNumber = Field(
        default=0.0, description="x of the point that the crest of the incident wave passes at t = 0, m"
    )
    drawn: tuple[AnyNumber, AnyNumber] | None = Field(
        default=None,
        description="x of both ends of what is drawn, m; by default the bodies with some water on either side",
    )

    @model_validator(mode="after")
    def _is_a_stretch(self) -> Sea:
        if self.drawn is not None and not self.drawn[0] < self.drawn[1]:
            raise problem("drawn does not go from left to right", allowed="[x of the left end, x of the right end]")
        return self

    @model_serializer(mode="wrap")
    def _as_given(self, write: SerializerFunctionWrapHandler) -> dict[str, Any]:
        return {key: value for key, value in write(self).items() if key != "drawn" or value is not None}


class SeaBeam(Beam):
    """A beam without draught, as in tanks; x may be negative."""

    start: AnyNumber = Field(default=0.0, description="x of the left end, m")


class SeaVaryingBeam(VaryingBeam):
    """A beam whose rigidity and mass vary along it, as in tanks; x may be negative."""

    start: AnyNumber = Field(default=0.0, description="x of the left end, m")


class SeaFloat(Float):
    """A rigid body that floats, as in tanks; x may be negative."""

    position: AnyNumber = Field(default=0.0, description="x of the origin of the float's frame, m")
    shape: Shape = Field(
        description="shape of the section; cylinder, sphere, ellipsoid, cone and revolved are solids of revolution"
    )


SeaBody = Annotated[
    Annotated[SeaBeam, Tag("beam")]
    | Annotated[SeaVaryingBeam, Tag("varying_beam")]
    | Annotated[SeaFloat, Tag("float")]
    | Annotated[RevolvedFloat, Tag("solid")]
    | Annotated[SeaPlate, Tag("plate")],
    Discriminator(kind_of_sea_body),
]


class SeaScene(TankParts):
    """Bodies that float in open water, which goes on to both sides; x = 0 is at the first body unless it says else.

    Raises:
        SceneError: if a value is not allowed or the parts do not fit together.
    """

    kind: Literal["sea"] = Field(default="sea", description="kind of the scene")
    title: Title = Field(default="", description="title of tables and images")
    sea: Sea = Field(default=Sea(), description="the sea")
    liquid: Liquids
    body: tuple[SeaBody, ...] = Field(
        default=(), max_length=MOST_BODIES, description=f"1 to {MOST_BODIES} bodies, in any order"
    )
    attachment: tuple[Attachment, ...] = Field(
        default=(), max_length=MOST_BODIES, description=f"up to {MOST_BODIES} springs and dampers that hold the bodies"
    )
    analysis: tuple[Analysis, ...] = Field(default=(), description="what is asked; one resonance analysis if empty")
    accuracy: Accuracy = Field(default=Accuracy(), description="what is asked of the answer")
    export: Export | None = Field(default=None, description="files for other programs, of open water")

    @property
    def mesh(self) -> None:
        """None: open water has a mesh of its own."""

    @cached_property
    def tank(self) -> Tank:
        """The stretch that is drawn, as open water of its length."""
        left, right = self.stretch
        # The bodies have their own limits, and the stretch that follows from them needs none.
        return Tank(length=min(right - left, LARGEST), gravity=self.sea.gravity, ends="open", top=self.sea.top)

    @cached_property
    def stretch(self) -> tuple[float, float]:
        """See `TankParts.stretch`."""
        if self.sea.drawn is not None:
            return self.sea.drawn
        lefts, rights = zip(*(_span(body, self) for body in self.body), strict=True) if self.body else ((0.0,), (0.0,))
        margin = _DRAWN * (max(rights) - min(lefts)) or 1.0
        return min(lefts) - margin, max(rights) + margin

    @property
    def phase_at(self) -> float:
        """See `TankParts.phase_at`."""
        return self.sea.phase_at

    @model_validator(mode="after")
    def _parts_fit(self) -> SeaScene:
        require_fit(
            self,
            (
                *STAGES,
                (round_plates_keep_apart, round_plates_are_in_range),
                (attachments_hold_bodies, drag_is_heeded, export_is_possible),
                (azimuthal_orders_can_be_solved,),
            ),
        )
        return self


def _span(body: AnyBody, scene: SeaScene) -> tuple[float, float]:
    if isinstance(body, SeaPlate):
        return -body.radius, body.radius
    if not isinstance(body, AnyFloat):
        return body.start, body.end
    # Contours need SciPy, whose import is slow.

    try:
        left, right = float_contour(body, scene.folder).bounds[:2]
    except ValueError:
        # An outline that cannot be read is refused by the checks.
        return body.position, body.position
    return body.position + left, body.position + right
