"""Vibration modes of threads against closed forms, reference cases and a beam by collocation."""

from __future__ import annotations

from contextlib import nullcontext
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from beam_in_axial_flow import axial_flow_roots
from scipy.special import jn_zeros
from thread_cases import CASES, inputs, results
from thread_field_cases import held_at, model_of, start_by, start_of
from thread_mode_cases import COMM, in_axial_flow, straight_pair, straight_thread

from hydroelastic.fem.thread.eigenpairs import eigenpairs, roots_near_zero
from hydroelastic.fem.thread.equilibrium import Equilibrium, Start, solve_on_mesh
from hydroelastic.fem.thread.hyperbolicity import IllPosedError, require_real_wave_speeds
from hydroelastic.fem.thread.modes import Roots, ThreadModes, thread_modes
from hydroelastic.fem.thread.operators import thread_operators
from hydroelastic.modal.thread.catenary import catenary_between, elastic_catenary
from hydroelastic.physics.stream import UniformStream
from hydroelastic.physics.thread import PointLoad, Reactive, Thread


def pair_from(model: Thread, start: Start, elements: int, degree: int = 3) -> tuple[Equilibrium, Equilibrium]:
    """An equilibrium on a mesh and on one half as fine."""
    fine, coarse = (
        solve_on_mesh(COMM, model, np.linspace(0.0, model.length, count + 1), start, degree=degree)
        for count in (elements, elements // 2)
    )
    return fine, coarse


def assert_roots(roots: Roots, exact: Any, *, rtol: float) -> None:
    """Each as close as asked, and not farther than its estimate says."""
    differences = np.abs(roots.values - np.asarray(exact))
    assert np.all(differences <= rtol * np.abs(exact)), differences / np.abs(exact)
    assert np.all(differences <= roots.errors), (differences, roots.errors)


def taut_frequencies(count: int) -> Any:
    """M01: ω_n = (nπ/L) √(T/(m + ma))."""
    given = inputs("M01")
    speed = np.sqrt(given["T"] / (given["m"] + given["ma"]))
    return np.arange(1, count + 1) * np.pi / given["L"] * speed


def taut_string(**options: Any) -> Thread:
    """M01."""
    given = inputs("M01")
    return straight_thread(**({"length": given["L"], "mass": given["m"], "added_mass": given["ma"]} | options))


# Order 2p: (kh)^{2p} with kh = 0.39 of the fourth mode at 40 elements, and a factor below one.
@pytest.mark.parametrize(("degree", "rtol"), [(1, 5e-3), (2, 1e-5), (3, 1e-8), (5, 1e-12)])
def test_taut_string_and_honest_errors(degree: int, rtol: float) -> None:
    modes = thread_modes(*straight_pair(taut_string(), inputs("M01")["T"], 40, degree), 4)
    np.testing.assert_allclose(taut_frequencies(4), results("M01")["omega"][:4], rtol=1e-12)
    assert_roots(modes.oscillating, 1j * taut_frequencies(4), rtol=rtol)
    assert len(modes.aperiodic.values) == 0
    assert modes.is_stable
    # The estimate is the error of the coarser mesh, 4^p times larger, until rounding is seen.
    if degree < 5:
        ratios = modes.oscillating.errors / np.abs(modes.oscillating.values - 1j * taut_frequencies(4))
        assert np.all(ratios < 2.0 * 4.0**degree)


@pytest.mark.slow_but("2-*")
@pytest.mark.parametrize("bends", [False, True])
@pytest.mark.parametrize(("degree", "counts"), [(1, (16, 24, 36)), (2, (8, 12, 18)), (3, (6, 9, 12))])
def test_order_is_twice_the_degree(degree: int, counts: tuple[int, ...], bends: bool) -> None:
    k = 2.0 * np.pi
    rigidity = 0.3 if bends else 0.0
    model = straight_thread(mass=1.0, flexural_rigidity=rigidity)
    exact = k * np.sqrt(2.0 + rigidity * k**2)
    errors = []
    for count in counts:
        modes = thread_modes(*straight_pair(model, 2.0, count, degree), 2)
        errors.append(abs(modes.frequencies[1] - exact))
    order = -np.polyfit(np.log(counts), np.log(errors), 1)[0]
    assert order == pytest.approx(2 * degree, abs=0.25)


def test_direction_in_space_changes_nothing() -> None:
    # Both directions across the thread: each frequency twice.
    modes = thread_modes(*straight_pair(taut_string(direction=(0.48, 0.64, 0.6)), inputs("M01")["T"]), 4)
    assert_roots(modes.oscillating, 1j * np.repeat(taut_frequencies(2), 2), rtol=1e-9)
    assert np.all(np.isnan(modes.oscillating.out_of_plane))
    along = modes.oscillating.shapes @ np.array([0.48, 0.64, 0.6])
    assert np.abs(along).max() < 1e-10


@pytest.mark.parametrize("rigidity", [0.0, 40.0])
def test_shapes_have_the_mass_of_the_thread(rigidity: float) -> None:
    model = taut_string(flexural_rigidity=rigidity)
    modes = thread_modes(*straight_pair(model, 3.0), 2)
    for number, shape in enumerate(modes.oscillating.shapes, start=1):
        exact = np.sqrt(2.0) * np.sin(number * np.pi * modes.nodes / 10.0)
        across = shape[:, 1].real
        np.testing.assert_allclose(across * np.sign(across[5]), exact, atol=1e-6)
        np.testing.assert_allclose(shape[:, 0], 0.0, atol=1e-10)


def test_tensioned_pinned_beam() -> None:
    # M12 with other numbers: ω = k √((T + EI k²)/m).
    k = np.pi * np.arange(1, 5)
    model = straight_thread(mass=2.0, flexural_rigidity=0.7)
    equilibria = straight_pair(model, 5.0)
    assert thread_operators(equilibria[0]).symmetric
    modes = thread_modes(*equilibria, 4)
    assert_roots(modes.oscillating, 1j * k * np.sqrt((5.0 + 0.7 * k**2) / 2.0), rtol=2e-8)


@pytest.mark.mpi
def test_hanging_chain() -> None:
    # M02: ω_n = (j_{0,n}/2) √(w/((m + ma) L)); the tension vanishes at the free end.
    model = straight_thread((0.0, -1.0), length=2.0, held=(True, False), weight=9.81, mass=1.0, added_mass=0.3)
    modes = thread_modes(*straight_pair(model, lambda s: 9.81 * (2.0 - s)), 3)
    exact = jn_zeros(0, 3) / 2.0 * np.sqrt(9.81 / (1.3 * 2.0))
    assert_roots(modes.oscillating, 1j * exact, rtol=1e-7)


def test_hanging_chain_with_a_body() -> None:
    given = inputs("M03")
    body = PointLoad(force=np.array([0.0, -given["W_tip"]]), mass=given["M_tip"])
    model = straight_thread(
        (0.0, -1.0),
        length=given["L"],
        held=(True, False),
        load=body,
        weight=given["w"],
        mass=given["m"],
        added_mass=given["ma"],
    )
    tensions = lambda s: given["W_tip"] + given["w"] * (given["L"] - s)  # noqa: E731
    modes = thread_modes(*straight_pair(model, tensions), 4)
    assert_roots(modes.oscillating, 1j * np.array(results("M03")["omega"]), rtol=1e-8)


def test_linear_damping() -> None:
    # M04: λ² + (c/μ) λ + ω_n² = 0; c so large that the first motion does not oscillate.
    omega = np.pi * np.arange(1, 4) * np.sqrt(5.0 / 1.5)
    model = straight_thread(mass=1.0, added_mass=0.5, viscous_drag=20.0)
    modes = thread_modes(*straight_pair(model, 5.0), 2)
    rate = 10.0 / 1.5
    assert_roots(modes.oscillating, -rate + 1j * np.sqrt(omega[1:] ** 2 - rate**2), rtol=1e-8)
    slow = -rate + np.sqrt(rate**2 - omega[0] ** 2)
    assert_roots(modes.aperiodic, [slow, -2.0 * rate - slow], rtol=1e-8)


def test_quadratic_drag_in_a_liquid_at_rest() -> None:
    model = straight_thread(mass=1.5, added_mass=0.5, length=2.0, normal_drag=3.0)
    modes = thread_modes(*straight_pair(model, 10.0), 1, amplitude=0.1)
    # c = (8/3π) kn ω a |φ|, and ∫|sin|³/∫sin² = 8/3π.
    exact = 4.0 / (3.0 * np.pi) * 3.0 * modes.frequencies * 0.1 / 2.0 * 8.0 / (3.0 * np.pi)
    np.testing.assert_allclose(modes.quadratic_decay, exact, rtol=1e-9)
    assert len(modes.aperiodic.values) == 0


def sagging_cable(name: str, **options: Any) -> tuple[Thread, Start]:
    """M05, in three dimensions."""
    given = inputs(name)
    model = Thread(
        **(
            {
                "dimension": 3,
                "length": given["L"],
                "ends": (held_at(given["A"]), held_at(given["B"])),
                "weight": given["w"],
                "axial_rigidity": given["EA"],
                "mass": given["m"],
            }
            | options
        )
    )
    start = start_by(
        lambda s: elastic_catenary(given["A"], given["B"], given["L"], given["w"], given["EA"], s), dimension=3
    )
    return model, start


@pytest.fixture(scope="module")
def sagging() -> dict[str, ThreadModes]:
    return {name: thread_modes(*pair_from(*sagging_cable(name), 40), 8) for name in ("M05a", "M05c")}


def test_sagging_cable_in_its_plane(sagging: dict[str, ThreadModes]) -> None:
    beyond = {}
    for name, modes in sagging.items():
        out = modes.oscillating.out_of_plane
        # Each motion is either in the plane or across it.
        assert np.all((out < 1e-9) | (out > 1.0 - 1e-9))
        inside = modes.frequencies[out < 0.5]
        np.testing.assert_allclose(inside[:4], results(name)["omega"], rtol=1e-8)
        # Irvine and Caughey's approximation is off by the square of the sag.
        approximation = CASES[name]["checks"]["irvine_caughey_approximation"][0]
        beyond[name] = (inside[0] - approximation) / approximation
        across = modes.frequencies[out > 0.5]
        # H ω²-waves along the chord but for the square of the sag.
        np.testing.assert_allclose(across[:3], np.pi * np.arange(1, 4), rtol=3.0 * inputs(name)["sag_over_span"] ** 2)
    assert beyond["M05a"] == pytest.approx(3.7e-4, rel=0.01)
    assert beyond["M05a"] / beyond["M05c"] == pytest.approx((0.02 / 0.005) ** 2, rel=0.02)


def test_lighthill_reaction_keeps_energy() -> None:
    # With the liquid's kinetic energy ma |V_n|²/2 and no drag an inextensible thread has a Lagrangian: all motions
    # about a stable equilibrium have Re λ = 0, also on a curved thread in a stream that is not along it.
    ends = (held_at([0.0, 0.0, 0.0]), held_at([1.0, 0.0, 0.0]))
    model = Thread(
        dimension=3,
        length=1.1,
        ends=ends,
        weight=1.0,
        mass=1.0,
        added_mass=0.5,
        reactive="lighthill",
        stream=UniformStream((0.3, 0.1, 0.2)),
    )
    start = start_by(lambda s: catenary_between([0, 0, 0], [1, 0, 0], 1.1, [0, 0, -1.0], s), dimension=3)
    equilibria = pair_from(model, start, 20)
    modes = thread_modes(*equilibria, 6)
    # The reaction does change them: without its part in C, for instance.
    without = thread_modes(*equilibria, 6, velocity_damping=False)
    assert np.max(np.abs(modes.frequencies / without.frequencies - 1.0)) > 1e-3
    assert len(modes.aperiodic.values) == 0
    # The length is kept in the mean over elements only: measured 8e-9, of order 2p too.
    assert np.max(np.abs(modes.oscillating.values.real) / modes.frequencies) < 1e-7


def moored_in_a_stream(**options: Any) -> tuple[Thread, Start]:
    """M11, a buoy above a thread, in three dimensions."""
    given = inputs("M11")
    model = model_of("M11", 3, mass=given["m"], **options)
    end = replace(model.ends[1], load=replace(model.ends[1].load, mass=given["M_tip"]))
    return replace(model, ends=(model.ends[0], end)), start_of("M11", 3)


@pytest.fixture(scope="module")
def moored() -> tuple[Equilibrium, Equilibrium]:
    return pair_from(*moored_in_a_stream(), 20)


@pytest.mark.mpi
def test_roots_of_the_coarser_mesh_go_beyond_the_last_one(moored: tuple[Equilibrium, Equilibrium]) -> None:
    """There a real root may be beyond the last oscillating one, and must be found all the same."""
    operators = thread_operators(moored[1])
    asked = [pair.root for pair in eigenpairs(operators, 1)]
    roots = roots_near_zero(operators, 1)
    assert roots[: len(asked)].tolist() == pytest.approx(asked, rel=1e-9)
    assert len(roots) > len(asked)
    assert np.all(np.abs(roots[len(asked) :]) >= abs(asked[-1]))


def test_overdamped_motions_come_before_oscillating_ones(moored: tuple[Equilibrium, Equilibrium]) -> None:
    modes = thread_modes(*moored, 2)
    exact = [complex(*value) for value in results("M11")["lam"]]
    assert_roots(modes.oscillating, exact[7:], rtol=1e-5)
    assert_roots(Roots(**{name: value[:7] for name, value in vars(modes.aperiodic).items()}), exact[:7], rtol=1e-5)
    assert modes.is_stable


def test_stream_without_velocity_damping(moored: tuple[Equilibrium, Equilibrium]) -> None:
    modes = thread_modes(*moored, 6, velocity_damping=False)
    exact = CASES["M11"]["checks"]["omega_if_velocity_damping_is_dropped"]
    assert_roots(modes.oscillating, 1j * np.array(exact), rtol=1e-5)
    # The stream along x: motions in the plane, and across it.
    out = modes.oscillating.out_of_plane
    assert np.all((out < 1e-9) | (out > 1.0 - 1e-9))
    assert 1 <= np.count_nonzero(out > 0.5) <= 5


def test_body_on_a_thread_without_mass() -> None:
    # A pendulum in a stream along x: across its plane M λ² + k U λ + T/L = 0, in it with k U (1 + e_x²) for the
    # direction e of the motion, for the drag grows with the square of the speed along it.
    drag, speed, buoyancy, length = 3.0, 1.2, 5.0, 2.0
    pull = np.array([drag * speed**2, 0.0, buoyancy])
    tension = float(np.linalg.norm(pull))
    along = pull / tension
    model = straight_thread(
        tuple(along),
        length=length,
        held=(True, False),
        load=PointLoad(force=np.array([0.0, 0.0, buoyancy]), drag=drag, mass=5.0, added_mass=2.0),
        stream=UniformStream((speed, 0.0, 0.0)),
    )
    modes = thread_modes(*straight_pair(model, tension, 4), 2)
    exact = []
    for resistance in (drag * speed, drag * speed * (1.0 + along[2] ** 2)):
        rate = resistance / (2.0 * 7.0)
        exact.append(-rate + 1j * np.sqrt(tension / (7.0 * length) - rate**2))
    for root in exact:
        # Rounding alone: a thread without load remains straight.
        assert np.min(np.abs(modes.oscillating.values - root)) < 1e-9


def string_in_axial_flow(name: str, reactive: Reactive, **changes: float) -> tuple[Equilibrium, Equilibrium]:
    given = inputs(name) | changes
    stream = UniformStream((given["U"], 0.0, 0.0))
    options = {"length": given["L"], "mass": given["m"], "added_mass": given["M"]}
    return straight_pair(straight_thread(**options, reactive=reactive, stream=stream), given["T"], 20, 5)


@pytest.mark.parametrize("reactive", ["lighthill", "moving_load"])
def test_string_in_axial_flow(reactive: Reactive) -> None:
    exact = [complex(*value) for value in results("M07a")["lam"]]
    assert_roots(thread_modes(*string_in_axial_flow("M07a", reactive), 2).oscillating, exact, rtol=1e-10)


@pytest.mark.parametrize("reactive", ["lighthill", "moving_load"])
def test_string_that_the_stream_makes_ill_posed(reactive: Reactive) -> None:
    equilibria = string_in_axial_flow("M07c", reactive)
    with pytest.raises(IllPosedError, match="the faster the shorter"):
        thread_modes(*equilibria, 1)
    growing = thread_modes(*equilibria, 1, ill_posed_too=True).aperiodic
    exact = [value[0] for value in results("M07c")["lam"]]
    for value in exact:
        # Far from normal: what one mesh tells of them.
        assert np.min(np.abs(growing.values - value)) < 1e-6 * value


def test_short_waves_grow_from_the_speed_at_which_the_tension_no_longer_carries_both_masses() -> None:
    """m ma U²/(m + ma) = T, here of m = 1 and ma = 3; from ma U² = T up to it the string is gyroscopic."""
    for part in (0.999, 1.001):
        equilibrium, _ = string_in_axial_flow("M07a", "moving_load", M=3.0, U=part * np.sqrt(4.0 / 3.0))
        with nullcontext() if part < 1.0 else pytest.raises(IllPosedError, match="m ma W²"):
            require_real_wave_speeds(equilibrium)


@pytest.mark.parametrize(("speed", "share"), [(2.0, 0.3), (7.0, 0.5)])
def test_pinned_beam_in_axial_flow(speed: float, share: float) -> None:
    # The same problem as M08, which has other numbers.
    exact = axial_flow_roots(speed, share)[:3]
    modes = thread_modes(*straight_pair(in_axial_flow(speed, share), 0.0, 20, 4), 3)
    assert np.array_equal(np.sort(modes.oscillating.values.real > 1e-6), np.sort(exact.real > 1e-6))
    for root in exact:
        assert np.min(np.abs(modes.oscillating.values - root)) < 1e-7 * abs(root)


@pytest.mark.parametrize("reactive", ["lighthill", "moving_load"])
def test_tapered_cantilever_with_friction(reactive: Reactive) -> None:
    speed, share, friction, viscous, taper = 6.0, 0.5, 0.2, 0.3, 0.8
    pull = friction * speed**2 / share
    exact = axial_flow_roots(
        speed, share, cantilever=True, tension=lambda x: pull * (1.0 - x), viscous=viscous, taper=taper
    )[:3]
    model = in_axial_flow(
        speed,
        share,
        reactive,
        clamped=(True, False),
        held=(True, False),
        tangential_drag=friction,
        viscous_drag=viscous,
        taper=taper,
    )
    modes = thread_modes(*straight_pair(model, lambda s: pull * (1.0 - s), 20, 4), 3)
    # The trace of r_s at the free end makes the order p.
    assert_roots(modes.oscillating, exact, rtol=5e-6)
    assert not modes.is_stable


def test_what_no_mesh_resolves_is_refused() -> None:
    stream = UniformStream((1.0, 0.0, 0.0))
    tail = straight_thread(
        held=(True, False), mass=1.0, added_mass=1.0, tangential_drag=0.1, reactive="lighthill", stream=stream
    )
    with pytest.raises(IllPosedError, match=r"at its free end.*reactive"):
        thread_modes(*straight_pair(tail, lambda s: 0.1 * (1.0 - s), 8), 1)
    with pytest.raises(IllPosedError, match="compressed"):
        thread_modes(*straight_pair(straight_thread(mass=1.0), -1.0, 8), 1)


def test_straight_equilibrium_refuses_what_does_not_rest() -> None:
    with pytest.raises(ValueError, match="not balanced"):
        straight_pair(straight_thread(mass=1.0, weight=1.0), 1.0, 8)
    with pytest.raises(ValueError, match="axial_rigidity"):
        straight_pair(straight_thread(mass=1.0, axial_rigidity=10.0), 1.0, 8)
    with pytest.raises(ValueError, match="has a mass"):
        thread_modes(*straight_pair(straight_thread(), 1.0, 8), 1)


def test_amplitude_in_a_stream_is_refused(moored: tuple[Equilibrium, Equilibrium]) -> None:
    with pytest.raises(ValueError, match="amplitude"):
        thread_modes(*moored, 1, amplitude=0.1)
