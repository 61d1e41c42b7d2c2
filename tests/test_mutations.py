"""The mutations that the default tests must see still fit the code; whether they are seen takes an hour to run."""

import mutations
import pytest


@pytest.mark.parametrize("mutation", mutations.mutations(), ids=lambda mutation: mutation["name"])
def test_a_mutation_fits_the_code(mutation: dict[str, str]) -> None:
    assert mutations.misfit(mutation) == ""
    assert mutation["new"] != mutation["old"]
