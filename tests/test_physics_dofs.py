"""Names of degrees of freedom, and what follows from them."""

from __future__ import annotations

import pytest

from hydroelastic.physics.beam_parts import Joint, Section
from hydroelastic.physics.beams import Beam
from hydroelastic.physics.dofs import Dof, body_name, body_number, dof_names


@pytest.mark.parametrize(
    ("name", "body", "kind", "capitalised", "words", "elastic", "turns"),
    [
        ("heave", None, "heave", "Heave", "heave", False, False),
        ("body_2__roll", 2, "roll", "body_2__Roll", "body 2 roll", False, True),
        ("elastic 12", None, "elastic", "Elastic 12", "elastic 12", True, False),
        ("body_11__elastic 1", 11, "elastic", "body_11__Elastic 1", "body 11 elastic 1", True, False),
        ("body_1__hinge 2", 1, "hinge", "body_1__Hinge 2", "body 1 hinge 2", False, False),
    ],
)
def test_all_follows_from_the_name(
    name: str, body: int | None, kind: str, capitalised: str, words: str, elastic: bool, turns: bool
) -> None:
    dof = Dof(name)
    found = dof.body, dof.kind, dof.capitalised, dof.words, dof.is_elastic, dof.is_rotation
    assert found == (body, kind, capitalised, words, elastic, turns)


def test_the_body_is_named_only_where_there_are_several() -> None:
    assert dof_names([("heave", "roll")]) == ("heave", "roll")
    # A body that does not move keeps its number.
    assert dof_names([(), ("heave",)]) == ("body_2__heave",)


def test_shapes_of_a_beam_are_rigid_then_elastic() -> None:
    part = Section(length=2.0, flexural_rigidity=1.0, mass_per_length=1.0)
    hinged = Beam(sections=(part,), joints=(Joint(at=1.0, rotational_stiffness=0.0),))
    assert hinged.dofs(5) == ("heave", "pitch", "hinge 1", "elastic 1", "elastic 2")
    assert hinged.dofs(2) == ("heave", "pitch")
    assert Beam(sections=(part,), ends="guided").dofs(2) == ("heave", "elastic 1")


def test_names_of_surfaces_and_numbers_of_bodies_belong_together() -> None:
    assert body_number(body_name(17)) == 17
    assert body_number("free_surface") is None
