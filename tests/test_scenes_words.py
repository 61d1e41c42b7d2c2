"""Words that newcomers use lead to those of the scenes; what is nearly a number is told how to be one."""

import pytest
from scene_files import CIRCLE_IN_OPEN_WATER, refused

from hydroelastic.scenes.errors import SceneError
from hydroelastic.scenes.models.bodies import Beam, Float
from hydroelastic.scenes.number_texts import how_to_write
from hydroelastic.scenes.read import read_scene
from hydroelastic.scenes.words import nearest, proposal

ANALYSIS = "[[analysis]]\nkind = {kind}\n{key} = [1.0]\n"


@pytest.mark.parametrize(
    ("word", "known", "meant"),
    [
        ("plate", ("beam", "float"), "beam"),  # by its letters it is nearer to "float"
        ("Pontoon", ("beam", "float"), "float"),
        ("ship", ("tank", "string", "thread", "roll"), "roll"),
        ("ship", ("beam", "float"), "float"),
        ("RAO", ("radiation", "response", "resonance", "decay"), "response"),
        ("anchor", ("fixed", "free", "surface"), "fixed"),
        ("lenght", ("length", "depth"), "length"),
        ("zebra", ("length", "depth"), None),
    ],
)
def test_a_word_is_known_by_what_it_means(word: str, known: tuple[str, ...], meant: str | None) -> None:
    assert nearest(word, known) == meant


def test_a_period_is_turned_into_a_frequency(tmp_path) -> None:  # type: ignore[no-untyped-def]
    for key in ("period", "wave_period"):
        text = CIRCLE_IN_OPEN_WATER + ANALYSIS.format(kind='"response"', key=key)
        assert 'Did you mean "omega"? omega = 2π/T in rad/s.' in refused(tmp_path, text)
    text = CIRCLE_IN_OPEN_WATER + ANALYSIS.format(kind='"radiation"', key="frequency")
    assert "omega = 2πf in rad/s" in refused(tmp_path, text)
    text = CIRCLE_IN_OPEN_WATER + ANALYSIS.format(kind='"rao"', key="omega")
    assert 'Did you mean "response"?' in refused(tmp_path, text)


def test_only_a_word_for_omega_is_converted() -> None:
    assert proposal("omga", ("omega",)) == 'Did you mean "omega"?'
    assert proposal("perod", ("period",)) == 'Did you mean "period"?'


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("12mm", "Write a number without a unit; the unit is m"),
        ('"1.5e3 kg/m"', "Write a number without a unit; the unit is m"),
        ("5°", "Write a number without a unit; the unit is m"),
        ("-12,5", "Write a decimal point, not a comma: -12.5"),
        ("12.5", ""),
        ("1, 2", ""),
        ("thick", ""),
        ("2026-11-22", ""),
    ],
)
def test_what_is_nearly_a_number(text: str, said: str) -> None:
    assert how_to_write(text, "length of the tank, m; more") == said


def test_units_are_read_off_the_descriptions_of_the_models() -> None:
    for model, key, unit in (
        (Beam, "start", "m"),
        (Beam, "mass_per_length", "kg/m²"),
        (Float, "radius_of_gyration", "m"),
    ):
        assert how_to_write("1 in", model.model_fields[key].description or "").endswith(f"the unit is {unit}")


@pytest.mark.parametrize("value", ['"a lot"', "true"])
def test_what_is_neither_a_number_nor_a_table(value: str) -> None:
    with pytest.raises(SceneError) as error:
        read_scene("string_smooth", [f"string.resistance={value}"])
    assert "it is neither a number nor a table. Allowed: λ" in str(error.value)
    assert "Write it as" not in str(error.value)
