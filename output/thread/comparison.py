"""Quantities of the comparison of a thread with estimates, which `scenes.thread.compare` computes."""

from __future__ import annotations

from hydroelastic.output.quantities import Group, Quantity

# fmt: off
# A table: as many arguments on a line as fit.
_ESTIMATE = (
    NAME := Quantity("name", "name of the estimate", short="estimate"),
    ORDER := Quantity("order", "order of the theory", "1", note="`null` of an exact one"),
    PARAMETER := Quantity("parameter", "what must be small", note="`\"\"` of an exact one"),
    SMALL := Quantity("small", "its value", "1", shown=".2g"),
    ESTIMATE_SECONDS := Quantity("seconds", "time that the estimate took", "s", shown=".3f", contract=False),
)
_BESIDE = (
    DIFFERENCE := Quantity("difference", "difference from the field solution", short="difference", shown=".1e"),
    Quantity("field_error", "estimated error of the field solution", short="error of field",
        shown=".1e", contract=False),
    LEFT_OUT := Quantity("left_out", "estimate of what the theory leaves out", short="left out", shown=".1e"),
    EXPLAINED := Quantity("explained", "whether both explain the difference", short="explained"),
)
COMPARISON = Group("comparison", "estimates beside the field solution", (
    FIELD := Group("field", "the field solution", (
        POSITION_ERROR := Quantity("position_error", "estimated error of positions", "m", shown=".1e", contract=False),
        TENSION_ERROR := Quantity("tension_error", "estimated error of tensions", "N", shown=".1e", contract=False),
        SECONDS := Quantity("seconds", "time that it took", "s", shown=".2f", contract=False),
    )),
    SHAPES := Group("shapes", "estimates of the equilibrium", (
        *_ESTIMATE,
        Quantity("end_positions", "positions of the ends A and B", "m", dimensions=("end", "axis")),
        Quantity("end_tensions", "tensions at the ends A and B", "N", dimensions=("end",)),
        Quantity("smallest_tension", "smallest tension", "N"),
        POSITION := Group("position", "largest difference of a position", _BESIDE),
        TENSION := Group("tension", "largest difference of a tension", _BESIDE),
    ), dimension="shape"),
    VALUES := Group("values", "estimates of single values", (
        *_ESTIMATE,
        QUANTITY := Quantity("quantity", "what is estimated"),
        COMPARED := Group("compared", "each value", (
            Quantity("number", "number", "1"),
            OF_FIELD := Quantity("field", "field solution"),
            OF_ESTIMATE := Quantity("estimate", "estimate"),
            *_BESIDE,
        ), dimension="value"),
    ), dimension="estimate"),
    INAPPLICABLE := Group("inapplicable", "estimates that do not apply", (
        NAME,
        REASON := Quantity("reason", "why"),
    ), dimension="inapplicable_estimate"),
))
