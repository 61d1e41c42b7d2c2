"""A float in a tank that is meshed in its volume, as it is written in scenes: a simple solid, an outline, a hull."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from math import pi
from pathlib import Path
from typing import TYPE_CHECKING, Literal, TypeAlias

from pydantic import Field, ValidationError, model_validator
from pydantic_core import InitErrorDetails

from hydroelastic.physics.hydrostatics import still_level
from hydroelastic.physics.plate import Point
from hydroelastic.physics.revolution import SolidOfRevolution
from hydroelastic.physics.solid_floats import RIGID_MOTIONS, RigidMotion, SolidFloat, SolidFloatShape
from hydroelastic.physics.solids import solid_of_revolution
from hydroelastic.scenes.models.bodies import MOST_VERTICES
from hydroelastic.scenes.models.problems import problem_at
from hydroelastic.scenes.models.revolved_floats import outline_is_beside_the_axis
from hydroelastic.scenes.models.scene_model import AnyNumber, PositiveNumber, SparseModel

if TYPE_CHECKING:
    from hydroelastic.physics.wetted_hulls import WettedHull

HULL_FORMATS = (".step", ".stp", ".brep", ".stl")
"""Files of hulls: solids of CAD, or triangles of their surface."""

_AGREED = 1e-3
"""Relative difference of two statements of one value that is accepted."""

_NEEDED: dict[SolidFloatShape, tuple[str, ...]] = {
    "cylinder": ("radius",),
    "sphere": ("radius",),
    "box": ("size",),
    "revolved": ("outline",),
    "hull": ("file", "vertical_centre_of_gravity"),
}
_OF_SHAPES = ("radius", "size", "outline", "file")


class UnfloatableError(ValueError):
    """A float does not float as it is given.

    Attributes:
        key: that is wrong.
    """

    def __init__(self, key: str, wrong: str) -> None:
        super().__init__(wrong)
        self.key = key


class VolumeFloat(SparseModel):
    """A rigid solid that floats upright by Archimedes' principle: its mass is that of the liquid it displaces.

    Raises:
        SceneError: if the keys do not belong to the shape.
    """

    kind: Literal["float"] = Field(description="kind of the body")
    shape: SolidFloatShape = Field(
        description="shape of the solid: an upright cylinder, a sphere, a box, a revolved outline, a hull of a file"
    )
    position: tuple[AnyNumber, AnyNumber] | None = Field(
        default=None,
        description="[x, y] of its axis, of a hull that of the origin of its file, m; by default the middle of the "
        "tank",
    )
    radius: PositiveNumber | None = Field(default=None, description="radius of a cylinder or sphere, m")
    size: tuple[PositiveNumber, PositiveNumber] | None = Field(
        default=None, description="[along x, along y] of a box, m"
    )
    outline: tuple[tuple[AnyNumber, AnyNumber], ...] | None = Field(
        default=None,
        min_length=3,
        max_length=MOST_VERTICES,
        description=f"3 to {MOST_VERTICES} corners [r, z] of a revolved outline, m, from the axis, r = 0, back to it; "
        "of a ring all around its section, with no r = 0",
    )
    file: Path | None = Field(
        default=None,
        description="file of a hull, m, z upwards: one solid (*.step, *.stp, *.brep), or the triangles of its surface "
        "(*.stl), which above the still level may be open",
    )
    draught: PositiveNumber | None = Field(
        default=None,
        description="depth of its lowest point below the still level, m; by default as the mass immerses it, a sphere "
        "floats half immersed, and of outlines and hulls z = 0 is the still level",
    )
    mass: PositiveNumber | None = Field(
        default=None, description="mass, kg, by which it is immersed; by default that of the liquid that it displaces"
    )
    vertical_centre_of_gravity: AnyNumber | None = Field(
        default=None,
        description="height of the centre of mass above the still level, m, over the centre of buoyancy; by default "
        "that of the solid, which but for spheres and outlines rises as far above the level as it is immersed; a hull "
        "needs it",
    )
    radii_of_gyration: tuple[PositiveNumber, PositiveNumber, PositiveNumber] | None = Field(
        default=None,
        description="[roll, pitch, yaw] about axes through the centre of mass, m; by default those of the homogeneous "
        "solid; a hull needs them, or inertia",
    )
    inertia: tuple[PositiveNumber, PositiveNumber, PositiveNumber] | None = Field(
        default=None,
        description="[roll, pitch, yaw], moments of inertia about axes through the centre of mass, kg·m²; instead of "
        "radii_of_gyration",
    )
    motions: tuple[RigidMotion, ...] = Field(
        default=RIGID_MOTIONS[:5], min_length=1, max_length=6, description="its free motions, each once"
    )

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
        return next(key for key in _OF_SHAPES if getattr(self, key) is not None)

    def solid(self, middle: Point, density: float, folder: Path) -> SolidFloat:
        """Return the float of a tank; SI units.

        Args:
            middle: of the tank, m.
            density: of the liquid in which it floats, kg/m³.

        Raises:
            UnfloatableError: if mass and draught do not fit together, or the file of a hull cannot be used.
        """
        volume = None if self.mass is None else self.mass / density
        hull: WettedHull | None = None
        outline: tuple[Point, ...] = ()
        if self.shape == "hull":
            hull = self._hull(folder, None if self.draught is not None else volume)
            found = hull.hydrostatics
            x, y = self.position or middle
            position = (x + found.axis[0], y + found.axis[1])
            size, depth = (hull.high[0] - hull.low[0], hull.high[1] - hull.low[1]), -hull.low[2]
            centre, radii = self.vertical_centre_of_gravity or 0.0, (0.0, 0.0, 0.0)
        else:
            position = self.position or middle
            size, depth, outline, centre, radii = self._simple(volume)
        solid = SolidFloat(
            shape=self.shape,
            size=size,
            draught=depth,
            position=position,
            centre_of_gravity=(centre if self.vertical_centre_of_gravity is None else self.vertical_centre_of_gravity),
            gyration=radii,
            motions=self.motions,
            outline=outline,
            hull=hull,
        )
        try:
            displaced = solid.hydrostatics.volume
        except ValueError as error:
            raise UnfloatableError(self.shape_key, str(error)) from error
        if volume is not None and abs(displaced - volume) > _AGREED * volume:
            raise UnfloatableError(
                "mass", f"with this draught it displaces {density * displaced:g} kg of the liquid, and has another mass"
            )
        given = self.radii_of_gyration
        if self.inertia is not None:
            roll, pitch, yaw = ((moment / (density * displaced)) ** 0.5 for moment in self.inertia)
            given = (roll, pitch, yaw)
        return solid if given is None else replace(solid, gyration=given)

    def _hull(self, folder: Path, volume: float | None) -> WettedHull:
        from hydroelastic.meshes.hull_file import wetted_hull
        from hydroelastic.meshes.tagged_mesh import MeshError

        assert self.file is not None
        file = (folder / self.file).resolve()
        if file.suffix.lower() not in HULL_FORMATS:
            raise UnfloatableError("file", f"it is not a known format: {', '.join(f'*{one}' for one in HULL_FORMATS)}")
        if not file.is_file():
            raise UnfloatableError("file", f"there is no file {file}")
        try:
            return wetted_hull(file, draught=self.draught, volume=volume)
        except MeshError as error:
            raise UnfloatableError("file", str(error)) from error

    def _simple(self, volume: float | None) -> _Simple:
        """Size, draught, outline, centre of mass and radii of gyration of the homogeneous solid."""
        radius = self.radius or 0.0
        if self.outline is not None:
            return self._revolved(self.outline, volume)
        along, across = self.size or (2.0 * radius, 2.0 * radius)
        depth = self.draught
        if depth is None and volume is not None:
            if self.shape == "sphere":
                depth = radius + self._level(solid_of_revolution("sphere", radius=radius), volume)
            else:
                depth = volume / (along * across * (1.0 if self.shape == "box" else 0.25 * pi))
        depth = depth or radius
        if self.shape == "sphere":
            return (along, across), depth, (), radius - depth, (radius * 0.4**0.5,) * 3
        # The whole solid is twice as high as its wetted part.
        part = 12.0 if self.shape == "box" else 16.0
        own = [side**2 / part for side in (across, along)]
        height = depth**2 / 3.0
        radii = ((own[0] + height) ** 0.5, (own[1] + height) ** 0.5, (own[0] + own[1]) ** 0.5)
        return (along, across), depth, (), 0.0, radii

    def _revolved(self, outline: tuple[Point, ...], volume: float | None) -> _Simple:
        solid, low = solid_of_revolution("revolved", outline=outline), min(z for _, z in outline)
        level = 0.0
        if self.draught is not None:
            level = low + self.draught
        elif volume is not None:
            level = self._level(solid, volume)
        moved = solid.moved((0.0, -level))
        try:
            widest = max(max(abs(arc.start[0]), abs(arc.end[0])) for arc in moved.below(0.0))
        except ValueError as error:
            raise UnfloatableError("outline", str(error)) from error
        whole = moved.moments()
        centre = whole.first[1] / whole.area
        across, along = whole.second[0] / whole.area, whole.second[1] / whole.area - centre**2
        radii = ((across + along) ** 0.5, (across + along) ** 0.5, (2.0 * across) ** 0.5)
        shifted = tuple((r, z - level) for r, z in outline)
        return (2.0 * widest, 2.0 * widest), level - low, shifted, centre, radii

    def _level(self, solid: SolidOfRevolution, volume: float) -> float:
        try:
            return still_level(solid, volume, (1.0, 0.0))
        except ValueError as error:
            most = solid.moments().area
            raise UnfloatableError(
                "mass", f"it sinks: as a whole it displaces {most:g} m³, not {volume:g} m³"
            ) from error


_Simple: TypeAlias = tuple[Point, float, tuple[Point, ...], float, tuple[float, float, float]]


def _keys_of_the_shape(body: VolumeFloat) -> Iterator[InitErrorDetails]:
    needed = _NEEDED[body.shape]
    for key in ("draught", *_OF_SHAPES, "vertical_centre_of_gravity"):
        value = getattr(body, key)
        missing = key in needed or (key == "draught" and body.shape in ("cylinder", "box") and body.mass is None)
        if value is None and missing:
            meaning = VolumeFloat.model_fields[key].description
            yield problem_at((key,), None, f'it is missing, and shape = "{body.shape}" needs it', allowed=f"{meaning}")
        elif value is not None and key in _OF_SHAPES and key not in needed:
            wrong = f'it does not belong to shape = "{body.shape}", which takes {needed[0]}'
            yield problem_at((key,), value, wrong, remedy="Leave it out")
    if body.inertia is not None and body.radii_of_gyration is not None:
        wrong = "it is given beside radii_of_gyration"
        yield problem_at(("inertia",), list(body.inertia), wrong, remedy="Leave one of both out")
    if body.shape == "hull" and body.inertia is None and body.radii_of_gyration is None:
        yield problem_at(
            ("radii_of_gyration",), None, 'it is missing, and shape = "hull" needs it', allowed="it, or inertia"
        )
    if body.outline is not None:
        yield from outline_is_beside_the_axis(body.outline)
    if body.shape == "sphere" and body.radius and (body.draught or 0.0) >= 2.0 * body.radius:
        allowed_depth = f"less than {2.0 * body.radius:g} m"
        yield problem_at(("draught",), body.draught, "the sphere is under water", allowed=allowed_depth)
    if "yaw" in body.motions and body.shape not in ("box", "hull"):
        yield problem_at(("motions",), list(body.motions), "the liquid does not feel the yaw of a round float")
