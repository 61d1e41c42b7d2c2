"""Projections of the dry shapes on the cosines of the tank, in closed form."""

from __future__ import annotations

import functools
import math

import numpy as np
from numpy.polynomial.legendre import leggauss

from hydroelastic.modal.beam.dry_modes import free_free_shape, free_free_wavenumber
from hydroelastic.modal.beam.floating_beam import FloatingBeam
from hydroelastic.physics.arrays import FloatArray

_RESONANCE = 1e-3
_POINTS = 32


def cosine_moments(beam: FloatingBeam, index: int, wavenumbers: FloatArray) -> FloatArray:
    """Return c_n = ∫ W cos k_n x dx over the beam, W normalised to ∫W² dz = l.

        c_n = [k² W' cos kx + k³ W sin kx]_{x₁}^{x₂} / (k⁴ − κ⁴)

    from W'''' = κ⁴ W and free ends; where k is within 0.1 % of κ the quotient is 0/0 and is integrated by Gauss points.

    Args:
        index: shape of `free_free_shape`.
        wavenumbers: k, 1/m, zero allowed, shape (n,).

    Returns:
        Moments, m, shape (n,).

    Source: theory of the aquarium, docs, § 1.2.
    """
    k = np.asarray(wavenumbers, dtype=np.float64)
    kappa = free_free_wavenumber(index) / beam.length
    near = np.abs(k - kappa) <= _RESONANCE * kappa
    small = k * beam.length < _RESONANCE
    by_points = near | small
    moments = np.empty_like(k)
    if by_points.any():
        moments[by_points] = _integrated(beam, index, k[by_points])
    moments[~by_points] = _closed_form(beam, index, kappa, k[~by_points])
    return moments


@functools.lru_cache(maxsize=2048)
def tip_values(index: int) -> tuple[FloatArray, FloatArray]:
    """Return W and dW/ds at the left and the right tip, each of shape (2,); do not write to them."""
    ends = np.array([0.0, 1.0])
    return free_free_shape(index, ends), free_free_shape(index, ends, 1)


def _closed_form(beam: FloatingBeam, index: int, kappa: float, k: FloatArray) -> FloatArray:
    value, slope = tip_values(index)
    left, right = k * beam.start, k * (beam.start + beam.length)
    slopes = (slope[1] * np.cos(right) - slope[0] * np.cos(left)) / beam.length
    values = value[1] * np.sin(right) - value[0] * np.sin(left)
    # Divided by k³ first: k⁴ of a distant cosine overflows nothing, and κ = 0 is the rigid shape.
    moments: FloatArray = (slopes / k + values) / (k * (1 - (kappa / k) ** 4))
    return moments


def _integrated(beam: FloatingBeam, index: int, k: FloatArray) -> FloatArray:
    # In steps: finding the points takes longer than the integrals.
    nodes, weights = _gauss_points(_POINTS * math.ceil((24 + 2 * index) / _POINTS))
    s = (nodes + 1) / 2
    waves = np.cos(np.outer(k, beam.start + beam.length * s))
    moments: FloatArray = beam.length / 2 * waves @ (weights * free_free_shape(index, s))
    return moments


_gauss_points = functools.cache(leggauss)
