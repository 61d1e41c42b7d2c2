"""A lesson in error against cost: how fast does a solution converge, and what does a digit cost?

    ./hydro python docs/tutorial_mesh_study.py [FOLDER]

It takes some seconds and writes a table and a figure into FOLDER, results/mesh_study by default. An editor that knows
cells (`# %%`) opens it as a notebook. docs/tutorial_mesh_study.md goes with it.
"""

# %%
import csv
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from hydroelastic.fem.study.row import StudyRow
from hydroelastic.scenes.models import Accuracy, Beam, Liquid, Tank, TankScene
from hydroelastic.scenes.study.run import StudyPlan, study_scene

# %% The tank: a scene is a frozen value, made from Python or read from a file; both are checked alike.
beam = Beam(start=3.0, length=4.0, flexural_rigidity=5e3, mass_per_length=50.0, hydrostatic=False)  # m, N·m, kg/m²
scene = TankScene(
    title="A plate in the middle of a tank",
    tank=Tank(length=10.0),  # m
    liquid=(Liquid(density=1000.0, depth=5.0),),  # kg/m³, m
    body=(beam,),
    accuracy=Accuracy(modes=4),
)

# %% The study: every row is one solution, with its errors against a far better one, and its seconds.
plan = StudyPlan(
    families=("uniform", "algebraic", "geometric", "tolerance"),
    degrees=(1, 2),
    halvings=4,
    geometric_degrees=(2, 3, 4, 5, 6, 7, 8),
    tolerances=(1e-3, 1e-5, 1e-7),
)
study = study_scene(scene, plan)


# %% Orders. Error ~ h^q is a straight line of slope q on logarithmic axes. Each mesh halves the elements of the last.
def observed_order(rows: tuple[StudyRow, ...]) -> float:
    """Slope of the error of the lowest frequency over the size of elements, on the three finest meshes."""
    sizes = [row.element_size for row in rows[-3:]]
    errors = [row.lowest_error for row in rows[-3:]]
    return float(np.polyfit(np.log(sizes), np.log(errors), 1)[0])


# What theory expects: ψ ~ r ln r at the plate's ends. On uniform meshes that spoils every degree alike, q = min(2p, 2).
# Meshes drawn towards the ends like r = R (i/n)^β, β > p, have the full order 2p again.
theory = {(rate.family, rate.degree): rate.expected for rate in study.rates}
orders = {key: observed_order(study.rows_of(*key)) for key in theory}
for (family, degree), order in orders.items():
    print(f"{family:9} degree {degree}: order {order:.2f}, theory {theory[family, degree]:g}")

# %% Rings that shrink geometrically towards the ends: each degree brings a factor, not a power of the size.
rings = [row for row in study.rows_of("geometric") if row.error > row.floor]
if study.gain is not None and study.gain.expected is not None:  # where the ends are what limits
    gain = (rings[-3].error / rings[-1].error) ** 0.5
    print(f"geometric rings: a factor of {gain:.0f} with degree {rings[-1].degree}, theory {study.gain.expected:.0f}")

# %% Tolerances: what `run` does. It knows no reference: its estimate is what you would be told.
told = study.rows_of("tolerance")
for row in told:
    print(f"asked {row.tolerance:.0e}: estimated {row.estimate:.0e}, true {row.error:.0e}")

# %% What it costs: the same error by four ways.
folder = Path(sys.argv[1] if len(sys.argv) > 1 else "results/mesh_study")
folder.mkdir(parents=True, exist_ok=True)
with (folder / "mesh_study.csv").open("w", encoding="utf-8", newline="") as file:
    writer = csv.writer(file)
    writer.writerow(["family", "degree", "element_size", "unknowns", "error", "seconds"])
    for row in study.rows:
        writer.writerow([row.family, row.degree, row.element_size, row.unknowns, row.error, row.seconds])

figure, axes = plt.subplots(figsize=(7, 5), layout="constrained")
ways = {
    "uniform, degree 2": study.rows_of("uniform", 2),
    "algebraic, degree 2": study.rows_of("algebraic", 2),
    "geometric rings, degrees 2 to 8": tuple(rings),
    "tolerances asked": told,
}
for name, rows in ways.items():
    axes.loglog([row.seconds for row in rows], [row.error for row in rows], "o-", label=name)
axes.set(xlabel="seconds", ylabel="largest relative error of 4 frequencies", title=scene.title)
axes.grid(which="both", alpha=0.3)
axes.legend()
figure.savefig(folder / "mesh_study.png", dpi=150)
print(f"Written to {folder}/")
