"""Shape of a thread at rest: positions and contact force along it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hydroelastic.physics.arrays import FloatArray


class NoTensionError(RuntimeError):
    """A thread without bending stiffness has no such equilibrium: its tension would vanish somewhere."""


@dataclass(frozen=True)
class ThreadShape:
    """A thread at places along it."""

    s: FloatArray  # unstretched arc length from end A, m, increasing, shape (n,)
    positions: FloatArray  # r, m, shape (n, 3)
    forces: FloatArray  # contact force N of the part beyond s on the part before it, N, shape (n, 3)

    @property
    def tensions(self) -> FloatArray:
        """T = |N|, N, shape (n,)."""
        return np.asarray(np.linalg.norm(self.forces, axis=1))

    @property
    def tangents(self) -> FloatArray:
        """τ = N/T, shape (n, 3)."""
        return self.forces / self.tensions[:, None]


class NoAsymptoticError(ValueError):
    """The conditions of an asymptotic solution do not hold."""


@dataclass(frozen=True)
class AsymptoticThread:
    """An asymptotic solution with its truncation error."""

    shape: ThreadShape  # positions and contact forces
    order: int  # of the last terms that are kept
    small: float  # the small parameter of the expansion
    # estimate of the largest error of a position, m: the next term, or the last one times the small parameter
    position_truncation: float
    force_truncation: float  # the same of a contact force, N
