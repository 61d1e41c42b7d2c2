"""A working folder of Nemoh 2: ``Nemoh.cal``, hydrostatics under ``mesh``, tables of Tecplot under ``results``.

Tables are in SI units with Nemoh's time factor e^{−iωt}; a row is ω and, for each force, two numbers: added mass and
damping, or magnitude and phase in rad. Frequencies and directions are equally spaced, since readers take them from
``Nemoh.cal``. Sources: Nemoh, Solver/MResults.f90 and postProcessor/Main.f90; WEC-Sim, readNEMOH.m.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from hydroelastic.output.hydrodynamic_files.whole_bodies import MOTIONS, WholeBodies, WholeBody

_RULE = "-" * 40


def write_nemoh(bodies: WholeBodies, folder: Path) -> None:
    """Write the folder; the frequencies are equally spaced."""
    for name in ("mesh", "results"):
        (folder / name).mkdir(parents=True)
    several = len(bodies.bodies) > 1
    _write(folder / "Nemoh.cal", _settings(bodies))
    for index, body in enumerate(bodies.bodies):
        ending = f"_{index}" if several else ""
        own = bodies.spans[index]
        _write(folder / "mesh" / f"Hydrostatics{ending}.dat", _hydrostatics(body))
        _write(folder / "mesh" / f"KH{ending}.dat", (_row(row) for row in bodies.stiffness[own, own]))
    _write(folder / "results" / "RadiationCoefficients.tec", _radiation(bodies))
    for name, title, force in (
        ("ExcitationForce", "Excitation force - beta", bodies.excitation_force),
        ("DiffractionForce", "Diffraction force - beta", bodies.diffraction_force),
        ("FKForce", "FKforce - beta", bodies.froude_krylov_force),
    ):
        _write(folder / "results" / f"{name}.tec", _force(bodies, title, force))


def _settings(bodies: WholeBodies) -> Iterator[str]:
    yield f"--- Environment {_RULE}"
    yield f"{bodies.density!r}\t! RHO\t! KG/M**3\t! Fluid specific volume"
    yield f"{bodies.gravity!r}\t! G\t! M/S**2\t! Gravity"
    yield f"{0.0 if np.isinf(bodies.depth) else bodies.depth!r}\t! DEPTH\t! M\t! Water depth"
    yield "0. 0.\t! XEFF YEFF\t! M\t! Wave measurement point"
    yield f"--- Description of floating bodies {_RULE}"
    yield f"{len(bodies.bodies)}\t! Number of bodies"
    for number, body in enumerate(bodies.bodies, 1):
        yield f"--- Body {number} {_RULE}"
        # No mesh belongs to it, and no solver of Nemoh is to run.
        yield f"mesh\\{body.name}.dat\t! Name of mesh file"
        yield "0 0\t! Number of points and number of panels"
        for what in ("degrees of freedom", "resulting generalised forces"):
            yield f"{len(body.motions)}\t! Number of {what}"
            for place, motion in enumerate(MOTIONS):
                axis = " ".join("1." if place % 3 == along else "0." for along in range(3))
                about = body.centre_of_gravity if place > 2 else (0.0, 0.0, 0.0)
                yield f"{1 + place // 3} {axis} {' '.join(map(repr, about))}\t! {motion}"
            # What is neither a translation nor a rotation.
            yield from (f"3 0. 0. 0. 0. 0. 0.\t! {motion}" for motion in body.modes)
        yield "0\t! Number of lines of additional information"
    yield f"--- Load cases to be solved {_RULE}"
    omega, directions = bodies.omega, bodies.directions
    yield f"{len(omega)} {float(omega[0])!r} {float(omega[-1])!r}\t! Number of wave frequencies, Min, and Max (rad/s)"
    yield (
        f"{len(directions)} {float(directions[0])!r} {float(directions[-1])!r}"
        "\t! Number of wave directions, Min and Max (degrees)"
    )
    yield f"--- Post processing {_RULE}"
    yield "0 0.1 10.\t! IRF\t! IRF calculation (0 for no calculation), time step and duration"
    yield "0\t! Show pressure"
    yield "0 0. 180.\t! Kochin function\t! Number of directions of calculation (0 for no calculations), Min and Max"
    yield "0 50 400. 400.\t! Free surface elevation\t! Number of points in x direction (0 for no calculations)"
    yield "---"


def _hydrostatics(body: WholeBody) -> Iterator[str]:
    for axis, buoyancy, gravity in zip("XYZ", body.centre_of_buoyancy, body.centre_of_gravity, strict=True):
        yield f" {axis}F = {buoyancy + 0.0:.9E} - {axis}G = {gravity + 0.0:.9E}"
    yield f" Displacement = {body.volume:.9E}"
    yield f" Waterplane area = {body.waterplane_area:.9E}"


def _radiation(bodies: WholeBodies) -> Iterator[str]:
    yield 'VARIABLES="w (rad/s)"'
    for body, motion in _motions(bodies):
        yield f'"A{body:4d}{motion:4d}" "B{body:4d}{motion:4d}"'
    for place, (body, motion) in enumerate(_motions(bodies)):
        yield f'Zone t="Motion of body {body:4d} in DoF{motion:4d}",I={len(bodies.omega):6d},F=POINT'
        for row, omega in enumerate(bodies.omega):
            masses, dampings = bodies.added_mass[row, :, place], bodies.radiation_damping[row, :, place]
            yield _row([omega, *np.column_stack([masses, dampings]).ravel()])


def _force(bodies: WholeBodies, title: str, force: np.ndarray) -> Iterator[str]:
    yield 'VARIABLES="w (rad/s)"'
    for body, motion in _motions(bodies):
        yield f'"abs(F{body:4d}{motion:4d})" "angle(F{body:4d}{motion:4d})"'
    for place, direction in enumerate(bodies.directions):
        yield f'Zone t="{title} = {direction:7.3f} deg",I={len(bodies.omega):6d},F=POINT'
        for omega, values in zip(bodies.omega, force[:, place], strict=True):
            yield _row([omega, *np.column_stack([np.abs(values), np.angle(values)]).ravel()])


def _motions(bodies: WholeBodies) -> list[tuple[int, int]]:
    """Numbers of body and motion, from 1."""
    return [
        (number, motion) for number, body in enumerate(bodies.bodies, 1) for motion in range(1, len(body.motions) + 1)
    ]


def _row(values: np.ndarray | list[float]) -> str:
    return "".join(f" {value + 0.0:.9E}" for value in values)


def _write(path: Path, lines: Iterator[str]) -> None:
    path.write_text("".join(f"{line}\n" for line in lines), encoding="ascii")
