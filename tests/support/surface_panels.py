"""The liquid under a piecewise polynomial surface, exactly: ∫∫ φᵢ(x) N(x, x') φⱼ(x') dx dx' on panels.

N maps the normal displacement of the top of a rectangular tank to the displacement potential there, in units of the
tank's length (docs/theory_aquarium.md, § 0):

    N(x, x') = −(1/π) ln|2 (cos πx − cos πx')| + 2 Σ_{n≥1} (coth nπH − 1)/(nπ) · cos nπx cos nπx'.

The logarithm is the sum of ln|x − x'|, its two images ln(x + x') and ln(2 − x − x') in the walls, and a remainder that
is analytic in the whole tank. Far pairs of panels and the remainder are integrated by Gauss's rule. For near pairs the
inner integral is closed, with the Legendre functions of the second kind,

    ∫₋₁¹ Pⱼ(ζ) ln|ξ − ζ| dζ = 2/(2j + 1) · (Qⱼ₊₁(ξ) − Qⱼ₋₁(ξ)),   j ≥ 1,

and the outer one is made with a double exponential rule, which takes the singularities at both of its ends. The series
needs the moments of Legendre polynomials against cosines, which are spherical Bessel functions. Nothing here is shared
with the package: no mesh, no quadrature, no kernel.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.polynomial.legendre import leggauss
from scipy.special import spherical_jn

EXTRA_NODES = 14
"""Gauss nodes beyond the degree: with `NEAR` they integrate far pairs to 2.2^(−27 − degree), rounding."""

NEAR = 0.35
"""Panels are near if the distance between them is less than this many half lengths of the larger one."""

TERMS_AT_ONCE = 4000
"""Terms of the depth series that are held at once."""

SERIES_EXPONENT = 38.0
"""Terms of the depth series are e^{−2nπH}: kept down to e^{−38} = 3e−17."""


IMAGES = ((0.0, 1.0), (0.0, -1.0), (2.0, -1.0))
"""Origin and sign of x' and of its images −x' and 2 − x' in the walls."""


@dataclass(frozen=True, kw_only=True)
class Panel:
    """A piece of the top with the orthonormal Legendre polynomials φⱼ = √((2j + 1)/(2h)) Pⱼ((x − c)/h).

    Attributes:
        anchor: a place that neighbouring panels share, a wall or an end of a beam, in tank lengths.
        offset: c from there; distances near a beam's end would cancel if c were one number.
        half: h, half of its length.
        degree: the largest j.
    """

    anchor: float
    offset: float
    half: float
    degree: int

    @property
    def size(self) -> int:
        """How many polynomials."""
        return self.degree + 1

    def norms(self) -> np.ndarray:
        """√((2j + 1)/(2h))."""
        return np.sqrt((2.0 * np.arange(self.size) + 1.0) / (2.0 * self.half))


def liquid_matrix(panels: list[Panel], depth: float) -> np.ndarray:
    """∫∫ φᵢ N φⱼ over all panels.

    Args:
        panels: pieces of 0 < x < 1 that do not overlap; where none lies nothing moves.
        depth: H in tank lengths.

    Returns:
        The symmetric matrix, shape (n, n), n the sum of the panels' sizes.
    """
    matrix = -(_logarithms(panels) + _remainder(panels)) / np.pi + _depth_series(panels, depth)
    return (matrix + matrix.T) / 2.0


def legendre_table(degree: int, points: np.ndarray) -> np.ndarray:
    """Pⱼ at some points, shape (degree + 1, points)."""
    table = np.empty((degree + 1, *points.shape))
    table[0] = 1.0
    if degree:
        table[1] = points
    for j in range(1, degree):
        table[j + 1] = ((2 * j + 1) * points * table[j] - j * table[j - 1]) / (j + 1)
    return table


def logarithmic_potentials(degree: int, points: np.ndarray) -> np.ndarray:
    """∫₋₁¹ Pⱼ(ζ) ln|ξ − ζ| dζ for all j up to a degree, at any real ξ, shape (degree + 1, points)."""
    away = np.abs(points)
    second = _legendre_second_kind(degree + 1, away)
    j = np.arange(1, degree + 1)[:, None]
    # ξ ln ξ → 0 at an end.
    beyond, within = 1.0 + away, np.maximum(np.abs(1.0 - away), 1e-300)
    constant = beyond * np.log(beyond) + (1.0 - away) * np.log(within) - 2.0
    values = np.concatenate([constant[None], 2.0 / (2.0 * j + 1.0) * (second[2:] - second[:-2])])
    values[1::2] *= np.where(points < 0.0, -1.0, 1.0)
    return values


def _legendre_second_kind(degree: int, points: np.ndarray) -> np.ndarray:
    """Qⱼ(ξ), ξ ≥ 0, on and off the cut."""
    distance = np.maximum(np.abs(points - 1.0), 1e-18)
    first = 0.5 * np.log((points + 1.0) / distance)
    table = np.empty((degree + 1, len(points)))
    growth = np.arccosh(np.maximum(points, 1.0))
    # For ξ > 1 the recurrence multiplies rounding by e^{j·growth} upward, and downward forgets its start like
    # e^{−2j·growth}.
    upward = growth * degree < 1.0
    _recur_upward(table, points, first, upward)
    remaining = ~upward
    limit = 1e-3
    while remaining.any():
        chosen = remaining & (growth < limit)
        if chosen.any():
            start = degree + int(np.ceil(20.0 / growth[chosen].min())) + 2
            table[:, chosen] = _downward(degree, start, points[chosen], first[chosen])
        remaining &= ~chosen
        limit *= 2.0
    return table


def _recur_upward(table: np.ndarray, points: np.ndarray, first: np.ndarray, chosen: np.ndarray) -> None:
    x = points[chosen]
    before, now = first[chosen], x * first[chosen] - 1.0
    table[0, chosen] = before
    for j in range(1, len(table)):
        table[j, chosen] = now
        before, now = now, ((2 * j + 1) * x * now - j * before) / (j + 1)


def _downward(degree: int, start: int, points: np.ndarray, first: np.ndarray) -> np.ndarray:
    ratio = np.zeros_like(points)  # Q_{j+1}/Q_j
    ratios = np.empty((degree + 1, len(points)))
    for j in range(start, 0, -1):
        # (2j + 1) ξ Q_j = (j + 1) Q_{j+1} + j Q_{j−1}
        ratio = j / ((2 * j + 1) * points - (j + 1) * ratio)
        if j <= degree:
            ratios[j] = ratio
    ratios[0] = first
    return np.cumprod(ratios, axis=0)


def _double_exponential(degree: int) -> tuple[np.ndarray, np.ndarray]:
    """Nodes and weights on [−1, 1] for polynomials times t ln t at both ends."""
    step = 1.0 / (8.0 + 0.5 * degree)
    t = np.arange(-int(3.4 / step), int(3.4 / step) + 1) * step
    inner = 0.5 * np.pi * np.sinh(t)
    return np.tanh(inner), step * 0.5 * np.pi * np.cosh(t) / np.cosh(inner) ** 2


def _offsets(panels: list[Panel]) -> np.ndarray:
    return np.concatenate([[0], np.cumsum([panel.size for panel in panels])])


@dataclass(frozen=True, kw_only=True)
class _Points:
    """Places on the top as anchors and offsets."""

    anchor: np.ndarray
    offset: np.ndarray

    def minus(self, other: _Points, mirror: tuple[float, float]) -> np.ndarray:
        """x − (origin + sign·x') for all pairs."""
        origin, sign = mirror
        anchors = self.anchor[:, None] - (origin + sign * other.anchor[None, :])
        return anchors + (self.offset[:, None] - sign * other.offset[None, :])


def _gauss(panel: Panel) -> tuple[np.ndarray, np.ndarray]:
    """Offsets of Gauss's nodes of a panel, and weighted polynomials there, shape (size, nodes)."""
    nodes, weights = leggauss(panel.size + EXTRA_NODES)
    return panel.offset + panel.half * nodes, (
        panel.norms()[:, None] * legendre_table(panel.degree, nodes) * (panel.half * weights)
    )


def _all_gauss(panels: list[Panel]) -> tuple[_Points, list[np.ndarray]]:
    offsets, loads = zip(*(_gauss(panel) for panel in panels), strict=True)
    anchors = [np.full(len(offset), panel.anchor) for panel, offset in zip(panels, offsets, strict=True)]
    return _Points(anchor=np.concatenate(anchors), offset=np.concatenate(offsets)), list(loads)


def _sandwich(panels: list[Panel], loads: list[np.ndarray], kernel: np.ndarray) -> np.ndarray:
    """Loads on both sides of a kernel at the Gauss nodes."""
    offsets = _offsets(panels)
    nodes = np.concatenate([[0], np.cumsum([load.shape[1] for load in loads])])
    half = np.empty((offsets[-1], kernel.shape[1]))
    result = np.empty((offsets[-1], offsets[-1]))
    for a, load in enumerate(loads):
        half[offsets[a] : offsets[a + 1]] = load @ kernel[nodes[a] : nodes[a + 1]]
    for b, load in enumerate(loads):
        result[:, offsets[b] : offsets[b + 1]] = half[:, nodes[b] : nodes[b + 1]] @ load.T
    return result


def _remainder(panels: list[Panel]) -> np.ndarray:
    """ln|2 sin(πu/2)/u| + ln(2 sin(πv/2)/(v(2 − v))), u = x − x', v = x + x': analytic."""
    points, loads = _all_gauss(panels)
    total = points.minus(points, IMAGES[1])
    near = np.minimum(total, 2.0 - total)
    kernel = np.log(np.pi * np.sinc(points.minus(points, IMAGES[0]) / 2.0))
    kernel += np.log(np.pi * np.sinc(near / 2.0) / (2.0 - near))
    return _sandwich(panels, loads, kernel)


def _logarithms(panels: list[Panel]) -> np.ndarray:
    """ln|x − x'| + ln(x + x') + ln(2 − x − x')."""
    offsets = _offsets(panels)
    points, loads = _all_gauss(panels)
    centres = _Points(
        anchor=np.array([panel.anchor for panel in panels]), offset=np.array([panel.offset for panel in panels])
    )
    halves = np.array([panel.half for panel in panels])
    result = np.zeros((offsets[-1], offsets[-1]))
    for mirror in IMAGES:
        distance = np.abs(points.minus(points, mirror))
        # Where a point is its own image, its panel is near itself, and replaced below.
        part = _sandwich(panels, loads, np.log(np.where(distance > 0.0, distance, 1.0)))
        gap = np.abs(centres.minus(centres, mirror)) - halves[:, None] - halves[None, :]
        near = gap < NEAR * np.maximum(halves[:, None], halves[None, :])
        for inner, panel in enumerate(panels):
            # Outside, the smaller panel: the closed potential of the larger is smooth on its scale but at its ends.
            outside = [a for a in np.flatnonzero(near[:, inner]) if (halves[a], a) <= (halves[inner], inner)]
            for rows, block in zip(outside, _near_blocks([panels[a] for a in outside], panel, mirror), strict=True):
                place = slice(offsets[rows], offsets[rows + 1]), slice(offsets[inner], offsets[inner + 1])
                part[place] = block
                part[place[::-1]] = block.T
        result += part
    return result


def _near_blocks(outside: list[Panel], panel: Panel, mirror: tuple[float, float]) -> list[np.ndarray]:
    """∫∫ φᵢ ln|x − (origin + sign·x')| φⱼ' of one panel, inside, with some others."""
    if not outside:
        return []
    origin, sign = mirror
    rules = [_double_exponential(outer.degree + panel.degree) for outer in outside]
    distances = [
        (outer.anchor - (origin + sign * panel.anchor)) + (outer.offset - sign * panel.offset) + outer.half * nodes
        for outer, (nodes, _) in zip(outside, rules, strict=True)
    ]
    # The image of a panel is its polynomials on the mirrored place: measured from there, odd ones change sign.
    potential = logarithmic_potentials(panel.degree, sign * np.concatenate(distances) / panel.half)
    potential[0] += 2.0 * np.log(panel.half)
    potential *= (panel.half * panel.norms())[:, None]
    parts = np.split(potential, np.cumsum([len(distance) for distance in distances])[:-1], axis=1)
    return [
        (outer.norms()[:, None] * legendre_table(outer.degree, nodes) * (outer.half * weights)) @ part.T
        for outer, (nodes, weights), part in zip(outside, rules, parts, strict=True)
    ]


def _depth_series(panels: list[Panel], depth: float) -> np.ndarray:
    """2 Σ (coth nπH − 1)/(nπ) ⟨cos nπx, φᵢ⟩⟨cos nπx, φⱼ⟩."""
    size = _offsets(panels)[-1]
    result = np.zeros((size, size))
    count = int(np.ceil(SERIES_EXPONENT / (2.0 * np.pi * depth))) + 1
    for first in range(1, count + 1, TERMS_AT_ONCE):
        wavenumbers = np.pi * np.arange(first, min(first + TERMS_AT_ONCE, count + 1))
        factors = 4.0 / np.expm1(np.minimum(2.0 * wavenumbers * depth, 700.0)) / wavenumbers
        moments = np.concatenate([_cosine_moments(panel, wavenumbers) for panel in panels])
        result += (moments * factors) @ moments.T
    return result


def _cosine_moments(panel: Panel, wavenumbers: np.ndarray) -> np.ndarray:
    """∫ φⱼ cos kx dx = h √((2j + 1)/(2h)) · 2 Re(iʲ e^{ikc}) jⱼ(kh), shape (size, wavenumbers)."""
    moments = np.empty((panel.size, len(wavenumbers)))
    # Gauss's rule of degree 2 (size + EXTRA_NODES) − 1 is exact to rounding up to here, and cheaper.
    slow = wavenumbers * panel.half < 0.5 * EXTRA_NODES
    offsets, loads = _gauss(panel)
    moments[:, slow] = loads @ np.cos(np.outer(panel.anchor + offsets, wavenumbers[slow]))
    fast = wavenumbers[~slow]
    phase = fast * (panel.anchor + panel.offset)
    turned = (np.cos(phase), -np.sin(phase), -np.cos(phase), np.sin(phase))
    for j, norm in enumerate(panel.norms()):
        moments[j, ~slow] = 2.0 * panel.half * norm * turned[j % 4] * spherical_jn(j, fast * panel.half)
    return moments
