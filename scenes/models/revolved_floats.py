"""A floating solid of revolution as it is written in scenes: cylinder, sphere, ellipsoid, cone, an outline, a ring."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any, ClassVar, Literal, get_args

from pydantic import Field, SerializerFunctionWrapHandler, ValidationError, model_serializer, model_validator
from pydantic_core import InitErrorDetails

from hydroelastic.physics.dofs import Level, SolidMotion
from hydroelastic.physics.solids import SolidShape
from hydroelastic.scenes.models.bodies import LEFT_OUT, MOST_VERTICES, motions_differ
from hydroelastic.scenes.models.problems import problem_at
from hydroelastic.scenes.models.scene_model import AnyNumber, PositiveNumber, SceneModel

SOLID_SHAPES: tuple[SolidShape, ...] = get_args(SolidShape)


class RevolvedFloat(SceneModel):
    """A rigid solid of revolution about the vertical axis r = 0, z up from the still level.

    Raises:
        SceneError: if the keys do not belong to the shape.
    """

    kind: Literal["float"] = Field(default="float", description="kind of the body")
    at: Level | None = Field(
        default=None,
        description="where it floats: at the interface of two liquids, which is the default with two, or at the top",
    )
    shape: SolidShape = Field(description="shape of the solid of revolution")
    radius: PositiveNumber | None = Field(
        default=None, description="largest radius, m; that of cones at the still level; of all shapes but revolved ones"
    )
    inner_radius: PositiveNumber | None = Field(
        default=None, description="radius of the hole of a ring, m; of cylinders"
    )
    draught: PositiveNumber | None = Field(
        default=None,
        description="depth of its lowest point below the still level, m; by default a sphere floats half immersed, and "
        "a revolved outline has z = 0 at the still level",
    )
    outline: tuple[tuple[AnyNumber, AnyNumber], ...] | None = Field(
        default=None,
        min_length=3,
        max_length=MOST_VERTICES,
        description=f"3 to {MOST_VERTICES} corners [r, z] of a revolved outline, m, from the axis, r = 0, back to it; "
        "of a ring all around its section, with no r = 0",
    )
    mass: PositiveNumber | None = Field(
        default=None, description="mass, kg, by which it is immersed; by default that of the water that it displaces"
    )
    vertical_force: AnyNumber | None = Field(
        default=None,
        description="constant vertical force of moorings on the body, upwards positive, N, at its centre of mass: the "
        "weight is that of the displaced liquid and this force; by default none",
    )
    vertical_centre_of_gravity: AnyNumber | None = Field(
        default=None,
        description="height of the centre of mass above the still level, m; by default that of the volume, which for "
        "cylinders, ellipsoids and cones rises as far above the level as it is immersed",
    )
    radius_of_gyration: PositiveNumber | None = Field(
        default=None,
        description="radius of gyration of pitch about the centre of mass, m; by default that of the homogeneous solid",
    )
    inertia: PositiveNumber | None = Field(
        default=None,
        description="moment of inertia of pitch about the centre of mass, kg·m²; instead of radius_of_gyration",
    )
    motions: tuple[SolidMotion, ...] = Field(
        default=("heave",), min_length=1, max_length=3, description="its free motions, each once"
    )
    unstable: Literal["refuse", "solve"] = Field(
        default="refuse", description="treatment of an unstable float: refused, or its pitch solved"
    )
    # What sections have, and checks of all floats ask for.
    position: ClassVar[float] = 0.0
    start: ClassVar[float] = 0.0
    end: ClassVar[float] = 0.0
    boundary: ClassVar[Literal["exact", "thin"]] = "exact"
    file: ClassVar[Path | None] = None
    centre_of_mass: ClassVar[float | None] = None

    @property
    def vertices(self) -> tuple[tuple[float, float], ...] | None:
        """Corners of the outline."""
        return self.outline

    @property
    def half_width(self) -> float | None:
        """The radius."""
        return self.radius

    @property
    def half_height(self) -> float | None:
        """The draught."""
        return self.draught

    @property
    def shape_key(self) -> str:
        """The key that defines the section."""
        return "outline" if self.shape == "revolved" else "radius"

    @model_serializer(mode="wrap")
    def _as_given(self, write: SerializerFunctionWrapHandler) -> dict[str, Any]:
        """Serialize a float without the keys that most lack, unless they are given."""
        return {key: value for key, value in write(self).items() if key not in LEFT_OUT or value is not None}

    @model_validator(mode="after")
    def _keys_fit(self) -> RevolvedFloat:
        problems = [*_keys_of_the_shape(self), *motions_differ(self.motions)]
        if problems:
            raise ValidationError.from_exception_data(type(self).__name__, problems)
        return self


_NEEDED: dict[SolidShape, tuple[str, ...]] = {
    "cylinder": ("radius", "draught"),
    "sphere": ("radius",),
    "ellipsoid": ("radius", "draught"),
    "cone": ("radius", "draught"),
    "revolved": ("outline",),
}
_FURTHER: dict[SolidShape, tuple[str, ...]] = {
    "cylinder": ("inner_radius",),
    "sphere": ("draught",),
    "revolved": ("draught",),
}


def _keys_of_the_shape(body: RevolvedFloat) -> Iterator[InitErrorDetails]:
    needed = _NEEDED[body.shape]
    allowed = (*needed, *_FURTHER.get(body.shape, ()))
    for key in ("radius", "inner_radius", "draught", "outline"):
        value = getattr(body, key)
        if value is None and key in needed:
            meaning = RevolvedFloat.model_fields[key].description
            yield problem_at((key,), None, f'it is missing, and shape = "{body.shape}" needs it', allowed=f"{meaning}")
        elif value is not None and key not in allowed:
            yield problem_at(
                (key,),
                value,
                f'it does not belong to shape = "{body.shape}", which takes {" and ".join(allowed)}',
                remedy="Leave it out",
            )
    if body.radius is not None and body.inner_radius is not None and body.inner_radius >= body.radius:
        yield problem_at(
            ("inner_radius",), body.inner_radius, "it is not inside the ring", allowed=f"less than {body.radius:g} m"
        )
    if body.shape == "sphere" and body.radius is not None and (body.draught or 0.0) >= 2.0 * body.radius:
        yield problem_at(
            ("draught",), body.draught, "the sphere is under water", allowed=f"less than {2.0 * body.radius:g} m"
        )
    if body.outline is not None:
        yield from outline_is_beside_the_axis(body.outline)


def outline_is_beside_the_axis(outline: tuple[tuple[float, float], ...]) -> Iterator[InitErrorDetails]:
    """Yield what is wrong with the corners of a revolved outline."""
    radii = [r for r, _ in outline]
    on_axis = [place for place, r in enumerate(radii) if r == 0.0]
    if min(radii) < 0.0 or on_axis not in ([], [0, len(radii) - 1]):
        yield problem_at(
            ("outline",),
            None,
            "it is not one side of a section through the axis",
            allowed="corners [r, z] with r > 0, but for the first and the last one: both on the axis, r = 0, or none",
        )
