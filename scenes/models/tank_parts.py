"""The parts of the scene of a closed tank or of open water, as frozen values. SI units; 2-D, so per metre of width."""

from __future__ import annotations

from functools import cached_property
from math import isinf
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal, TypeAlias

from pydantic import (
    Field,
    PrivateAttr,
    SerializerFunctionWrapHandler,
    Strict,
    field_validator,
    model_serializer,
)

from hydroelastic.meshes.formats import FORMATS
from hydroelastic.physics.geometry import PLANE, Geometry
from hydroelastic.scenes.models.attachments import Attachment
from hydroelastic.scenes.models.bodies import MOST_VERTICES, Level
from hydroelastic.scenes.models.body_kinds import AnyBeam, AnyBody, AnyFloat
from hydroelastic.scenes.models.export import Export
from hydroelastic.scenes.models.open_analyses import Analysis, Resonance
from hydroelastic.scenes.models.problems import problem
from hydroelastic.scenes.models.revolved_floats import RevolvedFloat
from hydroelastic.scenes.models.round_plates import SeaPlate
from hydroelastic.scenes.models.scene_model import LARGEST, SMALLEST, AnyNumber, PositiveNumber, SceneModel
from hydroelastic.scenes.models.values import PositiveOrInfinite


class Tank(SceneModel):
    """The rectangular tank and the boundary condition of its top beside the bodies."""

    length: PositiveNumber = Field(
        description="length of the tank between its walls, or of the stretch of open water that is drawn, m"
    )
    gravity: PositiveNumber = Field(default=9.81, description="acceleration of gravity, m/s²")
    ends: Literal["walls", "open"] = Field(
        default="walls",
        description="both ends are rigid vertical walls, or open water in which waves leave to both sides",
    )
    top: Literal["free", "rigid", "pressure_release"] = Field(
        default="free",
        description="the top beside the bodies: free surface with waves, rigid lid, or ψ = 0 without gravity waves",
    )


class Liquid(SceneModel):
    """A layer of ideal incompressible liquid."""

    density: Annotated[float, Strict(), Field(ge=0, le=LARGEST)] = Field(
        description="density, kg/m³; 0, of the upper of two only, is air, which is not modelled"
    )
    depth: PositiveOrInfinite = Field(description="depth of the layer, m; inf in open water alone")

    @field_validator("density")
    @classmethod
    def _density_or_air(cls, density: float) -> float:
        if 0.0 < density < SMALLEST:
            raise problem(
                "it is too small", allowed=f"0 for air, or a positive number from {SMALLEST:g} to {LARGEST:g}"
            )
        return density


class Accuracy(SceneModel):
    """Requested accuracy."""

    tolerance: Annotated[float, Strict(), Field(ge=1e-12, le=1e-1)] = Field(
        default=1e-6, description="asked relative error of frequencies, and of all else that open water is asked for"
    )
    modes: Annotated[int, Strict(), Field(ge=1, le=200)] = Field(
        default=10, description="number of modes, from the lowest"
    )


class MeshFile(SceneModel):
    """A mesh of the liquid by the user, in place of the built-in one."""

    file: Path = Field(
        description=f"mesh file ({', '.join(FORMATS)}); a relative path starts at the folder of the scene"
    )

    @field_validator("file")
    @classmethod
    def _known_format(cls, file: Path) -> Path:
        if file.suffix.lower() not in FORMATS:
            raise problem("it is not a known mesh format", allowed=", ".join(f"*{s}" for s in FORMATS))
        return file


Liquids: TypeAlias = Annotated[
    tuple[Liquid, ...],
    Field(min_length=1, max_length=2, description="one liquid or two, from the bottom up"),
]
"""The liquids of a scene."""


class RoundTank(SceneModel):
    """A tank of revolution about the vertical axis r = 0, with z = 0 at the still surface."""

    radius: PositiveNumber = Field(description="radius at the still surface, m")
    gravity: PositiveNumber = Field(default=9.81, description="acceleration of gravity, m/s²")
    top: Literal["free", "rigid", "pressure_release"] = Field(
        default="free", description="the top beside the floats: free surface, lid, or ψ = 0 without gravity waves"
    )
    shape: Literal["upright", "sphere"] = Field(
        default="upright",
        description="upright wall; or the part of a sphere below the still surface, whose radius is √(2Rh − h²) at a "
        "depth h in a sphere of radius R",
    )
    outline: tuple[tuple[AnyNumber, AnyNumber], ...] | None = Field(
        default=None,
        min_length=2,
        max_length=MOST_VERTICES,
        description=f"2 to {MOST_VERTICES} corners [r, z] of the bed from the axis to the wall, m; by default it is "
        "level",
    )

    @property
    def length(self) -> float:
        """The radius."""
        return self.radius

    @property
    def ends(self) -> Literal["walls", "open"]:
        """A tank of revolution has a wall."""
        return "walls"


class TankParts(SceneModel):
    """What the scenes of a tank and of the sea share: their liquids, bodies and analyses.

    Each part is valid by itself; `TankScene` and `SeaScene` check their consistency.
    """

    _folder: Path = PrivateAttr(default=Path())

    if TYPE_CHECKING:

        @property
        def kind(self) -> Literal["tank", "sea"]:
            """Kind of the scene, and name of its table."""

        @property
        def title(self) -> str:
            """Title of tables and images."""

        @property
        def tank(self) -> Any:
            """The tank, or the stretch of the sea that is drawn."""

        @property
        def liquid(self) -> tuple[Liquid, ...]:
            """The liquids, from the bottom up."""

        @property
        def body(self) -> tuple[AnyBody, ...]:
            """The bodies."""

        @property
        def attachment(self) -> tuple[Attachment, ...]:
            """Springs and dampers that hold the bodies."""

        @property
        def analysis(self) -> tuple[Analysis, ...]:
            """What is asked of open water."""

        @property
        def accuracy(self) -> Accuracy:
            """The accuracy that is asked."""

        @property
        def mesh(self) -> MeshFile | None:
            """A mesh by the user."""

        @property
        def export(self) -> Export | None:
            """Files for other programs."""

    def model_post_init(self, context: Any) -> None:
        """Keep the file's name for messages, which is not compared, and with outlines the folder, which is."""
        if context is None:
            return
        if any(body.file is not None for _, body in self.floats):
            self._folder = context["folder"]
        self.__dict__["source"] = context.get("source")

    @property
    def stretch(self) -> tuple[float, float]:
        """Abscissae of both ends of the tank, or of the stretch of open water that is drawn, m."""
        return 0.0, self.tank.length

    @property
    def phase_at(self) -> float:
        """Abscissa at which the crest of an incident wave is at t = 0, m."""
        return 0.0

    @property
    def folder(self) -> Path:
        """The folder of the scene file, or the current one."""
        return self._folder

    def state_of_file(self, body: AnyFloat) -> tuple[int, int] | None:
        """Time of the last change, ns, and size of the file of a float, by which changes are seen; ``None`` without."""
        if body.file is None:
            return None
        state = (self.folder / body.file).stat()
        return state.st_mtime_ns, state.st_size

    @cached_property
    def source(self) -> str | None:
        """Name of the scene file in messages, with its overrides; ``None`` if there is no file."""
        return None

    @property
    def layers(self) -> tuple[Liquid, ...]:
        """The liquids that are modelled, from the bottom up: without the air, of density 0, above the lower one."""
        return tuple(liquid for liquid in self.liquid if liquid.density > 0.0)

    @property
    def top(self) -> Literal["free", "rigid", "pressure_release"]:
        """Boundary condition of the uppermost modelled liquid beside the bodies: with air above it, the top is free.

        An infinitely deep upper liquid has no top; a distant lid is equivalent.
        """
        if len(self.layers) == 2 and isinf(self.layers[1].depth):
            return "rigid"
        return self.tank.top if len(self.layers) == len(self.liquid) else "free"

    @property
    def is_open(self) -> bool:
        """Whether waves leave to both sides."""
        return self.tank.ends == "open"

    @property
    def bed(self) -> tuple[tuple[float, float], ...] | Literal["sphere"] | None:
        """Corners of the bed from the left to the right wall, m, or "sphere"; None where it is level."""
        return None

    @property
    def is_revolved(self) -> bool:
        """Whether it is a sea of revolution: its bodies are solids and plates on one vertical axis, not sections."""
        return any(isinstance(body, RevolvedFloat | SeaPlate) for body in self.body)

    @property
    def geometry(self) -> Geometry:
        """What its section stands for."""
        return Geometry(kind="revolved") if self.is_revolved else PLANE

    @property
    def analyses(self) -> tuple[Analysis, ...]:
        """Analyses of open water; empty for a closed tank, whose modes are computed."""
        return (self.analysis or (Resonance(),)) if self.is_open else ()

    @property
    def beams(self) -> tuple[tuple[int, AnyBeam], ...]:
        """The beams, each with its index among the bodies."""
        return tuple((index, body) for index, body in enumerate(self.body) if isinstance(body, AnyBeam))

    @property
    def plates(self) -> tuple[tuple[int, SeaPlate], ...]:
        """The round plates, each with its index among the bodies."""
        return tuple((index, body) for index, body in enumerate(self.body) if isinstance(body, SeaPlate))

    @property
    def floats(self) -> tuple[tuple[int, AnyFloat], ...]:
        """The floats, each with its index among the bodies."""
        return tuple((index, body) for index, body in enumerate(self.body) if isinstance(body, AnyFloat))

    def level_of(self, body: AnyBody) -> Level:
        """Return the level at which a body floats; with one modelled liquid it is the surface."""
        if len(self.layers) == 1:
            return "surface"
        return body.at if body.at is not None else "interface"

    def height_of(self, level: Level) -> float:
        """Return the ordinate of a still level, m: 0 but for the surface of the upper of two liquids."""
        return self.layers[1].depth if level == "surface" and len(self.layers) == 2 else 0.0

    def densities_at(self, level: Level) -> tuple[float, float]:
        """Return the densities below and above a level, kg/m³; 0 above the surface."""
        densities = (*(layer.density for layer in self.layers), 0.0)
        place = len(self.layers) - 1 if level == "surface" else 0
        return densities[place], densities[place + 1]

    @model_serializer(mode="wrap")
    def _without_idle_keys(self, written: SerializerFunctionWrapHandler) -> dict[str, Any]:
        """Leave out empty lists, of attachments only in tanks, and files for other programs that are not asked for."""
        idle = ("analysis", "export", *(("attachment",) if self.kind == "tank" else ()))
        return {key: value for key, value in written(self).items() if key not in idle or value}
