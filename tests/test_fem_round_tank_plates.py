"""Round plates in tanks of revolution: references over a level bed, a closed form over a cone, scenes."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mpi4py import MPI
from open_cases import stored

from hydroelastic.fem.level_bed.solve import solve_level_tank
from hydroelastic.fem.plan.patches import level_patches
from hydroelastic.fem.tank.orders import solve_by_order
from hydroelastic.fem.tank.round_solution import round_solution
from hydroelastic.modal.plate.estimates import plate_estimates
from hydroelastic.modal.plate.round_estimates import round_plate_estimates
from hydroelastic.physics.geometry import Geometry
from hydroelastic.physics.level_tank import Cylinder, LevelTank
from hydroelastic.physics.plate import Disc, Plate
from hydroelastic.physics.round_plates import RoundPlate
from hydroelastic.physics.tank import Tank, tank
from hydroelastic.scenes.errors import SceneError
from hydroelastic.scenes.read import read_scene
from hydroelastic.scenes.round_tank.check import check_round_tank
from hydroelastic.scenes.round_tank.run import compare_round_tank
from hydroelastic.scenes.round_tank.solve import solve_round_scene

PLATES = {
    case["id"]: case for case in stored("three_dimensions.json")["cases"] if case["id"].startswith(("annulus", "disc"))
}
QUICK = ("annulus_s0", "disc_heavy_s1")
DISHED = """\
kind = "tank"
[tank]
radius = 10.0
outline = [[0.0, -10.0], [6.0, -6.0], [10.0, -4.0]]
[[liquid]]
density = 1000.0
depth = 10.0
[[body]]
kind = "plate"
outline = "disc"
radius = 3.0
flexural_rigidity = 1e4
mass_per_area = 5.0
[[body]]
kind = "plate"
outline = "ring"
inner_radius = 4.0
radius = 6.0
flexural_rigidity = 1e5
mass_per_area = 5.0
[accuracy]
tolerance = 1e-4
modes = 3
"""


def round_tank(radius: float, depth: float, *plates: RoundPlate) -> Tank:
    """Return a tank with one liquid and plates on it."""
    return tank(
        length=radius,
        gravity=9.81,
        is_open=False,
        liquids=((1000.0, depth),),
        top="free",
        bodies=plates,
        geometry=Geometry(kind="revolved"),
    )


def stored_tank(name: str) -> Tank:
    """Return a tank of the references."""
    given = PLATES[name]["inputs"]
    plate = RoundPlate(
        radius=given["a"],
        inner_radius=given["b"],
        flexural_rigidity=float(given["D"]),
        mass_per_area=given["m"],
        poisson_ratio=given["nu"],
        hydrostatic=bool(given["s"]),
    )
    return round_tank(given["R"], given["H"], plate)


@pytest.mark.mpi
@pytest.mark.parametrize(
    "name", [*QUICK, *(pytest.param(name, marks=pytest.mark.slow) for name in PLATES if name not in QUICK)]
)
def test_plates_over_a_level_bed(name: str) -> None:
    """Frequencies of eleven digits by a radial problem; bounds of estimates as for all tanks: 1 to 30 times the error,
    with 1e-12 of rounding in the references."""
    solution = solve_by_order(stored_tank(name), tolerance=1e-6, modes=8)
    assert not solution.reasons
    assert sum(mode.multiplicity for mode in solution.modes) == sum(PLATES[name]["multiplicity"][:8])
    for mode, known in zip(solution.modes, PLATES[name]["omega"], strict=False):
        error = abs(mode.omega / known - 1.0)
        assert error < mode.relative_error + 1e-12
        assert mode.relative_error < 30.0 * error + 1e-10


def test_the_lowest_mode_of_a_cover_has_two_nodal_diameters() -> None:
    """Orders 0 and 1 have none below it: the volume is constant, and pitch lifts much water."""
    (mode,) = solve_by_order(stored_tank("disc_full_s0"), tolerance=1e-4, modes=1).modes
    assert mode.order == 2
    assert mode.omega == pytest.approx(PLATES["disc_full_s0"]["omega"][0], rel=1e-4)


def test_a_covered_cone_pitches_as_a_whole() -> None:
    """ψ = xz from the apex of a cone of 45 degrees and w = x, which bends no plate: ω² = ρg/(ρH + m)."""
    depth, mass = 2.0, 300.0
    cover = RoundPlate(radius=depth, flexural_rigidity=5e3, mass_per_area=mass)
    cone = replace(round_tank(depth, depth, cover), bed=((0.0, -depth), (depth, 0.0)))
    solution = solve_by_order(cone, tolerance=1e-6, modes=3)
    found = next(mode for mode in solution.modes if mode.order == 1)
    assert found.omega == pytest.approx(np.sqrt(1000.0 * 9.81 / (1000.0 * depth + mass)), rel=1e-10)
    assert found.kind == "pitch"


def test_the_first_elastic_tone_is_that_of_the_radial_problem() -> None:
    """Both models are independent in depth and radius; the tolerance is the sum of their estimates."""
    plate = RoundPlate(radius=2.0, flexural_rigidity=5000.0, mass_per_area=50.0, hydrostatic=False)
    (found,) = round_solution(round_tank(5.0, 3.0, plate), tolerance=1e-5, modes=3).tones
    same = Plate(outline=Disc(radius=2.0), flexural_rigidity=5000.0, mass_per_area=50.0, hydrostatic=False)
    level = LevelTank(plan=Cylinder(radius=5.0), depth=3.0, density=1000.0, gravity=9.81, plates=(same,))
    (known,) = solve_level_tank(level, tolerance=1e-5, modes=3).tones
    assert found.order == known.order == 2
    assert found.tone is not None
    assert known.tone is not None
    assert found.tone.participation == pytest.approx(known.tone.participation, rel=1e-4)
    pairs: list[tuple[Any, Any, Any]] = [
        (found.eigenvalue, known.eigenvalue, (found.relative_error, known.relative_error)),
        (
            found.pressure_release,
            known.pressure_release,
            (found.pressure_release_error, known.pressure_release_error),
        ),
        (found.dry, known.dry, (1e-10,)),
        (found.mass / found.squares, known.mass / known.squares, (1e-10,)),
    ]
    for one, other, errors in pairs:
        assert one == pytest.approx(other, rel=2.0 * sum(errors))


def test_plates_of_a_scene_over_a_dished_bed(tmp_path: Path) -> None:
    """Each plate has its tone, and is drawn to its edges: the displacement jumps between plate and water alone."""
    (tmp_path / "dish.toml").write_text(DISHED, encoding="utf-8")
    scene = read_scene(tmp_path / "dish.toml")
    told = [row[1] for section in check_round_tank(scene) for row in section.rows]  # type: ignore[arg-type]
    assert "r from 4 to 6 m, w = Σ aᵢ Wᵢ(r) cos nθ" in told
    solution = solve_round_scene(scene, MPI.COMM_SELF, lambda _: None).tank  # type: ignore[arg-type]
    assert [tone.plate for tone in solution.tones] == [0, 1]
    assert not solution.reasons
    mode = next(one for one in solution.modes if one.problem.order == 0)
    for patch in level_patches(solution.tank):
        if patch.plate is not None:
            elevation = mode.problem.sampled(mode.mode, *patch.points.T, second=False).elevation  # type: ignore[attr-defined]
            rings = elevation.reshape(patch.shape)
            np.testing.assert_allclose(rings, rings[:, :1] * np.ones(patch.shape[1]), rtol=1e-9)
            # Between neighbouring circles a plate bends by little: the outermost ones are the plate's, not the water's.
            steps = np.abs(np.diff(rings[:, 0]))
            assert steps[-1] < 2.0 * np.median(steps)


def test_estimates_of_plates_take_a_shaped_bed_as_level() -> None:
    """A bed of flat rings is the level one; a sphere's mean depth below a disc of radius a is a closed form."""
    plate = RoundPlate(radius=2.0, flexural_rigidity=5000.0, mass_per_area=50.0)
    physical = round_tank(5.0, 3.0, plate)
    disc = Plate(outline=Disc(radius=2.0), flexural_rigidity=5000.0, mass_per_area=50.0)
    level = LevelTank(plan=Cylinder(radius=5.0), depth=3.0, density=1000.0, gravity=9.81, plates=(disc,))
    known = plate_estimates(level)
    assert tuple(round_plate_estimates(physical, level)) == known
    flat = round_plate_estimates(replace(physical, bed=((0.0, -3.0), (4.0, -3.0), (5.0, -3.0))), level)
    for one, other in zip(flat, known, strict=True):
        assert one.omega == pytest.approx(other.omega, rel=1e-12)
        assert one.note == f"{other.note}; the bed as if level at 3 m, its mean depth below the plate"
    bowl = replace(physical, length=5.0, bed="sphere")
    radius = (25.0 + 9.0) / 6.0
    mean = 2.0 * (radius**3 - (radius**2 - 4.0) ** 1.5) / (3.0 * 4.0) - radius + 3.0
    deep = plate_estimates(replace(level, depth=mean))
    for one, other in zip(round_plate_estimates(bowl, level), deep, strict=True):
        # A thousand circles leave 1e-7 of the mean depth.
        assert one.omega == pytest.approx(other.omega, rel=1e-6)
    assert not tuple(round_plate_estimates(round_tank(5.0, 3.0, replace(plate, tension=10.0)), level))


def test_plates_over_a_dished_bed_are_beside_their_estimates(tmp_path: Path) -> None:
    """Under a lid the water between the plates cannot rise: a fifth too low and an eighth too high."""
    (tmp_path / "dish.toml").write_text(DISHED, encoding="utf-8")
    scene = read_scene(tmp_path / "dish.toml")
    estimates = compare_round_tank(scene).summary["estimates"]  # type: ignore[arg-type]
    found = {name: one["difference"] for name, one in estimates.items() if name.startswith("rayleigh")}
    # Measured.
    assert found == {"rayleigh_lid": pytest.approx(-0.154, abs=2e-3), "rayleigh_lid_2": pytest.approx(0.129, abs=2e-3)}


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (("radius = 6.0", "radius = 11.0"), 'key "radius" = 11.0: the plate is wider than the tank'),
        (("inner_radius = 4.0", "inner_radius = 3.0"), "the plate overlaps or touches [[body]] number 1"),
        (('outline = "disc"', 'outline = "disc"\nedge = "clamped"'), 'key "edge" = "clamped": it is not known here'),
    ],
)
def test_plates_that_are_refused(change: tuple[str, str], said: str, tmp_path: Path) -> None:
    (tmp_path / "dish.toml").write_text(DISHED.replace(*change), encoding="utf-8")
    with pytest.raises(SceneError) as caught:
        read_scene(tmp_path / "dish.toml")
    assert said in str(caught.value)
