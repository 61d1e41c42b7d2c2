"""Checks of what holds bodies in the sea, and of analyses of irregular waves."""

from __future__ import annotations

from collections.abc import Iterator
from math import hypot
from typing import TYPE_CHECKING

import numpy as np
from pydantic_core import InitErrorDetails

from hydroelastic.physics import attachments as physics
from hydroelastic.scenes.models.attachments import Attachment
from hydroelastic.scenes.models.body_kinds import AnyFloat, name_of_body
from hydroelastic.scenes.models.limits import is_within, shown_least, shown_range
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.problems import problem_at
from hydroelastic.scenes.models.sea_states import Spectrum
from hydroelastic.scenes.models.tank_parts import TankParts

if TYPE_CHECKING:
    from hydroelastic.physics.tank import Tank


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
        if scene.is_revolved and not _is_round(one):
            yield problem_at(
                ("attachment", index, "at" if one.at is not None and one.at[0] != 0.0 else "stiffness"),
                None,
                "it couples heave to surge or pitch, which solids of revolution on their axis do not",
                allowed="a point [0, z], and matrices without terms between heave and the other two",
            )
        if physics.is_symmetric(one.damping) and not physics.is_passive(one.damping):
            yield problem_at(
                ("attachment", index, "damping"),
                None,
                "in some motion it adds power instead of taking it",
                allowed="a matrix without negative eigenvalues",
            )


def closed_tanks_have_springs_alone(scene: TankParts) -> Iterator[InitErrorDetails]:
    """Yield attachments of closed tanks that are not springs between a float and the ground."""
    for index, one in enumerate(() if scene.is_open else scene.attachment):
        damping = [key for key in ("damping", "quadratic_damping") if np.any(getattr(one, key))]
        if damping:
            yield problem_at(
                ("attachment", index, damping[0]),
                None,
                "the modes of a tank with walls are those of a real symmetric problem, which has no damping",
                allowed="stiffness alone",
                remedy='Leave it out, or set ends = "open" in [tank], where resonances are complex',
            )
        if one.to is not None:
            yield problem_at(
                ("attachment", index, "to"),
                one.to,
                "in a tank with walls springs hold floats to the ground, not to each other",
                remedy='Leave it out, or set ends = "open" in [tank]',
            )
        if one.body <= len(scene.body) and not isinstance(scene.body[one.body - 1], AnyFloat):
            yield problem_at(
                ("attachment", index, "body"),
                one.body,
                "in a tank with walls springs hold floats, and this is a beam",
                remedy='Hold a float, or set ends = "open" in [tank]',
            )


def _is_round(one: Attachment) -> bool:
    coupled = [row for matrix in (one.stiffness, one.damping) for row in (matrix[0][1], matrix[0][2])]
    return (one.at is None or one.at[0] == 0.0) and not any(coupled)


def _numbers(scene: TankParts) -> str:
    return f"1 to {len(scene.body)}" if scene.body else "none: this scene has no body"


def _ends_are_bodies(scene: TankParts, index: int, one: Attachment) -> Iterator[InitErrorDetails]:
    for key, number in (("body", one.body), ("to", one.to)):
        if number is not None and number > len(scene.body):
            yield problem_at(
                ("attachment", index, key), number, "there is no body of that number", allowed=_numbers(scene)
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
        if isinstance(body, AnyFloat):
            continue
        what = name_of_body(body)
        if one.at is None:
            yield problem_at(
                ("attachment", index, "at"),
                None,
                f"it is missing, and a {what} needs it",
                allowed="[x, y], m",
            )
        elif not is_within(one.at[0], body.start, body.end):
            yield problem_at(
                ("attachment", index, "at"),
                None,
                f"x = {one.at[0]:g} m does not lie on the {what}, [[body]] number {number}",
                allowed=f"x from {shown_range(body.start, body.end)} m",
            )
        sideways = "surge" if scene.is_revolved else "sway"
        if any(matrix[1][1] for matrix in (one.stiffness, one.damping)) or one.quadratic_damping[1]:
            yield problem_at(
                ("attachment", index, "stiffness"),
                None,
                f"a {what} does not {sideways}, so that forces in {sideways} have no effect on it",
                remedy=f"Make the numbers of {sideways} zero",
            )


def sea_points_lie_on_bodies(scene: TankParts) -> Iterator[InitErrorDetails]:
    """Yield points of bodies that there are not, or that do not lie on their beam or plate, and bands without waves."""
    for index, analysis in enumerate(scene.analysis):
        if not isinstance(analysis, Spectrum):
            continue
        moving = [("points", number, point.body, point.at) for number, point in enumerate(analysis.points)]
        moving += [
            ("air_gaps", number, gap.body, gap.at)
            for number, gap in enumerate(analysis.air_gaps)
            if gap.body is not None
        ]
        for key, number, one, at in moving:
            where = ("analysis", index, key, number)
            if one > len(scene.body):
                yield problem_at((*where, "body"), one, "there is no body of that number", allowed=_numbers(scene))
                continue
            body = scene.body[one - 1]
            # What bends about an axis is a round plate.
            place, x = (abs(at[0]), "|x|") if scene.is_revolved else (at[0], "x")
            if not isinstance(body, AnyFloat) and not is_within(place, body.start, body.end):
                yield problem_at(
                    (*where, "at"),
                    None,
                    f"x = {at[0]:g} m does not lie on the {name_of_body(body)}, [[body]] number {one}",
                    allowed=f"{x} from {shown_range(body.start, body.end)} m",
                )
        low = analysis.spectrum.band[0]
        if analysis.highest_omega is not None and analysis.highest_omega <= 1.1 * low:
            yield problem_at(
                ("analysis", index, "highest_omega"),
                analysis.highest_omega,
                "hardly any waves are below it",
                allowed=f"more than {shown_least(1.1 * low)} rad/s",
            )


def air_gaps_are_over_water(scene: TankParts) -> Iterator[InitErrorDetails]:
    """Yield points of air gaps that are not above the open part of a free surface within what is drawn."""
    if not any(analysis.air_gaps for analysis in scene.analysis if isinstance(analysis, Spectrum)):
        return
    # Floats at rest need SciPy.

    tank = physical_tank(scene)
    level, (low, high) = tank.levels_from_top[0], scene.stretch
    for index, analysis in enumerate(scene.analysis):
        for number, gap in enumerate(analysis.air_gaps if isinstance(analysis, Spectrum) else ()):
            where = ("analysis", index, "air_gaps", number)
            x = hypot(gap.at[0], gap.across) if scene.is_revolved else gap.at[0]
            if level.kind != "free":
                yield problem_at(where, None, "there is no free surface at the top", remedy="Leave air_gaps out")
            elif gap.across and not scene.is_revolved:
                yield problem_at(
                    (*where, "across"),
                    gap.across,
                    "a section is the same at any distance across",
                    remedy="Leave it out; solids of revolution have it",
                )
            elif gap.at[1] <= level.height:
                yield problem_at(
                    (*where, "at"),
                    None,
                    f"y = {gap.at[1]:g} m is not above the still water",
                    allowed=f"y above {level.height:g} m",
                )
            elif not is_within(x, low, high):
                yield problem_at(
                    (*where, "at"),
                    None,
                    f"it lies {x:g} m from x = 0, outside what is drawn, within which the waves are known",
                    allowed=f"{shown_range(low, high)} m",
                    remedy="Widen drawn of [sea]" if scene.kind == "sea" else "Lengthen the tank",
                )
            else:
                yield from _covered(where, x, tank)


def _covered(where: tuple[str | int, ...], x: float, tank: Tank) -> Iterator[InitErrorDetails]:
    for piece in tank.levels_from_top[0].pieces:
        thin = piece.start == piece.end == x
        if piece.body is not None and (thin or piece.start < x < piece.end):
            reaches = f"which reaches from {piece.start:g} to {piece.end:g} m"
            yield problem_at(
                (*where, "at"),
                None,
                f"below it there is [[body]] number {piece.body + 1}, {reaches}, and no water",
                allowed="a point beside it, or at one of its edges",
            )
