"""What libraries say of iterations that fail is no word for a user: results are looked at, and judged, instead."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
from scipy.integrate import IntegrationWarning


@contextmanager
def suppressed_library_warnings() -> Iterator[None]:
    """Keep the warnings of NumPy and SciPy from the terminal; their errors go on."""
    with np.errstate(all="ignore"), warnings.catch_warnings():
        warnings.filterwarnings("ignore", category=RuntimeWarning)
        warnings.filterwarnings("ignore", category=IntegrationWarning)
        yield
