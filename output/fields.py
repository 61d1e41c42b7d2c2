"""Pictures of motions in a section: colours and lines of ψ by pyvista, bodies, vectors and axes by matplotlib."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from textwrap import fill
from typing import Any, TypeAlias

import numpy as np
import pyvista
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.cm import ScalarMappable
from matplotlib.collections import PathCollection, PolyCollection
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.path import Path as Outline
from matplotlib.patheffects import withStroke
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray
from PIL import Image

from hydroelastic.fem.progress import Report
from hydroelastic.fem.shape_curves import FloatSection, SectionField, SurfaceCurve
from hydroelastic.output.plots import (
    BODY,
    BODY_EDGE,
    FRAMES,
    GREY,
    INK,
    PAGE,
    Sheets,
    add_colour_bar,
    arrow_key,
    mode_colours,
    new_page,
    page_box,
    page_style,
    plotter,
    without_opacity,
    write_caption,
    write_gif,
    write_keys,
    write_meaning,
    write_title,
)

Array = NDArray[np.float64]
_Coloured: TypeAlias = tuple[Image.Image, Outline]  # pixels of ψ, lines of equal ψ

_LOWER, _UPPER = "#bcd7ef", "#f0dca4"  # of liquids beyond their still levels
# Colour, width, edge, its colour, dashes of lines; widths in points.
_LINES: dict[str, tuple[str, float, float, str, str | tuple[float, tuple[float, float]]]] = {
    "free surface": ("#0a58a8", 3.2, 5.0, "white", "-"),
    "interface": ("#00747c", 3.2, 5.0, "white", "-"),
    "floating body": (BODY, 7.9, 10.8, BODY_EDGE, "-"),
    "still level": (INK, 1.0, 0.0, INK, (0.0, (6.5, 4.3))),
    "lines of equal": ("#6e6a72", 1.0, 0.0, INK, "-"),
    "wall": ("#3c3c3c", 3.6, 0.0, INK, "-"),
    "beyond": (GREY, 1.1, 0.0, INK, (0.0, (2.0, 4.0))),
}
_KINDS = {"free_surface": "free surface", "interface": "interface", "body": "floating body"}
_SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_ROUND = np.array([1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0])
# From vector to vector, and left and right of a section, below and above it on a page, inches.
_SPACING, _BESIDE, _DENSITIES, _FOOTER, _HEADING = 0.44, 2.3, 1.2, 2.85, 0.85


class View:
    """What of a section is drawn, and its scales, for the largest values of a motion.

    Shallow tanks are stretched vertically, tall ones compressed, deep ones cut where hardly anything moves; of two
    liquids a thin one has a scale of its own. Surfaces and floats move by `scale` times their displacement.
    """

    def __init__(self, field: SectionField) -> None:
        length, two = field.length, field.upper_depth > 0.0
        self.field = field
        reach = np.concatenate([np.zeros(1), *(section.contour[:, 1] for section in field.floats)])
        at_top = reach.max() > field.upper_depth or any(_is_at_top(field, curve) for curve in field.surfaces)
        deepest, cut = (1.0, 0.8) if two else (1.5, 1.25)

        def shown(depth: float, beside: float) -> float:
            return depth if depth <= deepest * length else min(depth, max(cut * length, 1.2 * beside))

        self.depth = shown(field.depth, -reach.min())
        self.upper = field.upper_depth if at_top else shown(field.upper_depth, reach.max())
        self.cut = self.depth < field.depth or self.upper < field.upper_depth
        lower, upper = self.depth / length, self.upper / length
        stretch = 1.0 if lower + upper >= 0.15 else _rounded(0.2 / (lower + upper), up=True)
        if two and lower + upper > 2.0:
            stretch = _rounded(2.0 / (lower + upper), up=False)
        thick = [stretch if not two or stretch * part >= 0.05 else _rounded(0.1 / part, up=True)
                 for part in (lower, upper or lower)]  # fmt: skip
        self.stretch, self.upper_stretch = thick
        self.rise = min(thick)
        # Surfaces must not meet across a thin liquid, nor floats leave their places, but they are to be seen to move.
        sizes = (0.1 * length, 0.3 * thick[0] * self.depth, 0.3 * thick[1] * self.upper)
        amplitude = (min(sizes) if two else min(sizes[0], 0.16 * thick[0] * self.depth)) / self.rise
        heights = [max(0.25 * float(np.ptp(one.contour[:, 1])), 0.25 * amplitude) for one in field.floats]
        amplitude = min(amplitude, *heights) if heights else amplitude
        moved = [np.abs(one.displacement).max() for one in field.surfaces]
        moved += [np.hypot(*one.displacement.T).max() for one in field.floats]
        self.scale = amplitude / max(moved) if max(moved, default=0.0) > 0.0 else 0.0
        room = 0.0 if two and not at_top else max(reach.max() - self.upper, 0.0) + 1.35 * amplitude
        self._levels = np.array([-self.depth, 0.0, self.upper, self.upper + max(room, 1e-12)])
        self._heights = np.cumsum(np.append(-thick[0] * self.depth, np.diff(self._levels) * [*thick, self.rise]))
        self.bottom, self.ceiling, self.top = (float(self._heights[number]) for number in (0, 2, 3))
        self.limit = float(np.abs(field.pressure).max(initial=0.0)) or 1.0

    def drawn(self, y: Any) -> Array:
        """Heights in the scale of the abscissae."""
        return np.interp(y, self._levels, self._heights)

    def moved(self, section: FloatSection) -> Array:
        """Corners of a float."""
        x, y = section.contour.T
        return np.column_stack([x, self.drawn(y)]) + self.scale * section.displacement * [1.0, self.rise]

    def surface(self, curve: SurfaceCurve) -> tuple[Array, Array]:
        """A surface, which goes on below the floats that it touches at rest."""
        x, y = curve.x, self.drawn(curve.level) + self.rise * self.scale * curve.displacement
        for section in self.field.floats if curve.kind != "body" else ():
            left, right = section.waterplane
            if section.slit is None:
                near, middle = 1e-6 * (right - left), 0.5 * (left + right)
                if abs(x[-1] - left) < near:
                    x, y = np.append(x, middle), np.append(y, y[-1])
                if abs(x[0] - right) < near:
                    x, y = np.insert(x, 0, middle), np.insert(y, 0, y[0])
        return x, y

    def notes(self) -> Iterator[str]:
        """What the reader must know to measure."""
        field = self.field
        if field.goes_on:
            yield "the water extends beyond the picture"
        if stretch := self.stretch_note():
            yield f"{stretch}, also of the vectors"
        if self.cut and self.upper:
            yield (f"only {-self.depth:.3g} m < y < {self.upper:.3g} m of {-field.depth:.3g} m < y < "
                   f"{field.upper_depth:.3g} m shown").replace("-", "−")  # fmt: skip
        elif self.cut:
            yield f"only the upper {self.depth:.3g} m of {field.depth:.3g} m of liquid shown"
        if self.scale > 0.0:
            scale = f"{self.scale:.3g}" if 1e-3 <= self.scale < 999.5 else _power_of_ten(self.scale)
            yield f"surface displacement drawn ×{scale} ({field.amplitude or 'arbitrary amplitude'})"
        else:
            yield "the surfaces do not move"
        yield "longest vectors shortened"

    def stretch_note(self) -> str:
        """The vertical scale in words, or ""."""
        if self.upper_stretch != self.stretch:
            return f"vertical scale ×{self.stretch:g} in the lower and ×{self.upper_stretch:g} in the upper liquid"
        return f"vertical scale ×{self.stretch:g}" if self.stretch != 1.0 else ""


def _is_at_top(field: SectionField, curve: SurfaceCurve) -> bool:
    return not field.upper_depth or curve.level > 0.0


def _rounded(value: float, *, up: bool) -> float:
    power = 10.0 ** np.floor(np.log10(value))
    part = value / power
    return float(power * (_ROUND[part * (1 - 1e-9) <= _ROUND][0] if up else _ROUND[part * (1 + 1e-9) >= _ROUND][-1]))


def _power_of_ten(value: float) -> str:
    mantissa, exponent = f"{value:.2e}".split("e")
    return f"{mantissa}·10{str(int(exponent)).translate(_SUPERSCRIPT)}"


def draw_sections(fields: Sequence[SectionField], names: Sequence[str], sheets: Sheets, report: Report) -> None:
    """Draw modes of one tank with axes, colour bar and keys, and all of them as panels of an overview."""
    views, pages = [View(field) for field in fields], _Pages(sheets.options.width)
    with page_style():
        overview, panels = _overview(sheets, views)
        for number, (view, name, axes) in enumerate(zip(views, names, panels, strict=True), 1):
            report(f"picture {number} of {len(fields)}")
            page = pages.of(view)
            page.draw(view.field, view.field.title)
            sheets.save(page.figure, name, page.pixels)
            _draw(axes, view.field, view, page.coloured, thin=0.62)
        sheets.save(overview, "overview")


def draw_motion(field: SectionField, name: str, sheets: Sheets) -> None:
    """Draw a motion e^{−iωt} at t = 0, in the scales of its largest values."""
    with page_style():
        page = _Page(View(field.mapped(np.abs)), sheets.options.width)
        page.draw(field.at(0.0), field.title)
        sheets.save(page.figure, name)


def animate_motion(field: SectionField, name: str, sheets: Sheets) -> None:
    """Draw a period of a motion e^{−iωt} as a GIF, in the scales of its largest values."""
    with page_style():
        page = _Page(View(field.mapped(np.abs)), sheets.options.animation_width)
        images = []
        for part in np.arange(FRAMES) / FRAMES:
            page.draw(field.at(part), f"{field.title}, t = {part:.2f} T")
            images.append(page.pixels())
        write_gif(images, sheets.folder / f"{name}.gif", kept=mode_colours())


def _overview(sheets: Sheets, views: Sequence[View]) -> tuple[Figure, list[Axes]]:
    """A page with a panel for each mode, which are still empty."""
    fields = [view.field for view in views]
    aspect = max((view.top - view.bottom) / view.field.length for view in views)
    most = 2 if aspect < 0.35 else 3 if aspect < 0.9 else 5
    rows = -(-len(fields) // most)
    columns = -(-len(fields) // rows)
    panel = (PAGE - 0.4 * (columns + 1)) / columns
    row, two = aspect * panel + 0.8, bool(fields[0].densities)
    notes = [f"each panel has its own scale of {'ρψ' if two else 'ψ'} (green positive, purple negative) and of the "
             "displacement", *dict.fromkeys(filter(None, (view.stretch_note() for view in views)))]  # fmt: skip
    if any(view.cut for view in views):
        notes.append(f"only the {'part around the interface' if two else 'upper part of the liquid'} shown")
    height = 1.2 + rows * row
    titles = [fill(field.title.replace(" = ", "\u00a0=\u00a0"), 42) for field in fields]
    size = min(13.7, 72.0 * panel / (0.58 * max(len(line) for title in titles for line in title.split("\n"))))
    # What reads pictures may refuse large ones.
    width = max(min(sheets.options.width, int(10_000 * PAGE / height)), 400)
    figure = new_page(width, height)
    write_caption(figure, "; ".join(notes))
    panels = []
    for number, view in enumerate(views):
        left, top = 0.4 + number % columns * (panel + 0.4), height - 0.15 - number // columns * row
        drawn = (view.top - view.bottom) / view.field.length * panel
        panels.append(figure.add_axes(page_box(figure, left, top - 0.72 - drawn, panel, drawn)))
        panels[-1].set_axis_off()
        figure.text((left + 0.5 * panel) / PAGE, (top - 0.36) / height, titles[number], size=size,
                    ha="center", va="center")  # fmt: skip
    write_keys(figure, _keys(fields), 0.66)
    return figure, panels


class _Pages:
    """The last page: modes of a tank whose views do not differ share it."""

    def __init__(self, width: int) -> None:
        self._width, self._pages = width, dict[Any, _Page]()

    def of(self, view: View) -> _Page:
        field = view.field
        key = (id(field.points), view.bottom, view.ceiling, view.top, tuple(_key_names([field])))
        if key not in self._pages:
            self._pages = {key: _Page(view, self._width)}
        page = self._pages[key]
        page.view = view
        return page


class _Page:
    """What is the same on the pictures of several modes, drawn once: axes, keys, colours."""

    def __init__(self, view: View, width: int) -> None:
        self.view, field, up = view, view.field, view.top - view.bottom
        beside = _DENSITIES if field.densities else 0.0
        wide = min(PAGE - _BESIDE - beside, 0.75 * PAGE * field.length / up)
        high = wide * up / field.length
        height = round(_FOOTER + high + _HEADING, 2)
        self.figure = new_page(width, height)
        self.axes = axes = self.figure.add_axes(
            page_box(self.figure, 0.5 * (PAGE - wide - beside) + 0.45, _FOOTER, wide, high)
        )
        self.scene = Scene(view, max(round(wide * width / PAGE), 2))
        axes.spines[:].set_visible(False)
        axes.xaxis.set_major_locator(MaxNLocator(8, steps=(1, 2, 5, 10)))
        ticks: list[float] = []
        ends = [(-view.depth, 0.0, view.stretch), (0.0, view.upper, view.upper_stretch)]
        for low, top, stretch in (
            ends if view.stretch != view.upper_stretch else [(-view.depth, view.upper, view.stretch)]
        ):
            count = max(2, min(6, round(stretch * wide / field.length * (top - low) / 0.75)))
            found = MaxNLocator(count, steps=(1, 2, 5, 10)).tick_values(low, top)
            ticks += [tick for tick in found if low - 1e-9 <= tick <= top + 1e-9]
        axes.set_yticks(view.drawn(ticks), [f"{tick + 0.0:.6g}".replace("-", "−") for tick in ticks])
        axes.tick_params(length=9.0)
        axes.set_xlabel("x, m")
        axes.set_ylabel("y, m")
        axes.yaxis.set_label_coords(-1.0 / wide, 0.5 * (view.ceiling - view.bottom) / up)
        for name, density, depth, colour in zip(
            "₂₁", field.densities, (-view.depth, view.upper), (_LOWER, _UPPER), strict=False
        ):
            words, at = f"ρ{name} = {density:.5g}\nkg/m³", (float(view.drawn(0.5 * depth)) - view.bottom) / up
            box = {"facecolor": colour, "linewidth": 0.0, "pad": 6.0}
            axes.annotate(words, (1.0, at), (22.0, 0.0), "axes fraction", "offset points", va="center", bbox=box)
        write_keys(self.figure, [*_keys([field]), arrow_key(INK, "displacement ∇ψ")])
        self._bar = add_colour_bar(self.figure, ScalarMappable(cmap=mode_colours()))
        self._texts = [self.figure.text(0.0, 0.0, "")]
        self._canvas, self._alike = FigureCanvasAgg(self.figure), None

    def draw(self, field: SectionField, title: str) -> None:
        """A mode, in place of the one before."""
        axes, view, figure = self.axes, self.view, self.figure
        for artist in self._changing():
            artist.remove()
        self.coloured = self.scene.coloured(field, view)
        _draw(axes, field, view, self.coloured)
        _draw_vectors(axes, self.scene.mesh, field, view)
        exponent = int(np.floor(np.log10(view.limit)))
        exponent = 0 if -3 <= exponent <= 3 else exponent
        self._bar.mappable.set_clim(*(side * view.limit / 10.0**exponent for side in (-1, 1)))
        name, unit = ("ρψ ∝ dynamic pressure", "kg/m") if field.densities else ("ψ", "m²")
        power = f"10{str(exponent).translate(_SUPERSCRIPT)} " if exponent else ""
        words = f"{name}, {power}{unit}, {field.amplitude or 'unit generalized mass'}"
        self._texts = [
            write_title(figure, title),
            write_caption(figure, "; ".join(view.notes())),
            write_meaning(figure, words),
        ]

    def _changing(self) -> list[Artist]:
        axes = self.axes
        return [*axes.collections, *axes.lines, *axes.artists, *axes.patches, *self._texts]

    def pixels(self) -> Image.Image:
        """The page as `pixels` makes it; what all modes have alike is drawn once."""
        changing = [*self._changing(), self._bar.ax]
        if self._alike is None:
            for artist in changing:
                artist.set_visible(False)
            self._canvas.draw()
            self._alike = self._canvas.copy_from_bbox(self.figure.bbox)
        self._canvas.restore_region(self._alike)
        for artist in sorted(changing, key=Artist.get_zorder):
            artist.set_visible(True)
            artist.draw(self._canvas.renderer)
        return without_opacity(self._canvas)


class _Pixels(Artist):
    """An image from the lower left corner of axes, which matplotlib would sample anew for each figure."""

    def __init__(self, image: Image.Image) -> None:
        super().__init__()
        self._image = np.asarray(image.convert("RGBA"))[::-1]

    def draw(self, renderer: Any) -> None:
        assert self.axes is not None
        renderer.draw_image(renderer.new_gc(), self.axes.bbox.x0, self.axes.bbox.y0, self._image)


def _draw(axes: Axes, field: SectionField, view: View, coloured: _Coloured, *, thin: float = 1.0) -> None:
    """A motion in axes of the scale of the abscissae."""
    image, lines = coloured
    axes.autoscale(False)
    axes.set_xlim(field.start, field.start + field.length)
    axes.set_ylim(view.bottom, view.top)
    width = round(axes.bbox.width)
    if width != image.width:
        image = image.resize((width, round(width * image.height / image.width)))
    axes.add_artist(_Pixels(image))
    axes.add_collection(PathCollection([lines], edgecolors=_LINES["lines of equal"][0], facecolors="none",
                                       linewidths=0.8 * thin, capstyle="round", snap=False), autolim=False)  # fmt: skip
    # Liquid that passed a still level is tinted; where air came in, the field fades.
    shapes, colours = [], []
    for curve in field.surfaces:
        level, inner, (x, y) = float(view.drawn(curve.level)), not _is_at_top(field, curve), view.surface(curve)
        risen, fallen = _LOWER if inner or not field.densities else _UPPER, (_UPPER, 0.55) if inner else ("white", 0.5)
        for height, colour in ((np.maximum(y, level), (risen, 0.55)), (np.minimum(y, level), fallen)):
            shapes.append(np.column_stack([[x[0], *x, x[-1]], [level, *height, level]]))
            colours.append(to_rgba(*colour))
    axes.add_collection(PolyCollection(shapes, facecolors=colours, lw=0.0, zorder=2.5, clip_on=False), autolim=False)
    for section in field.floats:
        x, y = (section.contour if section.slit is None else section.slit).T
        if section.slit is None:
            axes.fill(x, view.drawn(y), color="#f6e6d8", zorder=2.6)
        else:
            axes.plot(x, view.drawn(y), color=BODY_EDGE, lw=3.6 * thin, zorder=2.6)
    _draw_walls(axes, field, view, thin)
    for curve in sorted(field.surfaces, key=lambda curve: curve.kind == "body"):
        axes.add_line(_line(_KINDS[curve.kind], *view.surface(curve), thin))
    for section in field.floats:
        opacity = 1.0 if section.slit is None else 0.45
        axes.fill(*view.moved(section).T, facecolor=(BODY, opacity), edgecolor=BODY_EDGE, lw=2.5 * thin, zorder=3.5,
                  clip_on=False)  # fmt: skip
        x, y = np.vstack([section.contour, section.contour[:1]]).T
        axes.add_line(_line("still level", x, view.drawn(y), thin)).set_zorder(3.6)


def _line(name: str, x: Any, y: Any, thin: float = 1.0, label: str = "") -> Line2D:
    colour, width, edge, around, dashes = _LINES[name]
    effects = [withStroke(linewidth=edge * thin, foreground=around)] if edge else None
    return Line2D(x, y, color=colour, lw=width * thin, ls=dashes, path_effects=effects, solid_capstyle="butt",
                  label=label, clip_on=False, zorder=3.0)  # fmt: skip


def _key_names(fields: Sequence[SectionField]) -> list[str]:
    kinds = {curve.kind for field in fields for curve in field.surfaces}
    kinds |= {"body"} if any(field.floats for field in fields) else set()
    return [name for kind, name in _KINDS.items() if kind in kinds]


def _keys(fields: Sequence[SectionField]) -> list[Line2D]:
    still = "still level, float at rest" if any(field.floats for field in fields) else "still level"
    keys = [_line(name, [], [], label=name) for name in _key_names(fields)]
    lines = f"lines of equal {'ρψ' if fields[0].densities else 'ψ'}"
    return [*keys, _line("still level", [], [], label=still), _line("lines of equal", [], [], label=lines)]


def _draw_walls(axes: Axes, field: SectionField, view: View, thin: float) -> None:
    start, end, bottom, ceiling = field.start, field.start + field.length, view.bottom, view.ceiling
    goes_on = set(field.goes_on) | ({"bottom"} if view.depth < field.depth else set())
    goes_on |= {"top"} if view.upper < field.upper_depth else set()
    # Walls begin beyond the liquid by half their width.
    width = 0.42 * 3.6 * thin / 72.0 * field.length / (axes.get_position().width * PAGE)
    left, right, low, high = start - width, end + width, bottom - width, ceiling + width
    top = ceiling + 2.0 * width if field.lid else view.top
    beyond = "sides" in goes_on
    lines = [("beyond" if beyond else "wall", (x, x), (bottom, ceiling if beyond else top))
             for x in ((start, end) if beyond else (left, right))]  # fmt: skip
    if "bottom" in goes_on:
        lines.append(("beyond", (start, end), (bottom, bottom)))
    else:
        lines.append(("wall", (left - width, right + width), (low, low)))
    if "top" in goes_on:
        lines.append(("beyond", (start, end), (ceiling, ceiling)))
    else:
        lines += [("wall", (a if a > start else left - width, b if b < end else right + width), (high, high))
                  for a, b in field.lid]  # fmt: skip
    lines.append(("still level", (start, end), (0.0, 0.0)))
    if field.densities and "top" not in goes_on and view.top - ceiling > 1e-6 * field.length:
        lines.append(("still level", (start, end), (ceiling, ceiling)))
    for name, x, y in lines:
        axes.add_line(_line(name, x, y, thin))


def _draw_vectors(axes: Axes, mesh: pyvista.PolyData, field: SectionField, view: View) -> None:
    """∇ψ on a grid: the 90 % quantile of the lengths gets nearly the spacing, longer ones are shortened to it."""
    spacing = _SPACING * field.length / (axes.get_position().width * PAGE)
    columns, rows = (max(round(side / spacing), 2) for side in (field.length, view.ceiling - view.bottom))
    x = field.start + field.length * (np.arange(columns) + 0.5) / columns
    y = view.bottom + (view.ceiling - view.bottom) * (np.arange(rows) + 0.5) / rows
    grid = np.array(np.meshgrid(x, y)).reshape(2, -1).T
    mesh["vectors"], mesh["largest"] = field.displacement, view.field.displacement
    found = pyvista.PolyData(np.column_stack([grid, np.zeros(len(grid))])).sample(mesh)
    inside = found["vtkValidPointMask"].astype(bool)
    grid, stretches = grid[inside], np.where(grid[inside][:, 1:] > 0.0, [1.0, view.upper_stretch], [1.0, view.stretch])
    vectors = found["vectors"][inside] * stretches
    lengths = np.hypot(*(found["largest"][inside] * stretches).T)
    if not lengths.any():
        return
    vectors = 0.95 * spacing * vectors / np.maximum(lengths, np.quantile(lengths, 0.9) or lengths.max())[:, None]
    seen = np.hypot(*vectors.T) > 0.1 * spacing
    axes.quiver(*grid[seen].T, *vectors[seen].T, color="#26262b", pivot="mid", angles="xy", scale_units="xy", scale=1.0,
                units="inches", width=0.02, headwidth=3.8, headlength=4.5, headaxislength=4.5, minlength=0.0,
                zorder=2.0)  # fmt: skip


class Scene:
    """The colours of motions on the triangles of one field, in a view of it; one scene renders all modes."""

    def __init__(self, view: View, width: int) -> None:
        field, height = view.field, view.ceiling - view.bottom
        size = width, max(round(width * height / field.length), 2)
        points = np.column_stack([field.points[:, 0], view.drawn(field.points[:, 1]), np.zeros(len(field.points))])
        self.mesh = pyvista.PolyData.from_regular_faces(points, field.triangles)
        self._plotter = plotter(size)
        # Edges are smooth as they are.
        self._plotter.render_window.SetMultiSamples(0)
        self.mesh["field"] = np.zeros(len(points))
        self._plotter.add_mesh(
            self.mesh, scalars="field", cmap=mode_colours(), clim=(-1.0, 1.0), lighting=False, show_scalar_bar=False
        )
        camera, middle = self._plotter.camera, (field.start + 0.5 * field.length, 0.5 * (view.bottom + view.ceiling))
        camera.position, camera.focal_point, camera.up = (*middle, 10.0 * field.length), (*middle, 0.0), (0.0, 1.0, 0.0)
        camera.parallel_scale, camera.clipping_range = 0.5 * height, (field.length, 20.0 * field.length)

    def coloured(self, field: SectionField, view: View) -> _Coloured:
        """ψ or ρψ as pixels, and lines where it is equal."""
        self.mesh["field"] = field.pressure / view.limit
        self._plotter.render()
        image = Image.fromarray(np.asarray(self._plotter.screenshot(return_img=True)))
        # Where it hardly changes, rounding errors would decide on the course of ψ = 0.
        sizes = np.ptp(field.points[field.triangles], axis=1).max(axis=1)
        steep = np.ptp(self.mesh["field"][field.triangles], axis=1) > 0.01 * sizes / field.length
        if not steep.any():
            return image, Outline(np.empty((0, 2)))
        # The level 0 is a hair above it: on a mirror plane ψ is 0 at whole edges of triangles.
        values = np.asarray(MaxNLocator(24, steps=(1, 2, 5, 10)).tick_values(-view.limit, view.limit))
        part = pyvista.PolyData.from_regular_faces(self.mesh.points, field.triangles[steep])
        part["field"] = self.mesh["field"]
        lines = part.contour(values / view.limit + 1e-6, scalars="field")
        ends = lines.points[lines.lines.reshape(-1, 3)[:, 1:].ravel(), :2]
        return image, Outline(ends, np.tile([Outline.MOVETO, Outline.LINETO], len(ends) // 2))
