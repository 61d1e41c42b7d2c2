"""Modes to be drawn, and the pixels of what was."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Literal

import numpy as np
from PIL import Image

from hydroelastic.fem.pictures.mode import ModePicture, SurfaceCurve


def sloshing_picture(
    *, length: float = 10.0, depth: float = 4.0, body: tuple[float, float] | None = (0.3, 0.7), number: int = 2
) -> ModePicture:
    """ψ = cos kx cosh k(y + depth) / cosh k·depth with a body that moves with the liquid."""
    x, y = np.meshgrid(np.linspace(0.0, length, 41), -depth * np.linspace(1.0, 0.0, 31) ** 2)
    k = number * np.pi / length
    below = np.exp(k * y) / (1 + np.exp(-2 * k * depth))
    mirrored = np.exp(-k * (y + 2 * depth)) / (1 + np.exp(-2 * k * depth))
    potential = np.cos(k * x) * (below + mirrored)
    displacement = np.stack([-k * np.sin(k * x) * (below + mirrored), k * np.cos(k * x) * (below - mirrored)], axis=-1)
    corner = (np.arange(30)[:, None] * 41 + np.arange(40)).ravel()
    triangles = np.vstack(
        [np.column_stack([corner, corner + 1, corner + 42]), np.column_stack([corner, corner + 42, corner + 41])]
    )
    pieces: list[tuple[Literal["free_surface", "body"], float, float]] = [("free_surface", 0.0, 1.0)]
    if body is not None:
        pieces = [("free_surface", 0.0, body[0]), ("body", *body), ("free_surface", body[1], 1.0)]
    surfaces = []
    for kind, low, high in pieces:
        if high > low:
            at = length * np.linspace(low, high, 50)
            surfaces.append(SurfaceCurve(kind=kind, x=at, displacement=k * np.tanh(k * depth) * np.cos(k * at)))
    return ModePicture(
        points=np.column_stack([x.ravel(), y.ravel()]),
        triangles=triangles,
        potential=potential.ravel(),
        displacement=displacement.reshape(-1, 2),
        surfaces=tuple(surfaces),
        title="Mode 2: ω = 2.464523 rad/s, 0.392 Hz",
        length=length,
        depth=depth,
    )


def heave_picture(sign: float) -> ModePicture:
    """A body that heaves as a whole between surfaces at rest."""
    picture = sloshing_picture()
    surfaces = tuple(
        replace(curve, displacement=np.full(len(curve.x), sign if curve.kind == "body" else 0.0))
        for curve in picture.surfaces
    )
    return replace(picture, surfaces=surfaces)


def pixels(path: Path) -> np.ndarray:
    from matplotlib.image import imread

    return np.round(255 * imread(path)[:, :, :3]).astype(int)


def has_colour(image: np.ndarray, colour: str) -> np.ndarray:
    """Where the pixels have a colour, up to the rounding of the renderer."""
    rgb = [int(colour[i : i + 2], 16) for i in (1, 3, 5)]
    return np.abs(image - rgb).max(axis=2) <= 2


def gif_pages(path: Path) -> list[np.ndarray]:
    """The pages of an animation in 0…255, shape (height, width, 3) each."""
    pages = []
    with Image.open(path) as gif:
        for place in range(gif.n_frames):
            gif.seek(place)
            pages.append(np.array(gif.convert("RGB")).astype(int))
    return pages
