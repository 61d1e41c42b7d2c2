"""Estimates of a thread by closed and asymptotic forms: a shape or values, with the order and the truncation error."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from math import inf
from typing import Any, Literal, TypeAlias

from numpy.typing import NDArray

from hydroelastic.modal.thread.library_warnings import suppressed_library_warnings
from hydroelastic.modal.thread.shape import NoAsymptoticError, NoTensionError, ThreadShape
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.thread import Thread


@dataclass(frozen=True, kw_only=True)
class ThreadEstimate:
    """An estimate."""

    name: str  # name of the theory
    order: int | None  # order of the last terms that are kept; ``None`` of a solution that is exact
    parameter: str = ""  # what must be small, in words; empty of an exact solution
    small: float = 0.0  # its dimensionless value; 0 of an exact solution
    seconds: float = 0.0  # computing time, s


@dataclass(frozen=True, kw_only=True)
class ShapeEstimate(ThreadEstimate):
    """Positions and contact forces at the places that were asked for, or at both ends only."""

    shape: ThreadShape  # the thread
    position_truncation: float = 0.0  # estimate of the largest error of a position, m
    force_truncation: float = 0.0  # the same of a contact force, N


Quantity: TypeAlias = Literal[
    "frequency",
    "frequency in the plane",
    "frequency out of the plane",
    "root",
    "divergence speed",
    "flutter speed",
]
"""Angular frequencies, rad/s, of all modes or those in or out of the plane of the thread; roots λ, 1/s; speeds, m/s."""


@dataclass(frozen=True, kw_only=True)
class ValueEstimate(ThreadEstimate):
    """Single values, real or complex."""

    quantity: Quantity
    label: str  # symbol or words for the quantity, with its unit
    values: NDArray[Any]  # values in the unit of the label, shape (values,)
    truncation: FloatArray  # estimates of their absolute errors in that unit, shape (values,)
    analysis: int = 0  # number of the analysis of modes or of stability that it is an estimate of, from 0


@dataclass(frozen=True)
class Inapplicable:
    """A theory that does not apply to the thread."""

    name: str  # of the theory
    reason: str  # why not


Found: TypeAlias = ShapeEstimate | ValueEstimate | Inapplicable


def estimate_or_reason(name: str, find: Callable[[], ShapeEstimate | ValueEstimate]) -> Found:
    """Return an estimate with the seconds it took, or why there is none."""
    begin = time.perf_counter()
    try:
        with suppressed_library_warnings():
            found = find()
    except (NoAsymptoticError, NoTensionError) as error:
        return Inapplicable(name, str(error))
    except (ValueError, ArithmeticError):
        return Inapplicable(name, "its equations have no finite solution here that could be found")
    return replace(found, seconds=time.perf_counter() - begin)


def require(condition: bool, reason: str) -> None:
    """Refuse a theory whose condition does not hold."""
    if not condition:
        raise NoAsymptoticError(reason)


def require_bare_thread(thread: Thread, *, stretch: bool) -> None:
    """Refuse threads that no theory of the shape covers: with bending, bodies, or the reaction of a liquid.

    Args:
        stretch: whether the thread may stretch.
    """
    require(thread.flexural_rigidity == 0.0, "the thread resists bending")
    require(not thread.loads, "there are bodies on the thread")
    require(thread.reactive == "none", "the liquid reacts on the bends of the thread")
    require(thread.stretch_drag == "none", "the drag follows the stretch")
    require(stretch or thread.axial_rigidity == inf, "the thread stretches")
