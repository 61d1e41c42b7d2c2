"""Resonances far below the axis: H continued by what comes in, against closed forms of thin floats."""

from __future__ import annotations

from math import inf

import numpy as np
import pytest
from mpi4py import MPI
from open_cases import GRAVITY, RADIUS, SLOW, THIN_LIQUIDS, circle, circle_omega, problem_of
from open_tables import open_scene

from hydroelastic.fem.open_water.damped import DampedSolver, mirror_angle
from hydroelastic.fem.open_water.field_model import Band
from hydroelastic.fem.open_water.incident_waves import Plane, Standing
from hydroelastic.fem.open_water.model_building import first_resolution, open_model
from hydroelastic.fem.open_water.requests import ResonanceRequest
from hydroelastic.fem.open_water.resonance import ResonanceSolution, solve_resonance
from hydroelastic.fem.open_water.solve import resonance_reasons
from hydroelastic.fem.open_water.solver import OpenSolver
from hydroelastic.fem.stopwatch import Stopwatch
from hydroelastic.modal.floats.complex_moments import complex_wave_moment
from hydroelastic.modal.floats.infinite_draught import infinite_draught_float
from hydroelastic.modal.floats.thin_float import thin_constants
from hydroelastic.modal.floats.thin_float_radiation import natural_rate
from hydroelastic.modal.liquid.deep_water_wave import DeepWaterWave
from hydroelastic.modal.liquid.travelling_waves import travelling_waves
from hydroelastic.modal.liquid.two_layer import TwoLayers
from hydroelastic.physics.profiles import Profile
from hydroelastic.scenes.models.tank import TankScene

DEEP = THIN_LIQUIDS["deep"]


def exponential(tail: float, tolerance: float) -> TankScene:
    """Between two liquids, as wide as its decay length."""
    body = {"kind": "float", "shape": "exponential", "half_width": RADIUS, "half_height": RADIUS, "tail": tail}
    body |= {"at": "interface", "position": 5.0, "boundary": "thin", "motions": ["heave"]}
    liquids = tuple({"density": rho, "depth": inf} for rho in (DEEP.density_below, DEEP.density_above))
    return open_scene(body, liquids=liquids, analyses=[], accuracy={"tolerance": tolerance})


def damped(scene: TankScene, count: int, comm: MPI.Comm = MPI.COMM_WORLD) -> ResonanceSolution:
    return solve_resonance(problem_of(scene, comm), ResonanceRequest(count=count, largest_damping=2.0))


def closed_form(profile: Profile, start: complex) -> complex:
    """The zero of D(z) of a thin float next to ω, also beyond the 130 degrees of `characteristic`: there R of the
    exponential is still exact, and κ runs below the pole −z² all the same."""
    constants, rate = thin_constants(profile), natural_rate(profile, DEEP)
    step = 0.03
    kappa = np.exp(step * np.arange(-2000, 2000) - 0.25j * np.pi)
    weights = step * kappa * complex_wave_moment(profile, kappa) ** 2

    def value(z: complex) -> complex:
        wave = complex_wave_moment(profile, np.array([-z * z]))[0]
        integral = (weights / (kappa + z * z)).sum() - 2j * np.pi * wave**2
        return complex(z * z * (1.0 + constants.coupling * integral) + constants.frequency_squared)

    z = 1j * (start / rate).conjugate()
    for _ in range(20):
        slope = (value(z * (1.0 + 1e-6)) - value(z * (1.0 - 1e-6))) / (2e-6 * z)
        z -= value(z) / slope
    return complex(1j * z.conjugate()) * rate


def assert_honest(found: ResonanceSolution, profile: Profile) -> None:
    """Measured at tolerances from 1e-3 to 1e-6, errors are 0.4 to 1.2 times the estimate, and far less near the axis,
    where they cancel by chance."""
    table = found.table
    for omega, estimate in zip(table.omega, table.relative_error, strict=True):
        error = abs(omega / closed_form(profile, complex(omega)) - 1.0)
        assert error <= 1.5 * estimate
        assert -omega.imag < 0.7 * omega.real or estimate <= 4.0 * error


@pytest.mark.slow
def test_second_pole_of_the_exponential() -> None:
    tail = 1e-3
    found = damped(exponential(tail, 1e-3), count=6)
    profile = Profile(shape="exponential", half_width=RADIUS, half_height=RADIUS, tail=tail)
    infinite = infinite_draught_float(profile, DEEP)
    heave, second = infinite.resonances
    # The end moves both a little, and adds four that the float of infinite draught has not.
    assert found.table.omega[0] == pytest.approx(second, rel=infinite.cut)
    assert found.table.omega[1] == pytest.approx(heave, rel=infinite.cut)
    assert -found.table.omega[0].imag / found.table.omega[0].real == pytest.approx(1.31, abs=0.01)
    assert found.table.counted == len(found.table.omega) == 6
    assert not list(resonance_reasons(found))
    assert found.table.residuals.max() <= 1e-9
    assert found.error <= 1e-3
    assert_honest(found, profile)


@pytest.mark.slow
def test_search_and_count_agree_on_a_circle() -> None:
    # Its sway has resonances beside those of the water around a circle that is held, poles of H.
    found = damped(circle(1e-4, "heave", "sway"), count=4)
    assert not list(resonance_reasons(found))
    assert found.table.labels == ("heave", "sway", "heave", "sway")
    assert found.table.counted == 5


@SLOW
@pytest.mark.parametrize(("tail", "tolerance"), [(1e-3, 1e-6), (1e-5, 1e-4)])
def test_second_pole_by_tails_and_tolerances(tail: float, tolerance: float) -> None:
    found = damped(exponential(tail, tolerance), count=2)
    profile = Profile(shape="exponential", half_width=RADIUS, half_height=RADIUS, tail=tail)
    infinite = infinite_draught_float(profile, DEEP)
    assert not list(resonance_reasons(found))
    assert found.table.omega[0] == pytest.approx(infinite.resonances[1], rel=infinite.cut)
    assert_honest(found, profile)


def continued(comm: MPI.Comm, omega: complex, tolerance: float) -> tuple[DampedSolver, OpenSolver]:
    """Both solvers of a circle, for frequencies about one."""
    problem = problem_of(circle(tolerance, "heave", "sway"), comm)
    band = Band(lowest=0.8 * abs(omega), highest=1.2 * abs(omega))
    resolution = first_resolution(problem.tank, tolerance, band)
    models = [open_model(problem, band, resolution, angle=angle) for angle in (mirror_angle(1.0), 1.3)]
    return DampedSolver(models[0], Stopwatch()), OpenSolver(models[1], Stopwatch())


@pytest.mark.slow_but("0.2")
@pytest.mark.parametrize("damping", [0.0, 0.2, 0.35])
def test_what_comes_in_tells_what_leaves(damping: float) -> None:
    # A circle scatters waves, a slit none of the even ones.
    omega = circle_omega(1.0) * (1.0 - 1j * damping)
    mirrored, outgoing = continued(MPI.COMM_WORLD, omega, 1e-5)
    squared = mirrored.model.squared_frequency(omega)
    mirrored.radiation(squared)
    outgoing.radiation(squared)
    expected, _ = outgoing.hydrodynamic(squared)
    found, residual = mirrored.hydrodynamic(squared)
    assert residual <= 1e-9
    # Of the tolerance 1e-5.
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-5 * np.abs(expected).max())


@pytest.mark.only_on_ranks
@pytest.mark.mpi
def test_two_processes_continue_the_same() -> None:
    omega = circle_omega(1.0) * (1.0 - 1.2j)
    values = []
    for comm in (MPI.COMM_WORLD, MPI.COMM_SELF):
        solver, _ = continued(comm, omega, 1e-3)
        squared = solver.model.squared_frequency(omega)
        solver.radiation(squared)
        values.append(solver.hydrodynamic(squared)[0])
    np.testing.assert_allclose(values[0], values[1], rtol=0, atol=1e-10 * np.abs(values[1]).max())


@pytest.mark.parametrize("density_above", [0.0, 800.0])
def test_deep_water_waves_are_the_travelling_waves(density_above: float) -> None:
    layers = TwoLayers(density_below=1000.0, density_above=density_above, depth_below=inf, gravity=GRAVITY)
    (wave,) = travelling_waves(layers, 2.0)
    infinite = DeepWaterWave(layers=layers, squared=4.0 + 0.0j)
    assert infinite.wavenumber == pytest.approx(wave.wavenumber, rel=1e-13)
    assert infinite.energy == pytest.approx(wave.energy, rel=1e-13)
    places = np.random.default_rng(2).uniform(-1.0, 1.0, (5, 2))
    above = (places[:, 1] > 0.0).astype(int) * (density_above > 0.0)
    right, left = (Plane(wave=wave, direction=way).field(places - [0.5, 0.0], above) for way in (1, -1))
    for odd, sign in ((False, 1.0), (True, -1.0)):
        standing = Standing(wave=infinite, odd=odd).field(places, above)
        for own, one, other in zip(standing, right, left, strict=True):
            inside = above == (places[:, 1] > 0.0)
            np.testing.assert_allclose(own[inside], ((one + sign * other) / np.sqrt(2.0))[inside], rtol=1e-12)


def test_damping_beyond_that_of_a_bed_is_refused() -> None:
    scene = {"analyses": [{"kind": "resonance", "largest_damping": 1.5}]}
    with pytest.raises(ValueError, match="computed in infinite depths only"):
        open_scene(liquids=({"density": 1000.0, "depth": 2.0},), **scene)
    assert open_scene(**scene).analyses[0].largest_damping == 1.5
