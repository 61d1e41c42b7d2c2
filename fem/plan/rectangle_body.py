"""A rectangular plate as a body: its Ritz modes, sorted by their symmetry about its own middle."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import product

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.surfaces import Body
from hydroelastic.modal.plate.rectangle import AxisParity, RectangleModes, rectangle_modes
from hydroelastic.physics.dofs import Dof, body_name
from hydroelastic.physics.level_tank import Box
from hydroelastic.physics.plate import Edge, Outline, Plate, Rectangle, Strip
from hydroelastic.physics.symmetry import Parity

# A plate this close to a wall, in units of the tank, touches it.
_TOUCHING = 1e-9

ClassParity = tuple[AxisParity, AxisParity]
"""Symmetry of modes about the middle of the tank along x and y: 0 even, 1 odd, ``None`` where it has no symmetry."""


@dataclass(frozen=True, kw_only=True)
class RectangleBody:
    """The shapes of a rectangular plate that take part in one symmetry class, dimensionless.

    Attributes:
        index: index of the plate.
        plate: the plate, on a `Rectangle`.
        modes: its Ritz modes by their own parities.
    """

    index: int
    plate: Plate
    modes: tuple[tuple[ClassParity, RectangleModes], ...]

    @property
    def outline(self) -> Rectangle:
        """The rectangle."""
        return rectangle_of(self.plate.outline)

    @property
    def extents(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Its ends along x and along y."""
        (x, y), (length, width) = self.outline.position, self.outline.size
        return (x - 0.5 * length, x + 0.5 * length), (y - 0.5 * width, y + 0.5 * width)

    @cached_property
    def coefficients(self) -> NDArray[np.float64]:
        """Coefficients of its shapes in orthonormal Legendre polynomials of its sides, shape (shapes, m, n).

        Heave is 1, pitch and roll have unit ends and unit slope, elastic shapes a mean square of 1.
        """
        tables = [modes.coefficients for _, modes in self.modes]
        if not self.plate.is_elastic:
            tables = [
                table[: int(np.sum(modes.stiffness == 0.0))]
                for table, (_, modes) in zip(tables, self.modes, strict=True)
            ]
        table = np.concatenate(tables) * np.sqrt(self.outline.area)
        for number, dof in enumerate(self._dofs):
            if not dof.is_elastic:
                side = self.outline.size[1] / 2.0 if dof.is_rotation else 1.0
                table[number] *= np.sign(table[number].sum()) * side / (1.0 if dof == "heave" else np.sqrt(3.0))
        return table

    @cached_property
    def _stiffness(self) -> NDArray[np.float64]:
        values = [
            modes.stiffness if self.plate.is_elastic else modes.stiffness[modes.stiffness == 0.0]
            for _, modes in self.modes
        ]
        return np.concatenate(values)

    @cached_property
    def _dofs(self) -> tuple[Dof, ...]:
        rigid: list[Dof] = []
        for own, modes in self.modes:
            rigid += [_rigid_name(own, len(rigid) + place) for place in range(int(np.sum(modes.stiffness == 0.0)))]
        return dofs_by_stiffness(self._stiffness, rigid)

    @cached_property
    def body(self) -> Body:
        """The body of the pencil."""
        squares = (self.coefficients**2).sum(axis=(1, 2))
        bending = np.zeros(len(squares))
        if self.plate.is_elastic:
            bending = self.plate.flexural_rigidity * self._stiffness * squares
        parities: tuple[Parity, ...] = tuple(
            "antisymmetric" if own[0] == 1 else "symmetric"
            for own, modes in self.modes
            for value in modes.stiffness
            if self.plate.is_elastic or value == 0.0
        )
        return Body(
            surface=body_name(self.index + 1),
            shapes=lambda points, _normals: self.deflection(points),
            wavenumber=float(self._stiffness.max(initial=0.0) ** 0.25),
            dofs=self._dofs,
            parities=parities,
            stiffness=bending + float(self.plate.hydrostatic) * squares,
            bending_stiffness=bending,
            mass=np.diag(self.plate.mass_per_area * squares),
            motions=np.eye(len(squares)),
        )

    def deflection(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return all shapes at points (2, n), in coordinates of the tank, shape (shapes, n)."""
        middle = np.array(self.outline.position)[:, None]
        whole = RectangleModes(size=self.outline.size, stiffness=self._stiffness, coefficients=self.coefficients)
        return whole.deflection(*(points[:2] - middle))


def rectangle_body(plan: Box, index: int, plate: Plate, polynomials: int, parity: ClassParity) -> RectangleBody:
    """Return the shapes of a plate in a dimensionless box that take part in a symmetry class."""
    outline = rectangle_of(plate.outline)
    edges = [
        _edges(plate, outline.position[axis], outline.size[axis], length)
        for axis, length in enumerate((plan.length, plan.width))
    ]
    if isinstance(plate.outline, Strip):
        edges[1] = ("sliding", "sliding")
    # Shapes of either parity about the plate's own middle exist apart where its two edges are held alike.
    own: list[tuple[AxisParity, ...]] = [
        (None,) if pair[0] != pair[1] else (0, 1) if wanted is None else (wanted,)
        for pair, wanted in zip(edges, parity, strict=True)
    ]
    modes = tuple(
        (
            (along, across),
            rectangle_modes(
                outline.size, plate.poisson_ratio, polynomials, edges=(edges[0], edges[1]), parities=(along, across)
            ),
        )
        for along, across in product(*own)
    )
    return RectangleBody(index=index, plate=plate, modes=modes)


def dofs_by_stiffness(stiffness: NDArray[np.float64], rigid: list[Dof]) -> tuple[Dof, ...]:
    """Return the names of shapes: rigid motions in their order, elastic ones numbered from the softest."""
    left = iter(rigid)
    ranks = np.argsort(np.argsort(stiffness, kind="stable"), kind="stable") - len(rigid) + 1
    return tuple(
        next(left) if value == 0.0 else Dof.elastic(int(rank)) for value, rank in zip(stiffness, ranks, strict=True)
    )


def rectangle_of(outline: Outline) -> Rectangle:
    """Return a rectangle, or a strip as one."""
    if isinstance(outline, Strip):
        middle = outline.start + 0.5 * outline.length, 0.5 * outline.width
        return Rectangle(position=middle, size=(outline.length, outline.width))
    assert isinstance(outline, Rectangle)
    return outline


def _edges(plate: Plate, middle: float, side: float, length: float) -> tuple[Edge, Edge]:
    """What holds both edges along an axis: those that do not touch a wall are free."""
    left, right = middle - 0.5 * side, middle + 0.5 * side
    return (
        plate.edge if left < _TOUCHING else "free",
        plate.edge if right > length - _TOUCHING else "free",
    )


def _rigid_name(own: ClassParity, before: int) -> Dof:
    """Heave is even in both directions, pitch odd along x, roll odd along y; a hinged plate turns about its hinges."""
    if own[0] == 1:
        return Dof("pitch")
    if own[1] == 1:
        return Dof("roll")
    return Dof(("heave", "pitch", "roll")[before]) if None in own else Dof("heave")
