"""The cost of checking a scene grows like the number of its bodies, and there is a limit to that number."""

from collections.abc import Callable
from cProfile import Profile
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError

from hydroelastic.fem.bodies.registry import expected_tones
from hydroelastic.fem.tank.resolution import initial_resolution
from hydroelastic.meshes.geometry import tank_geometry
from hydroelastic.meshes.grading import Grading
from hydroelastic.meshes.nearest import Sources
from hydroelastic.meshes.tank import build_tank_mesh
from hydroelastic.scenes.kinds import checker_of
from hydroelastic.scenes.models import float_rest_checks, floats
from hydroelastic.scenes.models.bodies import MOST_BODIES, MOST_SECTIONS, Beam, Float
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.models.tank_parts import Liquid, Tank
from hydroelastic.scenes.validation_errors import scene_error

LENGTH = 10.0


def row_of_beams(count: int, ends: str = "walls") -> TankScene:
    """Beams of different stiffness side by side, all of the same size beside their gaps."""
    pitch = LENGTH / count
    bodies = tuple(
        Beam(
            start=(place + 0.2) * pitch,
            length=0.6 * pitch,
            flexural_rigidity=(1.0 + 0.01 * place) * 1e4 * pitch**4,
            mass_per_length=100.0 * pitch,
        )
        for place in range(count)
    )
    return scene(bodies, ends)


def row_of_floats(count: int, ends: str = "walls") -> TankScene:
    pitch = LENGTH / count
    return scene(
        tuple(
            Float(shape="wedge", position=(place + 0.5) * pitch, half_width=0.2 * pitch, half_height=0.2 * pitch)
            for place in range(count)
        ),
        ends,
    )


def scene(bodies: tuple[Beam | Float, ...], ends: Any) -> TankScene:
    liquid = Liquid(density=1000.0, depth=5.0)
    return TankScene(tank=Tank(length=LENGTH, ends=ends), liquid=(liquid,), body=bodies)


def calls_of(work: Callable[[], Any]) -> int:
    """How many functions are called, those of C too."""
    profile = Profile()
    profile.runcall(work)
    return sum(entry.callcount for entry in profile.getstats())


def counted_sources(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Of each evaluation from now on, how many sources times points it takes."""
    asked: list[int] = []
    evaluate = Sources._values

    def counted(sources: Sources, points: np.ndarray) -> np.ndarray:
        asked.append(len(points) * len(sources.sizes))
        return evaluate(sources, points)

    monkeypatch.setattr(Sources, "_values", counted)
    return asked


def growth_of(work: Callable[[int], Any], few: int, many: int) -> float:
    """Calls for many bodies over calls for a few."""
    work(2)  # imports are no work of the check
    return calls_of(lambda: work(many)) / calls_of(lambda: work(few))


@pytest.mark.parametrize("row", [row_of_beams, row_of_floats])
def test_what_is_modelled_is_said_in_a_time_that_grows_with_the_bodies(row: Callable[..., TankScene]) -> None:
    """Measured 2.1 for twice the bodies, before 2.9 and 3.2; in open water nothing is meshed."""
    assert growth_of(lambda count: tuple(checker_of(given := row(count, "open"))(given)), 25, 50) < 2.4


def test_waves_are_counted_for_a_few_of_many_tones() -> None:
    """Measured 2.1, as the logarithm of the number of tones takes part; counted for each tone it was 3.7."""

    def plan(count: int) -> None:
        given = row_of_beams(count)
        tank = physical_tank(given).scaled()
        initial_resolution(tank, given.accuracy.tolerance, modes=10, tones=expected_tones(tank))

    assert growth_of(plan, 25, 50) < 2.4


@pytest.mark.slow
def test_the_mesh_asks_only_what_is_near_for_the_size_of_an_element(monkeypatch: pytest.MonkeyPatch) -> None:
    """Measured 1.9 for twice the pieces; asking each source for each node would give 4."""
    asked = counted_sources(monkeypatch)

    def mesh(count: int) -> int:
        before = sum(asked)
        ends = [place / count for place in range(count)] + [1.0]
        pieces = tuple((start, end, f"body_{place}") for place, (start, end) in enumerate(pairwise(ends)))
        sizes = (0.5 / count,) * count
        build_tank_mesh(
            tank_geometry(length=1.0, depth=0.2, pieces=pieces), Grading(surface_sizes=sizes, bulk_size=0.1)
        )
        return sum(asked) - before

    assert mesh(160) < 2.4 * mesh(80)


def test_each_float_is_placed_once_and_compared_with_its_neighbours(monkeypatch: pytest.MonkeyPatch) -> None:
    compared = []
    nearer = float_rest_checks._nearer_than
    monkeypatch.setattr(float_rest_checks, "_nearer_than", lambda *boxes: compared.append(boxes) or nearer(*boxes))
    floats._placed.cache_clear()
    row_of_floats(MOST_BODIES)
    assert floats._placed.cache_info().misses == MOST_BODIES
    assert len(compared) < 2 * MOST_BODIES


def test_the_least_of_many_sources_is_found_among_a_few(monkeypatch: pytest.MonkeyPatch) -> None:
    """Segments of random sizes at random places: what is found is exactly what asking all of them gives."""
    random = np.random.default_rng(7)

    def complex_numbers(count: int) -> np.ndarray:
        return random.uniform(0.0, 1.0, count) + 1j * random.uniform(0.0, 1.0, count)

    count, starts = 1000, complex_numbers(1000)
    spans = 0.02 * complex_numbers(count) * (random.uniform(size=count) < 0.5)
    radii, sizes = 0.01 * random.uniform(size=count), 0.05 * random.uniform(size=count)
    sources = Sources(starts=starts, ends=starts + spans, radii=radii, sizes=sizes, growth=0.7)
    points = 2.0 * complex_numbers(50) - 0.5 * (1.0 + 1.0j)
    expected = sources._values(points)
    asked = counted_sources(monkeypatch)
    assert np.array_equal(sources.least(points, 10.0), expected)
    assert [sources.least_at(point) for point in points.tolist()] == pytest.approx(expected, rel=1e-14)
    # 160 of 1000 are asked for a point on average.
    assert sum(asked) < 50 * 250
    assert sources.least(points, 1e-9).tolist() == [1e-9] * 50


def told(**changes: Any) -> str:
    beam = {"start": 0.0, "length": 1.0, "flexural_rigidity": 1e4, "mass_per_length": 10.0}
    document = {"tank": {"length": LENGTH}, "liquid": [{"density": 1000.0, "depth": 5.0}], "body": [beam]}
    with pytest.raises(ValidationError) as caught:
        TankScene.model_validate(document | changes)
    return str(scene_error(caught.value, TankScene))


def test_more_bodies_sections_or_joints_than_one_mesh_can_show_are_refused() -> None:
    beam = {"start": 0.0, "length": 1.0, "flexural_rigidity": 1e4, "mass_per_length": 10.0}
    assert told(body=[beam] * (MOST_BODIES + 1)) == (
        f"[[body]]: there are too many. Allowed: up to {MOST_BODIES} bodies, in any order; none for sloshing alone."
    )
    section = {key: value for key, value in beam.items() if key != "start"}
    assert "[[body]] number 1, sections: there are too many" in told(
        body=[{"start": 0.0, "sections": [section] * (MOST_SECTIONS + 1)}]
    ).replace('key "sections"', "sections")
    joint = {"at": 0.5, "rotational_stiffness": 0.0}
    assert 'key "joints": there are too many' in told(body=[beam | {"joints": [joint] * (MOST_SECTIONS + 1)}])
