"""What thin plates have in tanks and in the sea: stiffness and mass, as frozen values. SI units."""

from __future__ import annotations

from collections.abc import Iterator
from math import inf
from typing import Annotated, ClassVar, Literal

from pydantic import Field, Strict
from pydantic_core import InitErrorDetails

from hydroelastic.scenes.models.problems import problem_at
from hydroelastic.scenes.models.scene_model import LARGEST, PositiveNumber, SparseModel


class ThinPlate(SparseModel):
    """A thin elastic or rigid plate without draught that floats on the liquid."""

    shape_key: ClassVar[str] = "outline"
    mass_key: ClassVar[str] = "mass_per_area"

    kind: Literal["plate"] = Field(default="plate", description="kind of the body")
    outline: str = Field(description="shape of the plate at rest")
    radius: PositiveNumber | None = Field(default=None, description="radius of a disc, outer radius of a ring, m")
    inner_radius: PositiveNumber | None = Field(default=None, description="inner radius of a ring, m")
    flexural_rigidity: PositiveNumber | None = Field(default=None, description="D = E h³/(12(1 − ν²)), N·m")
    youngs_modulus: PositiveNumber | None = Field(
        default=None, description="Young's modulus E, N/m², with thickness instead of flexural_rigidity"
    )
    thickness: PositiveNumber | None = Field(default=None, description="h, m")
    rigid: Annotated[bool, Strict()] = Field(default=False, description="whether the plate does not bend")
    poisson_ratio: Annotated[float, Strict(), Field(ge=-0.99, le=0.5)] = Field(
        default=0.3, description="Poisson's ratio ν"
    )
    mass_per_area: Annotated[float, Strict(), Field(ge=0, le=LARGEST)] | None = Field(
        default=None, description="mass per area, kg/m²"
    )
    density: PositiveNumber | None = Field(
        default=None, description="density of the plate, kg/m³, with thickness instead of mass_per_area"
    )
    hydrostatic: Annotated[bool, Strict()] = Field(
        default=True, description="whether the hydrostatic restoring ρ g w acts on the plate"
    )

    @property
    def whole_rigidity(self) -> float:
        """D, N·m; infinite of a rigid plate."""
        if self.rigid:
            return inf
        if self.flexural_rigidity is not None:
            return self.flexural_rigidity
        assert self.youngs_modulus is not None
        assert self.thickness is not None
        return self.youngs_modulus * self.thickness**3 / (12.0 * (1.0 - self.poisson_ratio**2))

    @property
    def whole_mass(self) -> float:
        """Mass per area, kg/m²."""
        if self.mass_per_area is not None:
            return self.mass_per_area
        assert self.density is not None
        assert self.thickness is not None
        return self.density * self.thickness


def one_rigidity(plate: ThinPlate) -> Iterator[InitErrorDetails]:
    """Yield a stiffness that is missing or given twice."""
    given = [key for key in ("flexural_rigidity", "youngs_modulus") if getattr(plate, key) is not None]
    ways = "flexural_rigidity, or youngs_modulus with thickness, or rigid = true"
    if len(given) + plate.rigid != 1:
        wrong = "the stiffness of the plate is missing" if not given else "the stiffness of the plate is given twice"
        yield problem_at((given[-1] if given else "flexural_rigidity",), None, wrong, allowed=f"one of {ways}")
    elif plate.youngs_modulus is not None and plate.thickness is None:
        yield problem_at(("thickness",), None, "it is missing beside youngs_modulus", allowed="thickness, m")


def one_mass(plate: ThinPlate) -> Iterator[InitErrorDetails]:
    """Yield a mass that is missing or given twice."""
    if (plate.mass_per_area is None) == (plate.density is None):
        wrong = "the mass of the plate is missing" if plate.density is None else "the mass of the plate is given twice"
        yield problem_at(("mass_per_area",), None, wrong, allowed="mass_per_area, or density with thickness")
    elif plate.density is not None and plate.thickness is None:
        yield problem_at(("thickness",), None, "it is missing beside density", allowed="thickness, m")


def ring_has_a_hole(plate: ThinPlate) -> Iterator[InitErrorDetails]:
    """Yield an inner radius that is not inside a ring."""
    if plate.outline == "ring" and plate.radius and plate.inner_radius and plate.inner_radius >= plate.radius:
        yield problem_at(("inner_radius",), plate.inner_radius, "it is not less than radius", allowed="< radius")
