"""The mean drift force on solids of revolution, by the waves of all azimuthal orders, and its error.

About an axis the dual solution of the amplitude aₙ = i I(φ)/P is the scattered wave itself: δaₙ = (i/P) A_λ(ψ − ψ_h,
ψ − ψ_h), see `drift_errors`. Without absorption |1 + 2aₙ| = 1, which errors hardly change: those along
d = (1 + 2aₙ)/|1 + 2aₙ| and across it are estimated apart, for the drift force depends on the phases of neighbouring
orders relative to each other.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hydroelastic.fem.open_water.bent_plates import omitted_effect
from hydroelastic.fem.open_water.drift_errors import between_places
from hydroelastic.fem.open_water.frequency import OpenResponse
from hydroelastic.fem.open_water.product_errors import product_errors
from hydroelastic.fem.open_water.response_errors import unmeshed_error
from hydroelastic.modal.liquid.travelling_waves import travelling_waves
from hydroelastic.modal.tank_estimates import two_layers
from hydroelastic.physics.tank import Tank

# Nothing moves below: a quotient by it is finite.
_LEAST = 1e-200
# The square of a wave that is lost in rounding, and is no measure of errors: of high orders in long waves.
_ROUNDED = float(np.finfo(float).eps) ** 2


def wave_errors(
    responses: Sequence[OpenResponse], omegas: np.ndarray, places: list[int], reduced: np.ndarray
) -> np.ndarray:
    """Estimate errors of aₙ of waves on one level by the mesh, along d and across it, and by other causes
    (collective)."""
    if len(responses[0].incidence.planes) > 1:
        return np.zeros((len(responses), 3))
    sizes = np.maximum(np.abs([one.partial_waves()[0, 0] for one in responses]) ** 2, _ROUNDED)
    missed = [_missed_wave(responses[place]) / sizes[place] for place in places]
    meshed = between_places(omegas, places, np.array(missed)) * sizes[:, None]
    return np.column_stack([meshed, reduced + unmeshed_error(responses[0].model)])


def _missed_wave(response: OpenResponse) -> np.ndarray:
    wave, power = response.outgoing()[0, 0], response.incidence.powers[0]
    # 1 + 2a is twice the outgoing wave.
    turn = 1j / power * wave.conj() / max(abs(wave), _LEAST)
    psi = response.scattered
    along, across = product_errors(response.model, np.array([turn * psi[0], -1j * turn * psi[0]]), psi[[0, 0]])
    further = response.reflected * response.scattered_powers[0] / power
    further += sum(float(omitted_effect(modes, response)[0]) for modes in response.model.plate_modes.values())
    return np.array([along, across]) + further


def drift_of_orders(
    widths: np.ndarray, waves: np.ndarray, errors: np.ndarray, residuals: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return the mean force along the waves per square of their amplitude of each pair of successive orders, N/m²,
    shape (n, orders − 1), and the error of their sum, shape (n,).

    The momentum that the scattered waves leave is F = −(4/k) E (c_g/c) Re Σ_{n≥0} [aₙ + aₙ₊₁ + 2aₙāₙ₊₁] of waves to the
    right, E = ½ρgA² (Maruo 1960), with E c_g/c = ½ω²k²N/η̂² of a wave of unit elevation. With the power lost in an
    order, Re aₙ + |aₙ|², the terms are those of −|aₙ − aₙ₊₁|², which tell the error by the last cause.
    """
    own, following = waves[:, :-1], waves[:, 1:]
    forces: np.ndarray = -widths[:, None] * (own + following + 2.0 * own * following.conj()).real
    turned = 1.0 + 2.0 * waves
    beside = np.zeros_like(turned)
    beside[:, :-1] += turned[:, 1:]
    beside[:, 1:] += turned[:, :-1]
    slopes = beside.conj() * turned / np.maximum(np.abs(turned), _LEAST)
    along, across, rest = np.moveaxis(errors, 2, 0)
    by_mesh = (np.abs(slopes.real) * along + np.abs(slopes.imag) * across).sum(axis=1)
    lost = 2.0 * rest * np.abs(waves.real + np.abs(waves) ** 2) + np.minimum(0.25 * np.abs(residuals), rest)
    by_rest = 2.0 * np.abs(own - following) * (rest[:, 1:] + rest[:, :-1]) + lost[:, 1:] + lost[:, :-1]
    error: np.ndarray = widths * (by_mesh + by_rest.sum(axis=1))
    return forces, error


def drift_widths(tank: Tank, omega: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return k, 1/m, and (4/k) E (c_g/c)/A², N/m², of waves on one level, each of shape (n,)."""
    waves = [travelling_waves(two_layers(tank), float(one))[0] for one in omega]
    wavenumbers = np.array([wave.wavenumber for wave in waves])
    momenta = [wave.wavenumber**2 * wave.energy / wave.elevation**2 for wave in waves]
    return wavenumbers, 2.0 * omega**2 * np.array(momenta) / wavenumbers
