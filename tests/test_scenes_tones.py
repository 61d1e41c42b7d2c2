"""First elastic tones of beams that are unlike, and scenes at the ends of what is allowed."""

import itertools
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from hydroelastic.fem.tank.elastic_tone import ElasticTone, elastic_tone
from hydroelastic.fem.tank.resolution import initial_resolution
from hydroelastic.fem.tank.solve import TankSolution
from hydroelastic.modal.tank_estimates import floating_beam
from hydroelastic.output.tank.tables import tone_lines
from hydroelastic.physics.dofs import FIRST_ELASTIC
from hydroelastic.scenes.models import Accuracy, Beam, Liquid, Tank, TankScene
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.tank_checks import MASS_GROUP, STIFFNESS_GROUP
from hydroelastic.scenes.tank.run import run_tank
from hydroelastic.scenes.tank.solve import EstimatedTank, solve_scene

LONG = Beam(start=1.0, length=4.0, flexural_rigidity=5e3, mass_per_length=50.0, hydrostatic=False)
SHORT = Beam(start=12.0, length=0.5, flexural_rigidity=5e3, mass_per_length=50.0, hydrostatic=False)


def tank(*beams: Beam, length: float = 20.0) -> TankScene:
    return TankScene(
        tank=Tank(length=length),
        liquid=(Liquid(density=1000.0, depth=5.0),),
        body=beams,
        accuracy=Accuracy(tolerance=1e-5, modes=6),
    )


@pytest.fixture(scope="module")
def unlike() -> TankSolution:
    return solve_scene(tank(LONG, SHORT))


def test_each_beam_keeps_the_tone_it_has_alone(unlike: TankSolution) -> None:
    assert not unlike.reasons
    for beam, tone in zip((LONG, SHORT), unlike.tones, strict=True):
        alone = solve_scene(tank(beam)).tones[0].pressure_release
        assert alone is not None
        # Another beam 7 m away is felt by the liquid's displacement, a part of (l/distance)² of the added mass.
        assert tone.pressure_release == pytest.approx(alone, rel=2e-2)


def test_a_tone_out_of_reach_does_not_hide_one_within(unlike: TankSolution) -> None:
    long, short = unlike.tones
    assert long.tone is not None
    assert long.tone.participation > 0.1
    assert short.tone is None
    assert "not searched for" in short.reason


def tone_of(parts: list[float]) -> ElasticTone:
    """The tone of a beam whose first dry mode has these participations in the modes."""
    modes: Any = SimpleNamespace(elastic_amplitudes=np.sqrt(np.array(parts))[:, None], eigenvalues=np.ones(len(parts)))
    beam: Any = SimpleNamespace(size=1, dofs=(FIRST_ELASTIC,), stiffness=(1.0,))
    return elastic_tone(modes, (beam,), 0)


@pytest.mark.parametrize(
    ("parts", "of_one_mode", "sharing"),
    [
        ([0.0, 0.9, 0.1], True, (1, 1)),
        ([0.1, 0.425, 0.307], True, (1, 2)),  # shared by two, each of which means something
        ([0.05, 0.08, 0.142, 0.06, 0.137, 0.02], False, (1, 4)),
        ([0.2, 0.09, 0.05], True, (0, 0)),  # small, but no other is near
    ],
)
def test_a_tone_that_is_no_single_modes_is_known(
    parts: list[float], of_one_mode: bool, sharing: tuple[int, int]
) -> None:
    tone = tone_of(parts)
    assert (tone.is_of_one_mode, tone.sharing) == (of_one_mode, sharing)


def test_a_tone_that_is_no_single_modes_is_said_so(unlike: TankSolution) -> None:
    summary = run_tank.summarized(tank(LONG, SHORT), EstimatedTank(scene=tank(LONG, SHORT), tank=unlike))
    ones = [run_tank.read(summary | {"first_elastic_by_body": [tone]}) for tone in _tones(summary)]
    long, short = (" ".join(tone_lines(one)) for one in ones)
    assert "no single mode; modes from 55 to 65 share it, most of it in mode 60, ω = " in long
    assert "; pressure-release tone (ψ = 0 on the water, the limit of infinite frequency): " in long
    assert "none; " in short
    assert "see the pressure-release tone" in short
    assert "First elastic tone of beam 2" in " ".join(tone_lines(run_tank.read(summary)))


def _tones(summary: dict[str, Any]) -> list[dict[str, Any]]:
    long, short = summary["first_elastic_by_body"]
    return [long | {"one_mode": False, "first_sharing_mode": 55, "last_sharing_mode": 65, "index": 60}, short]


def test_tones_follow_their_beams_when_the_scene_lists_them_otherwise(unlike: TankSolution) -> None:
    swapped = solve_scene(tank(SHORT, LONG))
    for one, other in zip(unlike.tones, reversed(swapped.tones), strict=True):
        assert one.pressure_release == pytest.approx(other.pressure_release, rel=1e-5)
        assert (one.tone is None) == (other.tone is None)


@pytest.mark.parametrize(
    ("rigidity", "mass", "hydrostatic"), list(itertools.product(STIFFNESS_GROUP, MASS_GROUP, (False, True)))
)
def test_a_mesh_can_be_planned_at_the_ends_of_the_ranges(rigidity: float, mass: float, hydrostatic: bool) -> None:
    beam = Beam(
        start=3.0,
        length=4.0,
        flexural_rigidity=1.01 ** (1 if rigidity < 1 else -1) * rigidity * 1000.0 * 9.81 * 4.0**4,
        mass_per_length=1.01 ** (1 if mass < 1 else -1) * mass * 1000.0 * 4.0,
        hydrostatic=hydrostatic,
    )
    assert min(initial_resolution(physical_tank(tank(beam, length=10.0)).scaled(), 1e-6, modes=6).surface_sizes) > 0.0


@pytest.mark.parametrize("beyond", [-0.5e-9, 0.0, 0.5e-9])
def test_an_end_within_rounding_of_the_wall_lies_on_it_for_the_estimates_too(beyond: float) -> None:
    beam = LONG.model_copy(update={"start": 6.0 + 10.0 * beyond})
    given = floating_beam(physical_tank(tank(beam, length=10.0)))
    assert given.right_gap == 0.0
