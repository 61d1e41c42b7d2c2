"""The content of a report, in its order: answer, results, comparison, pictures, model, scene, cost."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from hydroelastic.output.outcome import Outcome
from hydroelastic.output.provenance import SCENE, VERSIONS, read_summary, warnings_of
from hydroelastic.output.sections import title_of
from hydroelastic.scenes.kinds import checker_of
from hydroelastic.scenes.read import Scene
from hydroelastic.scenes.report.answer import answer
from hydroelastic.scenes.report.comparison import comparison_of
from hydroelastic.scenes.report.cost import cost_sections
from hydroelastic.scenes.report.page import Part, Picture, ReportPage, kind_of
from hydroelastic.scenes.report.pictures import pictures_of
from hydroelastic.scenes.report.resolved import resolved
from hydroelastic.scenes.report.scene_text import scene_text


def report_page(scene: Scene, outcome: Outcome, folder: Path) -> ReportPage:
    """Return the report of a run, on this process only."""
    summary = outcome.summary
    told = read_summary(summary)
    return ReportPage(
        title=title_of(summary),
        kind=kind_of(summary),
        tolerance=told[SCENE]["accuracy"]["tolerance"],
        reasons=outcome.reasons,
        warnings=(*warnings_of(summary), *outcome.warnings),
        version=told[VERSIONS]["hydroelastic"],
        parts=tuple(_parts(scene, outcome, folder / "images")),
    )


def _parts(scene: Scene, outcome: Outcome, images: Path) -> Iterator[Part]:
    summary = outcome.summary
    shown, left_out = pictures_of(images, summary)
    compared = comparison_of(scene, outcome)
    first = [picture for picture in shown if not picture.moving][:1]
    yield Part(anchor="answer", title="Answer", sections=(answer(summary),), pictures=tuple(first))
    yield Part(
        anchor="results",
        title="Results",
        lines=(compared,) if isinstance(compared, str) else (),
        sections=tuple(section for section in outcome.sections if not section.compares),
    )
    if not isinstance(compared, str):
        yield Part(anchor="comparison", title="Comparison with estimates and closed forms", sections=compared)
    further = tuple(picture for picture in shown if picture not in first)
    if further or left_out:
        yield _pictures(further, left_out)
    yield Part(
        anchor="model",
        title="What was modelled, and why",
        sections=(*checker_of(scene)(scene), resolved(summary)),
    )
    yield Part(
        anchor="scene",
        title="Scene",
        lines=("In SI units. Default values are marked.",),
        text=scene_text(scene),
    )
    yield Part(anchor="cost", title="Cost", sections=tuple(cost_sections(summary)))


def _pictures(shown: tuple[Picture, ...], left_out: tuple[str, ...]) -> Part:
    lines: tuple[str, ...] = ()
    if left_out:
        names = ", ".join(left_out)
        lines = (f"In the result folder only, because of their size or format: {names}.",)
    return Part(anchor="pictures", title="Pictures", lines=lines, pictures=shown)
