"""Two folders exchange their names, at once where the system can."""

from __future__ import annotations

import ctypes
import os
import sys
from pathlib import Path

# Of <fcntl.h> and <linux/fs.h>.
_AT_FDCWD = -100
_RENAME_EXCHANGE = 2


def exchange(new: Path, old: Path) -> None:
    """Let two folders of one file system exchange their names.

    On Linux the exchange is atomic: at any time, also after a killed process, one of both states is seen. Some network
    file systems, and other systems, need two steps. Between them the old folder has the name of
    the new one with the ending ``.previous``.

    Args:
        new: the folder that takes the place of the other one.
        old: the other one; afterwards it has the name of the first.

    Raises:
        OSError: if the folders cannot be renamed; both keep their names.
    """
    if sys.platform == "linux":
        # Python has no function for it. glibc 2.28 of 2018 is the first one that has.
        rename = getattr(ctypes.CDLL(None), "renameat2", None)
        paths = os.fsencode(new), os.fsencode(old)
        if rename is not None and rename(_AT_FDCWD, paths[0], _AT_FDCWD, paths[1], _RENAME_EXCHANGE) == 0:
            return
    previous = new.with_suffix(".previous")
    old.rename(previous)
    try:
        new.rename(old)
    except BaseException:
        previous.rename(old)
        raise
    previous.rename(new)
