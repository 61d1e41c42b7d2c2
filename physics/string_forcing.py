"""Motions of the upper end of a string as pieces of cubic polynomials plus exponentials."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

# f, f', f'', f''': no piece has more.
DERIVATIVES = 4


@dataclass(frozen=True, kw_only=True, eq=False)
class Forcing:
    """f(t) = Σ_n d_n (t − t_j)ⁿ/n! on piece j, plus Re Σ c e^{st} from t = 0."""

    # times t_j at which pieces start, s, rising from 0, shape (pieces,). The last one has no end.
    starts: NDArray[np.float64]
    derivatives: NDArray[np.float64]  # d_n, m/sⁿ, the limits from the right at the starts, shape (4, pieces)
    # s, 1/s, complex with real part up to 0, shape (exponentials,)
    rates: NDArray[np.complex128] = field(default_factory=lambda: np.empty(0, dtype=complex))
    # c, m, complex, shape (exponentials,)
    weights: NDArray[np.complex128] = field(default_factory=lambda: np.empty(0, dtype=complex))

    def derivative(self, order: int, times: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the derivative of f of an order from 0 to 3 at times from 0 (limits from the right)."""
        exponentials = np.exp(np.multiply.outer(times, self.rates)) @ (self.weights * self.rates**order)
        return np.asarray(self.polynomial(order, times) + exponentials.real)

    def polynomial(self, order: int, times: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the derivative of the polynomial part alone."""
        piece = np.searchsorted(self.starts, times, side="right") - 1
        return _taylor(self.derivatives[:, piece], order, times - self.starts[piece])

    def jumps(self) -> NDArray[np.float64]:
        """Return how much f, f', f'', f''' of the polynomials jump at the starts, shape (4, pieces); from rest at 0."""
        after = self.derivatives
        before = np.zeros_like(after)
        spans = np.diff(self.starts)
        for order in range(DERIVATIVES):
            before[order, 1:] = _taylor(after[:, :-1], order, spans)
        # Not even jumps of rounding are left out: those of f''' are large where damping is heavy, and theirs balance.
        return after - before


def _taylor(derivatives: NDArray[np.float64], order: int, steps: NDArray[np.float64]) -> NDArray[np.float64]:
    value = np.zeros_like(steps)
    for higher in range(DERIVATIVES - 1, order - 1, -1):
        value = derivatives[higher] + value * steps / (higher - order + 1)
    return value


def one_piece(*derivatives: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return starts and derivatives of one piece from t = 0 with the given f, f', … there."""
    column = np.zeros((DERIVATIVES, 1))
    column[: len(derivatives), 0] = derivatives
    return np.zeros(1), column
