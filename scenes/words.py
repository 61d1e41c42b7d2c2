"""Suggestions for unknown words in a scene: by spelling, or by synonyms."""

from __future__ import annotations

import difflib
from collections.abc import Iterable

# Synonyms, and the words of scenes for them; the first one that is allowed at the place is suggested.
_SYNONYMS = {
    "added_mass": ("radiation",),
    "anchor": ("fixed",),
    "anchored": ("fixed",),
    "bar": ("beam",),
    "barge": ("float",),
    "basin": ("tank",),
    "box": ("rectangle", "float"),
    "buoy": ("float", "free"),
    "cable": ("thread",),
    "chain": ("thread",),
    "circle": ("ellipse",),
    "clamped": ("fixed",),
    "cylinder": ("ellipse", "float"),
    "eigenmodes": ("modes", "resonance"),
    "free_decay": ("decay",),
    "frequencies": ("omega",),
    "frequency": ("omega",),
    "hull": ("float",),
    "lid": ("rigid",),
    "mooring": ("thread",),
    "ocean": ("sea",),
    "open_water": ("sea",),
    "period": ("omega",),
    "periods": ("omega",),
    "pinned": ("fixed",),
    "plate": ("beam",),
    "pontoon": ("float",),
    "rao": ("response",),
    "raos": ("response",),
    "riser": ("thread",),
    "rope": ("thread",),
    "ship": ("roll", "float"),
    "triangle": ("wedge",),
    "vessel": ("roll", "float"),
    "wave_period": ("omega",),
    "wave_periods": ("omega",),
}

_CONVERSIONS = {"period": "omega = 2π/T in rad/s", "frequenc": "omega = 2πf in rad/s"}
"""How omega follows from what was given in its place."""


def nearest(word: str, known: Iterable[str]) -> str | None:
    """Return the known word that ``word`` is a synonym of or most similar to; None if there is none."""
    by_lower_case = {name.lower(): name for name in known}
    for meant in _SYNONYMS.get(word.lower(), ()):
        if meant in by_lower_case:
            return by_lower_case[meant]
    found = difflib.get_close_matches(word.lower(), by_lower_case, n=1, cutoff=0.6)
    return by_lower_case[found[0]] if found else None


def proposal(word: str, known: Iterable[str]) -> str:
    """Return ``Did you mean "length"?`` for the nearest known word, or an empty text."""
    near = nearest(word, known)
    if near is None:
        return ""
    conversion = next((how for part, how in _CONVERSIONS.items() if near == "omega" and part in word.lower()), "")
    return f'Did you mean "{near}"?' + (f" {conversion}" if conversion else "")
