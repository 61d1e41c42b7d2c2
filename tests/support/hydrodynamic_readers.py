"""Readers of the files of WAMIT, BEMIO and Nemoh, written from the descriptions of these formats alone."""

import re
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np


@dataclass(frozen=True, kw_only=True)
class Read:
    """What a file holds, in the scales of WAMIT with L = 1 and the time factor e^{iωt}; motions are counted from 0."""

    omega: np.ndarray
    added_mass: np.ndarray
    damping: np.ndarray
    force: np.ndarray


def rows(path: Path) -> np.ndarray:
    return np.array([[float(word) for word in line.split()] for line in path.read_text().splitlines()])


def read_wamit(folder: Path, name: str, motions: int) -> tuple[Read, dict[float, np.ndarray], np.ndarray]:
    """Return the periodic part, the limits by PER, and the stiffness."""
    masses: dict[float, np.ndarray] = {}
    dampings: dict[float, np.ndarray] = {}
    for line in (folder / f"{name}.1").read_text().splitlines():
        period, i, j, *values = (float(word) for word in line.split())
        masses.setdefault(period, np.zeros((motions, motions)))[int(i) - 1, int(j) - 1] = values[0]
        if period > 0.0:
            dampings.setdefault(period, np.zeros((motions, motions)))[int(i) - 1, int(j) - 1] = values[1]
    periods = sorted(dampings, reverse=True)
    forces: dict[tuple[float, float], np.ndarray] = {}
    for period, beta, i, size, phase, real, imaginary in rows(folder / f"{name}.3"):
        np.testing.assert_allclose(size * np.exp(1j * np.radians(phase)), real + 1j * imaginary, atol=1e-7 * size)
        forces.setdefault((period, beta), np.zeros(motions, dtype=complex))[int(i) - 1] = real + 1j * imaginary
    betas = sorted({beta for _, beta in forces})
    stiffness = np.zeros((motions, motions))
    for i, j, value in rows(folder / f"{name}.hst"):
        stiffness[int(i) - 1, int(j) - 1] = value
    read = Read(
        omega=2.0 * np.pi / np.array(periods),
        added_mass=np.array([masses[period] for period in periods]),
        damping=np.array([dampings[period] for period in periods]),
        force=np.array([[forces[period, beta] for beta in betas] for period in periods]),
    )
    return read, {period: masses[period] for period in masses if period <= 0.0}, stiffness


def read_bemio(path: Path, bodies: int) -> Read:
    with h5py.File(path) as file:
        coefficients = [file[f"body{number}/hydro_coeffs"] for number in range(1, bodies + 1)]

        def stacked(name: str) -> np.ndarray:
            return np.moveaxis(np.concatenate([one[name][:] for one in coefficients]), -1, 0)

        return Read(
            omega=file["simulation_parameters/w"][:, 0],
            added_mass=stacked("added_mass/all"),
            damping=stacked("radiation_damping/all"),
            force=(stacked("excitation/re") + 1j * stacked("excitation/im")).swapaxes(1, 2),
        )


def tecplot_zones(path: Path, title: str) -> list[np.ndarray]:
    """The numbers of the zones whose titles begin so."""
    found: list[list[list[float]]] = []
    for line in path.read_text().splitlines():
        if match := re.match(r'Zone t="([^"]*)",I= *\d+,F=POINT', line):
            assert match[1].startswith(title)
            found.append([])
        elif found:
            found[-1].append([float(word) for word in line.split()])
    return [np.array(zone) for zone in found]


def read_nemoh(folder: Path, density: float, gravity: float) -> Read:
    zones = np.array(tecplot_zones(folder / "results" / "RadiationCoefficients.tec", "Motion of body"))
    omega = zones[0, :, 0]
    # A zone for each motion, a pair of columns for each force.
    masses, dampings = (np.moveaxis(zones[:, :, first::2], 0, -1) for first in (1, 2))
    waves = np.array(tecplot_zones(folder / "results" / "ExcitationForce.tec", "Excitation force"))
    forces = waves[:, :, 1::2] * np.exp(-1j * waves[:, :, 2::2])
    return Read(
        omega=omega,
        added_mass=masses / density,
        damping=dampings / (density * omega[:, None, None]),
        force=forces.swapaxes(0, 1) / (density * gravity),
    )
