"""The answer of a liquid that many bodies share, in the gravity modes of its surfaces.

With bodies held, the surfaces have the modes K_η q = λ M_a q, 1/λ = Δ. In them, η = Σ s q, only K and M of the bodies
change from one problem to the next:

    [K − λ(M + B)   −λ Cᵀ  ] [a]
    [−λ C           1 − λ Δ] [s] = 0

Gravity modes far above λ follow the bodies: s = λ(1 − λΔ)⁻¹C a = λ(C + λΔC + …)a. A few vectors, the leading left
singular vectors of these terms, take their place (component mode synthesis with residual attachment modes: R. H.
MacNeal, Computers & Structures 1 (1971) 581–601; S. Rubin, AIAA Journal 13 (1975) 995–1006). The basis depends on no
property of the bodies, but on their shapes.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from math import ceil

import numpy as np

from hydroelastic.fem.liquid_answer import LiquidAnswer, Projection

# Gravity modes that are kept for each mode asked for; those of long waves have λ in proportion to their number. Their
# number is rounded up, so that few bases are made.
_KEPT, _STEP = 1.5, 16
# Terms of the motion of the others, and least singular value relative to the largest.
_TERMS, _SMALLEST = 4, 1e-8
# Closer to a gravity mode the elimination of the surfaces loses digits.
_RESONANT = 1e-6


@dataclass(frozen=True, kw_only=True)
class SharedAnswer(LiquidAnswer):
    """An answer for many bodies of the same shapes.

    Attributes:
        bodies: number of the first unknowns, which belong to bodies.
        volumes: of the constraints, in the scaled unknowns of the surfaces, shape (constraints, surface unknowns).
        liquid_errors: returns error estimates of modes from ζ, see `SharedErrors.away_and_at_tips`; ``None`` where
            cells are curved.
    """

    bodies: int
    volumes: np.ndarray
    liquid_errors: Callable[[np.ndarray], np.ndarray] | None
    _projections: dict[int, Projection] = field(default_factory=dict)

    @cached_property
    def _gravity(self) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Δ descending, the scaled gravity modes as columns, C, and the volumes of these modes."""
        inverses, modes = np.linalg.eigh(self.scaled[self.bodies :, self.bodies :])
        modes = modes[:, ::-1]
        return inverses[::-1], modes, modes.T @ self.scaled[self.bodies :, : self.bodies], self.volumes @ modes

    def projection(self, count: int) -> Projection:
        """Return a basis for a number of the lowest modes."""
        kept = _STEP * ceil(_KEPT * count / _STEP)
        if kept not in self._projections:
            inverses, modes, loads, _ = self._gravity
            ratios = inverses[kept:, None] / inverses[min(kept, len(inverses) - 1)]
            terms = np.hstack([loads[kept:] * ratios**power for power in range(_TERMS)])
            left, sizes, _ = np.linalg.svd(terms, full_matrices=False)
            followers = modes[:, kept:] @ left[:, sizes > _SMALLEST * sizes.max(initial=0.0)]
            basis = np.hstack([modes[:, :kept], followers])
            surfaces = self.scaled[:, self.bodies :] @ basis
            columns = np.hstack([self.scaled[:, : self.bodies], surfaces])
            kinetics = np.vstack([columns[: self.bodies], basis.T @ columns[self.bodies :]])
            self._projections[kept] = Projection(
                basis=basis,
                root=self.root @ basis,
                volumes=self.volumes,
                projected_volumes=self.volumes @ basis,
                columns=columns,
                kinetics=kinetics,
            )
        return self._projections[kept]

    def eliminated(self, eigenvalues: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Eliminate the surfaces from K − σ(M + M_a), bordered by the constraints.

        Args:
            eigenvalues: σ of some problems, shape (problems,).

        Returns:
            The number of negative pivots; what is left of the bodies, without K − σM, and the constraints, shape
            (problems, bodies + constraints, bodies + constraints); and whether σ is far enough from gravity modes.
        """
        inverses, _, loads, volumes = self._gravity
        shifts = eigenvalues[:, None, None]
        pivots = 1.0 - eigenvalues[:, None] * inverses
        rows = np.concatenate([-shifts * loads.T, np.broadcast_to(volumes, (len(shifts), *volumes.shape))], axis=1)
        with np.errstate(divide="ignore", invalid="ignore"):
            left = -(rows / pivots[:, None, :]) @ rows.swapaxes(-1, -2)
        left[:, : self.bodies, : self.bodies] -= shifts * self.added_mass[: self.bodies, : self.bodies]
        return (
            np.count_nonzero(pivots < 0.0, axis=1),
            left,
            np.abs(pivots).min(axis=1, initial=np.inf) >= _RESONANT,
        )
