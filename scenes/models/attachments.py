"""Springs and dampers that hold floating bodies, as frozen values. SI units, per metre of width."""

from __future__ import annotations

from typing import Annotated, Any, TypeAlias

from pydantic import BeforeValidator, Field, Strict, model_validator

from hydroelastic.scenes.models.problems import problem
from hydroelastic.scenes.models.scene_model import LARGEST, AnyNumber, SparseModel
from hydroelastic.scenes.models.values import OrElse

_NOTHING = ((0.0, 0.0, 0.0),) * 3


def _as_matrix(value: Any) -> Any:
    if isinstance(value, list | tuple) and not any(isinstance(row, list | tuple) for row in value):
        if len(value) != 3:
            raise problem(f"there are {len(value)} numbers", allowed="three numbers, or three rows of three numbers")
        return tuple(tuple(entry if row == place else 0.0 for place in range(3)) for row, entry in enumerate(value))
    return value


_DIAGONAL = {"type": "array", "items": {"type": "number"}, "minItems": 3, "maxItems": 3}

Triple: TypeAlias = tuple[AnyNumber, AnyNumber, AnyNumber]
Matrix: TypeAlias = Annotated[tuple[Triple, Triple, Triple], BeforeValidator(_as_matrix), OrElse(_DIAGONAL)]
NotNegative: TypeAlias = Annotated[float, Strict(), Field(ge=0, le=LARGEST)]


class Attachment(SparseModel):
    """A spring and damper at a point of a body: a mooring, a fender, bilge keels, a power take-off."""

    body: Annotated[int, Strict(), Field(ge=1, le=1000)] = Field(default=1, description="number of the body, from 1")
    to: Annotated[int, Strict(), Field(ge=1, le=1000)] | None = Field(
        default=None, description="number of the body at its other end; by default that end is fixed"
    )
    at: tuple[AnyNumber, AnyNumber] | None = Field(
        default=None, description="[x, y] of the point, m; by default the centre of mass of a float"
    )
    stiffness: Matrix = Field(
        default=_NOTHING,
        description="three numbers for [heave, sway, roll], of solids [heave, surge, pitch], about the point, or a "
        "symmetric matrix of three rows, N/m²; of solids a metre more; "
        "of one roll in N/m, of two in N",
    )
    damping: Matrix = Field(
        default=_NOTHING,
        description="the same by velocities, which must not add power, kg/(m·s); of one roll in kg/s, of two in kg·m/s",
    )
    quadratic_damping: tuple[NotNegative, NotNegative, NotNegative] = Field(
        default=(0.0, 0.0, 0.0),
        description="β of [heave, sway, roll] about the point in forces β |v| v, kg/m²; of roll in kg·m",
    )

    @model_validator(mode="after")
    def _holds(self) -> Attachment:
        if not self.model_fields_set & {"stiffness", "damping", "quadratic_damping"}:
            raise problem("it has no force", remedy="Give stiffness, damping or quadratic_damping")
        return self
