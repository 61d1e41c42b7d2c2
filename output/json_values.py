"""Conversion of the values of a summary to types of JSON."""

from __future__ import annotations

from math import isfinite, isinf, isnan
from typing import Any

import numpy as np


def json_ready(value: Any) -> Any:
    """Return a value in types of JSON: arrays as lists, complex numbers as pairs, no infinity and no NaN."""
    # Nearly all are of these types.
    if value is None or type(value) in (str, int, bool) or (type(value) is float and isfinite(value)):
        return value
    if isinstance(value, np.ndarray):
        return json_ready(value.tolist())
    if isinstance(value, dict):
        return {name: json_ready(entry) for name, entry in value.items()}
    if isinstance(value, list | tuple):
        return [json_ready(entry) for entry in value]
    if isinstance(value, np.generic):
        return json_ready(value.item())
    if isinstance(value, complex):
        return [json_ready(value.real), json_ready(value.imag)]
    if isinstance(value, float) and isnan(value):
        return None
    if isinstance(value, float) and isinf(value):
        return "inf" if value > 0 else "-inf"
    return value
