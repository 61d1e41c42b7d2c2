"""Write the reference of all results, `docs/reference/results_*.md`, from the quantities that are declared.

Run it after a change of a quantity: ./hydro python docs/results_reference.py
"""

from pathlib import Path

from hydroelastic.output.level_tank.quantities import LEVEL_TANK
from hydroelastic.output.open_water.quantities import OPEN_WATER
from hydroelastic.output.provenance import OF_ALL_SCENES
from hydroelastic.output.quantities import Group
from hydroelastic.output.quantity_tables import reference_table
from hydroelastic.output.roll.quantities import ROLL
from hydroelastic.output.string.quantities import HANGING_STRING
from hydroelastic.output.tank.quantities import TANK
from hydroelastic.output.thread.quantities import THREAD

FOLDER = Path(__file__).parent / "reference"
KINDS = {
    "tank": TANK,
    "level_tank": LEVEL_TANK,
    "open_water": OPEN_WATER,
    "string": HANGING_STRING,
    "thread": THREAD,
    "roll": ROLL,
}


def page(kind: Group) -> str:
    """Return the page of a kind of scene as Markdown."""
    return (
        "\n".join(
            (
                f"# Results of {kind.meaning}",
                "",
                "Written by `docs/results_reference.py` from the quantities declared in `output/`. Keys are those of "
                "`summary.json`, a point before a key for each level of tables around it; a table along a dimension is "
                "a list, or a dictionary by names; rows without a key are arrays that only `dataset.nc` has, with "
                "their dimensions. A key that is `null` has no value. Values with † depend on the mesh or the machine: "
                "only their presence is promised.",
                "",
                reference_table(kind),
                "",
                "In `summary.json` of all scenes there are also",
                "",
                reference_table(OF_ALL_SCENES),
            )
        )
        + "\n"
    )


if __name__ == "__main__":
    for name, declared in KINDS.items():
        (FOLDER / f"results_{name}.md").write_text(page(declared), encoding="utf-8")
