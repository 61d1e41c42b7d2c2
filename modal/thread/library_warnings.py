"""Warnings of NumPy and SciPy about iterations that fail: suppressed where the results are checked instead."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
from scipy.integrate import IntegrationWarning


@contextmanager
def suppressed_library_warnings() -> Iterator[None]:
    """Suppress warnings of NumPy and SciPy; their errors are raised."""
    with np.errstate(all="ignore"), warnings.catch_warnings():
        warnings.filterwarnings("ignore", category=RuntimeWarning)
        warnings.filterwarnings("ignore", category=IntegrationWarning)
        yield
