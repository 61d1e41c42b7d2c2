"""The structured part of a mesh, made before gmsh fills the rest: rings at corners, elements of curved pieces,
sizes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
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
    straight_elements,
)
from hydroelastic.meshes.curved_cells import CurvedEdges
from hydroelastic.meshes.filling import Line
from hydroelastic.meshes.outline import Outline, Point
from hydroelastic.meshes.rings import RingEnds, ring_radii, wedge_nodes
from hydroelastic.meshes.size_field import Discs, SizeField
from hydroelastic.meshes.tagged_mesh import MeshError


@dataclass(frozen=True, kw_only=True)
class Wedge:
    """The rings of one region at one of its corners."""

    graded: Point
    nodes: NDArray[np.float64]  # shape (rings, rays, 2), see `rings.wedge_nodes`


@dataclass(frozen=True, kw_only=True)
class Layout:
    """An outline with its rings."""

    outline: Outline  # the domain
    # where rings meet curves, by the curve's index and whether they are at its start
    rings: dict[tuple[int, bool], RingEnds]
    # rings of the regions, by the region's index and the place in its loop of the curve that comes to the corner
    wedges: dict[tuple[int, int], Wedge]
    elements: list[NDArray[np.float64]]  # of each curve, the parameters of the elements' ends between the rings

    def middle(self, number: int) -> NDArray[np.float64]:
        """Ends of a curve's elements from ring to ring, shape (n, 2)."""
        return self._middles[number]

    @cached_property
    def _middles(self) -> list[NDArray[np.float64]]:
        found = []
        for number, (curve, parameters) in enumerate(zip(self.outline.curves, self.elements, strict=True)):
            points = curve.at(parameters)
            for at_start, place in ((True, 0), (False, -1)):
                if (number, at_start) in self.rings:
                    points[place] = self.rings[number, at_start].points[-1]
            found.append(points)
        return found

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
        if self.outline.curves[number].path is None:
            return None
        before, after = self.within_rings(number, True), self.within_rings(number, False)
        return CurvedEdges(
            curve=self.outline.curves[number],
            parameters=np.concatenate([before[0], self.elements[number], after[0]]),
            points=np.vstack([before[1], self.middle(number), after[1]]),
        )

    def check_crossings(self) -> None:
        """Check that lines meet at common ends only."""
        names, chains = [], []
        for line in {line.key: line for loop in self.loops() for line in loop}.values():
            curve = self.outline.curves[line.key] if isinstance(line.key, int) else None
            is_straight = curve is not None and curve.path is None
            chains.append(line.points[:: len(line.points) - 1] if is_straight else line.points)
            names += [(curve and curve.name) or "an inner line"] * (len(chains[-1]) - 1)
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
                    lines.append(Line(key=(index, place), points=outermost, forward=False))
                lines.append(Line(key=number, points=self.middle(number), forward=not forward))
            yield lines


def lay_out(
    outline: Outline, *, bulk_size: float, growth: float, ring_ratio: float, largest_turn: float
) -> tuple[Layout, SizeField]:
    """Create rings and the elements of curved pieces."""
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
        return SizeField(bulk_size=bulk_size, growth=growth, straight=sized, rings=outermost, bends=bends)

    wanted = field([bend_sources(outline, number, spans[number], largest_turn) for number in curved])
    elements = {
        number: element_parameters(outline.curves[number], spans[number], wanted, largest_turn) for number in curved
    }
    size = (
        field([element_sources(outline.curves[number].at(elements[number])) for number in curved]) if curved else wanted
    )
    straight = [number for number in range(len(outline.curves)) if number not in elements]
    ends = np.array([outline.curves[number].at(np.array(spans[number])) for number in straight]).reshape(-1, 2, 2)
    for number, parts in zip(straight, straight_elements(ends[:, 0], ends[:, 1], size), strict=True):
        first, last = spans[number]
        elements[number] = first + (last - first) * parts
        elements[number][-1] = last
    layout = Layout(
        outline=outline,
        rings=rings,
        wedges=_wedges(outline, radii, rings),
        elements=[elements[number] for number in range(len(outline.curves))],
    )
    return layout, size


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
