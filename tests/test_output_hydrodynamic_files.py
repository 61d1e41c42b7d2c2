"""Files of WAMIT, BEMIO, Nemoh and Capytaine of a solution, read back by readers of the formats' descriptions."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import h5py
import numpy as np
import pytest
import xarray
from hydrodynamic_readers import Read, read_bemio, read_nemoh, read_wamit, rows
from open_cases import answer, sea

DENSITY, GRAVITY, PHASE_AT = 1025.0, 9.8, -0.5
# Numbers are written with ten digits.
DIGITS = 1e-8
BARGE: dict[str, Any] = {"kind": "float", "shape": "rectangle", "half_width": 2.0, "half_height": 1.0, "position": 1.0}
BARGE |= {"motions": ["heave", "sway", "roll"], "vertical_centre_of_gravity": 0.2, "radius_of_gyration": 1.1}
BEAM: dict[str, Any] = {
    "start": 10.0,
    "sections": [
        {"length": 2.0, "flexural_rigidity": 3e5, "mass_per_length": 300.0},
        {"length": 4.0, "flexural_rigidity": 1e5, "mass_per_length": 90.0},
    ],
}
SPAR: dict[str, Any] = {"kind": "float", "shape": "cylinder", "draught": 0.5, "radius": 1.0}
SPAR |= {"motions": ["heave", "surge", "pitch"], "vertical_centre_of_gravity": -0.3}
ANALYSES: list[dict[str, Any]] = [
    {"kind": "radiation", "omega": [1.0, 1.5, 2.0, float("inf")], "elastic_modes": 1},
    {"kind": "response", "omega": [1.5], "waves_from": "right"},
    {"kind": "impulse_response", "times": [0.0, 1.0, 2.0], "elastic_modes": 1},
]
# Place and sign of each motion of a body in the files: about the y axis x turns to −z, about the x axis y to z.
OF_SECTION = {"heave": [(2, 1.0)], "sway": [(0, 1.0)], "roll": [(4, -1.0)], "pitch": [(4, -1.0)]}
OF_SECTION |= {"elastic 1": [(6, 1.0)]}
OF_SOLID = {"heave": [(2, 1.0)], "surge": [(0, 1.0), (1, 1.0)], "pitch": [(4, -1.0), (3, 1.0)]}
CASES = {
    "barge": ([BARGE], 7.0, OF_SECTION, [6]),
    "barge and beam": ([BARGE, BEAM], 7.0, OF_SECTION, [6, 7]),
    "spar": ([SPAR], None, OF_SOLID, [6]),
}


@pytest.fixture(scope="module", params=CASES)
def written(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> SimpleNamespace:
    """A solution with its files, and what they must hold, whole bodies in SI units."""
    bodies, width, places, counts = CASES[request.param]
    export = {"formats": ["wamit", "bemio", "nemoh", "capytaine"]} | ({"width": width} if width else {})
    keys = {"sea": {"phase_at": PHASE_AT, "gravity": GRAVITY}, "export": export, "density": DENSITY}
    analyses = ANALYSES[: 2 if width else 3]
    keys["export"] = export | ({"formats": ["wamit", "nemoh", "capytaine"]} if width else {})
    found = answer(sea(*bodies, depth=12.0, tolerance=1e-1, **keys), *analyses)
    folder = tmp_path_factory.mktemp("export") / "result"
    found.result.save(folder, images=None)
    (table,) = found.radiation
    size, starts = sum(counts), np.cumsum([0, *counts])
    # Columns are the motions of the table; a solid moves and is pushed alike along y, where waves along x do not push.
    along, across = np.zeros((size, len(table.dofs))), np.zeros((size, len(table.dofs)))
    for column, dof in enumerate(table.dofs):
        body, name = (int(dof[5]) - 1, dof[8:]) if dof.startswith("body_") else (0, dof)
        for part, (place, sign) in zip((along, across), places[name], strict=False):
            part[starts[body] + place, column] = sign

    if BEAM in bodies:
        # Force on x − x_G of that on √3 (2x/l − 1), which is what pitch of the table is, and on heave.
        centre, half = 10.0 + (600.0 * 1.0 + 360.0 * 4.0) / 960.0, 3.0
        heave, pitch = (table.dofs.index(f"body_2__{name}") for name in ("heave", "pitch"))
        along[starts[1] + 4, [heave, pitch]] = -(10.0 + half - centre), -half / np.sqrt(3.0)

    def whole(matrix: np.ndarray) -> np.ndarray:
        """Heave is in both parts, and once in the sum; other motions are in one."""
        return (width or 1.0) * np.asarray(along @ matrix @ along.T + across @ matrix @ across.T)

    force = (width or 1.0) * table.excitation_force[:3, 0] @ along.T
    return SimpleNamespace(
        folder=folder / "export",
        size=size,
        counts=counts,
        table=table,
        along=along,
        mass=np.array([whole(one) for one in table.added_mass]),
        damping=np.array([whole(one) for one in table.radiation_damping[:3]]),
        stiffness=whole(table.stiffness),
        force=force,
        width=width,
        found=found,
    )


def agrees(read: Read, written: SimpleNamespace) -> None:
    """In the scales of WAMIT, with e^{iωt} instead of e^{−iωt}."""
    omega = np.array([1.0, 1.5, 2.0])
    np.testing.assert_allclose(read.omega, omega, rtol=DIGITS)
    scale = np.abs(written.mass).max() / DENSITY
    np.testing.assert_allclose(read.added_mass, written.mass[:3] / DENSITY, rtol=DIGITS, atol=DIGITS * scale)
    per_frequency = written.damping / (DENSITY * omega[:, None, None])
    np.testing.assert_allclose(read.damping, per_frequency, rtol=DIGITS, atol=DIGITS * scale)
    force = np.conj(written.force) / (DENSITY * GRAVITY)
    np.testing.assert_allclose(read.force, force, rtol=DIGITS, atol=DIGITS * np.abs(force).max())


def test_wamit_is_read_back(written: SimpleNamespace) -> None:
    read, limits, stiffness = read_wamit(written.folder, "bodies", written.size)
    agrees(read, written)
    # PER = 0 is the infinite frequency.
    scale = np.abs(written.mass).max() / DENSITY
    np.testing.assert_allclose(limits[0.0], written.mass[3] / DENSITY, rtol=DIGITS, atol=DIGITS * scale)
    if len(written.counts) == 1:
        known = written.stiffness / (DENSITY * GRAVITY)
        np.testing.assert_allclose(stiffness, known, rtol=DIGITS, atol=DIGITS * np.abs(known).max())
    motions = rows(written.folder / "bodies.4")
    np.testing.assert_allclose(motions[:, 0], 2.0 * np.pi / 1.5, rtol=DIGITS)
    np.testing.assert_array_equal(motions[:, 1], 180.0)
    (response,) = written.found.response
    own = [response.dofs.index(dof) for dof in written.table.dofs]
    moved = np.linalg.pinv(written.along).T @ response.amplitudes[0, 0, own]
    known = np.conj(moved)[motions[:, 2].astype(int) - 1]
    np.testing.assert_allclose(motions[:, 5] + 1j * motions[:, 6], known, rtol=DIGITS, atol=DIGITS)


def test_bemio_is_read_back(written: SimpleNamespace) -> None:
    if written.width:
        assert not list(written.folder.glob("*.h5"))
        return
    (path,) = written.folder.glob("*.h5")
    agrees(read_bemio(path, 1), written)
    with h5py.File(path) as file:
        assert file["simulation_parameters/water_depth"][0, 0] == 12.0
        (rest,) = written.found.summary["bodies"]
        x, height = rest["centre_of_gravity"]
        cg = file["body1/properties/cg"][:, 0]
        np.testing.assert_allclose(cg, (x - PHASE_AT, 0.0, height), atol=1e-12)
        response = file["body1/hydro_coeffs/radiation_damping/impulse_response_fun"]
        (impulse,) = written.found.impulse_response
        heave = impulse.dofs.index("heave")
        known = (written.width or 1.0) * impulse.impulse_response[:, heave, heave] / DENSITY
        np.testing.assert_allclose(response["K"][2, 2], known, rtol=1e-12)


def test_nemoh_is_read_back(written: SimpleNamespace) -> None:
    (folder,) = (path.parent for path in written.folder.rglob("Nemoh.cal"))
    agrees(read_nemoh(folder, DENSITY, GRAVITY), written)
    known = written.stiffness[:6, :6]
    found = rows(folder / "mesh" / "KH_0.dat" if len(written.counts) > 1 else folder / "mesh" / "KH.dat")
    np.testing.assert_allclose(found, known, rtol=DIGITS, atol=DIGITS * np.abs(known).max())


def test_capytaine_finds_the_motions_of_the_response(written: SimpleNamespace) -> None:
    """By the labels of its dataset, in the lines of its own `rao`."""
    (path,) = written.folder.glob("*.nc")
    found = xarray.load_dataset(path).sel(omega=1.5)
    force = found.excitation_force.sel(complex="re") + 1j * found.excitation_force.sel(complex="im")
    stiffness = found.hydrostatic_stiffness + found.get("bending_stiffness", 0.0)
    impedance = -2.25 * (found.inertia_matrix + found.added_mass) - 1.5j * found.radiation_damping + stiffness
    impedance = impedance.transpose("influenced_dof", "radiating_dof")
    names = [str(one) for one in found.radiating_dof.values]
    moved = np.linalg.solve(impedance.values, force.sel(wave_direction=np.pi).values.ravel())
    (response,) = written.found.response
    heave = next(place for place, name in enumerate(names) if name.endswith("Heave"))
    known = response.amplitudes[0, 0, next(place for place, dof in enumerate(response.dofs) if dof.endswith("heave"))]
    # The tolerance of both analyses; shapes beyond the first are left out.
    assert moved[heave] == pytest.approx(known, rel=5e-2)
