"""Field solutions of threads beside asymptotic and closed forms: how differences fall with what must be small."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from command import run_command
from mutated_scenes import as_toml
from thread_scenes import fixed, free, scene

STREAM = {"density": 1000.0, "velocity": [1.0, 0.0]}
# Of d = 0.02 m at 1 m/s: kn = 10 N·s²/m³, kt = 0.628 N·s²/m³.
LINE = {"length": 10.0, "diameter": 0.02, "weight": 4.0, "normal_drag": 1.0, "tangential_drag": 0.02}
SHEARED = {**STREAM, "velocity": [0.5, 0.0], "shear": [0.1, 0.0]}
ROW = re.compile(r"^ (\S.*?)  +(\d|exact) +(\S+) +(\S+) +(\S+) +(yes|NO|no) ", re.MULTILINE)


def compared(*arguments: Any) -> tuple[list[tuple[str, ...]], str]:
    """Rows of name, order, small parameter, difference, what is left out, whether that explains it; and the output."""
    ran = run_command("compare", *map(str, arguments))
    assert ran.exit_code == 0, ran.output
    return ROW.findall(ran.output), " ".join(ran.output.split())


@cache
def family(name: str, folder: Path) -> dict[str, list[tuple[float, float, bool]]]:
    """What is small, and differences of positions, and of tensions over their largest, of three threads in a regime.

    Printed are two digits of the small parameter: it is taken as load by pull, which it is in proportion to.
    """
    tight, slantwise = (1280.0, 2560.0, 5120.0), np.array([0.5, 0.0, 1.0])
    threads = {
        "pulled": [(LINE, free(force=(pull * slantwise).tolist()), STREAM, pull) for pull in tight],
        "buoys": [(LINE, free(weight=-pull, drag_area=pull / 1000.0), SHEARED, pull) for pull in tight],
        "light": [
            ({**LINE, "weight": weight}, free(force=[20.0, 0.0, -200.0]), SHEARED, 1.0) for weight in (0.5, 1.0, 2.0)
        ],
    }[name]
    found: dict[str, list[tuple[float, float, bool]]] = {}
    for number, (thread, end, stream, pull) in enumerate(threads):
        file = folder / f"{name}_{number}.toml"
        file.write_text(as_toml(scene(thread, end, stream=stream, accuracy={"tolerance": 1e-9})), encoding="utf-8")
        rows, _ = compared(file)
        sizes = {True: 1.0, False: pull}
        seen: set[str] = set()
        load = thread["weight"] / pull
        for theory, _, _, difference, _, explained in rows:
            kind = "tension" if theory in seen else "position"
            seen.add(theory)
            values = found.setdefault(f"{theory}: {kind}", [])
            values.append((load, float(difference) / sizes[kind == "position"], explained == "yes"))
    return found


# Slopes are measured to 0.05 of the whole number that the order of a theory says, and so 0.1 is allowed.
@pytest.mark.slow_but("pulled-*")
@pytest.mark.parametrize(
    ("name", "theory", "order"),
    [
        *((name, "tension-dominated", order) for name in ("pulled", "buoys") for order in (0, 1, 2)),
        *(("light", "drag-dominated", order) for order in (0, 1)),
    ],
)
def test_differences_fall_with_the_order_of_the_theory(
    name: str, theory: str, order: int, tmp_path_factory: pytest.TempPathFactory
) -> None:
    found = family(name, tmp_path_factory.getbasetemp())
    for kind in ("position", "tension") if (name, order) != ("light", 1) else ("position",):
        values = np.array(found[f"{theory}, order {order}: {kind}"])
        assert values[:, 2].all()
        assert np.polyfit(*np.log(values[:, :2].T), 1)[0] == pytest.approx(order + 1, abs=0.1), kind


@pytest.mark.parametrize(
    ("arguments", "theory"),
    [
        (("catenary", "--set", "analysis=[]"), "catenary"),
        (("streamed_array", "--set", "analysis=[]"), "critical line of a free tail"),
    ],
)
def test_exact_shapes_are_met_within_the_error_of_the_field(arguments: tuple[str, ...], theory: str) -> None:
    rows, text = compared(*arguments)
    exact = [row for row in rows if row[0] == theory]
    assert [row[1] for row in exact] == ["exact", "exact"]
    assert all(row[5] == "yes" and float(row[4]) == 0.0 for row in exact)
    assert "Free motions" not in text


WET = {"length": 10.0, "diameter": 0.02, "mass": 1.0, "added_mass": 1.0}
MODES = {"kind": "modes", "count": 6}


@pytest.mark.parametrize(
    ("theory", "thread", "end", "velocity"),
    [
        ("taut string", {"weight": 0.0, "axial_rigidity": 1e5}, fixed(10.1), 0.0),
        ("taut string", {"weight": 0.0, "tension": 500.0}, fixed(10.0), 0.0),
        ("hanging chain", {"weight": 4.0}, free(weight=20.0, mass=2.0, added_mass=1.0), 0.0),
        pytest.param(
            "thread in a stream along it",
            {"axial_rigidity": 1e5, "reactive": "moving_load"},
            fixed(10.1),
            20.0,
            marks=pytest.mark.slow,
        ),
    ],
)
def test_closed_frequencies_are_met(theory: str, thread: Any, end: Any, velocity: float, tmp_path: Path) -> None:
    stream = {"density": 1000.0} | ({"velocity": [velocity, 0.0]} if velocity else {})
    file = tmp_path / "scene.toml"
    file.write_text(as_toml(scene(WET | thread, end, MODES, stream=stream)), encoding="utf-8")
    _, text = compared(file)
    assert theory in text
    assert "NO" not in text


def test_theories_that_do_not_fit_say_why(tmp_path: Path) -> None:
    veer = {"density": 1000.0, "veer": {"speed": 1.0, "rate": 0.05}}
    file = tmp_path / "scene.toml"
    document = scene(LINE, free(force=[10.0, 0.0, 600.0]), stream=veer, load=[{"at": 5.0, "weight": 3.0}])
    file.write_text(as_toml(document), encoding="utf-8")
    rows, text = compared(file)
    assert rows == []
    assert "there are bodies on the thread" in text
