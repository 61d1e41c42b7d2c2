"""All dry modes of a free-free beam at once: what the scripts of the peers load the liquid with."""

from __future__ import annotations

import numpy as np

from hydroelastic.modal.beam.dry_modes import RIGID_SHAPES, free_free_roots
from hydroelastic.physics.arrays import FloatArray


def dry_shapes(count: int, s: FloatArray) -> FloatArray:
    """Evaluate the shapes of `hydroelastic.modal.free_free_shape`, in one go.

    W_j(s) = e^{−bs} ± e^{−b(1−s)} + cos bs − σ sin bs but for what is scaled out, with b = κ_j l, from the nearer end.
    """
    roots = free_free_roots(max(count - RIGID_SHAPES, 0)).reshape(-1, *(1 for _ in s.shape))
    parity = np.where(np.arange(len(roots)) % 2 == 0, 1.0, -1.0).reshape(roots.shape)
    ratio = parity * np.exp(-roots)
    sigma = (1.0 - ratio) / (1.0 + ratio)
    far = s > 0.5
    near = np.where(far, 1.0 - s, s)
    phase = roots * near
    decay = np.exp(-phase)
    elastic = (decay + ratio / decay) / (1.0 + ratio) + np.cos(phase) - sigma * np.sin(phase)
    rigid = np.stack([np.ones_like(s), np.sqrt(3.0) * (2.0 * s - 1.0)])
    return np.concatenate([rigid[:count], np.where(far, parity * elastic, elastic)])
