"""A thread whose tension is much larger than the load on it: ε = ∫|q|/T."""

from __future__ import annotations

import math

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import ArrayLike

from hydroelastic.modal.thread.shape import AsymptoticThread, NoAsymptoticError, ThreadShape
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.thread_load import ThreadLoad

# Small parameter above which no order is more accurate than the one before.
_LARGEST = 0.5
_PANELS = 16

_NODES = 10


def tension_dominated(
    load: ThreadLoad,
    length: float,
    end_force: ArrayLike,
    s: ArrayLike,
    *,
    order: int = 2,
    axial_rigidity: float = math.inf,
    start: ArrayLike = (0.0, 0.0, 0.0),
) -> AsymptoticThread:
    """Return the shape of a thread that is held at A and pulled at B by a large constant force F, by quadrature.

    T₀ = |F|, e = F/T₀, P = I − eeᵀ, q₀(s) = q(r_A + e s, e):
    order 1: N₁ = ∫ₛᴸ q₀, b₁ = P N₁/T₀, a₁ = e·N₁/T₀, r₁ = ∫₀ˢ (b₁ + F/EA);
    order 2: N₂ = ∫ₛᴸ (q_r r₁ + q_τ b₁), τ₂ = P N₂/T₀ − a₁b₁ − |b₁|²e/2, r₂ = ∫₀ˢ (τ₂ + N₁/EA);
    r = r_A + e s + r₁ + r₂ + O(ε³), N = F + N₁ + N₂ + O(ε³ T₀). T₀/EA counts as ε.

    Args:
        load: q.
        length: L, m.
        end_force: F, N, shape (3,).
        s: places, m, increasing, shape (n,).
        order: 0, 1 or 2.
        axial_rigidity: EA, N; infinite if the thread does not stretch.
        start: position of A, m.

    Returns:
        The shape at s, with ε and what is left out; for order 2 that is ε times its own term.
    """
    if order not in (0, 1, 2):
        raise ValueError(f"order is {order}: it must be 0, 1 or 2")
    force, begin = np.asarray(end_force, dtype=float), np.asarray(start, dtype=float)
    pull, places = float(np.linalg.norm(force)), np.asarray(s, dtype=float)
    if pull == 0:
        raise NoAsymptoticError("no force pulls at the end")
    direction = force / pull
    rule = PanelQuadrature(_knots(load, length, direction, begin, places))
    at, tangents = begin + np.outer(rule.nodes, direction), np.tile(direction, (len(rule.nodes), 1))
    across = np.eye(3) - np.outer(direction, direction)

    loads = load.load(at, tangents)
    small = _small(rule, loads, pull) + pull / axial_rigidity
    if not small < _LARGEST:
        raise NoAsymptoticError(f"the load is {small:.3g} of the tension: it must be below {_LARGEST}")
    first, first_at_knots = _to_end(rule, loads)
    turn = first @ across / pull
    moved, moved_at_knots = rule.running(turn + force / axial_rigidity)

    change = np.einsum("nij,nj->ni", load.load_by_position(at, tangents), moved)
    change += np.einsum("nij,nj->ni", load.load_by_tangent(at, tangents), turn)
    second, second_at_knots = _to_end(rule, change)
    bend = second @ across / pull - (first @ direction / pull)[:, None] * turn
    bend -= 0.5 * np.outer(np.sum(turn**2, axis=1), direction)
    _, bent_at_knots = rule.running(bend + first / axial_rigidity)

    position_terms = [np.outer(rule.knots, direction), moved_at_knots, bent_at_knots]
    force_terms = [np.tile(force, (len(rule.knots), 1)), first_at_knots, second_at_knots]
    chosen = np.searchsorted(rule.knots, places)
    return AsymptoticThread(
        shape=ThreadShape(
            s=places,
            positions=begin + np.sum(position_terms[: order + 1], axis=0)[chosen],
            forces=np.sum(force_terms[: order + 1], axis=0)[chosen],
        ),
        order=order,
        small=small,
        position_truncation=_left_out(position_terms, order, small),
        force_truncation=_left_out(force_terms, order, small),
    )


def _knots(load: ThreadLoad, length: float, direction: FloatArray, begin: FloatArray, places: FloatArray) -> FloatArray:
    """Return knots: the places, where the straight thread meets breaks of the stream, and places between."""
    breaks = np.array(load.stream.breaks if load.stream is not None else (), dtype=float)
    crossings = (breaks - begin[2]) / direction[2] if direction[2] != 0 else np.empty(0)
    inside = crossings[(crossings > 0) & (crossings < length)]
    return np.unique(np.concatenate([np.linspace(0, length, _PANELS + 1), places, inside]))


def _small(rule: PanelQuadrature, loads: FloatArray, pull: float) -> float:
    return float(rule.running(np.linalg.norm(loads, axis=1, keepdims=True))[1][-1, 0]) / pull


def _to_end(rule: PanelQuadrature, values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the integrals from the nodes, and from the knots, to the end."""
    at_nodes, at_knots = rule.running(values)
    return at_knots[-1] - at_nodes, at_knots[-1] - at_knots


def _left_out(terms: list[FloatArray], order: int, small: float) -> float:
    following = terms[order + 1] if order < 2 else small * terms[2]
    return float(np.linalg.norm(following, axis=1).max())


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
