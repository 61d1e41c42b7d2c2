"""Checks of scenes that ask for files for other programs."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from math import inf

from pydantic_core import InitErrorDetails

from hydroelastic.scenes.models.export import Format
from hydroelastic.scenes.models.open_analyses import Radiation
from hydroelastic.scenes.models.problems import problem_at
from hydroelastic.scenes.models.tank_parts import TankParts
from hydroelastic.scenes.models.time_analyses import ImpulseResponse

_ROUNDING = 1e-9
# Analyses whose numbers of modes the files have.
_OF_MODES = (Radiation, ImpulseResponse)


def export_is_possible(scene: TankParts) -> Iterator[InitErrorDetails]:
    """Yield what the files that are asked for need and the scene lacks."""
    if scene.export is None:
        return
    omega = sorted(
        {
            omega
            for analysis in scene.analysis
            if isinstance(analysis, Radiation)
            for omega in analysis.omega
            if 0.0 < omega < inf
        }
    )
    if not scene.is_open:
        yield problem_at(("export",), None, "a tank with walls has no waves", remedy="Leave it out")
    elif scene.plates:
        yield problem_at(("export",), None, "the files are those of rigid bodies and beams, and a plate is neither")
    elif scene.beams and len({one.elastic_modes for one in scene.analysis if isinstance(one, _OF_MODES)}) > 1:
        yield problem_at(
            ("export",),
            None,
            "the analyses of radiation and impulse responses have different elastic_modes",
            remedy="Give them the same",
        )
    elif len(scene.layers) > 1:
        yield problem_at(("export",), None, "the files are those of bodies in one liquid, and there are two")
    elif len(omega) < 2:
        yield problem_at(
            ("export",),
            None,
            "it needs an analysis of radiation at two or more frequencies",
            remedy='Add an [[analysis]] of kind = "radiation"',
        )
    else:
        yield from _width_is_that_of_sections(scene, scene.export.width)
        yield from _formats_are_possible(scene, scene.export.formats, omega)


def _width_is_that_of_sections(scene: TankParts, width: float | None) -> Iterator[InitErrorDetails]:
    if scene.is_revolved and width is not None:
        yield problem_at(("export", "width"), width, "solids of revolution have none", remedy="Leave it out")
    elif not scene.is_revolved and width is None:
        yield problem_at(
            ("export", "width"),
            None,
            "it is missing, and sections are solved per metre of width",
            allowed="the width of the bodies, m",
        )


def _is_equally_spaced(values: Sequence[float]) -> bool:
    """Whether ascending values have equal distances, but for rounding."""
    steps = [after - before for before, after in pairwise(values)]
    return max(steps) - min(steps) <= _ROUNDING * values[-1]


def _formats_are_possible(
    scene: TankParts, formats: tuple[Format, ...], omega: list[float]
) -> Iterator[InitErrorDetails]:
    key = ("export", "formats")
    if "nemoh" in formats and not _is_equally_spaced(omega):
        yield problem_at(
            key,
            "nemoh",
            "its readers take equally spaced frequencies",
            remedy='Ask for radiation at omega = { start, stop, number } with spacing = "linear"',
        )
    times = next((analysis.times for analysis in scene.analysis if isinstance(analysis, ImpulseResponse)), ())
    if "bemio" in formats and (len(times) < 2 or times[0] != 0.0 or not _is_equally_spaced(times)):
        yield problem_at(
            key,
            "bemio",
            "it holds impulse responses at equally spaced times from 0 on",
            remedy='Add an [[analysis]] of kind = "impulse_response" with times = { start = 0.0, stop, number }',
        )
