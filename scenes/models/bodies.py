"""Bodies of a scene as frozen values: elastic beams and rigid floats. SI units, per metre of width."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, Literal, TypeAlias

from pydantic import (
    ConfigDict,
    Field,
    SerializerFunctionWrapHandler,
    Strict,
    ValidationError,
    model_serializer,
    model_validator,
)
from pydantic_core import InitErrorDetails

from hydroelastic.physics import beams
from hydroelastic.physics.beam_parts import Joint, Section
from hydroelastic.physics.dofs import Level, SectionMotion
from hydroelastic.scenes.models.problems import problem_at
from hydroelastic.scenes.models.scene_model import LARGEST, AnyNumber, Place, PositiveNumber, SceneModel

MOST_BODIES = 200
"""Of one scene: the mesh is graded towards both ends of each."""

MOST_SECTIONS = 100
"""Sections, and joints, of one beam: the mesh has a node at each, and more are rather a rigidity that varies."""

MOST_VERTICES = 100
"""Corners of a polygon: the mesh is graded towards each, and what has more is rather an outline."""

Shape: TypeAlias = Literal["exponential", "parabola", "ellipse", "wedge", "rectangle", "polygon", "outline"]


class BeamSection(SceneModel):
    """A uniform part of a stepped beam."""

    length: PositiveNumber = Field(description="length of the section, m")
    flexural_rigidity: PositiveNumber = Field(description="EI of the section per metre of width, N·m")
    mass_per_length: PositiveNumber = Field(description="mass of the section per length and metre of width, kg/m²")


class BeamJoint(SceneModel):
    """A joint of a beam, at which its slope may jump."""

    at: PositiveNumber = Field(description="distance from the left end of the beam, m")
    rotational_stiffness: Annotated[float, Strict(), Field(ge=0, le=LARGEST)] = Field(
        description="moment by a radian of the jump of the slope, per metre of width, N·m/rad; 0 is a hinge"
    )


def physical_sections(parts: tuple[BeamSection, ...]) -> tuple[Section, ...]:
    """Return the sections of a beam."""
    return tuple(
        Section(length=part.length, flexural_rigidity=part.flexural_rigidity, mass_per_length=part.mass_per_length)
        for part in parts
    )


def physical_joints(joints: tuple[BeamJoint, ...]) -> tuple[Joint, ...]:
    """Return the joints of a beam, from left to right."""
    ordered = sorted(joints, key=lambda joint: joint.at)
    return tuple(Joint(at=joint.at, rotational_stiffness=joint.rotational_stiffness) for joint in ordered)


UNIFORM_KEYS = ("length", "flexural_rigidity", "mass_per_length")
"""What a beam without sections is given by."""


def _sections_may_stand_for_means(schema: dict[str, Any]) -> None:
    """Require in the JSON schema only what a beam of sections has too."""
    schema["required"] = ["start"] if "start" in schema["required"] else []


class Beam(SceneModel):
    """An Euler–Bernoulli beam without draught that floats on a liquid: uniform, or of uniform sections.

    Of a beam of sections the length is their sum, the mass per length their mean, and the flexural rigidity that of the
    uniform beam of the same mean flexibility, l/EI = Σ lᵢ/EIᵢ; these means serve estimates of the resolution.

    Raises:
        SceneError: if sections stand beside the keys of a uniform beam.
    """

    model_config = ConfigDict(json_schema_extra=_sections_may_stand_for_means)

    kind: Literal["beam"] = Field(default="beam", description="kind of the body")
    at: Level | None = Field(
        default=None,
        description="where it floats: at the interface of two liquids, which is the default with two, or at the top",
    )
    start: Place = Field(description="distance of the left end from the left wall, m")
    length: PositiveNumber = Field(description="length, m; not beside sections")
    flexural_rigidity: PositiveNumber = Field(description="EI per metre of width, N·m; not beside sections")
    mass_per_length: PositiveNumber = Field(
        description="mass per length and metre of width, kg/m²; not beside sections"
    )
    hydrostatic: Annotated[bool, Strict()] = Field(
        default=True, description="whether the hydrostatic restoring Δρ g w acts on the beam"
    )
    ends: Literal["free", "guided"] = Field(
        default="free",
        description="free (no moment, no shear force) or guided (no slope, no shear force; only wall to wall)",
    )
    sections: tuple[BeamSection, ...] = Field(
        default=(),
        max_length=MOST_SECTIONS,
        description=f"up to {MOST_SECTIONS} sections from left to right, instead of length, flexural_rigidity, "
        "mass_per_length",
    )
    joints: tuple[BeamJoint, ...] = Field(
        default=(), max_length=MOST_SECTIONS, description=f"up to {MOST_SECTIONS} joints and hinges, from left to right"
    )

    @property
    def end(self) -> float:
        """Distance of the right end from the left wall, m."""
        return self.start + self.length

    @property
    def is_uniform(self) -> bool:
        """Whether it has neither sections nor joints."""
        return not self.sections and not self.joints

    @property
    def parts(self) -> tuple[BeamSection, ...]:
        """Its sections, from left to right: one of a uniform beam."""
        return self.sections or (BeamSection(**{key: getattr(self, key) for key in UNIFORM_KEYS}),)

    def location_of(self, number: int, key: str) -> tuple[str | int, ...]:
        """Return where a value of a section is given."""
        return ("sections", number, key) if self.sections else (key,)

    @property
    def hinges(self) -> tuple[float, ...]:
        """Where the joints without stiffness lie, m from the left end."""
        return tuple(joint.at for joint in self.joints if joint.rotational_stiffness == 0.0)

    def physical(self, level: Level) -> beams.Beam:
        """Return the beam at a level, in SI units."""
        return beams.Beam(
            sections=physical_sections(self.parts),
            joints=physical_joints(self.joints),
            start=self.start,
            level=level,
            hydrostatic=self.hydrostatic,
            ends=self.ends,
        )

    @model_validator(mode="before")
    @classmethod
    def _of_sections(cls, given: Any) -> Any:
        if not isinstance(given, dict) or not given.get("sections"):
            return given
        problems = [
            problem_at(
                (key,),
                given[key],
                "it is given beside sections, which have their own",
                remedy="Leave it out, or the sections",
            )
            for key in UNIFORM_KEYS
            if key in given
        ]
        if problems:
            raise ValidationError.from_exception_data(cls.__name__, problems)
        return given | _on_the_whole(given["sections"])

    @model_serializer(mode="wrap")
    def _as_given(self, write: SerializerFunctionWrapHandler) -> dict[str, Any]:
        left_out = UNIFORM_KEYS if self.sections else ()
        empty = tuple(key for key in ("sections", "joints") if not getattr(self, key))
        return {key: value for key, value in write(self).items() if key not in (*left_out, *empty)}


def _on_the_whole(sections: Any) -> dict[str, float]:
    """Length, mean flexural rigidity and mean mass of sections; arbitrary for invalid ones, which validation
    refuses."""
    try:
        parts = [part if isinstance(part, BeamSection) else BeamSection.model_validate(part) for part in sections]
    except (TypeError, ValidationError):
        return dict.fromkeys(UNIFORM_KEYS, 1.0)
    length = math.fsum(part.length for part in parts)
    return {
        "length": length,
        "flexural_rigidity": length / math.fsum(part.length / part.flexural_rigidity for part in parts),
        "mass_per_length": math.fsum(part.length * part.mass_per_length for part in parts) / length,
    }


class Float(SceneModel):
    """A rigid body that floats at a still level. Its frame: x from ``position``, y up from its reference level.

    Raises:
        SceneError: if the keys do not belong to the shape.
    """

    kind: Literal["float"] = Field(default="float", description="kind of the body")
    at: Level | None = Field(
        default=None,
        description="where it floats: at the interface of two liquids, which is the default with two, or at the top",
    )
    shape: Shape = Field(description="shape of the section")
    position: Place = Field(description="distance of the shape's x = 0 from the left wall, m")
    half_width: PositiveNumber | None = Field(
        default=None, description="half the width at the reference level, m; of all shapes but polygons and outlines"
    )
    half_height: PositiveNumber | None = Field(
        default=None,
        description="half the height, m, of the same shapes; of the exponential one its length of decay 1/μ",
    )
    tail: Annotated[float, Strict(), Field(ge=1e-9, le=0.5)] | None = Field(
        default=None,
        description="part of the half width at which the exponential shape is brought to a point; by default 0.001",
    )
    vertices: tuple[tuple[AnyNumber, AnyNumber], ...] | None = Field(
        default=None,
        min_length=3,
        max_length=MOST_VERTICES,
        description=f"3 to {MOST_VERTICES} corners [x, y] of a polygon in the float's frame, m, in either sense",
    )
    file: Path | None = Field(
        default=None,
        description="text file with two columns, x and y in m, of the points of an outline in the float's frame; "
        "relative to the folder of the scene",
    )
    corner_angle: Annotated[float, Strict(), Field(ge=1, le=180)] | None = Field(
        default=None, description="angle, degrees; where the outline turns more sharply it has a corner; by default 30"
    )
    mass: PositiveNumber | None = Field(
        default=None,
        description="mass, kg/m, by which it is immersed; by default the reference level lies at the still level",
    )
    draught: PositiveNumber | None = Field(
        default=None, description="depth of its lowest point below the still level, m; instead of mass, or beside it"
    )
    vertical_force: AnyNumber | None = Field(
        default=None,
        description="constant vertical force of moorings on the body, upwards positive, N/m, at its centre of mass: "
        "the weight is that of the displaced liquid and this force; by default none",
    )
    centre_of_mass: AnyNumber | None = Field(
        default=None,
        description="height of the centre of mass above the reference level, m; by default that of the area",
    )
    vertical_centre_of_gravity: AnyNumber | None = Field(
        default=None, description="height of the centre of mass above the still level, m; instead of centre_of_mass"
    )
    radius_of_gyration: PositiveNumber | None = Field(
        default=None,
        description="radius of gyration about the centre of mass, m; by default that of the homogeneous section",
    )
    inertia: PositiveNumber | None = Field(
        default=None, description="moment of inertia about the centre of mass, kg·m; instead of radius_of_gyration"
    )
    motions: tuple[SectionMotion, ...] = Field(
        default=("heave",), min_length=1, max_length=3, description="its free motions, each once"
    )
    boundary: Literal["exact", "thin"] = Field(
        default="exact", description="conditions on the contour itself, or those of a thin float on its middle line"
    )
    unstable: Literal["refuse", "solve"] = Field(
        default="refuse",
        description="treatment of an unstable float: refused, or its roll solved",
    )

    @property
    def start(self) -> float:
        """x by which it counts among the bodies, m: its position."""
        return self.position

    @property
    def end(self) -> float:
        """The same: where it ends follows from its shape."""
        return self.position

    @property
    def shape_key(self) -> str:
        """The key that defines the section."""
        return {"polygon": "vertices", "outline": "file"}.get(self.shape, "half_width")

    @model_serializer(mode="wrap")
    def _as_given(self, write: SerializerFunctionWrapHandler) -> dict[str, Any]:
        """Serialize a float without the keys that most lack, unless they are given."""
        return {key: value for key, value in write(self).items() if key not in LEFT_OUT or value is not None}

    @model_validator(mode="after")
    def _keys_fit(self) -> Float:
        problems = [*_keys_of_the_shape(self), *motions_differ(self.motions), *_thin_floats(self)]
        if problems:
            raise ValidationError.from_exception_data(type(self).__name__, problems)
        return self


SUBSTITUTES = {"draught": "mass", "vertical_centre_of_gravity": "centre_of_mass", "inertia": "radius_of_gyration"}
"""Keys of a float at rest, each with the one in whose place it may stand."""

LEFT_OUT = (*SUBSTITUTES, "vertical_force")
"""Keys that are written only where they are given."""

_PROFILE = ("half_width", "half_height")
NEEDED_KEYS: dict[Shape, tuple[str, ...]] = {
    "exponential": _PROFILE,
    "parabola": _PROFILE,
    "ellipse": _PROFILE,
    "wedge": _PROFILE,
    "rectangle": _PROFILE,
    "polygon": ("vertices",),
    "outline": ("file",),
}
FURTHER_KEYS: dict[Shape, tuple[str, ...]] = {"exponential": ("tail",), "outline": ("corner_angle",)}
_SHAPE_KEYS = (*_PROFILE, "vertices", "file", "tail", "corner_angle")

THIN_SHAPES: tuple[Shape, ...] = ("exponential", "parabola", "ellipse", "wedge")
"""Shapes whose half-width is a function of height that ends with zero, as the thin condition needs."""


def _keys_of_the_shape(body: Float) -> Iterator[InitErrorDetails]:
    needed, further = NEEDED_KEYS[body.shape], FURTHER_KEYS.get(body.shape, ())
    for key in _SHAPE_KEYS:
        value = getattr(body, key)
        if key in needed and value is None:
            description = Float.model_fields[key].description
            yield problem_at(
                (key,), None, f'it is missing, and shape = "{body.shape}" needs it', allowed=f"{description}"
            )
        elif value is not None and key not in (*needed, *further):
            owners = [shape for shape in NEEDED_KEYS if key in (*NEEDED_KEYS[shape], *FURTHER_KEYS.get(shape, ()))]
            yield problem_at(
                (key,),
                value,
                f'it does not belong to shape = "{body.shape}", which takes {" and ".join((*needed, *further))}',
                remedy=f"Leave it out; it belongs to {' or '.join(owners)}",
            )


def motions_differ(motions: tuple[str, ...]) -> Iterator[InitErrorDetails]:
    """Yield a problem of motions of which one is named twice."""
    if len(set(motions)) < len(motions):
        yield problem_at(("motions",), ", ".join(motions), "a motion is named twice", remedy="Name each once")


def _thin_floats(body: Float) -> Iterator[InitErrorDetails]:
    if body.boundary == "exact":
        return
    if body.shape not in THIN_SHAPES:
        yield problem_at(
            ("boundary",),
            body.boundary,
            f'a thin float ends in a point or a rounding above and below, shape = "{body.shape}" need not',
            allowed=f'"exact", or shape = {" or ".join(THIN_SHAPES)}',
        )
