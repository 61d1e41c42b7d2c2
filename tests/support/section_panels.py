"""Added masses of a rigid section by constant source panels, far above the waves: a second opinion on closed forms.

ρψ and ∂ψ/∂y are continuous on y = 0, so that a source q on one side has an image A q there,
A = (ρ_other − ρ)/(ρ₁ + ρ₂), and shines through with q (1 − A); without an upper liquid A = −1.
"""

from __future__ import annotations

import numpy as np


def added_masses(outline: np.ndarray, density_below: float, density_above: float = 0.0) -> np.ndarray:
    """Added masses in heave, sway and roll about the origin, kg/m, kg and kg·m.

    Args:
        outline: ends of the panels as x + iy, counterclockwise, none on both sides of y = 0; with one liquid the part
            below it, from left to right, else closed.
        density_below: ρ₂.
        density_above: ρ₁.

    Returns:
        Symmetric in theory, shape (3, 3).
    """
    start, end = outline[:-1], outline[1:]
    centre, length, angle = (start + end) / 2, np.abs(end - start), np.angle(end - start)
    below = centre.imag < 0
    density = np.where(below, density_below, density_above)
    other = np.where(below, density_above, density_below)
    image = (other - density) / (other + density)
    same = below[:, None] == below[None, :]
    normal = -1j * np.exp(1j * angle)
    potential, velocity = _panel(centre, start, length, angle)
    velocity[np.diag_indices(len(centre))] = np.pi * np.conj(normal)
    reflected, backward = _panel(centre, np.conj(start), length, -angle)
    potential = np.where(same, potential + image * reflected, (1 - image) * potential)
    velocity = np.where(same, velocity + image * backward, (1 - image) * velocity)
    flux = np.array([normal.imag, normal.real, centre.real * normal.imag - centre.imag * normal.real])
    sources = np.linalg.solve((velocity * normal[:, None]).real, flux.T)
    return -(flux * density * length) @ (potential @ sources)


def _panel(points: np.ndarray, start: np.ndarray, length: np.ndarray, angle: np.ndarray) -> tuple[np.ndarray, ...]:
    """∫ln r and its gradient u − iv at the points, for panels of strength 1."""
    near = (points[:, None] - start) * np.exp(-1j * angle)
    far = near - length
    first, last = np.log(near), np.log(far)
    return (near * first - far * last).real - length, np.exp(-1j * angle) * (first - last)
