"""Errors of functionals of waves, from products of what the mesh misses of a wave and of its dual solution.

The Galerkin method changes a functional of ψ with the dual solution z by A_λ(z − z_h, ψ − ψ_h), see
`functional_errors`: of both functions only the parts of higher degree are left. In each cell |A_λ| ≤ √(E_z E_ψ) with
the missed energies E of `spectral_error`; but where z and ψ are of different phase, or orthogonal to each other, far
less is left of the product. As the missed energy follows from that in the last degrees which are there, the missed
product follows from that in the two last ones: with the coefficients of both gradients there

    |A_λ(z − z_h, ψ − ψ_h)| ≈ √(E_z E_ψ) |Re Σ wᵢ zᵢψᵢ| / √(Σ|wᵢ zᵢ²| Σ|wᵢ ψᵢ²|),

weighted by wᵢ = ρ (det/sᵢ²) w of `complex_scaling`. In the absorbing layer, where ψ oscillates, the phase of the
products turns from degree to degree, and their modulus counts. There an outgoing wave e^{ikx̃ + ky} has
(∂ψ/∂x̃)² + (∂ψ/∂y)² = 0: of the energy that the layer misses hardly anything reaches the waves.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from hydroelastic.fem.liquid import cell_values
from hydroelastic.fem.open_water.field_model import OpenModel
from hydroelastic.fem.spectral_error import missing_energy


def product_errors(model: OpenModel, duals: np.ndarray, potentials: np.ndarray) -> np.ndarray:
    """Estimate |Re A_λ(z − z_h, ψ − ψ_h)| of pairs of z and ψ, summed over the cells (collective)."""
    layer = model.in_absorbing_layer
    cells = _cells(model, duals, potentials, lambda product: np.where(layer, np.abs(product), np.abs(product.real)))
    away, tips = model.summed_over_cells(cells)
    total: np.ndarray = away + tips
    return total


def square_errors(model: OpenModel, potentials: np.ndarray, layer_weight: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Estimate |A_λ(ψ − ψ_h, ψ − ψ_h)| in cells away from tips and at tips (collective)."""
    cells = _cells(model, potentials, potentials, np.abs)
    return model.summed_over_cells(cells * np.where(model.in_absorbing_layer, layer_weight[:, None], 1.0))


def _cells(
    model: OpenModel, duals: np.ndarray, potentials: np.ndarray, size: Callable[[np.ndarray], np.ndarray]
) -> np.ndarray:
    """The estimate of each own cell, with a size of the complex products in it, shape (pairs, cells)."""
    count, weights = len(duals), model.gradient_weights
    vectors = [model.pencil.vector(part) for psi in (*duals, *potentials) for part in (psi.real, psi.imag)]
    energies, products = [], []
    for coefficients in model.gradient_coefficients(cell_values(model.pencil.liquid, vectors)):
        # Those of each axis in turn.
        turned = np.repeat(weights, coefficients.shape[2] // weights.shape[1], axis=1)
        waves = coefficients[::2] + 1j * coefficients[1::2]
        energies.append((np.abs(turned) * np.abs(waves) ** 2).sum(axis=2))
        products.append(size((turned * waves[:count] * waves[count:]).sum(axis=2)))
    missed, last = np.sqrt(missing_energy(*energies)), np.sqrt(energies[0] + energies[1])
    # Cells at rest have no energy in any degree.
    parts = (products[0] + products[1]) / np.maximum(last[:count] * last[count:], np.finfo(float).tiny)
    cells: np.ndarray = missed[:count] * missed[count:] * parts
    return cells
