"""Quantities of responses to irregular waves, each declared once."""

from __future__ import annotations

from hydroelastic.output.open_water.declarations import CREST, DOFS, NUMBERED, OF_BODIES, joined_array, own_array
from hydroelastic.output.quantities import Group, Quantity

_CURVE = "spectrum_omega spectrum_quantity"


def _load_error(key: str, words: str, symbol: str) -> Quantity:
    return Quantity(
        f"{key}_error",
        f"estimated error of the significant {words}",
        "1",
        short=f"error {symbol}",
        shown=".0e",
        printed=False,
        value=lambda it: it.relative_errors[key],
        note="relative to the largest along it",
        contract=False,
    )


# fmt: off
# A table: as many arguments on a line as fit.
SPECTRUM = Group("spectrum", "responses to irregular waves, by analysis", (
    Quantity("waves", "spectrum of the waves", variable="spectrum_of_waves"),
    Quantity("waves_from", 'side from which the waves come, `"left"` or `"right"`', variable=""),
    joined_array("significant_height", "significant height of the waves", "", unit="m", symbol="Hs",
        variable="significant_wave_height"),
    joined_array("duration", "duration of the sea state", "", unit="s", variable="sea_state_duration"),
    own_array("omega", "frequencies chosen by the solver", "spectrum_omega", lambda it: it.omega, unit="rad/s",
        variable="spectrum_omega", column="omega", contract=False),
    own_array("density", "spectrum of the waves", "spectrum_omega", lambda it: it.density, unit="m^2 s/rad",
        variable="wave_spectrum", column="wave_spectrum", contract=False),
    own_array("quantities", "responses", "spectrum_quantity", lambda it: it.quantities, variable="spectrum_quantity"),
    own_array("transfer", "response per unit elevation, in its unit per m", _CURVE, lambda it: it.transfer,
        variable="spectrum_transfer_function", column="", phase=CREST, contract=False),
    own_array("response_density", "spectrum of a response, in the square of its unit times s/rad", _CURVE,
        lambda it: it.response_density, variable="response_spectrum", column="response_spectrum", contract=False),
    own_array("relative_error", "estimated error of the transfer functions, relative to the incident wave, or to the "
        "largest motion where that is larger", "spectrum_omega", lambda it: it.relative_error, unit="1",
        variable="spectrum_relative_error", column="relative_error", contract=False),
    RESPONSES := Group("responses", "statistics of each response, in its unit", (
        QUANTITY := Quantity("quantity", "response"),
        UNIT := Quantity("unit", "its unit", short="unit"),
        SIGNIFICANT_AMPLITUDE := Quantity("significant_amplitude", "significant amplitude", short="significant",
            error="relative_error"),
        Quantity("largest_amplitude", "most probable largest amplitude in the duration", short="largest",
            error="relative_error"),
        Quantity("zero_crossing_period", "zero-crossing period", "s", symbol="Tz", error="relative_error"),
        Quantity("relative_error", "estimated relative error of the significant amplitude", "1",
            short="relative error", shown=".1e", contract=False),
        Quantity("sampling_error", "part of it by the sampling of the transfer function", "1", shown=".1e",
            printed=False, contract=False),
        Quantity("truncation_error", "part of it by waves beyond the frequencies", "1", shown=".1e",
            printed=False, contract=False),
        Quantity("transfer_error", "part of it by errors of the transfer function", "1", shown=".1e",
            printed=False, contract=False),
    ), dimension="irregular_response", prefix="irregular_response"),
    AIR_GAPS := Group("air_gaps", "heights of points above the waves, linear in these", (
        Quantity("x", "x of the point at rest", "m", value=lambda it: it.point.at[0], short="x", shown=".6g"),
        Quantity("y", "its height in the scene", "m", value=lambda it: it.point.at[1], printed=False),
        Quantity("across", "its distance from the plane of x and y", "m", value=lambda it: it.point.across,
            short="across", shown=".6g"),
        Quantity("body", "number of the body with which it moves", "1",
            value=lambda it: None if it.point.body is None else it.point.body + 1, short="body",
            note="`null` of a fixed point"),
        Quantity("still_air_gap", "its height above the still water", "m", short="at rest", shown=".6g"),
        Quantity("significant_relative_elevation", "significant amplitude of the elevation less that of the point",
            "m", value=lambda it: it.relative_elevation.significant_amplitude, short="significant", shown=".4g"),
        Quantity("largest_relative_elevation", "most probable largest of these in the duration", "m",
            value=lambda it: it.relative_elevation.largest_amplitude, short="largest", shown=".4g"),
        Quantity("smallest_air_gap", "most probable smallest height above the waves in the duration", "m",
            short="smallest air gap", shown=".4g", note="negative where the water rises above the point"),
        Quantity("air_gap_error", "its estimated error", "m", short="error", shown=".1e", contract=False),
    ), dimension="air_gap", prefix="air_gap"),
    joined_array("mean_drift_force", "mean force on the bodies along x", "", unit="N/m",
        note="NaN about an axis in waves on two levels"),
    joined_array("mean_drift_error", "its estimated error", "", unit="N/m", contract=False),
    joined_array("mean_absorbed_power", "mean power that the linear damping of attachments takes", "", unit="W/m"),
    DOFS,
    joined_array("equivalent_damping", "linear damping in place of quadratic damping", OF_BODIES, unit="kg/(m s)",
        of_roll=("kg/s", "kg m/s")),
    LOADS := Group("plates", "largest loads along each beam, and along the diameter of each round plate", (
        Quantity("body", "number of the body", "1", value=lambda it: it.body + 1, short="body"),
        Quantity("largest_bending_moment", "most probable largest bending moment anywhere in the duration", "N",
            short="largest M", shown=".4g",
            value=lambda it: float(it.largest_bending_moment.max())),
        Quantity("at", "where that is", "m", symbol="x", shown=".4g",
            value=lambda it: float(it.positions[it.largest_bending_moment.argmax()])),
        Quantity("significant_bending_moment", "largest significant amplitude of the bending moment", "N",
            short="significant M", shown=".4g",
            value=lambda it: float(it.significant_bending_moment.max())),
        Quantity("significant_shear_force", "largest significant amplitude of the shear force", "N/m",
            short="significant Q", shown=".4g",
            value=lambda it: float(it.significant_shear_force.max())),
        Quantity("significant_deflection", "largest significant amplitude of the deflection", "m",
            short="significant w", shown=".4g",
            value=lambda it: float(it.significant_deflection.max())),
        Quantity("largest_stress", "most probable largest stress in the duration", "N/m^2", short="largest stress",
            shown=".4g",
            value=lambda it: None if it.largest_stress is None else float(it.largest_stress.max()),
            note="`null` without a thickness"),
        Quantity("relative_error", "largest estimated error of these, relative to the largest along the beam", "1",
            short="error", shown=".0e", contract=False),
        _load_error("bending_moment", "bending moment", "M"),
        _load_error("shear_force", "shear force", "Q"),
        _load_error("deflection", "deflection", "w"),
    ), dimension="spectrum_plate", prefix="spectrum_plate"),
), dimension="spectrum_analysis", note=NUMBERED)
# fmt: on
