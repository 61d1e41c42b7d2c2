"""A thread of large tension whose end lies at a given height, pulled by a force that depends on where the end is."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import root

from hydroelastic.modal.thread.asymptotics import NoAsymptoticError
from hydroelastic.modal.thread.panel_quadrature import PanelQuadrature
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.thread_load import ThreadLoad

_LARGEST = 0.5
_PANELS = 16
# Determinant of the equations of the end's first-order displacement below which a straight thread is neutrally stable.
_SINGULAR = 1e-6
# Of the height: central differences of the end force, with errors of 1e-10 of it.
_DIFFERENCE = 1e-5


@dataclass(frozen=True)
class ThreadAtHeight:
    """A thread between two heights, to first order in its load.

    Attributes:
        levels: z above A, m, increasing from 0 to H, shape (n,).
        positions: r, m, from A, shape (n, 3).
        forces: contact force, N, shape (n, 3).
        length: L, m.
        small: ε, the load on the thread, of its tension.
        position_truncation: estimate of the largest error of a position, m: first-order displacement times ε.
        force_truncation: the same of a contact force, N.
    """

    levels: FloatArray
    positions: FloatArray
    forces: FloatArray
    length: float
    small: float
    position_truncation: float
    force_truncation: float


def tension_dominated_at_height(
    load: ThreadLoad, height: float, end_force: Callable[[FloatArray], ArrayLike], levels: ArrayLike
) -> ThreadAtHeight:
    """Return the shape of a thread that is held at A = 0 and ends at z = H, to first order in ε = ∫|q| ds/T.

    p = (x, y), Φ the end force, Q(z) = ∫_z^H q₀/τ_z dz. Order 0: p₀(H) = H Φ_p(p₀)/Φ_z(p₀), slope σ = p₀(H)/H.
    Order 1: N₁ = Φ′ p₁(H) + Q, p₁′ = (N₁ₚ − σ N₁z)/N₀z, where p₁(H) is such that
    [I − (H/N₀z)(Φ_p′ − σ Φ_z′)] p₁(H) = ∫₀ᴴ (Q_p − σ Q_z)/N₀z dz.

    Args:
        load: q.
        height: H, m; the length follows.
        end_force: Φ of p = (x, y), m, shape (2,): N, shape (3,).
        levels: z, m, increasing, from 0 to H, shape (n,).

    Raises:
        ValueError: if the height is none.
        NoAsymptoticError: if there is no straight thread to begin with, it is neutrally stable in the field of the end
            force, or ε is above 0.5.
    """
    if not (math.isfinite(height) and height > 0):
        raise ValueError(f"height is {height}: it must be finite and positive")

    def force_at(place: FloatArray) -> FloatArray:
        return np.asarray(end_force(place), dtype=float)

    end, force = _straight(force_at, height)
    slope, lift = end / height, float(force[2])
    tau = force / np.linalg.norm(force)
    along = np.append(slope, 1.0)
    places = np.asarray(levels, dtype=float)
    rule = PanelQuadrature(
        np.unique(np.concatenate([np.linspace(0, height, _PANELS + 1), places, _breaks(load, height)]))
    )

    per_height = load.load(np.outer(rule.nodes, along), np.tile(tau, (len(rule.nodes), 1))) / tau[2]
    _, total = rule.running(np.linalg.norm(per_height, axis=1, keepdims=True))
    small = float(total[-1, 0] / np.linalg.norm(force))
    if not small < _LARGEST:
        raise NoAsymptoticError(f"the load is {small:.3g} of the tension: it must be below {_LARGEST}")
    inside, at_knots = rule.running(per_height)
    beyond, beyond_at_knots = at_knots[-1] - inside, at_knots[-1] - at_knots

    def sideways(forces: FloatArray) -> FloatArray:
        """Return (N_p − σ N_z)/N₀z of forces, the components in the first axis."""
        return np.asarray((forces[:2] - np.multiply.outer(slope, forces[2])) / lift)

    change = _derivative(force_at, end, height)
    matrix = np.eye(2) - height * sideways(change)
    if abs(np.linalg.det(matrix)) < _SINGULAR:
        raise NoAsymptoticError("the field of the end force leaves the straight thread neutrally stable")
    loaded = rule.running(sideways(beyond.T).T)[1]
    moved = np.linalg.solve(matrix, loaded[-1])
    chosen = np.searchsorted(rule.knots, places)
    first_force = (change @ moved + beyond_at_knots)[chosen]
    first_place = (np.outer(rule.knots, sideways(change @ moved)) + loaded)[chosen]
    # ds/dz = √(1 + |p′|²) to first order, p₁ from 0 to p₁(H).
    length = height * math.hypot(1, *slope) + float(slope @ moved) / math.hypot(1, *slope)
    return ThreadAtHeight(
        levels=places,
        positions=np.outer(places, along) + np.pad(first_place, ((0, 0), (0, 1))),
        forces=force + first_force,
        length=length,
        small=small,
        position_truncation=small * float(np.linalg.norm(first_place, axis=1).max()),
        force_truncation=small * float(np.linalg.norm(first_force, axis=1).max()),
    )


def _straight(force_at: Callable[[FloatArray], FloatArray], height: float) -> tuple[FloatArray, FloatArray]:
    """Return the end of the straight thread, and the force there."""
    guess = force_at(np.zeros(2))
    if not guess[2] > 0:
        raise NoAsymptoticError(f"the end force is {guess} above A: it must pull up")

    def miss(place: FloatArray) -> FloatArray:
        force = force_at(height * place)
        return np.asarray(place - force[:2] / force[2])

    found = root(miss, guess[:2] / guess[2], options={"xtol": 1e-14})
    force = force_at(height * found.x)
    if np.abs(miss(found.x)).max() > 1e-10 or not force[2] > 0:
        raise NoAsymptoticError("no straight thread ends where the end force has its direction")
    return height * found.x, force


def _derivative(force_at: Callable[[FloatArray], FloatArray], end: FloatArray, height: float) -> FloatArray:
    """Return Φ′, shape (3, 2)."""
    steps = _DIFFERENCE * height * np.eye(2)
    columns = [(force_at(end + step) - force_at(end - step)) / (2 * _DIFFERENCE * height) for step in steps]
    return np.stack(columns, axis=1)


def _breaks(load: ThreadLoad, height: float) -> FloatArray:
    breaks = np.array(load.stream.breaks if load.stream is not None else (), dtype=float)
    return breaks[(breaks > 0) & (breaks < height)]
