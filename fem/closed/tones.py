"""First elastic tones of beams, modes of the motions of floats, and what holds the energy of a mode.

Elastic tone: the mode in which a beam's first dry mode has the largest participation pₙ = (e₁ᵀ K φₙ)², with the
K-normalised dry mode e₁ and K-orthonormal modes φₙ; Σ pₙ = 1. Beside a free surface the elastic energy is spread over
several hybrid modes, and the tone then has a runner-up of nearly the same participation.

Motion of a float: at unit generalized mass a motion of amplitude a has the modal mass 1/a²; the mode of the motion is
the one with the smallest.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.closed.discretization import FAR_ENOUGH
from hydroelastic.physics.dofs import Dof

Array = NDArray[np.float64]

SHARED = 0.5
"""A mode that has more than this part of the largest participation shares the tone."""
LEAST_OF_ONE_MODE = 0.25
"""A shared tone whose largest participation is less is not attributed to a single mode."""

# A motion with a smaller part of a mode's kinetic energy is constrained, and its amplitude rounding.
_CONSTRAINED = 1e-18
# A runner-up with less than so many times the smallest modal mass makes the mode of a motion a shared one.
_SHARED_MOTION = 2.0


class Body(Protocol):
    """What is asked of a body in its unknowns."""

    @property
    def dofs(self) -> tuple[Dof, ...]: ...
    @property
    def size(self) -> int: ...
    @property
    def stiffness(self) -> Array: ...
    @property
    def mass(self) -> Array: ...


class Surface(Protocol):
    """What is asked of a surface: the layers beside it, ``None`` above a free one."""

    @property
    def above(self) -> int | None: ...
    @property
    def below(self) -> int: ...


@dataclass(frozen=True, kw_only=True)
class ElasticTone:
    """The first elastic tone of one beam among computed modes."""

    body: int  # index of the beam
    index: int  # index of the mode, from 0
    participation: float  # pₙ of that mode
    runner_up: float  # the next largest pₙ
    sharing: tuple[int, int]  # indices of the first and the last mode that share it
    # whether no mode above the computed ones can have a larger participation: their sum is less than the largest
    # one, or the computed modes extend well above the tone
    certain: bool

    @property
    def is_shared(self) -> bool:
        return self.runner_up > SHARED * self.participation

    @property
    def is_of_one_mode(self) -> bool:
        return not self.is_shared or self.participation >= LEAST_OF_ONE_MODE


def first_elastic(bodies: Sequence[Body], body: int) -> tuple[int, int]:
    """Place of a beam's first dry mode among its shapes, and among the unknowns of all bodies."""
    first = next(place for place, dof in enumerate(bodies[body].dofs) if dof.is_first_elastic)
    return first, sum(other.size for other in bodies[:body]) + first


def participations(values: Array, amplitudes: Array, bodies: Sequence[Body], body: int) -> Array:
    """pₙ of a beam's first dry mode, shape (modes,); `amplitudes` are those of all bodies, shape (modes, unknowns)."""
    first, place = first_elastic(bodies, body)
    # Modes have unit generalized mass, so φᵀKφ = λ.
    return np.asarray(bodies[body].stiffness[first] * amplitudes[:, place] ** 2 / values)


def elastic_tone(
    values: Array, amplitudes: Array, bodies: Sequence[Body], body: int, *, released: float | None = None
) -> ElasticTone:
    """Return the mode of largest participation."""
    parts = participations(values, amplitudes, bodies, body)
    order = np.argsort(parts)[::-1]
    best, second = parts[order[0]], parts[order[1]] if len(parts) > 1 else 0.0
    sharing = np.flatnonzero(parts >= SHARED * best)
    last = len(parts) - len(parts) // 5
    # Participations that decrease in the last fifth of the modes are not those above the tone.
    past = released is not None and last < len(parts) and released < values[last] and parts[last:].max() < 0.5 * best
    return ElasticTone(
        body=body,
        index=int(order[0]),
        participation=float(best),
        runner_up=float(second),
        sharing=(int(sharing[0]), int(sharing[-1])),
        certain=bool(best > 1.0 - parts.sum() or (past and parts.sum() > 0.5)),
    )


@dataclass(frozen=True, kw_only=True)
class FloatMode:
    """The mode of a motion with restoring force; dimensionless."""

    body: int  # index of the float
    motion: Dof  # degree of freedom
    index: int | None  # index of the mode, from 0; ``None`` where it is not one of the computed modes
    reason: str  # why there is no mode, or ""
    stiffness: float  # of the motion
    inertia: float  # mass or moment of inertia of the float
    modal_mass: float  # smallest 1/a²
    runner_up: float  # the next smallest

    @property
    def is_shared(self) -> bool:
        return self.index is not None and self.runner_up < _SHARED_MOTION * self.modal_mass


def float_modes(
    bodies: Sequence[Body],
    floats: Sequence[int],
    values: Array,
    amplitudes: Array,
    added: Array | None,
    *,
    complete: bool,
) -> tuple[FloatMode, ...]:
    """Find the mode of each restored motion of the floats."""
    found = []
    offsets = np.cumsum([0, *(body.size for body in bodies)])
    seen = 0
    for index in floats:
        body = bodies[index]
        for number, dof in enumerate(body.dofs):
            more = float(added[seen]) if added is not None else 0.0
            seen += 1
            stiffness, mass = float(body.stiffness[number]), float(body.mass[number, number])
            if stiffness <= 0.0:
                continue
            squares = np.append(np.sort(amplitudes[:, offsets[index] + number] ** 2)[::-1], [0.0, 0.0])
            certain = complete or bool(len(values) and values[-1] >= 0.8 * FAR_ENOUGH * stiffness / (mass + more))
            reason = ""
            if complete and mass * squares[0] < _CONSTRAINED:
                reason = "conservation of volume excludes it"
            elif not certain or squares[0] == 0.0:
                reason = "it may lie above the modes computed; ask for more modes"
            found.append(
                FloatMode(
                    body=index,
                    motion=dof,
                    index=None if reason else int(np.argmax(amplitudes[:, offsets[index] + number] ** 2)),
                    reason=reason,
                    stiffness=stiffness,
                    inertia=mass,
                    modal_mass=float(1.0 / squares[0]) if squares[0] > 0.0 else np.inf,
                    runner_up=float(1.0 / squares[1]) if squares[1] > 0.0 else np.inf,
                )
            )
    return tuple(found)


def mode_kinds(energies: Array, bodies: Sequence[Body], surfaces: Sequence[Surface]) -> list[str]:
    """What has most of the potential energy of each mode: a motion of the bodies ("heave", "pitch", "sway", "roll",
    "elastic"), or the liquids: "sloshing" of one liquid, "interface wave" or "surface wave" of two."""
    if not len(energies):
        return []
    of_bodies = [dof.kind for body in bodies for dof in body.dofs]
    of_surfaces = [
        "interface wave" if surface.above is not None else "surface wave" if surface.below else "sloshing"
        for surface in surfaces
    ]
    kinds = [*of_bodies, *of_surfaces]
    # Of two equal ones the liquids count first.
    names = list(dict.fromkeys(["sloshing", *of_surfaces, *of_bodies]))
    of_kind = np.array([[kind == name for name in names] for kind in kinds], dtype=float).reshape(
        len(kinds), len(names)
    )
    return [names[place] for place in (energies @ of_kind).argmax(axis=1)]


def added_mass_of(stiffness: float, mass: float, value: float, relative_error: float) -> tuple[float, float]:
    """The added mass k/λ − m of a tone or a motion from its frequency, with its relative error."""
    whole = stiffness / value
    added = whole - mass
    return added, 2.0 * relative_error * whole / abs(added) if added else 1.0
