"""Round plates bent by the pressure and the forces that the modes of the field model leave.

The dry modes k beyond those of the model have amplitudes aₖ = fₖ/(Kₖ − λmₖ), with the force fₖ of the waves and of
springs and dampers in the motion by the modes of the model. What they add to the waves is of second order: its effect
on an outgoing wave is, by reciprocity, Σ aₖ times the pressure on mode k of the wave that returns. Derivatives of the
deflection then converge as fast as the pressure allows (mode acceleration, see `beam_loads`).
"""

from __future__ import annotations

import numpy as np

from hydroelastic.fem.open_water.frequency import OpenResponse
from hydroelastic.fem.open_water.plate_modes import PlateModes


def bent(modes: PlateModes, response: OpenResponse, motions: np.ndarray, drag: np.ndarray) -> np.ndarray:
    """Return the amplitudes of all modes of a plate in each wave of a unit of c, shape (incident, modes)
    (collective)."""
    return modes.amplitudes(response.squared.real, _pressures(modes, response, motions), motions, drag)


def bent_without_drag(modes: PlateModes, response: OpenResponse) -> np.ndarray:
    """Return the same of the motions of the response, without drag (collective)."""
    motions = response.motions
    return bent(modes, response, motions, np.zeros((len(motions), len(response.model.outside.drag))))


def omitted_effect(modes: PlateModes, response: OpenResponse) -> np.ndarray:
    """Return the effect of the further modes on the amplitude of the outgoing wave over the incident one, shape
    (incident,) (collective)."""
    motions = response.motions
    pressures, drag = _pressures(modes, response, motions), np.zeros((len(motions), len(response.model.outside.drag)))
    amplitudes = modes.amplitudes(response.squared.real, pressures, motions, drag)
    further = (amplitudes * pressures)[:, modes.count :].sum(axis=1)
    return np.asarray(np.abs(further) / response.incidence.powers[response.incident])


def omitted_deflections(modes: PlateModes, response: OpenResponse, dual: np.ndarray) -> np.ndarray:
    """Return what the waves radiated by the further modes change motions by, by their dual solutions (collective)."""
    pressures = response.model.pencil.products(response.radiated_by(dual), modes.loads[modes.count :])
    further = bent_without_drag(modes, response)[:, modes.count :]
    return np.asarray(abs(response.squared) * np.abs(pressures @ further.T))


def _pressures(modes: PlateModes, response: OpenResponse, motions: np.ndarray) -> np.ndarray:
    """∫ρΨ on all modes of all waves, shape (incident, modes)."""
    scattered = response.model.pencil.products(response.scattered_by(motions), modes.loads)
    squared, surface = response.squared.real, modes.surface
    if squared not in modes.given:
        waves = np.array([wave.field(surface.points, surface.layers)[0] for wave in response.incidence.planes])
        modes.given[squared] = surface.integrals(waves, surface.shapes)
    return modes.given[squared][response.incident] + scattered
