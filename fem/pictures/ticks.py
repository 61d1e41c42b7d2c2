"""Round numbers on scales, and how numbers are written."""

from __future__ import annotations

import numpy as np

from hydroelastic.fem.pictures.shapes import Array

_SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def round_ticks(low: float, high: float, count: int) -> Array:
    """Multiples of 1, 2 or 5 times a power of ten in [low, high], about ``count`` of them and never many more."""
    rough = (high - low) / count
    power = 10.0 ** np.floor(np.log10(rough))
    step = power * next(s for s in (1.0, 2.0, 5.0, 10.0) if s * power >= rough * (1 - 1e-9))
    first, last = np.ceil(low / step - 1e-9), np.floor(high / step + 1e-9)
    return step * np.arange(first, last + 1)


def short_number(value: float) -> str:
    """Three significant digits, with a power of ten for very large and very small numbers."""
    if 1e-3 <= value < 999.5:
        return f"{value:.3g}"
    mantissa, exponent = f"{value:.2e}".split("e")
    return f"{mantissa}·{power_of_ten(int(exponent))}"


def tick_labels(ticks: Array) -> list[str]:
    """Numbers with the same, smallest sufficient count of decimals and a true minus sign."""
    scale = float(np.abs(ticks).max(initial=0.0)) or 1.0
    decimals = next((d for d in range(12) if np.allclose(ticks, np.round(ticks, d), rtol=0, atol=1e-6 * scale)), 12)
    return [f"{tick + 0.0:.{decimals}f}".replace("-", "−") for tick in np.round(ticks, decimals)]


def power_of_ten(exponent: int) -> str:
    """10 with a superscript."""
    return f"10{str(exponent).translate(_SUPERSCRIPT)}"
