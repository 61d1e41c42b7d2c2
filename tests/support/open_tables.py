"""Solutions of scenes with open ends that no solver made: arbitrary numbers in arrays of the right shapes."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray

from hydroelastic.fem.open_water.region import Region
from hydroelastic.fem.open_water.results import (
    DecayTable,
    PlateDeflection,
    RadiationTable,
    ResonanceTable,
    ResponseTable,
)
from hydroelastic.output.open_water.variables import open_variables
from hydroelastic.physics.dofs import Dof, dof_names
from hydroelastic.scenes.models.bodies import Beam
from hydroelastic.scenes.models.open_analyses import Decay, Radiation, Resonance, Response
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.open_water.results import OpenSolution

CIRCLE: dict[str, Any] = {
    "kind": "float",
    "shape": "ellipse",
    "position": 5.0,
    "half_width": 0.5,
    "half_height": 0.5,
    "motions": ["heave", "sway"],
}
PLATE: dict[str, Any] = {"start": 1.0, "length": 3.0, "flexural_rigidity": 5e3, "mass_per_length": 50.0}
DEEP: dict[str, Any] = {"density": 1000.0, "depth": float("inf")}
OIL: dict[str, Any] = {"density": 800.0, "depth": 1.0}
ANALYSES: list[dict[str, Any]] = [
    {"kind": "radiation", "omega": [0.0, 1.0, 2.0, 3.0, float("inf")]},
    {"kind": "response", "omega": {"start": 1.0, "stop": 3.0, "number": 3}},
    {"kind": "resonance"},
    {"kind": "decay", "displacement": 0.1, "times": {"start": 0.0, "stop": 20.0, "number": 41}},
]
FROM_BOTH_SIDES: list[dict[str, Any]] = [
    *ANALYSES,
    {"kind": "response", "omega": [2.0, 4.0], "waves_from": "right"},
]


def open_scene(
    *bodies: dict[str, Any],
    liquids: tuple[dict[str, Any], ...] = (DEEP,),
    analyses: list[dict[str, Any]] = ANALYSES,
    **more: Any,
) -> TankScene:
    """Return a scene with open ends: a circle in deep water unless other things are given."""
    tank = {"length": 10.0, "ends": "open"} | {key: more.pop(key) for key in ("top", "length") if key in more}
    given = {"tank": tank, "liquid": list(liquids), "body": list(bodies or (CIRCLE,)), "analysis": analyses}
    return TankScene.model_validate(given | {"title": "Open water"} | more)


def arbitrary_solution(scene: TankScene, *, reasons: tuple[str, ...] = ()) -> OpenSolution:
    """Return tables for all analyses of a scene; no number in them means anything."""
    numbers = np.random.default_rng(1)
    return OpenSolution(
        scene=scene,
        radiation=tuple(_radiation(scene, one, numbers) for one in scene.analyses if isinstance(one, Radiation)),
        response=tuple(_response(scene, one, numbers) for one in scene.analyses if isinstance(one, Response)),
        resonance=tuple(_resonance(scene, one, numbers) for one in scene.analyses if isinstance(one, Resonance)),
        decay=tuple(_decay(scene, one) for one in scene.analyses if isinstance(one, Decay)),
        size={"cells": 1000, "dofs": 20000, "degree": 8},
        seconds={"mesh": 0.5, "solve": 2.0},
        reasons=reasons,
    )


def dofs_of(scene: TankScene, elastic_modes: int = 2) -> tuple[Dof, ...]:
    """Return the motions of all bodies, with the body in front where there are several."""
    named = []
    for body in scene.body:
        elastic = [f"elastic {shape}" for shape in range(1, elastic_modes + 1)]
        named.append(["heave", "pitch", *elastic] if isinstance(body, Beam) else body.motions)
    return dof_names(named)


def _waves(scene: TankScene) -> tuple[str, ...]:
    return ("internal", "surface") if len(scene.layers) == 2 and scene.top == "free" else ("surface",)


def _complex(numbers: np.random.Generator, *shape: int) -> np.ndarray:
    return numbers.normal(size=shape) + 1j * numbers.normal(size=shape)


def _wavenumbers(scene: TankScene, omega: np.ndarray) -> np.ndarray:
    """Deep-water waves; the internal ones ten times shorter."""
    return np.stack([omega**2 / 9.81 * (10.0 if wave == "internal" else 1.0) for wave in _waves(scene)], axis=1)


def _radiation(scene: TankScene, analysis: Radiation, numbers: np.random.Generator) -> RadiationTable:
    omega, dofs, waves = np.array(analysis.omega), dofs_of(scene, analysis.elastic_modes), _waves(scene)
    count, motions = len(omega), len(dofs)
    known, scattered = (_complex(numbers, count, len(waves), 2, motions) for _ in range(2))
    return RadiationTable(
        omega=omega,
        dofs=dofs,
        waves=waves,
        wavenumbers=_wavenumbers(scene, omega),
        added_mass=numbers.normal(size=(count, motions, motions)),
        radiation_damping=numbers.normal(size=(count, motions, motions)),
        radiation_damping_error=np.full((count, motions, motions), 1e-7),
        excitation_force=known + scattered,
        excitation_force_error=np.full(known.shape, 1e-7),
        froude_krylov_force=known,
        diffraction_force=scattered,
        relative_error=np.full(count, 1e-7),
        energy_residual=np.where(np.isfinite(omega), 1e-8, np.nan),
        haskind_residual=np.where(np.isfinite(omega), 2e-8, np.nan),
        inertia=np.diag(np.arange(1.0, motions + 1)),
        stiffness=np.diag(np.arange(2.0, motions + 2)),
        infinite_frequency_added_mass=np.eye(motions),
        factorizations=2 * count,
    )


def _response(scene: TankScene, analysis: Response, numbers: np.random.Generator) -> ResponseTable:
    omega, dofs, waves = np.array(analysis.omega), dofs_of(scene, 6), _waves(scene)
    count = len(omega)
    plates = [
        PlateDeflection(
            body=index,
            positions=np.linspace(beam.start, beam.end, analysis.positions),
            deflection=_complex(numbers, count, len(waves), analysis.positions),
            bending_moment=_complex(numbers, count, len(waves), analysis.positions),
            shear_force=_complex(numbers, count, len(waves), analysis.positions),
            deflection_error=np.full((count, len(waves)), 1e-7),
            bending_moment_error=np.full((count, len(waves)), 1e-7),
            shear_force_error=np.full((count, len(waves)), 1e-7),
        )
        for index, beam in scene.beams
    ]
    return ResponseTable(
        omega=omega,
        waves=waves,
        wavenumbers=_wavenumbers(scene, omega),
        dofs=dofs,
        waves_from=analysis.waves_from,
        amplitudes=_complex(numbers, count, len(waves), len(dofs)),
        amplitude_error=np.full((count, len(waves), len(dofs)), 1e-7),
        reflection=_complex(numbers, count, len(waves), len(waves)),
        transmission=_complex(numbers, count, len(waves), len(waves)),
        absorption=np.zeros((count, len(waves))),
        drift_force=np.ones((count, len(waves))),
        drift_error=np.full((count, len(waves)), 1e-7),
        energy_residual=np.full((count, len(waves)), 1e-9),
        relative_error=np.full(count, 1e-7),
        plates=tuple(plates),
    )


def _resonance(scene: TankScene, analysis: Resonance, numbers: np.random.Generator) -> ResonanceTable:
    dofs, count = dofs_of(scene), analysis.count
    return ResonanceTable(
        omega=np.arange(1, count + 1) - 0.1j * np.arange(1, count + 1),
        dofs=dofs,
        labels=tuple(dofs[number % len(dofs)] for number in range(count)),
        body_amplitudes=_complex(numbers, count, len(dofs)),
        residuals=np.full(count, 1e-11),
        relative_error=np.full(count, 1e-7),
        counted=count,
        region=Region(lowest=0.0, highest=5.0, damping=0.5),
    )


def _decay(scene: TankScene, analysis: Decay) -> DecayTable:
    dofs, times = dofs_of(scene), np.array(analysis.times)
    first = np.array([float(dof.endswith("heave")) for dof in dofs])
    motion = analysis.displacement.heave * (np.exp(-0.3 * times) * np.cos(2.0 * times) + 0.02 / (1.0 + times) ** 2)
    return DecayTable(
        times=times,
        dofs=dofs,
        displacement=motion[:, None] * first,
        initial=analysis.displacement.heave * first,
        absolute_error=np.full(len(times), 1e-8),
        tail=0.02 * analysis.displacement.heave,
        certified_until=float(times[-1]),
    )


def two_bodies(analyses: list[dict[str, Any]] = ANALYSES) -> OpenSolution:
    """A circle and a plate on two liquids with a free top: several dofs, two waves."""
    return arbitrary_solution(open_scene(CIRCLE, PLATE, liquids=(DEEP, OIL), analyses=analyses))


def open_dataset(solution: OpenSolution) -> xarray.Dataset:
    """Return the arrays of a solution as a dataset with complex numbers."""
    found = open_variables(solution)
    dataset = xarray.Dataset({one.name: (one.dimensions, one.values, one.attributes) for one in found})
    return dataset.set_coords([one.name for one in found if one.is_coordinate])
