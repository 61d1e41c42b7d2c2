"""Closed tanks that were solved and then lost, or told as without a digit: read, solved and sampled."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import hydroelastic as he

PENTAGON: dict[str, Any] = {
    "tank": {
        "plan": [
            [0.4325209195464797, 0.3491700551413708],
            [-0.2378837681090747, 0.5023996279088871],
            [-0.2833400867755522, -0.478238924052385],
            [0.17654711362444797, -0.5270912538864941],
            [0.2796939638268761, -0.4803804324195256],
        ]
    },
    "liquid": [{"density": 545.2025004565442, "depth": 0.5183627663302491}],
    "body": [
        {
            "kind": "plate",
            "outline": "disc",
            "radius": 0.1304043403159261,
            "position": [0.0, 0.0],
            "youngs_modulus": 2616393.9021119787,
            "thickness": 0.012358005908592155,
            "density": 662.9633173581099,
            "hydrostatic": False,
        }
    ],
}


def solved(folder: Any, document: dict[str, Any], **accuracy: float) -> he.Result:
    """Solve a closed tank whose keys are given as TOML values."""
    file = folder / "scene.toml"
    whole = {"kind": "tank", **document, "accuracy": accuracy}
    file.write_text("".join(f"{key} = {_toml(value)}\n" for key, value in whole.items()), encoding="utf-8")
    return he.solve(he.read(file))


def _toml(value: Any) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {_toml(inner)}" for key, inner in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(_toml, value)) + "]"
    return {True: "true", False: "false"}.get(value, str(value)) if isinstance(value, bool) else repr(value)


@pytest.mark.slow
def test_fields_are_sampled_in_curved_cells_of_high_degree(tmp_path: Any) -> None:
    fine, coarse = (solved(tmp_path, PENTAGON, tolerance=tolerance, modes=1).dataset for tolerance in (1e-8, 1e-4))
    height = fine.elevation.values[0]
    # The error of a shape is of the order of the root of that of λ, here 1e-4 for the coarser one.
    assert height == pytest.approx(coarse.elevation.values[0], abs=0.02 * np.abs(height).max())


CANAL: dict[str, Any] = {
    "tank": {"length": 10.0, "width": 6.0},
    "liquid": [{"density": 1000.0, "depth": 3.0}],
    "body": [
        {
            "kind": "float",
            "shape": "rectangle",
            "position": 5.0,
            "half_width": 1.0,
            "half_height": 0.5,
            "centre_of_mass": -0.1,
            "motions": ["heave", "roll"],
        }
    ],
}


@pytest.mark.slow_but("1")
@pytest.mark.parametrize("liquids", [1, 2])
def test_motions_in_the_middle_of_a_canal_have_their_names(tmp_path: Any, liquids: int) -> None:
    """A tank that is its own mirror image falls into two halves; one that is a hair off does not."""
    oil_on_water = [{"density": 1000.0, "depth": 1.0}, {"density": 900.0, "depth": 2.0}]
    found = []
    for position in (5.0, 5.000001):
        float_ = CANAL["body"][0] | {"position": position}
        document = CANAL | {"body": [float_], "liquid": oil_on_water if liquids == 2 else CANAL["liquid"]}
        found.append(solved(tmp_path, document, tolerance=1e-3, modes=6).modes)
    assert found[0].kind.tolist() == found[1].kind.tolist()
    if liquids == 1:
        assert {"heave", "roll"} <= set(found[0].kind)
    # ω changes with the square of the shift, 1e-12; both are solved to the tolerance.
    assert found[0].omega == pytest.approx(found[1].omega, rel=2e-3)


def test_a_rigid_disc_under_a_lid_has_as_many_digits_as_asked_for(tmp_path: Any) -> None:
    document = {
        "tank": {"length": 3.593420328113196, "width": 14.403469845098005, "top": "rigid"},
        "liquid": [{"density": 1000.0, "depth": 0.1119304003586382}],
        "body": [
            {
                "kind": "plate",
                "outline": "disc",
                "radius": 1.2895469635776105,
                "rigid": True,
                "mass_per_area": 20.522908685389456,
            }
        ],
    }
    coarse = solved(tmp_path, document, tolerance=1e-3, modes=6)
    assert coarse.summary["status"] == "ok"
    # Solved to 1e-7: 1.7191444068 and 1.8310669571 rad/s. An estimate is a third of its error at least.
    errors = np.abs(coarse.modes.omega / np.array([1.7191444068, 1.8310669571]) - 1.0)
    assert np.all(errors <= 3.0 * coarse.modes.relative_error)
    assert np.all(coarse.modes.relative_error <= 1e-3)


# A cylinder over a cone, and a canal with a flat and a sloping bed: modes with little motion at the corners had
# estimates down to a sixth of their errors. Tank, tolerance, and the frequencies at the tolerance 1e-10.
CORNERS: dict[str, tuple[dict[str, Any], float, list[float]]] = {
    "cone": (
        {"radius": 2.8858123501354154, "outline": [[0.0, -1.0], [2.8858123501354154, -0.0011840366225681351]]},
        1e-3,
        [
            1.218252745568,
            1.638198540986,
            1.961509679164,
            2.236399573764,
            2.265298396928,
            2.480540273429,
            2.702840662809,
            2.908566071596,
            2.972977235554,
            3.101145541123,
            3.282964274376,
            3.455762667025,
        ],
    ),
    "canal": (
        {
            "length": 1.8982983146144563,
            "width": 3.299768757257008,
            "outline": [[0.0, -1.0], [0.5694894943843368, -1.0], [1.8982983146144563, -0.002223776346880009]],
        },
        1e-3,
        [
            2.122614253292,
            3.247293660651,
            3.339265568964,
            3.618953843276,
            4.126805274273,
            4.496878598069,
            4.776871209105,
            5.172396809699,
            5.30641958542,
            5.351670520131,
            5.392038677428,
            5.665924116582,
        ],
    ),
}


@pytest.mark.slow_but("cone")
@pytest.mark.parametrize("case", CORNERS)
def test_estimates_see_weak_singularities_at_corners_of_the_bed(tmp_path: Any, case: str) -> None:
    tank, tolerance, exact = CORNERS[case]
    document = {"tank": tank, "liquid": [{"density": 1000.0, "depth": 1.0}]}
    modes = solved(tmp_path, document, tolerance=tolerance, modes=12).modes
    errors = np.abs(modes.omega / np.array(exact) - 1.0)
    # An estimate is a third of its error at least; 1e-10 is the error of the reference where it matters.
    assert np.all(errors <= 3.0 * modes.relative_error + 1e-10)
    assert np.all(modes.relative_error <= tolerance)
