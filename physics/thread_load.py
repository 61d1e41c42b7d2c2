"""Load per length on a thread at rest: its weight in the liquid, and the drag of a steady stream."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.stream import Stream

UP = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True, kw_only=True)
class ThreadLoad:
    """q = −w e_z + kₙ|uₙ|uₙ + kₜ|uₜ|uₜ τ + νₙ uₙ, per unstretched length; uₜ = u·τ, uₙ = u − uₜτ."""

    weight: float  # w, submerged, N/m; negative if the thread is buoyant
    normal_drag: float = 0.0  # kₙ = ρ Cₙ d/2, N s²/m³
    tangential_drag: float = 0.0  # kₜ = ρ π Cₜ d/2, N s²/m³
    viscous_drag: float = 0.0  # νₙ, N s/m²
    stream: Stream | None = None  # u; ``None`` for a liquid at rest

    def __post_init__(self) -> None:
        if not math.isfinite(self.weight):
            raise ValueError(f"weight is {self.weight}: it must be finite")
        for name in ("normal_drag", "tangential_drag", "viscous_drag"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value >= 0):
                raise ValueError(f"{name} is {value}: it must be finite and not negative")

    def _stream(self, points: ArrayLike) -> FloatArray:
        places = np.asarray(points, dtype=float)
        return np.zeros_like(places) if self.stream is None else self.stream.velocity_at(places)

    def load(self, points: ArrayLike, tangents: ArrayLike) -> FloatArray:
        """Return q.

        Args:
            points: positions, m, shape (n, 3).
            tangents: unit tangents τ, shape (n, 3).

        Returns:
            q, N/m, shape (n, 3).
        """
        tau, stream = np.asarray(tangents, dtype=float), self._stream(points)
        along = np.sum(stream * tau, axis=1, keepdims=True)
        across = stream - along * tau
        speed = np.linalg.norm(across, axis=1, keepdims=True)
        normal = (self.normal_drag * speed + self.viscous_drag) * across
        return -self.weight * UP + normal + self.tangential_drag * np.abs(along) * along * tau

    def load_by_position(self, points: ArrayLike, tangents: ArrayLike) -> FloatArray:
        """Return ∂q/∂r = q_u ∇u at fixed τ, with q_u = kₙ D(uₙ) P + 2 kₜ|uₜ| ττᵀ + νₙ P and D(v) = |v| I + vvᵀ/|v|.

        Args:
            points: positions, m, shape (n, 3).
            tangents: unit tangents τ, shape (n, 3).

        Returns:
            ∂qᵢ/∂xⱼ, N/m², shape (n, 3, 3).
        """
        tau = np.asarray(tangents, dtype=float)
        if self.stream is None:
            return np.zeros((*tau.shape, 3))
        along, _, tangential, normal, quadratic = self._parts(points, tau)
        by_stream = quadratic @ normal + self.viscous_drag * normal
        by_stream += 2 * self.tangential_drag * np.abs(along) * tangential
        return by_stream @ self.stream.gradient_at(np.asarray(points, dtype=float))

    def load_by_tangent(self, points: ArrayLike, tangents: ArrayLike) -> FloatArray:
        """Return ∂q/∂τ at fixed r from the formula of q, for arbitrary dτ; a unit vector changes by P dτ.

        q_τ = −(kₙ D(uₙ) + νₙ I)(τuᵀ + uₜ I) + kₜ(2|uₜ| τuᵀ + |uₜ|uₜ I).

        Args:
            points: positions, m, shape (n, 3).
            tangents: unit tangents τ, shape (n, 3).

        Returns:
            ∂qᵢ/∂τⱼ, N/m, shape (n, 3, 3).
        """
        tau = np.asarray(tangents, dtype=float)
        along, stream, _, _, quadratic = self._parts(points, tau)
        unit = np.eye(3)
        tilt = tau[:, :, None] * stream[:, None, :]
        friction = 2 * np.abs(along) * tilt + np.abs(along) * along * unit
        return -(quadratic + self.viscous_drag * unit) @ (tilt + along * unit) + self.tangential_drag * friction

    def _parts(
        self, points: ArrayLike, tau: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray, FloatArray]:
        """Return uₜ (n, 1, 1), u (n, 3), ττᵀ, P and kₙ D(uₙ), all (n, 3, 3)."""
        stream, unit = self._stream(points), np.eye(3)
        along = np.sum(stream * tau, axis=1)[:, None, None]
        tangential = tau[:, :, None] * tau[:, None, :]
        across = stream - along[:, :, 0] * tau
        speed = np.linalg.norm(across, axis=1)[:, None, None]
        direction = across / np.where(speed[:, :, 0] == 0, 1.0, speed[:, :, 0])
        quadratic = self.normal_drag * speed * (unit + direction[:, :, None] * direction[:, None, :])
        return along, stream, tangential, unit - tangential, quadratic
