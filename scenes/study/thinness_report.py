"""Output of a study of thinness: a table with fitted rates and a CSV file."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence

from rich import box
from rich.console import Console
from rich.table import Table

from hydroelastic.fem.study.rates import DIFFERENCE
from hydroelastic.fem.study.thinness import ASKED, QUANTITIES, ThinnessRow, fitted_thinness

_WHY = {True: "heave is shared with waves", False: "not yet asymptotic"}


def print_thinness(console: Console, rows: Sequence[ThinnessRow]) -> None:
    """Print the differences thin/exact − 1 of all rows, and the rates at which they fall."""
    if not rows:
        console.print("  None: one of the models does not keep what is asked.\n", markup=False)
        return
    for line in (
        f"Differences thin/exact − 1 of floats of half width l and half height h; both models to {ASKED:g}.",
        "heave: ω; modal mass: of heave, * shared with waves; added mass: at infinite frequency; waves: ω of the two",
        "lowest modes other than heave.",
    ):
        console.print(line, markup=False)
    names = [name for name in QUANTITIES if any(name in row.compared for row in rows)]
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, padding=(0, 1, 0, 0))
    for heading in ("l in m", "l/h", "l/L", "ω thin", "ω exact", *names):
        table.add_column(heading, justify="right", no_wrap=True)
    for row in rows:
        heave = row.compared.get("heave")
        table.add_row(
            *(f"{value:.4g}" for value in (row.half_width, row.thinness, row.breadth)),
            *(["", ""] if heave is None else [f"{heave.thin:.8f}", f"{heave.exact:.8f}"]),
            *(_difference(row, name) for name in names),
        )
    console.print(table)
    console.print(_rates(rows))


def _difference(row: ThinnessRow, name: str) -> str:
    if name not in row.compared:
        return ""
    shared = "*" if name == "modal mass" and row.shared else ""
    return f"{row.compared[name].difference:+.2e}{shared}"


def _rates(rows: Sequence[ThinnessRow]) -> Table:
    table = Table(
        box=box.SIMPLE_HEAD,
        pad_edge=False,
        padding=(0, 1, 0, 0),
        title="Rates q, difference ~ l^q, fitted to the thinnest three floats",
        title_justify="left",
        title_style="",
    )
    for heading in ("", "observed", "expected", " "):
        table.add_column(heading, justify="right" if heading in ("observed", "expected") else "left", no_wrap=True)
    for rate in fitted_thinness(rows):
        table.add_row(
            QUANTITIES[rate.quantity][0],
            f"{rate.observed:.3f} ± {rate.deviation:.3f}",
            f"{rate.expected:g}",
            "" if rate.agrees else f"> {100 * DIFFERENCE:.0f} % off: {_WHY[rate.shared]}",
        )
    return table


def thinness_csv(rows: Sequence[ThinnessRow]) -> str:
    """Both models of every row at full precision; missing values are empty."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    names = {name: name.replace(" ", "_") for name in QUANTITIES}
    parts = ("thin", "exact", "difference", "uncertainty")
    columns = [f"{name}_{part}" for name in names.values() for part in parts]
    writer.writerow(["half_width", "thinness", "breadth", "shared", *columns])
    for row in rows:
        values: list[float | str] = []
        for name in names:
            found = row.compared.get(name)
            values += [""] * len(parts) if found is None else [getattr(found, part) for part in parts]
        writer.writerow([row.half_width, row.thinness, row.breadth, int(row.shared), *values])
    return text.getvalue()
