"""Motions that are larger than linear theory allows, told beside the results: a limit of the model, and no error."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from hydroelastic.output.sections import Section
from hydroelastic.physics.dofs import Dof
from hydroelastic.physics.linear_limits import SMALL_ANGLE, linear_limits
from hydroelastic.physics.tank import Tank

_TITLE = "Beyond linear theory"
_LINES = (
    "Linear theory takes wetted surfaces as they are at rest and angles as small (Faltinsen 1990). These results say "
    "that the motions are large, not how large; heave may be larger where a body follows long waves.",
)


def beyond_linear_theory(solution: Any) -> Iterator[Section]:
    """Yield a table of the motions that are larger than linear theory allows, if there are any."""
    rows = [row for name, dofs, sizes in _motions(solution) for row in _rows(solution.tank, name, dofs, sizes)]
    if rows:
        headings = ("analysis", "motion", "size", "limit", "what it is")
        yield Section(title=_TITLE, headings=headings, rows=rows, lines=_LINES)


def _motions(solution: Any) -> Iterator[tuple[str, Sequence[Dof], np.ndarray]]:
    """Yield the analyses that tell how large motions are, with these and their sizes, m or rad."""
    regular = [analysis for analysis in solution.scene.analyses if analysis.kind == "response"]
    for number, (analysis, response) in enumerate(zip(regular, solution.response, strict=True), 1):
        if analysis.wave_amplitude is not None:
            sizes = analysis.wave_amplitude * np.abs(response.amplitudes).max(axis=(0, 1))
            yield f"response {number}, largest amplitude", response.dofs, sizes
    for number, decay in enumerate(solution.decay, 1):
        yield f"decay {number}, largest", decay.dofs, np.abs(decay.displacement).max(axis=0)
    for number, spectrum in enumerate(solution.spectrum, 1):
        told = [one for one in spectrum.responses if isinstance(one.quantity, Dof)]
        dofs = [one.quantity for one in told]
        yield f"spectrum {number}, significant amplitude", dofs, np.array([one.significant_amplitude for one in told])
    for number, motion in enumerate(solution.motion, 1):
        yield f"motion {number}, largest", motion.dofs, motion.largest


def _rows(tank: Tank, name: str, dofs: Sequence[Dof], sizes: np.ndarray) -> Iterator[tuple[str, ...]]:
    for dof, size in zip(dofs, sizes, strict=True):
        index = (dof.body or 1) - 1
        body = tank.floats.get(index)
        limits = linear_limits(body, is_revolved=tank.geometry.is_revolved) if body else None
        if dof.is_rotation:
            limit, unit = limits.roll if limits else SMALL_ANGLE, "rad"
            reached = "deck edge dips or bottom emerges" if limit < SMALL_ANGLE else "small angles"
        elif limits and dof.motion == "heave":
            limit, unit, reached = limits.heave, "m", limits.reached
        else:
            continue
        if size > limit:
            yield name, dof.words, f"{size:.4g} {unit}", f"{limit:.4g} {unit}", reached
