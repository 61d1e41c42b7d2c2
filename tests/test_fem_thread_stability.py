"""Divergence and flutter of threads in axial flow against known thresholds."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from thread_cases import results
from thread_mode_cases import COMM, in_axial_flow, straight_thread

from hydroelastic.fem.thread.hyperbolicity import IllPosedError
from hydroelastic.fem.thread.spectrum import branches
from hydroelastic.fem.thread.stability import Stability, stability
from hydroelastic.fem.thread.straight import straight_equilibrium
from hydroelastic.physics.stream import UniformStream
from hydroelastic.physics.thread import Thread


def sweep(
    model_at: Callable[[float], Thread],
    values: list[float],
    *,
    tension: float = 0.0,
    elements: int = 12,
    degree: int = 4,
    count: int = 3,
) -> Stability:
    """A sweep about straight equilibria."""

    def on(elements: int) -> Any:
        nodes = np.linspace(0.0, 1.0, elements + 1)
        return lambda value: straight_equilibrium(COMM, model_at(value), nodes, tension, degree=degree)

    return stability(on(elements), on(elements // 2), np.array(values), count=count)


def assert_threshold(found: Any, kind: str, value: float, rtol: float) -> None:
    """As close as asked, and not farther than its estimate says beside the digits of the value."""
    assert found.kind == kind
    assert abs(found.value - value) <= rtol * value
    assert abs(found.value - value) <= found.error + 1e-6 * value
    assert found.error < 100.0 * rtol * value


# Five digits are known of where two pairs of roots meet: on the real axis for small shares of the liquid's mass, where
# the second divergence lets two motions grow, elsewhere on the imaginary axis after the first has become stable again.
@pytest.mark.slow_but("0.5*")
@pytest.mark.parametrize(
    ("share", "flutter", "growing"),
    [
        (0.1, 6.39412, (2, 1)),
        pytest.param(0.3, 6.28439, (2, 1), marks=pytest.mark.slow),
        (0.5, 6.30388, (0, 1)),
        pytest.param(0.8, 6.39072, (0, 1), marks=pytest.mark.slow),
    ],
)
def test_pinned_beam(share: float, flutter: float, growing: tuple[int, int]) -> None:
    found = sweep(lambda speed: in_axial_flow(speed, share), [6.2, 0.5 * (2.0 * np.pi + flutter), 6.5])
    second, third = found.thresholds
    assert_threshold(second, "divergence", 2.0 * np.pi, 1e-8)
    assert_threshold(third, "flutter", flutter, 1e-6)
    assert third.growing == growing
    assert (third.frequency > 0.0) == (growing[0] == 0)
    assert found.ill_posed is None


@pytest.mark.slow
def test_divergence_does_not_depend_on_the_share_and_grows_with_tension() -> None:
    for share in (0.2, 0.6):
        found = sweep(lambda speed, share=share: in_axial_flow(speed, share), [3.3, 3.6], tension=2.0, count=2)
        assert_threshold(found.thresholds[0], "divergence", np.sqrt(np.pi**2 + 2.0), 1e-8)
        assert list(found.growing) == [0, 1]


@pytest.mark.slow
def test_clamped_beam() -> None:
    found = sweep(lambda speed: in_axial_flow(speed, 0.3, "moving_load", clamped=(True, True)), [6.1, 6.4], count=2)
    assert len(found.thresholds) == 1
    assert_threshold(found.thresholds[0], "divergence", 2.0 * np.pi, 1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("share", [0.2, pytest.param(0.5, marks=pytest.mark.slow)])
def test_cantilever_with_a_blunt_end(share: float) -> None:
    speed, frequency = results("M09")[f"beta={share}"]
    # The trace of r_s at the free end makes the order p.
    found = sweep(
        lambda speed: in_axial_flow(speed, share, clamped=(True, False), held=(True, False)),
        [speed - 0.5, speed + 0.4],
        elements=20,
        degree=5,
    )
    assert len(found.thresholds) == 1
    assert_threshold(found.thresholds[0], "flutter", speed, 2e-7)
    # m + M = EI = L = 1.
    assert found.thresholds[0].frequency == pytest.approx(frequency, rel=1e-6)
    assert found.thresholds[0].growing == (0, 1)


def string(speed: float) -> Thread:
    """A string of m = M = T = 1."""
    return straight_thread(mass=1.0, added_mass=1.0, reactive="lighthill", stream=UniformStream((speed, 0.0, 0.0)))


@pytest.fixture(scope="module")
def string_in_stream() -> Stability:
    return sweep(string, [0.2, 0.5, 0.8, 1.2, 1.5], tension=1.0)


@pytest.mark.slow
def test_string_diverges_and_is_ill_posed_beyond(string_in_stream: Stability) -> None:
    # M U² = T for all motions at once; above, until M U² = T (m + M)/m, they are stable again.
    found = string_in_stream
    assert len(found.thresholds) == 1
    assert_threshold(found.thresholds[0], "divergence", 1.0, 1e-9)
    assert list(found.growing) == [0, 0, 0, 0]
    assert found.ill_posed is not None
    assert found.ill_posed[0] == 1.5
    assert "the faster the shorter" in found.ill_posed[1]
    with pytest.raises(IllPosedError, match="the faster the shorter"):
        sweep(string, [1.5, 1.6], tension=1.0)


@pytest.mark.slow
def test_roots_are_followed(string_in_stream: Stability) -> None:
    # ω_n = nπ (T − M U²)/√((m + M) T − m M U²), until they meet.
    speeds = string_in_stream.values[:3]
    factor = np.pi * (1.0 - speeds**2) / np.sqrt(2.0 - speeds**2)
    for branch in string_in_stream.roots[:3].T:
        number = branch[0] / (1j * factor[0])
        assert abs(number - round(number.real)) < 1e-6
        np.testing.assert_allclose(branch, 1j * round(number.real) * factor, rtol=1e-5)


def test_branches_cross_and_pairs_split() -> None:
    # One frequency rises through another that falls, a third pair goes through zero onto the real axis.
    values = np.linspace(0.0, 1.0, 6)
    pairs = np.array([(1.0 + 0.7 * x) * 1j for x in values]), np.array([(2.0 - 0.9 * x) * 1j for x in values])
    slow = np.sqrt((values - 0.55) * 0.1 + 0j)
    spectra: list[Any] = [
        SimpleNamespace(value=x, with_conjugates=np.array([a, b, c, -a, -b, -c]))
        for x, a, b, c in zip(values, *pairs, slow, strict=True)
    ]
    followed = branches(spectra)
    np.testing.assert_allclose(followed[:, 0], pairs[0])
    np.testing.assert_allclose(followed[:, 1], pairs[1])
    np.testing.assert_allclose(np.sort(followed[-1, [2, 5]].real), [-abs(slow[-1]), abs(slow[-1])])


@pytest.mark.parametrize("order", [(0, 1), (1, 0)])
def test_a_pair_on_the_real_axis_continues_in_one_way(order: tuple[int, int]) -> None:
    # Both real roots are equally far from both of the pair: the order in which they were found may not decide.
    values = np.linspace(0.0, 1.0, 6)
    slow = np.sqrt((values - 0.55) * 0.1 + 0j)
    spectra: list[Any] = [
        SimpleNamespace(value=x, with_conjugates=np.array([root, -root])[list(order) if x > 0.55 else [0, 1]])
        for x, root in zip(values, slow, strict=True)
    ]
    np.testing.assert_array_equal(branches(spectra), np.column_stack([slow, -slow]))


def test_values_must_ascend() -> None:
    with pytest.raises(ValueError, match="ascending"):
        sweep(string, [0.5, 0.4], tension=1.0)
