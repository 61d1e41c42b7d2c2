"""The scene of a closed tank, or of open water of a drawn length: its model with all checks."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import Field, model_validator

from hydroelastic.scenes.models.attachments import Attachment
from hydroelastic.scenes.models.bodies import MOST_BODIES
from hydroelastic.scenes.models.body_kinds import Body
from hydroelastic.scenes.models.export import Export
from hydroelastic.scenes.models.export_checks import export_is_possible
from hydroelastic.scenes.models.open_analyses import Analysis
from hydroelastic.scenes.models.open_checks import drag_is_heeded
from hydroelastic.scenes.models.problems import problem, require_fit
from hydroelastic.scenes.models.sea_checks import attachments_hold_bodies, closed_tanks_have_springs_alone
from hydroelastic.scenes.models.tank_checks import STAGES
from hydroelastic.scenes.models.tank_kinds import is_level_tank
from hydroelastic.scenes.models.tank_parts import Accuracy, Liquids, MeshFile, Tank, TankParts
from hydroelastic.scenes.models.values import Title


class TankScene(TankParts):
    """A closed tank with one liquid or two and any number of bodies, or none (sloshing); or open water with bodies.

    Raises:
        SceneError: if a value is not allowed or the parts do not fit together.
    """

    kind: Literal["tank"] = Field(default="tank", description="kind of the scene")
    title: Title = Field(default="", description="title of tables and images")
    tank: Tank = Field(description="the tank")
    liquid: Liquids
    body: tuple[Body, ...] = Field(
        default=(),
        max_length=MOST_BODIES,
        description=f"up to {MOST_BODIES} bodies, in any order; none for sloshing alone",
    )
    attachment: tuple[Attachment, ...] = Field(
        default=(),
        max_length=MOST_BODIES,
        description=f"up to {MOST_BODIES} springs and dampers that hold bodies; between walls springs of floats",
    )
    analysis: tuple[Analysis, ...] = Field(
        default=(), description='what is asked of open water, one resonance analysis if empty; none with ends = "walls"'
    )
    accuracy: Accuracy = Field(default=Accuracy(), description="what is asked of the answer")
    export: Export | None = Field(default=None, description="files for other programs, of open water")
    mesh: MeshFile | None = Field(default=None, description="a mesh of your own")

    @model_validator(mode="before")
    @classmethod
    def _is_per_metre_of_width(cls, keys: Any) -> Any:
        if isinstance(keys, dict) and is_level_tank(keys):
            remedy = 'Make it with he.read({"kind": "tank", …}), of the same keys'
            raise problem("this is a tank in three dimensions, and a TankScene is per metre of width", remedy=remedy)
        return keys

    @model_validator(mode="after")
    def _parts_fit(self) -> TankScene:
        require_fit(
            self,
            (
                (attachments_hold_bodies, closed_tanks_have_springs_alone),
                *STAGES,
                (drag_is_heeded, export_is_possible),
            ),
        )
        return self
