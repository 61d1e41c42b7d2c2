"""The list of the files that a run wrote into its result folder: the only files that a later run may replace."""

from __future__ import annotations

import hashlib
import json
import os
from dataclasses import asdict, dataclass
from pathlib import Path

MANIFEST = "manifest.json"


@dataclass(frozen=True, kw_only=True)
class Manifest:
    """The files that an earlier run wrote into a result folder.

    Attributes:
        scene: the scene file as a path relative to the folder, so that both may be moved together; empty where the
            scene came from Python.
        files: SHA-256 of each file, by its path relative to the folder.
    """

    scene: str
    files: dict[str, str]

    def is_own(self, folder: Path, name: str) -> bool:
        """Return whether a file of the folder was written by that run and is unchanged."""
        if name == MANIFEST:
            return True
        path = folder / name
        return name in self.files and path.is_file() and not path.is_symlink() and _digest(path) == self.files[name]

    def scene_file(self, folder: Path) -> Path | None:
        """Return the absolute path of the scene file; ``None`` where the scene came from Python."""
        return Path(os.path.normpath(folder.resolve() / self.scene)) if self.scene else None


def write_manifest(folder: Path, *, scene_file: Path | None, place: Path) -> None:
    """List all files of a finished folder in its ``manifest.json``, the last file to be written."""
    files = {name: _digest(folder / name) for name in file_names(folder)}
    scene = "" if scene_file is None else os.path.relpath(os.path.realpath(scene_file), place)
    text = json.dumps(asdict(Manifest(scene=scene, files=files)), indent=1, ensure_ascii=False)
    (folder / MANIFEST).write_text(text + "\n", encoding="utf-8")


def read_manifest(folder: Path) -> Manifest | None:
    """Return what an earlier run listed in a folder; ``None`` if there is no such folder or list."""
    try:
        found = json.loads((folder / MANIFEST).read_text(encoding="utf-8"))
        scene, files = found["scene"], found["files"]
    except (OSError, ValueError, TypeError, LookupError):
        return None
    if not (isinstance(scene, str) and isinstance(files, dict)):
        return None
    return Manifest(scene=scene, files=files)


def file_names(folder: Path) -> list[str]:
    """Return all files and links below a folder, as paths relative to it."""
    names = []
    for place, folders, files in os.walk(folder):
        links = [name for name in folders if os.path.islink(os.path.join(place, name))]
        names += [os.path.relpath(os.path.join(place, name), folder) for name in (*files, *links)]
    return sorted(names)


def _digest(file: Path) -> str:
    with file.open("rb") as content:
        return hashlib.file_digest(content, "sha256").hexdigest()
