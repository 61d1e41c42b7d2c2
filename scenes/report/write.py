"""Write ``report.html``."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

from hydroelastic.output.outcome import Outcome
from hydroelastic.scenes.read import Scene
from hydroelastic.scenes.report.content import report_page
from hydroelastic.scenes.report.page import is_numeric, is_warning

REPORT = "report.html"
_HERE = Path(__file__).resolve().parent


def write_report(scene: Scene, outcome: Outcome, folder: Path) -> None:
    """Write a self-contained page about a run, on this process only."""
    (folder / REPORT).write_text(
        rendered("page.html.jinja", page=report_page(scene, outcome, folder)), encoding="utf-8"
    )


def rendered(template: str, **values: Any) -> str:
    """Return a template of this folder as HTML; texts in it are escaped."""
    environment = Environment(
        loader=FileSystemLoader(_HERE),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=StrictUndefined,
    )
    environment.tests |= {"loud": is_warning, "numeric": is_numeric}
    style = Markup((_HERE / "page.css").read_text(encoding="utf-8"))
    return environment.get_template(template).render(**values, style=style)
