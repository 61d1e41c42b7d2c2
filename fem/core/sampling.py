"""Values of functions along surfaces of a mesh.

On a facet a function and the abscissa are polynomials of one parameter 0 ≤ t ≤ 1, known at the same Lagrange points;
where x(t) = x, also in cells with r = sᵐ, t follows by bisection.
"""

from __future__ import annotations

from functools import cache

import basix
import numpy as np
from mpi4py import MPI
from numpy.typing import NDArray
from scipy.interpolate import BarycentricInterpolator

from hydroelastic.fem.core.liquid import Liquid

Array = NDArray[np.float64]

# Halvings of the unit interval down to rounding.
_HALVINGS = 54


def along_level(liquid: Liquid, values: Array, name: str, layer: int, x: Array) -> Array:
    """A function on the facets of a name at abscissas; NaN beside them (collective).

    Args:
        liquid: whose function it is.
        values: of the unknowns of this process.
        name: of facets on which x is monotonic.
        layer: index of the layer.
        x: abscissas, shape (points,).
    """
    trace = liquid.trace(name, layer)
    known = np.zeros(trace.facets.shape)
    own = (trace.facets >= liquid.first) & (trace.facets < liquid.first + liquid.owned)
    known[own] = values[trace.facets[own] - liquid.first]
    liquid.comm.Allreduce(MPI.IN_PLACE, known)
    abscissas = trace.points[..., 0]
    found = np.full(len(x), np.nan)
    nodes = _nodes(abscissas.shape[1] - 1)
    for places, function in zip(abscissas, known, strict=True):
        here = np.flatnonzero((x >= places[0]) & (x <= places[-1]))
        if len(here):
            t = _parameters(BarycentricInterpolator(nodes, places), x[here])
            found[here] = BarycentricInterpolator(nodes, function)(t)
    return found


def _parameters(abscissa: BarycentricInterpolator, x: Array) -> Array:
    low: Array = np.zeros(len(x))
    high: Array = np.ones(len(x))
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        below = abscissa(middle) < x
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    return np.asarray(0.5 * (low + high))


@cache
def _nodes(degree: int) -> Array:
    element = basix.create_element(
        basix.ElementFamily.P, basix.CellType.interval, degree, basix.LagrangeVariant.gll_warped
    )
    return np.sort(element.points[:, 0])
