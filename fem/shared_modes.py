"""Modes of many bodies in one liquid, solved together: in stacked arrays each operation is called once for all."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

import numpy as np

from hydroelastic.fem.dense_modes import CompletedModes, DenseModes, DenseSolution, projection_errors
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.shared_answer import SharedAnswer

# Modes whose errors are estimated at once: their coefficients stay in the cache of a processor.
_AT_ONCE = 128


class LiquidErrors:
    """Error estimates of the modes of one problem, each made once; see `SharedErrors.away_and_at_tips`."""

    def __init__(self, estimate: Callable[[np.ndarray], np.ndarray], displacements: np.ndarray) -> None:
        """Begin without any.

        Args:
            estimate: returns those of some ζ, shape (modes, 2).
            displacements: ζ of all modes, shape (n, modes).
        """
        self._estimate, self._displacements = estimate, displacements
        self._known: dict[int, np.ndarray] = {}

    def __call__(self, numbers: Sequence[int]) -> np.ndarray:
        """Return the estimates of the modes of some numbers, shape (modes, 2)."""
        self.estimate_together([(self, numbers)])
        return np.array([self._known[number] for number in numbers])

    @staticmethod
    def estimate_together(asked: Iterable[tuple[LiquidErrors, Sequence[int]]]) -> None:
        """Estimate modes of some numbers of problems that share an answer, but those that are known."""
        missing = [(one, number) for one, numbers in asked for number in numbers if number not in one._known]
        for first in range(0, len(missing), _AT_ONCE):
            block = missing[first : first + _AT_ONCE]
            estimate = block[0][0]._estimate
            found = estimate(np.column_stack([one._displacements[:, number] for one, number in block]))
            for (one, number), row in zip(block, found, strict=True):
                one._known[number] = row


def solved_together(pencils: Sequence[CoupledPencil], answer: SharedAnswer, count: int) -> list[DenseSolution]:
    """Return a number of the lowest modes of each of some problems, the surfaces projected.

    Args:
        pencils: problems that differ in stiffness and mass of bodies, with the same motions without stiffness.
        answer: of their liquid.
        count: number of modes of each.
    """
    bodies = np.array([one.body_stiffness for one in pencils]), np.array([one.body_mass for one in pencils])
    dense = DenseModes(pencils[0], answer, answer.projection(count), bodies)
    ascending, vectors = np.linalg.eigh(dense.operator())
    inverses, vectors = ascending[:, ::-1], vectors[:, :, : -count - 1 : -1]
    # 1/λ of what is lost in rounding may be negative; it is left out afterwards.
    found = dense.completed(1.0 / np.maximum(inverses[:, :count], np.finfo(float).tiny), vectors)
    displacements, energies = dense.displacements(found, slice(None)), dense.energies(found, slice(None))
    amplitudes, projection = dense.amplitudes(found), projection_errors(inverses, found.residuals)
    estimate = answer.liquid_errors

    def one(place: int) -> DenseSolution:
        return DenseSolution(
            inverses=inverses[place],
            modes=CompletedModes(**{name: values[place] for name, values in vars(found).items()}),
            amplitudes=amplitudes[place],
            displacements=lambda some: displacements[place][:, some],
            energies=lambda some: energies[place][:, some],
            projection=projection[place],
            liquid_errors=None if estimate is None else LiquidErrors(estimate, displacements[place]),
        )

    return [one(place) for place in range(len(pencils))]
