"""Tanks that are solved order by order: the scene of one of revolution with floats of draught or a shaped bed, with
all checks. SI units."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import Annotated, Any, Literal

from pydantic import Discriminator, Field, Tag, ValidationError, model_validator
from pydantic_core import InitErrorDetails

from hydroelastic.physics.geometry import Geometry
from hydroelastic.scenes.models.bodies import MOST_BODIES, MOST_VERTICES, Float
from hydroelastic.scenes.models.body_kinds import kind_of_body
from hydroelastic.scenes.models.limits import is_at_most, shown_most
from hydroelastic.scenes.models.problems import problem_at, require_fit
from hydroelastic.scenes.models.revolved_floats import RevolvedFloat
from hydroelastic.scenes.models.round_plate_checks import round_plates_are_in_range, round_plates_keep_apart
from hydroelastic.scenes.models.round_plates import SeaPlate
from hydroelastic.scenes.models.scene_model import AnyNumber, PositiveNumber, SceneModel
from hydroelastic.scenes.models.tank_checks import STAGES
from hydroelastic.scenes.models.tank_parts import Accuracy, Liquids, RoundTank, TankParts
from hydroelastic.scenes.models.values import Title


class OrderedTankScene(TankParts):
    """A tank whose modes are solved for order by order, with floats or none."""

    kind: Literal["tank"] = Field(default="tank", description="kind of the scene")
    title: Title = Field(default="", description="title of tables and images")
    tank: Any
    liquid: Liquids
    body: Any = ()
    accuracy: Accuracy = Field(default=Accuracy(), description="what is asked of the answer")

    @property
    def analysis(self) -> tuple[()]:
        """None: a tank with walls has modes."""
        return ()

    @property
    def attachment(self) -> tuple[()]:
        """None: nothing holds the floats."""
        return ()

    @property
    def mesh(self) -> None:
        """None: the meshes are those of the half-plane."""

    @property
    def bed(self) -> tuple[tuple[float, float], ...] | Literal["sphere"] | None:
        """See `TankParts.bed`."""
        return self.tank.outline

    @model_validator(mode="after")
    def _parts_fit(self) -> OrderedTankScene:
        problems = list(_bed_fits(self))
        if problems:
            raise ValidationError.from_exception_data(type(self).__name__, problems)
        require_fit(self, (*STAGES, (_plates_lie_in_the_tank, round_plates_keep_apart, round_plates_are_in_range)))
        return self


RoundBody = Annotated[
    Annotated[RevolvedFloat, Tag("float")] | Annotated[SeaPlate, Tag("plate")], Discriminator(kind_of_body)
]


class RoundTankScene(OrderedTankScene):
    """A tank of revolution, with floats and plates on its axis or none.

    Raises:
        SceneError: if a value is not allowed or the parts do not fit together.
    """

    tank: RoundTank = Field(description="the tank")
    body: tuple[RoundBody, ...] = Field(
        default=(), max_length=MOST_BODIES, description=f"up to {MOST_BODIES} floats and plates on the axis"
    )

    @property
    def bed(self) -> tuple[tuple[float, float], ...] | Literal["sphere"] | None:
        """See `TankParts.bed`."""
        return "sphere" if self.tank.shape == "sphere" else self.tank.outline

    @property
    def is_revolved(self) -> bool:
        """See `TankParts.is_revolved`."""
        return True


def _plates_lie_in_the_tank(scene: OrderedTankScene) -> Iterator[InitErrorDetails]:
    for index, plate in scene.plates:
        if not is_at_most(plate.radius, scene.tank.length):
            yield problem_at(
                ("body", index, "radius"),
                plate.radius,
                "the plate is wider than the tank",
                allowed=f"up to {shown_most(scene.tank.length)} m, the tank's radius",
            )


def _bed_fits(scene: OrderedTankScene) -> Iterator[InitErrorDetails]:
    outline = scene.tank.outline
    if outline is None:
        return
    if scene.bed == "sphere":
        yield problem_at(("tank", "outline"), None, 'shape = "sphere" has no other bed', remedy="Leave one of them out")
        return
    depth, length = scene.liquid[0].depth, scene.tank.length
    rises = all(start[0] < end[0] for start, end in pairwise(outline))
    if outline[0][0] != 0.0 or outline[-1][0] != length or not rises:
        x, start = ("r, z", "the axis") if scene.is_revolved else ("x, y", "the left")
        yield problem_at(
            ("tank", "outline"),
            None,
            f"it does not lead from {start} to the {'wall' if scene.is_revolved else 'right'}",
            allowed=f"corners [{x}] with ascending {x[0]}, from {x[0]} = 0 to {x[0]} = {length:.12g} m",
        )
    elif max(z for _, z in outline) > 0.0 or abs(min(z for _, z in outline) + depth) > 1e-9 * depth:
        yield problem_at(
            ("tank", "outline"),
            None,
            f"its lowest corner does not lie {depth:.12g} m under the surface, the liquid's depth, or one above it",
            allowed=f"corners with {'z' if scene.is_revolved else 'y'} from {-depth:.12g} m, once at least, to 0",
        )


class CanalTank(SceneModel):
    """A tank between two walls across its section, with y = 0 at the still surface and x from the left end."""

    length: PositiveNumber = Field(description="length of the section at the still surface, m")
    width: PositiveNumber = Field(description="distance of the two walls across the section, m")
    gravity: PositiveNumber = Field(default=9.81, description="acceleration of gravity, m/s²")
    top: Literal["free", "rigid", "pressure_release"] = Field(
        default="free", description="the top beside the floats: free surface, lid, or ψ = 0 without gravity waves"
    )
    outline: tuple[tuple[AnyNumber, AnyNumber], ...] | None = Field(
        default=None,
        min_length=2,
        max_length=MOST_VERTICES,
        description=f"2 to {MOST_VERTICES} corners [x, y] of the bed from the left to the right end, m; by default it "
        "is level",
    )

    @property
    def ends(self) -> Literal["walls", "open"]:
        """Its section has walls at both ends."""
        return "walls"


class CanalScene(OrderedTankScene):
    """A tank of one section over a finite width, with floats over the whole width or none.

    Raises:
        SceneError: if a value is not allowed or the parts do not fit together.
    """

    tank: CanalTank = Field(description="the tank")
    body: tuple[Float, ...] = Field(
        default=(), max_length=MOST_BODIES, description=f"up to {MOST_BODIES} floats over the whole width, in any order"
    )

    @property
    def geometry(self) -> Geometry:
        """See `TankParts.geometry`."""
        return Geometry(kind="extruded", width=self.tank.width)
