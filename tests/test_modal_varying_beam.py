"""Dry modes of beams whose rigidity and mass vary, against a shooting method, stepped beams and closed forms."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from hydroelastic.modal.beam.beam_shapes import beam_shapes, first_dry_eigenvalue
from hydroelastic.modal.beam.jointed_modes import jointed_modes
from hydroelastic.physics.beam_parts import Section
from hydroelastic.physics.beams import Beam
from hydroelastic.physics.varying_beam import VaryingBeam

Function = Callable[[np.ndarray], np.ndarray]


def varying(rigidity: Function, mass: Function, *lengths: float) -> VaryingBeam:
    """A beam with breaks between the given lengths."""
    edges = np.cumsum([0.0, *lengths])
    middles = 0.5 * (edges[1:] + edges[:-1])
    return VaryingBeam(
        sections=tuple(
            Section(length=length, flexural_rigidity=float(ei), mass_per_length=float(m))
            for length, ei, m in zip(lengths, rigidity(middles), mass(middles), strict=True)
        ),
        rigidity=rigidity,
        mass=mass,
    )


def end_forces(beam: VaryingBeam, omega: float) -> float:
    """What must vanish at a dry frequency: the determinant of moment and shear force at the right end by deflection
    and slope at the free left one, from the differential equations of w, w′, M and Q."""

    def slopes(x: float, state: np.ndarray) -> np.ndarray:
        at = np.array([x])
        deflections, angles, moments, forces = state.reshape(4, 2)
        inertia = beam.mass(at)[0] * omega**2
        return np.concatenate([angles, moments / beam.rigidity(at)[0], forces, inertia * deflections])

    state = np.array([1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0])
    left = 0.0
    for part in beam.sections:
        state = solve_ivp(slopes, (left, left + part.length), state, method="DOP853", rtol=1e-12, atol=1e-14).y[:, -1]
        left += part.length
    return float(np.linalg.det(state.reshape(4, 2)[2:]))


TAPERED = varying(lambda x: (1.0 + 0.75 * x) ** 3, lambda x: 2.0 * (1.0 + 0.75 * x), 2.0)
BULGED = varying(lambda x: 3.0 + np.sin(3.0 * x), lambda x: 1.0 + 0.3 * x**2, 1.5)
KINKED = varying(lambda x: 1.0 + np.abs(x - 1.0), lambda x: np.where(x < 1.0, 1.0, 2.0), 1.0, 0.7)


@pytest.mark.slow_but("tapered")
@pytest.mark.parametrize("beam", [TAPERED, BULGED, KINKED], ids=["tapered", "bulged", "kinked"])
def test_dry_frequencies_are_those_of_a_shooting_method(beam: VaryingBeam) -> None:
    modes = jointed_modes(beam, 10)
    assert list(modes.squared_frequencies[:2]) == [0.0, 0.0]
    for squared in modes.squared_frequencies[2:6]:
        omega = float(np.sqrt(squared))
        found = brentq(lambda value: end_forces(beam, value), 0.99 * omega, 1.01 * omega, xtol=1e-13, rtol=1e-13)
        # Errors of the shooting method, 1e-12 a step, grow with cosh κl: 4e-9 in the sixth elastic mode, 1e-10 here.
        assert omega == pytest.approx(found, rel=1e-9)
    assert first_dry_eigenvalue(beam) == pytest.approx(modes.squared_frequencies[2], rel=1e-12)


def test_shapes_are_orthogonal_and_couple_in_the_mass_alone() -> None:
    shapes = beam_shapes(TAPERED, 12)
    nodes, weights = np.polynomial.legendre.leggauss(60)
    x = 1.0 + nodes
    values = shapes.deflections(x)
    # The sum of 60 terms near 1, each to rounding.
    assert (values * weights) @ values.T == pytest.approx(2.0 * np.eye(12), abs=1e-11)
    assert (values * weights * TAPERED.mass(x)) @ values.T == pytest.approx(shapes.mass, abs=1e-11)
    assert np.abs(shapes.mass - np.diag(np.diag(shapes.mass))).max() > 0.1


def test_a_beam_that_varies_by_nothing_is_the_uniform_one() -> None:
    uniform = Beam(sections=(Section(length=2.0, flexural_rigidity=3.0, mass_per_length=0.5),))
    same = varying(lambda x: np.full_like(x, 3.0), lambda x: np.full_like(x, 0.5), 1.2, 0.8)
    one, other = beam_shapes(uniform, 20), beam_shapes(same, 20)
    # Rounding grows with the ratio of the highest frequency to the lowest, 1e2 here.
    assert other.bending == pytest.approx(one.bending, rel=1e-12, abs=1e-12)
    assert other.mass == pytest.approx(one.mass, abs=1e-12)


def test_steps_of_a_varying_beam_are_those_of_a_stepped_one() -> None:
    stepped = Beam(
        sections=(
            Section(length=1.0, flexural_rigidity=2.0, mass_per_length=1.0),
            Section(length=0.6, flexural_rigidity=5.0, mass_per_length=3.0),
        )
    )
    same = varying(lambda x: np.where(x < 1.0, 2.0, 5.0), lambda x: np.where(x < 1.0, 1.0, 3.0), 1.0, 0.6)
    assert jointed_modes(same, 12).squared_frequencies == pytest.approx(
        jointed_modes(stepped, 12).squared_frequencies, rel=1e-12
    )
