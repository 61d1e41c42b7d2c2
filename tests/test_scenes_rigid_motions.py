"""Motions without stiffness, and those that the volume of the liquids forbids, against statics of the whole tank."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.linalg import block_diag, null_space

import hydroelastic as he
from hydroelastic.physics.dofs import Level
from hydroelastic.physics.rigid_motions import mode_count, zero_mode_count
from hydroelastic.scenes.models.floats import placed_float
from hydroelastic.scenes.models.physical import physical_tank


def beam(**changes: Any) -> he.Beam:
    values: dict[str, Any] = {"start": 0.5, "length": 3.0, "flexural_rigidity": 5e3, "mass_per_length": 50.0}
    return he.Beam(**(values | {"hydrostatic": False} | changes))


def floating(*motions: str, **changes: Any) -> he.Float:
    values: dict[str, Any] = {"shape": "wedge", "position": 5.0, "half_width": 1.0, "half_height": 0.8}
    return he.Float(**(values | {"motions": motions or ("heave",)} | changes))


def scene(*bodies: he.Beam | he.Float, top: str, upper: float | None) -> he.TankScene:
    above = () if upper is None else (he.Liquid(density=upper, depth=3),)
    return he.TankScene(
        tank=he.Tank(length=10, top=top),  # type: ignore[arg-type]
        liquid=(he.Liquid(density=1000, depth=5), *above),
        body=bodies,
    )


LOOSE, COVER = beam(), beam(start=0.0, length=10.0)
CIRCLE: dict[str, Any] = {"shape": "ellipse", "half_width": 1.0, "half_height": 1.0}
KEEL: dict[str, Any] = {
    "shape": "polygon",
    "half_width": None,
    "half_height": None,
    "vertices": ((-1, -1), (0, -1), (0, -0.2), (1, -0.2), (1, 0.2), (-1, 0.2)),
    "unstable": "solve",
}
ALL = ("heave", "sway", "roll")


def neutral(*motions: str) -> he.Float:
    """The keel with its centre of mass where it is neutral, with or without heave that follows its roll."""
    rest = placed_float(scene(floating(*motions, **KEEL), top="free", upper=None), 0).hydrostatics
    stiffness = rest.free_roll_stiffness if "heave" in motions else rest.roll_stiffness
    height = rest.centre_of_mass[1] + stiffness / (9.81 * rest.mass)
    return floating(*motions, **KEEL, centre_of_mass=height)


def statics(given: he.TankScene) -> tuple[np.ndarray, np.ndarray]:
    """Stiffness and volumes of all rigid motions and of the mean elevation of each level, in units of the tank.

    Rows of the second matrix are the volumes that must be kept: of the lower liquid, and of the upper one unless it may
    leave at a top without pressure.
    """
    levels: list[Level] = ["surface"] if len(given.layers) == 1 else ["interface", "surface"]
    blocks: list[np.ndarray] = []
    columns: list[list[float]] = []

    def add(level: Level, stiffness: np.ndarray, volumes: list[float]) -> None:
        blocks.append(stiffness)
        for volume in volumes:
            # What rises at a level leaves the layer below it and enters the one above.
            columns.append(
                [
                    volume if place == level else -volume if place == "surface" and level == "interface" else 0.0
                    for place in levels
                ]
            )

    for index, body in enumerate(given.body):
        level = given.level_of(body)
        if isinstance(body, he.Beam):
            assert not body.hydrostatic
            add(level, np.zeros((2, 2)), [body.length, 0.0])
            continue
        rest = placed_float(given, index).hydrostatics
        places = [ALL.index(motion) for motion in body.motions]
        left, right = rest.waterplane
        width, middle = right - left, (left + right) / 2 - rest.centre_of_mass[0]
        volumes = [width, 0.0, width * middle]
        add(level, rest.stiffness[np.ix_(places, places)] / 9810.0, [volumes[place] for place in places])
    for level in levels:
        moves = level == "interface" or given.top == "free"
        pieces = next(own.pieces for own in physical_tank(given).levels if own.name == level)
        open_length = sum(piece.length for piece in pieces if piece.body is None)
        if moves and open_length:
            below, above = given.densities_at(level)
            add(level, np.array([[(below - above) / 1000.0 * open_length]]), [open_length])
    released = given.top == "pressure_release" and physical_tank(given).levels[-1].is_open
    kept = np.array(columns).T
    return block_diag(*blocks), kept[:-1] if released else kept


@pytest.mark.parametrize("top", ["free", "rigid", "pressure_release"])
@pytest.mark.parametrize("upper", [None, 0.0, 800.0])
@pytest.mark.parametrize(
    "bodies",
    [
        (floating(),),
        (floating("sway"), floating(position=8.0)),
        (floating(*ALL),),
        (floating(*ALL, **CIRCLE),),
        (floating("roll", **CIRCLE), floating(position=8.0)),
        (floating("heave", "roll", **KEEL),),
        (neutral("heave", "roll"),),
        (neutral("roll"),),
        (neutral("roll"), LOOSE),
        (floating(*ALL, **CIRCLE), LOOSE),
        (floating(*ALL, at="surface", **CIRCLE), LOOSE),
        (floating(*ALL, at="surface"), beam(start=6.5, at="surface"), LOOSE),
        (COVER.model_copy(update={"at": "surface"}), LOOSE),
        (COVER, LOOSE.model_copy(update={"at": "surface"})),
    ],
)
def test_zero_modes_are_those_of_statics(bodies: tuple[he.Beam | he.Float, ...], upper: float | None, top: str) -> None:
    if upper != 800.0:
        bodies = tuple(body.model_copy(update={"at": None}) for body in bodies)
        if COVER in bodies:
            bodies = (COVER,)
    given, refusal = None, ""
    try:
        given = scene(*bodies, top=top, upper=upper)
    except he.SceneError as error:
        refusal = str(error)
    if given is None:
        assert "nothing oscillates" in refusal
        return
    stiffness, kept = statics(given)
    # Motions that keep the volumes, and those of them that cost nothing.
    free = null_space(kept, rcond=1e-10) if len(kept) else np.eye(len(stiffness))
    energies = np.abs(np.linalg.eigvalsh(free.T @ stiffness @ free))
    expected = int((energies < 1e-10).sum())
    assert zero_mode_count(physical_tank(given)) == expected
    if given.top != "free" and upper is None and not given.beams:
        assert mode_count(physical_tank(given)) == len(energies) - expected
    else:
        assert mode_count(physical_tank(given)) is None
