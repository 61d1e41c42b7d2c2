"""Units of the numbers in summaries, by the key that holds them; a number without dimension has the unit "1"."""

from __future__ import annotations

_BY_UNIT = {
    "1": (
        "added_mass_difference added_mass_relative_error attempts beam_shapes body bound_holds bound_mode cells "
        "counted degree difference difference_to_pressure_release dofs elastic_energy_fraction factorizations "
        "first_sharing_mode index laplace_solutions largest_residual last_sharing_mode one_mode pairs_asked "
        "pairs_converged pairs_kept participation pressure_release_relative_error processes relative_error "
        "residual restarts runner_up shared surface_unknowns waves zero_modes"
    ),
    "rad/s": "above below dry_omega omega pressure_release_omega",
    "Hz": "frequency_hz",
    "1/s": "growth_rate",
    "s": "timing",
    "m": "centre_of_mass reference_level waterplane",
    "kg/m": "added_mass mass",
    "kg/m^2": "added_mass_per_length",
    "kg m": "moment_of_inertia",
    "N": "coupling_stiffness roll_stiffness stiffness",
    "N/m^2": "heave_stiffness",
    "byte": "memory_peak",
}
_UNITS = {key: unit for unit, keys in _BY_UNIT.items() for key in keys.split()}
# Units that depend on the preceding key.
_UNITS |= {
    "floats.coupling_stiffness": "N/m",
    "floats.modes.added_mass": "kg/m or, of roll, kg m",
    "floats.modes.modal_mass": "kg/m or, of roll, kg m",
    "floats.modes.runner_up_modal_mass": "kg/m or, of roll, kg m",
    "missed_peaks.drawn": "m/m or, of roll, rad/m",
    "missed_peaks.value": "m/m or, of roll, rad/m",
}


def unit_of(place: str) -> str | None:
    """Return the unit of a number; ``None`` if it is unknown, or differs between entries.

    Args:
        place: keys that lead to it, joined by dots.
    """
    keys = place.split(".")
    endings = (".".join(keys[start:]) for start in range(len(keys)))
    return next((_UNITS[ending] for ending in endings if ending in _UNITS), None)
