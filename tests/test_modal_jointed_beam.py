"""Dry modes of stepped and jointed beams: closed forms, a transcendental determinant, limits, orthogonality."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from scipy.optimize import brentq

from hydroelastic.modal.beam.dry_modes import free_free_roots, free_free_shape
from hydroelastic.modal.beam.jointed_modes import JointedModes, jointed_modes
from hydroelastic.physics.beam_parts import Joint, Section
from hydroelastic.physics.beams import Beam

Parts = tuple[tuple[float, float, float], ...]


def beam(parts: Parts, *joints: tuple[float, float]) -> Beam:
    """A beam from lengths, flexural rigidities and masses of its sections, and places and stiffnesses of its joints."""
    return Beam(
        sections=tuple(Section(length=a, flexural_rigidity=b, mass_per_length=c) for a, b, c in parts),
        joints=tuple(Joint(at=place, rotational_stiffness=stiffness) for place, stiffness in joints),
    )


STEPPED = beam(((0.7, 2.0, 3.0), (1.1, 40.0, 1.0), (0.6, 0.5, 2.0)), (0.4, 5.0), (1.8, 0.0))
SYMMETRIC = beam(((0.5, 1.0, 2.0), (1.5, 30.0, 1.0), (0.5, 1.0, 2.0)), (0.5, 0.0), (1.25, 3.0), (2.0, 0.0))
STIFF = beam(((0.3, 1.0, 1.0), (0.5, 1e6, 1.0), (0.2, 1.0, 5.0)))
SOFT = beam(((0.3, 1.0, 1.0), (0.7, 4.0, 2.0)), (0.37, 1e-12))
BEAMS = {"stepped": STEPPED, "symmetric": SYMMETRIC, "stiff": STIFF, "soft joint": SOFT}


@pytest.mark.parametrize("parts", [((1.0, 1.0, 1.0),), ((0.3, 1.0, 1.0), (0.25, 1.0, 1.0), (0.45, 1.0, 1.0))])
def test_a_uniform_beam_has_the_closed_forms(parts: Parts) -> None:
    """Sixty elastic modes. Rounding is 1e-16 times the ratio of the frequencies, (κ₆₀/κ₁)² = 1600, times a few."""
    modes = jointed_modes(beam(parts), 62)
    assert modes.squared_frequencies[:2] == pytest.approx([0.0, 0.0], abs=0.0)
    assert modes.squared_frequencies[2:] ** 0.25 == pytest.approx(free_free_roots(60), rel=1e-12)
    x = np.linspace(0.0, 1.0, 401)
    for derivative in range(3):
        exact = np.array([free_free_shape(number, x, derivative) for number in range(62)])
        scale = np.array([1.0, 1.0, *free_free_roots(60)])[:, None] ** derivative
        # Pitch rises to the right in both; elastic shapes are positive at the left end in both.
        error = np.abs(modes.shapes(x, derivative) - exact) / scale
        assert error.max() < 2e-11


def test_a_hinge_in_the_middle_of_a_uniform_beam_has_known_frequencies() -> None:
    """Symmetric modes bend each half like a free beam; antisymmetric ones have no moment there without the hinge."""
    modes = jointed_modes(beam(((1.0, 1.0, 1.0),), (0.5, 0.0)), 23)
    roots = free_free_roots(20)
    expected = np.sort(np.concatenate([2.0 * roots, roots[1::2]]))[:20]
    assert modes.dofs[:4] == ("heave", "pitch", "hinge 1", "elastic 1")
    assert modes.squared_frequencies[3:] ** 0.25 == pytest.approx(expected, rel=1e-12)
    # They come in pairs, 2κⱼ = κ₂ⱼ but for e^{-κ}, which parity keeps apart.
    halves = {parity: modes.squared_frequencies[3:][np.array(modes.parities[3:]) == parity] for parity in (1, -1)}
    assert halves[1] ** 0.25 == pytest.approx(2.0 * roots[: len(halves[1])], rel=1e-12)
    assert halves[-1] ** 0.25 == pytest.approx(roots[1::2][: len(halves[-1])], rel=1e-12)


def test_a_stiff_joint_is_a_weld_and_a_soft_one_a_hinge() -> None:
    """The compliance of a joint changes λ by the part M²/(k λ) ~ κ/k of it: 200/1e12 at most here."""
    welded = jointed_modes(beam(((1.0, 1.0, 1.0),)), 62).squared_frequencies
    stiff = jointed_modes(beam(((1.0, 1.0, 1.0),), (0.37, 1e12)), 62).squared_frequencies
    assert stiff[2:] == pytest.approx(welded[2:], rel=4e-10)
    assert stiff[2] == pytest.approx(welded[2], rel=2e-11)
    hinged = jointed_modes(beam(((1.0, 1.0, 1.0),), (0.37, 0.0)), 62)
    soft = jointed_modes(beam(((1.0, 1.0, 1.0),), (0.37, 1e-12)), 62)
    assert hinged.rigid == 3
    assert soft.squared_frequencies[3:] == pytest.approx(hinged.squared_frequencies[3:], rel=1e-11)
    # Two rigid bars on a spring: λ = k Δ², Δ the jump of the slope in the rigid shape of unit mass.
    (jump,) = slope_jumps(hinged)[:, 2]
    assert soft.squared_frequencies[2] == pytest.approx(1e-12 * jump**2, rel=1e-11)


def slope_jumps(modes: JointedModes) -> np.ndarray:
    """Jump of the slope at each joint in each mode, shape (joints, modes)."""
    places = np.array([modes.beam.edges[modes.beam.node_of(joint)] for joint in modes.beam.joints])
    jumps: np.ndarray = (modes.shapes(places, 1, "right") - modes.shapes(places, 1, "left")).T
    return jumps


def waves(part: Section, omega: float, s: float) -> np.ndarray:
    """(w, w′, EI w″, EI w‴) at s of cos κs, sin κs, e^{-κs}, e^{-κ(l − s)}, shape (4, 4); nothing overflows."""
    k = (part.mass_per_length * omega**2 / part.flexural_rigidity) ** 0.25
    cosine, sine, falls, rises = np.cos(k * s), np.sin(k * s), np.exp(-k * s), np.exp(-k * (part.length - s))
    rows = [
        [cosine, sine, falls, rises],
        [-k * sine, k * cosine, -k * falls, k * rises],
        [-(k**2) * cosine, -(k**2) * sine, k**2 * falls, k**2 * rises],
        [k**3 * sine, -(k**3) * cosine, -(k**3) * falls, k**3 * rises],
    ]
    return np.array(rows) * np.array([1.0, 1.0, part.flexural_rigidity, part.flexural_rigidity])[:, None]


def determinant(given: Beam, omega: float) -> tuple[float, float]:
    """Sign and logarithm of the determinant of all conditions at ends, steps and joints; its roots are frequencies."""
    count = len(given.spans)
    stiffness = {given.node_of(joint): joint.rotational_stiffness for joint in given.joints}
    matrix = np.zeros((4 * count, 4 * count))
    matrix[:2, :4] = waves(given.spans[0], omega, 0.0)[2:]
    matrix[2:4, -4:] = waves(given.spans[-1], omega, given.spans[-1].length)[2:]
    for node, (left, right) in enumerate(pairwise(given.spans), 1):
        before, after = waves(left, omega, left.length), waves(right, omega, 0.0)
        rows = np.hstack([before, -after])
        if node in stiffness:
            # k (w′ before − w′ after) + M = 0 in place of equal slopes.
            rows[1] = stiffness[node] * rows[1] + np.concatenate([before[2], np.zeros(4)])
        matrix[4 * node : 4 * node + 4, 4 * node - 4 : 4 * node + 4] = rows
    matrix /= np.abs(matrix).max(axis=1)[:, None]
    sign, logarithm = np.linalg.slogdet(matrix)
    return float(sign), float(logarithm)


def root(given: Beam, low: float, high: float) -> float:
    reference = determinant(given, low)[1]

    def scaled(omega: float) -> float:
        sign, logarithm = determinant(given, omega)
        return sign * float(np.exp(logarithm - reference))

    return float(brentq(scaled, low, high, xtol=1e-15 * high, rtol=1e-14))


@pytest.mark.parametrize("name", sorted(BEAMS.keys() - {"soft joint"}))
def test_frequencies_are_roots_of_the_transcendental_determinant(name: str) -> None:
    """Between the means of neighbours the determinant changes its sign once, to rounding at the frequency."""
    modes = jointed_modes(BEAMS[name], 44)
    omega = np.sqrt(modes.squared_frequencies[modes.rigid :])
    middles = np.sqrt(omega[1:] * omega[:-1])
    roots = [root(BEAMS[name], low, high) for low, high in pairwise([0.7 * omega[0], *middles])]
    assert omega[: len(roots)] == pytest.approx(roots, rel=1e-11)


@pytest.mark.parametrize("name", BEAMS)
def test_modes_are_orthogonal_in_mass_and_in_strain_energy(name: str) -> None:
    """By a quadrature of the shapes that the modes are not made with; 60 elastic modes."""
    modes = jointed_modes(BEAMS[name], 60 + jointed_modes(BEAMS[name], 0).rigid)
    size = len(modes.dofs)
    mass, strain = np.zeros((size, size)), np.zeros((size, size))
    nodes, weights = np.polynomial.legendre.leggauss(160)
    for part, left in zip(modes.beam.spans, modes.beam.edges, strict=False):
        x = left + 0.5 * part.length * (nodes + 1.0)
        w, curvature = modes.shapes(x), modes.shapes(x, 2)
        mass += part.mass_per_length * 0.5 * part.length * (w * weights) @ w.T
        strain += part.flexural_rigidity * 0.5 * part.length * (curvature * weights) @ curvature.T
    for joint, jump in zip(modes.beam.joints, slope_jumps(modes), strict=True):
        strain += joint.rotational_stiffness * np.outer(jump, jump)
    assert np.abs(mass - np.eye(size)).max() < 1e-11
    assert np.abs(modes.products(modes.beam) - np.eye(size)).max() < (1e-11)
    elastic = slice(modes.rigid, size)
    scale = np.sqrt(modes.squared_frequencies[elastic])
    assert np.abs(strain[elastic, elastic] / np.outer(scale, scale) - np.eye(60)).max() < 1e-11
    assert np.abs(strain[: modes.rigid, : modes.rigid]).max() < 1e-11


@pytest.mark.parametrize("name", BEAMS)
def test_shapes_keep_the_conditions_at_ends_steps_and_joints(name: str) -> None:
    modes = jointed_modes(BEAMS[name], 40)
    edges = np.array(modes.beam.edges)
    inner = edges[1:-1]
    everywhere = np.linspace(edges[0], edges[-1], 501)
    largest = np.abs(modes.shapes(everywhere)).max(axis=1)[:, None]
    assert np.abs(modes.shapes(inner, 0, "left") - modes.shapes(inner)).max() < 1e-10 * largest.max()
    moments = np.abs(modes.bending_moments(everywhere)).max(axis=1)[:, None] + 1e-300
    shears = np.abs(modes.shear_forces(everywhere)).max(axis=1)[:, None] + 1e-300
    jump = modes.bending_moments(inner, "left") - modes.bending_moments(inner)
    assert (np.abs(jump) / moments)[modes.rigid :].max() < 1e-8
    assert (np.abs(modes.bending_moments(edges[[0, -1]])) / moments)[modes.rigid :].max() < 1e-8
    assert (np.abs(modes.shear_forces(edges[[0, -1]])) / shears)[modes.rigid :].max() < 1e-8
    for joint, jumps in zip(modes.beam.joints, slope_jumps(modes), strict=True):
        (moment,) = modes.bending_moments(np.array([edges[modes.beam.node_of(joint)]])).T
        error = np.abs(joint.rotational_stiffness * jumps - moment) / moments[:, 0]
        assert error[modes.rigid :].max() < 1e-8
    welds = [edge for number, edge in enumerate(inner, 1) if number not in map(modes.beam.node_of, modes.beam.joints)]
    slopes = np.abs(modes.shapes(everywhere, 1)).max(axis=1)[:, None] + 1.0
    kinks = modes.shapes(np.array(welds), 1, "left") - modes.shapes(np.array(welds), 1)
    assert np.abs(kinks / slopes).max(initial=0.0) < 1e-8


def test_a_chain_of_hinges_has_a_rigid_shape_more_for_each() -> None:
    chain = beam(((5.0, 1.0, 1.0),), *((place, 0.0) for place in (1.0, 2.0, 3.0, 4.0)))
    modes = jointed_modes(chain, 10)
    assert modes.rigid == 6
    assert np.count_nonzero(modes.squared_frequencies == 0.0) == 6
    inside = np.array([0.3, 1.2, 2.9, 4.4])
    assert np.abs(modes.shapes(inside, 2)[:6]).max() == pytest.approx(0.0, abs=0.0)
