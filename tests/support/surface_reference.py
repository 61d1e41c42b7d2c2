"""Reference frequencies of beams that float in a tank, good to about 1e-12, by a method of its own.

Galerkin's method on the top of the liquid alone, in units of the tank (L = ρ = g = 1; docs/theory_aquarium.md, § 0):

    K ζ = λ (M + N) ζ,   ∫ζ = 0.

η is a polynomial on each panel of the water, panels shrink geometrically towards the beams' ends; the deflection of a
beam is heave, pitch and bending polynomials whose second derivatives are orthonormal, so that its bending energy is a
unit matrix at any rigidity. N is exact (`surface_panels`). Two liquids under a rigid lid are the same problem in units
of Δρ = ρ₂ − ρ₁, with N = (ρ₂/Δρ) N(h₂) + (ρ₁/Δρ) N(h₁). Motions without restoring are condensed. Values are Ritz
values of the exact problem: they come from above, and converge exponentially.

Against the package: one dimension instead of two, dense instead of sparse, polynomials instead of dry modes; nothing
of it is imported.
"""

from __future__ import annotations

from dataclasses import astuple, dataclass, replace
from itertools import pairwise
from typing import Any, Literal

import numpy as np
from constrained_modes import ConstrainedProblem, lowest_modes
from scipy.linalg import block_diag, cholesky, eigh, solve_triangular
from scipy.optimize import brentq
from surface_panels import Panel, liquid_matrix

AT_THE_WALL = 1e-9
"""Ends nearer to a wall than this part of the tank lie at the wall, as scenes define it (docs/scenes.md)."""


KINDS = ("sloshing", "heave", "pitch", "elastic")
"""Groups of unknowns that may hold the potential energy of a mode (docs/conventions.md, `kind`)."""


@dataclass(frozen=True, kw_only=True)
class ReferenceBeam:
    """A beam in units of the tank: ends, EI/(ρgL⁴), m/(ρL), and whether ρgw restores it (1 or 0); Δρ for ρ if two."""

    start: float
    end: float
    rigidity: float
    mass: float
    restoring: float

    @property
    def length(self) -> float:
        """l/L."""
        return self.end - self.start


@dataclass(frozen=True, kw_only=True)
class ReferenceTank:
    """A tank in units of itself.

    Attributes:
        depth: H/L of the liquid under them.
        beams: from left to right.
        top: what lies beside them.
        upper: ρ₁/ρ₂ and h₁/L of a liquid above them, under a rigid lid.
    """

    depth: float
    beams: tuple[ReferenceBeam, ...]
    top: Literal["free", "rigid", "pressure_release"] = "free"
    upper: tuple[float, float] | None = None

    @property
    def layers(self) -> tuple[tuple[float, float], ...]:
        """Densities in the unit of density, and depths in L."""
        if self.upper is None:
            return ((1.0, self.depth),)
        ratio, depth = self.upper
        return ((1.0 / (1.0 - ratio), self.depth), (ratio / (1.0 - ratio), depth))

    @property
    def water(self) -> tuple[tuple[float, float], ...]:
        """Pieces of water that move."""
        ends = [0.0, *(end for beam in self.beams for end in (beam.start, beam.end)), 1.0]
        pieces = zip(ends[::2], ends[1::2], strict=True)
        return tuple((low, high) for low, high in pieces if high > low) if self.top != "rigid" else ()

    @property
    def mirror(self) -> bool:
        """Whether the tank is its own mirror image, to rounding."""
        mirrored = [replace(beam, start=1.0 - beam.end, end=1.0 - beam.start) for beam in reversed(self.beams)]
        pairs = zip(self.beams, mirrored, strict=True)
        return all(np.allclose(astuple(one), astuple(other), rtol=1e-12, atol=1e-15) for one, other in pairs)


@dataclass(frozen=True, kw_only=True)
class Fineness:
    """How finely the reference is resolved.

    Attributes:
        degree: of η on each panel.
        phase: largest k·h on a panel of half length h, k the shortest wave's wavenumber.
        ratio: of neighbouring panels towards a beam's end.
        smallest: the last panel there, in parts of the shortest length around; the error is about its cube.
        smallest_sharp: the same where ψ = 0 on the water; the error is about the panel itself.
        bending: degree of a beam's deflection without waves, layers and corners.
    """

    degree: int = 16
    phase: float = 2.0
    ratio: float = 0.2
    smallest: float = 1e-5
    smallest_sharp: float = 1e-14
    bending: int = 40

    def finer(self) -> Fineness:
        """To see how far the values move."""
        return Fineness(
            degree=self.degree + 4,
            phase=0.75 * self.phase,
            ratio=0.8 * self.ratio,
            smallest=0.1 * self.smallest,
            smallest_sharp=0.1 * self.smallest_sharp,
            bending=ceil(1.3 * self.bending),
        )


def ceil(value: float) -> int:
    """The next whole number."""
    return int(np.ceil(value))


@dataclass(frozen=True, kw_only=True)
class ReferenceModes:
    """The lowest modes, without those of zero frequency.

    Attributes:
        eigenvalues: λ in units g/L, ascending.
        participations: pₙ of every beam's first dry mode, shape (beams, modes) (docs/theory_aquarium.md, § 4).
        shares: of `KINDS` in the potential energy, shape (kinds, modes).
        size: number of unknowns.
    """

    eigenvalues: np.ndarray
    participations: np.ndarray
    shares: np.ndarray
    size: int


def reference_tank(scene: Any) -> ReferenceTank:
    """The dimensionless tank of a scene."""
    length, gravity, density = scene.tank.length, scene.tank.gravity, scene.liquid[0].density
    beams = []
    for beam in sorted(scene.body, key=lambda body: body.start):
        start, end = beam.start / length, (beam.start + beam.length) / length
        beams.append(
            ReferenceBeam(
                start=start if start > AT_THE_WALL else 0.0,
                end=end if end < 1.0 - AT_THE_WALL else 1.0,
                rigidity=beam.flexural_rigidity / (density * gravity * length**4),
                mass=beam.mass_per_length / (density * length),
                restoring=float(beam.hydrostatic),
            )
        )
    return ReferenceTank(depth=scene.liquid[0].depth / length, beams=tuple(beams), top=scene.tank.top)


def without_waves(tank: ReferenceTank) -> ReferenceTank:
    """The same tank with ψ = 0 on its water."""
    return replace(tank, top="pressure_release")


def reference_modes(
    tank: ReferenceTank,
    count: int,
    fineness: Fineness | None = None,
    *,
    parity: Literal["symmetric", "antisymmetric"] | None = None,
) -> ReferenceModes:
    """The lowest modes of a tank.

    Args:
        tank: the tank.
        count: how many.
        fineness: how finely it is resolved.
        parity: of the modes of a tank that is its own mirror image; both if left out.

    Returns:
        The modes.
    """
    fineness = fineness or Fineness()
    highest = _expected_highest(tank, count)
    while True:
        modes = _modes_below(tank, count, fineness, highest, parity)
        if modes.eigenvalues[-1] <= 1.2 * highest:
            return modes
        highest = modes.eigenvalues[-1]


def _expected_highest(tank: ReferenceTank, count: int) -> float:
    """About the λ below which there are ``count`` modes: waves of wavenumber k fit k s/π times in a length s."""

    def surplus(logarithm: float) -> float:
        value = np.exp(logarithm)
        waves = [
            0.0 if tank.top != "free" else layer_wavenumber(value, tank.layers) * (high - low)
            for low, high in tank.water
        ]
        waves += [beam_wavenumber(beam, value, tank.layers) * beam.length for beam in tank.beams]
        return float(sum(waves) / np.pi - count)

    return float(np.exp(brentq(surplus, np.log(1e-30), np.log(1e30), xtol=1e-2)))


def _modes_below(
    tank: ReferenceTank, count: int, fineness: Fineness, highest: float, parity: str | None
) -> ReferenceModes:
    """The modes, with panels and degrees that resolve waves up to λ = ``highest``."""
    water = [panel for piece in tank.water for panel in _water_panels(tank, piece, fineness, highest)]
    covers = [_beam_panel(tank, beam, fineness, highest) for beam in tank.beams]
    shapes = [_unit_shapes(beam, panel) for beam, panel in zip(tank.beams, covers, strict=True)]
    waves = sum(panel.size for panel in water)
    coordinates = block_diag(np.eye(waves), *shapes)
    bodies = list(zip(tank.beams, shapes, strict=True))
    legendre = np.concatenate([np.zeros(waves), *(np.full(len(shape), beam.mass) for beam, shape in bodies)])
    liquids = [density * liquid_matrix(water + covers, depth) for density, depth in tank.layers]
    mass = np.sum(liquids, axis=0) + np.diag(legendre)
    volume = np.concatenate([np.eye(1, panel.size)[0] * np.sqrt(2.0 * panel.half) for panel in water + covers])
    # Water without weight has no stiffness: it follows the beams like a rigid motion without restoring.
    rigid = np.concatenate(
        [np.full(waves, tank.top == "pressure_release"), *(_without_restoring(*body) for body in bodies)]
    )
    problem = ConstrainedProblem(mass=coordinates.T @ mass @ coordinates, volume=volume @ coordinates, free=rigid)
    if parity is None:
        eigenvalues, modes = lowest_modes(problem, count)
    else:
        sides = _halves(tank, water, shapes, 1.0 if parity == "symmetric" else -1.0)
        problem = problem.restricted(sides)
        if parity == "antisymmetric":
            # Antisymmetric motions displace nothing: what is left is rounding, and no constraint.
            problem = replace(problem, volume=np.zeros_like(problem.volume))
        eigenvalues, modes = lowest_modes(problem, count)
        modes = sides @ modes
    kinds = np.concatenate([np.zeros(waves, dtype=int), *(np.minimum(np.arange(len(s)), 2) + 1 for s in shapes)])
    return ReferenceModes(
        eigenvalues=eigenvalues,
        participations=(_first_dry_modes(tank, covers, waves) @ modes) ** 2,
        shares=np.array([(modes[kinds == kind] ** 2).sum(axis=0) for kind in range(len(KINDS))]),
        size=len(problem.mass),
    )


def layer_inertia(wavenumber: float, layers: tuple[tuple[float, float], ...]) -> float:
    """Σ ρ/(k tanh kh)."""
    return float(sum(density / (wavenumber * np.tanh(wavenumber * depth)) for density, depth in layers))


def layer_wavenumber(squared_frequency: float, layers: tuple[tuple[float, float], ...]) -> float:
    """k of 1 = λ Σ ρ/(k tanh kh)."""
    # tanh kh ≥ kh/(1 + kh): k is below the root of k = λ Σ ρ (1 + 1/kh).
    slope = squared_frequency * sum(density for density, _ in layers)
    high = slope + np.sqrt(squared_frequency * sum(density / depth for density, depth in layers))
    return float(brentq(lambda k: 1.0 / layer_inertia(k, layers) - squared_frequency, 1e-6 * high, 1.01 * high))


def beam_wavenumber(beam: ReferenceBeam, squared_frequency: float, layers: tuple[tuple[float, float], ...]) -> float:
    """k of EI k⁴ + s = λ (m + Σ ρ/(k tanh kh)); 0 if no wave is as slow."""

    def surplus(k: float) -> float:
        return float(beam.rigidity * k**4 + beam.restoring - squared_frequency * (beam.mass + layer_inertia(k, layers)))

    high, low = 1.0, 1e-6
    while surplus(high) < 0.0:
        high *= 2.0
    return 0.0 if surplus(low) > 0.0 else float(brentq(surplus, low, high))


def _water_panels(tank: ReferenceTank, piece: tuple[float, float], fineness: Fineness, highest: float) -> list[Panel]:
    """Panels of one piece of water, which shrink towards the ends where a beam begins."""
    low, high = piece
    length = high - low
    sharp = tank.top == "pressure_release"
    depth = min(depth for _, depth in tank.layers)
    # Nearer to a tip than the depth, the wave and the next tip, ψ is smooth but for r ln r; without waves, for r^{1/2}.
    reach = min(0.5 * length, depth) if sharp else min(0.5 * length, depth, 1.0 / highest)
    layers = [0.0, 0.5 * length]
    while layers[1] > (fineness.smallest_sharp if sharp else fineness.smallest) * reach:
        layers.insert(1, fineness.ratio * layers[1])
    largest = length if sharp else 2.0 * fineness.phase / layer_wavenumber(highest, tank.layers)
    panels = []
    for anchor, side in ((low, 1.0), (high, -1.0)):
        # Nothing happens where the water ends at a wall.
        cuts = [0.0, 0.5 * length] if anchor in (0.0, 1.0) else layers
        for first, last in pairwise(cuts):
            pieces = ceil((last - first) / largest)
            half = 0.5 * (last - first) / pieces
            panels += [
                Panel(
                    anchor=anchor,
                    offset=side * (first + (2 * number + 1) * half),
                    half=half,
                    degree=fineness.degree,
                )
                for number in range(pieces)
            ]
    return panels


def _beam_panel(tank: ReferenceTank, beam: ReferenceBeam, fineness: Fineness, highest: float) -> Panel:
    """One panel under a beam, of a degree that resolves its waves and the layers at its ends."""
    waves = beam_wavenumber(beam, highest, tank.layers) * beam.length
    # Layers of (EI/ρg)^{1/4} at the ends of a soft beam: a polynomial of degree n sees l/n² there.
    layers = (beam.restoring / beam.rigidity) ** 0.25 * beam.length
    degree = fineness.bending * (1.0 + 0.02 * waves) + 5.0 * np.sqrt(layers)
    half = 0.5 * beam.length
    return Panel(anchor=beam.start, offset=half, half=half, degree=ceil(degree))


def _bending_polynomials(panel: Panel) -> np.ndarray:
    """Polynomials whose second derivatives are the orthonormal φ₀, φ₁, …, and which are orthogonal to 1 and x.

    ∫∫Pₙ = ((Pₙ₊₂ − Pₙ)/(2n + 3) − (Pₙ − Pₙ₋₂)/(2n − 1))/(2n + 1), without P₀ and P₁, which are rigid motions.

    Returns:
        Their coefficients in the φⱼ of the panel, shape (size, size − 2).
    """
    shapes = np.zeros((panel.size, panel.size - 2))
    norms = panel.norms()
    for n in range(panel.size - 2):
        terms = {n + 2: 1.0 / (2 * n + 3), n: -1.0 / (2 * n + 3) - 1.0 / (2 * n - 1), n - 2: 1.0 / (2 * n - 1)}
        for j, factor in terms.items():
            if j >= 2:
                shapes[j, n] = panel.half**2 * norms[n] * factor / (2 * n + 1) / norms[j]
    return shapes


def _bending_root(beam: ReferenceBeam, bending: np.ndarray) -> np.ndarray:
    """The lower Cholesky factor of EI∫wᵢ''wⱼ'' + s∫wᵢwⱼ."""
    stiffness = beam.rigidity * np.eye(bending.shape[1]) + beam.restoring * bending.T @ bending
    return cholesky(stiffness, lower=True)


def _unit_shapes(beam: ReferenceBeam, panel: Panel) -> np.ndarray:
    """Heave, pitch and bending shapes of unit potential energy, shape (size, size); rigid ones have none for s = 0."""
    bending = _bending_polynomials(panel)
    scaled = solve_triangular(_bending_root(beam, bending), bending.T, lower=True).T
    return np.hstack([np.eye(panel.size, 2), scaled])


def _without_restoring(beam: ReferenceBeam, shapes: np.ndarray) -> np.ndarray:
    return (np.arange(shapes.shape[1]) < 2) & (beam.restoring == 0.0)


def _first_dry_modes(tank: ReferenceTank, covers: list[Panel], waves: int) -> np.ndarray:
    """The first dry mode of each beam in unit coordinates, of unit potential energy, shape (beams, unknowns).

    It is the bending polynomial with the largest ∫w² for its bending energy.
    """
    sizes = [panel.size for panel in covers]
    modes = np.zeros((len(covers), waves + sum(sizes)))
    first = waves
    for body, (beam, panel) in enumerate(zip(tank.beams, covers, strict=True)):
        bending = _bending_polynomials(panel)
        _, vectors = eigh(bending.T @ bending)
        unit = _bending_root(beam, bending).T @ vectors[:, -1]
        modes[body, first + 2 : first + panel.size] = unit / np.linalg.norm(unit)
        first += panel.size
    return modes


def _halves(tank: ReferenceTank, water: list[Panel], shapes: list[np.ndarray], sign: float) -> np.ndarray:
    """Basis of the symmetric or antisymmetric ζ of a tank that is its own mirror image."""
    if not tank.mirror:
        raise ValueError("only a tank that is its own mirror image has symmetric and antisymmetric modes")
    sizes = [panel.size for panel in water] + [shape.shape[1] for shape in shapes]
    starts = np.concatenate([[0], np.cumsum(sizes)])
    centres = np.array([panel.anchor + panel.offset for panel in water])
    partners = [int(np.argmin(np.abs(1.0 - centres - centre))) for centre in centres]
    partners += [len(water) + body for body in range(len(shapes))][::-1]
    columns = []
    for block, partner in enumerate(partners):
        if partner < block:
            continue
        for number in range(sizes[block]):
            # Legendre polynomials, and the shapes made of them, are even and odd in turn.
            mirrored = sign * (-1.0) ** number
            column = np.zeros(starts[-1])
            column[starts[block] + number] = 1.0
            column[starts[partner] + number] += mirrored
            if np.linalg.norm(column) > 0.0:
                columns.append(column / np.linalg.norm(column))
    return np.array(columns).T
