"""Numbers of bodies for files of other programs, as a solver would give them, and what they are compared with."""

from dataclasses import replace
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
from hydrodynamic_readers import Read

from hydroelastic.fem.open_water.results import RadiationTable, ResponseTable
from hydroelastic.fem.time_domain.results import ImpulseResponseTable
from hydroelastic.modal.beam.beam_shapes import beam_shapes
from hydroelastic.output.hydrodynamic_files.whole_bodies import WholeBodies, bodies_of_tables
from hydroelastic.physics.dofs import Dof, Turn
from hydroelastic.scenes.models import SeaScene
from hydroelastic.scenes.models.physical import physical_tank

WIDTH = 7.0
MATRICES = ("added_mass", "radiation_damping")
# Numbers are written with ten digits.
DIGITS = 1e-8
PHASE_AT = -0.5


def scene(**changes: Any) -> SeaScene:
    """A barge and a disc in a sea, with changes."""
    barge: dict[str, Any] = {
        "kind": "float",
        "shape": "rectangle",
        "half_width": 2.0,
        "half_height": 1.0,
        "motions": ["heave", "roll"],
    }
    disc = {"kind": "float", "shape": "ellipse", "half_width": 1.0, "half_height": 1.0, "motions": ["sway"]}
    barge |= {"position": 1.0, "vertical_centre_of_gravity": 0.2, "radius_of_gyration": 1.1}
    keys = {
        "sea": {"phase_at": PHASE_AT, "gravity": 9.8},
        "liquid": [{"density": 1025.0, "depth": 12.0}],
        "body": [barge, disc | {"position": 6.0}],
        "analysis": [{"kind": "radiation", "omega": [0.5, 1.0, 1.5]}],
    }
    return SeaScene(**keys | changes)


DOFS = (Dof("body_1__heave"), Dof("body_1__roll"), Dof("body_2__sway"))


def section_tables() -> SimpleNamespace:
    """Numbers of a section as a solver would give them, without its symmetries."""
    random = np.random.default_rng(5)

    def numbers(*shape: int) -> np.ndarray:
        return random.uniform(0.5, 1.5, shape) * 1e3

    def complex_numbers(*shape: int) -> np.ndarray:
        return np.asarray(numbers(*shape) * np.exp(2j * np.pi * random.uniform(size=shape)))

    omega = np.array([1.5, 0.5, np.inf, 1.0])
    finite = np.isfinite(omega)
    froude_krylov, diffraction = (complex_numbers(4, 1, 2, 3) * finite[:, None, None, None] for _ in range(2))
    radiation = RadiationTable(
        omega=omega,
        dofs=DOFS,
        waves=("surface",),
        wavenumbers=omega[:, None],
        added_mass=numbers(4, 3, 3),
        radiation_damping=numbers(4, 3, 3),
        radiation_damping_error=np.zeros((4, 3, 3)),
        excitation_force=froude_krylov + diffraction,
        excitation_force_error=np.zeros((4, 1, 2, 3)),
        froude_krylov_force=froude_krylov,
        diffraction_force=diffraction,
        relative_error=np.zeros(4),
        energy_residual=np.zeros(4),
        haskind_residual=np.zeros(4),
        inertia=np.diag([3.0, 2.0, 5.0]) * 1e3,
        stiffness=np.diag([4.0, 7.0, 0.0]) * 1e4,
        infinite_frequency_added_mass=None,
        factorizations=0,
    )
    response = SimpleNamespace(
        omega=np.array([1.0]), dofs=DOFS, waves_from="right", amplitudes=complex_numbers(1, 1, 3)
    )
    times = np.linspace(0.0, 4.0, 9)
    impulse = SimpleNamespace(
        times=times, dofs=DOFS, impulse_response=numbers(9, 3, 3), infinite_frequency_added_mass=numbers(3, 3)
    )
    return SimpleNamespace(radiation=radiation, response=response, impulse=impulse)


def bodies_of_sections(section: SimpleNamespace) -> WholeBodies:
    """The section as whole bodies."""
    return bodies_of_tables(
        physical_tank(scene()),
        [section.radiation],
        [cast(ResponseTable, section.response)],
        [cast(ImpulseResponseTable, section.impulse)],
        width=WIDTH,
    )


def agrees(read: Read, bodies: WholeBodies) -> None:
    """Assert that what was read is what was written."""
    scale, weight = bodies.density, bodies.density * bodies.gravity
    np.testing.assert_allclose(read.omega, bodies.omega, rtol=DIGITS)
    np.testing.assert_allclose(read.added_mass, bodies.added_mass / scale, rtol=DIGITS)
    per_frequency = bodies.radiation_damping / (scale * bodies.omega[:, None, None])
    np.testing.assert_allclose(read.damping, per_frequency, rtol=DIGITS)
    # e^{iωt} instead of e^{−iωt}.
    np.testing.assert_allclose(read.force, np.conj(bodies.excitation_force) / weight, rtol=DIGITS, atol=1e-12)


SOLIDS = (Dof("body_1__heave"), Turn("body_1__pitch"), Dof("body_2__surge"))


def solids_of_revolution(section: SimpleNamespace) -> WholeBodies:
    """The same numbers of a cylinder in heave and pitch, and of a ring around it in surge."""
    body: dict[str, Any] = {"kind": "float", "shape": "cylinder", "draught": 0.5}
    spar = body | {"radius": 1.0, "motions": ["heave", "pitch"], "vertical_centre_of_gravity": -0.3}
    ring = body | {"radius": 4.0, "inner_radius": 2.0, "motions": ["surge"]}
    radiation = replace(section.radiation, dofs=SOLIDS)
    # Heave is of another order than surge and pitch.
    for name in MATRICES:
        values = getattr(radiation, name).copy()
        values[:, 0, 1:] = values[:, 1:, 0] = 0.0
        radiation = replace(radiation, **{name: values})
    impulse = SimpleNamespace(**vars(section.impulse) | {"dofs": SOLIDS})
    return bodies_of_tables(physical_tank(scene(body=[spar, ring])), [radiation], [], [cast(Any, impulse)])


BEAM: dict[str, Any] = {
    "start": 10.0,
    "sections": [
        {"length": 2.0, "flexural_rigidity": 3e5, "mass_per_length": 300.0},
        {"length": 4.0, "flexural_rigidity": 1e5, "mass_per_length": 90.0},
    ],
}
OF_BEAM = tuple(Dof(f"body_2__{name}") for name in ("heave", "pitch", "elastic 1", "elastic 2"))


def barge_and_beam(section: SimpleNamespace) -> WholeBodies:
    """A barge that heaves and a beam of two sections, in arbitrary numbers but for what the beam itself is."""
    dofs = (Dof("body_1__heave"), *OF_BEAM)
    barge = {"kind": "float", "shape": "rectangle", "half_width": 2.0, "half_height": 1.0, "motions": ["heave"]}
    tank = physical_tank(scene(body=[barge | {"position": 1.0}, BEAM]))
    shapes = beam_shapes(tank.beams[1], len(OF_BEAM))
    inertia, stiffness = np.diag([5e3, *np.zeros(4)]), np.diag([4e4, *(1025.0 * 9.8 * 6.0 + shapes.bending)])
    inertia[1:, 1:] = shapes.mass
    random = np.random.default_rng(7)
    numbers = {
        "added_mass": random.uniform(1e2, 1e3, (4, 5, 5)),
        "radiation_damping": random.uniform(1e2, 1e3, (4, 5, 5)),
        "froude_krylov_force": random.uniform(1e2, 1e3, (4, 1, 2, 5)) * np.exp(2j),
        "diffraction_force": random.uniform(1e2, 1e3, (4, 1, 2, 5)) * np.exp(1j),
    }
    radiation = replace(section.radiation, dofs=dofs, inertia=inertia, stiffness=stiffness, **numbers)
    response = SimpleNamespace(
        omega=np.array([1.0]),
        # More modes move than radiation reports.
        dofs=(*dofs, Dof("body_2__elastic 3")),
        waves_from="left",
        amplitudes=random.uniform(1.0, 2.0, (1, 1, 6)) * np.exp(1j),
    )
    impulse = SimpleNamespace(
        times=section.impulse.times,
        impulse_response=random.uniform(1e2, 1e3, (9, 5, 5)),
        infinite_frequency_added_mass=random.uniform(1e2, 1e3, (5, 5)),
    )
    return bodies_of_tables(tank, [radiation], [cast(Any, response)], [cast(Any, impulse)], width=WIDTH)
