"""Quantities of older theories beside the field solution of open water, each declared once."""

from __future__ import annotations

from hydroelastic.output.quantities import Group, Quantity


def _poles(key: str, meaning: str, unit: str) -> Quantity:
    name = f"endless_float_{key}_entry"
    return Quantity(key, meaning, unit, dimensions=(name, f"{name}_2"))


# fmt: off
# A table: as many arguments on a line as fit.
_PARTS = (
    QUANTITY := Quantity("quantity", "quantity"),
    Quantity("theory", "by the theory"),
    Quantity("field", "by the field solution"),
    Quantity("difference", "relative difference of the theory from the field solution", "1", shown="%"),
)


def _rows(theory: str, prefix: str) -> Group:
    what = f"values by the {theory} and by the field solution"
    return Group("rows", what, _PARTS, dimension=f"{prefix}_row", prefix=prefix)


THIN_FLOAT_ROWS = _rows("thin-float theory", "thin_float")
ROUND_BODY_ROWS = _rows("theory", "round_body")

ESTIMATES = Group("estimates", "older theories beside the field solution", (
    THIN_FLOAT := Group("thin_float", "the thin-float theory", (
        THIN_FLOAT_ROWS,
        NOTE := Quantity("note", "what the theory neglects, or why it has no value"),
    ), record=lambda solution: dict(zip(("rows", "note"), solution.thin_float, strict=True)),
        note="of a lone float that heaves and whose shape is a half-width over height"),
    Group("endless_float", "the float of infinite draught, by its closed form", (
        Quantity("cut", "largest difference that the end of the float makes, of the displacement", "1"),
        _poles("resonances", "complex frequencies of heave and of the second pole, parts", "rad/s"),
        _poles("residues", "residues of both, parts", "1"),
    ), note="`null` for other floats"),
    ROUND_BODY := Group("round_body", "closed forms and older estimates of a lone body of revolution",
        (ROUND_BODY_ROWS,), record=lambda solution: {"rows": solution.round_body},
        note="long waves, Haskind's relation, MacCamy and Fuchs of upright cylinders, the rigid disc"),
), record=lambda solution: solution, prefix="")
