"""A second method for `float_reference`: Green's third identity on the whole boundary of each liquid (Nyström).

ψ(z) ∮ ∂G/∂n = ∮ (ψ(z') ∂G/∂n' − G ∂ψ/∂n') with G = ln|z − z'|, so that corners need no factors of their own. ψ and
∂ψ/∂n are polynomials on panels, which shrink geometrically towards the corners of floats; integrals near a place are
made on pieces of panels that shrink dyadically towards it. Floats without beams. Sections and their hydrostatics are
those of `float_sections`; all else is shared with no other method.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from float_reference import hull_displacement
from float_sections import MOTIONS, Arc, line
from float_tanks import FloatTank, Side
from harmonic_trial import Boundary
from scipy.linalg import block_diag, cholesky, solve_triangular

ORDER = 12
NODES, WEIGHTS = np.polynomial.legendre.leggauss(ORDER)
FINE_NODES, FINE_WEIGHTS = np.polynomial.legendre.leggauss(20)


@dataclass(frozen=True, kw_only=True)
class Panel:
    """A piece of an arc: its nodes, with the liquid to the right."""

    arc: Arc
    start: float
    length: float
    role: tuple[str, int]

    def at(self, nodes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """z and dz of places −1 … 1."""
        places = np.longdouble(self.start) + np.longdouble(self.length) * (nodes.astype(np.longdouble) + 1) / 2
        return self.arc.point(places).astype(complex), (self.arc.slope(places) * self.length / 2).astype(complex)


def panels_on(
    arc: Arc, role: tuple[str, int], *, graded: tuple[bool, bool], ratio: float, smallest: float, pieces: int
) -> list[Panel]:
    """Panels of an arc, graded towards some of its ends."""
    cuts = set(np.linspace(0.0, 1.0, pieces + 1))
    layer = 1.0 / pieces
    while layer > smallest:
        layer *= ratio
        cuts |= {layer} if graded[0] else set()
        cuts |= {1.0 - layer} if graded[1] else set()
    ordered = sorted(cuts)
    return [Panel(arc=arc, start=low, length=high - low, role=role) for low, high in pairwise(ordered)]


def neumann_to_dirichlet(panels: list[Panel]) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """T of ψ = T ∂ψ/∂n at the nodes of a closed boundary, with nodes, normals and weights; ψ has no mean."""
    z, dz = (np.concatenate(part) for part in zip(*(panel.at(NODES) for panel in panels), strict=True))
    weights = np.tile(WEIGHTS, len(panels)) * np.abs(dz)
    normals = 1j * dz / np.abs(dz)
    apart = z[None, :] - z[:, None]
    np.fill_diagonal(apart, 1.0)
    single = np.log(np.abs(apart)) * weights
    double = (normals / apart).real * weights
    for number, panel in enumerate(panels):
        own = slice(number * ORDER, (number + 1) * ORDER)
        size = weights[own].sum()
        near = np.flatnonzero(np.abs(z - z[own].mean()) < 1.6 * size)
        for target in near:
            place = NODES[target - own.start] if own.start <= target < own.stop else None
            single[target, own], double[target, own] = _near(panel, z[target], place)
    # ½ψ, or what it is at corners, from the identity for a constant.
    np.fill_diagonal(double, double.diagonal() - double.sum(axis=1))
    matrix = double + weights[None, :] / weights.sum()
    return np.linalg.solve(matrix, single), z, normals, weights


def _near(panel: Panel, target: complex, place: float | None) -> tuple[np.ndarray, np.ndarray]:
    """∫G and ∫∂G/∂n of the polynomials that are 1 at one node, from a place near or on the panel."""
    pieces = [(-1.0, place), (place, 1.0)] if place is not None else [(-1.0, 1.0)]
    nodes, weights = [], []
    pending = list(pieces)
    while pending:
        low, high = pending.pop()
        points, _ = panel.at(np.array([low, (low + high) / 2, high]))
        size = abs(points[2] - points[0])
        touching = place in (low, high) if place is not None else False
        if (np.abs(points - target).min() < 0.8 * size or touching) and high - low > 1e-15:
            middle = (low + high) / 2
            pending += [(low, middle), (middle, high)]
            continue
        nodes.append((low + high) / 2 + (high - low) / 2 * FINE_NODES)
        weights.append((high - low) / 2 * FINE_WEIGHTS)
    x, w = np.concatenate(nodes), np.concatenate(weights)
    z, dz = panel.at(x)
    apart = z - target
    distance = np.abs(apart)
    kept = distance > 0
    x, w, apart, dz = x[kept], w[kept], apart[kept], dz[kept]
    shapes = _lagrange(x)
    return (np.log(np.abs(apart)) * np.abs(dz) * w) @ shapes, ((1j * dz / apart).real * w) @ shapes


def _lagrange(x: np.ndarray) -> np.ndarray:
    return np.polynomial.legendre.legvander(x, ORDER - 1) @ INVERSE


INVERSE = np.linalg.inv(np.polynomial.legendre.legvander(NODES, ORDER - 1))


def _outline(tank: FloatTank, layer: int, ratio: float, smallest: float, pieces: int) -> list[Panel]:
    """The closed boundary of one liquid, counted clockwise around it as arcs go."""
    low, high = (-tank.depths[0], 0.0) if layer == 0 else (0.0, tank.depths[1])
    length = tank.length
    grading: dict[str, Any] = {"ratio": ratio, "smallest": smallest}
    found: list[Panel] = []
    # Eastwards with the liquid below, westwards with the liquid above.
    stops: list[Any] = [0.0, *(end for part, _ in tank.sections for end in part.ends), length]
    for number, (left, right) in enumerate(zip(stops[::2], stops[1::2], strict=True)):
        first, last = (np.clongdouble(x) for x in (left, right))
        arc = line(first, last) if layer == 0 else line(last, first)
        ends = (number > 0, number < len(stops) // 2 - 1)
        graded = ends if layer == 0 else ends[::-1]
        found += panels_on(arc, ("level", 0), graded=graded, pieces=pieces, **grading)
    for number, (part, _) in enumerate(tank.sections):
        for arc in part.below if layer == 0 else part.above:
            found += panels_on(arc, ("hull", number), graded=(True, True), pieces=max(2, pieces // 3), **grading)
    other = low if layer == 0 else high
    corners = [complex(length, 0.0), complex(length, other), complex(0.0, other), 0j]
    corners = corners if layer == 0 else corners[::-1]
    for start, end in pairwise(corners):
        role = ("level", 1) if layer == 1 and tank.top == "free" and start.imag == end.imag else ("rigid", 0)
        found += panels_on(line(start, end), role, graded=(False, False), pieces=pieces, **grading)
    return found


def second_omega(
    tank: FloatTank, count: int, *, ratio: float = 0.3, smallest: float = 1e-6, pieces: int = 8
) -> np.ndarray:
    """The lowest frequencies, rad/s, by boundary integrals.

    Args:
        tank: a tank without beams.
        count: how many.
        ratio: of neighbouring panels towards a corner.
        smallest: of them, in parts of an arc.
        pieces: panels of an arc without corners.

    Returns:
        ω, ascending.
    """
    motions = [(number, motion) for number, (_, moving) in enumerate(tank.sections) for motion in moving]
    stiffness, mass = _rigid(tank)
    kept = [tank.sections[number][0].stiffness[0, 0] > 0 and motion != "sway" for number, motion in motions]
    starts, total = {}, 0
    inertia, volumes, pending = None, [], []
    for layer, density in enumerate(tank.densities):
        panels = _outline(tank, layer, ratio, smallest, pieces)
        operator, z, normals, weights = neumann_to_dirichlet(panels)
        pending.append((panels, operator, z, normals, weights, density, layer))
        for level in range(2):
            places = np.flatnonzero([panel.role == ("level", level) for panel in panels for _ in range(ORDER)])
            if len(places) and level not in starts:
                starts[level] = (total, places, weights[places])
                total += len(places)
    size = total + len(motions)
    inertia = block_diag(np.zeros((total, total)), mass)
    for panels, operator, z, normals, weights, density, layer in pending:
        load = np.zeros((len(z), size))
        roles = [panel.role for panel in panels for _ in range(ORDER)]
        for level, (start, _, level_weights) in starts.items():
            places = np.flatnonzero([role == ("level", level) for role in roles])
            if not len(places):
                continue
            # Both liquids follow the interface in opposite directions.
            order = np.argsort(z[places].real)
            reference = np.argsort(pending[0][2][starts[level][1]].real) if level == 0 else order
            step = tank.density_step(tank.levels[level]) * tank.gravity
            sign = -1.0 if layer == 1 and level == 0 else 1.0
            load[places[order], start + reference] = sign / np.sqrt(step * level_weights[reference])
        for column, (number, motion) in enumerate(motions):
            places = np.flatnonzero([role == ("hull", number) for role in roles])
            side = Side(
                boundary=Boundary(
                    points=z[places].astype(np.clongdouble), normal=normals[places], weights=weights[places]
                ),
                kind="hull",
                number=number,
            )
            load[places, total + column] = hull_displacement(tank, side, motion)
        volume = weights @ load
        volumes.append(volume)
        # What has a mean is forbidden by the constraint; the operator sees none.
        part = (
            density
            * (load * weights[:, None]).T
            @ (operator @ (load - np.outer(np.ones(len(z)), volume) / weights.sum()))
        )
        inertia += part
    return _solved(inertia, stiffness, np.array(volumes), np.array(kept, dtype=bool), total, count)


def _rigid(tank: FloatTank) -> tuple[np.ndarray, np.ndarray]:
    stiffness, mass = [], []
    for part, moving in tank.sections:
        chosen = np.array([MOTIONS.index(motion) for motion in moving])
        stiffness.append(part.stiffness[np.ix_(chosen, chosen)])
        mass.append(np.diag([part.mass, part.mass, part.inertia])[np.ix_(chosen, chosen)])
    return block_diag(*stiffness), block_diag(*mass)


def _solved(
    inertia: np.ndarray, stiffness: np.ndarray, volumes: np.ndarray, kept: np.ndarray, nodes: int, count: int
) -> np.ndarray:
    stuck = np.concatenate([np.ones(nodes, dtype=bool), kept])
    loose = inertia[np.ix_(~stuck, ~stuck)]
    cross = inertia[np.ix_(~stuck, stuck)]
    reduced = inertia[np.ix_(stuck, stuck)] - (
        inertia[np.ix_(stuck, ~stuck)] @ np.linalg.solve(loose, cross) if len(loose) else 0.0
    )
    root = block_diag(np.eye(nodes), cholesky(stiffness[np.ix_(kept, kept)]))
    unit = solve_triangular(root, solve_triangular(root, reduced, trans="T").T, trans="T")
    vectors, sizes, _ = np.linalg.svd(solve_triangular(root, volumes[:, stuck].T, trans="T"), full_matrices=False)
    constraints = vectors[:, sizes > 1e-6 * sizes[0]]
    projected = unit - constraints @ (constraints.T @ unit)
    projected -= (projected @ constraints) @ constraints.T
    # Symmetric but for the error of discretisation: as it is, smooth shapes converge exponentially.
    values = np.sort(np.linalg.eigvals(projected).real)
    return 1 / np.sqrt(values[::-1][:count])
