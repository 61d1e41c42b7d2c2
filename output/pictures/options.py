"""How the pictures of a run are made: formats, resolution, sizes. Nothing here draws, nor imports what does."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any, Literal, TypeAlias, get_args

CurveFormat: TypeAlias = Literal["png", "svg", "pdf"]
PictureOption: TypeAlias = Literal["formats", "dpi", "scale", "width", "animate"]

CURVE_FORMATS: tuple[CurveFormat, ...] = get_args(CurveFormat)
DPI_LIMITS = (50, 1200)
SCALE_LIMITS = (0.8, 4.0)
"""On smaller pages the words would cover each other."""
WIDTH_LIMITS = (400, 8000)

OF_CURVES: frozenset[PictureOption] = frozenset(("formats", "dpi", "scale"))
"""Options that pictures of curves heed."""
OF_FIELDS: frozenset[PictureOption] = frozenset(("width",))
"""Options that rendered pictures of fields and lines heed."""
OF_MOTIONS: frozenset[PictureOption] = frozenset(("animate",))
"""Options that what moves heeds."""

_NO_CURVES = "this scene has only rendered pictures, which are PNG files as wide as width (--image-width) says"
_WITHOUT_EFFECT: dict[PictureOption, str] = {
    "formats": "a format of curves has no effect: " + _NO_CURVES,
    "dpi": "a resolution of curves has no effect: " + _NO_CURVES,
    "scale": "a scale of curves has no effect: " + _NO_CURVES,
    "width": "a width of rendered pictures has no effect: this scene has none, only curves, which dpi "
    "and scale (--dpi, --image-scale) size",
    "animate": "an animation has no effect: nothing of this scene can be animated",
}


@dataclass(frozen=True, kw_only=True)
class PictureOptions:
    """How pictures are made.

    Attributes:
        formats: files that are written of each picture of curves: ``"png"``, ``"svg"``, ``"pdf"``. Rendered pictures
            and frames are PNG always.
        dpi: pixels per inch of curves in PNG, and of coloured maps inside SVG and PDF; 50 to 1200.
        scale: size of the page of curves over its usual one, 0.8 to 4; letters and strokes keep their size.
        width: of rendered pictures, pixels, 400 to 8000.
        animate: whether what moves is drawn as an animation too.

    Raises:
        ValueError: naming the option that cannot be used, its value and what is allowed.
    """

    formats: tuple[CurveFormat, ...] = ("png",)
    dpi: int = 130
    scale: float = 1.0
    width: int = 1600
    animate: bool = False

    def __post_init__(self) -> None:
        if not self.formats or not set(self.formats) <= set(CURVE_FORMATS):
            raise ValueError(f"formats = {self.formats}: allowed are one or more of {', '.join(CURVE_FORMATS)}")
        _require("dpi", self.dpi, DPI_LIMITS)
        _require("scale", self.scale, SCALE_LIMITS)
        _require("width", self.width, WIDTH_LIMITS)

    @property
    def animation_width(self) -> int:
        """Of animations, pixels: half of that of pictures, which keeps their files small."""
        return max(self.width // 2, WIDTH_LIMITS[0])

    def without_effect(self, used: frozenset[PictureOption]) -> tuple[str, ...]:
        """Say which options were changed in vain."""
        changed = [field.name for field in fields(self) if getattr(self, field.name) != field.default]
        return tuple(words for name, words in _WITHOUT_EFFECT.items() if name in changed and name not in used)


def _require(name: str, value: Any, limits: tuple[float, float]) -> None:
    low, high = limits
    # The comparison fails for NaN as well.
    if not low <= value <= high:
        raise ValueError(f"{name} = {value}: allowed are numbers from {low:g} to {high:g}")


DEFAULT_PICTURES = PictureOptions()
"""PNG files of the usual size."""
