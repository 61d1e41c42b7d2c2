"""The page of errata is that of the code: its lists, and its numbers, evaluated anew as printed and as corrected."""

import math
from pathlib import Path

import pytest
from errata_numbers import ROLL_NUMBERS, STRING_NUMBERS, Number, row

from hydroelastic.modal.beam.paper_model import Erratum
from hydroelastic.modal.roll.paper import ROLL_ERRATA
from hydroelastic.modal.string.paper import STRING_ERRATA

PAGE = Path(__file__).parent.parent / "docs" / "errata_string_and_roll.md"
STRING_PART, ROLL_PART = PAGE.read_text(encoding="utf-8").split("## The ship on a swell")


def listed(erratum: Erratum) -> str:
    cells = (str(erratum.number), erratum.printed, erratum.corrected, erratum.consequence)
    return "| " + " | ".join(cell.replace("|", r"\|") for cell in cells) + " |"


@pytest.mark.parametrize("erratum", STRING_ERRATA, ids=lambda erratum: f"string {erratum.number}")
def test_errata_of_the_string_are_on_the_page(erratum: Erratum) -> None:
    assert listed(erratum) in STRING_PART


@pytest.mark.parametrize("erratum", ROLL_ERRATA, ids=lambda erratum: f"ship {erratum.number}")
def test_errata_of_the_ship_are_on_the_page(erratum: Erratum) -> None:
    assert listed(erratum) in ROLL_PART


@pytest.mark.slow_but("[!e]*")
@pytest.mark.parametrize("number", STRING_NUMBERS, ids=lambda number: number.quantity)
def test_numbers_of_the_string_are_those_of_both_formulas(number: Number) -> None:
    assert row(number) in STRING_PART
    differ(number)


@pytest.mark.parametrize("number", ROLL_NUMBERS, ids=lambda number: number.quantity)
def test_numbers_of_the_ship_are_those_of_both_formulas(number: Number) -> None:
    assert row(number) in ROLL_PART
    differ(number)


def differ(number: Number) -> None:
    """An erratum that changes nothing would be none; a formula that the paper lacks is not a number."""
    values = number.values()
    assert math.isnan(values.printed) or abs(values.printed - values.corrected) > 1e-3 * abs(values.corrected)
