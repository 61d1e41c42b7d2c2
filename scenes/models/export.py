"""Files for other programs that a scene asks for, as frozen values."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from pydantic import AfterValidator, Field

from hydroelastic.scenes.models.problems import problem
from hydroelastic.scenes.models.scene_model import PositiveNumber, SceneModel

Format: TypeAlias = Literal["wamit", "bemio", "nemoh", "capytaine"]


def _all_different(formats: tuple[Format, ...]) -> tuple[Format, ...]:
    if len(set(formats)) < len(formats):
        raise problem("a format is named twice", remedy="Name each once")
    return formats


class Export(SceneModel):
    """Files of the hydrodynamics of whole bodies, for other programs."""

    formats: Annotated[tuple[Format, ...], Field(min_length=1), AfterValidator(_all_different)] = Field(
        description='"wamit" (.1, .3, .4, .hst), "bemio" (HDF5 of WEC-Sim), "nemoh" (tables), "capytaine" (NetCDF)'
    )
    width: PositiveNumber | None = Field(
        default=None,
        description="width of the bodies, m, whose sections are solved per metre of width; none of solids",
    )
