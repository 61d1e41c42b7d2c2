"""Import matplotlib without the documentation that it makes of each class: a third of the time of its import."""

from __future__ import annotations

import sys


def import_matplotlib() -> None:
    """Import what all pictures use; where matplotlib is imported already, nothing is done.

    What is missing afterwards are the lists of keywords in the help of classes and of their methods ``set``.
    """
    if "matplotlib.artist" in sys.modules:
        return
    from matplotlib import artist

    # They inspect all methods of each class: `kwdoc` for its help, and `Artist.__init_subclass__` for a method `set`
    # with a signature, which it leaves to a parent whose method has no such one.
    documented, signed = artist.kwdoc, artist.Artist.set
    setattr(artist, "kwdoc", lambda _class: "")  # noqa: B010
    setattr(artist.Artist, "set", lambda self, **properties: signed(self, **properties))  # noqa: B010
    try:
        import matplotlib.backends.backend_agg
        import matplotlib.figure  # noqa: F401
    finally:
        setattr(artist, "kwdoc", documented)  # noqa: B010
        setattr(artist.Artist, "set", signed)  # noqa: B010
