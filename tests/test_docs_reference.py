"""The reference of the scenes' keys is that of the models, and tells a unit of each number that has one."""

import pytest
from pydantic import BaseModel
from results_reference import KINDS
from results_reference import page as results_page
from scene_reference import FOLDER, PAGES, UNIT, page, sections_of, value_type

REMEDY = "write the reference anew: ./hydro python docs/scene_reference.py"
# Numbers without a unit: counts, ratios, factors, coefficients, directions.
DIMENSIONLESS = {
    *("count", "modes", "elastic_modes", "positions", "frames", "tolerance", "body", "tail", "largest_damping"),
    *("normal_drag", "tangential_drag", "taper", "clamp", "direction", "factors", "lift", "strouhal"),
    *("spectral_radius", "damping_ratio", "poisson_ratio", "to", "peak_enhancement", "slope", "seed", "number"),
}


def models(kind: str) -> list[type[BaseModel]]:
    return [PAGES[kind], *(section.model for section in sections_of(PAGES[kind]))]


@pytest.mark.parametrize("kind", PAGES)
def test_pages_are_those_of_the_models(kind: str) -> None:
    assert (FOLDER / f"{kind}.md").read_text(encoding="utf-8") == page(kind), REMEDY


@pytest.mark.parametrize("kind", KINDS)
def test_pages_of_results_are_those_of_the_quantities(kind: str) -> None:
    written = (FOLDER / f"results_{kind}.md").read_text(encoding="utf-8")
    assert written == results_page(KINDS[kind]), "write them anew: ./hydro python docs/results_reference.py"


def test_there_is_a_page_of_each_kind_and_no_other() -> None:
    of_results = {f"results_{kind}" for kind in KINDS}
    assert {path.stem for path in FOLDER.glob("*.md")} == {*PAGES, *of_results, "index"}
    index = (FOLDER / "index.md").read_text(encoding="utf-8")
    assert all(
        f'`"{kind}"`' in index and f"({kind}.md)" in index for kind in ("tank", "sea", "string", "thread", "roll")
    )


@pytest.mark.parametrize("kind", PAGES)
def test_every_key_tells_what_it_is_and_every_number_its_unit(kind: str) -> None:
    for model in models(kind):
        for key, field in model.model_fields.items():
            assert field.description, f"{model.__name__}.{key}"
            has_unit = bool(UNIT.search(field.description))
            may_have_one = value_type(field)[0] in (float, int) and not (
                key in DIMENSIONLESS or (model.__name__, key) == ("FlexibleThread", "added_mass")
            )
            if may_have_one:
                assert has_unit, f"{model.__name__}.{key}: {field.description}"


def test_an_example_of_each_column() -> None:
    rows = {line.split("`")[1]: line for line in page("tank").splitlines() if line.startswith("| `")}
    assert rows["gravity"] == "| `gravity` | number | m/s² | 9.81 | positive | acceleration of gravity |"
    assert "list of texts" in rows["motions"]
    assert '`"heave"`, `"sway"`, `"roll"`; 1 to 3 of them' in rows["motions"]
    assert "| positive, or `inf` |" in rows["depth"]
    assert "list of lists of 2 numbers" in rows["vertices"]
    assert "[table](#values-as-a-table)" in rows["times"]


def test_an_end_has_its_section_once_and_no_default_kind() -> None:
    text = page("thread")
    assert text.count("## `[ends.a]` or `[ends.b]`: fixed") == 1
    assert '| `kind` | text |  | required | `"fixed"` |' in text
    assert '| `kind` | text |  | `"beam"` |' in page("tank")
