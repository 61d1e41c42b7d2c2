"""Quantities of the analyses over time: impulse responses of radiation, and motions in waves."""

from __future__ import annotations

from typing import Any

from hydroelastic.output.open_water.declarations import DOFS, NUMBERED, OF_BODIES, joined_array, named_dofs
from hydroelastic.output.quantities import Group, Quantity

_INERTIA: dict[str, Any] = {"unit": "kg/m", "of_roll": ("kg", "kg m")}
_MOTION: dict[str, Any] = {"unit": "m", "of_roll": ("rad",)}

# fmt: off
# A table: as many arguments on a line as fit.
IMPULSE_RESPONSE = Group("impulse_response", "impulse responses of radiation, by analysis; force by motion", (
    joined_array("times", "time after the impulse", "impulse_time", unit="s", symbol="t", shown=".6g",
        variable="impulse_time", column="time"),
    DOFS,
    named_dofs("radiating_dof", "motion that radiates"),
    named_dofs("influenced_dof", "motion that a force excites"),
    joined_array("impulse_response", "impulse response function of radiation", f"impulse_time {OF_BODIES}", symbol="K",
        unit="N/m^2", of_roll=("N/m", "N"), shown=".6g", variable="radiation_impulse_response", column=""),
    INFINITE_FREQUENCY_ADDED_MASS := joined_array("infinite_frequency_added_mass", "added mass at infinite frequency",
        OF_BODIES, variable="impulse_infinite_frequency_added_mass", **_INERTIA),
    joined_array("omega", "angular frequency at which the impulse responses are checked", "impulse_omega", unit="rad/s",
        symbol="ω", shown=".6g", variable="impulse_omega", contract=False),
    joined_array("added_mass", "added mass by the impulse responses", f"impulse_omega {OF_BODIES}", symbol="a",
        variable="impulse_added_mass", contract=False, **_INERTIA),
    joined_array("radiation_damping", "radiation damping by the impulse responses", f"impulse_omega {OF_BODIES}",
        symbol="b", unit="kg/(m s)", of_roll=("kg/s", "kg m/s"), variable="impulse_radiation_damping", contract=False),
    joined_array("causality_error", "difference of added mass and damping by the impulse responses and in the "
        "frequency domain, relative to the whole of both motions at each frequency", "impulse_omega", unit="1",
        short="causality error", shown=".1e", contract=False),
    joined_array("ogilvie_error", "difference of the added mass at infinite frequency by Ogilvie's relation and by its "
        "limit, relative to the same", "impulse_omega", unit="1", short="a∞ error", shown=".1e", contract=False),
    joined_array("impulse_response_error", "estimated error of the impulse responses, relative to their values at "
        "t = 0", "impulse_time", unit="1", symbol="δK", shown=".1e", variable="impulse_response_error", contract=False),
    IMPULSE_ERROR := joined_array("relative_error", "estimated relative error of the impulse responses", "", unit="1",
        shown=".1e", variable="impulse_relative_error", contract=False),
), dimension="impulse_response_analysis", note=NUMBERED)
MOTION = Group("motion", "motions in waves over time, by analysis", (
    MOTION_TIMES := joined_array("times", "time after the waves begin", "motion_time", unit="s", symbol="t",
        shown=".6g", variable="motion_time", column="time"),
    DOFS,
    named_dofs("dof", "motion"),
    Quantity("waves_from", 'side from which the waves come, `"left"` or `"right"`', variable=""),
    joined_array("wave_omega", "angular frequency of an incident wave", "component", unit="rad/s"),
    joined_array("wave_amplitude", "amplitude of an incident wave", "component", unit="m"),
    joined_array("wave_phase", "phase of an incident wave", "component", unit="rad",
        note="its crest passes the middle of the first body at t = phase/ω"),
    Quantity("ramp", "time in which the waves grow", "s", variable=""),
    joined_array("initial", "displacement at t = 0", "dof", variable="motion_initial", **_MOTION),
    ELEVATION := joined_array("elevation", "elevation of the incident waves, grown by the ramp, at the "
        "middle of the first body",
        "motion_time", unit="m", symbol="η", shown=".4g", variable="wave_elevation"),
    MOTION_DISPLACEMENT := joined_array("displacement", "motion in waves", "motion_time dof",
        variable="motion_displacement", column="", shown=".5g", **_MOTION),
    joined_array("velocity", "velocity in waves", "motion_time dof", unit="m/s", of_roll=("rad/s",),
        variable="motion_velocity"),
    joined_array("steady", "motion in the same waves without a beginning, by the frequency domain", "motion_time dof",
        variable="motion_steady", note="with a linear damping in place of drag", **_MOTION),
    joined_array("standard_deviation", "standard deviation of the motion after the ramp", "dof",
        variable="motion_standard_deviation", **_MOTION),
    LARGEST := joined_array("largest", "largest motion after the ramp", "dof", variable="motion_largest", **_MOTION),
    MOTION_ERROR := joined_array("relative_error", "estimated error of the motions relative to the largest", "",
        unit="1", shown=".1e", variable="motion_relative_error", contract=False),
), dimension="motion_analysis", note=NUMBERED)
