"""The liquid under the whole surface y = 0 as one symmetric matrix: ψ from the normal displacement."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from hydroelastic.modal.beam.dry_modes import free_free_wavenumber
from hydroelastic.modal.beam.floating_beam import FloatingBeam
from hydroelastic.physics.arrays import FloatArray

GRADING = 12
"""Order of the graded substitution: its derivative vanishes like (distance)^(GRADING − 1) at the tips."""

_BETA = math.factorial(GRADING - 1) ** 2 / math.factorial(2 * GRADING - 1)
"""Euler's B(GRADING, GRADING)."""

_PEAK = 0.25 ** (GRADING - 1) / _BETA
"""Largest spacing in the middle of a segment over the mean one."""

_FEWEST_NODES = 48
_PER_DEPTH = 1.4
_PER_WAVELENGTH = 3.5


@dataclass(frozen=True, kw_only=True)
class SurfaceOperator:
    """Nyström matrix of N: η → ψ on y = 0, with ψ_y = η, walls and a bottom that let nothing through.

    ∫∫ f(x) N(x, x') g(x') dx dx' ≈ (weights·f)ᵀ kernel (weights·g), exact to rounding for functions that are
    smooth on each side of the tips, singular behaviour at the tips included.
    """

    positions: FloatArray  # nodes x, m, shape (n,)
    weights: FloatArray  # quadrature weights of ∫₀ᴸ dx, m, shape (n,)
    kernel: FloatArray  # symmetric matrix, shape (n, n), dimensionless
    on_beam: np.ndarray  # which nodes lie under the beam, shape (n,)
    beam_coordinate: FloatArray  # s = (x − x₁)/l of those nodes, shape (on_beam.sum(),)


@dataclass(frozen=True, kw_only=True)
class _Nodes:
    """Nodes kept as end point plus offset, so that distances near a tip do not cancel."""

    anchor: FloatArray
    offset: FloatArray
    weight: FloatArray


def nodes_needed(beam: FloatingBeam, squared_frequency: float, largest_index: int = 2) -> list[int]:
    """Return the node counts of the left gap, the beam and the right gap for a wanted frequency.

    The spacing follows the depth H (the kernel is smooth on that scale), the gravity wavelength 2π g/ω² on the water
    and the wavelength 2π/κ of the shapes under the beam.

    Args:
        squared_frequency: largest λ = ω² that must be resolved, rad²/s².
        largest_index: largest index of `free_free_shape` that must be resolved.

    Returns:
        Three counts; zero for a gap that is not there.
    """
    wavelength = 2 * math.pi * beam.gravity / squared_frequency if squared_frequency > 0 else math.inf
    by_depth = beam.depth / _PER_DEPTH
    by_wave = min(by_depth, wavelength / _PER_WAVELENGTH)
    kappa = free_free_wavenumber(largest_index) / beam.length
    by_shape = 2 * math.pi / kappa / _PER_WAVELENGTH if kappa > 0 else math.inf
    spacings = [by_wave, min(by_depth, by_shape), by_wave]
    lengths = [beam.left_gap, beam.length, beam.right_gap]
    return [
        0 if length == 0 else max(_FEWEST_NODES, math.ceil(_PEAK * length / spacing))
        for length, spacing in zip(lengths, spacings, strict=True)
    ]


def surface_operator(beam: FloatingBeam, node_counts: list[int]) -> SurfaceOperator:
    """Assemble the kernel

        N(x, x') = −(1/π) ln|2 (cos θ − cos θ')| + (2/L) Σ (coth k_n H − 1)/k_n cos k_n x cos k_n x',  θ = π x/L,

    by the Martensen–Kussmaul rule for the logarithm on the doubled circle, on nodes graded toward every segment end.

    Args:
        node_counts: nodes on the left gap, beam and right gap (`nodes_needed`).

    Source: theory of the aquarium, docs, § 0 (kernel) and § 3 (method B); R. Kress, "Linear Integral Equations".
    """
    nodes = _graded_nodes(beam, node_counts)
    positions = nodes.anchor + nodes.offset
    left, on, _ = node_counts
    under = np.zeros(len(positions), dtype=bool)
    under[left : left + on] = True
    middle = _graded_unit(on)
    kernel = _logarithmic_part(beam.tank_length, nodes) + _depth_part(beam, positions)
    return SurfaceOperator(
        positions=positions, weights=nodes.weight, kernel=kernel, on_beam=under, beam_coordinate=middle[0] + middle[1]
    )


def _graded_unit(count: int) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return end points (0 or 1), offsets from them, and weights of ``count`` graded nodes on [0, 1]."""
    u = (np.arange(count) + 0.5) / max(count, 1)
    from_start = _incomplete_beta(u)
    from_end = from_start[::-1]
    second_half = u > 0.5
    anchor = np.where(second_half, 1.0, 0.0)
    offset = np.where(second_half, -from_end, from_start)
    slope = (u * (1 - u)) ** (GRADING - 1) / _BETA
    return anchor, offset, slope / max(count, 1)


def _incomplete_beta(u: FloatArray) -> FloatArray:
    """Return ∫₀ᵘ (t(1 − t))^(p − 1) dt/B(p, p), p = `GRADING`: the chance of p or more of 2p − 1 trials."""
    trials = 2 * GRADING - 1
    return np.sum([math.comb(trials, k) * u**k * (1 - u) ** (trials - k) for k in range(GRADING, trials + 1)], axis=0)


def _graded_nodes(beam: FloatingBeam, counts: list[int]) -> _Nodes:
    ends = np.array([0.0, beam.left_gap, beam.tank_length - beam.right_gap, beam.tank_length])
    anchors, offsets, weights = [], [], []
    for low, high, count in zip(ends[:-1], ends[1:], counts, strict=True):
        anchor, offset, weight = _graded_unit(count)
        anchors.append(np.where(anchor == 0.0, low, high))
        offsets.append((high - low) * offset)
        weights.append((high - low) * weight)
    return _Nodes(anchor=np.concatenate(anchors), offset=np.concatenate(offsets), weight=np.concatenate(weights))


def _logarithmic_part(tank_length: float, nodes: _Nodes) -> FloatArray:
    count = len(nodes.anchor)
    step = np.pi / count
    index = np.arange(count)
    difference = _chord(nodes.anchor, nodes.offset, tank_length, -1)
    total = _mirrored_sum(nodes, tank_length)
    parameter_difference = np.abs(2 * np.sin((index[:, None] - index[None, :]) * step / 2))
    parameter_sum = 2 * np.sin((index[:, None] + index[None, :] + 1) * step / 2)
    np.fill_diagonal(difference, np.pi / tank_length * nodes.weight / step)
    np.fill_diagonal(parameter_difference, 1.0)
    ratio = np.log(difference / parameter_difference) + np.log(total / parameter_sum)
    rule = _martensen_kussmaul(count) / step
    singular = rule[np.abs(index[:, None] - index[None, :])] + rule[index[:, None] + index[None, :] + 1]
    kernel: FloatArray = -(singular + ratio) / np.pi
    return kernel


def _chord(anchor: FloatArray, offset: FloatArray, tank_length: float, sign: int) -> FloatArray:
    """Return |2 sin((θ ± θ')/2)| from end points and offsets."""
    distance = (anchor[:, None] + sign * anchor[None, :]) + (offset[:, None] + sign * offset[None, :])
    chord: FloatArray = np.abs(2 * np.sin(np.pi * distance / (2 * tank_length)))
    return chord


def _mirrored_sum(nodes: _Nodes, tank_length: float) -> FloatArray:
    """Return 2 sin((θ + θ')/2), measured from the nearer wall."""
    near = _chord(nodes.anchor, nodes.offset, tank_length, 1)
    far = _chord(tank_length - nodes.anchor, -nodes.offset, tank_length, 1)
    positions = nodes.anchor + nodes.offset
    chord: FloatArray = np.where(positions[:, None] + positions[None, :] > tank_length, far, near)
    return chord


def _martensen_kussmaul(count: int) -> FloatArray:
    """Return the weights of ∫ ln|2 sin((t − τ)/2)| g(τ) dτ on 2·count equal steps, by distance 0 … 2·count − 1."""
    harmonics = np.zeros(count + 1)
    harmonics[1:count] = 1 / np.arange(1, count)
    harmonics[count] = 1 / count
    # irfft of 1/m gives the cosine sum; its last harmonic carries the half weight of the rule.
    return -np.pi * np.fft.irfft(harmonics, 2 * count)


def _depth_part(beam: FloatingBeam, positions: FloatArray) -> FloatArray:
    count = math.ceil(19 * beam.tank_length / (math.pi * beam.depth)) + 1
    wavenumbers = np.arange(1, count + 1) * np.pi / beam.tank_length
    exponents = np.minimum(2 * wavenumbers * beam.depth, 700.0)
    factors = 2 / beam.tank_length * 2 / np.expm1(exponents) / wavenumbers
    waves = np.cos(np.outer(positions, wavenumbers))
    depth: FloatArray = (waves * factors) @ waves.T
    return depth
