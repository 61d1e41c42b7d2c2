"""The kinds of bodies that a tank or open water may have."""

from __future__ import annotations

from difflib import get_close_matches
from typing import Annotated, Any, TypeAlias, get_args

from pydantic import Discriminator, Tag

from hydroelastic.scenes.models.bodies import Beam, Float, Shape
from hydroelastic.scenes.models.revolved_floats import SOLID_SHAPES, RevolvedFloat
from hydroelastic.scenes.models.round_plates import SeaPlate
from hydroelastic.scenes.models.varying_beam import VaryingBeam

AnyBeam: TypeAlias = Beam | VaryingBeam
"""A body that bends."""


AnyFloat: TypeAlias = Float | RevolvedFloat
"""A rigid body: a section, or a solid of revolution."""

AnyBody: TypeAlias = AnyBeam | AnyFloat | SeaPlate
"""Any body of a section or about an axis."""


def name_of_body(body: AnyBody) -> str:
    """Return what a body is called in messages."""
    return "float" if isinstance(body, AnyFloat) else "plate" if isinstance(body, SeaPlate) else "beam"


_SHAPES = (*get_args(Shape), *SOLID_SHAPES)


def kind_of_body(body: Any) -> str:
    """Return the kind of the model with which a body is read; that of the beam refuses what is not a table."""
    kind = body.get("kind", "beam") if isinstance(body, dict) else getattr(body, "kind", "beam")
    return str(kind)


def kind_of_sea_body(body: Any) -> str:
    """Return the same in the open sea, where the shape, or the one that it resembles, tells solids of revolution,
    "solid", from sections."""
    kind = kind_of_body(body)
    shape = body.get("shape") if isinstance(body, dict) else getattr(body, "shape", None)
    resembled = get_close_matches(str(shape), _SHAPES, n=1)
    return "solid" if kind == "float" and resembled and resembled[0] in SOLID_SHAPES else kind


Body: TypeAlias = Annotated[
    Annotated[Beam, Tag("beam")] | Annotated[VaryingBeam, Tag("varying_beam")] | Annotated[Float, Tag("float")],
    Discriminator(kind_of_body),
]
"""Any body: the key ``kind`` tells which, a beam where it is left out."""
