"""Quantities of the analyses over time: impulse responses of radiation, and motions in waves."""

from __future__ import annotations

from typing import Any

from hydroelastic.output.quantities import Group, Quantity

_INERTIA: dict[str, Any] = {"unit": "kg/m", "of_roll": ("kg", "kg m")}
_MOTION: dict[str, Any] = {"unit": "m", "of_roll": ("rad",)}
_NUMBERED = "several have one more dimension, `analysis`, in `dataset.nc`"


def _joined(key: str, meaning: str, dimensions: str, **more: Any) -> Quantity:
    names = tuple(dimensions.split())
    return Quantity(key, meaning, dimensions=names, joined=names, **more)


def _capitalised(name: str, meaning: str) -> Quantity:
    return _joined(name, meaning, name, value=lambda it: [dof.capitalised for dof in it.dofs], in_summary=False)


# fmt: off
# A table: as many arguments on a line as fit.
DOFS = Quantity("dofs", "names of the motions", dimensions=("dof",), variable="")
_MATRIX = "influenced_dof radiating_dof"
IMPULSE_RESPONSE = Group("impulse_response", "impulse responses of radiation, by analysis; force by motion", (
    _joined("times", "time after the impulse", "impulse_time", unit="s", symbol="t", shown=".6g",
        variable="impulse_time", column="time"),
    DOFS,
    _capitalised("radiating_dof", "motion that radiates"),
    _capitalised("influenced_dof", "motion that a force excites"),
    _joined("impulse_response", "impulse response function of radiation", f"impulse_time {_MATRIX}", symbol="K",
        unit="N/m^2", of_roll=("N/m", "N"), shown=".6g", variable="radiation_impulse_response", column=""),
    INFINITE_FREQUENCY_ADDED_MASS := _joined("infinite_frequency_added_mass", "added mass at infinite frequency",
        _MATRIX, variable="impulse_infinite_frequency_added_mass", **_INERTIA),
    _joined("omega", "angular frequency at which the impulse responses are checked", "impulse_omega", unit="rad/s",
        symbol="ω", shown=".6g", variable="impulse_omega"),
    _joined("added_mass", "added mass by the impulse responses", f"impulse_omega {_MATRIX}", symbol="a",
        variable="impulse_added_mass", **_INERTIA),
    _joined("radiation_damping", "radiation damping by the impulse responses", f"impulse_omega {_MATRIX}", symbol="b",
        unit="kg/(m s)", of_roll=("kg/s", "kg m/s"), variable="impulse_radiation_damping"),
    _joined("causality_error", "difference of added mass and damping by the impulse responses and in the frequency "
        "domain, relative to the largest of both motions", "impulse_omega", unit="1", short="causality error",
        shown=".1e"),
    _joined("ogilvie_error", "difference of the added mass at infinite frequency by Ogilvie's relation and by its "
        "limit, relative to the same", "impulse_omega", unit="1", short="a∞ error", shown=".1e"),
    IMPULSE_ERROR := _joined("relative_error", "estimated relative error of the impulse responses", "", unit="1",
        shown=".1e", variable="impulse_relative_error"),
), dimension="impulse_response_analysis", note=_NUMBERED)
MOTION = Group("motion", "motions in waves over time, by analysis", (
    MOTION_TIMES := _joined("times", "time after the waves begin", "motion_time", unit="s", symbol="t", shown=".6g",
        variable="motion_time", column="time"),
    DOFS,
    _capitalised("dof", "motion"),
    Quantity("waves_from", 'side from which the waves come, `"left"` or `"right"`', variable=""),
    _joined("wave_omega", "angular frequency of an incident wave", "component", unit="rad/s"),
    _joined("wave_amplitude", "amplitude of an incident wave", "component", unit="m"),
    _joined("wave_phase", "phase of an incident wave", "component", unit="rad",
        note="its crest passes the middle of the first body at t = phase/ω"),
    Quantity("ramp", "time in which the waves grow", "s", variable=""),
    _joined("initial", "displacement at t = 0", "dof", variable="motion_initial", **_MOTION),
    ELEVATION := _joined("elevation", "elevation of the incident waves at the middle of the first body", "motion_time",
        unit="m", symbol="η", shown=".4g", variable="wave_elevation"),
    MOTION_DISPLACEMENT := _joined("displacement", "motion in waves", "motion_time dof", variable="motion_displacement",
        column="", shown=".5g", **_MOTION),
    _joined("velocity", "velocity in waves", "motion_time dof", unit="m/s", of_roll=("rad/s",),
        variable="motion_velocity"),
    _joined("steady", "motion in the same waves without a beginning, by the frequency domain", "motion_time dof",
        variable="motion_steady", note="with a linear damping in place of drag", **_MOTION),
    _joined("standard_deviation", "standard deviation of the motion after the ramp", "dof",
        variable="motion_standard_deviation", **_MOTION),
    LARGEST := _joined("largest", "largest motion after the ramp", "dof", variable="motion_largest", **_MOTION),
    MOTION_ERROR := _joined("relative_error", "estimated error of the motions relative to the largest", "", unit="1",
        shown=".1e", variable="motion_relative_error"),
), dimension="motion_analysis", note=_NUMBERED)
