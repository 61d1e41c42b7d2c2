"""Captions of the pictures of a result folder, by their names."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import TypeAlias

from hydroelastic.output.digits import with_certain_digits
from hydroelastic.output.provenance import Summary

_Caption: TypeAlias = str | Callable[[Summary, int], str]


def _mode(summary: Summary, number: int) -> str:
    # Who only reads a result does without the libraries of solvers.
    from hydroelastic.output.level_tank import quantities as level
    from hydroelastic.output.tank import quantities as tank
    from hydroelastic.scenes.report.families import family_of, reading_of

    of_tank = tank.MODES, tank.MODE_OMEGA, tank.RELATIVE_ERROR, tank.KIND, tank.SYMMETRY
    of_level_tank = level.MODES, level.MODE_OMEGA, level.RELATIVE_ERROR, level.KIND, level.SYMMETRY
    modes, *parts = of_tank if family_of(summary) == "tank" else of_level_tank
    mode = reading_of(summary)[modes][number - 1]
    omega, error, kind, symmetry = (mode[part] for part in parts)
    words = ", ".join(filter(None, (kind, symmetry)))
    return f"Mode {number}: ω = {with_certain_digits(omega, error)} rad/s, {words}"


def _oscillation(_summary: Summary, number: int) -> str:
    return f"Free motion {number} over a period"


def _growing(summary: Summary, number: int) -> str:
    from hydroelastic.output.tank import quantities as tank
    from hydroelastic.scenes.report.families import reading_of

    return f"Motion that grows, number {number}: {reading_of(summary)[tank.GROWING][number - 1][tank.KIND]}"


_CAPTIONS: tuple[tuple[str, _Caption], ...] = (
    ("overview", "All modes on one sheet"),
    ("mode", _mode),
    ("growing", _growing),
    ("radiation", "Added mass, radiation damping and force of waves over frequency"),
    ("response", "Reflection, transmission and motions over frequency"),
    ("scattering", "Directions of the scattered power"),
    ("plan_response", "The waves around the bodies from above"),
    ("view_response", "The waves around the bodies"),
    ("deflection", "Deflection along the body in waves"),
    ("resonance", "Resonances in the complex plane"),
    ("decay", "Motion after release"),
    ("waves_radiation", "The waves that a motion makes"),
    ("waves_response", "Incident, transmitted and reflected waves"),
    ("waves_resonance", "The field of a resonance"),
    ("space_time", "Displacement over height and time"),
    ("shapes", "Shapes at a few times"),
    ("equilibrium", "The thread at rest, its tension as colour"),
    ("tension", "Tension along the thread at rest"),
    ("modes", "Shapes of the free motions"),
    ("oscillation", _oscillation),
    ("stability", "Roots against the stream: growth and frequency"),
    ("motion", "Shapes of the thread at a few times"),
    ("tension_in_time", "Tensions over time"),
    ("roll", "Angle of roll, slope of the waves and rate over time"),
)
"""By what comes before the number in a name, in the order in which a report shows them."""

_PLACES = {name: place for place, (name, _) in enumerate(_CAPTIONS)}
_NAME = re.compile(r"(?P<name>.+?)(?:_(?P<number>\d+)(?P<rest>.*))?")


def _parts(stem: str) -> tuple[str, int, str]:
    found = _NAME.fullmatch(stem)
    assert found is not None
    return found.group("name"), int(found.group("number") or 0), found.group("rest") or ""


def place_among_others(stem: str) -> tuple[int, int, str]:
    """Return the position of a picture among the others, by the name of its file without the ending."""
    name, number, rest = _parts(stem)
    return _PLACES.get(name, len(_CAPTIONS)), number, rest


def place_and_caption(stem: str, summary: Summary) -> tuple[tuple[int, int, str], str]:
    """Return the position of a picture among the others, and its caption."""
    name, number, rest = _parts(stem)
    order = place, *_ = place_among_others(stem)
    if place == len(_CAPTIONS):
        return order, stem.replace("_", " ").capitalize()
    caption, numbered = _CAPTIONS[place][1], f"analysis {number}" if number else ""
    if callable(caption):
        caption, numbered = caption(summary, number), ""
        rest = re.sub(r"^_(\d+)$", r"_analysis_\1", rest)
    words = " ".join(rest.replace("_", " ").split())
    # Numbered pictures within an analysis are resonances.
    words = re.sub(r"\b0*(\d+)$", r"resonance \1", words) if name == "waves_resonance" else words
    further = ", ".join(word for word in (numbered, words) if word)
    return order, caption + (f" ({further})" if further else "")
