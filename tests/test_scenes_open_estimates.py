"""The thin-float theory stands beside the field solution of open water, and where it is exact both agree."""

from __future__ import annotations

from math import inf

import pytest
from mpi4py import MPI

from hydroelastic.fem.open_water.thin_float_theory import Comparison, thin_float_comparisons
from hydroelastic.output.open_water.tables import infinite_draught_message
from hydroelastic.scenes.models.bodies import Beam, Float
from hydroelastic.scenes.models.open_analyses import Decay, Radiation, Resonance
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.models.tank_parts import Accuracy, Liquid, Tank
from hydroelastic.scenes.models.time_analyses import Release
from hydroelastic.scenes.open_water.check import open_requests
from hydroelastic.scenes.open_water.estimates import infinite_draught_comparison
from hydroelastic.scenes.open_water.results import OpenSolution
from hydroelastic.scenes.open_water.run import run_open
from hydroelastic.scenes.open_water.solve import solve_open


def _scene(**changes: object) -> TankScene:
    keys = {"shape": "parabola", "position": 3.0, "half_width": 0.1, "half_height": 1.0, "boundary": "thin"} | changes
    return TankScene(
        tank=Tank(length=6.0, ends="open"),
        liquid=(Liquid(density=1000.0, depth=inf),),
        body=(Float.model_validate(keys),),
        analysis=(
            Radiation(omega=(2.0, 4.0)),
            Resonance(),
            Decay(displacement=Release(heave=0.1), times=(1.0, 5.0, 20.0)),
        ),
        accuracy=Accuracy(tolerance=1e-3),
    )


def _compared(solution: OpenSolution) -> tuple[tuple[Comparison, ...], str]:
    return thin_float_comparisons(physical_tank(solution.scene), solution)


@pytest.mark.slow
def test_thin_boundary_is_what_the_theory_solves() -> None:
    rows, note = _compared(solve_open(_scene(), MPI.COMM_SELF, lambda _message: None))
    assert [row.quantity.split()[0] for row in rows] == ["Re", "γ", "a", "b", "heave"]
    # The field is asked for 1e-3, and is known to be better by a factor of ten; the theory has twelve digits.
    assert max(abs(row.difference) for row in rows) < 2e-4
    assert "thickness" in note


@pytest.mark.slow
def test_exact_contour_differs_by_the_thinness() -> None:
    rows, _ = _compared(solve_open(_scene(boundary="exact"), MPI.COMM_SELF, lambda _message: None))
    differences = {row.quantity.split()[0]: abs(row.difference) for row in rows}
    # τ = 0.1: of first order in a, b and γ, of second order in Re ω.
    assert 1e-3 < differences["γ"] < 0.15
    assert differences["Re"] < 0.02
    assert 1e-3 < max(differences["a"], differences["b"]) < 0.15


def test_other_scenes_have_no_such_theory() -> None:
    heavy = _scene(mass=150.0)
    beam = heavy.model_copy(
        update={"body": (Beam(start=1.0, length=2.0, flexural_rigidity=1e4, mass_per_length=50.0),)}
    )
    for scene in (heavy, beam):
        assert _compared(OpenSolution(scene=scene, size={}, seconds={})) == ((), "")


def test_check_and_summary_compare_with_the_float_of_infinite_draught() -> None:
    scene = _scene(shape="exponential", half_width=0.5, tail=1e-3)
    told = infinite_draught_comparison(scene)
    assert told is not None
    # Against both closed forms, `test_modal_infinite_draught`: 0.0103.
    assert told.cut == pytest.approx(0.0116, rel=1e-2)
    assert infinite_draught_message(told) in list(open_requests(scene))
    summary = run_open.summarized(scene, OpenSolution(scene=scene, size={}, seconds={}))
    stored = summary["estimates"]["endless_float"]
    assert stored["cut"] == told.cut
    assert stored["residues"][1] == [told.residues[1].real, told.residues[1].imag]
    assert infinite_draught_comparison(_scene()) is None


def test_blunt_sections_say_why() -> None:
    scene = _scene(shape="rectangle", boundary="exact")
    rows, note = _compared(OpenSolution(scene=scene, size={}, seconds={}))
    assert rows == ()
    assert note.startswith("The thin-float theory has no value")


@pytest.mark.slow
@pytest.mark.mpi
def test_two_processes_agree() -> None:
    solution = solve_open(_scene(), MPI.COMM_WORLD, lambda _message: None)
    rows, _ = _compared(solution)
    assert max(abs(row.difference) for row in rows) < 2e-4
