"""The scene of a tank of one section over a finite width, with waves across it: its model with all checks. SI units."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from hydroelastic.physics.geometry import Geometry
from hydroelastic.scenes.models.bodies import MOST_BODIES, MOST_VERTICES, Float
from hydroelastic.scenes.models.round_tank import OrderedTankScene
from hydroelastic.scenes.models.scene_model import AnyNumber, PositiveNumber, SceneModel


class CanalTank(SceneModel):
    """A tank between two walls across its section, with y = 0 at the still surface and x from the left end."""

    length: PositiveNumber = Field(description="length of the section at the still surface, m")
    width: PositiveNumber = Field(description="distance of the two walls across the section, m")
    gravity: PositiveNumber = Field(default=9.81, description="acceleration of gravity, m/s²")
    top: Literal["free", "rigid", "pressure_release"] = Field(
        default="free", description="the top beside the floats: free surface, lid, or ψ = 0 without gravity waves"
    )
    outline: tuple[tuple[AnyNumber, AnyNumber], ...] | None = Field(
        default=None,
        min_length=2,
        max_length=MOST_VERTICES,
        description=f"2 to {MOST_VERTICES} corners [x, y] of the bed from the left to the right end, m; by default it "
        "is level",
    )

    @property
    def ends(self) -> Literal["walls", "open"]:
        """Its section has walls at both ends."""
        return "walls"


class CanalScene(OrderedTankScene):
    """A tank of one section over a finite width, with floats over the whole width or none.

    Raises:
        SceneError: if a value is not allowed or the parts do not fit together.
    """

    tank: CanalTank = Field(description="the tank")
    body: tuple[Float, ...] = Field(
        default=(), max_length=MOST_BODIES, description=f"up to {MOST_BODIES} floats over the whole width, in any order"
    )

    @property
    def geometry(self) -> Geometry:
        """See `TankParts.geometry`."""
        return Geometry(kind="extruded", width=self.tank.width)
