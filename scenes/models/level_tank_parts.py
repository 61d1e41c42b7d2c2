"""The parts of the scene of a tank in three dimensions, as frozen values. SI units."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, ClassVar, Literal, TypeAlias

from pydantic import (
    Discriminator,
    Field,
    SerializerFunctionWrapHandler,
    Strict,
    Tag,
    ValidationError,
    model_serializer,
    model_validator,
)
from pydantic_core import InitErrorDetails

from hydroelastic.physics import plate as physics
from hydroelastic.scenes.models.bodies import MOST_BODIES, MOST_VERTICES
from hydroelastic.scenes.models.folder import SceneInFolder
from hydroelastic.scenes.models.obstacles import GivenBaffle, GivenColumn
from hydroelastic.scenes.models.problems import problem_at
from hydroelastic.scenes.models.scene_model import AnyNumber, Place, PositiveNumber, SceneModel, SparseModel
from hydroelastic.scenes.models.tank_parts import Accuracy
from hydroelastic.scenes.models.thin_plates import ThinPlate, one_mass, one_rigidity, ring_has_a_hole
from hydroelastic.scenes.models.values import Title
from hydroelastic.scenes.models.volume_floats import VolumeFloat

PlanPoint: TypeAlias = tuple[AnyNumber, AnyNumber]
OutlineName: TypeAlias = Literal["rectangle", "strip", "disc", "ring", "polygon"]


SOLID_FORMATS = (".step", ".stp", ".brep")
"""Files of solids that gmsh reads by OpenCASCADE."""

MOST_BED_POINTS = 5_000
"""The smooth surface through n points takes n² numbers."""

KEYS_OF_OUTLINES: dict[OutlineName, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "rectangle": (("size",), ("position",)),
    "strip": (("start", "length"), ()),
    "disc": (("radius",), ("position",)),
    "ring": (("radius", "inner_radius"), ("position",)),
    "polygon": (("points",), ()),
}
"""Keys that each outline needs, and those that it may have."""

_OUTLINE_KEYS = ("position", "size", "start", "length", "radius", "inner_radius", "points")


class ShapedBed(SparseModel):
    """The bed of an upright tank that is not level: a slope, or a smooth surface through points.

    Raises:
        SceneError: if it is not given in one of the three ways.
    """

    slope: PlanPoint | None = Field(
        default=None, description="[along x, along y], rise of a plane bed per length; depth is that in the middle"
    )
    points: tuple[tuple[AnyNumber, AnyNumber, AnyNumber], ...] | None = Field(
        default=None,
        min_length=3,
        max_length=MOST_BED_POINTS,
        description="[x, y, height] of points of the bed, m, from any level; depth is that over the lowest of them",
    )
    file: Path | None = Field(default=None, description="text file with three columns, x, y and height, of such points")

    @model_validator(mode="after")
    def _given_once(self) -> ShapedBed:
        given = [key for key in ("slope", "points", "file") if getattr(self, key) is not None]
        if len(given) != 1:
            wrong = f"{' and '.join(given)} are given together" if given else "its shape is missing"
            found = problem_at((given[-1] if given else "slope",), None, wrong, allowed="one of slope, points and file")
            raise ValidationError.from_exception_data(type(self).__name__, [found])
        return self


class PlanTank(SceneModel):
    """An upright tank: a box, a cylinder or ring, or a plan of corners; or a tank of any shape from a file."""

    length: PositiveNumber | None = Field(default=None, description="length of a box along x, m")
    width: PositiveNumber | None = Field(default=None, description="width of a box along y, m")
    radius: PositiveNumber | None = Field(default=None, description="radius of an upright cylinder, m")
    inner_radius: PositiveNumber | None = Field(
        default=None, description="radius of an inner cylinder, m, about which the liquid is a ring"
    )
    plan: tuple[PlanPoint, ...] | None = Field(
        default=None,
        min_length=3,
        max_length=MOST_VERTICES,
        description=f"3 to {MOST_VERTICES} corners [x, y] of the plan, m",
    )
    shape: Path | None = Field(
        default=None,
        description="file of a tank of any shape, m: the inside as one solid (*.step, *.stp, *.brep), filled to depth "
        'above its lowest point, or a mesh of the liquid (*.msh) with the physical surface "free_surface", and '
        '"baffle" for thin walls inside',
    )
    bed: ShapedBed | None = Field(default=None, description="bed of an upright tank that is not level")
    model: Literal["smallest", "volume"] = Field(
        default="smallest",
        description="whether the smallest model that fits is solved, or a mesh of the volume in any case",
    )
    gravity: PositiveNumber = Field(default=9.81, description="acceleration of gravity, m/s²")
    ends: Literal["walls"] = Field(default="walls", description="rigid vertical walls all around")
    top: Literal["free", "rigid", "pressure_release"] = Field(
        default="free",
        description="the top beside the plates: free surface with waves, rigid lid, or ψ = 0 without gravity waves",
    )

    @model_serializer(mode="wrap")
    def _without_idle_keys(self, write: SerializerFunctionWrapHandler) -> dict[str, Any]:
        idle = {"model": "smallest"}
        return {key: value for key, value in write(self).items() if value is not None and idle.get(key) != value}


class PlanLiquid(SparseModel):
    """An ideal incompressible liquid."""

    density: PositiveNumber = Field(description="density, kg/m³")
    depth: PositiveNumber | None = Field(
        default=None,
        description="depth, m; of the lowest one over the middle of a sloping bed, over the lowest point of a bed of "
        "points or of a file; a mesh (*.msh) has its own, which it must agree with if it is given",
    )


class Plate(ThinPlate):
    """A thin elastic or rigid plate without draught that floats on the liquid.

    Raises:
        SceneError: if keys do not belong to the outline, or rigidity or mass are given twice or not at all.
    """

    outline: OutlineName = Field(description="shape of the plate at rest")
    position: PlanPoint | None = Field(
        default=None, description="[x, y] of its centre, m; by default the middle of the tank"
    )
    size: tuple[PositiveNumber, PositiveNumber] | None = Field(
        default=None, description="[along x, along y] of a rectangle, m"
    )
    start: Place | None = Field(default=None, description="distance of a strip's left edge from the left wall, m")
    length: PositiveNumber | None = Field(
        default=None, description="length of a strip along x, m; it reaches over the whole width"
    )
    points: tuple[PlanPoint, ...] | None = Field(
        default=None,
        min_length=3,
        max_length=MOST_VERTICES,
        description=f"3 to {MOST_VERTICES} corners [x, y] of a polygon, m",
    )
    edge: physics.Edge = Field(
        default="free",
        description="what holds edges that lie on walls: nothing, w = 0 (hinged), w = 0 and no slope (clamped), or no "
        "slope alone (sliding); the side edges of a strip always slide",
    )

    @model_validator(mode="after")
    def _keys_fit(self) -> Plate:
        problems = [*_keys_of_the_outline(self), *one_rigidity(self), *one_mass(self), *_thickness_has_effect(self)]
        if problems:
            raise ValidationError.from_exception_data(type(self).__name__, problems)
        return self


class Slats(SceneModel):
    """Beams side by side over the whole width of a box: a cover that bends along x alone."""

    kind: Literal["beam"] = Field(default="beam", description="kind of the body")
    start: Place = Field(description="distance of the left ends from the left wall, m")
    length: PositiveNumber = Field(description="length along x, m")
    flexural_rigidity: PositiveNumber = Field(description="EI per metre of width, N·m")
    mass_per_length: PositiveNumber = Field(description="mass per length and metre of width, kg/m²")
    hydrostatic: Annotated[bool, Strict()] = Field(
        default=True, description="whether the hydrostatic restoring ρ g w acts on the beams"
    )
    ends: Literal["free"] = Field(default="free", description="free ends: no moment, no shear force")

    shape_key: ClassVar[str] = "start"
    mass_key: ClassVar[str] = "mass_per_length"
    outline: ClassVar[str] = "strip"
    edge: ClassVar[physics.Edge] = "free"
    poisson_ratio: ClassVar[float] = 0.0

    @property
    def whole_rigidity(self) -> float:
        """EI per metre of width, N·m."""
        return self.flexural_rigidity

    @property
    def whole_mass(self) -> float:
        """Mass per area, kg/m²."""
        return self.mass_per_length


def _kind_of(body: Any) -> str:
    return str(body.get("kind", "plate") if isinstance(body, dict) else getattr(body, "kind", "plate"))


PlanBody: TypeAlias = Plate | Slats


def _keys_of_the_outline(plate: Plate) -> Iterator[InitErrorDetails]:
    needed, further = KEYS_OF_OUTLINES[plate.outline]
    for key in _OUTLINE_KEYS:
        value = getattr(plate, key)
        if key in needed and value is None:
            description = Plate.model_fields[key].description
            yield problem_at(
                (key,), None, f'it is missing, and outline = "{plate.outline}" needs it', allowed=f"{description}"
            )
        elif value is not None and key not in (*needed, *further):
            yield problem_at(
                (key,),
                value,
                f'it does not belong to outline = "{plate.outline}", which takes {" and ".join((*needed, *further))}',
                remedy="Leave it out",
            )
    yield from ring_has_a_hole(plate)


def _thickness_has_effect(plate: Plate) -> Iterator[InitErrorDetails]:
    if plate.thickness is not None and plate.density is None and plate.youngs_modulus is None:
        yield problem_at(
            ("thickness",),
            plate.thickness,
            "nothing follows from it without youngs_modulus or density",
            remedy="Leave it out",
        )


class LevelTankParts(SceneInFolder):
    """The parts of the scene of a tank in three dimensions, each valid by itself."""

    kind: Literal["tank"] = Field(default="tank", description="kind of the scene")
    title: Title = Field(default="", description="title of tables and images")
    tank: PlanTank = Field(description="the tank")
    liquid: tuple[PlanLiquid, ...] = Field(
        min_length=1, max_length=2, description="one liquid or two, from the bottom up"
    )
    body: tuple[
        Annotated[
            Annotated[Plate, Tag("plate")] | Annotated[Slats, Tag("beam")] | Annotated[VolumeFloat, Tag("float")],
            Discriminator(_kind_of),
        ],
        ...,
    ] = Field(
        default=(),
        max_length=MOST_BODIES,
        description=f"up to {MOST_BODIES} plates, beams side by side, or solid floats; none for sloshing alone",
    )
    column: tuple[GivenColumn, ...] = Field(
        default=(), max_length=MOST_BODIES, description="rigid columns from the bed to above the still surface"
    )
    baffle: tuple[GivenBaffle, ...] = Field(
        default=(), max_length=MOST_BODIES, description="thin rigid plates in the liquid that do not move"
    )
    accuracy: Accuracy = Field(default=Accuracy(), description="what is asked of the answer")

    @model_serializer(mode="wrap")
    def _without_idle_tables(self, write: SerializerFunctionWrapHandler) -> dict[str, Any]:
        return {key: value for key, value in write(self).items() if key not in ("column", "baffle") or value}

    @property
    def depth(self) -> float:
        """That of all liquids together, m, as it is given; 0 where a mesh tells it."""
        return sum(liquid.depth or 0.0 for liquid in self.liquid)

    @property
    def density(self) -> float:
        """That of the liquid on which bodies float, kg/m³."""
        return self.liquid[-1].density

    @property
    def plates(self) -> tuple[PlanBody, ...]:
        """The plates and the beams side by side."""
        return tuple(body for body in self.body if not isinstance(body, VolumeFloat))

    @property
    def floats(self) -> tuple[VolumeFloat, ...]:
        """The solid floats, which come after the plates."""
        return tuple(body for body in self.body if isinstance(body, VolumeFloat))
