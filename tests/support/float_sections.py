"""Sections of rigid floats as smooth arcs, cut at the still level, with their hydrostatics; SI units, NumPy alone.

A section is a closed chain of arcs, counterclockwise, in tank coordinates z = x + iy with y = 0 at the still level.
Points are extended-precision numbers, so that distances near corners keep their digits. Heights of an arc are
monotone, so that the still level cuts it once.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np
from scipy.optimize import brentq

Curve = Callable[[np.ndarray], np.ndarray]

MOTIONS = ("heave", "sway", "roll")

GAUSS = tuple(array.astype(np.longdouble) for array in np.polynomial.legendre.leggauss(40))


@dataclass(frozen=True, kw_only=True)
class Arc:
    """z(t) and dz/dt on 0 ≤ t ≤ 1, analytic."""

    point: Curve
    slope: Curve

    def part(self, start: float, end: float) -> Arc:
        """The piece start ≤ t ≤ end."""
        first, length = np.longdouble(start), np.longdouble(end) - np.longdouble(start)
        return Arc(
            point=lambda t: self.point(first + length * t), slope=lambda t: length * self.slope(first + length * t)
        )

    def moved(self, by: complex) -> Arc:
        """The same arc elsewhere."""
        return replace(self, point=lambda t: self.point(t) + np.clongdouble(by))

    def at(self, t: float) -> complex:
        """One point of it."""
        return self.point(np.array([t], dtype=np.longdouble))[0]

    def direction(self, t: float) -> complex:
        """The unit tangent."""
        slope = self.slope(np.array([t], dtype=np.longdouble))[0]
        return slope / abs(slope)


def line(start: complex, end: complex) -> Arc:
    """A straight piece."""
    first, step = np.clongdouble(start), np.clongdouble(end) - np.clongdouble(start)
    return Arc(point=lambda t: first + step * t, slope=lambda t: step + 0 * t)


def _ellipse_quarter(width: float, height: float, quarter: int) -> Arc:
    turn = np.longdouble(np.pi) / 2 + np.longdouble(6.123233995736766035868820147292e-17)
    a, b = np.longdouble(width), np.longdouble(height)
    # x and y of quarter q are those of quarter 0, turned, so that both are exact at its ends.
    signs = ((1, 0), (0, 1), (-1, 0), (0, -1))
    (cx, sx) = signs[quarter]

    def point(t: np.ndarray) -> np.ndarray:
        cosine, sine = np.cos(turn * t), np.sin(turn * t)
        cosine = np.where(t == 1, 0, cosine)
        return a * (cx * cosine - sx * sine) + 1j * b * (sx * cosine + cx * sine)

    def slope(t: np.ndarray) -> np.ndarray:
        cosine, sine = np.cos(turn * t), np.sin(turn * t)
        return turn * (-a * (cx * sine + sx * cosine) + 1j * b * (-sx * sine + cx * cosine))

    return Arc(point=point, slope=slope)


def _parabola_half(width: float, height: float, side: int) -> Arc:
    a, b = np.longdouble(width), np.longdouble(height)

    def point(t: np.ndarray) -> np.ndarray:
        # ω = l (1 − y²/h²), y = ∓h … ±h
        return side * (a * 4 * t * (1 - t) + 1j * b * (2 * t - 1))

    def slope(t: np.ndarray) -> np.ndarray:
        return side * (a * 4 * (1 - 2 * t) + 2j * b)

    return Arc(point=point, slope=slope)


def contour(shape: dict[str, Any]) -> list[Arc]:
    """The arcs of a section in its own frame, from the keys of a scene (shape, half_width, half_height, vertices)."""
    kind = shape["shape"]
    if kind == "polygon":
        corners = [complex(*vertex) for vertex in shape["vertices"]]
        return [line(*side) for side in pairwise([*corners, corners[0]])]
    width, height = shape["half_width"], shape["half_height"]
    if kind == "ellipse":
        return [_ellipse_quarter(width, height, quarter) for quarter in range(4)]
    if kind == "parabola":
        return [_parabola_half(width, height, side) for side in (1, -1)]
    if kind == "wedge":
        corners = [-1j * height, complex(width), 1j * height, complex(-width)]
    elif kind == "rectangle":
        corners = [complex(width * i, height * j) for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    else:
        raise ValueError(f"no such shape: {kind}")
    return [line(*side) for side in pairwise([*corners, corners[0]])]


def _integral(arcs: list[Arc], values: Callable[[np.ndarray, np.ndarray], np.ndarray]) -> float:
    nodes, weights = (GAUSS[0] + 1) / 2, GAUSS[1] / 2
    return float(sum((weights * values(arc.point(nodes), arc.slope(nodes))).sum() for arc in arcs))


def inner_curve(shape: dict[str, Any], count: int) -> np.ndarray:
    """Points inside a section: around the foci of an ellipse, between the tips of a parabola, half-way to corners."""
    steps = (np.arange(count) + 0.5) / count
    if shape["shape"] == "ellipse":
        return _inside_ellipse(shape["half_width"], shape["half_height"], count)
    if shape["shape"] == "parabola":
        return 1j * shape["half_height"] * 0.9 * (2 * steps - 1)
    arcs = contour(shape)
    ring = np.array([arcs[int(place)].at(place - int(place)) for place in steps * len(arcs)])
    return ring.mean() + (ring - ring.mean()) / 2


def _inside_ellipse(width: float, height: float, count: int) -> np.ndarray:
    """A confocal ellipse half-way to the segment between the foci, or a circle of half the radius."""
    focus = np.sqrt(abs(width**2 - height**2))
    angles = 2 * np.pi * (np.arange(count) + 0.5) / count
    if focus < 0.3 * max(width, height):
        return 0.5 * (width * np.cos(angles) + 1j * height * np.sin(angles))
    depth = np.arccosh(max(width, height) / focus) / 2
    # Of n poles e^{−n·depth} is left, of those on the circle 2⁻ⁿ.
    more = int(np.ceil(count * max(1.0, np.log(2.0) / depth)))
    angles = 2 * np.pi * (np.arange(more) + 0.5) / more
    longer, shorter = focus * np.cosh(depth), focus * np.sinh(depth)
    axes = (longer, shorter) if width > height else (shorter, longer)
    return axes[0] * np.cos(angles) + 1j * axes[1] * np.sin(angles)


@dataclass(frozen=True, kw_only=True)
class Area:
    """Area, ∫x, ∫y and the polar ∫(x² + y²) of what a closed chain of arcs encloses."""

    area: float
    x: float
    y: float
    polar: float


def enclosed(arcs: list[Arc]) -> Area:
    """Green's theorem on a closed chain."""
    return Area(
        area=_integral(arcs, lambda z, s: z.real * s.imag),
        x=_integral(arcs, lambda z, s: z.real**2 / 2 * s.imag),
        y=_integral(arcs, lambda z, s: -(z.imag**2) / 2 * s.real),
        polar=_integral(arcs, lambda z, s: z.real**3 / 3 * s.imag - z.imag**3 / 3 * s.real),
    )


def cut(arcs: list[Arc], level: float) -> tuple[list[Arc], list[Arc]]:
    """The arcs below the height y = ``level``, from its left to its right end, and above, from right to left."""
    below: list[Arc] = []
    above: list[Arc] = []
    pieces: list[tuple[bool, Arc]] = []
    for arc in arcs:
        low, high = arc.at(0.0).imag - level, arc.at(1.0).imag - level
        if low * high < 0:
            place = _crossing(arc, level)
            pieces += [(low < 0, arc.part(0.0, place)), (high < 0, arc.part(place, 1.0))]
        else:
            pieces.append((low + high < 0, arc))
    start = next(i for i, piece in enumerate(pieces) if piece[0] and not pieces[i - 1][0])
    for is_below, arc in pieces[start:] + pieces[:start]:
        (below if is_below else above).append(arc)
    return below, above


def _crossing(arc: Arc, level: float) -> np.longdouble:
    place = np.longdouble(brentq(lambda t: float(arc.at(t).imag - level), 0.0, 1.0, xtol=1e-15))
    for _ in range(3):
        slope = arc.slope(np.array([place]))[0].imag
        place -= (arc.at(place).imag - level) / slope
    return place


@dataclass(frozen=True, kw_only=True)
class Section:
    """A float at rest in equilibrium.

    Attributes:
        below: its arcs in the lower liquid, from the left to the right end of its waterplane, y ≤ 0.
        above: the others, from right to left.
        mass: kg/m.
        inertia: about the centre of mass, kg m²/m.
        centre: of mass, x + iy, m.
        stiffness: of heave, sway and roll, shape (3, 3), N/m² and so on.
        thin: whether the liquids reach to its axis, a slit.
        flux: ±ω' there of unit heave, out of the liquid.
        inner: points on a curve inside, as many as asked for; beyond it potentials may be continued into the section.
    """

    below: list[Arc]
    above: list[Arc]
    mass: float
    inertia: float
    centre: complex
    stiffness: np.ndarray
    thin: bool
    flux: Callable[[np.ndarray], np.ndarray]
    inner: Callable[[int], np.ndarray]

    @property
    def ends(self) -> tuple[float, float]:
        """x of the ends of the waterplane."""
        return self.below[0].at(0.0).real, self.below[-1].at(1.0).real

    @property
    def size(self) -> float:
        """Its largest extent, about."""
        places = np.array([arc.at(t) for arc in self.below + self.above for t in (0.0, 0.5)])
        return float(max(np.ptp(places.real), np.ptp(places.imag)))


def closed(arcs: list[Arc]) -> list[Arc]:
    """A chain with the straight piece that closes it."""
    return [*arcs, line(arcs[-1].at(1.0), arcs[0].at(0.0))]


def section(shape: dict[str, Any], densities: tuple[float, float], gravity: float) -> Section:
    """The float of a scene's keys between liquids of two densities, lower first; 0 for air."""
    own = contour(shape)
    lower, upper = densities
    whole = enclosed(own)

    def weight(level: float) -> float:
        below, above = cut(own, level)
        return lower * enclosed(closed(below)).area + upper * enclosed(closed(above)).area

    level = 0.0
    if "mass" in shape:
        heights = [arc.at(t).imag for arc in own for t in (0.0, 1.0)]
        low, high = float(min(heights)), float(max(heights))
        edge = 1e-9 * (high - low)
        level = brentq(lambda y: weight(y) - shape["mass"], low + edge, high - edge, xtol=1e-16, rtol=1e-15)
    mass = weight(level)
    places = [arc.moved(shape["position"] - 1j * level) for arc in own]
    below, above = cut(places, 0.0)
    parts = [(lower, enclosed(closed(below))), (upper, enclosed(closed(above)))]
    moment_x = sum(density * part.x for density, part in parts)
    moment_y = sum(density * part.y for density, part in parts)
    height = shape.get("centre_of_mass", whole.y / whole.area) - level
    centre = complex(moment_x / mass, height)
    gyration = shape.get("radius_of_gyration")
    if gyration is None:
        polar = whole.polar / whole.area - (whole.x**2 + whole.y**2) / whole.area**2
        gyration = np.sqrt(polar)
    left, right = (float(end) - centre.real for end in (below[0].at(0.0).real, below[-1].at(1.0).real))
    weighed = (lower - upper) * gravity
    heave, coupling, second = (weighed * (right**n - left**n) / n for n in (1, 2, 3))
    roll = second + gravity * (moment_y - mass * centre.imag)
    return Section(
        below=below,
        above=above,
        mass=mass,
        inertia=mass * gyration**2,
        centre=centre,
        thin=False,
        flux=lambda z: np.zeros(len(z)),
        inner=lambda count: inner_curve(shape, count) + np.clongdouble(shape["position"] - 1j * level),
        stiffness=np.array([[heave, 0.0, coupling], [0.0, 0.0, 0.0], [coupling, 0.0, roll]]),
    )


def thin_section(shape: dict[str, Any], densities: tuple[float, float], gravity: float) -> Section:
    """The same float with its boundary laid on its axis: slits with the fluxes ±ω'(y); it heaves only."""
    thick = section(shape, densities, gravity)
    axis, height = np.longdouble(shape["position"]), np.longdouble(shape["half_height"])
    top, tip, level = axis + 1j * height, axis - 1j * height, axis + 0j * height
    return replace(
        thick,
        below=[line(level, tip), line(tip, level)],
        above=[line(level, top), line(top, level)],
        thin=True,
        # What is raised narrows below the level and widens above it.
        flux=lambda z: profile_slope(shape, z.imag).astype(float),
        inner=lambda count: np.zeros(0),
    )


def profile_slope(shape: dict[str, Any], y: np.ndarray) -> np.ndarray:
    """ω'(y) of a symmetric section."""
    width, height = shape["half_width"], shape["half_height"]
    if shape["shape"] == "parabola":
        return -2 * width * y / height**2
    if shape["shape"] == "wedge":
        return -np.sign(y) * width / height
    raise ValueError(f"no thin section of this shape: {shape['shape']}")
