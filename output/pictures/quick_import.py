"""Import matplotlib without the documentation that it makes of each class: two fifths of the time of its import."""

from __future__ import annotations

import sys


def import_matplotlib() -> None:
    """Import what all pictures use; where matplotlib is imported already, nothing is done.

    What is missing afterwards are the lists of keywords in the help of classes and of their methods ``set``.
    """
    if "matplotlib.artist" in sys.modules:
        return
    from matplotlib import artist

    # It inspects all methods of each class, and is called for each from `Artist.__init_subclass__` on.
    kept = artist.kwdoc
    artist.kwdoc = lambda _class: ""
    try:
        import matplotlib.backends.backend_agg
        import matplotlib.figure  # noqa: F401
    finally:
        artist.kwdoc = kept
