"""Files of hydrodynamics in Capytaine itself, where it is installed."""

import sys
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import xarray
from hydrodynamic_bodies import MATRICES, WIDTH, barge_and_beam, bodies_of_sections, scene, section_tables
from hydrodynamic_readers import rows

from hydroelastic.benchmarks.peers import PeerError, peer_folder
from hydroelastic.output.hydrodynamic_files.capytaine import write_capytaine
from hydroelastic.output.hydrodynamic_files.wamit import write_wamit
from hydroelastic.output.hydrodynamic_files.whole_bodies import WholeBodies, bodies_of_tables
from hydroelastic.physics.dofs import Dof
from hydroelastic.scenes.models.physical import physical_tank


@pytest.fixture(scope="module")
def section() -> SimpleNamespace:
    return section_tables()


@pytest.fixture(scope="module")
def bodies(section: SimpleNamespace) -> WholeBodies:
    return bodies_of_sections(section)


@pytest.fixture(scope="module")
def beam() -> WholeBodies:
    return barge_and_beam(section_tables())


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
