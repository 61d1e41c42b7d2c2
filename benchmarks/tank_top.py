"""What the scripts of NGSolve and scikit-fem share: dry modes of the beam, a resolution, the eigenproblem on the top.

    K ζ = ω² (M + Cᵀ A⁺ C) ζ        ζ = (a, η): dry modes of the beam, then the elevation of the water

is solved for the largest 1/ω² by the Lanczos method: one solution of the liquid for each step, and no restart. SciPy's
ARPACK takes as many steps, and 1.1 to 1.7 times the seconds.
"""

from __future__ import annotations

from collections.abc import Callable
from math import ceil, log10, pi
from typing import Any, NamedTuple

import numpy as np
from scipy.linalg import eigh_tridiagonal

MODES = 10
RING_RATIO = 0.15
"""Of the sizes of successive rings; from 0.1 to 0.2 the same errors cost the same within a tenth."""

Array = Any
Tank = dict[str, Any]


class Resolution(NamedTuple):
    """Largest elements at the water and under the beam, m; layers around the beam's ends; number of dry modes."""

    degree: int
    water_size: float
    beam_size: float
    rings: int
    shapes: int


def resolution(tank: Tank, degree: int, on_water: float, under_beam: float, degrees_per_ring: int) -> Resolution:
    """Return what a degree is worth, from sizes in wavelengths of the highest mode: rules that were found by search on
    the tanks of the benchmark; the fewest seconds for an error lie within a tenth or two of them."""
    omega, start, length = tank["highest"], tank["start"], tank["beam_length"]
    gaps = [gap for gap in (start, tank["length"] - start - length) if gap > 0.0]
    return Resolution(
        degree=degree,
        water_size=on_water * 2.0 * pi * tank["gravity"] / omega**2,
        beam_size=under_beam * 2.0 * pi * (tank["rigidity"] / tank["density"] / omega**2) ** 0.2,
        rings=max(2, degree // degrees_per_ring),
        # The narrower a gap, the more the beam bends near its end.
        shapes=ceil((24.0 + 30.0 * log10(length / min(gaps))) * 1.15 ** (degree - 10)),
    )


def _roots(count: int) -> Array:
    """κ with cos κ cosh κ = 1, by Newton's method from (n + 1/2)π."""
    roots = (np.arange(count) + 1.5) * pi
    for _ in range(4):
        roots -= (np.cos(roots) - 1.0 / np.cosh(roots)) / (np.tanh(roots) / np.cosh(roots) - np.sin(roots))
    return roots


def dry_shapes(count: int, s: Array) -> Array:
    """Evaluate the modes of a free beam at s = x/l: e^{−κs} ± e^{−κ(1−s)} + cos κs − σ sin κs from the nearer end."""
    roots = _roots(max(count - 2, 0)).reshape(-1, *(1 for _ in s.shape))
    parity = np.where(np.arange(len(roots)) % 2 == 0, 1.0, -1.0).reshape(roots.shape)
    ratio = parity * np.exp(-roots)
    far = s > 0.5
    phase = roots * np.where(far, 1.0 - s, s)
    decay = np.exp(-phase)
    elastic = (decay + ratio / decay - (1.0 - ratio) * np.sin(phase)) / (1.0 + ratio) + np.cos(phase)
    rigid = np.stack([np.ones_like(s), np.sqrt(3.0) * (2.0 * s - 1.0)])
    return np.concatenate([rigid[:count], np.where(far, parity * elastic, elastic)])


def frequencies(
    tank: Tank, half: str, mass: Array, water: Array, loads: Array, constant: Array, answer: Callable[[Array], Array]
) -> Array:
    """Return the lowest ω of a tank, or of one class of its modes.

    Args:
        tank: the tank.
        half: "", or "even" or "odd" where the left half is meshed for modes of that symmetry.
        mass: ∫φφ over the water, on the unknowns of the top.
        water: unknowns on the closure of the water.
        loads: ∫φW over the beam, shape (unknowns, all shapes).
        constant: coefficients of ψ = 1.
        answer: from a load on the top to ψ there, one unknown of ψ held where it has a constant.
    """
    every = np.arange(loads.shape[1])
    every = every[every % 2 == (half == "odd")] if half else every
    size, gravity = tank["beam_length"] * (0.5 if half else 1.0) / tank["density"], tank["gravity"]
    bending = tank["rigidity"] * np.concatenate([[0.0, 0.0], _roots(loads.shape[1] - 2) ** 4])[every]
    restoring = tank["density"] * gravity if tank["hydrostatic"] else 0.0
    stiffness = size * (bending / tank["beam_length"] ** 4 + restoring)
    flexibility = np.divide(1.0, stiffness, out=np.zeros(len(every)), where=stiffness > 0.0)
    free, shapes, inertia = np.flatnonzero(stiffness == 0.0), len(every), size * tank["mass"]
    rows, beside = loads[:, every], mass[water][:, water]
    across, on_water = np.ascontiguousarray(rows.T), constant[water]

    def weigh(motion: Array) -> Array:
        return np.concatenate([stiffness * motion[:shapes], gravity * (beside @ motion[shapes:])])

    def respond(motion: Array, weighed: Array) -> tuple[Array, Array]:
        """Momentum of motions without stiffness, and K⁻¹ of all others: Kη = gSη on the water, where it is Sψ."""
        load = rows @ motion[:shapes]
        load[water] += weighed[shapes:] / gravity
        potential = answer(load)
        momentum = inertia * motion[:shapes] + across @ potential
        return momentum[free], np.concatenate([flexibility * momentum, potential[water] / gravity])

    # Motions without stiffness follow the others, and so does the constant of ψ if they displace a volume; if there
    # are none, the volume is kept by projection.
    volume = np.concatenate([across @ constant, beside @ on_water])
    yielding = np.concatenate([flexibility * (across @ constant), on_water / gravity])
    follows = half != "odd" and len(free) > 0
    keeps = half != "odd" and not follows
    found = [respond(unit, np.zeros(len(volume))) for unit in np.eye(shapes, len(volume))[free]]
    corner: Array = np.array([momentum for momentum, _ in found]).reshape(len(free), len(free))
    responses = np.array([response for _, response in found] + [yielding] * follows)
    if follows:
        corner = np.block([[corner, volume[free, None]], [volume[free], 0.0]])
    followed = np.linalg.solve(corner, responses) if len(corner) else None

    def condensed(motion: Array, weighed: Array) -> Array:
        momentum, response = respond(motion, weighed)
        if followed is not None:
            response -= (np.append(momentum, volume @ motion) if follows else momentum) @ followed
        if keeps:
            response -= yielding * ((volume @ response) / (volume @ yielding))
        return response

    noise = np.random.default_rng(20).standard_normal(len(volume))
    noise[free] = 0.0
    return 1.0 / np.sqrt(_largest(condensed, weigh, noise, MODES // 2 + 2 if half else MODES))


def _largest(
    apply: Callable[[Array, Array], Array], weigh: Callable[[Array], Array], start: Array, count: int
) -> Array:
    """Return the largest eigenvalues of K⁻¹M by the Lanczos method in the metric of K, orthogonalized in full."""
    basis, weighed = np.empty((2, 400, len(start)))
    diagonal: list[float] = []
    beside: list[float] = []
    image = apply(start, weigh(start))
    for step in range(400):
        of_image = weigh(image)
        norm = np.sqrt(image @ of_image)
        if step > count + 6 and step % 3 == 0:
            values, vectors = eigh_tridiagonal(diagonal, beside)
            # Residual²/gap, the error of each; two more have to be near, or else one may not have appeared yet.
            gaps = np.abs(np.diff(values[::-1], append=0.0, prepend=np.inf))
            nearest = np.minimum(gaps[:-1], gaps[1:]) * values[::-1]
            errors = ((norm * vectors[-1, ::-1]) ** 2 / nearest)[: count + 2]
            if (errors[:count] < 1e-11).all() and (errors[count:] < 1e-3).all():
                return values[::-1][:count]
        if step:
            beside.append(norm)
        basis[step], weighed[step] = image / norm, of_image / norm
        image = apply(basis[step], weighed[step])
        for again in range(2):
            parts = weighed[: step + 1] @ image
            if not again:
                diagonal.append(parts[step])
            image -= parts @ basis[: step + 1]
    raise RuntimeError(f"{count} eigenvalues did not converge in 400 steps")
