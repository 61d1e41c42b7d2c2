"""The same files of beams, whose elastic modes follow their rigid motions."""

from pathlib import Path

import h5py
import numpy as np
import pytest
import xarray
from hydrodynamic_bodies import DIGITS, PHASE_AT, WIDTH, agrees, barge_and_beam, section_tables
from hydrodynamic_readers import read_bemio, read_nemoh, read_wamit, rows

from hydroelastic.output.hydrodynamic_files.bemio import write_bemio
from hydroelastic.output.hydrodynamic_files.capytaine import write_capytaine
from hydroelastic.output.hydrodynamic_files.nemoh import write_nemoh
from hydroelastic.output.hydrodynamic_files.wamit import write_wamit
from hydroelastic.output.hydrodynamic_files.whole_bodies import WholeBodies


@pytest.fixture(scope="module")
def beam() -> WholeBodies:
    return barge_and_beam(section_tables())


def test_a_beam_moves_about_its_centre_of_gravity_and_bends(beam: WholeBodies) -> None:
    heave, pitch, first = 8, 10, 12
    assert np.flatnonzero(beam.modelled).tolist() == [2, heave, pitch, first, first + 1]
    assert [own.stop for own in beam.spans] == [6, 14]
    assert beam.bodies[1].motions[6:] == ("Elastic 1", "Elastic 2")
    mass = 2.0 * 300.0 + 4.0 * 90.0
    centre = (600.0 * 1.0 + 360.0 * 4.0) / mass
    assert beam.bodies[1].centre_of_gravity == pytest.approx((10.0 + centre - PHASE_AT, 0.0, 0.0))
    assert beam.bodies[1].volume == pytest.approx(WIDTH * mass / 1025.0)
    # ∫m (x − x_G)² dx; heave and pitch about the centre of gravity do not couple, nor do they bend the beam.
    moment = 600.0 * (4.0 / 12.0 + (1.0 - centre) ** 2) + 360.0 * (16.0 / 12.0 + (4.0 - centre) ** 2)
    assert beam.inertia[heave, heave] == pytest.approx(WIDTH * mass)
    assert beam.inertia[pitch, pitch] == pytest.approx(WIDTH * moment)
    assert beam.inertia[heave, pitch] == pytest.approx(0.0, abs=1e-9 * WIDTH * moment)
    # ρg∫(x − x_G) dx: heave raises the bow, to the right, that positive pitch lowers.
    weight = 1025.0 * 9.8 * WIDTH
    assert beam.stiffness[heave, pitch] == pytest.approx(-weight * 6.0 * (3.0 - centre))
    assert beam.stiffness[pitch, pitch] == pytest.approx(weight * (6.0**3 / 12.0 + 6.0 * (3.0 - centre) ** 2))
    assert beam.stiffness[first, first] == pytest.approx(weight * 6.0)
    assert np.flatnonzero(beam.bending_stiffness.diagonal()).tolist() == [first, first + 1]
    assert np.all(beam.stiffness[:2] == 0.0)


def test_power_and_deflection_of_a_beam_are_those_of_the_tables(beam: WholeBodies) -> None:
    # The deflection of the right end: heave at the centre, less pitch, and the third of three unknowns.
    motions = beam.motions[0].amplitudes[0]
    random = np.random.default_rng(7)
    for shape in ((4, 5, 5), (4, 5, 5), (4, 1, 2, 5), (4, 1, 2, 5)):
        random.uniform(size=shape)
    heave, pitch, *elastic = random.uniform(1.0, 2.0, (1, 1, 6))[0, 0, 1:] * np.exp(1j)
    right = 16.0 - PHASE_AT - beam.bodies[1].centre_of_gravity[0]
    assert motions[8] - right * motions[10] == pytest.approx(heave + np.sqrt(3.0) * pitch)
    np.testing.assert_allclose(motions[12:], elastic[:2])


def test_files_of_beams_are_read_back(beam: WholeBodies, tmp_path: Path) -> None:
    write_wamit(beam, tmp_path, "beam")
    read, _, stiffness = read_wamit(tmp_path, "beam", 14)
    agrees(read, beam)
    np.testing.assert_allclose(stiffness, beam.stiffness / (beam.density * beam.gravity), rtol=DIGITS)
    assert (tmp_path / "beam.cfg").read_text().split() == ["NEWMDS(1)=0", "NEWMDS(2)=2"]
    external = np.array([line.split() for line in (tmp_path / "beam.mmx").read_text().splitlines()[2:]], dtype=float)
    np.testing.assert_allclose(external[:, 2].reshape(14, 14), beam.inertia, rtol=DIGITS, atol=1e-6)
    np.testing.assert_allclose(external[:, 4].reshape(14, 14), beam.bending_stiffness, rtol=DIGITS)
    write_bemio(beam, tmp_path / "beam.h5")
    agrees(read_bemio(tmp_path / "beam.h5", 2), beam)
    with h5py.File(tmp_path / "beam.h5") as file:
        properties = file["body2/properties"]
        assert [properties[name][0, 0] for name in ("dof", "dof_start", "dof_end")] == [8.0, 7.0, 14.0]
        # MATLAB's order of dimensions is the opposite one.
        np.testing.assert_array_equal(properties["mass"][:, :, 0], beam.inertia[6:])
        np.testing.assert_array_equal(properties["stiffness"][:, :, 0], beam.bending_stiffness[6:])
        restoring = file["body2/hydro_coeffs/linear_restoring_stiffness"][:, :, 0]
        np.testing.assert_allclose(restoring, beam.stiffness[6:, 6:] / (beam.density * beam.gravity))
    write_nemoh(beam, tmp_path)
    agrees(read_nemoh(tmp_path, beam.density, beam.gravity), beam)
    numbers = [line.split()[0] for line in (tmp_path / "Nemoh.cal").read_text().splitlines() if "Number of deg" in line]
    assert numbers == ["6", "8"]
    np.testing.assert_allclose(rows(tmp_path / "mesh" / "KH_1.dat"), beam.stiffness[6:, 6:], rtol=DIGITS, atol=1e-3)
    write_capytaine(beam, tmp_path / "beam.nc")
    with xarray.open_dataset(tmp_path / "beam.nc") as dataset:
        one = {"radiating_dof": "body_2__Elastic 1", "influenced_dof": "body_1__Heave"}
        np.testing.assert_array_equal(dataset.added_mass.sel(one), beam.added_mass[:, 2, 12])
        assert float(dataset.bending_stiffness.sel(one | {"influenced_dof": "body_2__Elastic 1"})) > 0.0
