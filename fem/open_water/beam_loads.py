"""Bending moment and shear force along a beam in waves, by the equilibrium of the part to the left of a section.

With the upward load q = ω²(m w + [ρΨ]) − Δρ g w per length, [ρΨ] below less above, Ψ of all waves, and forces Fᵢ and
anticlockwise moments Cᵢ of springs and dampers at points xᵢ, a beam with free ends has

    Q(x) = (EI w″)′ = ∫₀ˣ q dx′ + Σ Fᵢ,        M(x) = EI w″ = ∫₀ˣ (x − x′) q dx′ + Σ ((x − xᵢ) Fᵢ − Cᵢ),   xᵢ < x.

Both are as accurate as the deflection and the pressure, while derivatives of the dry modes converge two and three
orders more slowly (mode acceleration: R. L. Bisplinghoff, H. Ashley, R. L. Halfman, Aeroelasticity, 1955).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import ceil

import numpy as np
from mpi4py import MPI
from numpy.polynomial.legendre import leggauss

from hydroelastic.fem.facets import FacetGroup, facet_groups
from hydroelastic.fem.liquid import LiquidSpace
from hydroelastic.fem.open_water.field_model import OpenModel
from hydroelastic.fem.open_water.frequency import OpenResponse
from hydroelastic.fem.open_water.functional_errors import dual_motions, functional_errors
from hydroelastic.fem.open_water.incident_waves import Wave
from hydroelastic.fem.open_water.omitted_modes import weakened_attachments
from hydroelastic.fem.open_water.outside import attachment_paths
from hydroelastic.fem.shape_loads import potential_basis
from hydroelastic.modal.beam.beam_shapes import beam_shapes
from hydroelastic.physics.beams import Beam

# Gauss points beyond what polynomials and waves need.
_SPARE_POINTS = 8


@dataclass(frozen=True, kw_only=True)
class AlongBeam:
    """Deflection and loads along a beam in waves of a unit of c, in units of the basin. Shapes: w waves, p points."""

    deflection: np.ndarray  # w upwards, shape (w, p)
    bending_moment: np.ndarray  # EI w″, shape (w, p)
    shear_force: np.ndarray  # (EI w″)′, shape (w, p)


class BeamLoads:
    """Deflection and loads along a beam in waves.

    Args:
        index: of the beam among the bodies.
        x: distances from its left end, in units of the basin, shape (p,).
    """

    def __init__(self, model: OpenModel, index: int, x: np.ndarray) -> None:
        """Integrate over the beam (collective)."""
        tank, bodies = model.basin.tank, model.pencil.bodies
        self._model, self._x, body = model, x, bodies[index]
        beam, piece = tank.beams[index], tank.piece_of(index)
        first = sum(other.size for other in bodies[:index])
        self._own = slice(first, first + body.size)
        self._deflection = beam_shapes(beam, body.size).tabulated(x, 0)
        self._length, self._wavenumber = piece.length, body.wavenumber
        self._restoring = float(body.stiffness[0] - body.bending_stiffness[0]) / piece.length
        self._heaviest = float(np.diag(body.mass).max()) / piece.length
        self._density = max(layer.density for layer in tank.layers)
        self._inertia, self._area = _inertia_and_area(beam, body.size, x)
        self._buoyancy = self._restoring * self._area
        self._water = _Trace(model, body.surface, piece.start, x)
        # Forces from outside: distance from the end, displacement of the other body less that of this one.
        self._supports = [
            (
                min(
                    max((one.point[0] - model.basin.origin) / model.basin.units.length - piece.start, 0.0), beam.length
                ),
                sign,
                path,
                number,
            )
            for number, (one, path) in enumerate(
                zip(model.attachments, attachment_paths(model.basin, bodies, model.attachments), strict=True)
            )
            for at, sign in ((one.body, 1.0), (one.other, -1.0))
            if at == index
        ]

    def of(self, response: OpenResponse, motions: np.ndarray, drag: np.ndarray) -> AlongBeam:
        """Return deflection and loads in each incident wave (collective)."""
        own, squared = motions[:, self._own], response.squared.real
        waves = [response.incidence.planes[place] for place in response.incident]
        total = response.scattered_by(motions)
        shear, moment = (
            squared * (self._water.of_potentials(total) + self._water.of_waves(waves))
            + self._moved(squared, motions)
            + self._held(squared, motions, drag)
        )
        return AlongBeam(deflection=own @ self._deflection, bending_moment=moment, shear_force=shear)

    def errors(self, response: OpenResponse, omitted: np.ndarray) -> np.ndarray:
        """Return estimated errors anywhere along the beam of deflection, shear force and bending moment in each wave,
        shape (3, incident) (collective).

        Those by the mesh and by the absorbing layer are the `functional_errors` at the points x; the shear force is the
        functional with g = 1 to the left of x, the moment that with g = x − x′. A deflection δw in the omitted dry
        modes, of wavenumbers above κ, is a load (Δρ g + ω²(m + ρ/κ)) δw, whose integrals are smaller by κ and κ²; and
        it changes the forces of springs and dampers by the same part as the deflection. What these modes change in
        those in use is that of `weakened_attachments`.
        """
        squared, unit = response.squared.real, np.eye(response.motions.shape[1])
        radiated = response.radiated_by(unit)
        undamped = np.zeros((len(unit), len(self._model.outside.drag)))
        loads = (
            squared * self._water.of_potentials(radiated)
            + self._moved(squared, unit)
            + self._held(squared, unit, undamped)
        )
        deflections = np.zeros((len(unit), len(self._x)))
        deflections[self._own] = self._deflection
        dual = dual_motions(response, np.concatenate([deflections[None], loads]).swapaxes(1, 2).reshape(-1, len(unit)))
        weights = np.zeros((3, len(self._x), len(unit)))
        weights[1:, :, self._own] = self._area.swapaxes(1, 2) / self._length
        found = sum(functional_errors(response, dual + weights.reshape(dual.shape)))
        meshed: np.ndarray = np.asarray(found).reshape(3, len(self._x), -1).max(axis=1)
        weakened = weakened_attachments(response, dual, self._carried()).reshape(3, len(self._x), -1).max(axis=1)
        largest = np.abs(response.motions[:, self._own] @ self._deflection).max(axis=1)
        drag = np.zeros((len(response.incident), len(self._model.outside.drag)))
        held = self._held(squared, response.motions, drag)
        kept = np.abs(held - self._balanced(held)).max(axis=2)
        load = self._restoring + squared * (self._heaviest + self._density / self._wavenumber)
        truncated = np.array([np.ones_like(largest), *(kept / largest)])
        truncated[1:] += np.array([[load / self._wavenumber], [load / self._wavenumber**2]])
        return meshed + weakened + truncated * omitted

    def _moved(self, squared: float, motions: np.ndarray) -> np.ndarray:
        """Shear force and moment by the inertia of the beam and by its weight in the liquid, shape (2, motions, p)."""
        moved: np.ndarray = np.einsum("wn,knp->kwp", motions[:, self._own], squared * self._inertia - self._buoyancy)
        return moved

    def _held(self, squared: float, motions: np.ndarray, drag: np.ndarray) -> np.ndarray:
        """Shear force and moment by springs and dampers, shape (2, motions, p)."""
        held = np.zeros((2, len(motions), len(self._x)), dtype=complex)
        for start, force, couple in self._outside(float(np.sqrt(squared)), motions, drag):
            beyond = self._x > start
            held[0] += beyond * force[:, None]
            held[1] += beyond * ((self._x - start) * force[:, None] - couple[:, None])
        return held

    def _carried(self) -> dict[int, np.ndarray]:
        """What deflection, shear force and moment at the points take of the force, in heave, sway and rotation, of each
        attachment, shape (3 p, 3), by its number."""
        found: dict[int, np.ndarray] = {}
        for start, sign, _path, number in self._supports:
            beyond = sign * (self._x > start)
            carried = np.zeros((3, len(self._x), 3))
            carried[1, :, 0], carried[2, :, 0], carried[2, :, 2] = beyond, beyond * (self._x - start), -beyond
            found[number] = carried.reshape(-1, 3)
        return found

    def _balanced(self, loads: np.ndarray) -> np.ndarray:
        """Shear force and moment by a load that varies linearly, with the same values at the right end: inertia of a
        rigid beam takes it up, and its errors are errors of no load; shape (2, waves, p)."""
        s, (shear, moment) = self._x / self._x[-1], loads[:, :, -1:] * [[[self._x[-1]]], [[1.0]]]
        # q l² = a + b s, with a + b/2 = Q l and a/2 + b/6 = M at the end.
        b = 6.0 * shear - 12.0 * moment
        a = shear - 0.5 * b
        return np.array([(a * s + b * s**2 / 2.0) / self._x[-1], a * s**2 / 2.0 + b * s**3 / 6.0])

    def _outside(
        self, omega: float, motions: np.ndarray, drag: np.ndarray
    ) -> list[tuple[float, np.ndarray, np.ndarray]]:
        """Distance from the left end, and upward force and anticlockwise moment of each spring and damper in each
        wave."""
        units, attachments = self._model.basin.units, self._model.attachments
        betas = np.array([one.scaled(units).drag for one in attachments]).reshape(-1, 3)
        linear = np.zeros((len(motions), *betas.shape))
        linear[:, betas > 0.0] = drag
        found = []
        for start, sign, path, number in self._supports:
            scaled, moved = attachments[number].scaled(units), motions @ path.T
            pull = moved @ (scaled.stiffness - 1j * omega * scaled.damping) - 1j * omega * linear[:, number] * moved
            found.append((start, -sign * pull[:, 0], -sign * pull[:, 2]))
        return found


def _inertia_and_area(beam: Beam, count: int, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """∫₀ˣ m W dx′ and ∫₀ˣ (x − x′) m W dx′ of each shape W, and the same without m, each of shape (2, shapes, p)."""
    shapes = beam_shapes(beam, count)
    edges = np.array(beam.edges)
    ends = np.union1d(edges, x)
    middles, half = 0.5 * (ends[1:] + ends[:-1]), 0.5 * np.diff(ends)
    nodes, weights = leggauss(ceil(shapes.wavenumber * half.max()) + _SPARE_POINTS)
    points = middles[:, None] + half[:, None] * nodes
    span = np.clip(np.searchsorted(edges, middles, side="right") - 1, 0, len(edges) - 2)
    fractions = (points - edges[span][:, None]) / np.diff(edges)[span][:, None]
    mass = np.array([beam.mass_of(int(number), row) for number, row in zip(span, fractions, strict=True)])
    values = shapes.tabulated(points.ravel(), 0).reshape(count, *points.shape)
    found = []
    for density in (mass, np.ones_like(mass)):
        parts = np.einsum("nig,kig->kni", values, half[:, None] * weights * density * np.array([points**0, points]))
        sums = np.concatenate([np.zeros((2, count, 1)), np.cumsum(parts, axis=2)], axis=2)
        plain, first = sums[:, :, np.searchsorted(ends, x)]
        found.append(np.array([plain, x * plain - first]))
    return found[0], found[1]


class _Trace:
    """∫₀ˣ [ρΨ] dx′ and ∫₀ˣ (x − x′) [ρΨ] dx′ along a surface.

    Args:
        x: distances from there, shape (p,).
    """

    def __init__(self, model: OpenModel, surface: str, start: float, x: np.ndarray) -> None:
        liquid = model.pencil.liquid
        self._model = model
        loads = np.zeros((2 * len(x), len(liquid.layer_of)))
        nodes = [(np.zeros((0, 2)), np.zeros(0, dtype=int), np.zeros((2 * len(x), 0)))]
        for group in facet_groups(liquid, surface):
            nodes += _added(liquid, group, model.shortest, start, x, loads)
        rows = liquid.numbering.summed(loads)[:, model.pencil.free]
        self._dofs = np.flatnonzero(rows.any(axis=0))
        self._rows = rows[:, self._dofs]
        points, layers, weights = zip(*nodes, strict=True)
        # For waves in closed form.
        self._points, self._layers, self._weights = np.vstack(points), np.concatenate(layers), np.hstack(weights)

    def of_potentials(self, potentials: np.ndarray) -> np.ndarray:
        """Return both integrals of w potentials, shape (w, free unknowns): shape (2, w, p) (collective)."""
        return self._summed(potentials[:, self._dofs] @ self._rows.T)

    def of_waves(self, waves: list[Wave]) -> np.ndarray:
        """Return both integrals of w incident waves, shape (2, w, p) (collective)."""
        values = np.array([wave.field(self._points, self._layers)[0] for wave in waves])
        return self._summed(values @ self._weights.T)

    def _summed(self, parts: np.ndarray) -> np.ndarray:
        total = parts.astype(complex)
        self._model.pencil.comm.Allreduce(MPI.IN_PLACE, total)
        return total.reshape(len(parts), 2, -1).swapaxes(0, 1)


def _added(
    liquid: LiquidSpace, group: FacetGroup, wavenumber: float, start: float, x: np.ndarray, loads: np.ndarray
) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Add whole facets to the left of each x, and the part to its left of that in which it lies."""
    ends = group.physical_points(group.reference_corners)
    away = ends[:, :, 0] - start
    nodes, weights = leggauss(ceil(0.5 * (liquid.degree + wavenumber * group.longest)) + _SPARE_POINTS)
    upward = group.normals(group.reference_corners[:1])[0][:, 0, 1]
    for place, (low, high) in enumerate(np.sort(away, axis=1)):
        dofs = liquid.space.dofmap.list[group.cells[place]]
        layer = int(liquid.layer_of[dofs[0]])
        for stop, behind in [(high, x >= high), *((value, x == value) for value in x[(low < x) & (x < high)])]:
            at = low + 0.5 * (stop - low) * (nodes + 1.0)
            local = ((at - away[place, 0]) / (away[place, 1] - away[place, 0]))[:, None]
            measure = 0.5 * (stop - low) * weights * (upward[place] * liquid.layers[layer].density)
            rows = np.concatenate([behind[:, None] * measure, behind[:, None] * (x[:, None] - at) * measure])
            loads[:, dofs] += rows @ potential_basis(liquid, group.reference_points(local))
            points = ends[place, 0] + local * (ends[place, 1] - ends[place, 0])
            yield points, np.full(len(at), layer), rows
