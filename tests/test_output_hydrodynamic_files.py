"""Files of WAMIT, BEMIO, Nemoh and Capytaine, read back by readers written from the formats' descriptions."""

import sys
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import h5py
import numpy as np
import pytest
import xarray
from hydrodynamic_readers import Read, read_bemio, read_nemoh, read_wamit, rows

from hydroelastic.benchmarks.peers import PeerError, peer_folder
from hydroelastic.fem.open_water.results import RadiationTable, ResponseTable
from hydroelastic.fem.time_domain.results import ImpulseResponseTable
from hydroelastic.modal.beam.beam_shapes import beam_shapes
from hydroelastic.output.hydrodynamic_files.bemio import write_bemio
from hydroelastic.output.hydrodynamic_files.capytaine import write_capytaine
from hydroelastic.output.hydrodynamic_files.nemoh import write_nemoh
from hydroelastic.output.hydrodynamic_files.wamit import write_wamit
from hydroelastic.output.hydrodynamic_files.whole_bodies import WholeBodies, bodies_of_tables
from hydroelastic.physics.dofs import Dof, Turn
from hydroelastic.scenes.errors import SceneError
from hydroelastic.scenes.models import SeaScene
from hydroelastic.scenes.models.physical import physical_tank

WIDTH = 7.0
MATRICES = ("added_mass", "radiation_damping")
# Numbers are written with ten digits.
DIGITS = 1e-8
PHASE_AT = -0.5


def scene(**changes: Any) -> SeaScene:
    barge: dict[str, Any] = {
        "kind": "float",
        "shape": "rectangle",
        "half_width": 2.0,
        "half_height": 1.0,
        "motions": ["heave", "roll"],
    }
    disc = {"kind": "float", "shape": "ellipse", "half_width": 1.0, "half_height": 1.0, "motions": ["sway"]}
    barge |= {"position": 1.0, "vertical_centre_of_gravity": 0.2, "radius_of_gyration": 1.1}
    keys = {
        "sea": {"phase_at": PHASE_AT, "gravity": 9.8},
        "liquid": [{"density": 1025.0, "depth": 12.0}],
        "body": [barge, disc | {"position": 6.0}],
        "analysis": [{"kind": "radiation", "omega": [0.5, 1.0, 1.5]}],
    }
    return SeaScene(**keys | changes)


DOFS = (Dof("body_1__heave"), Dof("body_1__roll"), Dof("body_2__sway"))


@pytest.fixture(scope="module")
def section() -> SimpleNamespace:
    """Numbers of a section as a solver would give them, without its symmetries."""
    random = np.random.default_rng(5)

    def numbers(*shape: int) -> np.ndarray:
        return random.uniform(0.5, 1.5, shape) * 1e3

    def complex_numbers(*shape: int) -> np.ndarray:
        return np.asarray(numbers(*shape) * np.exp(2j * np.pi * random.uniform(size=shape)))

    omega = np.array([1.5, 0.5, np.inf, 1.0])
    finite = np.isfinite(omega)
    froude_krylov, diffraction = (complex_numbers(4, 1, 2, 3) * finite[:, None, None, None] for _ in range(2))
    radiation = RadiationTable(
        omega=omega,
        dofs=DOFS,
        waves=("surface",),
        wavenumbers=omega[:, None],
        added_mass=numbers(4, 3, 3),
        radiation_damping=numbers(4, 3, 3),
        excitation_force=froude_krylov + diffraction,
        froude_krylov_force=froude_krylov,
        diffraction_force=diffraction,
        relative_error=np.zeros(4),
        energy_residual=np.zeros(4),
        haskind_residual=np.zeros(4),
        inertia=np.diag([3.0, 2.0, 5.0]) * 1e3,
        stiffness=np.diag([4.0, 7.0, 0.0]) * 1e4,
        infinite_frequency_added_mass=None,
        factorizations=0,
    )
    response = SimpleNamespace(
        omega=np.array([1.0]), dofs=DOFS, waves_from="right", amplitudes=complex_numbers(1, 1, 3)
    )
    times = np.linspace(0.0, 4.0, 9)
    impulse = SimpleNamespace(
        times=times, dofs=DOFS, impulse_response=numbers(9, 3, 3), infinite_frequency_added_mass=numbers(3, 3)
    )
    return SimpleNamespace(radiation=radiation, response=response, impulse=impulse)


@pytest.fixture(scope="module")
def bodies(section: SimpleNamespace) -> WholeBodies:
    return bodies_of_tables(
        physical_tank(scene()),
        [section.radiation],
        [cast(ResponseTable, section.response)],
        [cast(ImpulseResponseTable, section.impulse)],
        width=WIDTH,
    )


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


def agrees(read: Read, bodies: WholeBodies) -> None:
    scale, weight = bodies.density, bodies.density * bodies.gravity
    np.testing.assert_allclose(read.omega, bodies.omega, rtol=DIGITS)
    np.testing.assert_allclose(read.added_mass, bodies.added_mass / scale, rtol=DIGITS)
    per_frequency = bodies.radiation_damping / (scale * bodies.omega[:, None, None])
    np.testing.assert_allclose(read.damping, per_frequency, rtol=DIGITS)
    # e^{iωt} instead of e^{−iωt}.
    np.testing.assert_allclose(read.force, np.conj(bodies.excitation_force) / weight, rtol=DIGITS, atol=1e-12)


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


@pytest.fixture
def capytaine(monkeypatch: pytest.MonkeyPatch) -> Any:
    """Capytaine where it is installed, if only for the benchmarks, behind all that the environment has."""
    try:
        folder = peer_folder("capytaine", install=False, report=lambda _message: None)
    except PeerError as error:
        pytest.skip(f"{error}; `./hydro bench` installs it")
    if folder is not None:
        monkeypatch.setattr(sys, "path", [*sys.path, str(folder)])
    return pytest.importorskip("capytaine")


def opened(path: Path) -> Any:
    """A dataset as Capytaine takes it, complex."""
    from capytaine.io.xarray import merge_complex_values

    return merge_complex_values(xarray.load_dataset(path))


@pytest.mark.parametrize("which", ["bodies", "beam"])
def test_capytaine_finds_the_motions_in_waves(
    which: str, capytaine: Any, request: pytest.FixtureRequest, tmp_path: Path
) -> None:
    """Its own functions read the dataset, rigid bodies and elastic modes alike."""
    whole: WholeBodies = request.getfixturevalue(which)
    write_capytaine(whole, tmp_path / "barge.nc")
    dataset = opened(tmp_path / "barge.nc")
    own = np.flatnonzero(whole.modelled)
    matrices = np.ix_(own, own)
    found = capytaine.post_pro.rao(dataset, wave_direction=np.pi, stiffness=dataset.get("bending_stiffness"))
    for row, omega in enumerate(whole.omega):
        impedance = (
            -(omega**2) * (whole.inertia + whole.added_mass[row])
            - 1j * omega * whole.radiation_damping[row]
            + whole.stiffness
            + whole.bending_stiffness
        )[matrices]
        expected = np.linalg.solve(impedance, whole.excitation_force[row, 1, own])
        np.testing.assert_allclose(found.sel(omega=omega).values.squeeze(), expected, rtol=1e-10)


@pytest.mark.usefixtures("capytaine")
def test_capytaine_writes_the_same_files_of_wamit(section: SimpleNamespace, tmp_path: Path) -> None:
    """Two writers of one format, of one body in heave, sway and roll."""
    from capytaine.io.wamit import export_wamit_1, export_wamit_3

    barge = scene().model_dump()["body"][0] | {"motions": ["heave", "sway", "roll"]}
    dofs = tuple(Dof(name) for name in ("heave", "sway", "roll"))
    one = scene(body=[{name: value for name, value in barge.items() if value is not None}])
    # Capytaine has the motion before the force, which is the same of matrices that are symmetric.
    given = section.radiation
    symmetric = {name: getattr(given, name) + getattr(given, name).swapaxes(1, 2) for name in MATRICES}
    radiation = replace(given, dofs=dofs, **symmetric)
    whole = bodies_of_tables(physical_tank(one), [radiation], [], [], width=WIDTH)
    write_wamit(replace(whole, limits=(None, None)), tmp_path, "ours")
    write_capytaine(whole, tmp_path / "barge.nc")
    dataset = opened(tmp_path / "barge.nc")
    export_wamit_1(dataset, str(tmp_path / "theirs.1"))
    export_wamit_3(dataset, str(tmp_path / "theirs.3"))
    # Of phases they write three decimals.
    for kind, columns in (("1", [3, 4]), ("3", [3, 5, 6])):
        ours, theirs = (
            {tuple(np.round(row[:3], 3)): row[columns] for row in rows(tmp_path / f"{who}.{kind}")}
            for who in ("ours", "theirs")
        )
        # Six digits are written there.
        for at, values in ours.items():
            np.testing.assert_allclose(theirs[at], values, rtol=2e-6, atol=1e-6, err_msg=f".{kind} {at}")


SOLIDS = (Dof("body_1__heave"), Turn("body_1__pitch"), Dof("body_2__surge"))


@pytest.fixture(scope="module")
def solids(section: SimpleNamespace) -> WholeBodies:
    """The same numbers of a cylinder in heave and pitch, and of a ring around it in surge."""
    body: dict[str, Any] = {"kind": "float", "shape": "cylinder", "draught": 0.5}
    spar = body | {"radius": 1.0, "motions": ["heave", "pitch"], "vertical_centre_of_gravity": -0.3}
    ring = body | {"radius": 4.0, "inner_radius": 2.0, "motions": ["surge"]}
    radiation = replace(section.radiation, dofs=SOLIDS)
    # Heave is of another order than surge and pitch.
    for name in MATRICES:
        values = getattr(radiation, name).copy()
        values[:, 0, 1:] = values[:, 1:, 0] = 0.0
        radiation = replace(radiation, **{name: values})
    impulse = SimpleNamespace(**vars(section.impulse) | {"dofs": SOLIDS})
    return bodies_of_tables(physical_tank(scene(body=[spar, ring])), [radiation], [], [cast(Any, impulse)])


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


BEAM: dict[str, Any] = {
    "start": 10.0,
    "sections": [
        {"length": 2.0, "flexural_rigidity": 3e5, "mass_per_length": 300.0},
        {"length": 4.0, "flexural_rigidity": 1e5, "mass_per_length": 90.0},
    ],
}
OF_BEAM = tuple(Dof(f"body_2__{name}") for name in ("heave", "pitch", "elastic 1", "elastic 2"))


@pytest.fixture(scope="module")
def beam(section: SimpleNamespace) -> WholeBodies:
    """A barge that heaves and a beam of two sections, in arbitrary numbers but for what the beam itself is."""
    dofs = (Dof("body_1__heave"), *OF_BEAM)
    barge = {"kind": "float", "shape": "rectangle", "half_width": 2.0, "half_height": 1.0, "motions": ["heave"]}
    tank = physical_tank(scene(body=[barge | {"position": 1.0}, BEAM]))
    shapes = beam_shapes(tank.beams[1], len(OF_BEAM))
    inertia, stiffness = np.diag([5e3, *np.zeros(4)]), np.diag([4e4, *(1025.0 * 9.8 * 6.0 + shapes.bending)])
    inertia[1:, 1:] = shapes.mass
    random = np.random.default_rng(7)
    numbers = {
        "added_mass": random.uniform(1e2, 1e3, (4, 5, 5)),
        "radiation_damping": random.uniform(1e2, 1e3, (4, 5, 5)),
        "froude_krylov_force": random.uniform(1e2, 1e3, (4, 1, 2, 5)) * np.exp(2j),
        "diffraction_force": random.uniform(1e2, 1e3, (4, 1, 2, 5)) * np.exp(1j),
    }
    radiation = replace(section.radiation, dofs=dofs, inertia=inertia, stiffness=stiffness, **numbers)
    response = SimpleNamespace(
        omega=np.array([1.0]),
        # More modes move than radiation reports.
        dofs=(*dofs, Dof("body_2__elastic 3")),
        waves_from="left",
        amplitudes=random.uniform(1.0, 2.0, (1, 1, 6)) * np.exp(1j),
    )
    impulse = SimpleNamespace(
        times=section.impulse.times,
        impulse_response=random.uniform(1e2, 1e3, (9, 5, 5)),
        infinite_frequency_added_mass=random.uniform(1e2, 1e3, (5, 5)),
    )
    return bodies_of_tables(tank, [radiation], [cast(Any, response)], [cast(Any, impulse)], width=WIDTH)


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


EXPORT = {"formats": ["wamit"], "width": 3.0}
IMPULSE = {"kind": "impulse_response", "times": [0.0, 1.0, 2.0]}
OF_RADIATION: dict[str, Any] = {"kind": "radiation", "omega": [0.5, 1.0]}
DISC = {"kind": "plate", "outline": "disc", "radius": 5.0, "youngs_modulus": 6e9, "thickness": 1.0, "density": 900.0}
DISC |= {"poisson_ratio": 0.3}


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"export": {"formats": ["wamit"]}}, "width"),
        ({"export": EXPORT, "body": [{"kind": "float", "shape": "sphere", "radius": 1.0}]}, "solids of revolution"),
        ({"export": {"formats": ["wamit", "wamit"], "width": 1.0}}, "named twice"),
        ({"export": {"formats": ["hydrostar"], "width": 1.0}}, "formats"),
        ({"export": EXPORT, "analysis": []}, "analysis of radiation"),
        ({"export": EXPORT, "liquid": [{"density": 1025.0, "depth": 3.0}, {"density": 1.2, "depth": 5.0}]}, "two"),
        ({"export": {"formats": ["wamit"]}, "body": [DISC]}, "a plate is neither"),
        (
            {"export": EXPORT, "body": [BEAM], "analysis": [OF_RADIATION, OF_RADIATION | {"elastic_modes": 2}]},
            "different elastic_modes",
        ),
        ({"export": EXPORT | {"formats": ["bemio"]}}, "impulse responses at equally spaced times"),
        (
            {"export": EXPORT | {"formats": ["nemoh"]}, "analysis": [{"kind": "radiation", "omega": [0.5, 1.0, 2.0]}]},
            "equally spaced",
        ),
    ],
)
def test_what_files_need_is_asked_for(changes: dict[str, Any], words: str) -> None:
    with pytest.raises(SceneError, match=words):
        scene(**changes)


def test_all_files_are_possible() -> None:
    asked = scene(
        export={"formats": ["wamit", "bemio", "nemoh", "capytaine"], "width": 3.0},
        analysis=[{"kind": "radiation", "omega": [0.5, 1.0, 1.5]}, IMPULSE],
    )
    assert asked.export is not None
    assert asked.export.width == 3.0
    assert "export" not in scene().model_dump()
