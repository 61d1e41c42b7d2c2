"""Running integrals over panels, by Gauss's rule in each of them."""

from __future__ import annotations

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import ArrayLike

from hydroelastic.physics.arrays import FloatArray

_NODES = 10


class PanelQuadrature:
    """Gauss's nodes between knots, and integrals from the first knot to all of them, exact for degree 9."""

    def __init__(self, knots: ArrayLike) -> None:
        """Take the ends of the panels.

        Args:
            knots: increasing, shape (panels + 1,); what is integrated is smooth between them.
        """
        self.knots = np.asarray(knots, dtype=float)
        nodes, weights = legendre.leggauss(_NODES)
        widths = np.diff(self.knots)
        self.nodes = (self.knots[:-1, None] + 0.5 * widths[:, None] * (1 + nodes)).ravel()
        self._half_widths, self._weights = 0.5 * widths, weights
        # Interpolate by Legendre polynomials, exactly at the nodes, and integrate each from −1.
        coefficients = np.linalg.inv(legendre.legvander(nodes, _NODES - 1))
        primitives = np.stack([legendre.legint(row, lbnd=-1) for row in np.eye(_NODES)], axis=1)
        self._partial = legendre.legvander(nodes, _NODES) @ primitives @ coefficients

    def running(self, values: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the integral from the first knot to the nodes, and to the knots.

        Args:
            values: the integrand at ``nodes``, shape (nodes, components).
        """
        panels = values.reshape(len(self.knots) - 1, _NODES, -1) * self._half_widths[:, None, None]
        sums = np.einsum("j,ijk->ik", self._weights, panels)
        at_knots = np.concatenate([np.zeros((1, sums.shape[1])), np.cumsum(sums, axis=0)])
        inside = at_knots[:-1, None, :] + np.einsum("lj,ijk->ilk", self._partial, panels)
        return inside.reshape(values.shape), at_knots
