"""Import matplotlib without the documentation that it makes of each class: two fifths of the time of its import."""

from __future__ import annotations

import sys

_SIGNATURE = "_update_set_signature_and_docstring"


def import_matplotlib() -> None:
    """Import what all pictures use; where matplotlib is imported already, nothing is done.

    What is missing afterwards are the lists of keywords in the help of classes and of their methods ``set``.
    """
    if "matplotlib.artist" in sys.modules:
        return
    from matplotlib import artist

    # It inspects all methods of each class twice, for the signature of `set` and for its documentation.
    signature, kwdoc = vars(artist.Artist)[_SIGNATURE], artist.kwdoc
    setattr(artist.Artist, _SIGNATURE, lambda: None)
    setattr(artist, "kwdoc", lambda _class: "")  # noqa: B010
    try:
        import matplotlib.backends.backend_agg
        import matplotlib.figure  # noqa: F401
    finally:
        setattr(artist.Artist, _SIGNATURE, signature)
        setattr(artist, "kwdoc", kwdoc)  # noqa: B010
