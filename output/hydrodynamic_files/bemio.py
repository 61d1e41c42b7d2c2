"""The HDF5 file that BEMIO writes for WEC-Sim.

Its scales are those of WAMIT with L = 1 m: A/ρ, B/(ρω), X/(ρg), C/(ρg), K/ρ, and impulse responses of the excitation
f/(ρg); phases are those of e^{iωt}. MATLAB stores arrays column by column, so that a row vector of n is (n, 1) here,
and matrices over the frequency are (force, motion, frequency), forces (motion, direction, frequency). Source: WEC-Sim,
source/functions/BEMIO/writeBEMIOH5.m, normalizeBEM.m, radiationIRF.m and excitationIRF.m. Bodies with modes beyond the
six motions ("generalized body modes") have their mass, damping and bending stiffness among their properties, of shape
(own motion, motion of all bodies, 1) and in SI units, and all bodies then have a hydrostatic stiffness of shape (own
motion, own motion, 1).
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from hydroelastic.output.hydrodynamic_files.whole_bodies import WholeBodies, WholeBody

if TYPE_CHECKING:
    import h5py

# Number of frequencies to which the excitation is interpolated for its impulse response, as in BEMIO.
_INTERPOLATED = 1001


def write_bemio(bodies: WholeBodies, path: Path) -> None:
    """Write the file; the bodies' impulse responses and added mass at infinite frequency are known."""
    # Only who asks for it needs it.
    import h5py

    with h5py.File(path, "w") as file:
        file["bem_data/code"] = np.bytes_("hydroelastic")
        _write(file, "simulation_parameters/scaled", 0.0, "", "")
        _write(file, "simulation_parameters/g", bodies.gravity, "Gravitational acceleration", "m/s^2")
        _write(file, "simulation_parameters/rho", bodies.density, "Water density", "kg/m^3")
        _write(file, "simulation_parameters/T", 2.0 * np.pi / bodies.omega, "Wave periods", "s")
        _write(file, "simulation_parameters/w", bodies.omega, "Wave frequencies", "rad/s")
        if np.isinf(bodies.depth):
            file["simulation_parameters/water_depth"] = np.bytes_("infinite")
        else:
            _write(file, "simulation_parameters/water_depth", bodies.depth, "Water depth", "m")
        _write(file, "simulation_parameters/wave_dir", bodies.directions, "Wave direction", "deg")
        for index, body in enumerate(bodies.bodies):
            group = file.create_group(f"body{index + 1}")
            own = bodies.spans[index]
            _write_properties(group.create_group("properties"), body, index, own)
            if any(each.modes for each in bodies.bodies):
                _write_modes(group["properties"], bodies, own)
            _write_coefficients(group.create_group("hydro_coeffs"), bodies, own)


def _write_properties(group: h5py.Group, body: WholeBody, index: int, own: slice) -> None:
    group["name"] = np.bytes_(body.name)
    for name, value, meaning, unit in (
        ("body_number", index + 1.0, "Number of rigid body from the BEM simulation", ""),
        ("cb", np.array(body.centre_of_buoyancy), "Center of buoyancy", "m"),
        ("cg", np.array(body.centre_of_gravity), "Center of gravity", "m"),
        ("disp_vol", body.volume, "Displaced volume", "m^3"),
        ("dof", len(body.motions), "Degrees of freedom", ""),
        ("dof_start", own.start + 1, "Degrees of freedom", ""),
        ("dof_end", own.stop, "Degrees of freedom", ""),
    ):
        _write(group, name, value, meaning, unit)


def _write_modes(group: h5py.Group, bodies: WholeBodies, own: slice) -> None:
    for name, matrix, unit in (
        ("mass", bodies.inertia, "kg"),
        ("damping", np.zeros_like(bodies.inertia), "N-s/m"),
        ("stiffness", bodies.bending_stiffness, "N/m"),
    ):
        _write(group, name, matrix[own, :, None], f"Generalized body modes {name}", unit)


def _write_coefficients(group: h5py.Group, bodies: WholeBodies, own: slice) -> None:
    far, times, response = bodies.limits[1], bodies.impulse_times, bodies.impulse_response
    if far is None or times is None or response is None:
        raise ValueError("BEMIO's file holds impulse responses and the added mass at infinite frequency")
    density, weight = bodies.density, bodies.density * bodies.gravity
    restoring = bodies.stiffness[own, own] / weight
    _write(
        group,
        "linear_restoring_stiffness",
        restoring[:, :, None] if any(body.modes for body in bodies.bodies) else restoring,
        "Hydrostatic stiffness matrix (normalized by rho*g)",
        "N/m",
    )
    last = np.moveaxis(bodies.added_mass[:, own] / density, 0, -1)
    _write(group, "added_mass/inf_freq", far[own] / density, "Infinite frequency added mass (normalized by rho)", "kg")
    _write(group, "added_mass/all", last, "Added mass (normalized by rho)", "kg")
    excitation = group.create_group("excitation")
    for name, part, meaning in (
        ("", bodies.excitation_force, "excitation"),
        ("scattering/", bodies.diffraction_force, "scattering"),
        ("froude-krylov/", bodies.froude_krylov_force, "Froude-Krylov"),
    ):
        _write_force(excitation, name, np.conj(np.moveaxis(part[..., own], 0, -1).swapaxes(0, 1)) / weight, meaning)
    lags = np.linspace(-times.max(), times.max(), 2 * len(times) - 1)
    omega = np.linspace(bodies.omega[0], bodies.omega[-1], _INTERPOLATED)
    functions = excitation.create_group("impulse_response_fun")
    shape = (own.stop - own.start, len(bodies.directions), -1)
    forces = np.conj(np.moveaxis(bodies.excitation_force[..., own], 0, -1).swapaxes(0, 1)) / weight
    between = np.array([np.interp(omega, bodies.omega, row) for row in forces.reshape(-1, len(bodies.omega))])
    _write(functions, "f", _excitation_response(omega, between, lags).reshape(shape), "Impulse response function", "")
    _write(functions, "t", lags, "Time vector for the impulse resonse function", "s")
    _write(functions, "w", omega, "Interpolated frequencies used to compute the impulse response function", "rad/s")
    damping = group.create_group("radiation_damping")
    scaled = bodies.radiation_damping[:, own] / (density * bodies.omega[:, None, None])
    _write(damping, "all", np.moveaxis(scaled, 0, -1), "Radiation damping (normalized by rho*w)", "N-s/m")
    functions = damping.create_group("impulse_response_fun")
    _write(functions, "K", np.moveaxis(response[:, own] / density, 0, -1), "Impulse response function", "")
    _write(functions, "t", times, "Time vector for the impulse resonse function", "s")
    _write(
        functions, "w", bodies.omega, "Interpolated frequencies used to compute the impulse response function", "rad/s"
    )


def _write_force(group: h5py.Group, prefix: str, force: np.ndarray, what: str) -> None:
    for name, values, part, unit in (
        ("re", force.real, "Real component", "N"),
        ("im", force.imag, "Imaginary component", "N"),
        ("mag", np.abs(force), "Magnitude", "N"),
        ("phase", np.angle(force), "Phase angle", "rad"),
    ):
        scale = "" if unit == "rad" else " (normalized by rho*g)"
        _write(group, prefix + name, values, f"{part} of {what} force{scale}", unit)


def _excitation_response(omega: np.ndarray, force: np.ndarray, times: np.ndarray) -> np.ndarray:
    """(1/π) ∫ (Re X cos ωt − Im X sin ωt) dω by trapezoids, shape (forces, times)."""
    turning = np.exp(1j * np.outer(omega, times))
    weights = np.full(len(omega), omega[1] - omega[0])
    weights[[0, -1]] *= 0.5
    values: np.ndarray = ((force * weights) @ turning).real / np.pi
    return values


def _write(group: Any, name: str, values: Any, description: str, units: str) -> None:
    array = np.asarray(values, dtype=float)
    # A scalar of MATLAB is 1 × 1, and a row vector of n is 1 × n, stored as (n, 1).
    dataset = group.create_dataset(name, data=array.reshape(-1, 1) if array.ndim < 2 else array)
    dataset.attrs["description"] = np.bytes_(description)
    dataset.attrs["units"] = np.bytes_(units)
