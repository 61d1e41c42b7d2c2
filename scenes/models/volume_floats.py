"""A float in a tank that is meshed in its volume, as it is written in scenes: cylinder, sphere, box."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

from pydantic import Field, ValidationError, model_validator
from pydantic_core import InitErrorDetails

from hydroelastic.physics.plate import Point
from hydroelastic.physics.solid_floats import RIGID_MOTIONS, RigidMotion, SolidFloat, SolidFloatShape
from hydroelastic.scenes.models.bodies import AnyNumber, PositiveNumber, SparseModel
from hydroelastic.scenes.models.problems import problem_at

_NEEDED: dict[SolidFloatShape, tuple[str, ...]] = {
    "cylinder": ("radius", "draught"),
    "sphere": ("radius",),
    "box": ("size", "draught"),
}


class VolumeFloat(SparseModel):
    """A rigid solid that floats upright by Archimedes' principle: its mass is that of the liquid it displaces.

    Raises:
        SceneError: if the keys do not belong to the shape.
    """

    kind: Literal["float"] = Field(description="kind of the body")
    shape: SolidFloatShape = Field(description="shape of the solid: an upright cylinder, a sphere, a box")
    position: tuple[AnyNumber, AnyNumber] | None = Field(
        default=None, description="[x, y] of its axis, m; by default the middle of the tank"
    )
    radius: PositiveNumber | None = Field(default=None, description="radius of a cylinder or sphere, m")
    size: tuple[PositiveNumber, PositiveNumber] | None = Field(
        default=None, description="[along x, along y] of a box, m"
    )
    draught: PositiveNumber | None = Field(
        default=None,
        description="depth of its lowest point below the still level, m; by default a sphere floats half immersed",
    )
    vertical_centre_of_gravity: AnyNumber | None = Field(
        default=None,
        description="height of the centre of mass above the still level, m; by default that of the solid, which but "
        "for spheres rises as far above the level as it is immersed",
    )
    radii_of_gyration: tuple[PositiveNumber, PositiveNumber, PositiveNumber] | None = Field(
        default=None,
        description="[roll, pitch, yaw] about axes through the centre of mass, m; by default those of the homogeneous "
        "solid",
    )
    motions: tuple[RigidMotion, ...] = Field(
        default=RIGID_MOTIONS[:5], min_length=1, max_length=6, description="its free motions, each once"
    )

    outline: ClassVar[str] = "float"

    @model_validator(mode="after")
    def _keys_fit(self) -> VolumeFloat:
        problems = [*_keys_of_the_shape(self)]
        if len(set(self.motions)) < len(self.motions):
            problems.append(problem_at(("motions",), list(self.motions), "a motion is given twice"))
        if problems:
            raise ValidationError.from_exception_data(type(self).__name__, problems)
        return self

    @property
    def shape_key(self) -> str:
        """The key that defines its size."""
        return "size" if self.shape == "box" else "radius"

    def solid(self, middle: Point) -> SolidFloat:
        """Return the float of a tank with this middle; SI units."""
        radius = self.radius or 0.0
        along, across = self.size or (2.0 * radius, 2.0 * radius)
        depth = self.draught or radius
        # The whole solid is twice as high as its wetted part, but for spheres.
        if self.shape == "sphere":
            centre, radii = radius - depth, (radius * 0.4**0.5,) * 3
        else:
            part = 12.0 if self.shape == "box" else 16.0
            own = [side**2 / part for side in (across, along)]
            height = depth**2 / 3.0
            centre = 0.0
            radii = ((own[0] + height) ** 0.5, (own[1] + height) ** 0.5, (own[0] + own[1]) ** 0.5)
        given = self.vertical_centre_of_gravity
        return SolidFloat(
            shape=self.shape,
            size=(along, across),
            draught=depth,
            position=self.position or middle,
            centre_of_gravity=centre if given is None else given,
            gyration=self.radii_of_gyration or (radii[0], radii[1], radii[2]),
            motions=self.motions,
        )


def _keys_of_the_shape(body: VolumeFloat) -> Iterator[InitErrorDetails]:
    needed = _NEEDED[body.shape]
    allowed = (*needed, "draught")
    for key in ("radius", "size", "draught"):
        value = getattr(body, key)
        if value is None and key in needed:
            meaning = VolumeFloat.model_fields[key].description
            yield problem_at((key,), None, f'it is missing, and shape = "{body.shape}" needs it', allowed=f"{meaning}")
        elif value is not None and key not in allowed:
            wrong = f'it does not belong to shape = "{body.shape}", which takes {" and ".join(needed)}'
            yield problem_at((key,), value, wrong, remedy="Leave it out")
    if body.shape == "sphere" and body.radius and (body.draught or 0.0) >= 2.0 * body.radius:
        allowed_depth = f"less than {2.0 * body.radius:g} m"
        yield problem_at(("draught",), body.draught, "the sphere is under water", allowed=allowed_depth)
    if "yaw" in body.motions and body.shape != "box":
        yield problem_at(("motions",), list(body.motions), "the liquid does not feel the yaw of a round float")
