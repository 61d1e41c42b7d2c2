"""A circular or ring-shaped plate or membrane in the open sea as it is written in scenes. SI units."""

from __future__ import annotations

from typing import Literal

from pydantic import Field, ValidationError, model_validator

from hydroelastic.physics import round_plates as physics
from hydroelastic.physics.dofs import Level
from hydroelastic.scenes.models.problems import problem_at
from hydroelastic.scenes.models.scene_model import PositiveNumber
from hydroelastic.scenes.models.thin_plates import ThinPlate, one_mass, one_rigidity, ring_has_a_hole


class SeaPlate(ThinPlate):
    """A disc or ring about the vertical axis r = 0, with free edges and without draught.

    Raises:
        SceneError: if keys do not belong to the outline, or stiffness or mass are given twice or not at all.
    """

    at: Level | None = Field(
        default=None,
        description="where it floats: at the interface of two liquids, which is the default with two, or at the top",
    )
    outline: Literal["disc", "ring"] = Field(description="shape of the plate at rest")
    radius: PositiveNumber = Field(description="radius of a disc, outer radius of a ring, m")
    tension: PositiveNumber | None = Field(
        default=None,
        description="horizontal tension in all directions, N/m, of a membrane, or of a plate beside its rigidity",
    )

    @property
    def start(self) -> float:
        """The inner radius, m; 0 of a disc."""
        return self.inner_radius or 0.0

    @property
    def end(self) -> float:
        """The outer radius, m."""
        return self.radius

    @model_validator(mode="after")
    def _keys_fit(self) -> SeaPlate:
        problems = [*one_mass(self), *ring_has_a_hole(self)]
        is_membrane = self.tension is not None and self.youngs_modulus is self.flexural_rigidity is None
        if self.rigid or not is_membrane:
            problems += one_rigidity(self)
        if (self.inner_radius is None) != (self.outline == "disc"):
            wrong = "a ring needs it" if self.inner_radius is None else 'it does not belong to outline = "disc"'
            problems.append(problem_at(("inner_radius",), self.inner_radius, wrong, allowed="that of a ring, m"))
        if self.rigid and self.tension is not None:
            problems.append(problem_at(("tension",), self.tension, "a rigid plate has none", remedy="Leave it out"))
        if problems:
            raise ValidationError.from_exception_data(type(self).__name__, problems)
        return self

    @property
    def whole_rigidity(self) -> float:
        """D, N·m; 0 of a membrane, infinite of a rigid plate."""
        given = self.rigid or self.youngs_modulus is not None or self.flexural_rigidity is not None
        return super().whole_rigidity if given else 0.0

    def physical(self, level: Level) -> physics.RoundPlate:
        """Return the plate at a level."""
        return physics.RoundPlate(
            radius=self.radius,
            inner_radius=self.start,
            flexural_rigidity=self.whole_rigidity,
            mass_per_area=self.whole_mass,
            poisson_ratio=self.poisson_ratio,
            tension=self.tension or 0.0,
            thickness=self.thickness,
            hydrostatic=self.hydrostatic,
            level=level,
        )
