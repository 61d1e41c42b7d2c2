"""What goes wrong with a thread is said in the words of its scene, never in those of a library."""

import re
import warnings
from math import nextafter
from typing import Any

import numpy as np
import pytest
from mpi4py import MPI
from pydantic import ValidationError
from scipy.optimize import root_scalar

from hydroelastic.modal.thread import starts
from hydroelastic.modal.thread.estimate import Inapplicable, estimate_or_reason
from hydroelastic.modal.thread.march import march_back
from hydroelastic.modal.thread.starts import thread_starts
from hydroelastic.physics.thread_load import ThreadLoad
from hydroelastic.scenes.errors import UnsolvedError
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.thread.physics import thread_of
from hydroelastic.scenes.thread.solve import solve_thread_scene


def held(length: float, chord: float = 1.0, **thread: Any) -> dict[str, Any]:
    return {
        "thread": {"length": length, "weight": 1.0, **thread},
        "ends": {"b": {"kind": "fixed", "position": [chord, 0.0, 0.0]}},
    }


@pytest.mark.parametrize("length", [1.0, 1.000000001, nextafter(1.0, 2.0), 0.5])
def test_the_length_that_is_allowed_is_accepted(length: float) -> None:
    for chord in (1.0, 13.7, 1e-3):
        with pytest.raises(ValidationError) as refused:
            ThreadScene.model_validate(held(length * chord, chord))
        (found,) = re.findall(r"allowed: (\S+) m or more, or axial_rigidity", str(refused.value))
        ThreadScene.model_validate(held(float(found), chord))
        ThreadScene.model_validate(held(length * chord, chord, axial_rigidity=1e6))


def test_a_length_within_the_margin_is_said_to_be_so() -> None:
    with pytest.raises(ValidationError, match=r"within 1e-09 of the distance of the fixed ends, 1 m.*1\.000000002 m"):
        ThreadScene.model_validate(held(1.000000001))


def test_numbers_that_nearly_agree_are_told_apart() -> None:
    scene = held(10.000001, 5.0)
    with pytest.raises(ValidationError, match=r"less than length = 10\.000001 m"):
        ThreadScene.model_validate({**scene, "load": [{"at": 10.0000015, "weight": 1.0}]})


LIGHT = {
    "thread": {
        "length": 91.44640239877445,
        "diameter": 0.0025999781482391564,
        "normal_drag": 1.2,
        "weight": -5.92910037240637e-06,
        "mass": 3.767506063700118e-07,
    },
    "stream": {"density": 1.2, "veer": {"speed": 0.06147092368384201, "rate": 0.0011372609250726107}},
    "ends": {"b": {"kind": "surface", "level": 62.25627390568255, "drag_area": 2.975929769653988}},
    "analysis": [{"kind": "motion", "times": [0.0, 1.8], "start": "still_liquid", "tolerance": 1e-2}],
}


@pytest.mark.slow
def test_a_line_that_would_hang_in_two_parts_in_still_liquid() -> None:
    """At the start of the motion nothing pulls the buoy aside, and the line is longer than it is deep."""
    with pytest.raises(UnsolvedError) as unsolved:
        solve_thread_scene(ThreadScene.model_validate(LIGHT), MPI.COMM_WORLD, lambda _message: None)
    message = str(unsolved.value)
    assert "x0" not in message
    assert 'start = "still_liquid": without the stream no equilibrium under tension was found' in message
    assert re.search(r"march: (the|no) [a-z ]+", message)


def test_a_march_that_begins_at_its_height() -> None:
    """A light thread pulled sideways ends at the height of A at once: two heights for a secant are not there."""
    found = march_back(ThreadLoad(weight=0.0), 1.0, lambda place: np.array([1.0, 0.3 * float(place[0]), 0.0]))
    assert found.positions[0] == pytest.approx(np.zeros(3), abs=1e-8)
    direction = found.forces[-1] / np.linalg.norm(found.forces[-1])
    assert found.positions[-1] == pytest.approx(direction, abs=1e-8)


def test_a_slack_thread_without_weight_in_a_stream_along_it() -> None:
    scene = ThreadScene.model_validate(
        {
            "thread": {"length": 2.0, "weight": 0.0, "diameter": 0.01, "normal_drag": 1.0, "tangential_drag": 0.01},
            "stream": {"density": 1000.0, "velocity": [1.0, 0.0], "shear": [0.1, 0.0]},
            "ends": {"b": {"kind": "fixed", "position": [1.0, 0.0, 0.0]}},
        }
    )
    refused: list[str] = []
    names = [start.name for start in thread_starts(thread_of(scene), refused)]
    assert "hanging catenary" not in names
    assert refused[-1] == "hanging catenary: a slack thread without weight does not hang"
    with pytest.raises(UnsolvedError) as unsolved:
        solve_thread_scene(scene, MPI.COMM_WORLD, lambda _message: None)
    assert "load_vector" not in str(unsolved.value)


def fails_like_a_library() -> Any:
    warnings.warn("Tolerance of 1.0 reached.", RuntimeWarning, stacklevel=1)
    return root_scalar(lambda x: x, method="secant", x0=1.0, x1=1.0)


def test_messages_of_libraries_do_not_pass(monkeypatch: pytest.MonkeyPatch) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = estimate_or_reason("a theory", fails_like_a_library)
        assert isinstance(found, Inapplicable)
        assert found.reason == "its equations have no finite solution here that could be found"
        monkeypatch.setattr(starts, "catenary_between", lambda *_: fails_like_a_library())
        refused: list[str] = []
        assert list(thread_starts(thread_of(ThreadScene.model_validate(held(2.0))), refused)) == []
    assert refused == [
        f"{name}: its equations have no finite solution that could be found"
        for name in ("catenary", "hanging catenary")
    ]
