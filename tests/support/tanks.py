"""Tanks that several tests solve: made from a few changed values, or read from the exact reference cases."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.tank.field_model import build_field_model
from hydroelastic.fem.tank.mesh import geometry_of
from hydroelastic.fem.tank.solve import TankSolution
from hydroelastic.meshes.distribute import TankMesh, distribute_mesh
from hydroelastic.meshes.grading import Grading
from hydroelastic.meshes.tagged_mesh import TaggedMesh
from hydroelastic.meshes.tank import build_tank_mesh
from hydroelastic.physics import tank as physics
from hydroelastic.scenes.models import Accuracy, Beam, Liquid, Tank, TankScene
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.tank.solve import solve_scene


class Tanks:
    """Makes scenes, and solves each scene only once."""

    def __init__(self) -> None:
        path = Path(__file__).parents[1] / "reference" / "aquarium.json"
        self.reference: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
        self.cases: dict[str, Any] = {case["name"]: case for case in self.reference["cases"]}
        self._solutions: dict[tuple[TankScene, bool], TankSolution] = {}

    def beam(self, **changes: Any) -> Beam:
        """The beam of the case base_s0, but for what is changed."""
        values = {"start": 3.0, "length": 4.0, "flexural_rigidity": 5e3, "mass_per_length": 50.0, "hydrostatic": False}
        return Beam(**(values | changes))

    def scene(self, *beams: Beam, **changes: Any) -> TankScene:
        """The tank of the case base_s0 with the given beams, but for what is changed."""
        values = {"length": 10.0, "gravity": 9.81, "top": "free", "depth": 5.0, "density": 1000.0}
        values |= {"tolerance": 1e-6, "modes": 8} | changes
        return TankScene(
            tank=Tank(length=values["length"], gravity=values["gravity"], top=values["top"]),
            liquid=(Liquid(density=values["density"], depth=values["depth"]),),
            body=beams,
            accuracy=Accuracy(tolerance=values["tolerance"], modes=values["modes"]),
        )

    def case_scene(self, name: str, **changes: Any) -> TankScene:
        """A reference case as a scene."""
        given = self.cases[name]["inputs"]
        beam = {"start": given["x1"], "length": given["l"], "hydrostatic": bool(given["s"]), "ends": given["ends"]}
        beam |= {"flexural_rigidity": given["EI"], "mass_per_length": given["m"]}
        tank = {"length": given["L"], "gravity": given["g"], "depth": given["H"], "density": given["rho"]}
        return self.scene(*([Beam(**beam)] if given["l"] else []), **(tank | changes))

    def solve(self, scene: TankScene, *, halves: bool = True) -> TankSolution:
        """The scene's solution (collective)."""
        if (scene, halves) not in self._solutions:
            self._solutions[scene, halves] = solve_scene(scene, halves=halves)
        return self._solutions[scene, halves]

    def omega(self, scene: TankScene) -> np.ndarray:
        """ω of the modes asked for, rad/s (collective)."""
        solution = self.solve(scene)
        return np.array([solution.omega(mode.eigenvalue) for mode in solution.asked])

    def graded_mesh(
        self, scene: TankScene, *, size: float = 0.25, tip_size: float | None = 1e-8
    ) -> tuple[physics.Tank, TaggedMesh]:
        """The scaled scene and a mesh of it, elements of one size but for the rings at the tips."""
        tank = physical_tank(scene).scaled()
        grading = Grading(surface_sizes=(size,) * len(tank.pieces), bulk_size=size, tip_size=tip_size)
        return tank, build_tank_mesh(geometry_of(tank), grading)

    def distribute(self, tagged: TaggedMesh) -> TankMesh:
        """Spread a mesh that every process has made over all of them (collective)."""
        return distribute_mesh(MPI.COMM_WORLD, tagged)

    def pencil_on(
        self, mesh: TankMesh, tank: physics.Tank, *, degree: int, shapes: int, pressure_release: bool = False
    ) -> CoupledPencil:
        """The matrices of a scaled scene on a given mesh (collective)."""
        counts = (shapes,) * len(tank.beams)
        return build_field_model(mesh, tank, degree=degree, shapes=counts, infinite_frequency=pressure_release)

    def pencil(
        self,
        scene: TankScene,
        *,
        degree: int = 6,
        shapes: int = 20,
        size: float = 0.25,
        tip_size: float | None = 1e-8,
        pressure_release: bool = False,
    ) -> CoupledPencil:
        """The scene's matrices at a resolution of the test's choice (collective)."""
        tank, tagged = self.graded_mesh(scene, size=size, tip_size=tip_size)
        mesh = self.distribute(tagged)
        return self.pencil_on(mesh, tank, degree=degree, shapes=shapes, pressure_release=pressure_release)
