"""Free motions of threads, divergence and flutter: closed forms, reference cases, a beam by Chebyshev collocation."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from beam_in_axial_flow import axial_flow_roots
from scipy.special import jn_zeros
from thread_cases import CASES, inputs, results
from thread_scenes import case, fixed, free, roots, scene

import hydroelastic as he

# A diameter of 1 kg/m of water, so that the coefficient of added mass is the added mass by length.
DIAMETER = (4e-3 / np.pi) ** 0.5
WATER = {"density": 1000.0}


def modes(count: int, **more: Any) -> dict[str, Any]:
    return {"kind": "modes", "count": count, **more}


def taut(length: float = 1.0, direction: Any = (1.0, 0.0, 0.0), **thread: Any) -> dict[str, Any]:
    """A straight thread of a given tension between fixed ends."""
    parts = {name: thread.pop(name) for name in ("velocity", "analysis", "clamp") if name in thread}
    stream = WATER | ({"velocity": [parts["velocity"], 0.0]} if "velocity" in parts else {})
    clamps = {"clamp": list(direction)} if parts.get("clamp") else {}
    end, start = fixed(*(length * np.array(direction)), **clamps), fixed(**clamps)
    given = {"length": length, "diameter": DIAMETER, **thread}
    return scene(given, end, *parts["analysis"], a=start, stream=stream)


def assert_roots(result: he.Result, exact: Any, *, kind: str = "oscillating", analysis: int = 0) -> None:
    """Each no farther than its estimate says, which is at most the tolerance of 1e-6."""
    found = roots(result, kind, analysis)
    stated = np.array([mode["relative_error"] for mode in result.summary["modes"][analysis][kind]])
    exact = np.asarray(exact)
    assert len(found) == len(exact)
    assert np.all(stated <= 1e-6)
    # The reference cases have ten digits or more; rounding of straight threads is 1e-12.
    assert np.all(np.abs(found - exact) <= (stated + 1e-9) * np.abs(exact)), (found, exact)


def test_a_taut_string_in_any_direction() -> None:
    """M01: ω_n = (nπ/L) √(T/(m + ma)), each in both directions across; shapes of the mass of the thread."""
    given = inputs("M01")
    exact = np.repeat(results("M01")["omega"][:3], 2)
    direction = np.array([0.48, 0.64, 0.6])
    masses = {"mass": given["m"], "added_mass": given["ma"], "tension": given["T"]}
    result = he.solve(taut(given["L"], direction, **masses, analysis=[modes(6)]))
    assert_roots(result, 1j * exact)
    (found,) = result.summary["modes"]
    assert found["stable"] is True
    assert found["aperiodic"] == []
    assert all(mode["out_of_plane"] is None for mode in found["oscillating"])
    shapes = result.dataset.mode_shape.sel(complex="re").transpose("mode", "mode_s", "axis").values
    # Along the thread nothing moves.
    assert np.abs(shapes @ direction).max() < 1e-9
    for number, shape in enumerate(shapes):
        across = np.sqrt(2.0) * np.sin((number // 2 + 1) * np.pi * result.dataset.mode_s.values / given["L"])
        assert np.linalg.norm(shape, axis=1) == pytest.approx(np.abs(across), abs=1e-6)


@pytest.mark.mpi
def test_hanging_chains() -> None:
    """M02, whose tension vanishes at the free end: ω_n = (j_{0,n}/2) √(w/((m + ma) L)); M03 with a body there."""
    thread = {"length": 2.0, "weight": 9.81, "mass": 1.0, "added_mass": 0.3, "diameter": DIAMETER}
    exact = jn_zeros(0, 3) / 2.0 * np.sqrt(9.81 / (1.3 * 2.0))
    assert_roots(he.solve(scene(thread, free(), modes(6), stream=WATER)), 1j * np.repeat(exact, 2))
    given = inputs("M03")
    thread |= {"length": given["L"], "weight": given["w"], "mass": given["m"], "added_mass": given["ma"]}
    body = free(weight=given["W_tip"], mass=given["M_tip"])
    assert_roots(he.solve(scene(thread, body, modes(6), stream=WATER)), 1j * np.repeat(results("M03")["omega"][:3], 2))


def test_linear_damping() -> None:
    """M04: λ² + (c/μ) λ + ω_n² = 0; c so large that the first motion does not oscillate."""
    omega, rate = np.pi * np.arange(1, 4) * np.sqrt(5.0 / 1.5), 10.0 / 1.5
    result = he.solve(taut(mass=1.0, added_mass=0.5, viscous_drag=20.0, tension=5.0, analysis=[modes(4)]))
    assert_roots(result, np.repeat(-rate + 1j * np.sqrt(omega[1:] ** 2 - rate**2), 2))
    slow = -rate + np.sqrt(rate**2 - omega[0] ** 2)
    assert_roots(result, np.repeat([slow, -2.0 * rate - slow], 2), kind="aperiodic")


def test_sagging_cables_in_their_plane_and_across() -> None:
    """M05: Irvine and Caughey's approximation is off by the square of the sag."""
    beyond = {}
    for name in ("M05a", "M05c"):
        given = inputs(name)
        thread = {"length": given["L"], "weight": given["w"], "axial_rigidity": given["EA"], "mass": given["m"]}
        result = he.solve(scene(thread, fixed(*given["B"]), modes(8)))
        out = np.array([mode["out_of_plane"] for mode in result.summary["modes"][0]["oscillating"]])
        assert np.all((out < 1e-9) | (out > 1.0 - 1e-9))
        omega = roots(result).imag
        # To the tolerance of 1e-6; the length is given in thirteen digits.
        assert omega[out < 0.5][:4] == pytest.approx(results(name)["omega"], rel=1e-6)
        approximation = CASES[name]["checks"]["irvine_caughey_approximation"][0]
        beyond[name] = omega[out < 0.5][0] / approximation - 1.0
        # Waves along the chord but for the square of the sag.
        across = np.pi * np.arange(1, 4)
        assert omega[out > 0.5][:3] == pytest.approx(across, rel=3.0 * given["sag_over_span"] ** 2)
    assert beyond["M05a"] == pytest.approx(3.7e-4, rel=0.02)
    assert beyond["M05a"] / beyond["M05c"] == pytest.approx((0.02 / 0.005) ** 2, rel=0.05)


def test_lighthills_reaction_keeps_energy() -> None:
    """With the liquid's energy ma |V_n|²/2 and no drag an inextensible thread has a Lagrangian: Re λ = 0, on a curved
    thread in a stream that is not along it, too; but the reaction changes the motions."""
    thread = {"length": 1.1, "weight": 1.0, "mass": 1.0, "added_mass": 0.5, "diameter": DIAMETER}
    document = scene(
        thread | {"reactive": "lighthill"},
        fixed(1.0, 0.0, 0.0),
        modes(6),
        modes(6, velocity_damping=False),
        stream=WATER | {"velocity": [0.3, 0.1]},
    )
    result = he.solve(document)
    with_reaction, without = roots(result), roots(result, analysis=1)
    assert np.max(np.abs(with_reaction.imag / without.imag - 1.0)) > 1e-3
    assert result.summary["modes"][0]["aperiodic"] == []
    # The length is kept in the mean over elements only, to the tolerance.
    assert np.max(np.abs(with_reaction.real) / with_reaction.imag) < 1e-6


@pytest.fixture(scope="module")
def moored() -> he.Result:
    return he.solve(case("M11", modes(2), modes(6, velocity_damping=False), tolerance=1e-6))


def test_overdamped_motions_come_before_oscillating_ones(moored: he.Result) -> None:
    """M11, a buoy above a thread in a stream: the second mode is one of nine roots."""
    exact = np.array([complex(*value) for value in results("M11")["lam"]])
    assert_roots(moored, exact[7:])
    found = roots(moored, "aperiodic")
    stated = np.array([mode["relative_error"] for mode in moored.summary["modes"][0]["aperiodic"]])
    assert np.all(np.abs(found[:7] - exact[:7]) <= (stated[:7] + 1e-9) * np.abs(exact[:7]))
    assert moored.summary["modes"][0]["stable"] is True


def test_a_stream_without_velocity_damping(moored: he.Result) -> None:
    exact = CASES["M11"]["checks"]["omega_if_velocity_damping_is_dropped"]
    assert_roots(moored, 1j * np.array(exact), analysis=1)
    out = np.array([mode["out_of_plane"] for mode in moored.summary["modes"][1]["oscillating"]])
    assert np.all((out < 1e-9) | (out > 1.0 - 1e-9))
    assert 1 <= np.count_nonzero(out > 0.5) <= 5


def test_a_body_on_a_thread_of_hardly_any_mass() -> None:
    """A pendulum in a stream along x: across its plane M λ² + k U λ + T/L = 0, in it with k U (1 + e_x²) for the
    direction e of the motion, for the drag grows with the square of the speed along it."""
    drag, speed, buoyancy, length = 3.0, 1.2, 5.0, 2.0
    pull = np.array([drag * speed**2, 0.0, buoyancy])
    tension = float(np.linalg.norm(pull))
    body = free(weight=-buoyancy, drag_area=2.0 * drag / 1000.0, mass=5.0, added_mass=2.0)
    thread = {"length": length, "mass": 1e-9, "diameter": DIAMETER}
    result = he.solve(scene(thread, body, modes(2), stream=WATER | {"velocity": [speed, 0.0]}))
    for resistance in (drag * speed, drag * speed * (1.0 + (buoyancy / tension) ** 2)):
        rate = resistance / (2.0 * 7.0)
        exact = -rate + 1j * np.sqrt(tension / (7.0 * length) - rate**2)
        assert np.min(np.abs(roots(result) - exact)) < 1e-7


@pytest.mark.parametrize("reactive", ["lighthill", "moving_load"])
def test_a_string_in_a_stream_along_it(reactive: str) -> None:
    given = inputs("M07a")
    thread = {"mass": given["m"], "added_mass": given["M"], "tension": given["T"], "reactive": reactive}
    exact = [complex(*value) for value in results("M07a")["lam"]]
    result = he.solve(taut(given["L"], velocity=given["U"], **thread, analysis=[modes(4)]))
    assert_roots(result, np.repeat(exact, 2))


def test_short_waves_grow_from_the_speed_at_which_the_tension_no_longer_carries_both_masses() -> None:
    """m ma U²/(m + ma) = T, here of m = 1 and ma = 3; from ma U² = T up to it the string is gyroscopic."""
    thread = {"mass": 1.0, "added_mass": 3.0, "tension": 1.0, "reactive": "moving_load", "analysis": [modes(1)]}
    assert he.solve(taut(velocity=0.9 * np.sqrt(4.0 / 3.0), **thread)).summary["modes"]
    with pytest.raises(he.UnsolvedError, match="the faster the shorter"):
        he.solve(taut(velocity=1.001 * np.sqrt(4.0 / 3.0), **thread))


def in_axial_flow(speed: float, share: float, *analysis: Any, velocity: float = 1.0, **thread: Any) -> dict[str, Any]:
    """A beam of EI = L = m + M = 1, U √(M/EI) = `speed` and M/(m + M) = `share`."""
    masses = {"mass": 1.0 - share, "added_mass": share, "flexural_rigidity": 1.0, "tension": 0.0}
    options = {"reactive": "lighthill", **masses, **thread}
    return taut(velocity=speed / np.sqrt(share), analysis=list(analysis), **options)


@pytest.mark.parametrize(("speed", "share"), [(2.0, 0.3), (7.0, 0.5)])
def test_a_pinned_beam_in_a_stream_along_it(speed: float, share: float) -> None:
    exact = axial_flow_roots(speed, share)[:3]
    result = he.solve(in_axial_flow(speed, share, modes(6)))
    found = np.concatenate([roots(result), roots(result, "aperiodic")])
    for root in exact:
        assert np.min(np.abs(found - root)) < 1e-6 * abs(root)
    assert result.summary["modes"][0]["stable"] is bool(np.all(exact.real < 1e-6))


@pytest.mark.parametrize("reactive", ["lighthill", "moving_load"])
def test_a_tapered_cantilever_with_friction(reactive: str) -> None:
    speed, share, friction, viscous, taper = 6.0, 0.5, 0.2, 0.3, 0.8
    pull = friction * speed**2 / share
    options = {"cantilever": True, "viscous": viscous, "taper": taper}
    exact = axial_flow_roots(speed, share, tension=lambda x: pull * (1.0 - x), **options)[:3]  # type: ignore[arg-type]
    thread = {"length": 1.0, "diameter": DIAMETER, "mass": 1.0 - share, "added_mass": share, "flexural_rigidity": 1.0}
    thread |= {"reactive": reactive, "viscous_drag": viscous, "tangential_drag": friction / (500.0 * np.pi * DIAMETER)}
    stream = WATER | {"velocity": [speed / np.sqrt(share), 0.0]}
    start = fixed(clamp=[1.0, 0.0, 0.0])
    result = he.solve(scene(thread, free(taper=taper), modes(6), a=start, stream=stream, accuracy={"tolerance": 1e-5}))
    found = roots(result)
    for root in exact:
        assert np.min(np.abs(found - root)) < 2e-5 * abs(root)
    assert result.summary["modes"][0]["stable"] is False


def thresholds(document: dict[str, Any]) -> list[dict[str, Any]]:
    (found,) = he.solve(document).summary["stability"]
    return list(found["thresholds"])


def assert_threshold(found: dict[str, Any], kind: str, factor: float, rtol: float = 1e-6) -> None:
    assert found["kind"] == kind
    assert abs(found["factor"] / factor - 1.0) <= min(found["relative_error"] + 1e-6, rtol)


def stability(*factors: float) -> dict[str, Any]:
    return {"kind": "stability", "factors": list(factors)}


# Five digits are known of where two pairs of roots meet: on the real axis for small shares of the liquid's mass, where
# the second divergence lets two motions grow, elsewhere on the imaginary axis after the first has become stable again.
@pytest.mark.slow
@pytest.mark.parametrize(("share", "flutter"), [(0.1, 6.39412), (0.3, 6.28439), (0.5, 6.30388), (0.8, 6.39072)])
def test_thresholds_of_a_pinned_beam(share: float, flutter: float) -> None:
    between = 0.5 * (2.0 * np.pi + flutter)
    second, third = thresholds(in_axial_flow(1.0, share, stability(6.2, between, 6.5)))
    assert_threshold(second, "divergence", 2.0 * np.pi)
    assert_threshold(third, "flutter", flutter, 2e-6)
    assert (third["omega"] > 0.0) == (share > 0.4)


@pytest.mark.slow
def test_divergence_grows_with_tension_and_with_clamps() -> None:
    (found,) = thresholds(in_axial_flow(1.0, 0.2, stability(3.3, 3.6), tension=2.0))
    assert_threshold(found, "divergence", np.sqrt(np.pi**2 + 2.0))
    (found,) = thresholds(in_axial_flow(1.0, 0.3, stability(6.1, 6.4), reactive="moving_load", clamp=True))
    assert_threshold(found, "divergence", 2.0 * np.pi)


@pytest.mark.slow
def test_a_hose_flutters_at_the_speed_of_a_pipe() -> None:
    """M09, of which eight digits are known; m + M = EI = L = 1 but for masses of 1 kg/m each."""
    speed, frequency = results("M09")["beta=0.5"]
    found = he.solve(he.read("fluttering_hose", {"analysis": [stability(9.0, 9.6)]})).summary["stability"][0]
    assert found["growing"] == [0, found["growing"][1]]
    (flutter,) = found["thresholds"]
    assert_threshold(flutter, "flutter", speed, 2e-5)
    assert flutter["omega"] == pytest.approx(frequency / np.sqrt(2.0), rel=1e-4)


@pytest.mark.slow
def test_a_string_diverges_and_is_ill_posed_beyond() -> None:
    """M U² = T for all motions at once; above, until M U² = T (m + M)/m, they are stable again."""
    thread = {"mass": 1.0, "added_mass": 1.0, "tension": 1.0, "reactive": "lighthill"}
    # Not so that an interval is halved at 1, where no motion has any stiffness.
    result = he.solve(taut(velocity=1.0, **thread, analysis=[stability(0.2, 0.5, 0.8, 1.1, 1.5)]))
    (found,) = result.summary["stability"]
    assert found["growing"][:4] == [0, 0, 0, 0]
    assert found["ill_posed_from"] == 1.5
    assert "the faster the shorter" in found["ill_posed_reason"]
    assert {one["kind"] for one in found["thresholds"]} == {"divergence"}
    assert_threshold(found["thresholds"][0], "divergence", 1.0)


@pytest.mark.slow
def test_motions_that_do_not_oscillate_keep_the_tolerance() -> None:
    """A buoyant line that hangs in a stream between fixed ends, of whose first 27 roots 22 are real."""
    thread = {"length": 691.3915738971978, "diameter": 0.014606320526490253, "normal_drag": 0.41044095071395204}
    thread |= {"weight": -10.344128599987942, "mass": 0.6053917739879237, "axial_rigidity": 185352870.2550414}
    end = fixed(44.360017318137935, 103.36364762208115, 294.76382083608235)
    document = scene(thread, end, modes(5), stream=WATER | {"velocity": [-0.6943079866011038, 0.0]})
    rough, fine = (he.solve(document | {"accuracy": {"tolerance": tolerance}}) for tolerance in (1e-6, 1e-8))
    assert rough.summary["status"] == "ok"
    for kind in ("oscillating", "aperiodic"):
        stated = np.array([mode["relative_error"] for mode in rough.summary["modes"][0][kind]])
        # On the first mesh the largest error of an oscillating root is 8.1e-7, that of a real one 6.1e-6.
        assert stated.max() <= 1e-6
        found, exact = roots(rough, kind), roots(fine, kind)
        assert np.all(np.abs(found - exact) <= (stated + 1e-8) * np.abs(exact))
