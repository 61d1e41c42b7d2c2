"""The scene of a closed tank as frozen, validated values. SI units; 2-D, so per metre of width."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Annotated, Literal, TypeAlias

from pydantic import BaseModel, ConfigDict, Field, Strict, ValidationError, field_validator, model_validator
from pydantic_core import InitErrorDetails, PydanticCustomError

from hydroelastic.meshes.formats import FORMATS

SMALLEST, LARGEST = 1e-30, 1e30
"""Range of any positive quantity in SI: no product of a few of them overflows."""

ROUND_OFF = 1e-9
"""Lengths below this part of the tank's length count as zero: decimal input is not exact."""

DEPTH_TO_LENGTH = (1e-4, 1e3)
"""Below it the layer is too thin for cells that follow it along the tank; above it no motion reaches
the bottom (it decays as e^{-πy/L}), and the depth only adds cells and rounding."""

SHORTEST_BEAM = 1e-4
"""Part of the tank's length: with a shorter beam the lengths of one mesh lie too far apart."""

STIFFNESS_GROUP = (1e-15, 1e15)
"""EI/(ρ g l⁴): beyond this, bending or gravity is lost in the rounding of the other."""

MASS_GROUP = (1e-12, 1e12)
"""m/(ρ l): beyond this, the beam or the liquid is lost in the rounding of the other."""

PositiveNumber: TypeAlias = Annotated[float, Strict(), Field(ge=SMALLEST, le=LARGEST)]


class SceneModel(BaseModel):
    """Base of all parts of a scene: immutable, no unknown keys, no NaN or infinity."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


class Tank(SceneModel):
    """The rectangular tank and what closes it on top where no body floats."""

    length: PositiveNumber = Field(description="length of the tank between its walls, m")
    gravity: PositiveNumber = Field(default=9.81, description="acceleration of gravity, m/s²")
    ends: Literal["walls"] = Field(default="walls", description="both ends are rigid vertical walls")
    top: Literal["free", "rigid", "pressure_release"] = Field(
        default="free",
        description="the top beside the bodies: free surface with waves, rigid lid, or ψ = 0 without gravity waves",
    )


class Liquid(SceneModel):
    """A layer of ideal incompressible liquid."""

    density: PositiveNumber = Field(description="density, kg/m³")
    depth: PositiveNumber = Field(description="depth of the layer, m")


class Beam(SceneModel):
    """A uniform Euler–Bernoulli beam without draught that floats on the liquid."""

    kind: Literal["beam"] = Field(default="beam", description="kind of the body")
    start: Annotated[float, Strict(), Field(ge=0, le=LARGEST)] = Field(
        description="distance of the left end from the left wall, m"
    )
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


class Accuracy(SceneModel):
    """What is asked of the answer."""

    tolerance: Annotated[float, Strict(), Field(ge=1e-12, le=1e-1)] = Field(
        default=1e-6, description="asked relative error of the frequencies"
    )
    modes: Annotated[int, Strict(), Field(ge=1, le=200)] = Field(
        default=10, description="number of modes, from the lowest"
    )


class MeshFile(SceneModel):
    """A mesh of the liquid made by the user instead of the built-in one."""

    file: Path = Field(
        description=f"mesh file ({', '.join(FORMATS)}); a relative path starts at the folder of the scene"
    )

    @field_validator("file")
    @classmethod
    def _known_format(cls, file: Path) -> Path:
        if file.suffix.lower() not in FORMATS:
            raise _problem("it is not a known mesh format", allowed=", ".join(f"*{s}" for s in FORMATS))
        return file


class TankScene(SceneModel):
    """A closed tank with one liquid and any number of beams, or none (sloshing).

    Raises:
        ValidationError: (a ValueError) if a value is not allowed or the parts do not fit together.
    """

    kind: Literal["tank"] = Field(default="tank", description="kind of the scene")
    title: Annotated[str, Strict()] = Field(default="", description="title of tables and images")
    tank: Tank = Field(description="the tank")
    liquid: tuple[Liquid, ...] = Field(min_length=1, max_length=1, description="exactly one liquid")
    body: tuple[Beam, ...] = Field(default=(), description="the beams, in any order; none for sloshing alone")
    accuracy: Accuracy = Field(default=Accuracy(), description="what is asked of the answer")
    mesh: MeshFile | None = Field(default=None, description="a mesh of your own")

    @model_validator(mode="after")
    def _parts_fit(self) -> TankScene:
        for checks in (_CHECKS_OF_PLACE, _CHECKS_OF_PHYSICS):
            problems = [problem for check in checks for problem in check(self)]
            if problems:
                raise ValidationError.from_exception_data(type(self).__name__, problems)
        return self


@dataclass(frozen=True, kw_only=True)
class Segment:
    """A piece of the top of the liquid.

    Args:
        kind: what lies there.
        start: distance of its left end from the left wall, m.
        end: distance of its right end from the left wall, m.
        body: index of the body in the scene, or None beside the bodies.
    """

    kind: Literal["free", "rigid", "pressure_release", "beam"]
    start: float
    end: float
    body: int | None = None


def top_segments(scene: TankScene) -> tuple[Segment, ...]:
    """Return the top of the liquid from the left wall to the right one, without gaps.

    A beam whose end is within `ROUND_OFF` of a wall ends exactly there.
    """
    length = scene.tank.length
    negligible = ROUND_OFF * length
    segments = []
    reached = 0.0
    for index, beam in sorted(enumerate(scene.body), key=lambda numbered: numbered[1].start):
        start = beam.start if beam.start > negligible else 0.0
        end = beam.end if beam.end < length - negligible else length
        if start > reached:
            segments.append(Segment(kind=scene.tank.top, start=reached, end=start))
        segments.append(Segment(kind="beam", start=start, end=end, body=index))
        reached = end
    if reached < length:
        segments.append(Segment(kind=scene.tank.top, start=reached, end=length))
    return tuple(segments)


def _problem(wrong: str, *, allowed: str = "", remedy: str = "") -> PydanticCustomError:
    said = [wrong, f"allowed: {allowed}" if allowed else "", remedy]
    context = {"wrong": wrong, "allowed": allowed, "remedy": remedy, "message": "; ".join(filter(None, said))}
    return PydanticCustomError("scene", "{message}", context)


def _misfit(
    location: tuple[str | int, ...], value: object, wrong: str, *, allowed: str = "", remedy: str = ""
) -> InitErrorDetails:
    return InitErrorDetails(type=_problem(wrong, allowed=allowed, remedy=remedy), loc=location, input=value)


def _depth_fits_the_length(scene: TankScene) -> Iterator[InitErrorDetails]:
    depth, length = scene.liquid[0].depth, scene.tank.length
    least, most = DEPTH_TO_LENGTH
    if not least <= depth / length <= most:
        yield _misfit(
            ("liquid", 0, "depth"),
            depth,
            f"it is {depth / length:g} of the tank's length, too {'thin' if depth < length else 'deep'} to mesh",
            allowed=f"{least * length:g} to {most * length:g} m ({least:g} to {most:g} tank lengths)",
        )


def _beams_lie_in_the_tank(scene: TankScene) -> Iterator[InitErrorDetails]:
    length = scene.tank.length
    for index, beam in enumerate(scene.body):
        if beam.length > length * (1 + ROUND_OFF):
            yield _misfit(("body", index, "length"), beam.length, f"the beam is longer than the tank ({length:g} m)")
        elif beam.end > length * (1 + ROUND_OFF):
            yield _misfit(
                ("body", index, "start"),
                beam.start,
                f"the beam ends at {beam.end:g} m, outside the tank of {length:g} m",
                allowed=f"0 to {length - beam.length:g} m for this beam",
            )


def _beams_keep_apart(scene: TankScene) -> Iterator[InitErrorDetails]:
    ordered = sorted(enumerate(scene.body), key=lambda numbered: numbered[1].start)
    for (first, left), (second, right) in pairwise(ordered):
        if right.start - left.end <= ROUND_OFF * scene.tank.length:
            yield _misfit(
                ("body", second, "start"),
                right.start,
                f"the beam overlaps or touches [[body]] number {first + 1}, which ends at {left.end:g} m",
                remedy="Leave a gap between them",
            )


def _beams_are_not_too_short(scene: TankScene) -> Iterator[InitErrorDetails]:
    shortest = SHORTEST_BEAM * scene.tank.length
    for index, beam in enumerate(scene.body):
        if beam.length < shortest:
            yield _misfit(
                ("body", index, "length"),
                beam.length,
                "the beam is too short beside the tank for one mesh to show both",
                allowed=f"at least {shortest:g} m ({SHORTEST_BEAM:g} of the tank's length)",
            )


def _groups_are_in_range(scene: TankScene) -> Iterator[InitErrorDetails]:
    density, gravity = scene.liquid[0].density, scene.tank.gravity
    for index, beam in enumerate(scene.body):
        groups = (
            ("flexural_rigidity", "EI/(ρ g l⁴)", density * gravity * beam.length**4, STIFFNESS_GROUP),
            ("mass_per_length", "m/(ρ l)", density * beam.length, MASS_GROUP),
        )
        for key, formula, scale, (least, most) in groups:
            value = getattr(beam, key)
            if not least <= value / scale <= most:
                yield _misfit(
                    ("body", index, key),
                    value,
                    f"{formula} = {value / scale:g} is beyond what double precision can tell apart",
                    allowed=f"{least * scale:.3g} to {most * scale:.3g} for this beam and liquid",
                )


def _guided_beams_cover_the_tank(scene: TankScene) -> Iterator[InitErrorDetails]:
    negligible = ROUND_OFF * scene.tank.length
    for index, beam in enumerate(scene.body):
        covers = beam.start <= negligible and beam.end >= scene.tank.length - negligible
        if beam.ends == "guided" and not covers:
            yield _misfit(
                ("body", index, "ends"),
                beam.ends,
                "ends are guided by the walls, but this beam does not reach from wall to wall",
                allowed=f'"free", or start = 0 and length = {scene.tank.length:g}',
            )


def _something_moves(scene: TankScene) -> Iterator[InitErrorDetails]:
    if not scene.body and scene.tank.top != "free":
        yield _misfit(
            ("tank", "top"),
            scene.tank.top,
            "without a body and without a free surface nothing oscillates",
            remedy='Set top = "free" for sloshing, or add a [[body]]',
        )


_Check: TypeAlias = Callable[[TankScene], Iterator[InitErrorDetails]]

_CHECKS_OF_PLACE: tuple[_Check, ...] = (
    _depth_fits_the_length,
    _beams_are_not_too_short,
    _beams_lie_in_the_tank,
    _beams_keep_apart,
    _guided_beams_cover_the_tank,
)

_CHECKS_OF_PHYSICS: tuple[_Check, ...] = (_groups_are_in_range, _something_moves)
"""Made when the lengths are right, so that one wrong length is one message."""
