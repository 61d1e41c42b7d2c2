"""All older estimates of the first elastic tone, side by side."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from hydroelastic.modal.beam.added_mass import deep_open_added_mass, shallow_added_mass, strip_added_mass
from hydroelastic.modal.beam.floating_beam import FloatingBeam
from hydroelastic.modal.beam.grammel import beam_quotients, best_term, one_term_root, term_tones
from hydroelastic.modal.beam.rayleigh import rayleigh, rayleigh_dry_mode, rayleigh_lid, rayleigh_pressure_release
from hydroelastic.modal.estimate import (
    Estimate,
    NoEstimateError,
    added_mass_from_frequency,
    frequency_from_added_mass,
    without_number,
)

_SHALLOW = 0.1
_MOST_SPREAD = 1e10


def all_estimates(beam: FloatingBeam, terms: int = 32) -> dict[str, Estimate]:
    """Return every estimate of the first elastic tone by its name; a method without meaning says so in its note.

    Args:
        terms: N of the N-term forms, at least 1.

    Returns:
        ``grammel_1`` (the paper's single cosine), ``grammel_best`` (the cosine that projects most on dry mode 1),
        ``grammel_n``, ``grammel_quotient``, ``rayleigh`` (heave, pitch, dry mode 1, free surface),
        ``rayleigh_dry_mode``, ``rayleigh_lid``, ``rayleigh_pressure_release``, ``deep_water``, ``strip``,
        ``shallow``, ``paper_no_volume_term``.
    """
    if terms < 1:
        raise ValueError(f"terms is {terms}; at least one cosine is needed")
    methods: dict[str, Callable[[], Estimate]] = {
        "grammel_1": lambda: _one_term(beam, 1),
        "grammel_best": lambda: _one_term(beam, best_term(beam)),
        "grammel_n": lambda: _many_terms(beam, terms),
        "grammel_quotient": lambda: _quotient(beam),
        "rayleigh": lambda: rayleigh(beam),
        "rayleigh_dry_mode": lambda: rayleigh_dry_mode(beam),
        "rayleigh_lid": lambda: rayleigh_lid(beam),
        "rayleigh_pressure_release": lambda: rayleigh_pressure_release(beam),
        "deep_water": lambda: _deep_water(beam),
        "strip": lambda: _strip(beam),
        "shallow": lambda: _shallow(beam),
        "paper_no_volume_term": lambda: _without_volume_term(beam, terms),
    }
    return {name: _guarded(name, method) for name, method in methods.items()}


_UNIFORM_MODE = "its dry mode 1 is that of a uniform beam"
_NOT_FOR_JOINTS = {
    "grammel_1": "one cosine takes one EI and one m for the whole beam",
    "grammel_best": "one cosine takes one EI and one m for the whole beam",
    "grammel_n": "its cosines take one EI and one m for the whole beam, and no joints",
    "grammel_quotient": _UNIFORM_MODE,
    "rayleigh": _UNIFORM_MODE,
    "rayleigh_dry_mode": _UNIFORM_MODE,
    "rayleigh_lid": _UNIFORM_MODE,
    "rayleigh_pressure_release": _UNIFORM_MODE,
    "deep_water": "its added mass is that of the dry mode 1 of a uniform beam",
    "strip": "it knows one dry wavenumber, and a stepped beam has several",
    "shallow": "its added mass is that of the dry mode 1 of a uniform beam",
    "paper_no_volume_term": "its cosines take one EI and one m for the whole beam, and no joints",
}


def estimates_of_jointed_beams() -> dict[str, Estimate]:
    """Return every estimate by its name for a stepped or jointed beam: none has a number, each says why."""

    def refused(reason: str) -> Callable[[], Estimate]:
        def method() -> Estimate:
            raise NoEstimateError(f"{reason}; this beam has sections or joints")

        return method

    return {name: _guarded(name, refused(reason)) for name, reason in _NOT_FOR_JOINTS.items()}


def _guarded(name: str, method: Callable[[], Estimate]) -> Estimate:
    try:
        return method()
    except (NoEstimateError, np.linalg.LinAlgError) as reason:
        return without_number(f"Method {name}.", str(reason))


def _one_term(beam: FloatingBeam, number: int) -> Estimate:
    omega = one_term_root(beam, number)
    note = (
        f"One cosine, n = {number}, root below its first dry pole: neglects every other wave of the liquid and the "
        "balance of volume."
    )
    added_mass = added_mass_from_frequency(beam, omega)
    if added_mass < 0:
        note += " The root lies above the dry frequency: this cosine says nothing of the tone."
    return Estimate(omega=omega, added_mass_per_length=added_mass, note=note, bound="none")


def _many_terms(beam: FloatingBeam, terms: int) -> Estimate:
    omega, index = _term_tone(beam, terms, volume_term=True)
    note = f"Cosines i = 0 … {terms}: neglects the waves beyond, with an error O(N⁻²)."
    needed = max(4 * beam.tank_length / beam.length, omega**2 * beam.tank_length / (math.pi * beam.gravity))
    if terms < needed:
        note += f" About {math.ceil(needed)} terms are needed before it sees the beam and the gravity waves."
    return Estimate(
        omega=omega,
        added_mass_per_length=added_mass_from_frequency(beam, omega),
        note=note,
        bound="above_mode_index",
        mode_index=index,
    )


def _without_volume_term(beam: FloatingBeam, terms: int) -> Estimate:
    omega, _ = _term_tone(beam, terms, volume_term=False)
    return Estimate(
        omega=omega,
        added_mass_per_length=added_mass_from_frequency(beam, omega),
        note=f"The paper's set, cosines i = 1 … {terms}: without the volume term its limit for N → ∞ is wrong.",
        bound="none",
    )


def _term_tone(beam: FloatingBeam, terms: int, *, volume_term: bool) -> tuple[float, int]:
    tones = term_tones(beam, terms, volume_term=volume_term)
    squared = tones.elastic_squared_frequency
    if squared > _MOST_SPREAD * tones.squared_frequencies[0]:
        raise NoEstimateError("the elastic tone is too far above the lowest mode for double precision")
    return math.sqrt(squared), tones.elastic_index


def _quotient(beam: FloatingBeam) -> Estimate:
    result = beam_quotients(beam)
    omega = math.sqrt(result.grammel)
    trials = "heave, pitch and dry mode 1" if beam.hydrostatic else "dry mode 1 with its recoil"
    return Estimate(
        omega=omega,
        added_mass_per_length=added_mass_from_frequency(beam, omega),
        note=f"Grammel's quotient, {trials}; space: {result.space}; neglects gravity waves.",
        bound="above_mode_index" if beam.covers_tank else "above_pressure_release_tone",
        mode_index=result.index,
    )


def _deep_water(beam: FloatingBeam) -> Estimate:
    return _from_constant(
        beam,
        deep_open_added_mass(beam),
        "Dry mode 1, ψ = 0 around the beam, no walls, no bottom: neglects recoil and gravity waves as well.",
    )


def _strip(beam: FloatingBeam) -> Estimate:
    return _from_constant(
        beam,
        strip_added_mass(beam),
        "Added mass of a travelling wave of the dry wavenumber: neglects the ends of the beam, recoil and gravity "
        "waves; in deep water 65 % above that of the dry mode.",
    )


def _shallow(beam: FloatingBeam) -> Estimate:
    note = (
        "Dry mode 1 on water much shallower than the beam, ψ = 0 around it: neglects terms O((H/l)²), recoil and waves."
    )
    if beam.depth > _SHALLOW * beam.length:
        return without_number(note, f"the depth exceeds {_SHALLOW} of the length")
    if beam.covers_tank:
        return without_number(note, "no surface is free where the pressure could be released")
    return _from_constant(beam, shallow_added_mass(beam), note)


def _from_constant(beam: FloatingBeam, added_mass: float, note: str) -> Estimate:
    return Estimate(
        omega=frequency_from_added_mass(beam, added_mass), added_mass_per_length=added_mass, note=note, bound="none"
    )
