"""A solution of open water as a labelled dataset, with the names and dimensions of Capytaine, and as NetCDF.

Capytaine has the same time factor e^{−iωt} and incident waves e^{ik(x cos β) − iωt} of unit elevation. Names of motions
are capitalised: "Heave", "body_2__Heave". What it has no name for, here has one of its own.
"""

from __future__ import annotations

from functools import reduce
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from hydroelastic.scenes.models import TankScene
from hydroelastic.scenes.open_results import (
    DIRECTIONS,
    DecayTable,
    OpenSolution,
    RadiationTable,
    ResonanceTable,
    ResponseTable,
)

if TYPE_CHECKING:
    import xarray

_UNITS = {
    "omega": "rad/s",
    "wavenumber": "1/m",
    "wavelength": "m",
    "period": "s",
    "wave_direction": "rad",
    "time": "s",
    "resonance_omega": "rad/s",
    "g": "m/s^2",
    "rho": "kg/m^3",
    "water_depth": "m",
    "rho_above": "kg/m^3",
    "depth_above": "m",
}


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
    # Joining analyses sorts the labels: put them in the order of the bodies again.
    ending = [*(table.dofs for table in solution.resonance), *(table.dofs for table in solution.decay)]
    others = max(ending, key=len, default=())
    order = {"radiating_dof": motions, "influenced_dof": motions, "dof": others}
    found = found.reindex({name: _labels(dofs) for name, dofs in order.items() if name in found.dims})
    if "resonance_motion" in found:
        found["resonance_motion"] = found["resonance_motion"].fillna("").astype(np.str_)
    found = found.set_coords([name for name in ("wavenumber", "wavelength", "period") if name in found])
    found = found.squeeze([name for name in ("wave", "outgoing_wave") if found.sizes.get(name) == 1])
    found = found.assign_coords(_of_the_scene(solution.scene))
    for name, unit in _UNITS.items():
        if name in found.variables:
            found[name].attrs["units"] = unit
    return found.assign_attrs(_said_of(solution))


def write_dataset(solution: OpenSolution, path: Path) -> None:
    """Write the dataset as NetCDF 3, which every reader of NetCDF knows and SciPy alone can read and write.

    Complex numbers become a leading dimension `complex` of "re" and "im", as Capytaine writes them.
    """
    _without_complex_numbers(open_dataset(solution)).to_netcdf(path, engine="scipy", format="NETCDF3_64BIT")


def _without_complex_numbers(dataset: xarray.Dataset) -> xarray.Dataset:
    import xarray

    separated = dataset.copy()
    for name, values in dataset.data_vars.items():
        if np.iscomplexobj(values):
            # What was not computed has no imaginary part either.
            parts = xarray.concat([values.real, values.imag], dim="complex").where(values.notnull())
            separated[name] = parts.assign_coords(complex=["re", "im"]).assign_attrs(values.attrs)
    return separated


def _labels(dofs: tuple[str, ...]) -> list[str]:
    """Motions as Capytaine writes them; "elastic 1" is "Elastic 1"."""
    pairs = [dof.rpartition("__") for dof in dofs]
    return [body + joint + motion[:1].upper() + motion[1:] for body, joint, motion in pairs]


def _dataset(coordinates: dict[str, Any], variables: dict[str, Any]) -> xarray.Dataset:
    import xarray

    return xarray.Dataset(variables, coords=coordinates)


def _waves(omega: npt.NDArray[np.float64], wavenumbers: npt.NDArray[np.float64]) -> dict[str, Any]:
    """Wavenumber, wavelength and period; very long waves have no end."""
    with np.errstate(divide="ignore"):
        return {
            "wavenumber": (("omega", "wave"), wavenumbers),
            "wavelength": (("omega", "wave"), 2.0 * np.pi / wavenumbers),
            "period": (("omega",), 2.0 * np.pi / omega),
        }


def _radiation(table: RadiationTable) -> xarray.Dataset:
    dofs = _labels(table.dofs)
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


def _response(table: ResponseTable, motions: tuple[str, ...]) -> xarray.Dataset:
    """The response in the motions of the radiation analysis: shapes beyond them only bend the deflection."""
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
    places = {}
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
            "radiating_dof": _labels(tuple(table.dofs[place] for place in kept)),
            **places,
        },
        variables | _waves(table.omega, table.wavenumbers),
    )


def _resonance(table: ResonanceTable) -> xarray.Dataset:
    along = ("resonance",)
    return _dataset(
        {"resonance": np.arange(1, len(table.omega) + 1, dtype=np.int32), "dof": _labels(table.dofs)},
        {
            "resonance_omega": (along, table.omega),
            "resonance_motion": (along, np.array(_labels(table.labels), dtype=np.str_)),
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
    return _dataset({"time": table.times, "dof": _labels(table.dofs)}, variables)


def _numbered(parts: list[xarray.Dataset]) -> list[xarray.Dataset]:
    """Where there are several of a kind, tell them apart by a dimension `analysis`, from 1."""
    if len(parts) < 2:
        return parts
    return [part.expand_dims(analysis=np.array([number], dtype=np.int32)) for number, part in enumerate(parts, 1)]


def _of_the_scene(scene: TankScene) -> dict[str, Any]:
    lower, *upper = scene.layers
    found: dict[str, Any] = {
        "g": scene.tank.gravity,
        "rho": lower.density,
        "water_depth": lower.depth,
        "body_name": "+".join(f"body_{number}" for number in range(1, len(scene.body) + 1)),
    }
    if upper:
        found |= {"rho_above": upper[0].density, "depth_above": upper[0].depth}
    return found


def _said_of(solution: OpenSolution) -> dict[str, str]:
    from hydroelastic.scenes.provenance import versions

    said = {
        "title": solution.scene.title,
        "conventions": "exp(-i omega t); per metre of width; x along the waves, heave upwards, roll anticlockwise",
        "hydroelastic_version": versions()["hydroelastic"],
        "status": solution.status,
    }
    for number, table in enumerate(solution.resonance, 1):
        said[f"resonance_region_{number}"] = table.region
    return said
