"""A dataset of Capytaine: what its `assemble_dataset` makes, with complex numbers as `separate_complex_values` does.

Capytaine's time factor and phases are those of this project; dimensions and names are those of its version 3. The
motions are those that are modelled: rotations about the centres of gravity, hinges and elastic modes of beams. The
bending stiffness of these is beside that of hydrostatics: `rao` takes it as its argument `stiffness`.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from hydroelastic.output.dataset import write_dataset
from hydroelastic.output.hydrodynamic_files.whole_bodies import WholeBodies
from hydroelastic.output.variables import Variable


def write_capytaine(bodies: WholeBodies, path: Path) -> None:
    """Write the dataset as NetCDF."""
    attributes = {"comment": "exp(-i omega t); rotations about the centres of gravity"}
    write_dataset(path, _variables(bodies), attributes)


def _variables(bodies: WholeBodies) -> Iterator[Variable]:
    places = np.flatnonzero(bodies.modelled)
    names = [
        (bodies.bodies[bodies.names[place][0]].name + "__" if len(bodies.bodies) > 1 else "") + bodies.names[place][1]
        for place in places
    ]
    of_motions = ("omega", "radiating_dof", "influenced_dof")
    of_forces = ("omega", "wave_direction", "influenced_dof")
    for name, values in (("added_mass", bodies.added_mass), ("radiation_damping", bodies.radiation_damping)):
        # Motions before forces.
        yield _array(name, of_motions, values[:, places[:, None], places].swapaxes(1, 2))
    for name, force in (
        ("diffraction_force", bodies.diffraction_force),
        ("Froude_Krylov_force", bodies.froude_krylov_force),
        ("excitation_force", bodies.excitation_force),
    ):
        yield _array(name, of_forces, force[..., places])
    matrices = {"inertia_matrix": bodies.inertia, "hydrostatic_stiffness": bodies.stiffness}
    if bodies.bending_stiffness.any():
        matrices["bending_stiffness"] = bodies.bending_stiffness
    for name, matrix in matrices.items():
        yield _array(name, ("influenced_dof", "radiating_dof"), matrix[np.ix_(places, places)])
    yield _array("center_of_mass", ("body", "xyz"), [body.centre_of_gravity for body in bodies.bodies], units="m")
    yield _array("center_of_buoyancy", ("body", "xyz"), [body.centre_of_buoyancy for body in bodies.bodies], units="m")
    yield _array("displaced_volume", ("body",), [body.volume for body in bodies.bodies], units="m^3")
    for label, texts in (
        ("radiating_dof", names),
        ("influenced_dof", names),
        ("body", [body.name for body in bodies.bodies]),
        ("xyz", ["x", "y", "z"]),
    ):
        yield _array(label, (label,), texts)
    yield _array("omega", ("omega",), bodies.omega, units="rad/s")
    yield _array("wave_direction", ("wave_direction",), np.radians(bodies.directions), units="rad")
    yield _coordinate("period", ("omega",), 2.0 * np.pi / bodies.omega, units="s")
    yield _coordinate("rho", (), bodies.density, units="kg/m^3")
    yield _coordinate("g", (), bodies.gravity, units="m/s^2")
    yield _coordinate("water_depth", (), bodies.depth, units="m")
    yield _coordinate("forward_speed", (), 0.0, units="m/s")
    yield _coordinate("body_name", (), "+".join(body.name for body in bodies.bodies))


def _array(name: str, dimensions: tuple[str, ...], values: Any, **attributes: str) -> Variable:
    return Variable(name=name, dimensions=dimensions, values=np.asarray(values), attributes=attributes)


def _coordinate(name: str, dimensions: tuple[str, ...], value: Any, **attributes: str) -> Variable:
    values = np.asarray(value)
    return Variable(name=name, dimensions=dimensions, values=values, attributes=attributes, is_coordinate=True)
