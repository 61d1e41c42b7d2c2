"""A dataset of open water reads like one of Capytaine, and each number arrives under its label."""

from __future__ import annotations

from dataclasses import replace
from math import inf
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray
from open_cases import problem_of
from open_tables import CIRCLE, DEEP, FROM_BOTH_SIDES, OIL, arbitrary_solution, open_dataset, open_scene, two_bodies

from hydroelastic.fem.open_water.radiation import solve_radiation
from hydroelastic.fem.open_water.response import solve_response
from hydroelastic.output.dataset import write_dataset
from hydroelastic.output.open_water.variables import COMMENT, open_variables
from hydroelastic.scenes.models.open_analyses import Radiation, Response


@pytest.fixture
def written(tmp_path: Path) -> xarray.Dataset:
    """The dataset of a circle in deep water, as a stranger opens it."""
    write_dataset(tmp_path / "dataset.nc", open_variables(arbitrary_solution(open_scene())), {"comment": COMMENT})
    return xarray.load_dataset(tmp_path / "dataset.nc")


def test_it_reads_like_a_dataset_of_capytaine(written: xarray.Dataset) -> None:
    table = arbitrary_solution(open_scene()).radiation[0]
    heave = written.added_mass.sel(radiating_dof="Heave", influenced_dof="Heave")
    assert heave.dims == ("omega",)
    np.testing.assert_array_equal(heave, table.added_mass[:, 0, 0])
    np.testing.assert_array_equal(
        written["radiation_damping"].sel(radiating_dof="Sway", influenced_dof="Heave"), table.radiation_damping[:, 0, 1]
    )
    real = written["excitation_force"].sel(complex="re")
    assert real.dims == ("omega", "wave_direction", "influenced_dof")
    np.testing.assert_array_equal(real, table.excitation_force[:, 0].real)
    np.testing.assert_array_equal(
        written["excitation_force"].sel(complex="im", wave_direction=np.pi, method=None, influenced_dof="Sway"),
        table.excitation_force[:, 0, 1, 1].imag,
    )
    assert written["wavenumber"].sel(omega=1.0) == pytest.approx(1.0 / 9.81, rel=1e-15)
    assert written["wavelength"].sel(omega=1.0) == pytest.approx(2.0 * np.pi * 9.81, rel=1e-15)
    assert (float(written["g"]), float(written["rho"]), float(written["water_depth"])) == (9.81, 1000.0, inf)
    assert str(written["body_name"].values) == "body_1"
    assert str(written["wave"].values) == "surface"


def test_capytaines_recipe_for_complex_numbers_and_motions_works(written: xarray.Dataset) -> None:
    """Its `merge_complex_values` and `rao`, in their own few lines: the equation of motion by labels."""
    force = written["excitation_force"].sel(complex="re") + 1j * written["excitation_force"].sel(complex="im")
    omega = written["omega"]
    impedance = (
        -(omega**2) * (written["inertia_matrix"] + written["added_mass"])
        - 1j * omega * written["radiation_damping"]
        + written["hydrostatic_stiffness"]
    ).transpose("omega", "radiating_dof", "influenced_dof")
    at = {"omega": 2.0, "wave_direction": 0.0}
    table = arbitrary_solution(open_scene()).radiation[0]
    expected = (
        -4.0 * (table.inertia + table.added_mass[2]) - 2.0j * table.radiation_damping[2] + table.stiffness
    ).T  # Capytaine puts the motion first
    np.testing.assert_allclose(impedance.sel(omega=2.0), expected, rtol=1e-15)
    np.testing.assert_allclose(
        force.sel(at)
        - (written["diffraction_force"].sel(complex="re") + 1j * written["diffraction_force"].sel(complex="im")).sel(
            at
        ),
        table.froude_krylov_force[2, 0, 0],
        rtol=0,
        atol=1e-15,
    )


@pytest.mark.slow
def test_motions_in_waves_follow_from_the_dataset_of_radiation() -> None:
    """Radiation and response are solved apart, and meet in the equation of motion by the dataset's labels.

    An ellipse off the origin, with an off-centre mass to couple sway and roll; matrices and forces to 1e-6 each.
    """
    ellipse = CIRCLE | {"half_height": 0.4, "motions": ["heave", "sway", "roll"], "centre_of_mass": -0.1}
    analyses: list[dict[str, Any]] = [
        {"kind": "radiation", "omega": [3.0]},
        {"kind": "response", "omega": [3.0]},
        {"kind": "response", "omega": [3.0], "waves_from": "right"},
    ]
    scene = open_scene(ellipse, liquids=(DEEP, OIL), analyses=analyses)
    problem = problem_of(scene)
    radiation, *responses = scene.analyses
    assert isinstance(radiation, Radiation)
    solution = replace(
        arbitrary_solution(scene),
        radiation=(solve_radiation(problem, radiation.request).table,),
        response=tuple(
            solve_response(problem, response.request).table for response in responses if isinstance(response, Response)
        ),
    )
    found = open_dataset(solution).sel(omega=3.0)
    impedance = (
        -9.0 * (found["inertia_matrix"] + found["added_mass"])
        - 3.0j * found["radiation_damping"]
        + found["hydrostatic_stiffness"]
    ).transpose("radiating_dof", "influenced_dof")
    for side in (0.0, np.pi):
        for wave in ("internal", "surface"):
            at = {"wave_direction": side, "wave": wave}
            force = found["excitation_force"].sel(at)
            expected = found["RAO"].sel(at).values
            # Rigid motions in SI: heave and sway in m, roll in rad, of like size here.
            motions = np.linalg.solve(impedance.values, force.values)
            np.testing.assert_allclose(motions, expected, rtol=0, atol=1e-5 * np.abs(expected).max())


def test_what_capytaine_has_no_name_for_is_there(written: xarray.Dataset) -> None:
    solution = arbitrary_solution(open_scene())
    response, resonance, decay = solution.response[0], solution.resonance[0], solution.decay[0]
    from_left = written.sel(omega=response.omega, wave_direction=0.0)
    np.testing.assert_array_equal(from_left["RAO"].sel(complex="im"), response.amplitudes[:, 0].imag)
    np.testing.assert_array_equal(
        from_left["transmission_coefficient"].sel(complex="re"), response.transmission[:, 0, 0].real
    )
    np.testing.assert_array_equal(
        from_left["reflection_coefficient"].sel(complex="im"), response.reflection[:, 0, 0].imag
    )
    assert np.isnan(written["RAO"].sel(omega=0.0)).all()
    np.testing.assert_array_equal(written["resonance_omega"].sel(complex="im"), resonance.omega.imag)
    assert list(written["resonance_motion"].values) == ["Heave", "Sway", "Heave", "Sway"]
    np.testing.assert_array_equal(written["decay_displacement"].sel(dof="Heave"), decay.displacement[:, 0])
    assert float(written["decay_tail"]) == decay.tail
    assert "exp(-i omega t)" in written.attrs["comment"]


def test_several_bodies_waves_and_sides_have_their_labels(tmp_path: Path) -> None:
    solution = two_bodies(FROM_BOTH_SIDES)
    write_dataset(tmp_path / "dataset.nc", open_variables(solution), {})
    found = xarray.load_dataset(tmp_path / "dataset.nc")
    radiation, (left, right) = solution.radiation[0], solution.response
    labels = ["body_1__Heave", "body_1__Sway", "body_2__Heave", "body_2__Pitch"]
    elastic = [f"body_2__Elastic {number}" for number in range(1, 5)]
    assert list(found.radiating_dof.values) == list(found.influenced_dof.values) == labels + elastic
    assert list(found.wave.values) == ["internal", "surface"]
    pair = found.added_mass.sel(radiating_dof="body_2__Pitch", influenced_dof="body_1__Sway")
    np.testing.assert_array_equal(pair.sel(omega=radiation.omega), radiation.added_mass[:, 1, 3])
    assert np.isnan(pair.sel(omega=4.0))
    rao = found["RAO"].sel(radiating_dof="body_1__Heave", wave="surface", complex="re")
    np.testing.assert_array_equal(rao.sel(omega=left.omega, wave_direction=0.0), left.amplitudes[:, 1, 0].real)
    np.testing.assert_array_equal(rao.sel(omega=right.omega, wave_direction=np.pi), right.amplitudes[:, 1, 0].real)
    into = found["reflection_coefficient"].sel(wave="surface", outgoing_wave="internal", complex="im")
    np.testing.assert_array_equal(into.sel(omega=left.omega, wave_direction=0.0), left.reflection[:, 1, 0].imag)
    bent = found["deflection_of_body_2"].sel(wave="internal", complex="re", wave_direction=np.pi)
    np.testing.assert_array_equal(bent.sel(omega=right.omega), right.plates[0].deflection[:, 0].real)
    np.testing.assert_array_equal(found["position_on_body_2"], np.linspace(1.0, 4.0, 101))
    assert (float(found["rho_upper"]), float(found["depth_upper"])) == (800.0, 1.0)
    np.testing.assert_array_equal(
        found["wavenumber"].sel(wave="internal", omega=radiation.omega), radiation.wavenumbers[:, 0]
    )


def test_several_resonance_analyses_are_numbered() -> None:
    analyses: list[dict[str, Any]] = [{"kind": "resonance"}, {"kind": "resonance", "count": 2}]
    found = open_dataset(arbitrary_solution(open_scene(analyses=analyses)))
    assert found["resonance_omega"].dims == ("analysis", "resonance")
    assert found["resonance_omega"].sel(analysis=2, resonance=2).item() == 2.0 - 0.2j
    assert np.isnan(found["resonance_omega"].sel(analysis=2, resonance=3).real)
    assert found["resonance_motion"].sel(analysis=2, resonance=3).item() == ""
