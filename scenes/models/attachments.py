"""Springs and dampers that hold floating bodies, as frozen values. SI units, per metre of width."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any, TypeAlias

from pydantic import BeforeValidator, Field, SerializerFunctionWrapHandler, Strict, model_serializer
from pydantic_core import InitErrorDetails

from hydroelastic.physics import attachments as physics
from hydroelastic.scenes.models.bodies import LARGEST, AnyNumber, Float, SceneModel
from hydroelastic.scenes.models.problems import problem_at
from hydroelastic.scenes.models.tank_parts import TankParts
from hydroelastic.scenes.models.values import OrElse

_NOTHING = ((0.0, 0.0, 0.0),) * 3


def _as_matrix(value: Any) -> Any:
    """Three numbers are a diagonal."""
    if isinstance(value, list | tuple) and len(value) == 3 and not any(isinstance(row, list | tuple) for row in value):
        return tuple(tuple(entry if row == place else 0.0 for place in range(3)) for row, entry in enumerate(value))
    return value


_DIAGONAL = {"type": "array", "items": {"type": "number"}, "minItems": 3, "maxItems": 3}

Triple: TypeAlias = tuple[AnyNumber, AnyNumber, AnyNumber]
Matrix: TypeAlias = Annotated[tuple[Triple, Triple, Triple], BeforeValidator(_as_matrix), OrElse(_DIAGONAL)]
NotNegative: TypeAlias = Annotated[float, Strict(), Field(ge=0, le=LARGEST)]


class Attachment(SceneModel):
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
        description="three numbers for [heave, sway, roll] about the point, or a symmetric matrix of three rows; "
        "forces in N/m and moments in N by displacements in m and rad",
    )
    damping: Matrix = Field(
        default=_NOTHING, description="the same by velocities in m/s and rad/s; it must not add power"
    )
    quadratic_damping: tuple[NotNegative, NotNegative, NotNegative] = Field(
        default=(0.0, 0.0, 0.0),
        description="β of [heave, sway, roll] about the point: forces β |v| v by velocities v in m/s and rad/s",
    )

    @model_serializer(mode="wrap")
    def _as_given(self, write: SerializerFunctionWrapHandler) -> dict[str, Any]:
        return {key: value for key, value in write(self).items() if value is not None}

    def physical(self, scene: TankParts) -> physics.Attachment:
        """Return the attachment in the coordinates of a scene."""
        body, point = scene.body[self.body - 1], self.at
        if point is None:
            if not isinstance(body, Float):
                raise TypeError("a beam has no centre of mass at which something holds")
            from hydroelastic.scenes.models.floats import placed_float

            point = placed_float(scene, self.body - 1).hydrostatics.centre_of_mass
        return physics.Attachment(
            body=self.body - 1,
            other=None if self.to is None else self.to - 1,
            point=point,
            stiffness=self.stiffness,
            damping=self.damping,
            drag=self.quadratic_damping,
        )


def attachments_hold_bodies(scene: TankParts) -> Iterator[InitErrorDetails]:
    """Yield attachments of bodies that there are not, or that add power."""
    for index, one in enumerate(scene.attachment):
        yield from _ends_are_bodies(scene, index, one)
        for key in ("stiffness", "damping"):
            if not physics.is_symmetric(getattr(one, key)):
                yield problem_at(
                    ("attachment", index, key),
                    None,
                    "it is not symmetric, so that a closed path of motions would gain or lose energy",
                    allowed="three numbers, or a symmetric matrix of three rows",
                )
        if physics.is_symmetric(one.damping) and not physics.is_passive(one.damping):
            yield problem_at(
                ("attachment", index, "damping"),
                None,
                "in some motion it adds power instead of taking it",
                allowed="a matrix without negative eigenvalues",
            )


def _ends_are_bodies(scene: TankParts, index: int, one: Attachment) -> Iterator[InitErrorDetails]:
    for key, number in (("body", one.body), ("to", one.to)):
        if number is not None and number > len(scene.body):
            yield problem_at(
                ("attachment", index, key), number, "there is no body of that number", allowed=f"1 to {len(scene.body)}"
            )
            return
    if one.to == one.body:
        yield problem_at(
            ("attachment", index, "to"),
            one.to,
            "both ends hold the same body, and never move apart",
            remedy="Leave it out for an end that is fixed",
        )
    for number in (one.body, one.to):
        if number is None:
            continue
        body = scene.body[number - 1]
        if isinstance(body, Float):
            continue
        if one.at is None:
            yield problem_at(
                ("attachment", index, "at"), None, "it is missing, and a beam needs it", allowed="[x, y], m"
            )
        elif not body.start <= one.at[0] <= body.end:
            yield problem_at(
                ("attachment", index, "at"),
                None,
                f"x = {one.at[0]:g} m does not lie on the beam, [[body]] number {number}",
                allowed=f"x from {body.start:g} to {body.end:g} m",
            )
        if any(matrix[1][1] for matrix in (one.stiffness, one.damping)) or one.quadratic_damping[1]:
            yield problem_at(
                ("attachment", index, "stiffness"),
                None,
                "a beam does not sway, so that forces in sway have no effect on it",
                remedy="Make the numbers of sway zero",
            )
