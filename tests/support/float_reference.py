"""Reference frequencies of tanks with one or two liquids, rigid floats and beams, by harmonic trial functions.

The lowest λ = ω² of K ζ = λ (M + Σ ρ Cᵀ A⁻¹ C) ζ, ζ = (η, motions of floats, deflections of beams), each liquid keeping
its volume. Potentials are the trial functions of `harmonic_trial`, η is any function, given at the Gauss nodes of the
levels. Values are Ritz values of the exact problem: they come from above.

Nothing of the package is imported.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from float_sections import MOTIONS
from float_tanks import BeamPlace, Fineness, FloatTank, Level, Liquid, Side, discretized
from harmonic_trial import Boundary, energy_basis
from scipy.linalg import block_diag, cholesky, solve_triangular, svd
from scipy.sparse import csr_array


@dataclass(frozen=True, kw_only=True)
class FloatModes:
    """The lowest modes, without those of zero frequency.

    Attributes:
        omega: rad/s, ascending.
        modal_masses: twice the kinetic energy over the square of the velocity of each motion, floats from left to
            right, kg/m or kg m, shape (motions, modes).
        size: number of trial functions.
    """

    omega: np.ndarray
    modal_masses: np.ndarray
    size: int


@dataclass(frozen=True, kw_only=True)
class _Bodies:
    """Motions of floats and polynomials of beams.

    Attributes:
        motions: float and motion of each of the first unknowns.
        beams: the unknowns of each beam.
        stiffness, mass: shape (n, n).
    """

    motions: tuple[tuple[int, str], ...]
    beams: tuple[slice, ...]
    stiffness: np.ndarray
    mass: np.ndarray


def reference_modes(tank: FloatTank, count: int, fineness: Fineness | None = None) -> FloatModes:
    """The lowest modes of a tank.

    Args:
        tank: the tank.
        count: how many modes.
        fineness: how finely it is resolved.

    Returns:
        The modes.
    """
    fineness = fineness or Fineness()
    levels, liquids = discretized(tank, fineness)
    bodies = _bodies(tank, fineness)
    loads = [_loads(tank, levels, bodies, liquid, fineness) for liquid in liquids]
    # Kinetic energy is |Gζ|²/2.
    gains = [_gain(liquid, load, fineness) for liquid, load in zip(liquids, loads, strict=True)]
    nodes = loads[0].shape[1] - len(bodies.mass)
    inertia = np.hstack(
        [np.zeros((len(bodies.mass), nodes)), cholesky(bodies.mass) if len(bodies.mass) else bodies.mass]
    )
    gain = np.vstack([*gains, inertia])
    weights = [Boundary.joined([side.boundary for side in liquid.sides]).weights for liquid in liquids]
    volumes = np.array([load.T @ weight for weight, load in zip(weights, loads, strict=True)])
    omega, shapes = _lowest(gain, volumes, bodies.stiffness, count)
    motions = shapes[nodes : nodes + len(bodies.motions)]
    with np.errstate(divide="ignore"):
        # Modes have unit potential energy, so that their kinetic energy is λ times 1/λ.
        return FloatModes(omega=omega, modal_masses=1.0 / (omega * motions) ** 2, size=len(gain))


def _lowest(gain: np.ndarray, volumes: np.ndarray, stiffness: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """ω and modes of ζᵀKζ = 1; K is 1 at nodes, and a matrix with empty rows for motions that nothing restores."""
    nodes = gain.shape[1] - len(stiffness)
    stuck = np.concatenate([np.ones(nodes, dtype=bool), np.abs(stiffness).sum(axis=1) > 0.0])
    held = stuck[nodes:]
    root = cholesky(stiffness[np.ix_(held, held)]) if held.any() else np.zeros((0, 0))
    largest = np.linalg.norm(volumes)
    if np.abs(volumes[:, ~stuck]).max(initial=0.0) > 1e-9 * largest:
        raise ValueError("a motion that nothing restores must not displace volume")

    def scaled(matrix: np.ndarray) -> np.ndarray:
        bodies = solve_triangular(root, matrix[:, nodes:][:, held].T, trans="T").T if held.any() else matrix[:, :0]
        return np.hstack([matrix[:, :nodes], bodies])

    unit = scaled(gain)
    # In a closed tank the volumes of both liquids are one constraint.
    vectors, sizes, _ = svd(scaled(volumes).T, full_matrices=False)
    constraints = vectors[:, sizes > 1e-9 * largest]
    reduced = unit - (unit @ constraints) @ constraints.T
    loose, _ = np.linalg.qr(gain[:, ~stuck])
    reduced -= loose @ (loose.T @ reduced)
    _, values, shapes = svd(reduced, full_matrices=False)
    values, shapes = values[:count], shapes[:count].T
    modes = np.zeros((len(stuck), len(values)))
    modes[:nodes] = shapes[:nodes]
    if held.any():
        modes[np.flatnonzero(stuck)[nodes:]] = solve_triangular(root, shapes[nodes:])
    if not stuck.all():
        modes[~stuck] = -np.linalg.lstsq(gain[:, ~stuck], gain @ modes)[0]
    return 1.0 / values, modes


def _gain(liquid: Liquid, load: csr_array, fineness: Fineness) -> np.ndarray:
    """√ρ ∮vᵢ ζₙ for trial functions of unit energy and all ζ, shape (functions, unknowns)."""
    boundary = Boundary.joined([side.boundary for side in liquid.sides])
    functions, slopes = liquid.trial.values(boundary)
    functions -= (boundary.weights @ functions) / boundary.weights.sum()
    basis = energy_basis(functions, slopes, boundary.weights, fineness.tolerance)
    return np.sqrt(liquid.density) * (load.T @ (boundary.weights[:, None] * functions) @ basis).T


def _loads(tank: FloatTank, levels: list[Level], bodies: _Bodies, liquid: Liquid, fineness: Fineness) -> csr_array:
    """Displacement out of a liquid at its nodes for each unknown: η of unit stiffness, motions, beams."""
    free = [np.flatnonzero(level.beam < 0) for level in levels]
    starts = np.concatenate([[0], np.cumsum([len(nodes) for nodes in free])])
    loads = []
    for side in liquid.sides:
        load = np.zeros((len(side.boundary.points), starts[-1] + len(bodies.mass)))
        if side.kind == "hull":
            for column, (number, motion) in enumerate(bodies.motions):
                if number == side.number:
                    load[:, starts[-1] + column] = hull_displacement(tank, side, motion)
        if side.kind == "level":
            nodes, weight = free[side.number], tank.gravity * tank.density_step(tank.levels[side.number])
            columns = starts[side.number] + np.arange(len(nodes))
            load[nodes, columns] = side.sign / np.sqrt(weight * side.boundary.weights[nodes])
            for number, columns_of in enumerate(bodies.beams):
                if tank.beams[number].at == tank.levels[side.number]:
                    on = np.flatnonzero(levels[side.number].beam == number)
                    shapes = _beam_shapes(tank.beams[number], side.boundary.points[on], fineness.bending)
                    load[on, starts[-1] + columns_of.start : starts[-1] + columns_of.stop] = side.sign * shapes
        loads.append(load)
    return csr_array(np.vstack(loads))


def hull_displacement(tank: FloatTank, side: Side, motion: str) -> np.ndarray:
    """Displacement of a hull out of the liquid in a unit motion, shape (nodes,)."""
    part = tank.sections[side.number][0]
    if part.thin:
        return part.flux(side.boundary.points)
    offset = (side.boundary.points - np.clongdouble(part.centre)).astype(complex)
    displacement = {"heave": 1j + 0 * offset, "sway": 1.0 + 0 * offset, "roll": 1j * offset}[motion]
    return (displacement * side.boundary.normal.conj()).real


def _bodies(tank: FloatTank, fineness: Fineness) -> _Bodies:
    motions, beams, stiffness, mass = [], [], [np.zeros((0, 0))], [np.zeros((0, 0))]
    for number, (part, moving) in enumerate(tank.sections):
        chosen = np.array([MOTIONS.index(motion) for motion in moving])
        motions += [(number, motion) for motion in moving]
        stiffness.append(part.stiffness[np.ix_(chosen, chosen)])
        mass.append(np.diag([part.mass, part.mass, part.inertia])[np.ix_(chosen, chosen)])
    place = len(motions)
    for beam in tank.beams:
        bending, products = _beam_matrices(beam, fineness.bending)
        restoring = tank.gravity * tank.density_step(beam.at) if beam.restoring else 0.0
        stiffness.append(bending + restoring * products)
        mass.append(beam.mass * products)
        beams.append(slice(place, place + fineness.bending))
        place += fineness.bending
    return _Bodies(motions=tuple(motions), beams=tuple(beams), stiffness=block_diag(*stiffness), mass=block_diag(*mass))


def _bending_polynomials(count: int) -> np.ndarray:
    """1, x and polynomials with orthonormal second derivatives on −1 … 1, in Legendre polynomials, one a column.

    ∫∫Pₙ = ((Pₙ₊₂ − Pₙ)/(2n + 3) − (Pₙ − Pₙ₋₂)/(2n − 1))/(2n + 1), without P₀ and P₁, which are the first two.
    """
    shapes = np.eye(count)
    for n in range(count - 2):
        terms = {n + 2: 1 / (2 * n + 3), n: -1 / (2 * n + 3) - 1 / (2 * n - 1), n - 2: 1 / (2 * n - 1)}
        shapes[:, n + 2] = 0.0
        for degree, factor in terms.items():
            if degree >= 2:
                shapes[degree, n + 2] = factor / (2 * n + 1) * np.sqrt(n + 0.5)
    return shapes


def _beam_shapes(beam: BeamPlace, points: np.ndarray, count: int) -> np.ndarray:
    """Deflections of a beam, shape (places, count)."""
    middle, half = (beam.start + beam.end) / 2, (beam.end - beam.start) / 2
    legendre = np.polynomial.legendre.legvander((points.real.astype(float) - middle) / half, count - 1)
    return legendre @ _bending_polynomials(count)


def _beam_matrices(beam: BeamPlace, count: int) -> tuple[np.ndarray, np.ndarray]:
    """∫EI w''w'' and ∫w w of the deflections of a beam."""
    half = (beam.end - beam.start) / 2
    shapes = _bending_polynomials(count)
    bends = np.arange(count) >= 2
    norms = half * 2 / (2 * np.arange(count) + 1)
    return beam.rigidity / half**3 * np.diag(bends.astype(float)), shapes.T @ (norms[:, None] * shapes)
