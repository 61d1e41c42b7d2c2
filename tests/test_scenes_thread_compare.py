"""Field solutions of threads beside asymptotic and closed forms: how their differences fall with what must be small."""

import json
from collections.abc import Sequence
from functools import cache
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from mpi4py import MPI

from hydroelastic.modal.thread.estimate import Inapplicable
from hydroelastic.output.thread.comparison_tables import comparison_sections
from hydroelastic.scenes.command_line import main
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.read import read_scene
from hydroelastic.scenes.thread.differences import thread_differences
from hydroelastic.scenes.thread.estimates import thread_estimates
from hydroelastic.scenes.thread.solve import solve_thread_scene

STREAM = {"density": 1000.0, "velocity": [1.0, 0.0]}
# Of d = 0.02 m at 1 m/s: kn = 10 N·s²/m³, kt = 0.628 N·s²/m³.
LINE = {"length": 10.0, "diameter": 0.02, "weight": 4.0, "normal_drag": 1.0, "tangential_drag": 0.02}


def scene_of(name: str, *overrides: str) -> ThreadScene:
    scene = read_scene(name, overrides)
    assert isinstance(scene, ThreadScene)
    return scene


def made(**given: Any) -> ThreadScene:
    """A scene held at the origin unless it says otherwise, to nine digits."""
    ends = {"a": {"kind": "fixed"}, **given.pop("ends")}
    return ThreadScene.model_validate({"ends": ends, "accuracy": {"tolerance": 1e-9}, **given})


def compared(scene: ThreadScene) -> dict[str, Any]:
    solution = solve_thread_scene(scene, MPI.COMM_WORLD, lambda _message: None)
    found = thread_differences(solution, tuple(thread_estimates(scene)))
    json.dumps(found)
    return found


def named(found: dict[str, Any], name: str) -> dict[str, Any]:
    (entry,) = (entry for part in ("shapes", "values") for entry in found[part] if entry["name"] == name)
    return dict(entry)


def reason(found: dict[str, Any], name: str) -> str:
    (entry,) = (entry for entry in found["inapplicable"] if entry["name"] == name)
    return str(entry["reason"])


def slope(found: Sequence[dict[str, Any]], name: str, quantity: str) -> float:
    """Of the logarithm of the relative difference over that of the small parameter, by least squares.

    Of values the first one is taken.
    """
    entries = [named(one, name) for one in found]
    if quantity == "value":
        parts = [entry["compared"][0] for entry in entries]
        sizes = [abs(part["estimate"]) for part in parts]
    else:
        parts = [entry[quantity] for entry in entries]
        sizes = [1.0 if quantity == "position" else max(entry["end_tensions"]) for entry in entries]
    assert all(part["explained"] for part in parts)
    # Else the slope would be that of the field solution.
    assert all(part["field_error"] < 0.01 * part["difference"] for part in parts)
    differences = [part["difference"] / size for part, size in zip(parts, sizes, strict=True)]
    return float(np.polyfit(np.log([entry["small"] for entry in entries]), np.log(differences), 1)[0])


SHEARED = {**STREAM, "velocity": [0.5, 0.0], "shear": [0.1, 0.0]}


@cache
def family_of(name: str) -> list[dict[str, Any]]:
    """Three threads in a regime, compared; what must be small grows twice by a factor 1.4 to 2."""
    slantwise = np.array([0.5, 0.0, 1.0])
    tight = (640.0, 1280.0, 2560.0)
    given: dict[str, list[dict[str, Any]]] = {
        "pulled": [
            {"thread": LINE, "stream": STREAM, "ends": {"b": {"kind": "free", "force": list(pull * slantwise)}}}
            for pull in tight
        ],
        "buoys": [
            {
                "thread": LINE,
                "stream": SHEARED,
                "ends": {"b": {"kind": "free", "weight": -pull, "drag_area": pull / 1000.0}},
            }
            for pull in tight
        ],
        "light": [
            {
                "thread": {**LINE, "weight": weight},
                "stream": SHEARED,
                "ends": {"b": {"kind": "free", "force": [20.0, 0.0, -200.0]}},
            }
            for weight in (0.5, 1.0, 2.0)
        ],
        "cables": [
            {
                "thread": {"length": 10.0, "mass": 1.0, "weight": weight, "axial_rigidity": 1e5},
                "ends": {"b": {"kind": "fixed", "position": [10.0, 0.0, 0.0]}},
                "analysis": [{"kind": "modes", "count": 4}],
            }
            for weight in (2.0, 4.0, 8.0)
        ],
    }
    return [compared(made(**scene)) for scene in given[name]]


IN_PLANE, OUT_OF_PLANE = (f"Irvine and Caughey's cable, {where} its plane" for where in ("in", "out of"))


# Slopes are measured to 0.05 of the whole number that the order of a theory says, and so 0.1 is allowed.
@pytest.mark.slow_but("pulled-*")
@pytest.mark.parametrize(
    ("family", "name", "quantity", "expected", "within"),
    [
        *(
            (family, f"tension-dominated, order {order}", quantity, order + 1, 0.1)
            for family in ("pulled", "buoys")
            for order in (0, 1, 2)
            for quantity in ("position", "tension")
        ),
        ("light", "drag-dominated, order 0", "position", 1, 0.1),
        ("light", "drag-dominated, order 0", "tension", 1, 0.1),
        ("light", "drag-dominated, order 1", "position", 2, 0.1),
        ("cables", IN_PLANE, "value", 2, 0.1),
        ("cables", OUT_OF_PLANE, "value", 2, 0.1),
    ],
)
def test_differences_fall_with_the_order_of_the_theory(
    family: str, name: str, quantity: str, expected: float, within: float
) -> None:
    assert slope(family_of(family), name, quantity) == pytest.approx(expected, abs=within)


def test_a_thread_held_at_its_other_end_is_estimated_the_same() -> None:
    force = [40.0, 0.0, 600.0]
    forth = compared(made(thread=LINE, stream=STREAM, ends={"b": {"kind": "free", "force": force}}))
    back = compared(
        made(thread=LINE, stream=STREAM, ends={"a": {"kind": "free", "force": force}, "b": {"kind": "fixed"}})
    )
    for one, other in zip(forth["shapes"], back["shapes"], strict=True):
        turned = np.array(other["end_positions"][::-1])
        assert np.array(one["end_positions"]) == pytest.approx(turned, abs=1e-13)
        assert one["end_tensions"] == pytest.approx(other["end_tensions"][::-1], rel=1e-13)
        assert one["position"]["difference"] == pytest.approx(other["position"]["difference"], abs=1e-8)


EXACT = {
    "catenary": scene_of("catenary", "analysis=[]"),
    "critical line of a free tail": scene_of("streamed_array", "analysis=[]"),
}


@pytest.mark.parametrize("name", EXACT)
def test_exact_shapes_are_met_within_the_error_of_the_field(name: str) -> None:
    entry = named(compared(EXACT[name]), name)
    assert entry["order"] is None
    for quantity in ("position", "tension"):
        assert entry[quantity]["explained"]
        assert entry[quantity]["left_out"] == 0.0


HELD = {"b": {"kind": "fixed", "position": [10.1, 0.0, 0.0]}}
STRETCHED = {"length": 10.0, "diameter": 0.02, "mass": 1.0, "weight": 0.0, "added_mass": 1.0, "axial_rigidity": 1e5}
MODES = [{"kind": "modes", "count": 6}]
CHAIN = {"length": 10.0, "diameter": 0.02, "mass": 1.0, "weight": 4.0, "added_mass": 1.0}
ALONG = {"thread": {**STRETCHED, "reactive": "moving_load"}, "ends": HELD}
SWINGS: dict[str, tuple[str, dict[str, Any], int]] = {
    "string": ("taut string", {"thread": STRETCHED, "stream": {"density": 1000.0}, "ends": HELD}, 3),
    "string of a given tension": (
        "taut string",
        {
            "thread": {**CHAIN, "weight": 0.0, "tension": 500.0},
            "stream": {"density": 1000.0},
            "ends": {"b": {"kind": "fixed", "position": [10.0, 0.0, 0.0]}},
        },
        3,
    ),
    "chain": (
        "hanging chain",
        {
            "thread": CHAIN,
            "stream": {"density": 1000.0},
            "ends": {"b": {"kind": "free", "weight": 20.0, "mass": 2.0, "added_mass": 1.0}},
        },
        3,
    ),
    "string in a stream": (
        "thread in a stream along it",
        {**ALONG, "stream": {"density": 1000.0, "velocity": [20.0, 0.0]}},
        3,
    ),
}


@pytest.mark.parametrize(
    "case", ["string", "string of a given tension", "chain", pytest.param("string in a stream", marks=pytest.mark.slow)]
)
def test_closed_frequencies_are_met(case: str) -> None:
    # Each motion of these goes two ways, so that six are three.
    name, given, count = SWINGS[case]
    entry = named(compared(made(**given, analysis=MODES)), name)
    assert len(entry["compared"]) == count
    for value in entry["compared"]:
        assert value["explained"]
        assert value["difference"] < (1e-7 if entry["order"] is None else 0.02) * np.abs(value["field"]).max()


@pytest.mark.slow
def test_a_moored_buoy_is_dominated_by_drag() -> None:
    found = compared(scene_of("moored_buoy", "analysis=[]"))
    zero, first = (named(found, f"drag-dominated, order {order}") for order in (0, 1))
    assert first["small"] == pytest.approx(0.228, abs=1e-3)
    assert first["position"]["difference"] < 0.25 * zero["position"]["difference"]
    assert first["position"]["explained"]


def test_compare_prints_what_fits_and_what_does_not() -> None:
    ran = CliRunner().invoke(main, ["compare", "catenary"])
    assert ran.exit_code == 0
    assert ran.output.splitlines()[1].startswith("Largest difference of a position")
    assert "Free motions" not in ran.output
    rows = [line.split() for line in ran.output.splitlines() if line.startswith(" catenary ")]
    assert [row[1] for row in rows] == ["exact", "exact"]
    assert all(row[-2] == "yes" for row in rows)
    assert "one end is higher than the other" in " ".join(ran.output.split())


def test_a_difference_that_no_error_explains_is_told() -> None:
    scene = made(thread=LINE, stream=STREAM, ends={"b": {"kind": "free", "force": [40.0, 0.0, 600.0]}}, analysis=[])
    solution = solve_thread_scene(scene, MPI.COMM_WORLD, lambda _message: None)
    # Estimates of a thread that is heavier by a newton per metre.
    other = scene.model_copy(update={"thread": scene.thread.model_copy(update={"weight": 5.0})})
    found = thread_differences(solution, tuple(thread_estimates(other)))
    told = {entry["name"]: entry["tension"]["explained"] for entry in found["shapes"]}
    assert told["tension-dominated, order 0"]
    assert not told["tension-dominated, order 2"]
    lines = [line for section in comparison_sections(found) for line in section.lines]
    assert any(line.startswith("NO: larger than") for line in lines)


@pytest.mark.slow
def test_a_hose_flutters_at_the_speed_of_a_pipe() -> None:
    found = compared(
        scene_of("fluttering_hose", "analysis=[{kind='stability', factors=[9.0, 9.6]}, {kind='modes', count=3}]")
    )
    motions = named(found, "thread in a stream along it")["compared"]
    assert len(motions) > 1
    for motion in motions:
        assert motion["explained"]
        assert motion["difference"] < 1e-7 * np.abs(motion["field"]).max()
    entry = named(found, "thread in a stream along it: flutter")["compared"][0]
    assert entry["explained"]
    assert entry["field_error"] < 1e-4
    assert entry["estimate"] == pytest.approx(9.3224184, abs=1e-7)
    assert entry["field"] == pytest.approx(9.3224184, abs=5e-5)
    assert "not known in closed form" in reason(found, "thread in a stream along it: divergence")
    assert reason(found, "tension-dominated, order 0") == "the thread resists bending"


HELD_SLACK = {"b": {"kind": "fixed", "position": [8.0, 0.0, 0.0]}}
VEER = {"density": 1000.0, "veer": {"speed": 1.0, "rate": 0.05}}


@pytest.mark.parametrize(
    ("changed", "name", "why"),
    [
        ({"load": [{"at": 5.0, "weight": 3.0}]}, "tension-dominated, order 1", "there are bodies on the thread"),
        ({"ends": HELD_SLACK}, "catenary", "a stream drags at the thread"),
        ({"stream": VEER}, "drag-dominated, order 1", "in one direction at all heights"),
        ({"stream": VEER}, "critical line of a free tail", "a force or a body pulls at the tail"),
        ({"analysis": MODES, "thread": {**LINE, "mass": 1.0}}, "hanging chain", "the liquid streams"),
    ],
)
def test_theories_that_do_not_fit_say_why(changed: dict[str, Any], name: str, why: str) -> None:
    given = {"thread": LINE, "stream": STREAM, "ends": {"b": {"kind": "free", "force": [10.0, 0.0, 600.0]}}, **changed}
    reasons = {found.name: found.reason for found in thread_estimates(made(**given)) if isinstance(found, Inapplicable)}
    assert why in reasons[name]
