"""Exact frequencies of the tank without a beam, and of a guided plate that covers it."""

from __future__ import annotations

import numpy as np

from hydroelastic.modal.beam.floating_beam import FloatingBeam
from hydroelastic.physics.arrays import FloatArray


def wavenumbers(tank_length: float, count: int) -> FloatArray:
    """Return k_n = nπ/L, 1/m, n = 1 … count, for a tank of length L in metres."""
    return np.arange(1, count + 1) * np.pi / tank_length


def sloshing_frequencies(tank_length: float, depth: float, gravity: float, count: int) -> FloatArray:
    """Return ω_n = √(g k_n tanh k_n H) of the open tank.

    Args:
        tank_length: L, m.
        depth: H, m.
        gravity: g, m/s².
        count: how many, n = 1 … count.

    Returns:
        Angular frequencies, rad/s, shape (count,).

    Source: H. Lamb, "Hydrodynamics", art. 228.
    """
    k = wavenumbers(tank_length, count)
    return np.sqrt(gravity * k * np.tanh(k * depth))


def guided_cover_frequencies(beam: FloatingBeam, count: int) -> FloatArray:
    """Return the exact frequencies of a beam over the whole tank with guided ends, w' = w''' = 0 at the walls:

        ω_n² = (EI k_n⁴ + s ρ g) / (m + ρ/(k_n tanh k_n H)).

    Args:
        beam: the problem; its ``start`` and ``length`` are not used, the plate covers the tank.
        count: how many, n = 1 … count.

    Returns:
        Angular frequencies, rad/s, shape (count,).

    Source: theory of the aquarium, docs, § 2 (exact checks).
    """
    k = wavenumbers(beam.tank_length, count)
    stiffness = beam.flexural_rigidity * k**4 + beam.hydrostatic_stiffness
    return np.sqrt(stiffness / (beam.mass_per_length + beam.density / (k * np.tanh(k * beam.depth))))
