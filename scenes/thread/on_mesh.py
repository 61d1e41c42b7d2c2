"""The equilibrium of a scene on a mesh, also of a straight thread whose tension is given."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from mpi4py import MPI
from numpy.typing import NDArray
from scipy.integrate import quad

from hydroelastic.fem.thread.equilibrium import Equilibrium, Start, solve_on_mesh
from hydroelastic.fem.thread.profile import thread_profile
from hydroelastic.fem.thread.refinement import ROUNDING, ThreadErrors, ThreadSolution
from hydroelastic.fem.thread.straight import straight_equilibrium
from hydroelastic.scenes.errors import UnsolvedError
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.models.thread_parts import FixedEnd
from hydroelastic.scenes.thread.frame import Frame
from hydroelastic.scenes.thread.model import load_of, model_of
from hydroelastic.scenes.thread.quiet import libraries_silent

Array = NDArray[np.float64]

# Of a straight thread, which any mesh holds exactly: enough for its first modes.
_STRAIGHT_ELEMENTS, _STRAIGHT_DEGREE = 32, 5


def equilibrium_on(
    comm: MPI.Comm, scene: ThreadScene, frame: Frame, nodes: Array, start: Start | None, degree: int
) -> Equilibrium:
    """The equilibrium of a scene on one mesh, near one that is known.

    Args:
        comm: the processes.
        scene: the scene.
        frame: coordinates of the model.
        nodes: of the mesh, m along the thread.
        start: the equilibrium that is known; not needed where the tension is given.
        degree: of the positions.

    Raises:
        ThreadSolverError: where Newton's method fails (collective).
        UnsolvedError: where a thread of given tension is not at rest.
    """
    model = model_of(scene, frame)
    if scene.thread.tension is None:
        assert start is not None
        return solve_on_mesh(comm, model, nodes, start, degree=degree)
    try:
        return straight_equilibrium(comm, model, nodes, given_tension(scene), degree=degree)
    except ValueError as error:
        raise UnsolvedError(str(error)) from error


def given_tension(scene: ThreadScene) -> Callable[[Array], Array]:
    """T(s) of a straight thread: what is given at B, and what weight and friction add up to from there."""
    a, b = scene.ends.a, scene.ends.b
    assert isinstance(a, FixedEnd)
    assert isinstance(b, FixedEnd)
    assert scene.thread.tension is not None
    begin, length, tension = np.array(a.position), scene.thread.length, scene.thread.tension
    way = (np.array(b.position) - begin) / length
    load = load_of(scene)

    def along(s: float) -> float:
        return float(load.load((begin + s * way)[None], way[None])[0] @ way)

    def at(s: Array) -> Array:
        with libraries_silent():
            return np.array([tension + quad(along, place, length)[0] for place in np.ravel(s)]).reshape(np.shape(s))

    return at


def solve_with_given_tension(comm: MPI.Comm, scene: ThreadScene, frame: Frame) -> ThreadSolution:
    """The straight equilibrium of a thread whose tension is given.

    Args:
        comm: the processes.
        scene: the scene, with `thread.tension`.
        frame: coordinates of the model.

    Returns:
        The equilibrium, of which any mesh holds all but rounding (collective).

    Raises:
        UnsolvedError: where weight or drag bend the thread.
    """
    nodes: Array = np.linspace(0.0, scene.thread.length, _STRAIGHT_ELEMENTS + 1, dtype=np.float64)
    found = equilibrium_on(comm, scene, frame, nodes, None, _STRAIGHT_DEGREE)
    profile = thread_profile(found)
    force, moment = ROUNDING * found.units.force, ROUNDING * scene.thread.flexural_rigidity / scene.thread.length
    errors = ThreadErrors(
        position=ROUNDING * scene.thread.length, tension=force, reaction=force, moment=moment, relative=ROUNDING
    )
    return ThreadSolution(
        equilibrium=found,
        profile=profile,
        errors=errors,
        elements=(_STRAIGHT_ELEMENTS,),
        newton_steps=(0,),
        ramps=(),
    )
