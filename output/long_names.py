"""Long names of the main numbers of summaries."""

from __future__ import annotations

_LONG_NAMES = {
    "modes.omega": "angular frequency of a mode",
    "modes.frequency_hz": "frequency of a mode",
    "modes.relative_error": "estimated relative error of the frequency of a mode",
    "modes.kind": "what moves in a mode",
    "modes.symmetry": "symmetry of a mode about the middle of the tank",
    "modes.elastic_energy_fraction": "part of the potential energy of a mode that is in bending",
    "modes.residual": "relative residual of the equations of a mode",
    "first_elastic_by_body.omega": "angular frequency of the first elastic tone",
    "first_elastic_by_body.dry_omega": "angular frequency of the first elastic tone in vacuo",
    "first_elastic_by_body.pressure_release_omega": "angular frequency of the pressure-release tone",
    "first_elastic_by_body.added_mass_per_length": "added mass of the first elastic tone",
    "estimates.omega": "first elastic tone by an older theory",
    "estimates.difference": "relative difference of an older theory from the field solution",
    "exact.omega": "angular frequency of the exact solution",
    "exact.difference": "relative difference of the field solution from the exact one",
    "size.dofs": "number of unknowns",
    "memory_peak": "largest memory of all processes together",
    "timing": "wall-clock time of a stage",
    "versions": "version of a package",
}


def long_name_of(place: str) -> str:
    """Return the long name of a place; by default its keys.

    Args:
        place: keys that lead to it, joined by dots.
    """
    return _LONG_NAMES.get(place) or place.replace(".", ", ").replace("_", " ")
