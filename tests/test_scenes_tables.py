"""Printed tables: errors that say what they are relative to, numbers no longer than they are certain, few rows."""

from __future__ import annotations

from dataclasses import replace
from math import degrees

import numpy as np
import pytest
from open_tables import CIRCLE, arbitrary_solution, open_scene

from hydroelastic.fem.open_water.results import DecayTable
from hydroelastic.output.digits import beyond_error
from hydroelastic.output.open_water.tables import MOST_ROWS, open_sections
from hydroelastic.output.quantity_tables import headings, without_zeros
from hydroelastic.output.reading import Reading
from hydroelastic.output.sections import Section
from hydroelastic.output.tank.quantities import BENDING, MODES
from hydroelastic.physics.dofs import Dof
from hydroelastic.scenes.models.roll import RollScene
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.open_water.results import OpenSolution
from hydroelastic.scenes.open_water.run import run_open
from hydroelastic.scenes.read import read_scene
from hydroelastic.scenes.roll.run import run_roll
from hydroelastic.scenes.thread.run import run_thread

ROLLING = CIRCLE | {"motions": ["heave", "roll"]}


@pytest.mark.parametrize(
    ("value", "error", "text"),
    [
        (0.0166, 6e-5, "0.0166"),
        (-5.4e-5, 1e-5, "-5e-05"),
        (9e-6, 1e-5, "0"),
        (-1e-5, 1e-5, "0"),
        (0.1, 0.0, "0.1"),
        (0.0, 0.0, "0"),
        (1.23456789, 1e-12, "1.23457"),
    ],
)
def test_numbers_are_as_long_as_they_are_certain(value: float, error: float, text: str) -> None:
    assert beyond_error(value, error) == text


def tables(solution: OpenSolution) -> list[Section]:
    return list(open_sections(solution, run_open.read(run_open.summarized(solution.scene, solution))))


def decaying(count: int) -> Section:
    scene = open_scene(ROLLING, analyses=[{"kind": "decay", "displacement": 0.1, "times": [0.0, 1.0]}])
    table = DecayTable(
        times=np.linspace(0.0, 0.2 * (count - 1), count),
        dofs=(Dof("heave"), Dof("roll")),
        displacement=np.full((count, 2), [0.1, 1e-9]),
        initial=np.array([0.1, 0.0]),
        absolute_error=np.full(count, 1e-6),
        tail=None,
        certified_until=1.0,
    )
    (section,) = (one for one in tables(replace(arbitrary_solution(scene), decay=(table,))) if "release" in one.title)
    return section


@pytest.mark.parametrize("count", [2, 25, 151, 41, 241])
def test_times_of_a_decay_are_even_and_end_at_the_last(count: int) -> None:
    section = decaying(count)
    times = np.array([float(row[0]) for row in section.rows])
    assert len(times) <= MOST_ROWS
    assert np.diff(times) == pytest.approx(times[1])
    assert times[-1] == pytest.approx(0.2 * (count - 1))


def test_a_decay_tells_the_unit_of_its_error_and_no_noise() -> None:
    section = decaying(9)
    assert section.headings == ("t, s", "heave, m", "roll, rad", "error, m or rad")
    assert {row[1:3] for row in section.rows} == {("0.1", "0")}


def test_motions_have_units_and_phases() -> None:
    scene = open_scene(ROLLING, analyses=[{"kind": "response", "omega": [2.0, 4.0]}])
    solution = arbitrary_solution(scene)
    (section,) = (one for one in tables(solution) if one.title.startswith("Motions"))
    assert section.headings == ("ω, rad/s", "heave, m/m", "roll, rad/m")
    table = solution.response[0]
    at_body = table.amplitudes[0, 0, 1] * np.exp(-1j * table.wavenumbers[0, 0] * CIRCLE["position"])
    angle = degrees(float(np.angle(at_body)))
    # Printed with one place.
    assert float(section.rows[0][2].partition(" ∠ ")[2].removesuffix("°")) == pytest.approx(angle, abs=0.05)
    assert "the crest of the wave is at the middle of the body" in section.lines[0]


def test_no_table_leaves_open_what_an_error_is_relative_to() -> None:
    scene = open_scene(
        CIRCLE,
        analyses=[
            {"kind": "radiation", "omega": [2.0]},
            {"kind": "response", "omega": [2.0]},
            {"kind": "resonance"},
            {"kind": "decay", "displacement": 0.1, "times": [0.0, 1.0]},
        ],
    )
    headings = {heading for section in tables(arbitrary_solution(scene)) for heading in section.headings}
    assert {"relative error", "error/largest", "error, m"} <= headings
    assert "estimated error" not in headings


def test_an_angle_has_no_more_digits_than_anyone_needs() -> None:
    scene = read_scene("swell", ())
    assert isinstance(scene, RollScene)
    rows = {row[0]: row[1] for section in run_roll(scene).sections for row in section.rows}
    assert len(rows["largest angle, degrees"].lstrip("-").replace(".", "")) <= 7


def test_as_many_overdamped_motions_are_shown_as_modes_were_asked() -> None:
    scene = read_scene("streamed_array", ("analysis=[{kind = 'modes', count = 2}]", "accuracy.tolerance=1e-6"))
    assert isinstance(scene, ThreadScene)
    outcome = run_thread(scene)
    (section,) = (one for one in outcome.sections if one.title.startswith("Free motions"))
    (modes,) = outcome.summary["modes"]
    assert len(modes["aperiodic"]) > 2
    assert [row[0] for row in section.rows] == ["1", "2", "–", "–"]
    assert f"{len(modes['aperiodic'])} motions" in section.lines[0]
    assert "the 2 slowest are shown" in section.lines[0]


def test_tables_of_modes_without_bending_have_no_column_of_it() -> None:
    for bending, told in (((0.0, 1e-9), True), ((0.0,), False)):
        modes = [Reading(MODES, {BENDING.key: one}) for one in bending]
        group, entries = without_zeros(BENDING, modes, MODES)
        assert ("bending energy" in headings(group)) == told
        assert all(entry.group is group for entry in entries)
