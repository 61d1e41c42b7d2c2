"""What older theories say of a thread: a shape, or values, with the order of a theory and what it leaves out."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from hydroelastic.modal.thread.asymptotics import NoAsymptoticError
from hydroelastic.modal.thread.shape import NoTensionError, ThreadShape
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.thread.quiet import libraries_silent
from hydroelastic.scenes.thread.results import ThreadSolutionOfScene


@dataclass(frozen=True, kw_only=True)
class ThreadEstimate:
    """An estimate.

    Attributes:
        name: of the theory.
        order: of the last terms that are kept; ``None`` of a solution that is exact.
        parameter: what must be small, in words; empty of an exact solution.
        small: its value; 0 of an exact solution.
        seconds: that the estimate took.
    """

    name: str
    order: int | None
    parameter: str = ""
    small: float = 0.0
    seconds: float = 0.0


@dataclass(frozen=True, kw_only=True)
class ShapeEstimate(ThreadEstimate):
    """Positions and contact forces at the places of `places_of`, or at both ends only.

    Attributes:
        shape: the thread.
        position_left_out: estimate of the largest error of a position, m.
        force_left_out: the same of a contact force, N.
    """

    shape: ThreadShape
    position_left_out: float = 0.0
    force_left_out: float = 0.0


@dataclass(frozen=True)
class Measured:
    """Values of the field solution that an estimate is of.

    Attributes:
        values: NaN where there is none, shape (values,).
        errors: estimates of their absolute errors, shape (values,).
    """

    values: NDArray[Any]
    errors: FloatArray


@dataclass(frozen=True, kw_only=True)
class ValueEstimate(ThreadEstimate):
    """Single values, real or complex.

    Attributes:
        quantity: what they are, with their unit.
        values: shape (values,).
        left_out: estimates of their absolute errors, shape (values,).
        measure: finds them in the field solution, from it and the values of the estimate.
    """

    quantity: str
    values: NDArray[Any]
    left_out: FloatArray
    measure: Callable[[ThreadSolutionOfScene, NDArray[Any]], Measured]


@dataclass(frozen=True)
class Inapplicable:
    """A theory that does not fit the scene.

    Attributes:
        name: of the theory.
        reason: why not.
    """

    name: str
    reason: str


Found: TypeAlias = ShapeEstimate | ValueEstimate | Inapplicable


def attempted(name: str, find: Callable[[], ShapeEstimate | ValueEstimate]) -> Found:
    """Return an estimate with the seconds it took, or why there is none."""
    begin = time.perf_counter()
    try:
        with libraries_silent():
            found = find()
    except (NoAsymptoticError, NoTensionError) as error:
        return Inapplicable(name, str(error))
    except (ValueError, ArithmeticError):
        return Inapplicable(name, "its equations have no finite solution here that could be found")
    return replace(found, seconds=time.perf_counter() - begin)


def require(condition: bool, reason: str) -> None:
    """Refuse a theory whose condition does not hold.

    Raises:
        NoAsymptoticError: with the reason.
    """
    if not condition:
        raise NoAsymptoticError(reason)


def places_of(scene: ThreadScene) -> FloatArray:
    """Places at which shapes are compared: those of the scene between both ends, m, shape (positions + 2,)."""
    return np.array([0.0, *scene.positions, scene.thread.length])


def require_bare_thread(scene: ThreadScene, *, stretch: bool) -> None:
    """Refuse what no theory of the shape knows: bending, bodies on the thread, the reaction of a liquid.

    Args:
        scene: the scene.
        stretch: whether the thread may stretch.

    Raises:
        NoAsymptoticError: with the reason.
    """
    thread = scene.thread
    require(thread.flexural_rigidity == 0.0, "the thread resists bending")
    require(not scene.load, "there are bodies on the thread")
    require(thread.reactive == "none", "the liquid reacts on the bends of the thread")
    require(thread.stretch_drag == "none", "the drag follows the stretch")
    require(stretch or thread.axial_rigidity is None, "the thread stretches")


def nearest(values: NDArray[Any], field: NDArray[Any], errors: FloatArray) -> Measured:
    """Of each value the nearest one of a field solution; none for values beyond its largest one.

    Args:
        values: of an estimate, shape (values,).
        field: those of the field solution, shape (n,).
        errors: of these, shape (n,).
    """
    found = np.full(len(values), np.nan, dtype=np.asarray(field).dtype)
    found_errors = np.full(len(values), np.nan)
    if len(field) == 0:
        return Measured(found, found_errors)
    # The last one that was asked for is still found where the estimate of it is a little too large.
    reached = np.flatnonzero(np.abs(values) <= 1.02 * np.max(np.abs(field)))
    chosen = np.argmin(np.abs(values[reached, None] - field[None, :]), axis=1)
    found[reached], found_errors[reached] = field[chosen], errors[chosen]
    return Measured(found, found_errors)
