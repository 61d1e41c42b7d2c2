"""Units of the numbers in summaries, by the key that holds them; a number without dimension has the unit "1"."""

from __future__ import annotations

_BY_UNIT = {
    "1": (
        "added_mass_difference added_mass_relative_error aperiodic_modes attempts beam_shapes body bound_holds "
        "bound_mode cells counted damping_ratio degree difference difference_to_pressure_release dimension dofs "
        "elastic_energy_fraction factor factorizations first_oscillating_mode first_sharing_mode growing_above "
        "growing_below ill_posed_from index laplace_solutions largest_residual last_sharing_mode "
        "logarithmic_decrement mode newton_steps nodes one_mode out_of_plane pairs_asked pairs_converged pairs_kept "
        "participation points pressure_release_relative_error processes ratio_of_swings relative_error residual "
        "restarts runner_up shared steps surface_unknowns swings terms waves within zero_modes"
    ),
    "rad/s": "above below damped_omega dry_omega natural_frequency omega pressure_release_omega",
    "Hz": "frequency_hz",
    "1/s": "damping decay growth_rate",
    "1/rad": "quadratic_damping",
    "s": "at_time end_of_waves from natural_period period time_of_largest_angle timing to travel_time until",
    "m": (
        "amplitude at at_position centre_of_mass distance_to_rest end_positions highest_point largest_displacement "
        "lowest_point mesh_error position_error reference_level smallest_tension_at step_error waterplane"
    ),
    "1/m": "largest_curvature",
    "m/s^2": "apparent_gravity",
    "rad": "largest_angle level root_mean_square significant_angle",
    "degree": "largest_angle_degrees",
    "kg/m": "added_mass mass",
    "kg/m^2": "added_mass_per_length",
    "kg m": "added_inertia inertia moment_of_inertia",
    "kg m/s": "wave_damping",
    "kg/(m s)": "critical_resistance",
    "N": (
        "coupling_stiffness end_tensions end_tensions_range extreme_tension_error largest_tension reaction_error "
        "roll_stiffness smallest_tension stiffness tension tension_error"
    ),
    "N/m": "weight",
    "N/m^2": "heave_stiffness",
    "N m": "moment_error",
    "N s^2/m^3": "normal_drag tangential_drag",
    "J": "energy_at_end energy_at_start work_of_drag",
    "byte": "memory_peak",
}
_UNITS = {key: unit for unit, keys in _BY_UNIT.items() for key in keys.split()}
# Units that depend on the preceding key.
_UNITS |= {
    "floats.coupling_stiffness": "N/m",
    "floats.modes.added_mass": "kg/m or, of roll, kg m",
    "floats.modes.modal_mass": "kg/m or, of roll, kg m",
    "floats.modes.runner_up_modal_mass": "kg/m or, of roll, kg m",
    "motion.largest_tension_at": "s and m",
    "motion.smallest_tension_at": "s and m",
    "missed_peaks.drawn": "m/m or, of roll, rad/m",
    "missed_peaks.value": "m/m or, of roll, rad/m",
    "size.times": "1",
}


def unit_of(place: str) -> str | None:
    """Return the unit of a number; ``None`` if it is unknown, or differs between entries.

    Args:
        place: keys that lead to it, joined by dots.
    """
    keys = place.split(".")
    endings = (".".join(keys[start:]) for start in range(len(keys)))
    return next((_UNITS[ending] for ending in endings if ending in _UNITS), None)
