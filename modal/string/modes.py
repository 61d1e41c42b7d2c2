"""Free motions of the modes of a hanging string, which start wherever the motion of its upper end breaks.

With the forced part in closed form each mode is left with a free motion q(t), which starts anew at every time at which
the upper end's motion breaks: q jumps by u and q' by v there, and moves as u(C + αS) + vS (`damped_pair`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hydroelastic.modal.damped_pair import damped_pair
from hydroelastic.modal.string.quasistatic import Exponential
from hydroelastic.physics.string import HangingString
from hydroelastic.physics.string_forcing import Forcing


@dataclass(frozen=True, kw_only=True)
class FreeMotionJumps:
    """Jumps u (m) of q and v (m/s) of q', as products: modes × factors by factors × starts."""

    factors: NDArray[np.float64]  # powers of 1/Ω², and gains of exponentials, shape (modes, factors)
    displacements: NDArray[np.float64]  # of u, shape (factors, starts)
    velocities: NDArray[np.float64]  # of v, shape (factors, starts)

    def at(self, start: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return u and v at one start, each of shape (modes,)."""
        return self.factors @ self.displacements[:, start], self.factors @ self.velocities[:, start]


def free_motion_jumps(
    string: HangingString,
    forcing: Forcing,
    parts: Sequence[Exponential],
    frequencies: NDArray[np.float64],
    first_mode: int,
) -> FreeMotionJumps:
    """Return the jumps of the free motions of modes at every start of a piece of the motion.

    They are those of the forced part with the opposite sign.

    Args:
        forcing: the motion of the upper end.
        frequencies: Ω of the modes, 1/s, shape (modes,).
        first_mode: number of the first of these modes.
    """
    drag = 2 * string.damping
    value, slope, curvature, third = forcing.jumps()
    nothing = np.zeros_like(value)
    displacements = [-value, curvature + drag * slope, -(drag**2) * curvature - 2 * drag * third, drag**3 * third]
    velocities = [-slope, third + drag * curvature, -(drag**2) * third, nothing]
    factors = [frequencies ** (-2 * power) for power in range(4)]
    at_start = np.arange(len(value)) == 0
    for part in parts:
        denominator = part.rate * (part.rate + drag) + frequencies**2
        if 0 <= part.mode - first_mode < len(frequencies):
            # Its whole motion is with the forced part.
            denominator[part.mode - first_mode] = np.inf
        gain = frequencies**2 / denominator
        factors += [gain.real, gain.imag]
        rate = part.weight * part.rate
        displacements += [-part.weight.real * at_start, part.weight.imag * at_start]
        velocities += [-rate.real * at_start, rate.imag * at_start]
    return FreeMotionJumps(
        factors=np.stack(factors, axis=1), displacements=np.stack(displacements), velocities=np.stack(velocities)
    )


def free_coordinates(
    frequencies: NDArray[np.float64],
    damping: float,
    starts: NDArray[np.float64],
    jumps: FreeMotionJumps,
    times: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Return q of modes at rising times, shape (modes, times).

    Args:
        frequencies: Ω, 1/s, shape (modes,).
        damping: α, 1/s.
        starts: times of the jumps, s, shape (starts,), rising from 0.
        jumps: of these modes at the starts.
        times: s, rising, from 0, shape (times,).
    """
    values = np.empty((len(frequencies), len(times)))
    edges = np.searchsorted(times, starts)
    displacement: NDArray[np.float64] = np.zeros(len(frequencies))
    velocity: NDArray[np.float64] = np.zeros(len(frequencies))
    stiffness = frequencies**2
    for piece, start in enumerate(starts[: np.searchsorted(starts, times[-1], side="right")]):
        u, v = jumps.at(piece)
        displacement, velocity = displacement + u, velocity + v
        inside = slice(edges[piece], edges[piece + 1] if piece + 1 < len(starts) else len(times))
        steps = times[inside] - start
        if piece + 1 < len(starts):
            steps = np.append(steps, starts[piece + 1] - start)
        first, second = damped_pair(frequencies, damping, steps)
        kick = velocity + damping * displacement
        motion = displacement[:, None] * first + kick[:, None] * second
        values[:, inside] = motion[:, : inside.stop - inside.start]
        if piece + 1 < len(starts):
            kick = damping * velocity + stiffness * displacement
            velocity = velocity * first[:, -1] - kick * second[:, -1]
            displacement = motion[:, -1]
    return values
