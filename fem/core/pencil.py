"""The coupled problem as a plain value.

    K ζ = ω² (M + M_a) ζ,    M_a = Σ ρ CᵀA⁺C over the layers,    V ζ = 0        ζ = (a, η): bodies, then surfaces

C has a column for each shape of each body, ∫vᵢ·n q, and for each unknown of a surface that moves, ∫ηⱼ q in the layer
below and −∫ηⱼ q in the one above. K holds the stiffness of the bodies and Δρ g ∫ηᵢηⱼ, M the mass of the bodies. V is
the volume that each unknown takes from each closed layer; the constant of ψ there is its Lagrange multiplier.

K, M + M_a and V are small and dense, and the same on every process; C has the rows of each.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
from mpi4py import MPI
from numpy.typing import NDArray
from scipy.linalg import block_diag

from hydroelastic.fem.core.bodies import Body
from hydroelastic.fem.core.liquid import Indices, Liquid, ShapeSpace, Zero

Array = NDArray[np.float64]

# Loads that are solved for at once.
_TOGETHER = 128
# Volumes below this part of the largest flux that moves in and out are rounding.
_NO_VOLUME = 1e-10
# Constraints that differ by less differ by rounding of the loads.
_SAME_VOLUME = 1e-6


class Surface(NamedTuple):
    """A surface of a liquid, or between two, under gravity."""

    name: str
    below: int
    above: int | None
    jump: float


@dataclass(frozen=True, kw_only=True)
class Pencil:
    """The matrices of one part of a tank."""

    liquid: Liquid  # ψ
    bodies: tuple[Body, ...]  # in the order of their unknowns
    surfaces: tuple[tuple[Surface, int], ...]  # in the order of theirs, with the number of the unknowns of each
    stiffness: Array  # K, shape (n, n)
    mass: Array  # M of the bodies, shape (n, n)
    added_mass: Array  # M_a, shape (n, n)
    volume: Array  # V, shape (constraints, n), independent rows
    volumes: Array  # of all closed layers, as rows
    zero: Zero  # names of facets with ψ = 0
    rows: Indices  # unknowns of ψ of this process on what moves
    coupling: Array  # C on these, shape (rows, n); zero elsewhere

    @property
    def body_size(self) -> int:
        return sum(body.size for body in self.bodies)

    @property
    def size(self) -> int:
        return len(self.stiffness)

    @cached_property
    def kinetic(self) -> Array:
        return self.mass + self.added_mass

    @cached_property
    def zero_modes(self) -> int:
        """Number of motions without stiffness that the volumes allow."""
        free = np.flatnonzero(~self.stiffness.any(axis=0))
        return len(free) - _rank(self.volume[:, free])

    def potentials(self, vectors: Array) -> Array:
        """A⁺C ζ on the unknowns of this process, shape (unknowns, vectors) (collective)."""
        return self.liquid.solve(_spread(self.coupling @ vectors, self.rows, self.liquid), self.zero)

    def added_energies(self, vectors: Array, liquid: Liquid | None = None) -> Array:
        """ζᵀM_aζ, or what it is with ψ of a lower degree, of vectors that keep the volumes (collective).

        The loads are the same on that subspace, and η follows the trace of ψ: λ changes by the same part as
        ζᵀ(M + M_a)ζ, up to squares.
        """
        if liquid is None:
            return np.einsum("ik,ij,jk->k", vectors, self.added_mass, vectors, optimize=True)
        loads = liquid.restricted(self.liquid, self.rows, self.coupling @ vectors)
        weights = np.array(liquid.densities)[liquid.layer_of]
        energies = np.einsum("nk,nk,n->k", loads, liquid.solve(loads, self.zero), weights)
        liquid.comm.Allreduce(MPI.IN_PLACE, energies)
        return energies

    def with_bodies(self, bodies: tuple[Body, ...]) -> Pencil:
        size = self.body_size
        stiffness, mass = self.stiffness.copy(), self.mass.copy()
        stiffness[:size, :size], mass[:size, :size] = _body_matrices(bodies)
        return replace(self, bodies=bodies, stiffness=stiffness, mass=mass)

    def of_first(self, counts: Sequence[int]) -> Pencil:
        """The same with only the first dry modes of each body of the tank."""
        first = [body.of_first(counts[body.index]) for body in self.bodies]
        kept = np.concatenate([*(own for _, own in first), np.ones(self.size - self.body_size, dtype=bool)])
        both = np.ix_(kept, kept)
        return replace(
            self,
            bodies=tuple(body for body, _ in first),
            stiffness=self.stiffness[both],
            mass=self.mass[both],
            added_mass=self.added_mass[both],
            volume=self.volume[:, kept],
            volumes=self.volumes[:, kept],
            coupling=self.coupling[:, kept],
        )

    def released(self, surfaces: Sequence[str]) -> Pencil:
        """The limit of infinite frequency on some surfaces between liquids: they follow the bodies without stiffness.

        Their part of the pencil is condensed, M_a ← M_aa − M_aη M_ηη⁻¹ M_ηa under the volumes' constraints, so that
        ρψ is the same on both sides.
        """
        first, follows = self.body_size, np.zeros(self.size, dtype=bool)
        for surface, count in self.surfaces:
            follows[first : first + count] = surface.name in surfaces
            first += count
        if not follows.any():
            return self
        stays, rows = ~follows, self.volume[:, follows]
        held = np.array(_independent(rows), dtype=np.int64)
        count = len(held)
        block = np.block(
            [[self.added_mass[np.ix_(follows, follows)], rows[held].T], [rows[held], np.zeros((count, count))]]
        )
        right = np.vstack([self.added_mass[np.ix_(follows, stays)], self.volume[np.ix_(held, stays)]])
        answer = -np.linalg.solve(block, right)
        path = np.zeros((self.size, int(stays.sum())))
        path[stays], path[follows] = np.eye(path.shape[1]), answer[: int(follows.sum())]
        volume = self.volume @ path
        volume[np.abs(volume) < _SAME_VOLUME * np.abs(self.volume).max(initial=0.0)] = 0.0
        added = path.T @ self.added_mass @ path
        return replace(
            self,
            surfaces=tuple(pair for pair in self.surfaces if pair[0].name not in surfaces),
            stiffness=self.stiffness[np.ix_(stays, stays)],
            mass=self.mass[np.ix_(stays, stays)],
            added_mass=0.5 * (added + added.T),
            volume=volume[_independent(volume)],
            volumes=self.volumes @ path,
            coupling=self.coupling @ path,
        )


def _body_matrices(bodies: Sequence[Body]) -> tuple[Array, Array]:
    if not bodies:
        return np.empty((0, 0)), np.empty((0, 0))
    return np.diag(np.concatenate([body.stiffness for body in bodies])), block_diag(*(body.mass for body in bodies))


class Loads:
    """What the parts of a tank have in common: the loads of surfaces and bodies on one mesh and degree."""

    def __init__(self, liquid: Liquid, surfaces: Sequence[Surface], bodies: Sequence[str]) -> None:
        self.liquid = liquid
        self.surfaces = tuple(surface for surface in surfaces if liquid.has(surface.name))
        self.shapes = ShapeSpace(liquid, bodies)
        moving = [*(surface.name for surface in self.surfaces), *self.shapes.points]
        self._rows = np.unique(np.concatenate([np.empty(0, dtype=np.int64), *map(liquid.boundary, moving)]))
        self._blocks = [self._surface_block(surface) for surface in self.surfaces]

    def _surface_block(self, surface: Surface) -> tuple[Array, Array, Indices]:
        """Loads and stiffness of the unknowns of a surface, and their numbers among those of ψ."""
        liquid = self.liquid
        trace = liquid.trace(surface.name, surface.below)
        unknowns = trace.unknowns()
        starts, columns, values = liquid.surface(surface.name).getValuesCSR()
        rows = np.repeat(np.arange(liquid.owned), np.diff(starts))

        def block(of_rows: Indices, of_columns: Indices) -> Array:
            places = [np.full(size, -1) for size in (liquid.owned, liquid.size)]
            for place, numbers in zip(places, (of_rows, of_columns), strict=True):
                place[numbers] = np.arange(len(numbers))
            row, column = places[0][rows], places[1][columns]
            both = (row >= 0) & (column >= 0)
            found = np.zeros((len(of_rows), len(of_columns)))
            found[row[both], column[both]] = values[both]
            return found

        load = block(self._rows, unknowns)
        own = (unknowns >= liquid.first) & (unknowns < liquid.first + liquid.owned)
        restoring = np.zeros((len(unknowns),) * 2)
        restoring[own] = load[np.searchsorted(self._rows, unknowns[own] - liquid.first)]
        liquid.comm.Allreduce(MPI.IN_PLACE, restoring)
        if surface.above is not None:
            load = load - block(self._rows, trace.unknowns(liquid.trace(surface.name, surface.above)))
        return load, 0.5 * surface.jump * (restoring + restoring.T), unknowns

    def pencil(self, bodies: tuple[Body, ...], zero: Zero) -> Pencil:
        """The pencil of a part with ψ = 0 on the facets of some names (collective)."""
        liquid, rows = self.liquid, self._rows
        zeros, closed, _ = liquid.conditions(zero)
        everywhere = np.concatenate(liquid.comm.allgather(zeros + liquid.first))
        columns, restoring, surfaces = [self._body_loads(body) for body in bodies], [], []
        for surface, (load, stiffness, unknowns) in zip(self.surfaces, self._blocks, strict=True):
            kept = np.flatnonzero(~np.isin(unknowns, everywhere))
            columns.append(load[:, kept])
            restoring.append(stiffness[np.ix_(kept, kept)])
            surfaces.append((surface, len(kept)))
        coupling = np.hstack([np.empty((len(rows), 0)), *columns])
        volumes = (liquid.layer_of[rows] == np.array(closed)[:, None]).astype(float) @ coupling
        liquid.comm.Allreduce(MPI.IN_PLACE, volumes)
        largest = liquid.comm.allreduce(np.abs(coupling).sum(axis=0).max(initial=0.0), op=MPI.MAX)
        volumes[np.abs(volumes) <= _NO_VOLUME * largest] = 0.0
        coupling[np.isin(rows, zeros)] = 0.0
        weighed = (coupling * np.array(liquid.densities)[liquid.layer_of[rows], None]).T
        count = coupling.shape[1]
        added = np.zeros((count, count))
        for first in range(0, count, _TOGETHER):
            some = slice(first, first + _TOGETHER)
            added[:, some] = weighed @ liquid.solve(_spread(coupling[:, some], rows, liquid), zero)[rows]
        liquid.comm.Allreduce(MPI.IN_PLACE, added)
        stiffness, mass = _body_matrices(bodies)
        whole_mass = np.zeros((count, count))
        whole_mass[: len(mass), : len(mass)] = mass
        return Pencil(
            liquid=liquid,
            bodies=bodies,
            surfaces=tuple(surfaces),
            stiffness=block_diag(stiffness, *restoring) if count else np.empty((0, 0)),
            mass=whole_mass,
            added_mass=0.5 * (added + added.T),
            volume=volumes[_independent(volumes)],
            volumes=volumes,
            zero=zero,
            rows=rows,
            coupling=coupling,
        )

    def _body_loads(self, body: Body) -> Array:
        points, sides = self.shapes.points[body.name]
        shapes = body.shapes(points, sides if body.is_slit else np.zeros_like(sides))
        return self.shapes.load(body.name, shapes)[self._rows]


def _spread(loads: Array, rows: Indices, liquid: Liquid) -> Array:
    found = np.zeros((liquid.owned, loads.shape[1]), order="F")
    found[rows] = loads
    return found


def _independent(rows: Array) -> list[int]:
    """Indices of rows that are independent of those before; they may be small or zero."""
    kept: list[int] = []
    largest = np.abs(rows).max(initial=0.0)
    for number, row in enumerate(rows):
        if np.abs(row).max(initial=0.0) <= _SAME_VOLUME * largest:
            continue
        rest = row - rows[kept].T @ np.linalg.lstsq(rows[kept].T, row, rcond=None)[0] if kept else row
        if np.linalg.norm(rest) > _SAME_VOLUME * np.linalg.norm(row):
            kept.append(number)
    return kept


def _rank(matrix: Array) -> int:
    return int(np.linalg.matrix_rank(matrix, tol=_NO_VOLUME * np.abs(matrix).max(initial=0.0))) if matrix.size else 0
