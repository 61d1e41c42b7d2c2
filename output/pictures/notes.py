"""What is written beside the picture of a mode: which field it shows, and in which scales."""

from __future__ import annotations

from collections.abc import Sequence

from hydroelastic.fem.pictures.mode import UNIT_MASS, ModePicture
from hydroelastic.output.pictures.view import View

_SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def field_name(picture: ModePicture) -> str:
    """What the colours and lines of a picture show."""
    return "ρψ" if picture.has_two_liquids else "ψ"


def stretch_note(view: View) -> str:
    """The vertical scale in words, or ""."""
    if view.stretch != view.upper_stretch:
        return f"vertical scale ×{view.stretch:g} in the lower and ×{view.upper_stretch:g} in the upper liquid"
    return f"vertical scale ×{view.stretch:g}" if view.stretch != 1.0 else ""


def scale_notes(view: View, picture: ModePicture) -> str:
    """What the reader must know to measure in the picture."""
    notes = ["the water extends beyond the picture"] if picture.goes_on else []
    if stretch := stretch_note(view):
        notes.append(f"{stretch}, also of the vectors")
    if view.whole_upper_depth and (view.cut or view.upper_cut):
        notes.append(
            f"only {-view.depth:.3g} m < y < {view.upper_depth:.3g} m of {-view.whole_depth:.3g} m < y < "
            f"{view.whole_upper_depth:.3g} m shown".replace("-", "−")
        )
    elif view.cut:
        notes.append(f"only the upper {view.depth:.3g} m of {view.whole_depth:.3g} m of liquid shown")
    if view.surface_scale > 0:
        amplitude = "arbitrary amplitude" if picture.amplitude == UNIT_MASS else picture.amplitude
        notes.append(f"surface displacement drawn ×{short_number(view.surface_scale)} ({amplitude})")
    else:
        notes.append("the surfaces do not move")
    notes.append("longest vectors shortened")
    return "; ".join(notes)


def overview_note(pictures: Sequence[ModePicture], views: Sequence[View]) -> str:
    """What the reader of a sheet must know."""
    name = field_name(pictures[0])
    notes = [f"each panel has its own scale of {name} (green positive, purple negative) and of the displacement"]
    notes += [*dict.fromkeys(filter(None, map(stretch_note, views)))]
    if any(view.cut or view.upper_cut for view in views):
        part = "part around the interface" if pictures[0].has_two_liquids else "upper part of the liquid"
        notes.append(f"only the {part} shown")
    return "; ".join(notes)


def short_number(value: float) -> str:
    """Three significant digits, with a power of ten for very large and very small numbers."""
    if 1e-3 <= value < 999.5:
        return f"{value:.3g}"
    mantissa, exponent = f"{value:.2e}".split("e")
    return f"{mantissa}·10{str(int(exponent)).translate(_SUPERSCRIPT)}"
