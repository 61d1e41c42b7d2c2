"""Rayleigh estimates of the first elastic tone, with and without the recoil of the rigid body."""

from __future__ import annotations

import math

import numpy as np

from hydroelastic.modal.beam.added_mass import deep_open_constant, lid_added_mass
from hydroelastic.modal.beam.dry_modes import RIGID_SHAPES
from hydroelastic.modal.beam.floating_beam import FloatingBeam
from hydroelastic.modal.beam.gravity_added_mass import gravity_tones
from hydroelastic.modal.beam.pressure_release import pressure_release_added_mass
from hydroelastic.modal.beam.tone_pencil import Tones, pencil_modes
from hydroelastic.modal.estimate import (
    Estimate,
    NoEstimateError,
    added_mass_from_frequency,
    frequency_from_added_mass,
    without_number,
)


def rayleigh_lid(beam: FloatingBeam) -> Estimate:
    """Return the estimate with dry mode 1 under a rigid lid (η = 0 on the water around the beam).

    Returns:
        ω² = (EI κ⁴ + s ρ g)/(m + m_a) with `lid_added_mass`.

    Source: theory of the aquarium, docs, § 2 (lid).
    """
    # One trial function bounds the lowest mode; without hydrostatics pitch is a zero mode and must be excluded,
    # which symmetry does for a centred beam.
    bounded = beam.hydrostatic or beam.is_centred
    return _from_added_mass(
        beam,
        lid_added_mass(beam),
        "Dry mode 1 alone, water around the beam held flat: neglects waves, recoil of the rigid body and the change "
        "of shape.",
        bounded,
    )


def rayleigh_pressure_release(beam: FloatingBeam) -> Estimate:
    """Return the three-shape Ritz estimate (heave, pitch, dry mode 1) with ψ = 0 around the beam.

    Returns:
        The estimate; it lies above the tone of the same index of the problem with ψ = 0 around the beam.

    Source: theory of the aquarium, docs, § 2 (psi0, rigid-body recoil).
    """
    note = "Heave, pitch and dry mode 1 with ψ = 0 around the beam: neglects gravity waves and the change of shape."
    try:
        tones = pressure_release_tones(beam, RIGID_SHAPES + 1)
    except NoEstimateError as reason:
        return without_number(note, str(reason))
    omega = math.sqrt(tones.elastic_squared_frequency)
    return Estimate(
        omega=omega,
        added_mass_per_length=added_mass_from_frequency(beam, omega),
        note=note,
        bound="above_pressure_release_tone",
        mode_index=tones.elastic_index,
    )


def pressure_release_tones(beam: FloatingBeam, count: int) -> Tones:
    """Return the tones of the first dry shapes with ψ = 0 around the beam; many shapes give the exact limit g → 0.

    Args:
        count: number of shapes, heave and pitch included, at least 3.

    Returns:
        The tones, λ in rad²/s².
    """
    stiffness = beam.dry_stiffnesses(count)
    mass = pressure_release_added_mass(beam, count) + beam.mass_per_length * np.eye(count)
    # M is well conditioned here, so K x = λ M x keeps the digits of the high tones of a nearly rigid beam.
    squared, vectors = pencil_modes(np.diag(stiffness), mass)
    rigid = int(np.count_nonzero(stiffness == 0))
    squared, vectors = squared[rigid:], vectors[:, rigid:]
    participation = stiffness[RIGID_SHAPES] * vectors[RIGID_SHAPES] ** 2 / squared
    return Tones(
        squared_frequencies=squared, participation=participation, elastic_index=int(np.argmax(participation)) + 1
    )


def rayleigh_dry_mode(beam: FloatingBeam) -> Estimate:
    """Return the estimate with dry mode 1 alone on water with gravity waves: ω² = (EI κ⁴ + s ρ g)/(m + m_a(ω²)).

    Returns:
        The root with the largest participation of the beam.

    Source: theory of the aquarium, docs, § 2 (`gravity`).
    """
    note = (
        "Dry mode 1 alone on water with gravity waves: neglects the recoil of the rigid body and the change of shape."
    )
    # The space holds no pitch, so without hydrostatics its count runs one ahead of that of the nonzero modes.
    return _on_waves(beam, (2,), note, 0 if beam.hydrostatic or beam.covers_tank else 1)


def rayleigh(beam: FloatingBeam) -> Estimate:
    """Return the Rayleigh–Ritz estimate with heave, pitch and dry mode 1 on water with gravity waves.

    Returns:
        The tone with the largest participation of dry mode 1; an upper bound of the exact mode of its index.

    Source: theory of the aquarium, docs, § 2 (`gravity_rigid`).
    """
    note = "Heave, pitch and dry mode 1 with the full free surface: neglects only the change of the bent shape."
    return _on_waves(beam, (0, 1, 2), note, 0)


def highest_frequency_of_interest(beam: FloatingBeam) -> float:
    """Return a λ, rad²/s², safely above the first elastic tone, for the resolution of the waves.

    The pressure-release tone with 20 % in λ to spare, or the tone with a quarter of the deep-water added mass.
    """
    try:
        return 1.2 * pressure_release_tones(beam, RIGID_SHAPES + 1).elastic_squared_frequency
    except NoEstimateError:
        least = 0.25 * deep_open_constant() * beam.density * beam.length
        return beam.first_dry_stiffness / (beam.mass_per_length + least)


def _on_waves(beam: FloatingBeam, indices: tuple[int, ...], note: str, zero_modes_ahead: int) -> Estimate:
    try:
        tones = gravity_tones(beam, indices, highest_frequency_of_interest(beam))
    except NoEstimateError as reason:
        return without_number(note, f"{reason}; see the pressure-release limit")
    omega = math.sqrt(tones.elastic_squared_frequency)
    index = tones.elastic_index - zero_modes_ahead
    return Estimate(
        omega=omega,
        added_mass_per_length=added_mass_from_frequency(beam, omega),
        note=note,
        bound="above_mode_index" if index >= 1 else "none",
        mode_index=index if index >= 1 else None,
    )


def _from_added_mass(beam: FloatingBeam, added_mass: float, note: str, bounds_lowest: bool) -> Estimate:
    return Estimate(
        omega=frequency_from_added_mass(beam, added_mass),
        added_mass_per_length=added_mass,
        note=note,
        bound="above_mode_index" if bounds_lowest else "none",
        mode_index=1 if bounds_lowest else None,
    )
