"""Output of a study: tables, a CSV file, a figure and a summary."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict
from math import inf
from pathlib import Path

from rich import box
from rich.console import Console
from rich.table import Table

from hydroelastic.fem.study.rates import DIFFERENCE, GAIN_FACTOR, Gain
from hydroelastic.fem.study.reference import Reference
from hydroelastic.fem.study.row import Family, StudyRow
from hydroelastic.fem.study.singular_points import has_curved_contours, sharpest_of, symmetries_apart
from hydroelastic.output.folder import SUMMARY, result_folder
from hydroelastic.output.pictures.curves import Sheets
from hydroelastic.output.pictures.options import DEFAULT_PICTURES, PictureOptions
from hydroelastic.output.sections import text_console, text_of
from hydroelastic.physics.symmetry import Parity
from hydroelastic.physics.tank import Tank
from hydroelastic.scenes.errors import folder_errors
from hydroelastic.scenes.study.figure import draw_study
from hydroelastic.scenes.study.run import Study

# Where all modes have one order their symmetry is not stated.
_SYMMETRIES: dict[Parity | None, str] = {None: "", "symmetric": " sym.", "antisymmetric": " antisym."}
_WIDTH = 120

TITLES: dict[Family, str] = {
    "uniform": "Uniform meshes, every element halved from one to the next",
    "algebraic": "The same meshes drawn towards tips and corners, rᵢ = R (i/n)^β at the sharpest",
    "geometric": "One mesh, with geometric rings around tips and corners, degree by degree",
    "tolerance": "The solver with a requested tolerance",
}

Cell = Callable[[StudyRow], str]

_COLUMNS: dict[str, Cell] = {
    "asked": lambda row: "" if row.tolerance is None else f"{row.tolerance:.0e}",
    "degree": lambda row: str(row.degree),
    "β": lambda row: "" if row.grading is None else f"{row.grading:.3g}",
    "element/L": lambda row: f"{row.element_size:.4g}",
    "unknowns": lambda row: str(row.unknowns),
    "error": lambda row: _above(row, row.error),
    "lowest": lambda row: _above(row, row.lowest_error),
    "estimate": lambda row: "" if row.estimate is None else f"{row.estimate:.1e}",
    "ratio": lambda row: _ratio(row),
}
# Columns with the same value in every row of a family are left out of its table.
_SHOWN: dict[Family, tuple[str, ...]] = {
    "uniform": ("degree", "element/L", "unknowns", "error", "lowest"),
    "algebraic": ("degree", "β", "element/L", "unknowns", "error", "lowest"),
    "geometric": ("degree", "unknowns", "error", "lowest", "estimate", "ratio"),
    "tolerance": ("asked", "degree", "unknowns", "error", "lowest", "estimate", "ratio"),
}


def study_table(study: Study) -> str:
    """All rows by family, and the observed rates with those of theory, as text."""
    console = text_console(_WIDTH)
    _print_errors(console, study, study.reference)
    return "\n".join(line.rstrip() for line in text_of(console).splitlines())


def _print_errors(console: Console, study: Study, reference: Reference) -> None:
    modes = study.scene.accuracy.modes
    certain = f", estimated error {reference.uncertainty:.1e}" if reference.uncertainty else ", exact"
    for line in (
        f"{study.scene.title or 'Untitled scene'}: error against cost",
        f"Reference: {reference.name}{certain}.",
        *_symmetry_lines(study.tank),
        f"error: largest relative error of {modes} frequencies; lowest: of the lowest; ratio: estimate over error.",
        "Seconds without compiling; MB: highest resident memory, above what was held before.",
        "",
    ):
        console.print(line, markup=False)
    for family in study.plan.families:
        rows = study.rows_of(family)
        console.print(TITLES[family], markup=False)
        if rows:
            console.print(_rows_table(family, rows))
        else:
            console.print(f"  None: {_why_none(study.tank, family)}.\n", markup=False)
    if study.rates:
        console.print("Orders q, error ~ (element size)^q, fitted to the finest three meshes above rounding")
        console.print(_rates_table(study))
    if study.gain is not None:
        console.print(_gain_line(study.gain), markup=False)
    if "tolerance" in study.plan.families:
        console.print(_tolerance_line(study), markup=False)


def _symmetry_lines(tank: Tank) -> Iterator[str]:
    """The exponents of the error where the orders of symmetric and antisymmetric modes differ."""
    found = [f"{(sharpest_of(tank, parity) or inf):.3g} ({parity} modes)" for parity in symmetries_apart(tank)]
    if found:
        yield f"At the worst point ψ ~ r^α, α = {' or '.join(found)}: the error of all follows the smaller."


def _why_none(tank: Tank, family: Family) -> str:
    if family in ("uniform", "algebraic") and has_curved_contours(tank):
        return "the contour of a float is curved, and these meshes are halved along straight boundaries only"
    return "ψ is smooth, or no mesh has so few unknowns"


def _rows_table(family: Family, rows: Sequence[StudyRow]) -> Table:
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, padding=0)
    for heading in (*_SHOWN[family], "seconds", "MB"):
        table.add_column(heading, justify="right", no_wrap=True)
    for row in rows:
        table.add_row(
            *(_COLUMNS[column](row) for column in _SHOWN[family]),
            f"{row.seconds:.3f}",
            "" if row.memory is None else f"{row.memory / 1e6:.3g}",
        )
    return table


def _above(row: StudyRow, error: float) -> str:
    """An error; its upper limit where it is rounding or that of the reference."""
    return f"{error:.1e}" if error > row.floor else f"<{row.floor:.0e}"


def _ratio(row: StudyRow) -> str:
    return "" if row.estimate is None or row.error <= row.floor else f"{row.estimate / row.error:.1f}"


def _rates_table(study: Study) -> Table:
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, padding=(0, 1, 0, 0))
    for heading in ("meshes", "degree", "β", "observed", "expected", "mode", "elements/L", ""):
        table.add_column(heading, justify="left" if heading in ("meshes", "elements/L", "") else "right", no_wrap=True)
    for rate in study.rates:
        table.add_row(
            rate.family,
            str(rate.degree),
            f"{rate.grading:.3g}",
            f"{rate.observed:.3f} ± {rate.deviation:.3f}",
            f"{rate.expected:.4g}",
            f"{rate.mode}{_SYMMETRIES[rate.symmetry]}",
            ", ".join(f"{size:.3g}" for size in rate.sizes),
            "" if rate.agrees else f"> {100 * DIFFERENCE:.0f} % off: not yet asymptotic",
        )
    return table


def _gain_line(gain: Gain) -> str:
    theory = (
        "ψ is smooth, so no fixed factor is expected"
        if gain.expected is None
        else f"expected {gain.expected:.1f} on such triangles ({gain.along_a_ray:.1f} along a ray)"
    )
    flag = ""
    if not gain.agrees and gain.expected is not None:
        why = "other elements still gain more" if gain.observed > gain.expected else "slower than theory"
        flag = f"; off by more than a factor of {GAIN_FACTOR:g}: {why}"
    return (
        f"Gain per degree on geometric rings, mode {gain.mode}, degrees {gain.degrees[0]} to {gain.degrees[-1]}: "
        f"observed {gain.observed:.1f} ± {gain.observed * gain.deviation:.1f}, {theory}{flag}"
    )


def _tolerance_line(study: Study) -> str:
    asked = study.rows_of("tolerance")
    told = [row.estimate / row.error for row in asked if row.estimate is not None and row.error > row.floor]
    between = f"estimate over error from {min(told):.1f} to {max(told):.1f}" if told else "all errors are rounding"
    kept = "not all kept: " + "; ".join(study.reasons) if study.reasons else "all kept"
    return f"Tolerances: {kept}; {between}."


_CSV = (
    *("family", "degree", "element_size", "grading", "tolerance", "unknowns"),
    *("error", "lowest_error", "floor", "estimate", "seconds", "memory"),
)


def study_csv(study: Study) -> str:
    """All rows at full precision; columns that a family does not have are empty."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(_CSV)
    writer.writerows([getattr(row, column) for column in _CSV] for row in study.rows)
    return text.getvalue()


def write_study(
    study: Study, folder: Path, options: PictureOptions = DEFAULT_PICTURES, *, scene_file: Path | None = None
) -> None:
    """Write tables, rows, figure and summary into a result folder, whole or not at all."""
    with folder_errors(), result_folder(folder, scene_file=scene_file) as inside:
        sheets = Sheets(folder=inside, title=study.scene.title, options=options)
        (inside / "study.txt").write_text(study_table(study) + "\n", encoding="utf-8")
        (inside / "study.csv").write_text(study_csv(study), encoding="utf-8")
        draw_study(study, sheets)
        summary = {
            "scene": study.scene.model_dump(mode="json"),
            "status": "unconverged" if study.reasons else "ok",
            "reasons": study.reasons,
            "plan": asdict(study.plan),
            "reference": _reference_row(study.reference),
            "rates": [asdict(rate) | {"agrees": rate.agrees} for rate in study.rates],
            "gain": None if study.gain is None else asdict(study.gain) | {"agrees": study.gain.agrees},
            "rows": [asdict(row) for row in study.rows],
        }
        (inside / SUMMARY).write_text(json.dumps(summary, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


def _reference_row(reference: Reference) -> dict[str, object]:
    return {
        "name": reference.name,
        "omega": reference.omega.tolist(),
        "relative_error": reference.uncertainty,
        "symmetry": list(reference.parities),
    }
