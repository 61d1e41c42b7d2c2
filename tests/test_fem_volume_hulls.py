"""Floats of volumes from files, as triangles and as solids, and revolved outlines: rest, hydrostatics and modes."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from itertools import pairwise
from pathlib import Path

import gmsh
import numpy as np
import pytest
from mpi4py import MPI

from hydroelastic.fem.facets import facet_groups
from hydroelastic.fem.liquid import liquid_space
from hydroelastic.fem.plan.classes import solve_classes
from hydroelastic.fem.shape_loads import facet_quadrature
from hydroelastic.fem.volume.floats import float_body
from hydroelastic.fem.volume.model import VolumeModel, volume_mirrors
from hydroelastic.fem.volume.resolution import VolumeResolution
from hydroelastic.fem.volume.solve import direct_or_multigrid, distributed_volume, solve_volume
from hydroelastic.meshes.filling import gmsh_model
from hydroelastic.meshes.hull_file import wetted_hull
from hydroelastic.meshes.tagged_mesh import MeshError
from hydroelastic.meshes.volume import VolumeSizes, volume_mesh
from hydroelastic.physics.level_tank import Box
from hydroelastic.physics.solid_floats import RIGID_MOTIONS, SolidFloat
from hydroelastic.physics.volume_tank import VolumeTank
from hydroelastic.physics.wetted_hulls import Hydrostatics, Triangles, hydrostatics_of_surface

AXES = (2.0, 0.8, 0.6)
"""Half axes of the ellipsoid, m, whose middle is at the still level."""


def ellipsoid_triangles(around: int, shift: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> np.ndarray:
    """Triangles with corners on an ellipsoid, those without an area left out, shape (triangles, 3, 3)."""
    polar, turn = np.linspace(0.0, np.pi, around // 2 + 1), np.linspace(0.0, 2.0 * np.pi, around + 1)
    x, y, z = (
        axis * values + moved
        for axis, values, moved in zip(
            AXES,
            (
                np.repeat(np.cos(polar)[:, None], around + 1, axis=1),
                np.outer(np.sin(polar), np.cos(turn)),
                np.outer(np.sin(polar), np.sin(turn)),
            ),
            shift,
            strict=True,
        )
    )
    corners = np.stack([x, y, z], axis=2)
    one, two, three, four = corners[:-1, :-1], corners[1:, :-1], corners[1:, 1:], corners[:-1, 1:]
    parts = [np.stack(part, axis=2).reshape(-1, 3, 3) for part in ((one, two, three), (one, three, four))]
    triangles = np.concatenate(parts)
    sides = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    return np.asarray(triangles[np.linalg.norm(sides, axis=1) > 1e-12])


def ellipsoid_file(folder: Path, around: int, shift: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Path:
    return written(folder / f"ellipsoid_{around}.stl", ellipsoid_triangles(around, shift))


def written(file: Path, triangles: np.ndarray) -> Path:
    facets = (
        "facet normal 0 0 0\nouter loop\n"
        + "".join("vertex {:.9g} {:.9g} {:.9g}\n".format(*corner) for corner in triangle)
        + "endloop\nendfacet\n"
        for triangle in triangles
    )
    file.write_text(f"solid hull\n{''.join(facets)}endsolid hull\n", encoding="ascii")
    return file


def solid_file(folder: Path, name: str, *, box: tuple[float, float, float] | None = None) -> Path:
    """The ellipsoid, or a box of twice its draught beside the origin, as a solid of CAD or its triangles."""
    file = folder / name
    with gmsh_model():
        occ = gmsh.model.occ
        if box is None:
            occ.addSphere(0.0, 0.0, 0.0, 1.0)
            occ.dilate([(3, 1)], 0.0, 0.0, 0.0, *AXES)
        else:
            along, across, depth = box
            occ.addBox(0.3 - 0.5 * along, -0.2 - 0.5 * across, -depth, along, across, 2.0 * depth)
        occ.synchronize()
        gmsh.option.setString("Geometry.OCCTargetUnit", "M")
        if name.endswith(".stl"):
            gmsh.model.mesh.generate(2)
        gmsh.write(str(file))
    return file


def hull_float(file: Path, middle: tuple[float, float], draught: float | None = None) -> SolidFloat:
    hull = wetted_hull(file, draught=draught)
    (x, y), (low, high) = hull.hydrostatics.axis, (hull.low, hull.high)
    return SolidFloat(
        shape="hull",
        size=(high[0] - low[0], high[1] - low[1]),
        draught=-low[2],
        position=(middle[0] + x, middle[1] + y),
        centre_of_gravity=-0.05,
        gyration=(0.4, 0.9, 1.0),
        motions=RIGID_MOTIONS,
        hull=hull,
    )


PYRAMID = Triangles(
    points=np.array([[0.0, 0.0, 0.0], [3.0, -3.0, 3.0], [3.0, 3.0, 3.0], [-3.0, 3.0, 3.0], [-3.0, -3.0, 3.0]]),
    corners=np.array([[0, 2, 1], [0, 3, 2], [0, 4, 3], [0, 1, 4], [1, 2, 3], [1, 3, 4]]),
)
"""It stands on its tip, with a base of 6 m at 3 m above it."""


def test_triangles_are_cut_where_they_cross_the_level() -> None:
    wetted = PYRAMID.below(1.0)
    wetted.require_closed()
    found = wetted.hydrostatics()
    # A base of 2 m at a height of 1 m; rounding.
    assert found.volume == pytest.approx(4.0 / 3.0, rel=1e-12)
    assert found.buoyancy == pytest.approx(-0.25, rel=1e-12)
    assert found.waterplane == pytest.approx(4.0, rel=1e-12)
    assert found.second == pytest.approx((4.0 / 3.0, 4.0 / 3.0), rel=1e-12)


BASIN = VolumeTank(plan=Box(length=10.0, width=6.0), depth=2.5, density=1000.0, gravity=9.81)


def half_ellipsoid() -> Hydrostatics:
    a, b, c = AXES
    return Hydrostatics(
        volume=2.0 / 3.0 * np.pi * a * b * c,
        buoyancy=-0.375 * c,
        waterplane=np.pi * a * b,
        second=(0.25 * np.pi * a * b**3, 0.25 * np.pi * a**3 * b),
    )


def differences(found: Hydrostatics, exact: Hydrostatics) -> list[float]:
    return [
        found.volume / exact.volume - 1.0,
        found.buoyancy / exact.buoyancy - 1.0,
        found.waterplane / exact.waterplane - 1.0,
        found.second[0] / exact.second[0] - 1.0,
        found.second[1] / exact.second[1] - 1.0,
    ]


def test_hydrostatics_of_triangles_converge_like_their_chords(tmp_path: Path) -> None:
    exact = half_ellipsoid()
    errors = []
    for around in (12, 24, 48):
        # Its origin is elsewhere, and the file lies deeper than its still level.
        file = ellipsoid_file(tmp_path, around, shift=(0.5, -0.3, 0.2))
        found = wetted_hull(file, draught=AXES[2]).hydrostatics
        assert found.axis == pytest.approx((0.5, -0.3), abs=1e-6)
        assert (*found.first, found.product) == pytest.approx((0.0, 0.0, 0.0), abs=1e-5)
        errors.append(max(map(abs, differences(found, exact))))
        # Of the chord, 1 − cos(π/n); areas and moments lack up to five times as much.
        assert errors[-1] < 5.0 * (1.0 - np.cos(np.pi / around))
    assert all(np.log2(one / other) == pytest.approx(2.0, abs=0.15) for one, other in pairwise(errors)), errors


def test_a_mass_immerses_a_hull_to_its_volume(tmp_path: Path) -> None:
    file = ellipsoid_file(tmp_path, 40)
    hull = wetted_hull(file, volume=1.0)
    assert hull.hydrostatics.volume == pytest.approx(1.0, rel=1e-6)
    # Of an ellipsoid of height 2c filled to h: V = πab/c² · (c h² − h³/3).
    a, b, c = AXES
    height = hull.level + c
    assert np.pi * a * b / c**2 * (c * height**2 - height**3 / 3.0) == pytest.approx(1.0, rel=2e-2)
    with pytest.raises(MeshError, match="displaces 9 m³ at no level"):
        wetted_hull(file, volume=9.0)


def test_a_surface_that_is_no_body_is_refused(tmp_path: Path) -> None:
    triangles = ellipsoid_triangles(20)
    lowest = np.argsort(triangles[:, :, 2].mean(axis=1))
    # Open above the still level it is a hull.
    whole = wetted_hull(written(tmp_path / "open.stl", triangles[triangles[:, :, 2].min(axis=1) < 1e-9])).hydrostatics
    assert whole.volume == pytest.approx(wetted_hull(ellipsoid_file(tmp_path, 20)).hydrostatics.volume, rel=1e-6)
    with pytest.raises(MeshError, match="is not closed: 3 of its edges below the still level have one triangle"):
        wetted_hull(written(tmp_path / "hole.stl", np.delete(triangles, lowest[3], axis=0)))
    turned = triangles.copy()
    turned[lowest[3]] = turned[lowest[3], ::-1]
    with pytest.raises(MeshError, match="has neighbours that are not turned alike at 3 edges"):
        wetted_hull(written(tmp_path / "turned.stl", turned))
    with pytest.raises(MeshError, match="is not between its lowest and highest point"):
        wetted_hull(tmp_path / "ellipsoid_20.stl", draught=3.0)


def of_wetted_faces(tank: VolumeTank, sizes: VolumeSizes) -> Hydrostatics:
    """By the divergence theorem over the faces of a mesh."""
    mesh, _ = distributed_volume(tank, sizes, (None, None), MPI.COMM_SELF)
    liquid = liquid_space(mesh, 2)
    points, areas = [], []
    for group in facet_groups(liquid, "body_1"):
        quadrature = facet_quadrature(liquid, group, 1.0, -1)
        points.append(quadrature.points.T)
        # Out of the liquid is into the body.
        areas.append(-(quadrature.normals * quadrature.weights.ravel()).T)
    return hydrostatics_of_surface(np.concatenate(points), np.concatenate(areas))


def test_wetted_faces_of_a_hull_have_its_hydrostatics(tmp_path: Path) -> None:
    """Of a solid box beside the middle, of its triangles, and of a revolved outline, each in its place."""
    box = (2.0, 1.4, 0.6)
    wedge = ((0.0, -0.5), (0.6, -0.5), (0.9, 0.4), (0.0, 0.4))
    outline = SolidFloat(
        shape="revolved",
        size=(1.6, 1.6),
        draught=0.5,
        position=(4.0, 3.5),
        centre_of_gravity=-0.05,
        gyration=(0.4, 0.9, 1.0),
        motions=RIGID_MOTIONS[:5],
        outline=wedge,
    )
    hulls = [hull_float(solid_file(tmp_path, name, box=box), (3.7, 3.7)) for name in ("box.step", "box.stl")]
    for solid, degree, tolerance in ((hulls[0], 1, 1e-9), (hulls[1], 1, 1e-9), (outline, 4, 1e-5)):
        sizes = VolumeSizes(edge=0.3, bulk=0.3, geometry=degree)
        found = of_wetted_faces(replace(BASIN, floats=(solid,)).scaled(), sizes)
        exact = replace(BASIN, floats=(solid,)).scaled().floats[0]
        assert differences(found, exact.hydrostatics) == pytest.approx([0.0] * 5, abs=tolerance)
        assert found.axis == pytest.approx(exact.position, abs=tolerance)
        assert np.array(exact.position) * 10.0 == pytest.approx((4.0, 3.5), abs=1e-9)
    # A frustum of a cone: π h (R² + Rr + r²)/3, with the waterline of radius 0.6 + 0.5 · 0.3/0.9.
    radius = 0.6 + 0.5 / 3.0
    assert outline.hydrostatics.volume == pytest.approx(np.pi * 0.5 / 3.0 * (0.36 + 0.6 * radius + radius**2))
    assert outline.hydrostatics.waterplane == pytest.approx(np.pi * radius**2)
    # In the plane through x a hull of CAD is known to be symmetric; of triangles that is not asked.
    assert hulls[0].hull is not None
    assert hulls[0].hull.symmetric == (True, True)
    middle = replace(BASIN, floats=(replace(hulls[1], position=(5.0, 3.0)),)).scaled()
    assert volume_mirrors(middle) == (None, None)


def eigenvalues(tank: VolumeTank, sizes: VolumeSizes, degree: int, count: int) -> np.ndarray:
    resolution = VolumeResolution(degree=degree, sizes=sizes, polynomials=())
    mesh, _ = distributed_volume(tank.scaled(), sizes, (None, None), MPI.COMM_SELF)
    model = VolumeModel(tank=tank.scaled(), resolution=resolution, mesh=mesh, mirrors=(None, None))
    return solve_classes(model.pencils(partial(direct_or_multigrid, tolerance=1e-6)), count, 1e-6).eigenvalues


@pytest.mark.slow
def test_a_box_of_triangles_has_the_modes_of_the_box(tmp_path: Path) -> None:
    box = (2.0, 1.4, 0.6)
    shaped = SolidFloat(
        shape="box",
        size=box[:2],
        draught=box[2],
        position=(4.0, 3.5),
        centre_of_gravity=-0.05,
        gyration=(0.4, 0.9, 1.0),
        motions=RIGID_MOTIONS,
    )
    sizes = VolumeSizes(edge=0.02, bulk=0.2, geometry=1)
    values = [
        eigenvalues(replace(BASIN, floats=(solid,)), sizes, 2, 8)
        for solid in (shaped, hull_float(solid_file(tmp_path, "box.stl", box=box), (3.7, 3.7)))
    ]
    # Two meshes of equal sizes, of which each has an error of 1 % by the corners: measured 7e-3, of most modes 1e-3.
    assert values[0] == pytest.approx(values[1], rel=1.5e-2)
    assert np.median(np.abs(values[0] / values[1] - 1.0)) < 2e-3


@pytest.mark.slow
def test_a_hull_of_triangles_converges_to_the_solid(tmp_path: Path) -> None:
    """The frequencies of an ellipsoid by its triangles, against those of the same hull from CAD."""
    exact = eigenvalues(
        replace(BASIN, floats=(hull_float(solid_file(tmp_path, "hull.step"), (5.0, 3.0)),)),
        VolumeSizes(edge=0.05, bulk=0.2, geometry=4, around=24),
        4,
        8,
    )
    errors = []
    for around in (12, 24, 48):
        hull = hull_float(ellipsoid_file(tmp_path, around), (5.0, 3.0))
        found = eigenvalues(
            replace(BASIN, floats=(hull,)), VolumeSizes(edge=0.05, bulk=0.2, geometry=1, around=64), 4, 8
        )
        errors.append(float(np.abs(0.5 * (found / exact - 1.0)).max()))
        # Of the chord, 1 − cos(π/n); measured 0.1 times.
        assert errors[-1] < 0.15 * (1.0 - np.cos(np.pi / around))
    # Chords fall with the square of their number; the mesh's own, of 64 around, are left at the end.
    assert errors[0] / errors[1] > 3.0
    assert errors[1] / errors[2] > 2.5


@pytest.mark.slow
def test_a_revolved_rectangle_is_a_cylinder() -> None:
    cylinder = SolidFloat(
        shape="cylinder",
        size=(2.4, 2.4),
        draught=0.7,
        position=(5.0, 3.0),
        centre_of_gravity=-0.05,
        gyration=(0.5, 0.5, 1.0),
        motions=RIGID_MOTIONS[:5],
    )
    corners = ((0.0, -0.7), (1.2, -0.7), (1.2, 0.5), (0.0, 0.5))
    values = [
        solve_volume(replace(BASIN, floats=(solid,)).scaled(), tolerance=5e-3, count=6).modes.eigenvalues
        for solid in (cylinder, replace(cylinder, shape="revolved", outline=corners))
    ]
    assert values[0] == pytest.approx(values[1], rel=1e-3)


def test_hulls_whose_waterline_leaves_the_tank_are_refused(tmp_path: Path) -> None:
    hull = hull_float(solid_file(tmp_path, "box.stl", box=(2.0, 1.4, 0.6)), (0.5, 3.0))
    with pytest.raises(MeshError, match="waterline of a hull"):
        volume_mesh(replace(BASIN, floats=(hull,)).scaled(), VolumeSizes(edge=0.2, bulk=0.3, geometry=1))


def test_a_box_that_is_turned_has_a_product_of_inertia(tmp_path: Path) -> None:
    """About axes turned by α, ∫xy = ½(I_y − I_x) sin 2α of its principal second moments."""
    corners = np.array(
        [[x, y, z] for z in (-0.6, 0.4) for x, y in ((-1.0, -0.7), (1.0, -0.7), (1.0, 0.7), (-1.0, 0.7))]
    )
    turn = np.radians(25.0)
    corners[:, :2] = corners[:, :2] @ np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    sides = [(0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7), (3, 2, 1, 0), (4, 5, 6, 7)]
    triangles = np.array([corners[[side[0], side[i], side[i + 1]]] for side in sides for i in (1, 2)])
    found = wetted_hull(written(tmp_path / "turned_box.stl", triangles)).hydrostatics
    about_x, about_y = 2.0 * 1.4**3 / 12.0, 1.4 * 2.0**3 / 12.0
    assert found.volume == pytest.approx(2.0 * 1.4 * 0.6)
    assert found.product == pytest.approx(0.5 * (about_y - about_x) * np.sin(2.0 * turn))
    assert found.second[0] == pytest.approx(about_x * np.cos(turn) ** 2 + about_y * np.sin(turn) ** 2)


def test_an_unsymmetric_waterplane_couples_heave_roll_and_pitch() -> None:
    """The stiffness is the second derivative of the energy of a tilted waterplane, by its polygon."""
    hydrostatics = Hydrostatics(
        volume=1.0, buoyancy=-0.3, waterplane=2.0, second=(0.5, 0.8), first=(0.2, -0.1), product=0.05
    )
    hull = replace_hull(hydrostatics)
    stiffness = hull.stiffness()
    lever = -0.3 + 0.05
    # Heave, roll and pitch raise a point by 1, y and −x.
    assert stiffness[2:5, 2:5] == pytest.approx(
        np.array([[2.0, -0.1, -0.2], [-0.1, 0.5 + lever, -0.05], [-0.2, -0.05, 0.8 + lever]])
    )
    points = np.array([[0.3, -0.4], [0.7, 0.2], [0.0, 0.0]])
    heights = [hull.displacement(motion, points)[2] for motion in ("heave", "roll", "pitch")]
    assert heights == pytest.approx(np.array([[1.0, 1.0], [0.7, 0.2], [-0.3, 0.4]]))
    # The motions that are solved for are coupled by neither stiffness nor inertia, and move the surface as they say.
    body = float_body(hull, "body_1", (None, None))
    turn = body.motions
    assert turn.T @ stiffness @ turn == pytest.approx(np.diag(body.stiffness), abs=1e-12)
    assert turn.T @ np.diag(hull.inertia()) @ turn == pytest.approx(body.mass, abs=1e-12)
    assert np.diag(turn) == pytest.approx(np.ones(6))
    assert np.abs(turn - np.eye(6)).max() > 1e-2
    upwards = np.array([[0.0, 0.0], [0.0, 0.0], [1.0, 1.0]])
    assert body.shapes(points, upwards)[2] == pytest.approx(turn[2:5, 2] @ np.array(heights))


def replace_hull(hydrostatics: Hydrostatics) -> SolidFloat:
    from hydroelastic.physics.wetted_hulls import WettedHull

    return SolidFloat(
        shape="hull",
        size=(2.0, 1.0),
        draught=0.6,
        position=(0.0, 0.0),
        centre_of_gravity=-0.05,
        gyration=(0.4, 0.9, 1.0),
        motions=RIGID_MOTIONS,
        hull=WettedHull(
            file=Path("hull.stl"),
            level=0.0,
            low=(-1.0, -0.5, -0.6),
            high=(1.0, 0.5, 0.0),
            hydrostatics=hydrostatics,
            symmetric=(False, False),
        ),
    )
