"""A solution of open water as a labelled dataset, with the names and dimensions of Capytaine.

Capytaine has the same time factor e^{−iωt} and incident waves e^{ik(x cos β) − iωt} of unit elevation. Names of motions
are capitalised: "Heave", "body_2__Heave". What it has no name for, here has one of its own.
"""

from __future__ import annotations

from dataclasses import fields
from functools import reduce
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from hydroelastic.fem.open_water.results import DIRECTIONS, DecayTable, RadiationTable, ResonanceTable, ResponseTable
from hydroelastic.output.dof_units import INERTIA_UNITS, MOTION_UNITS, STIFFNESS_UNITS
from hydroelastic.output.summary_names import SummaryNames
from hydroelastic.physics.dofs import Dof, body_name
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.open_water.results import OpenSolution

if TYPE_CHECKING:
    import xarray

# Units and long names, the same for all motions.
_SAID = {
    "omega": ("rad/s", "angular frequency"),
    "wavenumber": ("1/m", "wavenumber"),
    "wavelength": ("m", "wavelength"),
    "period": ("s", "period"),
    "wave_direction": ("rad", "direction in which incident waves travel"),
    "wave": (None, "branch of the dispersion relation"),
    "outgoing_wave": (None, "branch of the outgoing wave"),
    "time": ("s", "time after release"),
    "radiation_relative_error": ("1", "estimated relative error of added mass and damping"),
    "radiation_energy_residual": ("1", "relative difference of damping and the radiated power"),
    "haskind_residual": ("1", "relative difference of the excitation and its value by Haskind's relation"),
    "reflection_coefficient": ("1", "elevation of the reflected wave over that of the incident one"),
    "transmission_coefficient": ("1", "elevation of the transmitted wave over that of the incident one"),
    "response_energy_residual": ("1", "relative difference of incident and outgoing power"),
    "response_relative_error": ("1", "estimated relative error of the motions"),
    "shape_amplitude": ("1", "amplitude of a further shape per unit elevation"),
    "resonance_omega": ("rad/s", "complex frequency of a resonance"),
    "resonance_motion": (None, "dominant motion of a resonance"),
    "resonance_amplitude": ("1", "motion in a resonance, the dominant one 1"),
    "resonance_residual": ("1", "relative residual of the equations"),
    "resonance_relative_error": ("1", "estimated relative error of the frequency of a resonance"),
    "decay_certified_until": ("s", "time to which the error of the motion after release holds"),
    "g": ("m/s^2", "gravity"),
    "rho": ("kg/m^3", "density of the lower liquid"),
    "water_depth": ("m", "depth of the lower liquid"),
    "rho_upper": ("kg/m^3", "density of the upper liquid"),
    "depth_upper": ("m", "depth of the upper liquid"),
    "body_name": (None, "bodies"),
}
# Quantities of motions: unit, that with a roll among them, and long name.
_SAID_OF_MOTIONS = {
    "added_mass": (*INERTIA_UNITS, "added mass"),
    "infinite_frequency_added_mass": (*INERTIA_UNITS, "added mass at infinite frequency"),
    "inertia_matrix": (*INERTIA_UNITS, "inertia of the bodies"),
    "radiation_damping": ("kg/(m s)", "kg/(m s), with a roll kg/s, of rolls kg m/s", "radiation damping"),
    "hydrostatic_stiffness": (*STIFFNESS_UNITS, "stiffness of bodies and hydrostatics"),
    "excitation_force": ("N/m^2", "N/m^2, of roll N/m", "excitation force per unit elevation"),
    "Froude_Krylov_force": ("N/m^2", "N/m^2, of roll N/m", "force of the incident wave per unit elevation"),
    "diffraction_force": ("N/m^2", "N/m^2, of roll N/m", "force of the scattered waves per unit elevation"),
    "RAO": ("m/m", "m/m, of roll rad/m", "motion per unit elevation of the incident wave"),
    "decay_displacement": (*MOTION_UNITS, "motion after release"),
    "decay_initial": (*MOTION_UNITS, "motion at release"),
    "decay_absolute_error": (*MOTION_UNITS, "estimated error of the motion after release"),
    "decay_tail": ("m s^2", "m s^2, of roll rad s^2", "asymptotic coefficient of 1/t^2"),
}
# Variables whose phase is relative to an incident wave.
_PHASED = (
    "excitation_force",
    "Froude_Krylov_force",
    "diffraction_force",
    "RAO",
    "reflection_coefficient",
    "transmission_coefficient",
    "shape_amplitude",
)
_PHASE = "beside an incident wave whose crest is at x = 0 of the scene at t = 0"
COMMENT = "exp(-i omega t); per metre of width; x along the waves, heave upwards, roll anticlockwise"
"""Signs and units of all arrays."""
# Analyses are labelled arrays; only counts are taken from the summary.
OPEN_NAMES = SummaryNames(
    by_place={
        "radiation": ("radiation_analysis",),
        "response": ("response_analysis",),
        "response.missed_peaks": ("missed_peak",),
        "resonance": ("resonance_analysis",),
        "estimates.thin_float.rows": ("thin_float_row",),
    },
    prefixes={"estimates": "", "estimates.thin_float.rows": "thin_float", "response.missed_peaks": "missed_peak"},
    reported_by_arrays=frozenset(
        f"{analysis}.{name}"
        for analysis, table in (
            ("radiation", RadiationTable),
            ("response", ResponseTable),
            ("resonance", ResonanceTable),
            ("decay", DecayTable),
        )
        for name in ("wave_direction", *(field.name for field in fields(table)))
    )
    - {"radiation.factorizations", "response.missed_peaks", "resonance.counted", "resonance.region"},
)


def open_dataset(solution: OpenSolution) -> xarray.Dataset:
    """Return all tables of a solution as one dataset with complex numbers.

    Several analyses of a kind are joined by their frequencies and wave directions; what none of them computed is NaN.
    A dimension `wave` is there only where waves travel on two levels, `analysis` only with several resonance or decay
    analyses.
    """
    radiated, responding = ([table.dofs for table in kind] for kind in (solution.radiation, solution.response))
    motions = max(radiated or responding, key=len, default=())
    parts = [
        *(_radiation(table) for table in solution.radiation),
        *(_response(table, motions) for table in solution.response),
        *_numbered([_resonance(table) for table in solution.resonance]),
        *_numbered([_decay(table) for table in solution.decay]),
    ]
    found = reduce(lambda one, other: one.combine_first(other), parts)
    # Joining analyses sorts the labels: restore the order of the bodies.
    ending = [*(table.dofs for table in solution.resonance), *(table.dofs for table in solution.decay)]
    others = max(ending, key=len, default=())
    order = {"radiating_dof": motions, "influenced_dof": motions, "dof": others}
    found = found.reindex({name: _capitalised(dofs) for name, dofs in order.items() if name in found.dims})
    if "resonance_motion" in found:
        found["resonance_motion"] = found["resonance_motion"].fillna("").astype(np.str_)
    found = found.set_coords([name for name in ("wavenumber", "wavelength", "period") if name in found])
    found = found.squeeze([name for name in ("wave", "outgoing_wave") if found.sizes.get(name) == 1])
    found = found.assign_coords(_of_the_scene(solution.scene))
    turning = any(dof.is_rotation for dof in (*motions, *others))
    for name in found.variables:
        found[name].attrs |= _attributes(str(name), turning=turning)
        if name in _PHASED or str(name).startswith("deflection_of_body"):
            found[name].attrs["phase"] = _PHASE
    return found


def _attributes(name: str, *, turning: bool) -> dict[str, str]:
    """Unit and long name of a variable."""
    if name.startswith(("position_on_body", "deflection_of_body")):
        unit: str | None = "m" if name.startswith("position") else "m/m"
        long_name = name.replace("_", " ")
    elif name in _SAID_OF_MOTIONS:
        plain, with_roll, long_name = _SAID_OF_MOTIONS[name]
        unit = with_roll if turning else plain
    elif name in _SAID:
        unit, long_name = _SAID[name]
    else:
        return {}
    return {"long_name": long_name} | ({} if unit is None else {"units": unit})


def _capitalised(dofs: tuple[Dof, ...]) -> list[str]:
    """Names of degrees of freedom in Capytaine."""
    return [dof.capitalised for dof in dofs]


def _dataset(coordinates: dict[str, Any], variables: dict[str, Any]) -> xarray.Dataset:
    import xarray

    return xarray.Dataset(variables, coords=coordinates)


def _waves(omega: npt.NDArray[np.float64], wavenumbers: npt.NDArray[np.float64]) -> dict[str, Any]:
    """Wavenumber, wavelength and period; infinite in the limit of long waves."""
    with np.errstate(divide="ignore"):
        return {
            "wavenumber": (("omega", "wave"), wavenumbers),
            "wavelength": (("omega", "wave"), 2.0 * np.pi / wavenumbers),
            "period": (("omega",), 2.0 * np.pi / omega),
        }


def _radiation(table: RadiationTable) -> xarray.Dataset:
    dofs = _capitalised(table.dofs)
    # Matrices are (force, motion); Capytaine puts the motion first.
    matrix = ("omega", "radiating_dof", "influenced_dof")
    force = ("omega", "wave", "wave_direction", "influenced_dof")
    body = ("influenced_dof", "radiating_dof")
    variables: dict[str, Any] = {
        "added_mass": (matrix, table.added_mass.swapaxes(1, 2)),
        "radiation_damping": (matrix, table.radiation_damping.swapaxes(1, 2)),
        "excitation_force": (force, table.excitation_force),
        "Froude_Krylov_force": (force, table.froude_krylov_force),
        "diffraction_force": (force, table.diffraction_force),
        "inertia_matrix": (body, table.inertia),
        "hydrostatic_stiffness": (body, table.stiffness),
        "radiation_relative_error": (("omega",), table.relative_error),
        "radiation_energy_residual": (("omega",), table.energy_residual),
        "haskind_residual": (("omega",), table.haskind_residual),
    }
    if table.infinite_frequency_added_mass is not None:
        variables["infinite_frequency_added_mass"] = (body, table.infinite_frequency_added_mass)
    return _dataset(
        {
            "omega": table.omega,
            "wave": list(table.waves),
            "wave_direction": list(DIRECTIONS),
            "radiating_dof": dofs,
            "influenced_dof": dofs,
        },
        variables | _waves(table.omega, table.wavenumbers),
    )


def _response(table: ResponseTable, motions: tuple[Dof, ...]) -> xarray.Dataset:
    """The response in the motions of the radiation analysis, and in further dry modes."""
    kept = [place for place, dof in enumerate(table.dofs) if dof in motions]
    direction = DIRECTIONS[0] if table.waves_from == "left" else DIRECTIONS[1]
    of_waves = ("omega", "wave_direction", "wave", "outgoing_wave")
    variables: dict[str, Any] = {
        "RAO": (("omega", "wave_direction", "wave", "radiating_dof"), table.amplitudes[:, None, :, kept]),
        "reflection_coefficient": (of_waves, table.reflection[:, None]),
        "transmission_coefficient": (of_waves, table.transmission[:, None]),
        "response_energy_residual": (("omega", "wave_direction", "wave"), table.energy_residual[:, None]),
        "response_relative_error": (("omega", "wave_direction"), table.relative_error[:, None]),
    }
    further = [place for place, dof in enumerate(table.dofs) if dof not in motions]
    places: dict[str, Any] = {}
    if further:
        places["shape"] = [table.dofs[place].capitalised for place in further]
        variables["shape_amplitude"] = (
            ("omega", "wave_direction", "wave", "shape"),
            table.amplitudes[:, None, :, further],
        )
    for plate in table.plates:
        along = f"position_on_body_{plate.body + 1}"
        places[along] = plate.positions
        variables[f"deflection_of_body_{plate.body + 1}"] = (
            ("omega", "wave_direction", "wave", along),
            plate.deflection[:, None],
        )
    return _dataset(
        {
            "omega": table.omega,
            "wave": list(table.waves),
            "outgoing_wave": list(table.waves),
            "wave_direction": [direction],
            "radiating_dof": [table.dofs[place].capitalised for place in kept],
            **places,
        },
        variables | _waves(table.omega, table.wavenumbers),
    )


def _resonance(table: ResonanceTable) -> xarray.Dataset:
    along = ("resonance",)
    return _dataset(
        {"resonance": np.arange(1, len(table.omega) + 1, dtype=np.int32), "dof": _capitalised(table.dofs)},
        {
            "resonance_omega": (along, table.omega),
            "resonance_motion": (along, np.array(_capitalised(table.labels), dtype=np.str_)),
            "resonance_amplitude": (("resonance", "dof"), table.body_amplitudes),
            "resonance_residual": (along, table.residuals),
            "resonance_relative_error": (along, table.relative_error),
        },
    )


def _decay(table: DecayTable) -> xarray.Dataset:
    variables: dict[str, Any] = {
        "decay_displacement": (("time", "dof"), table.displacement),
        "decay_initial": (("dof",), table.initial),
        "decay_absolute_error": (("time",), table.absolute_error),
        "decay_certified_until": ((), np.float64(table.certified_until)),
    }
    if table.tail is not None:
        variables["decay_tail"] = ((), np.float64(table.tail))
    return _dataset({"time": table.times, "dof": _capitalised(table.dofs)}, variables)


def _numbered(parts: list[xarray.Dataset]) -> list[xarray.Dataset]:
    """Join several analyses of a kind along a dimension `analysis`, from 1."""
    if len(parts) < 2:
        return parts
    return [part.expand_dims(analysis=np.array([number], dtype=np.int32)) for number, part in enumerate(parts, 1)]


def _of_the_scene(scene: TankScene) -> dict[str, Any]:
    lower, *upper = scene.layers
    found: dict[str, Any] = {
        "g": scene.tank.gravity,
        "rho": lower.density,
        "water_depth": lower.depth,
        "body_name": "+".join(body_name(number) for number in range(1, len(scene.body) + 1)),
    }
    if upper:
        found |= {"rho_upper": upper[0].density, "depth_upper": upper[0].depth}
    return found
