"""How arrays of open water are declared: those of several analyses lie along common dimensions."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from hydroelastic.output.quantities import Quantity

CREST = "beside an incident wave whose crest is at x = 0 of the scene, or at `sea.phase_at`, at t = 0"
"""What phases are relative to."""
NUMBERED = "several have one more dimension, `analysis`, in `dataset.nc`"
"""Note on groups of analyses that are not joined."""
OF_BODIES = "influenced_dof radiating_dof"
"""Dimensions of matrices, force by motion."""
DOFS = Quantity("dofs", "names of the motions", dimensions=("dof",), variable="")
"""The motions."""


def joined_array(key: str, meaning: str, dimensions: str, order: str = "", **more: Any) -> Quantity:
    """Return an array that all analyses of a kind have together, in another order of its dimensions if there is one."""
    names = tuple(dimensions.split())
    return Quantity(key, meaning, dimensions=names, joined=tuple(order.split()) or names, **more)


def own_array(key: str, meaning: str, dimensions: str, value: Callable[[Any], Any], **more: Any) -> Quantity:
    """Return such an array of ``dataset.nc`` alone."""
    return joined_array(key, meaning, dimensions, value=value, in_summary=False, **more)


def named_dofs(name: str, meaning: str = "motion") -> Quantity:
    """Return the names of the motions as Capytaine writes them, along a dimension of their own."""
    return own_array(name, meaning, name, lambda table: [dof.capitalised for dof in table.dofs])
