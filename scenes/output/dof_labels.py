"""Motions of bodies: their names as Capytaine writes them, and units of what belongs to them, per metre of width."""

from __future__ import annotations

from collections.abc import Iterable

# Without a roll among the motions, and with one.
MOTION_UNITS = ("m", "m, of roll rad")
INERTIA_UNITS = ("kg/m", "kg/m, with a roll kg, of rolls kg m")
STIFFNESS_UNITS = ("N/m^2", "N/m^2, with a roll N/m, of rolls N")


def dof_labels(dofs: Iterable[str]) -> list[str]:
    """Return names with a capital: "body_2__heave" is "body_2__Heave", "elastic 1" is "Elastic 1"."""
    pairs = [dof.rpartition("__") for dof in dofs]
    return [body + joint + motion[:1].upper() + motion[1:] for body, joint, motion in pairs]


def any_turns(dofs: Iterable[str]) -> bool:
    """Whether a roll, which is an angle, is among the motions."""
    return any(dof.lower().endswith("roll") for dof in dofs)
