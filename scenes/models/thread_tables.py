"""Parts of the scene of a thread in a stream as frozen values: thread, stream, loads, ends. SI units."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal, TypeAlias

from pydantic import Discriminator, Field, Tag

from hydroelastic.scenes.models.scene_model import AnyNumber, PositiveNumber, SceneModel
from hydroelastic.scenes.models.values import NumberFromZero, kind_of

Vector: TypeAlias = tuple[AnyNumber, AnyNumber, AnyNumber]
Horizontal: TypeAlias = tuple[AnyNumber, AnyNumber]

STANDARD_GRAVITY = 9.81


class FlexibleThread(SceneModel):
    """A uniform thread: line, wire, chain, hose."""

    length: PositiveNumber = Field(description="length without stretch, m")
    diameter: PositiveNumber | None = Field(
        default=None, description="diameter that drag, added mass and buoyancy are reckoned with, m"
    )
    mass: NumberFromZero = Field(default=0.0, description="mass per length, kg/m")
    weight: AnyNumber | None = Field(
        default=None,
        description="weight per length in the liquid, N/m, negative for a buoyant thread; by default that of the mass "
        "less that of the liquid in its place, which the diameter tells",
    )
    gravity: PositiveNumber = Field(default=STANDARD_GRAVITY, description="acceleration of gravity, m/s²")
    axial_rigidity: PositiveNumber | None = Field(default=None, description="EA, N; by default it does not stretch")
    flexural_rigidity: NumberFromZero = Field(default=0.0, description="EI, N·m²")
    tension: NumberFromZero | None = Field(
        default=None,
        description="tension at end B, N, of a straight thread between fixed ends that does not stretch; there its "
        "length does not tell it",
    )
    normal_drag: NumberFromZero = Field(
        default=0.0, description="drag coefficient Cn across the thread, of ρ d |u_n| u_n/2; 1 to 1.5 for most lines"
    )
    tangential_drag: NumberFromZero = Field(
        default=0.0, description="drag coefficient Ct along the thread, of ρ π d |u_t| u_t/2; 0.01 to 0.03 for most"
    )
    viscous_drag: NumberFromZero = Field(
        default=0.0, description="force across the thread by length and velocity, linear, N·s/m²"
    )
    added_mass: NumberFromZero = Field(
        default=0.0, description="added-mass coefficient across the thread, of ρ π d²/4; 1 for a round one"
    )
    reactive: Literal["none", "moving_load", "lighthill"] = Field(
        default="none",
        description="what of the liquid's reaction in a stream along the thread is modelled beyond added mass: "
        "nothing, the added mass as a load that moves with the stream, or Lighthill's momentum",
    )
    stretch_drag: Literal["none", "volume"] = Field(
        default="none", description="whether the drag follows the diameter of a thread that stretches at equal volume"
    )


class Veer(SceneModel):
    """A stream of one speed whose direction turns with the height."""

    speed: PositiveNumber = Field(description="speed, m/s")
    rate: AnyNumber = Field(description="angle by height, anticlockwise from x at z = 0, rad/m")


class LiquidStream(SceneModel):
    """The liquid and its stream: uniform, sheared, veering, or by a table. Without any of them it is at rest."""

    density: PositiveNumber = Field(description="density of the liquid, kg/m³")
    velocity: Horizontal | None = Field(default=None, description="(x, y) of the velocity at the height level, m/s")
    shear: Horizontal | None = Field(
        default=None, description="by how much (x, y) of the velocity grow with the height, 1/s"
    )
    level: AnyNumber = Field(default=0.0, description="height at which velocity holds, m")
    veer: Veer | None = Field(default=None, description="stream of one speed whose direction turns with the height")
    profile: tuple[Vector, ...] | None = Field(
        default=None,
        description="2 to 10 000 rows of height, m, and (x, y) of the velocity, m/s, upwards; constant beyond them",
    )
    file: Path | None = Field(
        default=None,
        description="text file with three columns, height in m and (x, y) of the velocity in m/s, upwards; relative "
        "to the folder of the scene",
    )
    interpolation: Literal["linear", "monotone", "spline", "cubic"] = Field(
        default="linear",
        description="between the rows of a profile: straight lines; monotone cubics, which do not overshoot the rows, "
        "and whose slope is continuous, not their curvature; a cubic spline, whose curvature is continuous and zero at "
        'the outer rows, and which may overshoot; "cubic" is an older name of "monotone"',
    )


class CarriedBody(SceneModel):
    """A body carried by a thread at a point."""

    weight: AnyNumber = Field(default=0.0, description="weight in the liquid, N; negative for a buoy")
    drag_area: NumberFromZero = Field(default=0.0, description="drag coefficient times area, of ρ C A |u| u/2, m²")
    mass: NumberFromZero = Field(default=0.0, description="mass, kg")
    added_mass: NumberFromZero = Field(default=0.0, description="mass of liquid that moves along, kg")


class PointOnThread(CarriedBody):
    """A body on the thread."""

    at: PositiveNumber = Field(description="distance from end A along the thread without stretch, m")


class FixedEnd(SceneModel):
    """An end held in place, by an anchor, a ship, a wall."""

    kind: Literal["fixed"] = Field(default="fixed", description="kind of the end")
    position: Vector = Field(default=(0.0, 0.0, 0.0), description="place (x, y, z), m")
    clamp: Vector | None = Field(
        default=None,
        description="direction in which the thread leaves end A, or arrives at end B, clamped; it needs flexural "
        "rigidity; by default the end turns freely",
    )


class FreeEnd(CarriedBody):
    """An end that moves freely, with a force or a body on it."""

    kind: Literal["free"] = Field(default="free", description="kind of the end")
    force: Vector = Field(default=(0.0, 0.0, 0.0), description="dead force on the end, N")
    taper: NumberFromZero = Field(
        default=0.0, le=1.0, description="shape of the end in a reactive liquid: 0 blunt, 1 tapered to a point"
    )


class SurfaceEnd(CarriedBody):
    """An end on a buoy that keeps it at a height and lets it drift."""

    kind: Literal["surface"] = Field(default="surface", description="kind of the end")
    level: AnyNumber = Field(default=0.0, description="height at which the end is kept, m")
    force: Horizontal = Field(default=(0.0, 0.0), description="(x, y) of a dead force on the end, N")


End: TypeAlias = Annotated[
    Annotated[FixedEnd, Tag("fixed")] | Annotated[FreeEnd, Tag("free")] | Annotated[SurfaceEnd, Tag("surface")],
    Discriminator(kind_of),
]
"""How an end is held: the key ``kind`` tells."""


class Ends(SceneModel):
    """Both ends of a thread."""

    a: End = Field(
        default=FixedEnd(), description="the end from which lengths are reckoned, by default fixed at the origin"
    )
    b: End = Field(description="the other end")
