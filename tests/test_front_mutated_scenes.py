"""Whatever a shipped scene is changed to, `check` accepts it or refuses it in words."""

from pathlib import Path

import pytest
from mutated_scenes import complaint, files_of_scenes, mutated_scenes


@pytest.mark.parametrize(("count", "seed"), [(40, 1), pytest.param(300, 2, marks=pytest.mark.slow)])
def test_changed_scenes_are_accepted_or_refused_in_words(count: int, seed: int, tmp_path: Path) -> None:
    files_of_scenes(tmp_path)
    found = [(name, complaint(document, tmp_path)) for name, document in mutated_scenes(count, seed)]
    assert not [(number, *one) for number, one in enumerate(found) if one[1]]
    assert len(found) == count
