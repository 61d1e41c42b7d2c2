"""Tables that scenes name: what holds too many rows is refused before it is read to its end, whoever reads it."""

from pathlib import Path

import pytest
from scene_files import refused

from hydroelastic.scenes.errors import SceneError
from hydroelastic.scenes.models.number_files import MOST_BYTES, MOST_ROWS, read_columns
from hydroelastic.scenes.read import read_scene

# Every key of a scene that names a table: its columns, and a scene that is good but for the table.
READERS = {
    "outline": (
        2,
        'kind = "tank"\n[tank]\nlength = 10.0\n[[liquid]]\ndensity = 1000.0\ndepth = 5.0\n'
        '[[body]]\nkind = "float"\nshape = "outline"\nposition = 5.0\nfile = "table.csv"\n',
        '[[body]] number 1, key "file"',
    ),
    "motion of a string": (
        2,
        'kind = "string"\n[string]\nlength = 1.0\nlinear_density = 1.0\n[motion]\nkind = "table"\nfile = "table.csv"\n',
        '[motion], key "file"',
    ),
    "waves": (2, 'kind = "roll"\n[roll]\nnatural_period = 8.0\n[train]\nfile = "table.csv"\n', '[train], key "file"'),
    "stream": (
        3,
        'kind = "thread"\n[thread]\nlength = 10.0\nweight = 1.0\n[stream]\ndensity = 1000.0\nfile = "table.csv"\n'
        '[ends.b]\nkind = "free"\n',
        '[stream], key "file"',
    ),
    "motion of a thread's end": (
        4,
        'kind = "thread"\n[thread]\nlength = 10.0\nweight = 1.0\nmass = 1.0\n[ends.b]\nkind = "free"\n'
        '[[analysis]]\nkind = "motion"\ntimes = [0.0, 1.0]\n[[analysis.move]]\nend = "a"\nfile = "table.csv"\n',
        'key "move.file", entry 1',
    ),
}


@pytest.mark.slow_but("outline")
@pytest.mark.parametrize("reader", READERS)
def test_a_table_is_not_read_beyond_the_most_rows(reader: str, tmp_path: Path) -> None:
    """What stands after too many rows is no number, and that is not found."""
    columns, text, key = READERS[reader]
    rows = "".join(f"{','.join([str(row)] * columns)}\n" for row in range(MOST_ROWS + 1))
    (tmp_path / "table.csv").write_text(rows + "no number\n", encoding="utf-8")
    said = refused(tmp_path, text)
    assert key in said
    assert f"it holds more than {MOST_ROWS} rows" in said


@pytest.mark.parametrize("reader", READERS)
def test_a_file_that_is_too_large_for_a_table_is_not_opened(
    reader: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    _, text, key = READERS[reader]
    with (tmp_path / "table.csv").open("wb") as table:
        table.truncate(MOST_BYTES + 1)
    read_text = Path.read_text
    opened: list[str] = []
    monkeypatch.setattr(
        Path, "read_text", lambda path, *rest, **how: opened.append(path.name) or read_text(path, *rest, **how)
    )
    said = refused(tmp_path, text)
    assert key in said
    assert "it is 20 MB large: a table of up to 100000 rows takes 20 MB at most" in said
    assert opened == []


def test_a_scene_that_is_too_large_is_not_opened(tmp_path: Path) -> None:
    with (tmp_path / "scene.toml").open("wb") as file:
        file.truncate(30_000_000)
    with pytest.raises(SceneError, match="it is 30 MB large, and a scene takes 20 MB at most"):
        read_scene(tmp_path / "scene.toml")


def test_as_many_rows_as_are_allowed_are_read(tmp_path: Path) -> None:
    table = tmp_path / "table.csv"
    table.write_text("time,value\n" + "1,2\n" * MOST_ROWS, encoding="utf-8")
    assert len(read_columns(table, 2)) == MOST_ROWS


def test_control_characters_of_a_table_do_not_reach_the_terminal(tmp_path: Path) -> None:
    (tmp_path / "table.csv").write_text("0,0\n\x1b[31mred\n", encoding="utf-8")
    assert r'line 2, "\u001b[31mred", is not two numbers' in refused(tmp_path, READERS["waves"][1])
