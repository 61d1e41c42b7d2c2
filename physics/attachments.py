"""Forces from outside on floating bodies: springs and dampers at points, as of moorings, fenders and power take-offs.

At its point an attachment follows the displacement u = (heave, sway, roll) of a body, or the difference of those of two
bodies. It pulls back with K u + B u̇ and, in each of the three, with the drag βᵢ |u̇ᵢ| u̇ᵢ. Drag is made linear, b u̇ with
the same loss of energy or the least mean square difference, so that b follows from the motion:

    b = 8/(3π) β |u̇|          in a regular wave, u̇ of amplitude |u̇|
    b = √(8/π) β σ            in irregular waves, u̇ normally distributed with standard deviation σ

Source: O. M. Faltinsen, Sea Loads on Ships and Offshore Structures, 1990.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import pi, sqrt
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from hydroelastic.physics.scales import Scales

Matrix: TypeAlias = tuple[tuple[float, float, float], ...]
"""A matrix of heave, sway and roll, 3 × 3."""

REGULAR = 8.0 / (3.0 * pi)
"""b/(β |u̇|) of a harmonic velocity: equal loss of energy in a period."""
IRREGULAR = sqrt(8.0 / pi)
"""b/(β σ) of a normally distributed velocity: least mean square difference of the forces."""

_ROUNDING = 1e-12
# Relative change of velocities that ends the iteration for the linear damping, and its most steps.
_CONVERGED = 1e-12
_MOST_STEPS = 200


@dataclass(frozen=True, kw_only=True)
class Attachment:
    """A spring and damper at a point, in SI units per metre of width, of whole solids with one metre more."""

    body: int  # index of the body
    other: int | None = None  # index of the body at its other end; ``None`` if that end is fixed
    point: tuple[float, float]  # (x, y) where it holds, m
    stiffness: Matrix  # K, forces by displacements in heave, sway and roll about the point: N/m², N/m, N; symmetric
    damping: Matrix  # B, the same by velocities, kg/(m s), kg/s, kg m/s; symmetric, and positive or zero
    # β of heave, sway and roll, kg/m² of the first two, kg m of roll; positive or zero
    drag: tuple[float, float, float]

    def scaled(self, units: Scales) -> ScaledAttachment:
        """Return its matrices in units in which ρ = g = L = 1; roll stays in rad."""
        length = units.length
        arms = np.array([length, length, 1.0])
        force = units.density * units.gravity * units.volume * length
        return ScaledAttachment(
            stiffness=np.array(self.stiffness) * np.outer(arms, arms) / force,
            damping=np.array(self.damping) * np.outer(arms, arms) * (units.frequency / force),
            drag=np.array(self.drag) * arms**3 * units.frequency**2 / force,
        )


@dataclass(frozen=True, kw_only=True)
class ScaledAttachment:
    """The matrices of an attachment, dimensionless: K and B, shape (3, 3), and β, shape (3,)."""

    stiffness: NDArray[np.float64]
    damping: NDArray[np.float64]
    drag: NDArray[np.float64]


def is_symmetric(matrix: Matrix) -> bool:
    """Whether a matrix is its own transpose up to rounding."""
    values = np.array(matrix)
    return bool(np.abs(values - values.T).max() <= _ROUNDING * np.abs(values).max(initial=0.0))


def is_passive(damping: Matrix) -> bool:
    """Whether a symmetric damping never adds power: no eigenvalue is negative.

    Rows of different units are brought to one scale.
    """
    values = np.array(damping)
    roots = np.sqrt(np.abs(np.diag(values)))
    if np.any(np.diag(values) < 0.0) or np.any(np.abs(values[roots == 0.0]) > _ROUNDING * np.abs(values).max()):
        return False
    scale = np.where(roots > 0.0, roots, 1.0)
    return bool(np.linalg.eigvalsh(values / np.outer(scale, scale)).min() >= -_ROUNDING)


@dataclass(frozen=True, kw_only=True)
class OutsideForces:
    """Forces from outside on the motions of all bodies. Shapes: m motions, d drags.

    They are of one kind of units throughout; what they act on may be anything with m motions.
    """

    stiffness: NDArray[np.float64]  # K, shape (m, m)
    damping: NDArray[np.float64]  # B, shape (m, m)
    drag: NDArray[np.float64]  # β of each drag, shape (d,)
    paths: NDArray[np.float64]  # displacement in the direction of each drag by a unit of each motion, shape (d, m)

    def impedance(self, omega: complex) -> NDArray[np.complex128]:
        """K − iωB, shape (m, m), without drag."""
        impedance: NDArray[np.complex128] = self.stiffness - 1j * omega * self.damping
        return impedance

    def equivalent_damping(
        self, speeds: Callable[[NDArray[np.float64]], NDArray[np.float64]], factor: float
    ) -> NDArray[np.float64]:
        """Return the linear damping of the drags in the motion that it leaves, shape (m, m).

        With b = fβv and v ~ 1/b near a resonance plain iteration would swing for ever; the geometric mean of successive
        speeds converges at least like 2⁻ⁿ.

        Args:
            speeds: returns the velocities along the paths, shape (d,), with a damping, shape (m, m).
            factor: `REGULAR` or `IRREGULAR`.
        """
        found = speeds(np.zeros_like(self.damping))
        for _ in range(_MOST_STEPS):
            # Where nothing moves, nothing is damped.
            found, last = np.sqrt(found * speeds(self.linearized(found, factor))), found
            if np.all(np.abs(found - last) <= _CONVERGED * found.max(initial=0.0)):
                return self.linearized(found, factor)
        raise ArithmeticError("the linear damping in place of the drag does not converge")

    def linearized(self, speeds: NDArray[np.float64], factor: float) -> NDArray[np.float64]:
        """Return the linear damping in place of the drags, shape (m, m).

        Args:
            speeds: amplitudes, or standard deviations, of the velocities along the paths, shape (d,).
            factor: `REGULAR` or `IRREGULAR`.
        """
        damping: NDArray[np.float64] = (self.paths.T * (factor * self.drag * speeds)) @ self.paths
        return damping


def outside_forces(maps: list[NDArray[np.float64]], attachments: list[ScaledAttachment], count: int) -> OutsideForces:
    """Add up attachments.

    Args:
        maps: of each, its displacement by a unit of each motion, shape (3, m).
        attachments: their matrices.
        count: m.
    """
    stiffness, damping = np.zeros((count, count)), np.zeros((count, count))
    drag: list[NDArray[np.float64]] = [np.zeros(0)]
    paths: list[NDArray[np.float64]] = [np.zeros((0, count))]
    for path, own in zip(maps, attachments, strict=True):
        stiffness += path.T @ own.stiffness @ path
        damping += path.T @ own.damping @ path
        acts = own.drag > 0.0
        drag.append(own.drag[acts])
        paths.append(path[acts])
    return OutsideForces(stiffness=stiffness, damping=damping, drag=np.concatenate(drag), paths=np.concatenate(paths))
