"""Pictures of a result folder, reduced for embedding in a page."""

from __future__ import annotations

import io
from base64 import b64encode
from collections.abc import Iterator
from pathlib import Path

from hydroelastic.output.provenance import Summary
from hydroelastic.scenes.report.captions import place_and_caption
from hydroelastic.scenes.report.page import Picture

# Width in pixels, twice that of a column of the page, for high-resolution screens and print.
_WIDEST = 1600
# Limit of WebP.
_HIGHEST = 8000
# Bytes of one drawing, beyond which its pixels are smaller; of one image that stays as it is; of all together.
_LARGEST_DRAWING = 400_000
_SMALL = 120_000
_ALL = 3_000_000
_QUALITY = 82
# A higher effort takes twice the time and saves 5 %.
_METHOD = 2


def pictures_of(folder: Path, summary: Summary) -> tuple[tuple[Picture, ...], tuple[str, ...]]:
    """Return the pictures of a folder, and the names of those beyond the size limit.

    Of several formats of a picture, vector graphics (SVG) take precedence over pixels (PNG).
    """
    shown, room = [], _ALL
    # PDF cannot be embedded.
    left_out = [file.name for file in sorted(folder.glob("*.pdf")) if not _in_a_page(file)]
    for file, caption in _files(folder, summary):
        picture, size = _picture(file, caption)
        if size > room:
            left_out.append(file.name)
            continue
        room -= size
        shown.append(picture)
    return tuple(shown), tuple(left_out)


def _in_a_page(file: Path) -> bool:
    return any(file.with_suffix(ending).exists() for ending in (".svg", ".png"))


def _files(folder: Path, summary: Summary) -> Iterator[tuple[Path, str]]:
    """A file for each picture, in the order of the page, with its caption; animations come last."""
    films = []
    stems = {file.stem for file in folder.glob("*.*")}
    ordered = sorted((*place_and_caption(stem, summary), stem) for stem in stems)
    for _, caption, stem in ordered:
        drawing, pixels, film = (folder / f"{stem}.{ending}" for ending in ("svg", "png", "gif"))
        if drawing.exists() and (drawing.stat().st_size <= _LARGEST_DRAWING or not pixels.exists()):
            yield drawing, caption
        elif pixels.exists():
            yield pixels, caption
        if film.exists():
            films.append((film, f"{caption}: moving"))
    yield from films


def _picture(file: Path, caption: str) -> tuple[Picture, int]:
    content = file.read_bytes()
    width = height = None
    kind = {".svg": "svg+xml", ".gif": "gif", ".png": "png"}[file.suffix]
    if file.suffix == ".png":
        content, kind, (width, height) = _smaller(content)
    encoded = b64encode(content).decode("ascii")
    source = f"data:image/{kind};base64,{encoded}"
    moving = file.suffix == ".gif"
    return Picture(source=source, caption=caption, width=width, height=height, moving=moving), len(content)


def _smaller(content: bytes) -> tuple[bytes, str, tuple[int, int]]:
    """An image as it is if it is small, else as WebP, which every browser knows; its kind, width and height."""
    from PIL import Image

    with Image.open(io.BytesIO(content)) as opened:
        size = opened.size
        part = min(1.0, _WIDEST / size[0], _HIGHEST / size[1])
        if part == 1.0 and len(content) <= _SMALL:
            return content, "png", size
        image = opened.convert("RGB")
    if part < 1.0:
        image = image.resize((round(size[0] * part), round(size[1] * part)), Image.Resampling.LANCZOS)
    written = io.BytesIO()
    image.save(written, "WEBP", quality=_QUALITY, method=_METHOD)
    return written.getvalue(), "webp", image.size
