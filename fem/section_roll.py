"""Natural frequency, added inertia and wave damping of the roll of a section, from its field solution.

In open water, with motions ∝ e^{−iωt}, the other free motions of the section follow without force:

    Z(ω) = Z_rr − Z_ro Z_oo⁻¹ Z_or,   Z = K − ω²(M + a) − iωb,

and the equation of roll is that of a single oscillator at its natural frequency k, where Re Z(k) = 0:

    I + a = C/k²,   b = −Im Z(k)/k,   n = b/2(I + a),

with C the stiffness of roll where other motions follow at rest. The search for k begins at the complex frequency of the
roll. In a closed tank k is the frequency of the mode of roll, and no waves leave.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from mpi4py import MPI
from scipy.optimize import root_scalar

from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.open_water.radiation import RadiationSolution, solve_radiation
from hydroelastic.fem.open_water.requests import RadiationRequest, ResonanceRequest
from hydroelastic.fem.open_water.resonance import solve_resonance
from hydroelastic.fem.open_water.results import RadiationTable
from hydroelastic.fem.progress import Report
from hydroelastic.fem.solver_error import EigenSolverError
from hydroelastic.fem.tank.solve import TankSolution, solve_tank
from hydroelastic.meshes.tagged_mesh import TaggedMesh
from hydroelastic.physics.dofs import MOTIONS
from hydroelastic.physics.tank import Tank

# Of the tolerance asked: a step of the root finder that changes k by less is the last.
_STEP = 0.1
_FIRST_STEP = 1e-3


@dataclass(frozen=True, kw_only=True)
class SectionRoll:
    """The roll of a section, per metre of its length.

    Attributes:
        title: of the section.
        natural_frequency: k, rad/s.
        relative_error: estimated, of k and of the added inertia and damping as parts of the whole inertia.
        damping: n, 1/s; ``None`` in a closed tank.
        stiffness: C, N.
        inertia: I of the body, kg·m.
        added_inertia: a at k, kg·m.
        wave_damping: b at k, kg·m/s; ``None`` in a closed tank.
        followers: motions coupled to the roll without force.
    """

    title: str
    natural_frequency: float
    relative_error: float
    damping: float | None
    stiffness: float
    inertia: float
    added_inertia: float
    wave_damping: float | None
    followers: tuple[str, ...]


class SectionRollError(RuntimeError):
    """The roll of a section was not found, or not to its tolerance."""


def section_roll(
    tank: Tank,
    *,
    tolerance: float,
    modes: int,
    comm: MPI.Comm,
    title: str = "",
    mesh: TaggedMesh | None = None,
    report: Report = lambda _message: None,
) -> SectionRoll:
    """Solve for the roll of a section (collective)."""
    if tank.is_open:
        problem = OpenWaterProblem(comm=comm, tank=tank, tolerance=tolerance)
        return _in_open_water(problem, title)
    return _in_a_tank(solve_tank(tank, tolerance=tolerance, modes=modes, comm=comm, mesh=mesh, report=report), title)


def _in_a_tank(solution: TankSolution, title: str) -> SectionRoll:
    if solution.reasons:
        raise SectionRollError(f"the section was not solved to its tolerance: {'; '.join(solution.reasons)}")
    mode = next((mode for mode in solution.float_modes if mode.motion == "roll"), None)
    if mode is None or mode.index is None:
        raise SectionRollError(f"the section has no mode of roll{'' if mode is None else ': ' + mode.reason}")
    body = solution.physical.floats[mode.body]
    eigenvalue = float(solution.modes.eigenvalues[mode.index])
    natural, inertia = solution.omega(eigenvalue), float(body.inertia[MOTIONS.index("roll")])
    # Per unit of length a moment of inertia is a density times the fourth power of a length.
    added = (mode.stiffness / eigenvalue - mode.inertia) * solution.units.density * solution.units.length**4
    return SectionRoll(
        title=title,
        natural_frequency=natural,
        relative_error=float(solution.relative_errors[mode.index]),
        damping=None,
        stiffness=natural**2 * (inertia + added),
        inertia=inertia,
        added_inertia=added,
        wave_damping=None,
        followers=tuple(motion for motion in body.motions if motion != "roll"),
    )


def _in_open_water(problem: OpenWaterProblem, title: str) -> SectionRoll:
    body = problem.tank.floats[0]
    stiffness, inertia = body.roll_stiffness, float(body.inertia[MOTIONS.index("roll")])

    def radiation(omega: float) -> RadiationSolution:
        return solve_radiation(problem, RadiationRequest(omega=(omega,)))

    resonance = _resonance(problem)
    # k differs from the modulus of the complex frequency by the change of added inertia and damping between the two.
    found = root_scalar(
        lambda omega: float(_impedance(radiation(float(omega)).table).real),
        method="secant",
        x0=abs(resonance),
        x1=abs(resonance) * (1.0 + _FIRST_STEP),
        rtol=_STEP * problem.tolerance,
    )
    if not found.converged:
        raise SectionRollError(f"no natural frequency of the section's roll was found near {abs(resonance):.4g} rad/s")
    natural = float(found.root)
    solution = radiation(natural)
    table, error = solution.table, solution.error
    if error > problem.tolerance:
        raise SectionRollError(
            f"the section was not solved to its tolerance: its estimated relative error is {error:.1e}"
        )
    whole = stiffness / natural**2
    wave_damping = -float(_impedance(table).imag) / natural
    return SectionRoll(
        title=title,
        natural_frequency=natural,
        relative_error=error,
        damping=0.5 * wave_damping / whole,
        stiffness=stiffness,
        inertia=inertia,
        added_inertia=whole - inertia,
        wave_damping=wave_damping,
        followers=tuple(dof for dof in table.dofs if dof != "roll"),
    )


def _resonance(problem: OpenWaterProblem) -> complex:
    asked = ResonanceRequest(count=len(problem.tank.bodies[0].rigid_motions))
    try:
        table = solve_resonance(problem, asked).table
    except EigenSolverError as error:
        raise SectionRollError(f"no resonance of the section was found: {error}") from error
    if "roll" not in table.labels:
        raise SectionRollError("the section has no resonance in which it rolls: its roll may be damped too much")
    return complex(table.omega[table.labels.index("roll")])


def _impedance(table: RadiationTable) -> complex:
    """Z of roll at the first frequency, N, other motions following without force."""
    omega = table.omega[0]
    whole = table.stiffness - omega**2 * (table.inertia + table.added_mass[0]) - 1j * omega * table.radiation_damping[0]
    roll = table.dofs.index("roll")
    others = [place for place in range(len(table.dofs)) if place != roll]
    follow = np.linalg.solve(whole[np.ix_(others, others)], whole[others, roll])
    return complex(whole[roll, roll] - whole[roll, others] @ follow)
