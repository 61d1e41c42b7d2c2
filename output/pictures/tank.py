"""One natural mode drawn into axes: potential, displacement vectors, displaced surfaces, walls."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cache, lru_cache
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PathCollection, PolyCollection
from matplotlib.colors import to_rgba_array
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.path import Path
from matplotlib.patheffects import withStroke
from matplotlib.transforms import IdentityTransform
from matplotlib.tri import Triangulation
from numpy.typing import ArrayLike

from hydroelastic.fem.pictures.mode import Array, FloatSection, ModePicture, SurfaceCurve
from hydroelastic.output.pictures.colours import (
    BODY,
    BODY_EDGE,
    FREE_SURFACE,
    GREY,
    INK,
    INTERFACE,
    LOWER_WASH,
    UPPER_WASH,
    mode_colours,
)
from hydroelastic.output.pictures.floats import up_to_floats
from hydroelastic.output.pictures.page import POINT, FieldImage, arrow_key, round_ticks
from hydroelastic.output.pictures.raster import Raster, Same
from hydroelastic.output.pictures.view import View, colour_limit

WALL = 5.0
"""Width of a wall, in pixels of a page."""
SPACING = 44.0
"""From vector to vector, the same."""

_WALL, _ISO_LINE, _ARROW, _RESTING = "#3c3c3c", "#6e6a72", "#26262b", "#f6e6d8"
_KINDS = {"free surface": "free_surface", "interface": "interface", "floating body": "body"}
_LINES, _VECTORS = "lines of equal", "displacement ∇ψ"
_DASHES, _DOTS = (9.0, 6.0), (3.0, 6.0)


def draw_tank(
    axes: Axes,
    picture: ModePicture,
    view: View,
    *,
    largest: ModePicture | None = None,
    vectors: bool = True,
    thin: float = 1.0,
) -> None:
    """Draw a mode without axes and legend."""
    low, bottom, top, high = view.drawn(
        np.array([-view.depth, -view.depth, view.upper_depth, view.upper_depth + view.headroom])
    )
    axes.set_axis_off()
    axes.set_xlim(0.0, view.length)
    axes.set_ylim(low, high)
    # Metres of a pixel of the page to which sizes refer.
    pixel = thin * POINT * view.length / (axes.bbox.width * 72.0 / axes.figure.dpi)
    limit = colour_limit(largest or picture)
    # Whole pixels, up to walls and surfaces; rounding errors do not make another one.
    lower, upper = axes.bbox.get_points().round(6)
    (left, base), (right, ceiling) = np.floor(lower).astype(int), np.ceil(upper).astype(int)
    raster = _raster(
        Same(picture.points), Same(picture.triangles), replace(view, surface_scale=0.0),
        (int(right - left), int(ceiling - base)),
    )  # fmt: skip
    axes.add_artist(FieldImage(raster.coloured(picture.drawn_field, limit, mode_colours()), int(left), int(base)))
    axes.patch.set_visible(False)
    iso_lines = _iso_lines(Same(picture), view, limit)
    axes.add_collection(
        PathCollection(
            iso_lines, facecolors="none", edgecolors=_ISO_LINE, linewidths=1.1 * POINT * thin, zorder=1.0
        ),
        autolim=False,
    )  # fmt: skip
    if vectors:
        columns, rows = (max(round(side / (SPACING * pixel)), 2) for side in (view.length, top - bottom))
        x, y = (
            view.length * (np.arange(columns) + 0.5) / columns,
            bottom + (top - bottom) * (np.arange(rows) + 0.5) / rows,
        )
        _draw_vectors(axes, raster, picture, largest, x, y, SPACING * pixel, view)
    surfaces = tuple(up_to_floats(curve, picture.floats, view) for curve in picture.surfaces)
    _draw_wash(axes, picture, surfaces, view)
    for section in picture.floats:
        _draw_resting(axes, section, view, thin)
    _draw_walls(axes, picture, view, pixel, thin)
    # Surfaces of liquids first: a body's ends cover theirs.
    for curve in sorted(surfaces, key=lambda curve: curve.kind == "body"):
        axes.add_artist(_surface(curve.kind, curve.x, view.heights(curve, curve.displacement), thin))
    for section in picture.floats:
        opacity = 1.0 if section.slit is None else 0.45
        moved = view.displaced(section)
        _fill(axes, [moved], 2.0, facecolors=(BODY, opacity), edgecolors=BODY_EDGE, linewidths=3.5 * POINT * thin)
        resting = np.column_stack([section.contour[:, 0], view.drawn(section.contour[:, 1])])
        _stroke(axes, ([[*resting, resting[0]]], 1.6 * thin, INK, _DASHES))


def erase_tank(axes: Axes) -> None:
    """Make room for the next mode: other axes would take longer than what is drawn into them."""
    for artist in (*axes.collections, *axes.lines, *axes.artists):
        artist.remove()


def key_names(pictures: Sequence[ModePicture], field: str, *, vectors: bool) -> tuple[str, ...]:
    """Names of what is present."""
    floats = any(picture.floats for picture in pictures)
    kinds = {curve.kind for picture in pictures for curve in picture.surfaces} | ({"body"} if floats else set())
    # A float at rest is dashed like the still levels.
    still = "still level, float at rest" if floats else "still level"
    moving = [name for name, kind in _KINDS.items() if kind in kinds]
    return (*moving, still, f"{_LINES} {field}", *([_VECTORS] if vectors else []))


def keys(names: Sequence[str]) -> list[Artist]:
    """Keys of what is present, by its names."""
    return [_key(name) for name in names]


def _key(name: str) -> Line2D:
    if name in _KINDS:
        return _surface(_KINDS[name], [], [], 1.0, label=name)
    if name == _VECTORS:
        return arrow_key(_ARROW, name)
    if name.startswith(_LINES):
        return Line2D([], [], color=_ISO_LINE, lw=1.6 * POINT, label=name)
    return Line2D([], [], color=INK, lw=1.6 * POINT, linestyle=_dashed(_DASHES, 1.6), label=name)


def drawn_vectors(vectors: Array, spacing: float, lengths: Array | None = None) -> Array:
    """Vectors of shape (vectors, 2) scaled to the spacing of their grid, with an upper limit of the length.

    ∇ψ grows without bound towards the tips of a body: the 90 % quantile of the lengths gets nearly the spacing, and
    longer vectors are shortened to it. The lengths are those of the vectors, or of what they are an instant of.
    """
    length = np.hypot(*vectors.T) if lengths is None else lengths
    if not length.any():
        return np.zeros_like(vectors)
    reference = np.quantile(length, 0.9) or length.max()
    return 0.95 * spacing * vectors / np.maximum(length, reference)[:, None]


def iso_levels(limit: float) -> Array:
    """Round levels of ψ between −limit and limit, six to twelve on each side.

    The level 0 is a hair above it: on the mirror plane of an antisymmetric mode ψ is 0 at whole edges of triangles,
    where a line has no course.
    """
    levels = round_ticks(-limit, limit, 24)
    return levels + np.where(levels == 0.0, 1e-6 * limit, 0.0)


@lru_cache(maxsize=8)
def _raster(points: Same, triangles: Same, view: View, size: tuple[int, int]) -> Raster:
    x, y = points.thing.T
    low, high = view.drawn(np.array([-view.depth, view.upper_depth + view.headroom]))
    corners = np.column_stack([x / view.length * size[0], (high - view.drawn(y)) / (high - low) * size[1]])
    return Raster(points=corners, triangles=triangles.thing, size=size)


@lru_cache(maxsize=32)
def _iso_lines(picture: Same, view: View, limit: float) -> list[Path]:
    """Lines of equal ψ, or ρψ; a sheet of modes shows them again.

    They are left out where it hardly changes: rounding errors would decide on the course of ψ = 0 in still water.
    """
    mode: ModePicture = picture.thing
    steepness = mode.weight * np.hypot(*mode.displacement.T)
    steep = mode.triangles[(steepness > 0.01 * limit / view.length)[mode.triangles.T].any(axis=0)]
    if not len(steep):
        return []
    triangles = Triangulation(mode.points[:, 0], view.drawn(mode.points[:, 1]), steep)
    # One colour is found faster than a scale of them.
    lines = _unseen().tricontour(triangles, mode.drawn_field, iso_levels(limit), colors=_ISO_LINE)
    lines.remove()
    return list(lines.get_paths())


@cache
def _unseen() -> Axes:
    """Axes in which matplotlib finds lines that are drawn elsewhere."""
    return Figure().add_subplot()


def _draw_vectors(
    axes: Axes, raster: Raster, picture: ModePicture, largest: ModePicture | None, x: Array, y: Array, spacing: float,
    view: View,
) -> None:  # fmt: skip
    """∇ψ on a regular grid, stretched like the tank and scaled like the longest displacements."""
    across, up = (grid.ravel() for grid in np.meshgrid(x, y))
    (low, high), (width, height) = axes.get_ylim(), raster.size
    places = np.column_stack([across / view.length * width, (high - up) / (high - low) * height])
    stretches = np.column_stack([np.ones(across.size), np.where(up > 0.0, view.upper_stretch, view.stretch)])

    def at_places(of: ModePicture) -> Array:
        return raster.at(places, of.displacement) * stretches

    sampled = at_places(picture)
    inside = np.isfinite(sampled[:, 0])
    lengths = None if largest is None else np.hypot(*at_places(largest)[inside].T)
    vectors = drawn_vectors(sampled[inside], spacing, lengths)
    seen = np.hypot(*vectors.T) > 0.1 * spacing
    centres = np.column_stack([across[inside][seen], up[inside][seen]])
    of_pixels = axes.transData.transform
    ends = of_pixels(centres + 0.5 * vectors[seen]), of_pixels(centres - 0.5 * vectors[seen])
    arrows = _arrows(*ends, width=2.0 * POINT * axes.figure.dpi / 72.0)
    _fill(axes, list(arrows), 1.0, facecolors=_ARROW, linewidths=0.0, transform=IdentityTransform())


def _arrows(heads: Array, tails: Array, width: float) -> Array:
    """Outlines of arrows from tails to heads, shape (arrows, 7, 2): a shaft of a width, whose head is 3.8 times as wide
    and 4.5 times as long; what is shorter is a smaller head. matplotlib's quiver takes twice as long."""
    spans = heads - tails
    lengths = np.hypot(*spans.T)
    forward = spans / lengths[:, None]
    head = np.minimum(lengths, 4.5 * width)
    neck, none, size = lengths - head, 0.0 * lengths, head / 4.5
    along = np.column_stack([none, neck, neck, lengths, neck, neck, none])
    beside = size[:, None] * np.array([0.5, 0.5, 1.9, 0.0, -1.9, -0.5, -0.5])
    left = np.column_stack([-forward[:, 1], forward[:, 0]])
    return tails[:, None] + along[:, :, None] * forward[:, None] + beside[:, :, None] * left[:, None]


def _draw_wash(axes: Axes, picture: ModePicture, surfaces: tuple[SurfaceCurve, ...], view: View) -> None:
    """Tint the liquid that passed a still level; where air came in, fade the field."""
    shapes, colours = [], []
    for sign in (1.0, -1.0):
        for curve in surfaces:
            height = sign * np.maximum(sign * curve.displacement, 0.0)
            if height.any():
                inner = not picture.is_at_top(curve)
                of_lower = inner or not picture.has_two_liquids
                risen = LOWER_WASH if of_lower else UPPER_WASH
                colours.append((risen, 0.55) if sign > 0 else (UPPER_WASH, 0.55) if inner else ("white", 0.5))
                level, surface = (view.heights(curve, y) for y in (0.0 * height, height))
                shapes.append(np.column_stack([np.append(curve.x, curve.x[::-1]), np.append(surface, level[::-1])]))
    _fill(axes, shapes, 1.5, facecolors=to_rgba_array(colours), linewidths=0.0)


def _draw_resting(axes: Axes, section: FloatSection, view: View, thin: float) -> None:
    """Fill the place of a float in the liquid; mark the line on which a thin one acts."""
    x, y = (section.contour if section.slit is None else section.slit).T
    points = np.column_stack([x, view.drawn(y)])
    if section.slit is None:
        _fill(axes, [points], 1.6, facecolors=_RESTING)
    else:
        _stroke(axes, ([points], 5.0 * thin, BODY_EDGE, None))


def _draw_walls(axes: Axes, picture: ModePicture, view: View, pixel: float, thin: float) -> None:
    wall = WALL * pixel
    edge, right = 0.5 * wall, view.length
    bottom, ceiling, top = view.drawn(np.array([-view.depth, view.upper_depth, view.upper_depth + view.headroom]))
    top = ceiling + wall if picture.lid else top
    walls, goes_on, levels = [], [], [0.0]
    if "sides" in picture.goes_on:
        goes_on += [[(x, bottom), (x, ceiling)] for x in (0.0, right)]
    else:
        walls += [[(x, bottom), (x, top)] for x in (-edge, right + edge)]
    if view.cut or "bottom" in picture.goes_on:
        goes_on.append([(0.0, bottom), (right, bottom)])
    else:
        walls.append([(-wall, bottom - edge), (right + wall, bottom - edge)])
    if view.upper_cut or "top" in picture.goes_on:
        goes_on.append([(0.0, ceiling), (right, ceiling)])
    else:
        for start, end in picture.lid:
            # Where a piece of the lid meets a wall, it joins it.
            first, last = -wall if start <= 0.0 else start, right + wall if end >= right else end
            walls.append([(first, ceiling + edge), (last, ceiling + edge)])
    if picture.has_two_liquids and not view.upper_cut and view.headroom > 0:
        levels.append(float(ceiling))
    still = [[(0.0, y), (right, y)] for y in levels]
    _stroke(
        axes,
        (walls, WALL * thin, _WALL, None),
        (goes_on, 1.5 * thin, GREY, _DOTS),
        (still, 1.4 * thin, INK, _DASHES),
    )


def _fill(axes: Axes, polygons: Sequence[Array], zorder: float, **style: Any) -> None:
    """Polygons: patches would take long to find limits of the axes that they do not change."""
    axes.add_collection(PolyCollection(polygons, clip_on=False, zorder=zorder, **style), autolim=False)


def _stroke(axes: Axes, *strokes: tuple[Sequence[Any], float, str, tuple[float, float] | None]) -> None:
    """Lines and polygons in one collection, which draws many as fast as one."""
    styles = [(line, *style) for lines, *style in strokes for line in lines]
    axes.add_collection(
        LineCollection(
            [line for line, *_ in styles],
            linewidths=[width * POINT for _, width, _, _ in styles],
            colors=[colour for _, _, colour, _ in styles],
            linestyles=["solid" if dashes is None else _dashed(dashes, width) for _, width, _, dashes in styles],
            capstyle="butt",
            clip_on=False,
            zorder=2.0,
        ),
        autolim=False,
    )


def _dashed(dashes: tuple[float, float], width: float) -> tuple[float, tuple[float, float]]:
    """Dash and gap in pixels of a page, as matplotlib has them: in widths of the line."""
    return 0.0, (dashes[0] / width, dashes[1] / width)


def _surface(kind: str, x: ArrayLike, y: ArrayLike, thin: float, *, label: str = "") -> Line2D:
    """A displaced surface in a white edge, or a body in a dark one."""
    colour, width, edge, around = {
        "free_surface": (FREE_SURFACE, 4.5, 7.0, "white"),
        "interface": (INTERFACE, 4.5, 7.0, "white"),
        "body": (BODY, 11.0, 15.0, BODY_EDGE),
    }[kind]
    outline = [withStroke(linewidth=edge * POINT * thin, foreground=around)]
    return Line2D(
        x, y, color=colour, lw=width * POINT * thin, path_effects=outline, solid_capstyle="butt", label=label,
        clip_on=False, zorder=2.0,
    )  # fmt: skip
