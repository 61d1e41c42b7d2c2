"""The scene of a tank of revolution with floats of draught or a shaped bed: its model with all checks. SI units."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import Literal

from pydantic import Field, ValidationError, model_validator
from pydantic_core import InitErrorDetails

from hydroelastic.scenes.models.bodies import MOST_BODIES
from hydroelastic.scenes.models.problems import problem_at, require_fit
from hydroelastic.scenes.models.revolved_floats import RevolvedFloat
from hydroelastic.scenes.models.tank_checks import STAGES
from hydroelastic.scenes.models.tank_parts import Accuracy, Liquids, RoundTank, TankParts
from hydroelastic.scenes.models.title import Title


class RoundTankScene(TankParts):
    """A tank of revolution whose modes are solved for order by order, with floats on its axis or none.

    Raises:
        SceneError: if a value is not allowed or the parts do not fit together.
    """

    kind: Literal["tank"] = Field(default="tank", description="kind of the scene")
    title: Title = Field(default="", description="title of tables and images")
    tank: RoundTank = Field(description="the tank")
    liquid: Liquids
    body: tuple[RevolvedFloat, ...] = Field(
        default=(), max_length=MOST_BODIES, description=f"up to {MOST_BODIES} floats on the axis, in any order"
    )
    accuracy: Accuracy = Field(default=Accuracy(), description="what is asked of the answer")

    @property
    def analysis(self) -> tuple[()]:
        """None: a tank with walls has modes."""
        return ()

    @property
    def attachment(self) -> tuple[()]:
        """None: nothing holds the floats."""
        return ()

    @property
    def mesh(self) -> None:
        """None: the meshes are those of the half-plane."""

    @property
    def bed(self) -> tuple[tuple[float, float], ...] | None:
        """See `TankParts.bed`."""
        return self.tank.outline

    @property
    def is_revolved(self) -> bool:
        """See `TankParts.is_revolved`."""
        return True

    @model_validator(mode="after")
    def _parts_fit(self) -> RoundTankScene:
        problems = list(_bed_fits(self))
        if problems:
            raise ValidationError.from_exception_data(type(self).__name__, problems)
        require_fit(self, STAGES)
        return self


def _bed_fits(scene: RoundTankScene) -> Iterator[InitErrorDetails]:
    outline = scene.tank.outline
    if outline is None:
        return
    depth, radius = scene.liquid[0].depth, scene.tank.radius
    rises = all(start[0] < end[0] for start, end in pairwise(outline))
    if outline[0][0] != 0.0 or outline[-1][0] != radius or not rises:
        yield problem_at(
            ("tank", "outline"),
            None,
            "it does not lead from the axis to the wall",
            allowed=f"corners [r, z] with ascending r, from r = 0 to r = {radius:g} m",
        )
    elif max(z for _, z in outline) > 0.0 or abs(min(z for _, z in outline) + depth) > 1e-9 * depth:
        yield problem_at(
            ("tank", "outline"),
            None,
            f"its lowest corner does not lie {depth:g} m under the surface, the depth of the liquid, or one above it",
            allowed=f"corners with z from {-depth:g} m, once at least, to 0",
        )
