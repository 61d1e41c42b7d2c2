"""Dry modes of a uniform beam with both ends free, in a form that is exact at any index."""

from __future__ import annotations

import functools
from typing import SupportsFloat

import numpy as np
import numpy.typing as npt

from hydroelastic.physics.arrays import FloatArray

RIGID_SHAPES = 2
"""Heave (index 0) and pitch (index 1) come before the elastic shapes."""


def _root_offset(numbers: FloatArray) -> FloatArray:
    """Return x in κ_j l = (j + 1/2) π + x, from sin x = −(−1)^j / cosh κ_j l.

    The fixed point contracts by 1/cosh κ_1 l < 0.02, so a dozen turns reach rounding for every j.
    """
    alternating = np.where(numbers % 2 == 1, 1.0, -1.0)
    offset = np.zeros_like(numbers)
    for _ in range(12):
        decay = np.exp(-((numbers + 0.5) * np.pi + offset))
        offset = alternating * np.arcsin(2 * decay / (1 + decay**2))
    return offset


def free_free_roots(count: int) -> FloatArray:
    """Return the first roots κ_j l of cosh κl cos κl = 1, which are 4.730, 7.853, 10.996, …

    Args:
        count: how many roots, j = 1 … count.

    Returns:
        The dimensionless roots κ_j l, shape (count,).

    Source: the frequency equation of the free-free Euler–Bernoulli beam; 1/cosh is used instead of
    cosh, so nothing overflows.
    """
    if count < 0:
        raise ValueError(f"count is {count}; it must not be negative")
    numbers = np.arange(1, count + 1, dtype=np.float64)
    return (numbers + 0.5) * np.pi + _root_offset(numbers)


def free_free_wavenumber(index: int) -> float:
    """Return κ l of the shape ``index`` of `free_free_shape`: zero for heave and pitch.

    Args:
        index: 0 heave, 1 pitch, 2, 3, … elastic.

    Returns:
        The dimensionless wavenumber κ_j l, j = index − 1.
    """
    _check_index(index)
    if index < RIGID_SHAPES:
        return 0.0
    return (index - 0.5) * np.pi + _single_root_offset(index - 1)


@functools.lru_cache(maxsize=2048)
def _single_root_offset(number: int) -> float:
    return float(_root_offset(np.array([float(number)]))[0])


def free_free_shape(index: int, s: npt.ArrayLike | SupportsFloat, derivative: int = 0) -> FloatArray:
    """Return a dry shape of the free-free beam, or one of its derivatives with respect to s = z/l.

    Heave is 1, pitch is √3 (2s − 1), and elastic shape j = index − 1 is

        W_j(s) = cosh b s + cos b s − σ (sinh b s + sin b s),   b = κ_j l,
        σ = tanh(b/2) for odd j, coth(b/2) for even j,

    so ∫₀¹ W² ds = 1 for all of them and W_j(0) = +2. It is evaluated from the nearer end with decaying
    exponentials and an exactly reduced phase, so the error stays near rounding (times b^derivative) at any index.

    Args:
        index: 0 heave, 1 pitch, 2, 3, … elastic.
        s: positions z/l in [0, 1], any shape.
        derivative: order 0 … 3 of the derivative with respect to s (divide by l^derivative for metres).

    Returns:
        The values, with the shape of ``s``.

    Source: any text on beam vibration; theory of the aquarium, docs, § 1.2.
    """
    _check_index(index)
    if derivative not in (0, 1, 2, 3):
        raise ValueError(f"derivative is {derivative}; orders 0, 1, 2 and 3 are available")
    position = np.asarray(s, dtype=np.float64)
    if not np.all((position >= 0) & (position <= 1)):
        raise ValueError("s must lie in [0, 1]")
    if index < RIGID_SHAPES:
        return _rigid_shape(index, position, derivative)
    return _elastic_shapes(np.array([index - 1]), position.ravel(), derivative).reshape(position.shape)


def free_free_shapes(count: int, s: FloatArray) -> FloatArray:
    """Return the first shapes of `free_free_shape` at positions z/l in [0, 1], shape (count, positions)."""
    rigid = [_rigid_shape(index, s, 0) for index in range(min(count, RIGID_SHAPES))]
    elastic = _elastic_shapes(np.arange(1, max(count - 1, 1)), s, 0)
    return np.concatenate([np.array(rigid).reshape(-1, len(s)), elastic])


def _check_index(index: int) -> None:
    if index < 0:
        raise ValueError(f"index is {index}; shapes are numbered from 0 (heave)")


def _rigid_shape(index: int, s: FloatArray, derivative: int) -> FloatArray:
    if derivative > index:
        return np.zeros_like(s)
    if index == 0:
        return np.ones_like(s)
    return np.sqrt(3.0) * (2 * s - 1) if derivative == 0 else np.full_like(s, 2 * np.sqrt(3.0))


def _elastic_shapes(numbers: npt.NDArray[np.int64], s: FloatArray, derivative: int) -> FloatArray:
    parity = np.where(numbers % 2 == 1, 1.0, -1.0)[:, None]
    far_half = s > 0.5
    near = np.where(far_half, 1 - s, s)
    value = _elastic_shapes_near(numbers, parity, near, derivative)
    mirrored: FloatArray = np.where(far_half, parity * (-1.0) ** derivative * value, value)
    return mirrored


def _elastic_shapes_near(
    numbers: npt.NDArray[np.int64], parity: FloatArray, s: FloatArray, derivative: int
) -> FloatArray:
    """Evaluate shapes for s ≤ 1/2, where every term is bounded by one or two."""
    offset = np.array([_single_root_offset(number) for number in map(int, numbers)])[:, None]
    half_waves = numbers[:, None] + 0.5
    root = half_waves * np.pi + offset
    ratio = parity * np.exp(-root)
    decaying = (parity * np.exp(-root * (1 - s)) + (-1.0) ** derivative * np.exp(-root * s)) / (1 + ratio)
    sigma = (1 - ratio) / (1 + ratio)
    # A quarter of the bits of s times the half-integer is exact, so turns are dropped without rounding.
    leading = s.astype(np.float32).astype(np.float64)
    turns = np.fmod(half_waves * leading, 2.0) + half_waves * (s - leading)
    phase = np.pi * turns + offset * s
    cosine, sine = np.cos(phase), np.sin(phase)
    # d/dθ turns (cos, sin) into (−sin, cos).
    wave = [cosine - sigma * sine, -sine - sigma * cosine, -cosine + sigma * sine, sine + sigma * cosine][derivative]
    return root**derivative * (decaying + wave)
