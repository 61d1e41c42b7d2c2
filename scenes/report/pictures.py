"""Pictures of a result folder, small enough to stand in a page."""

from __future__ import annotations

import io
from base64 import b64encode
from collections.abc import Iterator
from pathlib import Path

from hydroelastic.scenes.output.provenance import Summary
from hydroelastic.scenes.report.captions import place_and_caption
from hydroelastic.scenes.report.page import Picture

# Pixels across, twice what a column of the page shows: sharp on a fine screen and on paper.
_WIDEST = 1600
# WebP ends at 16383.
_HIGHEST = 8000
# Bytes of one drawing, beyond which its pixels are smaller; of one image that stays as it is; of all together.
_LARGEST_DRAWING = 400_000
_SMALL = 120_000
_ALL = 3_000_000
_QUALITY = 82
# More takes twice the time and saves a twentieth.
_METHOD = 2


def pictures_of(folder: Path, summary: Summary) -> tuple[tuple[Picture, ...], tuple[str, ...]]:
    """Return the pictures of a folder, and the names of those that there is no room for.

    Of one that is there in several formats, a drawing (SVG) is taken before pixels (PNG).

    Args:
        folder: the images; there need be none.
        summary: content of ``summary.json``.
    """
    shown, room = [], _ALL
    # A page cannot hold a PDF.
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
    """Whether a picture is there in a format that a page shows."""
    return any(file.with_suffix(ending).exists() for ending in (".svg", ".png"))


def _files(folder: Path, summary: Summary) -> Iterator[tuple[Path, str]]:
    """A file for each picture, in the order of the page, with its caption; what moves comes last."""
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
    """A picture in the page, and how many bytes it takes there."""
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
