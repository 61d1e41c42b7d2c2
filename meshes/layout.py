"""The structured part of a mesh, made before gmsh fills the rest: rings at corners, elements of curved pieces,
sizes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import isfinite

import numpy as np
from numpy.typing import NDArray

from hydroelastic.meshes.crossings import crossing_pair
from hydroelastic.meshes.curve_nodes import (
    bend_sources,
    element_parameters,
    element_sources,
    outermost_ring,
    ring_ends,
)
from hydroelastic.meshes.curved_cells import CurvedEdges
from hydroelastic.meshes.filling import Line
from hydroelastic.meshes.outline import Outline, Point
from hydroelastic.meshes.rings import RingEnds, ring_radii, wedge_nodes
from hydroelastic.meshes.size_field import Discs, SizeField
from hydroelastic.meshes.tagged_mesh import MeshError


@dataclass(frozen=True, kw_only=True)
class Wedge:
    """The rings of one region at one of its corners.

    Attributes:
        corner: its point.
        nodes: shape (rings, rays, 2), see `rings.wedge_nodes`.
    """

    graded: Point
    nodes: NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Layout:
    """An outline with its rings.

    Attributes:
        outline: the domain.
        rings: where rings meet curves, by the curve's index and whether they are at its start.
        wedges: rings of the regions, by the region's index and the place in its loop of the curve that comes to
            the corner.
        elements: of each curved piece, the parameters of the elements' ends between the rings; ``None`` if straight.
    """

    outline: Outline
    rings: dict[tuple[int, bool], RingEnds]
    wedges: dict[tuple[int, int], Wedge]
    elements: list[NDArray[np.float64] | None]

    def middle(self, number: int) -> NDArray[np.float64]:
        """Points of a curve from ring to ring: those of its elements, or the ends of a straight line, shape (n, 2)."""
        curve, elements = self.outline.curves[number], self.elements[number]
        points = curve.at(np.array([0.0, 1.0]) if elements is None else elements)
        for at_start, place in ((True, 0), (False, -1)):
            if (number, at_start) in self.rings:
                points[place] = self.rings[number, at_start].points[-1]
        return points

    def within_rings(self, number: int, at_start: bool) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Parameters and points of a curve's nodes from a corner to before the outermost ring, in the curve's order."""
        if (number, at_start) not in self.rings:
            return np.zeros(0), np.zeros((0, 2))
        curve, ring = self.outline.curves[number], self.rings[number, at_start]
        parameters = np.append(0.0 if at_start else 1.0, ring.parameters[:-1])
        points = np.vstack([curve.start if at_start else curve.end, ring.points[:-1]])
        return (parameters, points) if at_start else (parameters[::-1], points[::-1])

    def curved_edges(self, number: int) -> CurvedEdges | None:
        """All elements of a curve, those between rings too; ``None`` for a straight one."""
        elements = self.elements[number]
        if elements is None:
            return None
        before, after = self.within_rings(number, True), self.within_rings(number, False)
        return CurvedEdges(
            curve=self.outline.curves[number],
            parameters=np.concatenate([before[0], elements, after[0]]),
            points=np.vstack([before[1], self.middle(number), after[1]]),
        )

    def check_crossings(self) -> None:
        """Check that lines meet at common ends only.

        Raises:
            MeshError: naming the curves.
        """
        names, chains = [], []
        for line in {line.key: line for loop in self.loops() for line in loop}.values():
            curve = self.outline.curves[line.key].name if isinstance(line.key, int) else ""
            chains.append(line.points)
            names += [curve or "an inner line"] * (len(line.points) - 1)
        found = crossing_pair(np.vstack([chain[:-1] for chain in chains]), np.vstack([chain[1:] for chain in chains]))
        if found is not None:
            first, second = sorted(names[place] for place in found)
            raise MeshError(f"curves of the outline cross or touch one another: {first} and {second}")

    def points(self) -> Iterator[NDArray[np.float64]]:
        """All points outside the rings, curve by curve from start to end, a corner's outermost rings in its place."""
        for number, curve in enumerate(self.outline.curves):
            middle = self.middle(number)
            for graded, rest in ((curve.start, middle[:1]), (curve.end, middle[1:])):
                yield from (wedge.nodes[-1] for wedge in self.wedges.values() if wedge.graded == graded)
                yield rest

    def loops(self) -> Iterator[list[Line]]:
        """Clockwise boundary of each region outside its rings."""
        for index, region in enumerate(self.outline.regions):
            lines = []
            for place, (number, forward) in reversed(list(enumerate(region.loop))):
                if (index, place) in self.wedges:
                    outermost = self.wedges[index, place].nodes[-1]
                    lines.append(Line(key=(index, place), points=outermost, forward=False, divided=False))
                straight = self.elements[number] is None
                lines.append(Line(key=number, points=self.middle(number), forward=not forward, divided=straight))
            yield lines


def lay_out(
    outline: Outline, *, bulk_size: float, growth: float, ring_ratio: float, largest_turn: float
) -> tuple[Layout, SizeField]:
    """Create rings and the elements of curved pieces.

    Args:
        outline: the domain.
        bulk_size: largest element, in the unit of the outline.
        growth: growth of elements per distance from a curve, dimensionless.
        ring_ratio: ratio of the radii of successive rings.
        largest_turn: largest change of direction of a curve along an element, rad.

    Returns:
        The layout, and the size field for the rest.

    Raises:
        MeshError: if the angle of a region at a corner is too small.
    """
    radii = {
        graded.point: ring_radii(graded.inner, outermost_ring(outline, graded, largest_turn), ring_ratio)
        for graded in outline.graded_points
    }
    rings = {}
    for number, curve in enumerate(outline.curves):
        for at_start, point in ((True, curve.start), (False, curve.end)):
            if point in radii:
                rings[number, at_start] = ring_ends(curve, at_start, radii[point])
    spans = [
        (
            float(rings[number, True].parameters[-1]) if (number, True) in rings else 0.0,
            float(rings[number, False].parameters[-1]) if (number, False) in rings else 1.0,
        )
        for number in range(len(outline.curves))
    ]
    sized = [curve for curve in outline.curves if curve.path is None and isfinite(curve.size)]
    outermost = [(point, float(outer[-1])) for point, outer in radii.items()]
    curved = [number for number, curve in enumerate(outline.curves) if curve.path is not None]

    def field(bends: list[Discs]) -> SizeField:
        return SizeField(bulk_size=bulk_size, growth=growth, straight=sized, rings=outermost, bends=Discs.joined(bends))

    wanted = field([bend_sources(outline, number, spans[number], largest_turn) for number in curved])
    elements: list[NDArray[np.float64] | None] = [None] * len(outline.curves)
    for number in curved:
        elements[number] = element_parameters(outline.curves[number], spans[number], wanted, largest_turn)
    layout = Layout(outline=outline, rings=rings, wedges=_wedges(outline, radii, rings), elements=elements)
    return layout, field([element_sources(layout.middle(number)) for number in curved])


def _wedges(
    outline: Outline, radii: dict[Point, NDArray[np.float64]], rings: dict[tuple[int, bool], RingEnds]
) -> dict[tuple[int, int], Wedge]:
    wedges = {}
    for index, region in enumerate(outline.regions):
        for place, (coming, onwards) in enumerate(region.loop):
            leaving, forward = region.loop[(place + 1) % len(region.loop)]
            point = outline.curves[leaving].start if forward else outline.curves[leaving].end
            if point in radii:
                nodes = wedge_nodes(np.array(point), radii[point], rings[coming, not onwards], rings[leaving, forward])
                wedges[index, place] = Wedge(graded=point, nodes=nodes)
    return wedges
