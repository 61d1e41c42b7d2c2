"""Run a scene of any kind."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path

from hydroelastic.fem.progress import Report
from hydroelastic.output.outcome import Outcome
from hydroelastic.output.pictures.options import DEFAULT_PICTURES, PictureOptions
from hydroelastic.scenes.kinds import runner_of
from hydroelastic.scenes.read import Scene


def run_scene(
    scene: Scene,
    *,
    out: Path | None = None,
    images: PictureOptions | None = DEFAULT_PICTURES,
    page: bool = False,
    import_seconds: float = 0.0,
    report: Report = lambda _message: None,
) -> Outcome:
    """Solve a scene and write its result folder (collective)."""
    return runner_of(scene)(
        scene,
        out=out,
        images=images,
        page=page_writer(scene) if page else None,
        import_seconds=import_seconds,
        report=report,
    )


def page_writer(scene: Scene) -> Callable[[Outcome, Path], None]:
    """Return the function that writes ``report.html`` into a result folder. Its libraries are imported now."""
    from hydroelastic.scenes.report.write import write_report

    return partial(write_report, scene)
