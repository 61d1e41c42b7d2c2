"""What the models of all parts of a scene share: construction by keywords, errors, and ranges of numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, TypeAlias

from pydantic import (
    BaseModel,
    ConfigDict,
    Field,
    SerializerFunctionWrapHandler,
    Strict,
    ValidationError,
    model_serializer,
)
from pydantic._internal._model_construction import ModelMetaclass

from hydroelastic.scenes.errors import Problem, SceneError, shown_value
from hydroelastic.scenes.validation_errors import scene_error

SMALLEST, LARGEST = 1e-30, 1e30
"""Range of any positive quantity in SI: no product of a few of them overflows."""

PositiveNumber: TypeAlias = Annotated[float, Strict(), Field(ge=SMALLEST, le=LARGEST)]
AnyNumber: TypeAlias = Annotated[float, Strict(), Field(ge=-LARGEST, le=LARGEST)]
Place: TypeAlias = Annotated[float, Strict(), Field(ge=0, le=LARGEST)]


class _Keyworded(ModelMetaclass):
    """Construction by keywords: values may be of NumPy, and errors are those of scene files."""

    if not TYPE_CHECKING:  # where the keywords are those of each model

        def __getattr__(cls, name: str) -> Any:  # noqa: N805
            """Return the signature, for help and completion in notebooks, which pydantic makes at the first use."""
            if name != "__signature__" or cls.__pydantic_complete__:
                return super().__getattr__(name)
            cls.model_rebuild()
            return cls.__signature__

        def __call__(cls, /, *values: Any, **keys: Any) -> Any:  # noqa: N805
            if values:
                raise TypeError(f"{cls.__name__} takes keywords alone: {', '.join(cls.model_fields)}")
            try:
                return super().__call__(**plain(keys))
            except ValidationError as error:
                raise scene_error(error, cls) from None


class SceneModel(BaseModel, metaclass=_Keyworded):
    """Base of all parts of a scene: immutable, no unknown keys, no NaN or infinity.

    Raises:
        SceneError: if a value is not allowed, or values do not fit together; ``model_validate`` raises a
            ``pydantic.ValidationError`` instead.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False, defer_build=True)

    if not TYPE_CHECKING:  # where an assignment is refused as it is

        def __setattr__(self, name: str, value: Any) -> None:
            try:
                super().__setattr__(name, value)
            except ValidationError:
                remedy = 'Make a changed copy of the scene, for example he.read(scene, {"tank.length": 7.0})'
                problem = Problem(key=name, value=shown_value(value), wrong="scenes cannot be changed", remedy=remedy)
                raise SceneError(problem) from None


class SparseModel(SceneModel):
    """A part of a scene that is written without the keys that are not given."""

    @model_serializer(mode="wrap")
    def _as_given(self, write: SerializerFunctionWrapHandler) -> dict[str, Any]:
        return {key: value for key, value in write(self).items() if value not in (None, (), [])}


def plain(value: Any) -> Any:
    """Return a value with the arrays and numbers of NumPy in it as lists and numbers of Python."""
    if isinstance(value, dict):
        return {key: plain(entry) for key, entry in value.items()}
    if isinstance(value, list | tuple):
        return [plain(entry) for entry in value]
    return value.tolist() if hasattr(value, "tolist") else value
