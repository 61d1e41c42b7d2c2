"""A thread in a plane stream whose weight is much smaller than the drag: w/Rₙ small, any profile U(z)."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from hydroelastic.modal.thread.shape import AsymptoticThread, NoAsymptoticError, ThreadShape
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.thread_load import UP, ThreadLoad

# Largest first-order change of the angle, of sin f and of ln T: above it the second order is not smaller.
_LARGEST = 0.5
_TOLERANCE = 1e-12
# Vectors are parallel up to this rounding of the input.
_PARALLEL = 1e-9


def drag_dominated(
    load: ThreadLoad,
    end_force: ArrayLike,
    *,
    height: float | None = None,
    length: float | None = None,
    order: int = 1,
    count: int = 65,
    start: ArrayLike = (0.0, 0.0, 0.0),
) -> AsymptoticThread:
    """Return the shape of a thread that is held at A and pulled at B, to order 0 or 1 in its weight.

    f the angle to the stream, γ = kₜ/kₙ, G = γ sgn(π/2 − f)(cot f + f − π/2), K = ∫ e^G/sin f df, A = ln T − G:
    dA/dz = w e^{−A−G}(1 + γ|cot f|³), dK/dz = e^{−A}(Rₙ + w cos f/sin² f). Without weight A is constant, exactly;
    order 1: A₁ = ∫_H^z e^{−A₀−G}(1 + γ|cot f₀|³), K₁ = ∫_H^z e^{−A₀}(cos f₀/sin² f₀ − A₁Rₙ), f₁ = K₁ sin f₀ e^{−G}.
    A thread that is pulled down is the mirror image, with z and w reversed.

    Args:
        load: q, without viscous drag, kₙ positive; its stream level, everywhere in one vertical plane with the force.
        end_force: N(L), N, shape (3,), neither level nor zero.
        height: H, how far B lies above A (below, if pulled down), m; or instead
        length: L, m, for which the height is found.
        order: 0 or 1.
        count: of levels, equally spaced, at which the shape is returned.
        start: position of A, m.

    Returns:
        The shape, its s of the same order, with the largest first-order change and what is left out: for order 1 the
        change times its own term.
    """
    if (height is None) == (length is None):
        raise ValueError("height and length: one of them must be given, and the other is found")
    if order not in (0, 1):
        raise ValueError(f"order is {order}: it must be 0 or 1")
    if count < 2:
        raise ValueError(f"count is {count}: it must be 2 or more")
    name, extent = ("height", height) if height is not None else ("length", length)
    if extent is None or not (math.isfinite(extent) and extent > 0):
        raise ValueError(f"{name} is {extent}: it must be finite and positive")
    plane = _Plane(load, np.asarray(end_force, dtype=float), np.asarray(start, dtype=float), extent)
    if height is None:
        height = plane.height_of(extent, order)
    levels = np.linspace(0, height, count)
    zero, first = plane.terms(height, levels)
    small = float(np.max(np.abs([first["angle"] / np.sin(zero["angle"]), first["logarithm"]])))
    if not small < _LARGEST:
        raise NoAsymptoticError(f"weight changes angle or tension by {small:.3g}: it must be below {_LARGEST}")
    shape = plane.shape(levels, zero, first if order else None)
    other = plane.shape(levels, zero, None if order else first)
    factor = small if order else 1.0
    return AsymptoticThread(
        shape=shape,
        order=order,
        small=small,
        position_truncation=factor * float(np.linalg.norm(shape.positions - other.positions, axis=1).max()),
        force_truncation=factor * float(np.linalg.norm(shape.forces - other.forces, axis=1).max()),
    )


class _Plane:
    """The plane of stream and force, with heights along the vertical component of the force."""

    def __init__(self, load: ThreadLoad, force: FloatArray, start: FloatArray, extent: float) -> None:
        self.up = math.copysign(1.0, force[2])
        self.start, self.load = start, load
        if load.viscous_drag or not load.normal_drag > 0:
            raise NoAsymptoticError("the drag must be quadratic, with a normal part and without a viscous one")
        if load.stream is None:
            raise NoAsymptoticError("there is no stream")
        self.stream = load.stream
        velocities = self._velocities(np.linspace(0, extent, 65))
        fastest = velocities[np.argmax(np.linalg.norm(velocities, axis=1))]
        speed = float(np.linalg.norm(fastest))
        if speed == 0:
            raise NoAsymptoticError("there is no stream at the thread")
        self.along = fastest / speed
        aside = velocities - np.outer(velocities @ self.along, self.along)
        sideways = np.cross(self.along, [0.0, 0.0, 1.0])
        if abs(self.along[2]) > _PARALLEL or np.abs(aside).max() > _PARALLEL * speed:
            raise NoAsymptoticError("the stream must be level, and in one direction at all heights")
        size = float(np.linalg.norm(force))
        if abs(force @ sideways) > _PARALLEL * size or abs(force[2]) <= _PARALLEL * size:
            raise NoAsymptoticError("the end force must lie in the plane of the stream, and must not be level")
        self.weight = self.up * load.weight
        self.friction = load.tangential_drag / load.normal_drag
        self.angle = math.atan2(abs(force[2]), float(force @ self.along))
        self.constant = math.log(size) - self._logarithm(self.angle)

    def _velocities(self, heights: FloatArray) -> FloatArray:
        """Return u, m/s, at heights, m, reckoned from the start along the force, shape (n,); shape (n, 3)."""
        return self.stream.velocity_at(self.start + np.outer(self.up * heights, UP))

    def _logarithm(self, angle: float) -> float:
        return self.friction * math.copysign(1.0, 0.5 * math.pi - angle) * (1 / math.tan(angle) + angle - 0.5 * math.pi)

    def _solve(self, height: float) -> Any:
        """Integrate f₀, A₁, K₁, x₀, s₀, x₁, s₁ down from B, the last four from 0 there."""

        def slope(z: float, y: FloatArray) -> list[float]:
            angle, first, turned = y[:3]
            sine, cosine = math.sin(angle), math.cos(angle)
            velocity = float(self._velocities(np.array([z]))[0] @ self.along)
            drag = self.load.normal_drag * velocity * abs(velocity)
            inverse, growth = math.exp(-self.constant), math.exp(-self._logarithm(angle))
            change = turned * sine * growth
            return [
                inverse * drag * sine * growth,
                inverse * growth * (1 + self.friction * abs(cosine / sine) ** 3),
                inverse * (cosine / sine**2 - first * drag),
                cosine / sine,
                1 / sine,
                -change / sine**2,
                -change * cosine / sine**2,
            ]

        begin = np.array([self.angle, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
        return solve_ivp(
            slope, (height, 0.0), begin, "DOP853", rtol=_TOLERANCE, atol=1e-3 * _TOLERANCE, dense_output=True
        )

    def terms(self, height: float, levels: FloatArray) -> tuple[dict[str, FloatArray], dict[str, FloatArray]]:
        """Return angle, logarithm of the tension, x and s at levels above A: without weight, and changes by weight."""
        solution = self._solve(height).sol
        angle, first, turned, x, s, more_x, more_s = solution(levels)
        base = solution(0.0)[3:]
        logarithm = np.array([self._logarithm(value) for value in angle])
        change = self.weight * turned * np.sin(angle) * np.exp(-logarithm)
        cotangent = 1 / np.tan(angle)
        zero = {"angle": angle, "logarithm": self.constant + logarithm, "x": x - base[0], "s": s - base[1]}
        return zero, {
            "angle": change,
            "logarithm": self.weight * first - self.friction * cotangent * np.abs(cotangent) * change,
            "x": self.weight * (more_x - base[2]),
            "s": self.weight * (more_s - base[3]),
        }

    def height_of(self, length: float, order: int) -> float:
        """Return the height of a thread of a length."""

        def excess(height: float) -> float:
            end = self._solve(height).y[:, -1]
            return float(-end[4] - order * self.weight * end[6] - length)

        low = 1e-3 * length
        if not excess(low) < 0 < excess(length):
            raise NoAsymptoticError(f"no height is found for the length {length} m: the thread is nearly level")
        return float(brentq(excess, low, length, xtol=1e-14 * length))

    def shape(
        self, levels: FloatArray, zero: dict[str, FloatArray], first: dict[str, FloatArray] | None
    ) -> ThreadShape:
        """Return the shape of order 0, or 1: tensions by T₀(1 + w T₁/T₀)."""
        angle, x, s = (zero[name] + (first[name] if first else 0.0) for name in ("angle", "x", "s"))
        tension = np.exp(zero["logarithm"]) * (1 + (first["logarithm"] if first else 0.0))
        up = np.array([0.0, 0.0, self.up])
        return ThreadShape(
            s=s,
            positions=self.start + np.outer(x, self.along) + np.outer(levels, up),
            forces=np.outer(tension * np.cos(angle), self.along) + np.outer(tension * np.sin(angle), up),
        )
