"""Regenerate results/shipped: tables and pictures of every shipped scene, and some studies.

    ./hydro python results/regenerate.py [SCENE ...]

Each scene of a closed tank keeps its tables, the sheet of all its modes and the pictures of its first elastic tone and
of heave, any other its summary and its pictures; fields, curves and frames stay out, they are large and one command
away. Studies of error against cost are made of the scenes in `STUDIED`. results/shipped/README.md lists all scenes with
what they took.
"""

from __future__ import annotations

import json
import shutil
import sys
import tempfile
from io import BytesIO
from pathlib import Path

import numpy as np
from PIL import Image

from hydroelastic.output.folder import SUMMARY
from hydroelastic.output.markdown import markdown_table, markdown_text
from hydroelastic.output.pictures.options import PictureOptions
from hydroelastic.output.pictures.page import save
from hydroelastic.output.provenance import Summary
from hydroelastic.scenes.models.level_tank import LevelTankScene
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.read import read_scene, shipped_scenes
from hydroelastic.scenes.run import run_scene
from hydroelastic.scenes.study.plan import StudyPlan
from hydroelastic.scenes.study.report import write_study
from hydroelastic.scenes.study.run import study_scene

SHIPPED = Path(__file__).parent / "shipped"
STUDIED = {
    "aquarium": StudyPlan(),
    "sloshing": StudyPlan(),
    "interface_beam": StudyPlan(),
    "float_ellipse": StudyPlan(),
    "float_parabola": StudyPlan(),
}
# At the width that pages show.
SHOWN = PictureOptions(width=720, dpi=85)
# Scenes whose pictures are kept smaller, with the names of the most telling ones.
FEW = {
    "conical_tank": "mode_001.png",
    "hemisphere": "[rv]*_1.png",
    "ice_floe": "[rv]*_1.png",
    "point_absorber": "[rv]*_1.png",
    "ship_tank": "mode_001.png",
    "spar": "re*.png",
    "spherical_tank": "mode_001.png",
}
SMALL = PictureOptions(width=400, dpi=50)
TABLES = ("summary.json", "summary.md", "modes.csv")
OTHER_TABLES = ("summary.json", "summary.md")


def regenerate(name: str) -> str:
    """Run one scene and keep the small part of its results."""
    scene = read_scene(name)
    with tempfile.TemporaryDirectory() as scratch:
        outcome = run_scene(scene, out=Path(scratch) / name, images=SMALL if name in FEW else SHOWN)
        assert outcome.folder is not None
        kept = SHIPPED / name
        shutil.rmtree(kept, ignore_errors=True)
        kept.mkdir(parents=True)
        pictures = outcome.folder / "images"
        in_section = isinstance(scene, TankScene) and not scene.is_open
        of_tank = in_section or isinstance(scene, LevelTankScene)
        for table in TABLES if of_tank else OTHER_TABLES:
            shutil.copy(outcome.folder / table, kept)
        if of_tank:
            if in_section:
                keep_picture(pictures / "overview.png", kept / "overview.png")
            for index, picture in shown_modes(outcome.summary).items():
                keep_picture(pictures / f"mode_{index:03d}.png", kept / picture)
        else:
            # Frames of an animation lie in a folder of their own and stay out.
            for drawn in sorted(pictures.glob(FEW.get(name, "*.png"))):
                keep_picture(drawn, kept / drawn.name)
    if name in STUDIED:
        assert isinstance(scene, TankScene)
        with tempfile.TemporaryDirectory() as scratch:
            write_study(study_scene(scene, STUDIED[name]), Path(scratch) / name)
            for file in (Path(scratch) / name).iterdir():
                if file.name != SUMMARY:
                    (keep_picture if file.suffix == ".png" else shutil.copy)(file, kept / file.name)
    return outcome.status


def shown_modes(summary: Summary) -> dict[int, str]:
    """The modes whose pictures are kept, by number: the first elastic tone, and that in which a float heaves most."""
    tone = summary["first_elastic"]
    found = {tone["index"]: "first_elastic.png"} if tone is not None else {}
    for row in summary.get("floats", ()):
        found |= {mode["index"]: "heave.png" for mode in row["modes"] if mode["motion"] == "heave"}
    asked = len(summary["modes"])
    return {index: picture for index, picture in found.items() if index is not None and index <= asked}


def keep_picture(source: Path, target: Path) -> None:
    """Store a picture with all its colours, its rows as they are or filtered, whichever takes fewer bytes."""
    filtered = BytesIO()
    with Image.open(source) as picture:
        picture.convert("RGB").save(filtered, "PNG", optimize=True)
        save(np.asarray(picture.convert("RGBA")), target, compression=9)
    if len(filtered.getvalue()) < target.stat().st_size:
        target.write_bytes(filtered.getvalue())


def index() -> str:
    """Return a page that lists all shipped scenes, as their stored summaries have them."""
    headings = ("scene", "title", "kind", "status", "seconds", "pictures")
    rows = []
    for shipped in shipped_scenes():
        folder = SHIPPED / shipped.name
        summary = json.loads((folder / SUMMARY).read_text(encoding="utf-8"))
        pictures = ", ".join(f"[{path.stem}]({shipped.name}/{path.name})" for path in sorted(folder.glob("*.png")))
        rows.append(
            (
                f"`{shipped.name}`",
                markdown_text(shipped.title),
                summary["scene"]["kind"],
                summary["status"],
                f"{summary['seconds']:.1f}",
                pictures,
            )
        )
    return "\n".join(
        [
            "# The shipped scenes",
            "",
            "Made by `./hydro python results/regenerate.py`. Seconds are those of a run after imports.",
            "",
            markdown_table(headings, rows),
            "",
        ]
    )


def main() -> None:
    """Regenerate the scenes named on the command line, or all, and the list of all."""
    for name in sys.argv[1:] or [scene.name for scene in shipped_scenes()]:
        print(f"{name}: {regenerate(name)}", flush=True)
    (SHIPPED / "README.md").write_text(index(), encoding="utf-8")


if __name__ == "__main__":
    main()
