"""Files of WAMIT, BEMIO, Nemoh and Capytaine, read back by readers written from the formats' descriptions."""

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import h5py
import numpy as np
import pytest
import xarray
from hydrodynamic_bodies import DIGITS, WIDTH, agrees, bodies_of_sections, section_tables, solids_of_revolution
from hydrodynamic_readers import read_bemio, read_nemoh, read_wamit, rows

from hydroelastic.output.hydrodynamic_files.bemio import write_bemio
from hydroelastic.output.hydrodynamic_files.capytaine import write_capytaine
from hydroelastic.output.hydrodynamic_files.nemoh import write_nemoh
from hydroelastic.output.hydrodynamic_files.wamit import write_wamit
from hydroelastic.output.hydrodynamic_files.whole_bodies import WholeBodies


@pytest.fixture(scope="module")
def section() -> SimpleNamespace:
    return section_tables()


@pytest.fixture(scope="module")
def bodies(section: SimpleNamespace) -> WholeBodies:
    return bodies_of_sections(section)


@pytest.fixture(scope="module")
def solids(section: SimpleNamespace) -> WholeBodies:
    return solids_of_revolution(section)


def test_a_section_of_some_width_has_surge_heave_and_pitch(section: SimpleNamespace, bodies: WholeBodies) -> None:
    heave, pitch, surge = 2, 4, 6
    given = section.radiation
    assert np.flatnonzero(bodies.modelled).tolist() == [heave, pitch, surge]
    np.testing.assert_array_equal(bodies.omega, [0.5, 1.0, 1.5])
    # Pitch lifts what roll lowers, so that coupling with it changes its sign.
    mass = bodies.added_mass[0]
    assert mass[heave, surge] == WIDTH * given.added_mass[1, 0, 2]
    assert mass[heave, pitch] == -WIDTH * given.added_mass[1, 0, 1]
    assert mass[pitch, pitch] == WIDTH * given.added_mass[1, 1, 1]
    assert bodies.limits[0] is None
    assert bodies.limits[1] is not None
    assert bodies.limits[1][surge, pitch] == -WIDTH * given.added_mass[2, 2, 1]
    np.testing.assert_array_equal(bodies.excitation_force[2, 1, pitch], -WIDTH * given.excitation_force[0, 0, 1, 1])
    assert bodies.motions[0].direction == 180.0
    np.testing.assert_array_equal(
        bodies.motions[0].amplitudes[0, [heave, pitch]], section.response.amplitudes[0, 0, :2] * [1.0, -1.0]
    )


def test_bodies_at_rest_are_relative_to_where_phases_are(bodies: WholeBodies) -> None:
    barge, disc = bodies.bodies
    np.testing.assert_allclose(barge.centre_of_gravity, (1.5, 0.0, 0.2), atol=1e-12)
    np.testing.assert_allclose(barge.centre_of_buoyancy, (1.5, 0.0, -0.5), atol=1e-12)
    assert barge.volume == pytest.approx(4.0 * WIDTH, rel=1e-12)
    assert disc.waterplane_area == pytest.approx(2.0 * WIDTH, rel=1e-12)


def test_wamit_is_read_back(bodies: WholeBodies, tmp_path: Path) -> None:
    slow = np.full((12, 12), 5.0)
    slow[2, 2] = np.inf
    known = replace(bodies, limits=(slow, bodies.limits[1]))
    write_wamit(known, tmp_path, "barge")
    read, limits, stiffness = read_wamit(tmp_path, "barge", 12)
    agrees(read, bodies)
    # PER = 0 is the infinite frequency, PER < 0 the infinite period; what is infinite there is left out.
    assert set(limits) == {0.0, -1.0}
    assert bodies.limits[1] is not None
    np.testing.assert_allclose(limits[0.0], bodies.limits[1] / bodies.density, rtol=DIGITS)
    assert limits[-1.0][4, 6] == pytest.approx(5.0 / bodies.density, rel=DIGITS)
    assert limits[-1.0][2, 2] == 0.0
    np.testing.assert_allclose(stiffness, bodies.stiffness / (bodies.density * bodies.gravity), rtol=DIGITS)
    motions = rows(tmp_path / "barge.4")
    np.testing.assert_allclose(motions[:, 0], 2.0 * np.pi, rtol=DIGITS)
    np.testing.assert_array_equal(motions[:, 1], 180.0)
    expected = np.conj(bodies.motions[0].amplitudes[0][motions[:, 2].astype(int) - 1])
    np.testing.assert_allclose(motions[:, 5] + 1j * motions[:, 6], expected, rtol=DIGITS)


def test_bemio_is_read_back(bodies: WholeBodies, tmp_path: Path) -> None:
    path = tmp_path / "barge.h5"
    write_bemio(bodies, path)
    agrees(read_bemio(path, 2), bodies)
    with h5py.File(path) as file:
        assert file["simulation_parameters/scaled"][0, 0] == 0.0
        assert file["simulation_parameters/water_depth"][0, 0] == 12.0
        np.testing.assert_allclose(file["simulation_parameters/wave_dir"][:, 0], [0.0, 180.0])
        second = file["body2"]
        assert second["properties/name"][()] == b"body_2"
        assert second["properties/dof_start"][0, 0] == 7.0
        np.testing.assert_allclose(second["properties/cg"][:, 0], bodies.bodies[1].centre_of_gravity)
        coefficients = second["hydro_coeffs"]
        assert coefficients["added_mass/all"].shape == (6, 12, 3)
        assert coefficients["excitation/re"].shape == (6, 2, 3)
        assert bodies.limits[1] is not None
        np.testing.assert_allclose(coefficients["added_mass/inf_freq"][:], bodies.limits[1][6:] / bodies.density)
        for part in ("", "scattering/", "froude-krylov/"):
            force = {name: coefficients[f"excitation/{part}{name}"][:] for name in ("re", "im", "mag", "phase")}
            np.testing.assert_allclose(force["mag"] * np.exp(1j * force["phase"]), force["re"] + 1j * force["im"])
        response = coefficients["radiation_damping/impulse_response_fun"]
        assert bodies.impulse_response is not None
        np.testing.assert_allclose(response["K"][0, 4], bodies.impulse_response[:, 6, 4] / bodies.density)
        np.testing.assert_allclose(response["t"][:, 0], np.linspace(0.0, 4.0, 9))
        # (1/π) ∫ Re (X e^{iωt}) dω with X between three frequencies on straight lines, at t = 0.
        excitation = coefficients["excitation/impulse_response_fun"]
        lags = excitation["t"][:, 0]
        np.testing.assert_allclose(lags, np.linspace(-4.0, 4.0, 17))
        real = coefficients["excitation/re"][0, 1]
        expected = 0.5 * (0.5 * (real[0] + real[1]) + 0.5 * (real[1] + real[2])) / np.pi
        np.testing.assert_allclose(excitation["f"][0, 1, 8], expected, rtol=1e-12)
        omega = np.linspace(0.5, 1.5, 20001)
        force = np.interp(omega, bodies.omega, coefficients["excitation/re"][0, 1]) + 1j * np.interp(
            omega, bodies.omega, coefficients["excitation/im"][0, 1]
        )
        expected = np.trapezoid((force * np.exp(2j * omega)).real, omega) / np.pi
        np.testing.assert_allclose(excitation["f"][0, 1, 12], expected, rtol=1e-4)


def test_nemoh_is_read_back(bodies: WholeBodies, tmp_path: Path) -> None:
    write_nemoh(bodies, tmp_path)
    agrees(read_nemoh(tmp_path, bodies.density, bodies.gravity), bodies)
    settings = (tmp_path / "Nemoh.cal").read_text().splitlines()
    assert [line.split()[:3] for line in settings if "Number of wave" in line] == [
        ["3", "0.5", "1.5"],
        ["2", "0.0", "180.0"],
    ]
    places = (tmp_path / "mesh" / "Hydrostatics_1.dat").read_text().splitlines()
    np.testing.assert_allclose([float(line.split()[6]) for line in places[:3]], bodies.bodies[1].centre_of_gravity)
    assert float(places[3].split()[2]) == pytest.approx(bodies.bodies[1].volume, rel=DIGITS)
    np.testing.assert_allclose(rows(tmp_path / "mesh" / "KH_0.dat"), bodies.stiffness[:6, :6], rtol=DIGITS)


def test_capytaine_is_read_back(bodies: WholeBodies, tmp_path: Path) -> None:
    path = tmp_path / "barge.nc"
    write_capytaine(bodies, path)
    dataset = xarray.load_dataset(path)
    assert dataset.radiating_dof.values.tolist() == ["body_1__Heave", "body_1__Pitch", "body_2__Surge"]
    one = {"radiating_dof": "body_2__Surge", "influenced_dof": "body_1__Pitch"}
    np.testing.assert_array_equal(dataset.added_mass.sel(one), bodies.added_mass[:, 4, 6])
    force = dataset.excitation_force.sel(influenced_dof="body_1__Pitch")
    np.testing.assert_array_equal(
        force.sel(complex="re") + 1j * force.sel(complex="im"), bodies.excitation_force[:, :, 4]
    )


def test_a_solid_of_revolution_has_sway_and_roll_as_surge_and_pitch(
    section: SimpleNamespace, solids: WholeBodies
) -> None:
    heave, roll, pitch, surge, sway = 2, 3, 4, 6, 7
    given = section.radiation
    assert np.flatnonzero(solids.modelled).tolist() == [heave, roll, pitch, surge, sway]
    mass = solids.added_mass[0]
    assert mass[heave, heave] == given.added_mass[1, 0, 0]
    assert mass[roll, roll] == mass[pitch, pitch] == given.added_mass[1, 1, 1]
    # About the y axis x turns to −z, about the x axis y turns to z.
    assert mass[surge, pitch] == -given.added_mass[1, 2, 1]
    assert mass[sway, roll] == given.added_mass[1, 2, 1]
    assert mass[sway, pitch] == mass[surge, roll] == mass[heave, pitch] == 0.0
    # Waves along x.
    np.testing.assert_array_equal(solids.excitation_force[:, :, [roll, sway]], 0.0)
    np.testing.assert_array_equal(solids.excitation_force[2, 1, pitch], -given.excitation_force[0, 0, 1, 1])
    cylinder, ring = solids.bodies
    assert cylinder.volume == pytest.approx(0.5 * np.pi, rel=1e-12)
    assert ring.waterplane_area == pytest.approx(12.0 * np.pi, rel=1e-12)
    assert cylinder.centre_of_gravity == pytest.approx((0.5, 0.0, -0.3))
    assert solids.stiffness.shape == solids.inertia.shape == (12, 12)


def test_files_of_solids_are_read_back(solids: WholeBodies, tmp_path: Path) -> None:
    write_wamit(solids, tmp_path, "solids")
    agrees(read_wamit(tmp_path, "solids", 12)[0], solids)
    write_bemio(solids, tmp_path / "solids.h5")
    agrees(read_bemio(tmp_path / "solids.h5", 2), solids)
    write_capytaine(solids, tmp_path / "solids.nc")
    with xarray.open_dataset(tmp_path / "solids.nc") as dataset:
        assert dataset.radiating_dof.values.tolist() == [
            *("body_1__Heave", "body_1__Roll", "body_1__Pitch", "body_2__Surge", "body_2__Sway")
        ]
        own = np.flatnonzero(solids.modelled)
        np.testing.assert_array_equal(
            dataset.added_mass.transpose("omega", "influenced_dof", "radiating_dof"),
            solids.added_mass[:, own[:, None], own],
        )
        assert dataset.hydrostatic_stiffness.shape == (5, 5)
