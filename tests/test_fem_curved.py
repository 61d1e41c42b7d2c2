"""Curved cells at floats: normals, measures, Laplace's equation beside a circle, and motions far above the waves."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from math import exp, pi
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from layered_tanks import PlainProblem, layered, pencils, rigid
from mpi4py import MPI
from scipy.sparse.linalg import splu
from scipy.special import ellipe, i1

from hydroelastic.fem.added_mass import body_added_mass
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.shape_loads import shape_loads, surface_load
from hydroelastic.fem.stopwatch import Stopwatch
from hydroelastic.fem.surfaces import Body
from hydroelastic.fem.tank.error_estimates import boundary_error
from hydroelastic.fem.tank.field_model import build_field_model, build_mesh, distributed_mesh
from hydroelastic.fem.tank.field_solution import solve_field
from hydroelastic.fem.tank.infinite_frequency import InfiniteFrequencyAddedMass, infinite_frequency_limit
from hydroelastic.fem.tank.mesh import graded_outline
from hydroelastic.fem.tank.resolution import infinite_frequency_resolution, initial_resolution
from hydroelastic.meshes.build import build_mesh as build_tagged_mesh
from hydroelastic.meshes.geometry import BOTTOM, FREE_SURFACE, INTERFACE, LEFT_WALL, RIGHT_WALL
from hydroelastic.modal.floats.rigid_limits import half_immersed_ellipse, interface_ellipse, section_heave_added_mass
from hydroelastic.physics.dofs import Dof
from hydroelastic.physics.profiles import float_profile
from hydroelastic.physics.tank import Tank
from hydroelastic.scenes.models.bodies import Beam, Float
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.tank import TankScene

FOLDER = Path(__file__).parent / "reference"
FLOATS: dict[str, Any] = json.loads((FOLDER / "floats.json").read_text(encoding="utf-8"))["cases"]
PUBLIC: list[dict[str, Any]] = json.loads((FOLDER / "two_fluid_float.json").read_text(encoding="utf-8"))["cases"]

SHIP = ((-0.12, -0.03), (-0.08, -0.08), (0.05, -0.08), (0.11, -0.02), (0.12, 0.06), (-0.12, 0.06))
SIDES = tuple(zip(SHIP, (*SHIP[1:], SHIP[0]), strict=True))
SECTIONS: dict[str, tuple[Float, float]] = {
    "circle": (rigid("ellipse", 0.4, half_width=0.1, half_height=0.1), pi * 0.01),
    "ellipse": (rigid("ellipse", 0.4, half_width=0.1, half_height=0.04), pi * 0.004),
    "sunken ellipse": (rigid("ellipse", 0.4, half_width=0.1, half_height=0.1, mass=30.0), pi * 0.01),
    "parabola": (rigid("parabola", 0.4, half_width=0.05, half_height=0.1), 8.0 / 3.0 * 0.005),
    "exponential": (rigid("exponential", 0.4, half_width=0.05, half_height=0.02, tail=0.1), 0.0),
    "ship": (rigid("polygon", 0.4, vertices=SHIP), 0.5 * sum(a * d - b * c for (a, b), (c, d) in SIDES)),
}
SECTIONS["exponential"] = (
    SECTIONS["exponential"][0],
    # 4 l/μ ∫₀^{ln 1/t} (e^{−s} − t)/(1 − t) ds
    4.0 * 0.05 * 0.02 * (0.9 - 0.1 * np.log(10.0)) / 0.9,
)


def moments(pencil: CoupledPencil, values: Callable[[np.ndarray, np.ndarray], np.ndarray]) -> float:
    """∫f over the float's wetted contour, from its load on ψ = 1 (collective)."""
    one = np.zeros(1)
    body = Body(
        surface="body_1",
        shapes=lambda points, normals: values(points, normals)[None],
        wavenumber=0.0,
        dofs=(Dof("heave"),),
        parities=("symmetric",),
        motions=np.eye(1),
        stiffness=one,
        bending_stiffness=one,
        mass=np.diag(one),
    )
    return float(pencil.liquid.tank.mesh.comm.allreduce(shape_loads(pencil.liquid, body).sum()))


@pytest.mark.slow_but("ship")
@pytest.mark.slow_on_ranks_but("ship")
@pytest.mark.mpi
@pytest.mark.parametrize("name", SECTIONS)
def test_normals_of_a_contour_close_and_hold_its_area(name: str) -> None:
    """∮n ds = 0 and ∮x·n ds = −2 area, n out of the liquids and into the float."""
    floating, area = SECTIONS[name]
    (pencil,) = pencils(layered(floating), coarse=False)
    perimeter = moments(pencil, lambda points, _normals: np.ones(points.shape[1]))
    # Rings at corners put nodes on the contour to rounding of the tank's length; measured 1e-12 of the perimeter.
    for axis in (0, 1):
        total = moments(pencil, lambda _points, normals, axis=axis: normals[axis])
        assert abs(total) <= 1e-11 * perimeter
    twice = moments(pencil, lambda points, normals: (points * normals).sum(axis=0))
    assert -0.5 * twice == pytest.approx(area, rel=1e-11)


@pytest.mark.mpi
def test_measures_of_surfaces_and_contours_are_exact() -> None:
    floating = SECTIONS["ellipse"][0]
    (pencil,) = pencils(layered(floating, top="free"), coarse=False)
    comm = pencil.liquid.tank.mesh.comm
    # The interface has a side in either liquid.
    for name, expected in ((INTERFACE, 2.0 * 0.8), (FREE_SURFACE, 1.0), ("body_1", 4.0 * 0.1 * ellipe(1.0 - 0.16))):
        assert comm.allreduce(surface_load(pencil.liquid, (name,)).sum()) == pytest.approx(expected, rel=1e-11)


@pytest.mark.slow_but("beside a circle-0.333-0.1")
@pytest.mark.slow_on_ranks_but("beside a circle-0.333-0.1")
@pytest.mark.mpi
@pytest.mark.parametrize(("position", "half_height"), [(0.333, 0.1), (0.4123, 0.0771), (0.29, 0.1234)])
@pytest.mark.parametrize("beside", [False, True], ids=["alone", "beside a circle"])
def test_the_flux_of_a_thin_ellipse_displaces_its_width(beside: bool, position: float, half_height: float) -> None:
    """∫ω' dy = 2b in each liquid, where ω' has no bound: on the curved cells that a float beside it brings, too.

    The end of the ellipse is known to a unit of the last place δ: an error of √δ, 1e-8, of what is clustered at it.
    """
    width = 0.05
    circle = (rigid("ellipse", 0.7, half_width=0.1, half_height=0.1),) if beside else ()
    thin = rigid("ellipse", position, half_width=0.5 * width, half_height=half_height, boundary="thin")
    (pencil,) = pencils(layered(thin, *circle, top="free"), coarse=False)
    for constraint, sign in zip(pencil.constraints, (1.0, -1.0), strict=True):
        taken = pencil.body_values(constraint.volume)
        # Measured 1e-10 alone, 4e-10 beside a circle.
        assert sign * taken[0] == pytest.approx(width, rel=5e-9)


RADIUS, CENTRE, DEPTH, GROWTH = 0.15, 0.4, 0.5, 3.0


def neumann_energy(degree: int) -> float:
    """∫|∇ψ|² of the ψ whose normal derivative on all of the boundary is that of Re e^{kz}, beside a half-immersed
    circle; the geometry has the degree of ψ."""
    scene = layered(
        rigid("ellipse", CENTRE, half_width=RADIUS, half_height=RADIUS),
        densities=(1000.0,),
        depths=(DEPTH,),
        top="free",
    )
    tank = physical_tank(scene).scaled()
    resolution = replace(
        initial_resolution(tank, scene.accuracy.tolerance, modes=6),
        degree=degree,
        tip_size=None,
    )
    mesh = build_mesh(MPI.COMM_WORLD, tank, resolution)
    pencil = build_field_model(mesh, tank, degree=degree, shapes=(0,))

    def flux(points: np.ndarray, normals: np.ndarray) -> np.ndarray:
        x, y = GROWTH * points[:, None]
        return GROWTH * np.exp(x) * (np.cos(y) * normals[0] - np.sin(y) * normals[1])

    zero = np.zeros(1)
    given = {"shapes": flux, "wavenumber": 0.0, "dofs": (Dof("heave"),), "parities": ("symmetric",)}
    given |= {"motions": np.eye(1), "stiffness": zero, "bending_stiffness": zero, "mass": np.diag(zero)}
    load = sum(
        shape_loads(pencil.liquid, Body(surface=name, **given))[0]
        for name in ("body_1", FREE_SURFACE, BOTTOM, LEFT_WALL, RIGHT_WALL)
    )
    # The net flux is zero; one unknown is held.
    laplace = PlainProblem(pencil).laplace[1:][:, 1:]
    return float(load[1:] @ splu(laplace.tocsc()).solve(load[1:]))


@pytest.mark.slow
def test_the_energy_of_a_harmonic_function_beside_a_circle_converges_exponentially() -> None:
    """∫k² e^{2kx} over the rectangle less half a disc, for which ∫e^{sx} = πR I₁(sR)/s."""
    k = GROWTH
    whole = DEPTH * k / 2.0 * (exp(2.0 * k) - 1.0)
    half_disc = k**2 * exp(2.0 * k * CENTRE) * pi * RADIUS * float(i1(2.0 * k * RADIUS)) / (2.0 * k)
    errors = np.array([abs(neumann_energy(degree) / (whole - half_disc) - 1.0) for degree in range(1, 9)])
    # Each degree gains a factor of ten and more; the last ones reach rounding, 1e-13.
    assert errors[0] > 1e-3
    assert np.all(errors[1:] <= np.maximum(0.3 * errors[:-1], 1e-12))
    assert errors[-1] <= 1e-12


@pytest.mark.slow_but("circle_off_centre")
@pytest.mark.parametrize("name", ["circle", "circle_off_centre", "two_liquids_parabola"])
def test_frequencies_converge_with_the_degree_of_the_geometry(name: str) -> None:
    """ψ of degree 9 on cells of degree 1, 2, 3, 5, 8: errors fall until those of ψ and of the reference are left."""
    case = FLOATS[name]
    omega = np.array([float(text) for text in case["omega"]])
    scene = TankScene.model_validate(case["scene"] | {"accuracy": {"tolerance": 1e-8, "modes": len(omega)}})
    tank = physical_tank(scene).scaled()
    resolution = replace(initial_resolution(tank, scene.accuracy.tolerance, modes=len(omega)), degree=9)
    half = name != "circle_off_centre"
    errors = []
    for geometry_degree in (1, 2, 3, 5, 8):
        mesh = distributed_mesh(
            MPI.COMM_WORLD,
            lambda degree=geometry_degree: build_tagged_mesh(
                graded_outline(tank, resolution, half=half, infinite_frequency=False),
                bulk_size=resolution.bulk_size,
                ring_ratio=resolution.ring_ratio,
                geometry_degree=degree,
            ),
        )
        field = solve_field(mesh, tank, resolution, len(omega), Stopwatch(), half=half)
        found = np.sqrt(field.modes.eigenvalues) * np.sqrt(scene.tank.gravity / scene.tank.length)
        errors.append(float(np.abs(found / omega - 1.0).max()))
        # An upper estimate, measured up to 1.3 times too small (circle off the centre, degree 2); and what degree 9 and
        # the reference's ten digits leave.
        assert errors[-1] <= 2.0 * boundary_error(mesh, tank) + 2e-10
    assert errors[0] > 1e-5
    for coarse, fine in pairwise(errors):
        assert fine <= max(0.3 * coarse, 2e-10)


# Far above the waves: added mass in the limit of an unbounded liquid.

LENGTHS = (500.0, 1000.0)


def added_mass(comm: MPI.Comm, tank: Tank, tolerance: float, *, half: bool) -> InfiniteFrequencyAddedMass:
    first = infinite_frequency_resolution(tank, tolerance, ())
    found = infinite_frequency_limit(comm, tank, first, tolerance, Stopwatch(), half=half).added_mass
    assert found is not None
    return found


def above_the_waves(length: float, *bodies: Float, densities: tuple[float, ...]) -> InfiniteFrequencyAddedMass:
    scene = layered(
        *bodies,
        densities=densities,
        depths=(0.5 * length,) * len(densities),
        length=length,
        top="free" if len(densities) == 1 else "rigid",
    )
    return added_mass(MPI.COMM_WORLD, physical_tank(scene).scaled(), 1e-9, half=True)


def unbounded(shape: str, densities: tuple[float, ...], motions: str = "heave", **keys: Any) -> np.ndarray:
    """Added-mass matrix of a float, kg/m, kg and kg·m, in the limit of a long and deep tank.

    Images in the walls add a part proportional to (R/L)², which two lengths take away; the next is 1e-11.
    """
    found = []
    for length in LENGTHS:
        body = rigid(shape, 0.5 * length, motions, unstable="solve", **keys)
        added = above_the_waves(length, body, densities=densities)
        assert added.error <= 1e-9
        powers = np.array([1.0 if motion == "roll" else 0.0 for motion in ("heave", "sway", "roll")])
        powers = powers[: len(body.motions)]
        found.append(added.matrix * densities[0] * length ** (2.0 + powers[:, None] + powers))
    return found[1] + (found[1] - found[0]) / 3.0


@pytest.mark.slow_but("2.0-1.0-one")
@pytest.mark.parametrize("densities", [(1000.0,), (1000.0, 800.0), (1000.0, 999.0)], ids=["one", "two", "close"])
@pytest.mark.parametrize(("half_width", "half_height"), [(1.0, 1.0), (2.0, 1.0), (0.1, 1.0)])
def test_ellipses_have_their_added_mass_above_the_waves(
    half_width: float, half_height: float, densities: tuple[float, ...]
) -> None:
    """A circle: π/2 ρR² in heave, 2/π ρR² in sway; the slender one sways like a vertical plate."""
    added = unbounded("ellipse", densities, "heave sway roll", half_width=half_width, half_height=half_height)
    exact = (
        half_immersed_ellipse(half_width, half_height, densities[0])
        if len(densities) == 1
        else interface_ellipse(half_width, half_height, *densities)
    )
    # The asked 1e-9 of either length, and the images' next part.
    assert added[0, 0] == pytest.approx(exact.heave, rel=1e-8)
    assert added[1, 1] == pytest.approx(exact.sway, rel=1e-8)
    # A circle does not turn the liquid; errors of an entry are told in parts of what an ellipse like it would turn.
    turned = sum(densities) * max(half_width, half_height) ** 4
    assert added[2, 2] == pytest.approx(exact.roll, rel=1e-8, abs=1e-9 * turned)
    assert added[1, 2] == pytest.approx(exact.sway_roll, abs=1e-8 * np.sqrt(exact.sway * turned))
    assert np.abs(added[0, 1:]).max() <= 1e-12 * added[0, 0]


@pytest.mark.slow_but("wedge-one")
@pytest.mark.parametrize("densities", [(1000.0,), (1000.0, 800.0)], ids=["one", "two"])
@pytest.mark.parametrize("shape", ["rectangle", "wedge"])
def test_sections_with_corners_have_their_added_mass_above_the_waves(shape: str, densities: tuple[float, ...]) -> None:
    added = unbounded(shape, densities, half_width=1.0, half_height=0.5)
    exact = section_heave_added_mass(float_profile(shape, 1.0, 0.5), *densities)
    assert added[0, 0] == pytest.approx(exact, rel=1e-8)


@pytest.mark.slow
def test_a_thin_float_has_its_added_mass_above_the_waves() -> None:
    (public,) = [case["values"] for case in PUBLIC if case["id"] == "ab_parabola"]
    added = unbounded("parabola", (1000.0, 800.0), half_width=0.1, half_height=1.0, boundary="thin")
    assert added[0, 0] == pytest.approx(1800.0 * 0.01 * float(public["a_hat_inf"]), rel=1e-8)


@pytest.mark.slow
@pytest.mark.parametrize("densities", [(1000.0,), (1000.0, 800.0)], ids=["one", "two"])
def test_a_rigid_plate_has_its_added_mass_above_the_waves(densities: tuple[float, ...]) -> None:
    """π/8 ρl² of each liquid."""
    found = []
    for length in LENGTHS:
        beam = Beam(start=0.5 * length - 1.0, length=2.0, flexural_rigidity=1e6, mass_per_length=1.0)
        depths = (0.5 * length,) * len(densities)
        tank = physical_tank(layered(beam, densities=densities, depths=depths, length=length, top="free")).scaled()
        resolution = infinite_frequency_resolution(tank, 1e-9, (0.0,))
        mesh = build_mesh(MPI.COMM_WORLD, tank, resolution, infinite_frequency=True)
        pencil = build_field_model(mesh, tank, degree=resolution.degree, shapes=(1,), infinite_frequency=True)
        found.append(body_added_mass(pencil)[0, 0] * densities[0] * length**2)
    assert found[1] + (found[1] - found[0]) / 3.0 == pytest.approx(pi / 8.0 * sum(densities) * 4.0, rel=1e-8)


@pytest.mark.slow_on_ranks_but("two")
@pytest.mark.only_on_ranks
@pytest.mark.mpi
@pytest.mark.parametrize("densities", [(1000.0,), (1000.0, 800.0)], ids=["one", "two"])
def test_processes_agree_on_the_added_mass_above_the_waves(densities: tuple[float, ...]) -> None:
    bodies = (
        rigid("ellipse", 0.3, "heave sway roll", half_width=0.1, half_height=0.08),
        rigid("wedge", 0.7, half_width=0.1, half_height=0.1),
    )
    top = "free" if len(densities) == 1 else "rigid"
    tank = physical_tank(layered(*bodies, densities=densities, top=top)).scaled()
    together, alone = (added_mass(comm, tank, 1e-8, half=False).matrix for comm in (MPI.COMM_WORLD, MPI.COMM_SELF))
    assert together == pytest.approx(alone, abs=1e-11 * np.abs(alone).max())
    assert np.array_equal(alone, alone.T)
    assert np.linalg.eigvalsh(alone).min() > 0.0
