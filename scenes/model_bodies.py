"""Bodies of a scene as frozen values: elastic beams and rigid floats. SI units, per metre of width."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, Literal, TypeAlias

from pydantic import BaseModel, ConfigDict, Discriminator, Field, Strict, Tag

SMALLEST, LARGEST = 1e-30, 1e30
"""Range of any positive quantity in SI: no product of a few of them overflows."""

Level: TypeAlias = Literal["interface", "surface"]
Shape: TypeAlias = Literal["exponential", "parabola", "ellipse", "wedge", "rectangle", "polygon", "outline"]
Motion: TypeAlias = Literal["heave", "sway", "roll"]

PositiveNumber: TypeAlias = Annotated[float, Strict(), Field(ge=SMALLEST, le=LARGEST)]
AnyNumber: TypeAlias = Annotated[float, Strict(), Field(ge=-LARGEST, le=LARGEST)]
Place: TypeAlias = Annotated[float, Strict(), Field(ge=0, le=LARGEST)]


class SceneModel(BaseModel):
    """Base of all parts of a scene: immutable, no unknown keys, no NaN or infinity."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


class Beam(SceneModel):
    """A uniform Euler–Bernoulli beam without draught that floats on a liquid."""

    kind: Literal["beam"] = Field(default="beam", description="kind of the body")
    at: Level | None = Field(
        default=None,
        description="where it floats: the interface of two liquids, or the top of the uppermost one",
    )
    start: Place = Field(description="distance of the left end from the left wall, m")
    length: PositiveNumber = Field(description="length, m")
    flexural_rigidity: PositiveNumber = Field(description="EI per metre of width, N·m")
    mass_per_length: PositiveNumber = Field(description="mass per length and metre of width, kg/m²")
    hydrostatic: Annotated[bool, Strict()] = Field(
        default=True, description="whether the hydrostatic restoring ρ g w acts on the beam"
    )
    ends: Literal["free", "guided"] = Field(
        default="free",
        description="free (no moment, no shear force) or guided (no slope, no shear force; only wall to wall)",
    )

    @property
    def end(self) -> float:
        """Distance of the right end from the left wall, m."""
        return self.start + self.length


class Float(SceneModel):
    """A rigid body that floats at a still level. Its frame: x from ``position``, y up from its reference level."""

    kind: Literal["float"] = Field(description="kind of the body")
    at: Level | None = Field(
        default=None,
        description="where it floats: the interface of two liquids, or the top of the uppermost one",
    )
    shape: Shape = Field(description="shape of the section")
    position: Place = Field(description="distance of the shape's x = 0 from the left wall, m")
    half_width: PositiveNumber | None = Field(default=None, description="half the width at the reference level, m")
    half_height: PositiveNumber | None = Field(
        default=None, description="half the height, m; of the exponential shape 1/μ"
    )
    tail: Annotated[float, Strict(), Field(ge=1e-9, le=0.5)] | None = Field(
        default=None,
        description="part of the half width at which the exponential shape is cut, so that it ends in a point",
    )
    vertices: tuple[tuple[AnyNumber, AnyNumber], ...] | None = Field(
        default=None, description="corners [x, y] of the polygon in its own frame, m"
    )
    file: Path | None = Field(
        default=None,
        description="two columns x, y in the float's frame, m; a relative path starts at the folder of the scene",
    )
    corner_angle: Annotated[float, Strict(), Field(ge=1, le=180)] | None = Field(
        default=None, description="degrees; where the outline turns more sharply it has a corner"
    )
    mass: PositiveNumber | None = Field(
        default=None, description="mass per metre of width, kg/m; without it the reference level floats at the still level"
    )
    centre_of_mass: AnyNumber | None = Field(
        default=None, description="height of the centre of mass above the reference level, m"
    )
    radius_of_gyration: PositiveNumber | None = Field(
        default=None, description="radius of gyration about the centre of mass, m"
    )
    motions: tuple[Motion, ...] = Field(
        default=("heave",), min_length=1, max_length=3, description="in what ways it may move"
    )
    boundary: Literal["exact", "thin"] = Field(
        default="exact",
        description="conditions on the contour itself, or those of a thin body on its middle line",
    )
    unstable: Literal["refuse", "solve"] = Field(
        default="refuse", description="what to do if the float is not stable"
    )


def _kind_of(body: Any) -> str:
    """Which model a body is read with; what is no table is left to the beam's model to refuse."""
    kind = body.get("kind", "beam") if isinstance(body, dict) else getattr(body, "kind", "beam")
    return str(kind)


Body: TypeAlias = Annotated[Annotated[Beam, Tag("beam")] | Annotated[Float, Tag("float")], Discriminator(_kind_of)]
"""Any body: the key ``kind`` tells which, a beam where it is left out."""
