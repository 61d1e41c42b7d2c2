"""The mode of each motion of a float: the one with the largest amplitude of that motion.

At unit generalized mass a motion of amplitude a has the modal mass 1/a²; the mode of the motion is the one with the
smallest. In a tank the resonance of a float couples with standing waves of nearby frequencies: where the runner-up is
close, the motion has no single natural frequency.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hydroelastic.fem.bodies.model import FAR_ENOUGH
from hydroelastic.fem.mode_set import ModeSet
from hydroelastic.fem.surfaces import Body
from hydroelastic.fem.tank.infinite_frequency import InfiniteFrequencyAddedMass
from hydroelastic.physics.dofs import Dof
from hydroelastic.physics.tank import Tank

# A motion with a smaller part of a mode's kinetic energy is constrained, and its amplitude rounding.
_CONSTRAINED = 1e-18
# A runner-up with less than so many times the smallest modal mass makes the mode of a motion a shared one.
_SHARED = 2.0


@dataclass(frozen=True, kw_only=True)
class FloatMode:
    """The mode of a motion with restoring force.

    Attributes:
        body: index of the float among the bodies.
        motion: degree of freedom.
        index: index of the mode, from 0; ``None`` where it is not one of the computed modes.
        reason: why there is no mode, or "".
        stiffness: hydrostatic stiffness of the motion, in units of the tank.
        inertia: mass or moment of inertia of the float, in units of the tank.
        modal_mass: smallest 1/a², in units of the tank.
        runner_up: the next smallest.
    """

    body: int
    motion: Dof
    index: int | None
    reason: str
    stiffness: float
    inertia: float
    modal_mass: float
    runner_up: float

    @property
    def is_shared(self) -> bool:
        """Whether a second mode has nearly the same amplitude, by coupling with waves or other bodies."""
        return self.index is not None and self.runner_up < _SHARED * self.modal_mass


@dataclass(frozen=True, kw_only=True)
class _Motion:
    body: int
    dof: Dof
    number: int
    place: int
    stiffness: float
    mass: float


def _restored(tank: Tank, bodies: tuple[Body, ...]) -> list[_Motion]:
    """Return the motions of floats with restoring force, with their indices among the unknowns of all bodies."""
    if not tank.rigid:
        return []
    offsets = np.cumsum([0, *(body.size for body in bodies)])
    return [
        _Motion(
            body=index,
            dof=dof,
            number=number,
            place=int(offsets[index]) + number,
            stiffness=stiffness,
            mass=mass,
        )
        for index in tank.rigid
        for number, (dof, stiffness, mass) in enumerate(
            zip(bodies[index].dofs, bodies[index].stiffness, bodies[index].mass.diagonal(), strict=True)
        )
        if stiffness > 0.0
    ]


def float_modes(
    tank: Tank,
    bodies: tuple[Body, ...],
    modes: ModeSet,
    added: InfiniteFrequencyAddedMass | None,
    *,
    complete: bool,
) -> tuple[FloatMode, ...]:
    """Find the mode of each motion."""
    found = []
    for motion in _restored(tank, bodies):
        moved = modes.elastic_amplitudes[:, motion.place] ** 2
        order = np.argsort(-moved)
        more = (
            added.principal(tank, motion.body, bodies[motion.body].motions)[motion.number] if added is not None else 0.0
        )
        limit = motion.stiffness / (motion.mass + more)
        certain = complete or bool(modes.eigenvalues[-1] >= 0.8 * FAR_ENOUGH * limit)
        reason = ""
        if complete and motion.mass * moved.max(initial=0.0) < _CONSTRAINED:
            reason = "conservation of volume excludes it"
        elif not certain or not np.any(moved):
            reason = "it may lie above the modes computed; ask for more modes"
        found.append(
            FloatMode(
                body=motion.body,
                motion=motion.dof,
                index=None if reason else int(order[0]),
                reason=reason,
                stiffness=float(motion.stiffness),
                inertia=float(motion.mass),
                modal_mass=_inverse(moved, order, 0),
                runner_up=_inverse(moved, order, 1),
            )
        )
    return tuple(found)


def _inverse(squares: np.ndarray, order: np.ndarray, place: int) -> float:
    """Return 1/a² of the mode at a place of an order; infinite where there is none."""
    largest = squares[order[place]] if place < len(order) else 0.0
    return float(1.0 / largest) if largest > 0.0 else np.inf
