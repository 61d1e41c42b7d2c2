"""The two classes of modes of a centred tank, each solved on its left half."""

from __future__ import annotations

from dataclasses import dataclass

from hydroelastic.benchmarks.tank.cases import MODES

_SPARE = 2


@dataclass(frozen=True, kw_only=True)
class ModeClass:
    """Modes that are solved for together.

    Attributes:
        shapes: indices of the dry modes that take part.
        antisymmetric: whether ψ = 0 on the plane x = L/2; else it is a wall, as it is for the whole tank.
        count: how many modes are solved for.
    """

    shapes: tuple[int, ...]
    antisymmetric: bool
    count: int


def mode_classes(shapes: int, *, halves: bool) -> tuple[ModeClass, ...]:
    """The classes of a tank: one for the whole tank, two for its halves.

    Symmetric and antisymmetric modes alternate but for a few, so half of the modes and two more hold the lowest ones.
    """
    if not halves:
        return (ModeClass(shapes=tuple(range(shapes)), antisymmetric=False, count=MODES),)
    count = MODES // 2 + _SPARE
    return (
        ModeClass(shapes=tuple(range(0, shapes, 2)), antisymmetric=False, count=count),
        ModeClass(shapes=tuple(range(1, shapes, 2)), antisymmetric=True, count=count),
    )


def lowest_of(classes: tuple[tuple[float, ...], ...]) -> tuple[float, ...]:
    """The lowest modes of all classes together."""
    merged = sorted(value for values in classes for value in values)[:MODES]
    if len(classes) > 1 and any(max(values) <= merged[-1] for values in classes):
        raise RuntimeError("one class of modes holds more of the lowest modes than were solved for")
    return tuple(merged)
