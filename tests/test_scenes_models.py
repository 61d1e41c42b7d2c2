"""Scene models: what is accepted, what is refused, and that they never change."""

import json
from typing import Any

import pytest

from hydroelastic.scenes.errors import SceneError
from hydroelastic.scenes.models import Accuracy, Beam, Liquid, MeshFile, Tank, TankScene
from hydroelastic.scenes.models.physical import physical_tank


def beam(**changes: Any) -> Beam:
    values: dict[str, Any] = {"start": 3.0, "length": 4.0, "flexural_rigidity": 5e3, "mass_per_length": 50.0}
    return Beam(**(values | changes))


def scene(*bodies: Beam, length: float = 10.0, depth: float = 5.0, **tank: Any) -> TankScene:
    return TankScene(
        tank=Tank(length=length, **tank), liquid=(Liquid(density=1000.0, depth=depth),), body=bodies, title="A tank"
    )


def refusal(*bodies: Beam, **changes: Any) -> tuple[str, str]:
    with pytest.raises(SceneError) as caught:
        scene(*bodies, **changes)
    (problem,) = caught.value.problems
    return problem.key, problem.wrong


def test_defaults_are_those_of_the_contract() -> None:
    given = scene(beam())
    assert (given.kind, given.tank.gravity, given.tank.ends, given.tank.top) == ("tank", 9.81, "walls", "free")
    assert given.body[0].kind == "beam"
    assert given.body[0].hydrostatic is True
    assert given.body[0].ends == "free"
    assert given.accuracy == Accuracy(tolerance=1e-6, modes=10)
    assert given.mesh is None


def test_scenes_are_frozen_and_hashable() -> None:
    given = scene(beam())
    with pytest.raises(SceneError, match="scenes cannot be changed"):
        given.title = "Another"
    with pytest.raises(SceneError, match="scenes cannot be changed"):
        given.tank.length = 3.0
    assert hash(given) == hash(scene(beam()))


@pytest.mark.parametrize("bodies", [(), (beam(),), (beam(start=0.5), beam(start=5, hydrostatic=False))])
def test_round_trip_through_a_dictionary_and_json(bodies: tuple[Beam, ...]) -> None:
    given = scene(*bodies).model_copy(update={"mesh": MeshFile(file="tank.msh")})  # type: ignore[arg-type]
    assert TankScene.model_validate(given.model_dump()) == given
    assert TankScene.model_validate(json.loads(json.dumps(given.model_dump(mode="json")))) == given


def test_whole_numbers_become_floats() -> None:
    length = Tank(length=10).length
    assert isinstance(length, float)
    assert length == 10


@pytest.mark.parametrize("value", [True, "10", None, float("nan"), float("inf"), 0, -1, 1e-40, 1e40, [1], 10**400])
def test_lengths_are_positive_finite_numbers(value: Any) -> None:
    with pytest.raises(SceneError):
        Tank(length=value)


@pytest.mark.parametrize("modes", [0, 201, 10**6, 10.0, True, "10"])
def test_the_number_of_modes_is_a_whole_number_up_to_200(modes: Any) -> None:
    with pytest.raises(SceneError):
        Accuracy(modes=modes)
    assert Accuracy(modes=1).modes == 1
    assert Accuracy(modes=200).modes == 200


@pytest.mark.parametrize("tolerance", [0, 0.9e-12, 0.11, -1e-6, float("nan")])
def test_the_tolerance_lies_within_what_can_be_asked(tolerance: float) -> None:
    with pytest.raises(SceneError):
        Accuracy(tolerance=tolerance)
    assert Accuracy(tolerance=1e-12).tolerance == 1e-12
    assert Accuracy(tolerance=0.1).tolerance == 0.1


def test_truth_values_are_not_numbers_or_texts() -> None:
    for value in (1, "true"):
        with pytest.raises(SceneError):
            beam(hydrostatic=value)


def test_every_field_says_what_it_is() -> None:
    for model in (TankScene, Tank, Liquid, Beam, Accuracy, MeshFile):
        for name, field in model.model_fields.items():
            assert field.description, f"{model.__name__}.{name}"


def test_a_beam_must_lie_in_the_tank() -> None:
    location, message = refusal(beam(start=7))
    assert location == '[[body]] number 1, key "start"'
    assert "outside the tank" in message
    assert refusal(beam(start=0, length=11))[0] == '[[body]] number 1, key "length"'


def test_round_off_at_the_walls_is_forgiven() -> None:
    # 0.1 + 0.2 > 0.3 by one rounding; the top must still end exactly at the walls.
    given = scene(beam(start=0.1, length=0.2), length=0.3, depth=1)
    assert given.body[0].end > given.tank.length
    assert physical_tank(given).pieces[-1].end == 0.3
    assert [piece.body for piece in physical_tank(scene(beam(start=1e-12, length=10))).pieces] == [0]


@pytest.mark.parametrize("start", [6.0, 7.0, 4.0, 3.0])
def test_beams_neither_overlap_nor_touch(start: float) -> None:
    location, message = refusal(beam(), beam(start=start, length=1.5))
    assert location.startswith("[[body]]")
    assert "overlaps or touches" in message


def test_the_top_is_listed_from_wall_to_wall_whatever_the_order_of_the_beams() -> None:
    given = scene(beam(start=6, length=4), beam(start=1, length=2), top="rigid")
    (level,) = physical_tank(given).levels
    assert level.kind == "rigid"
    found = [(piece.start, piece.end, piece.body) for piece in level.pieces]
    assert found == [(0, 1, None), (1, 3, 1), (3, 6, None), (6, 10, 0)]


@pytest.mark.parametrize("top", ["rigid", "pressure_release"])
def test_something_must_be_able_to_move(top: str) -> None:
    assert refusal(top=top)[0] == '[tank], key "top"'
    assert scene(beam(), top=top).tank.top == top
    assert scene().body == ()


def test_guided_ends_need_both_walls() -> None:
    assert refusal(beam(ends="guided"))[0] == '[[body]] number 1, key "ends"'
    assert scene(beam(start=0, length=10, ends="guided")).body[0].ends == "guided"


@pytest.mark.parametrize("depth", [0.9e-3, 1.1e4])
def test_the_depth_fits_the_length(depth: float) -> None:
    assert refusal(depth=depth)[0] == '[[liquid]] number 1, key "depth"'


@pytest.mark.parametrize("depth", [1e-3, 1e4])
def test_the_limits_of_the_depth_are_allowed(depth: float) -> None:
    assert scene(depth=depth).liquid[0].depth == depth


@pytest.mark.parametrize(
    ("key", "value"), [("flexural_rigidity", 1e29), ("flexural_rigidity", 1e-29), ("mass_per_length", 1e-29)]
)
def test_groups_beyond_double_precision_are_refused(key: str, value: float) -> None:
    assert refusal(beam(**{key: value}))[0] == f'[[body]] number 1, key "{key}"'


@pytest.mark.parametrize("changes", [{"flexural_rigidity": 1e15, "mass_per_length": 2000.0}, {"mass_per_length": 1e-3}])
def test_the_extremes_of_the_reference_cases_are_accepted(changes: dict[str, float]) -> None:
    assert scene(beam(**changes)).body[0].length == 4.0


def test_what_is_not_modelled_is_not_allowed() -> None:
    with pytest.raises(SceneError):
        Tank(length=10, ends="periodic")  # type: ignore[arg-type]
    with pytest.raises(SceneError):
        beam(kind="float")
    liquid = Liquid(density=1000, depth=5)
    with pytest.raises(SceneError):
        TankScene(tank=Tank(length=10), liquid=(liquid, liquid))
    with pytest.raises(SceneError):
        TankScene(tank=Tank(length=10), liquid=(liquid,), damping=())  # type: ignore[call-arg]


@pytest.mark.parametrize("name", ["tank.stl", "tank", ""])
def test_meshes_have_a_known_format(name: str) -> None:
    with pytest.raises(SceneError):
        MeshFile(file=name)  # type: ignore[arg-type]
