"""The string in time on one mesh: orders in time and space, energy."""

from __future__ import annotations

import numpy as np
import pytest
from mpi4py import MPI
from numpy.polynomial import legendre
from string_closed_forms import FREQUENCIES, Motion, ramp, sine, smooth, step

from hydroelastic.fem.string.collocation import Collocation
from hydroelastic.fem.string.pencil import StringPencil, build_string_pencil, string_nodes
from hydroelastic.fem.string.probe import StringProbe
from hydroelastic.fem.string.time_integration import StepControl, integrate_motion
from hydroelastic.physics.string import HangingString

COMM = MPI.COMM_WORLD
MOTIONS = {"ramp": ramp(), "sine": sine(1.7), "smooth": smooth(2.0), "step": step()}


def plain(damping: float, degree: int, elements: int) -> StringPencil:
    string = HangingString(length=1.0, linear_density=1.0, gravity=1.0, resistance=(damping, damping))
    return build_string_pencil(COMM, string, degree, string_nodes(string, elements))


@pytest.mark.slow_but("ramp-8.0-2", "smooth-0.3-3", "step-0.0-4")
@pytest.mark.parametrize("stages", [2, 3, 4])
@pytest.mark.parametrize("damping", [0.0, 0.3, float(FREQUENCIES[0]), 8.0])
@pytest.mark.parametrize("name", list(MOTIONS))
def test_order_in_time(name: str, damping: float, stages: int) -> None:
    # On a given mesh even a step, which is but an initial state, keeps the order.
    pencil = plain(damping, 4, 6)
    probe = StringProbe(pencil, np.array([0.0, 0.1, 0.25, 0.5, 0.7, 0.9, 0.97]))
    # Early too: heavy resistance soon leaves nothing but rounding.
    times = np.array([0.25, 0.5, 2.0])
    exact = integrate_motion(pencil, probe, MOTIONS[name], times, StepControl(longest=1.0 / 240.0)).values
    counts = np.array([40, 56, 80] if stages == 4 else [80, 112, 160])
    errors = [
        np.abs(
            integrate_motion(
                pencil, probe, MOTIONS[name], times, StepControl(longest=1.0 / count), stages=stages
            ).values
            - exact
        ).max()
        for count in counts
    ]
    assert -np.polyfit(np.log(counts), np.log(errors), 1)[0] == pytest.approx(2 * stages, abs=0.25)


@pytest.mark.slow_but("ramp-1.5-1")
@pytest.mark.parametrize("degree", [1, 2, 4])
@pytest.mark.parametrize(("name", "regularity"), [("smooth", 2.5), ("ramp", 1.5), ("step", 0.5)])
def test_order_in_space_is_that_of_the_front(name: str, regularity: float, degree: int) -> None:
    # The jump of U_tt, U_t or U has a spectrum k^{−s−½}; waves of k arrive with a phase error (kh)^{2n} k t, so that
    # all beyond k ~ h^{−2n/(2n+1)} are lost: ‖e‖ ~ k^{−s}. Brenner, Thomée, Wahlbin, LNM 434 (1975), for differences.
    motion, times = MOTIONS[name], np.array([0.8])
    points, weights = legendre.leggauss(1200)
    root = 0.5 * (points + 1.0)
    positions, weights = root**2, weights * root
    exact = motion.answer(0.3, positions, times)
    counts = np.array([128, 192, 288, 432, 648]) // degree
    errors = []
    for count in counts:
        pencil = plain(0.3, degree, int(count))
        values = integrate_motion(
            pencil, StringProbe(pencil, positions), motion, times, StepControl(longest=0.7 / count / degree)
        ).values
        errors.append(np.sqrt(weights @ (values - exact)[:, 0] ** 2))
    order = -np.polyfit(np.log(counts), np.log(errors), 1)[0]
    assert order == pytest.approx(regularity * 2 * degree / (2 * degree + 1), abs=0.1)


@pytest.mark.mpi
def test_energy_is_kept_after_a_step() -> None:
    pencil = plain(0.0, 6, 12)
    probe = StringProbe(pencil, np.array([0.0]))
    # ½∫T w_x² of the state after the step is large but finite on a mesh. Measured 1e-11 after 2000 steps: rounding.
    energies = integrate_motion(pencil, probe, step(), np.linspace(0.0, 100.0, 9), StepControl(longest=0.05)).energies
    np.testing.assert_allclose(energies, energies[0], rtol=5e-11)


def test_energy_lost_is_what_the_resistance_takes() -> None:
    string = HangingString(length=1.0, linear_density=1.0, gravity=1.0, resistance=(0.2, 0.7), tip_mass=0.3)
    pencil = build_string_pencil(COMM, string, 6, string_nodes(string, 6))
    stepper = Collocation(pencil.mass, pencil.resistance, pencil.stiffness, 4)
    size = len(pencil.free)
    w, v = np.zeros(size), np.ones(size)
    before = stepper.energy(w, v)
    nodes, weights = legendre.leggauss(6)
    source, image = pencil.mass.createVecs()
    taken = 0.0
    for _ in range(150):
        last = -1.0
        for node, weight in zip([*nodes, 1.0], [*weights, 0.0], strict=True):
            w, v = stepper.advance(w, v, 0.01 * (node - last), None)
            last = node
            source.array[:] = v
            pencil.resistance.mult(source, image)
            # ∫2λ w_t², for C = ∫2λ u v.
            taken += 0.01 * weight * source.dot(image)
    after = stepper.energy(w, v)
    assert after < 0.5 * before
    assert before - after == pytest.approx(taken, rel=1e-9)


@pytest.mark.mpi
def test_probe_finds_polynomials_at_nodes_and_between() -> None:
    pencil = plain(0.0, 5, 7)
    field = pencil.zeros()
    places = pencil.space.tabulate_dof_coordinates()[pencil.free, 0]
    field.array[:] = (1.0 - places) * places**4
    positions = np.concatenate([[1.0, 0.0, 0.3], string_nodes(pencil.string, 7), [0.77]])
    np.testing.assert_allclose(
        StringProbe(pencil, positions).values(field), (1.0 - positions) * positions**4, atol=1e-14
    )


def test_motions_that_jump_again() -> None:
    # Two steps are the sum of two motions, one later.
    first = step()
    twice = Motion(
        lambda t: 1.0 + np.where(np.asarray(t) > 0.5, 0.5, 0.0), first.slope, first.curvature, first.answer, (0.0, 0.5)
    )
    pencil = plain(0.2, 6, 10)
    probe = StringProbe(pencil, np.array([0.0, 0.4, 0.8]))
    control = StepControl(longest=0.01)
    both = integrate_motion(pencil, probe, twice, np.array([1.5, 2.0]), control).values
    one = integrate_motion(pencil, probe, first, np.array([1.0, 1.5, 2.0]), control).values
    np.testing.assert_allclose(both, one[:, 1:] + 0.5 * one[:, :2], atol=1e-8)
