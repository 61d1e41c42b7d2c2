"""The references of the hard cases are true: against closed forms, older references, and themselves when refined."""

from __future__ import annotations

import json
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from surface_panels import Panel, liquid_matrix
from surface_reference import (
    Fineness,
    ReferenceBeam,
    ReferenceTank,
    layer_wavenumber,
    reference_modes,
    reference_tank,
    without_waves,
)

import hydroelastic as he
from hydroelastic.modal.beam.floating_beam import FloatingBeam
from hydroelastic.modal.beam.gravity_added_mass import gravity_tones

FOLDER = Path(__file__).parent / "reference"
OLDER: dict[str, Any] = json.loads((FOLDER / "aquarium.json").read_text(encoding="utf-8"))
AQUARIUM: dict[str, Any] = {case["name"]: case for case in OLDER["cases"]}
HARD: dict[str, Any] = json.loads((FOLDER / "hard_cases.json").read_text(encoding="utf-8"))
COMPUTED = {name: entry for name, entry in HARD["cases"].items() if "unknowns" in entry}
COMPUTED |= {f"random {number}": entry for number, entry in enumerate(HARD["random"])}


def some_slow(names: Any, fast: set[str]) -> list[Any]:
    return [pytest.param(name, marks=[] if name in fast else [pytest.mark.slow]) for name in names]


def aquarium_tank(name: str) -> ReferenceTank:
    given = AQUARIUM[name]["inputs"]
    length = given["L"]
    beam = ReferenceBeam(
        start=given["x1"] / length,
        end=(given["x1"] + given["l"]) / length,
        rigidity=given["EI"] / (given["rho"] * given["g"] * length**4),
        mass=given["m"] / (given["rho"] * length),
        restoring=float(given["s"]),
    )
    return ReferenceTank(depth=given["H"] / length, beams=(beam,) if given["l"] else ())


def aquarium_omega(name: str, eigenvalues: np.ndarray) -> np.ndarray:
    given = AQUARIUM[name]["inputs"]
    return np.sqrt(eigenvalues * given["g"] / given["L"])


@pytest.mark.parametrize("depth", [0.003, 0.5, 20.0])
def test_cosines_are_eigenfunctions_of_the_operator(depth: float) -> None:
    """N cos kx = cos kx/(k tanh kH), on panels of very different length, one of them next to a wall."""
    ends = [0.0, 0.2, 0.2001, 0.6, 0.600001, 1.0]
    panels = [
        Panel(anchor=low, offset=0.5 * (high - low), half=0.5 * (high - low), degree=24) for low, high in pairwise(ends)
    ]
    matrix = liquid_matrix(panels, depth)
    nodes, weights = np.polynomial.legendre.leggauss(40)
    for number in (1, 2, 7):
        wavenumber = number * np.pi
        moments = np.concatenate(
            [
                (np.polynomial.legendre.legvander(nodes, panel.degree).T * weights * panel.half)
                @ np.cos(wavenumber * (panel.anchor + panel.offset + panel.half * nodes))
                * panel.norms()
                for panel in panels
            ]
        )
        expected = moments / (wavenumber * np.tanh(wavenumber * depth))
        # Rounding: some fifty units of the last place of the largest, 1/k²H.
        np.testing.assert_allclose(matrix @ moments, expected, rtol=0, atol=1e-14 * max(1.0, 0.1 / depth))


WITHOUT_GUIDES = [name for name, case in AQUARIUM.items() if case["inputs"]["ends"] != "guided"]


@pytest.mark.slow_but("full_free_s0")
@pytest.mark.parametrize("name", some_slow(WITHOUT_GUIDES, {"base_s0", "narrow_s1", "full_free_s0", "vlfs_dock_s1"}))
def test_frequencies_are_those_of_the_older_references(name: str) -> None:
    # These have 11 to 14 certain digits; measured 2e-14, and 2e-13 for full_free_s0, whose λ span five decades.
    omega = aquarium_omega(name, reference_modes(aquarium_tank(name), 8).eigenvalues)
    np.testing.assert_allclose(omega, AQUARIUM[name]["omega"], rtol=5e-13)


WITHOUT_WAVES = [name for name, case in AQUARIUM.items() if "psi0" in case]


@pytest.mark.slow
@pytest.mark.parametrize("name", WITHOUT_WAVES)
def test_pressure_release_tones_are_those_of_the_older_references(name: str) -> None:
    modes = reference_modes(without_waves(aquarium_tank(name)), 6)
    omega = aquarium_omega(name, modes.eigenvalues)[modes.participations[0].argmax()]
    # Exponentially convergent there, measured 7e-15; with a beam at the wall it keeps nine digits, measured 1.1e-10.
    given = AQUARIUM[name]["inputs"]
    assert omega == pytest.approx(AQUARIUM[name]["psi0"]["elastic_omega"], rel=1e-12 if given["x1"] else 1e-9)


@pytest.mark.slow
def test_participations_and_kinds_are_those_of_the_older_references() -> None:
    modes = reference_modes(aquarium_tank("base_s0"), 8)
    np.testing.assert_allclose(modes.participations[0], AQUARIUM["base_s0"]["p_dry1"], atol=1e-12)
    np.testing.assert_allclose(modes.shares.sum(axis=0), 1.0, rtol=1e-12)
    # Without hydrostatics all that is not in the water bends.
    np.testing.assert_allclose(modes.shares[3], AQUARIUM["base_s0"]["f_strain"], atol=1e-12)


def test_tones_are_those_of_the_dense_estimates() -> None:
    """`modal` discretises the same operator by another rule, and the beam by its dry modes."""
    scene = he.TankScene(**COMPUTED["tip_1e-02_from_the_wall"]["scene"])
    (body,), (liquid,) = scene.body, scene.liquid
    floating = FloatingBeam(
        tank_length=scene.tank.length,
        depth=liquid.depth,
        density=liquid.density,
        gravity=scene.tank.gravity,
        start=body.start,
        length=body.length,
        flexural_rigidity=body.flexural_rigidity,
        mass_per_length=body.mass_per_length,
        hydrostatic=body.hydrostatic,
    )
    expected = COMPUTED["tip_1e-02_from_the_wall"]["omega"]
    tones = gravity_tones(floating, tuple(range(40)), 4.0 * expected[-1] ** 2)
    # Forty dry modes leave a tail, so that these lie above; measured 4e-11.
    error = np.sqrt(tones.squared_frequencies[: len(expected)]) / expected - 1.0
    assert error.min() >= -1e-11
    assert error.max() <= 3e-10


def test_a_slit_beside_a_heavy_beam_sloshes_as_in_the_literature() -> None:
    """Ice fishing: beside a heavy rigid cover λa/g of a slit of width a at the wall tends to 3.4533348, 6.6286147, …

    Source: the even modes of a strip in a rigid dock (Henrici, Troesch & Wuytack 1970, and others).
    """
    slit = 1e-3
    cover = ReferenceBeam(start=slit, end=1.0, rigidity=1e15, mass=1e7, restoring=0.0)
    modes = reference_modes(ReferenceTank(depth=1.0, beams=(cover,)), 3)
    expected = OLDER["constants"]["ice-fishing strip even modes lam*a/g (half aperture a)"]
    # The first is the heave of the cover. Printed with eight digits; the other wall is a thousand slits away, and felt
    # like the square of that.
    np.testing.assert_allclose(modes.eigenvalues[1:] * slit, expected[:2], rtol=1e-6)


@pytest.mark.slow
def test_values_come_from_above() -> None:
    coarse = Fineness(degree=3, phase=4.0, smallest=1e-2, bending=8)
    for name in ("base_s0", "vlfs_dock_s1"):
        tank = aquarium_tank(name)
        above = reference_modes(tank, 8, coarse).eigenvalues / reference_modes(tank, 8).eigenvalues - 1.0
        # The lowest are exact to rounding already.
        assert above.min() > -1e-12
        assert above.max() > 1e-9


@pytest.mark.slow
def test_symmetric_and_antisymmetric_modes_are_all_modes() -> None:
    tank = aquarium_tank("narrow_s1")
    halves = [reference_modes(tank, 4, parity=parity).eigenvalues for parity in ("symmetric", "antisymmetric")]
    both = np.sort(np.concatenate(halves))[:6]
    np.testing.assert_allclose(both, reference_modes(tank, 6).eigenvalues, rtol=1e-13)
    with pytest.raises(ValueError, match="mirror image"):
        reference_modes(aquarium_tank("offcentre_s0"), 2, parity="symmetric")


def test_without_a_beam_waves_obey_the_dispersion_relation() -> None:
    tank = ReferenceTank(depth=0.3, beams=())
    wavenumbers = np.pi * np.arange(1, 21)
    values = reference_modes(tank, 20).eigenvalues
    np.testing.assert_allclose(values, wavenumbers * np.tanh(0.3 * wavenumbers), rtol=1e-13)
    assert layer_wavenumber(values[6], tank.layers) == pytest.approx(wavenumbers[6], rel=1e-12)


@pytest.mark.parametrize("name", COMPUTED)
def test_references_have_converged(name: str) -> None:
    # Measured: 5e-13 where λ spans four decades and bending is soft (waves_above_the_tones), 1e-14 as a rule.
    assert COMPUTED[name]["self_convergence"] <= 1e-12
    # Measured: 2e-10 where the tone lies nine decades above heave (stiff_6), 1e-12 and below else.
    for tone in COMPUTED[name]["pressure_release"]:
        assert tone is None or tone["self_convergence"] <= 3e-10


@pytest.mark.slow_but("full_cover")
@pytest.mark.parametrize("name", some_slow(COMPUTED, {"full_cover", "tip_at_the_wall"}))
def test_stored_references_are_made_anew(name: str) -> None:
    scene = he.TankScene(**COMPUTED[name]["scene"])
    modes = reference_modes(reference_tank(scene), scene.accuracy.modes, replace(Fineness(), degree=18, bending=46))
    omega = np.sqrt(modes.eigenvalues * scene.tank.gravity / scene.tank.length)
    np.testing.assert_allclose(omega, COMPUTED[name]["omega"], rtol=1e-12)
