"""A mesh spread over processes is the same domain: liquids, groups, curved cells, both sides of what is cut open."""

from __future__ import annotations

from math import pi, radians

import numpy as np
import pytest
import ufl
from dolfinx import fem
from mpi4py import MPI
from outlines import FLOAT, INTERFACE, LOWER, UPPER, Circle, circle_tank, thin_float_tank, two_liquids

from hydroelastic.meshes.build import build_mesh
from hydroelastic.meshes.compat import coordinate_degree
from hydroelastic.meshes.distribute import TankMesh, bisected, distribute_mesh
from hydroelastic.meshes.geometry import BOTTOM
from hydroelastic.meshes.outline import Outline

pytestmark = pytest.mark.mpi

COMM = MPI.COMM_WORLD


def spread(outline: Outline, degree: int = 1) -> TankMesh:
    return distribute_mesh(COMM, build_mesh(outline, bulk_size=0.2, geometry_degree=degree) if COMM.rank == 0 else None)


def integral(form: ufl.Form) -> float:
    return float(COMM.allreduce(fem.assemble_scalar(fem.form(form)), op=MPI.SUM))


def cell_measure(tank: TankMesh, name: str) -> ufl.Measure:
    return ufl.Measure("dx", tank.mesh, subdomain_data=tank.cell_tags)(tank.cell_names[name])


def facet_measure(tank: TankMesh, name: str) -> ufl.Measure:
    return ufl.Measure("ds", tank.mesh, subdomain_data=tank.facet_tags)(tank.facet_names[name])


def test_parts_for_processes_are_boxes_of_as_many_places() -> None:
    places = np.random.default_rng(0).uniform(size=(1000, 3)) * [4.0, 1.0, 1.0]
    for parts in (1, 2, 7, 64):
        part_of = bisected(places, parts)
        counts = np.bincount(part_of, minlength=parts)
        assert len(counts) == parts
        # Each of ⌈log₂ 64⌉ = 6 divisions rounds once.
        assert counts.max() - counts.min() <= 6
        corners = np.array([[own.min(axis=0), own.max(axis=0)] for own in (places[part_of == n] for n in range(parts))])
        # Boxes that do not overlap have less volume than all places together.
        assert np.ptp(corners, axis=1).prod(axis=1).sum() <= 4.0
    assert np.all(np.diff(places[np.lexsort((places[:, 0], bisected(places, 2)))][:, 0]) > 0.0), "not along the longest"
    assert len(bisected(places[:0], 3)) == 0


def test_each_liquid_has_its_area_and_moments() -> None:
    circle = Circle(centre=0.4, contact_angle=radians(70))
    tank = spread(circle_tank(circle), degree=6)
    one = fem.Constant(tank.mesh, 1.0)
    x = ufl.SpatialCoordinate(tank.mesh)
    lower, upper = (cell_measure(tank, name) for name in (LOWER, UPPER))
    # Of degree 6 at 30 degrees the boundary is right to 1e-9 and areas, of order 12, to rounding.
    assert integral(one * lower) == pytest.approx(0.4 - circle.immersed, rel=1e-12)
    assert integral(one * upper) == pytest.approx(0.3 - (circle.area - circle.immersed), rel=1e-12)
    # The circle's centroid is its centre; the two rectangles have theirs at (0.5, -0.2) and (0.5, 0.15).
    whole = [integral(x[axis] * lower) + integral(x[axis] * upper) for axis in range(2)]
    assert whole[0] == pytest.approx(0.7 * 0.5 - circle.area * circle.centre, rel=1e-12)
    assert whole[1] == pytest.approx(-0.4 * 0.2 + 0.3 * 0.15 - circle.area * circle.height, rel=1e-11)


def test_normals_of_a_float_point_into_it_and_close() -> None:
    circle = Circle(contact_angle=radians(120))
    tank = spread(circle_tank(circle), degree=6)
    normal, x = ufl.FacetNormal(tank.mesh), ufl.SpatialCoordinate(tank.mesh)
    around = facet_measure(tank, FLOAT)
    assert integral(fem.Constant(tank.mesh, 1.0) * around) == pytest.approx(2.0 * pi * circle.radius, rel=1e-11)
    assert integral(ufl.dot(normal, x) * around) == pytest.approx(-2.0 * circle.area, rel=1e-11)
    assert [integral(normal[axis] * around) for axis in range(2)] == pytest.approx([0.0, 0.0], abs=1e-13)


@pytest.mark.slow_but("3")
@pytest.mark.parametrize("degree", [1, 2, 3, 5])
def test_every_degree_of_geometry_keeps_straight_parts(degree: int) -> None:
    """Shared nodes are numbered once and in the right order: a wrong one would fold cells."""
    tank = spread(circle_tank(Circle()), degree)
    one = fem.Constant(tank.mesh, 1.0)
    assert coordinate_degree(tank.mesh) == degree
    assert integral(one * facet_measure(tank, BOTTOM)) == pytest.approx(1.0, rel=1e-14)
    assert integral(one * facet_measure(tank, INTERFACE)) == pytest.approx(1.6, rel=1e-13)
    jacobian = ufl.JacobianDeterminant(tank.mesh)
    # Signs agree everywhere: the areas of both signs are all or nothing.
    areas = [integral(ufl.conditional(ufl.gt(sign * jacobian, 0.0), one, 0.0 * one) * ufl.dx) for sign in (1.0, -1.0)]
    assert min(areas) == 0.0


def test_interfaces_have_a_facet_on_either_side() -> None:
    tank = spread(two_liquids(left=[(0.3, INTERFACE), (0.7, "body_1"), (1.0, INTERFACE)]))
    normal = ufl.FacetNormal(tank.mesh)
    for name, length in ((INTERFACE, 0.6), ("body_1", 0.4)):
        up, down = (
            integral(ufl.conditional(ufl.gt(sign * normal[1], 0.0), 1.0, 0.0) * facet_measure(tank, name))
            for sign in (1.0, -1.0)
        )
        assert up == pytest.approx(length, rel=1e-13)
        assert down == pytest.approx(length, rel=1e-13)


def test_a_slit_has_a_facet_on_either_side_and_liquids_join_beyond_it() -> None:
    tank = spread(thin_float_tank(height=0.2, position=0.4))
    normal, x = ufl.FacetNormal(tank.mesh), ufl.SpatialCoordinate(tank.mesh)
    along = facet_measure(tank, FLOAT)
    assert integral(ufl.conditional(ufl.gt(normal[0], 0.0), 1.0, 0.0) * along) == pytest.approx(0.4, rel=1e-13)
    assert integral(ufl.conditional(ufl.lt(normal[0], 0.0), 1.0, 0.0) * along) == pytest.approx(0.4, rel=1e-13)
    assert integral(x[0] * normal[0] * along) == pytest.approx(0.0, abs=1e-15)
    # On all outer boundaries ∮ x·n = 2 area: no facet is missing, and none of the inner lines is one.
    assert integral(ufl.dot(x, normal) * ufl.ds(domain=tank.mesh)) == pytest.approx(2.0 * 0.7, rel=1e-13)


def test_cells_are_told_apart_by_liquid_on_every_process() -> None:
    outline = circle_tank(Circle())
    tagged = build_mesh(outline, bulk_size=0.2)
    tank = spread(outline)
    own = tank.mesh.topology.index_map(2).size_local
    lower, upper = tank.cells(LOWER), tank.cells(UPPER)
    assert np.array_equal(np.sort(np.concatenate([lower, upper])), np.arange(own))
    counts = [COMM.allreduce(len(cells), op=MPI.SUM) for cells in (lower, upper)]
    assert counts == [int(np.sum(tagged.cell_tags == tagged.cell_names[name])) for name in (LOWER, UPPER)]
