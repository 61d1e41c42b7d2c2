"""Plates of any outline as bodies on a plan: rectangles, discs and rings, polygons."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from itertools import product
from math import ceil, pi

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.plan.plan_pencil import Deflection, PlanPlate, Pressures
from hydroelastic.fem.plan.truncation import finer_count, geometric_tail, missing_after, rectangle_energies
from hydroelastic.fem.surfaces import Body
from hydroelastic.modal.plate.line_modes import LineModes, PlateLine, dry_modes
from hydroelastic.modal.plate.polygon import PolygonModes, polygon_modes
from hydroelastic.modal.plate.rectangle import AxisParity, ClassParity, RectangleModes, rectangle_modes
from hydroelastic.physics.dofs import Dof, body_name
from hydroelastic.physics.level_tank import Box, Cylinder, LevelTank
from hydroelastic.physics.plate import Disc, Edge, Outline, Plate, Polygon, Rectangle, Strip
from hydroelastic.physics.symmetry import Parity

# A plate this close to a wall, in units of the tank, touches it.
_TOUCHING = 1e-9
# Beyond this degree the polynomials of a polygon are no longer told apart in double precision.
_HIGHEST_OF_POLYGON = 22
_RIGID_MOTIONS = ("heave", "pitch", "roll")


def plan_plate(tank: LevelTank, index: int, polynomials: int, parity: ClassParity) -> PlanPlate:
    """Return a plate of a dimensionless tank in its shapes of one symmetry."""
    plate = tank.plates[index]
    outline = plate.outline
    if isinstance(outline, Rectangle | Strip):
        return _rectangle(tank, index, polynomials, parity)
    if isinstance(outline, Disc):
        return _disc(tank, index, outline, polynomials, parity)
    assert isinstance(outline, Polygon)
    return _polygon(plate, index, outline, polynomials, parity)


def _rectangle(tank: LevelTank, index: int, polynomials: int, parity: ClassParity) -> PlanPlate:
    plate, outline = tank.plates[index], _as_rectangle(tank.plates[index].outline)
    modes, dofs = _rectangle_shapes(tank, index, polynomials, parity)
    squares = (modes.coefficients**2).sum(axis=(1, 2))
    bending = plate.flexural_rigidity * modes.stiffness * squares if plate.is_elastic else np.zeros(len(squares))

    def deflection(points: NDArray[np.float64]) -> NDArray[np.float64]:
        return modes.deflection(*(points - np.array(outline.position)[:, None]))

    def missing(
        amplitudes: NDArray[np.float64], eigenvalues: NDArray[np.float64], pressures_of: Pressures
    ) -> NDArray[np.float64]:
        if not plate.is_elastic:
            return np.zeros(len(amplitudes))
        more = finer_count(polynomials)
        finer, body = _rectangle_shapes(tank, index, more, parity)[0], _rectangle(tank, index, more, parity)
        pressures = pressures_of(body)
        return rectangle_energies(
            plate, modes.coefficients, finer.coefficients, body.body, amplitudes, eigenvalues, pressures
        )

    return PlanPlate(
        body=_body(plate, index, deflection, dofs, bending, squares),
        deflection=deflection,
        wavenumber=1.5 * polynomials / min(outline.size),
        missing_energy=missing,
    )


def _as_rectangle(outline: Outline) -> Rectangle:
    if isinstance(outline, Strip):
        middle = outline.start + 0.5 * outline.length, 0.5 * outline.width
        return Rectangle(position=middle, size=(outline.length, outline.width))
    assert isinstance(outline, Rectangle)
    return outline


def _rectangle_shapes(
    tank: LevelTank, index: int, polynomials: int, parity: ClassParity
) -> tuple[RectangleModes, tuple[Dof, ...]]:
    """Dry modes of one symmetry of the tank: heave, ends of pitch, slope of roll and mean squares are 1."""
    plate, outline = tank.plates[index], _as_rectangle(tank.plates[index].outline)
    edges = [_held(tank, plate, axis, outline) for axis in (0, 1)]
    # Shapes of either parity about the plate's own middle exist apart where its two edges are held alike.
    choices: list[tuple[AxisParity, ...]] = [
        (None,) if pair[0] != pair[1] else (0, 1) if wanted is None else (wanted,)
        for pair, wanted in zip(edges, parity, strict=True)
    ]
    tables, stiffness = [], []
    rigid: list[Dof] = []
    for own in product(*choices):
        modes = rectangle_modes(
            outline.size, plate.poisson_ratio, polynomials, edges=(edges[0], edges[1]), parities=(own[0], own[1])
        )
        loose = int(np.sum(modes.stiffness == 0.0))
        count = len(modes.stiffness) if plate.is_elastic else loose
        table = modes.coefficients[:count] * np.sqrt(outline.area)
        for number in range(loose):
            # Pitch is odd along x, roll along y; a hinged plate turns about its hinges.
            odd = own.index(1) + 1 if 1 in own else 0
            name = _RIGID_MOTIONS[len(rigid) if odd == 0 and None in own else odd]
            unit = {"heave": 1.0, "pitch": 1.0 / np.sqrt(3.0), "roll": outline.size[1] / np.sqrt(12.0)}[name]
            table[number] *= np.sign(table[number].sum()) * unit
            rigid.append(Dof(name))
        tables.append(table)
        stiffness.append(modes.stiffness[:count])
    values = np.concatenate(stiffness)
    shapes = RectangleModes(size=outline.size, stiffness=values, coefficients=np.concatenate(tables))
    return shapes, _dofs_by_stiffness(values, rigid)


def _held(tank: LevelTank, plate: Plate, axis: int, outline: Rectangle) -> tuple[Edge, Edge]:
    """What holds both edges along an axis: those that do not touch a wall of a box are free."""
    if not isinstance(tank.plan, Box):
        return "free", "free"
    if isinstance(plate.outline, Strip) and axis == 1:
        return "sliding", "sliding"
    middle, half = outline.position[axis], 0.5 * outline.size[axis]
    end = (tank.plan.length, tank.plan.width)[axis] - _TOUCHING
    return plate.edge if middle - half < _TOUCHING else "free", plate.edge if middle + half > end else "free"


def _dofs_by_stiffness(stiffness: NDArray[np.float64], rigid: list[Dof]) -> tuple[Dof, ...]:
    """Names of shapes: rigid motions in their order, elastic ones numbered from the softest."""
    left = iter(rigid)
    ranks = np.argsort(np.argsort(stiffness, kind="stable"), kind="stable") - len(rigid) + 1
    return tuple(
        next(left) if value == 0.0 else Dof.elastic(int(rank)) for value, rank in zip(stiffness, ranks, strict=True)
    )


def _body(
    plate: Plate,
    index: int,
    deflection: Deflection,
    dofs: tuple[Dof, ...],
    bending: NDArray[np.float64],
    squares: NDArray[np.float64],
) -> Body:
    parities: tuple[Parity, ...] = tuple("symmetric" for _ in squares)
    return Body(
        surface=body_name(index + 1),
        shapes=lambda points, _normals: deflection(points[:2]),
        wavenumber=0.0,
        dofs=dofs,
        parities=parities,
        stiffness=bending + float(plate.hydrostatic) * squares,
        bending_stiffness=bending,
        mass=np.diag(plate.mass_per_area * squares),
        motions=np.eye(len(squares)),
    )


@dataclass(frozen=True, kw_only=True)
class _DiscShapes:
    """Shapes W(r) cos nθ and W(r) sin nθ of a disc or ring.

    Attributes:
        disc: the outline.
        orders: n of each family, and +1 for cosines, −1 for sines.
        families: its radial shapes.
        factors: of each shape, shape (shapes,).
    """

    disc: Disc
    orders: tuple[tuple[int, int], ...]
    families: tuple[LineModes, ...]
    factors: NDArray[np.float64]

    def __call__(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        x, y = points - np.array(self.disc.position)[:, None]
        radius = np.clip(np.hypot(x, y), self.disc.inner_radius, self.disc.radius)
        angle = np.arctan2(y, x)
        tables = [
            modes.values(radius).T * (np.cos(order * angle) if sign > 0 else np.sin(order * angle))
            for (order, sign), modes in zip(self.orders, self.families, strict=True)
        ]
        if not tables:
            return np.empty((0, len(radius)))
        return np.concatenate(tables) * self.factors[:, None]


def _disc(tank: LevelTank, index: int, disc: Disc, polynomials: int, parity: ClassParity) -> PlanPlate:
    plate = tank.plates[index]
    edge = plate.edge if _covers(tank, disc) else "free"
    edges: tuple[Edge, Edge] = ("free", edge)
    orders, families = [], []
    # Polynomials of degree up to twice their number: order n and 2 per radial function.
    highest = polynomials
    for order in range(highest + 1 if plate.is_elastic else 2):
        line = PlateLine(
            start=disc.inner_radius,
            end=disc.radius,
            round=True,
            transverse=float(order),
            poisson_ratio=plate.poisson_ratio,
            edges=edges,
        )
        count = max(ceil(0.5 * (polynomials - 0.5 * order)) + 1, 5) if plate.is_elastic else line.rigid_count
        count += 2 if disc.inner_radius and plate.is_elastic else 0
        if count:
            for sign in (1, -1) if order else (1,):
                if _is_of(parity, order, sign):
                    orders.append((order, sign))
                    families.append(dry_modes(line, count))
    factors, squares, bending, rigid = [], [], [], []
    for (order, sign), modes in zip(orders, families, strict=True):
        whole = 2.0 * pi if order == 0 else pi
        for place in range(modes.count):
            if place < modes.rigid:
                # W is 1 of heave, r/a of pitch, r of roll.
                edge_value = float(modes.values(np.array([disc.radius]))[0, place])
                factor = (1.0 if order == 0 or sign > 0 else disc.radius) / edge_value
                rigid.append(Dof("heave" if order == 0 else "pitch" if sign > 0 else "roll"))
            else:
                factor = 1.0
            factors.append(factor)
            squares.append(whole * modes.squares[place] * factor**2)
            bending.append(whole * modes.bending[place] * factor**2)
    shapes = _DiscShapes(disc=disc, orders=tuple(orders), families=tuple(families), factors=np.array(factors))
    rigidity = plate.flexural_rigidity if plate.is_elastic else 0.0
    names = _dofs_by_stiffness(np.array(bending) / np.array(squares), rigid)
    body = _body(plate, index, shapes, names, rigidity * np.array(bending), np.array(squares))
    return PlanPlate(
        body=body,
        deflection=shapes,
        wavenumber=0.8 * polynomials / disc.radius,
        missing_energy=partial(_disc_tail, body, shapes),
    )


def _is_of(parity: ClassParity, order: int, sign: int) -> bool:
    """Whether cos nθ (sign +1) or sin nθ (−1) has a parity: x → −x turns θ to π − θ, y → −y to −θ."""
    sine = int(sign < 0)
    return all(wanted in (None, own) for wanted, own in zip(parity, ((order + sine) % 2, sine), strict=True))


def _covers(tank: LevelTank, disc: Disc) -> bool:
    return (
        isinstance(tank.plan, Cylinder)
        and disc.position == (0.0, 0.0)
        and disc.radius >= tank.plan.radius * (1.0 - 1e-9)
    )


def _disc_tail(
    body: Body,
    shapes: _DiscShapes,
    amplitudes: NDArray[np.float64],
    _eigenvalues: NDArray[np.float64],
    _pressures_of: Pressures,
) -> NDArray[np.float64]:
    """Energy of the orders and radial polynomials left out, from that of the last ones."""
    energies = body.stiffness * amplitudes**2
    rigid_free = body.bending_stiffness > 0.0
    if not rigid_free.any():
        return np.zeros(len(amplitudes))
    of_order = np.zeros((len(amplitudes), max(order for order, _ in shapes.orders) + 1))
    radial = np.zeros(len(amplitudes))
    first = 0
    for (order, _), modes in zip(shapes.orders, shapes.families, strict=True):
        own = slice(first, first + modes.count)
        of_order[:, order] += energies[:, own].sum(axis=1)
        if rigid_free[own].any():
            # From dry modes back to the polynomials, by ascending degree.
            inverse = np.linalg.pinv(modes.coefficients)
            parts = amplitudes[:, own] @ modes.coefficients.T
            stiffness = (inverse.T * body.stiffness[own]) @ inverse
            last, before = (
                ((parts[:, -kept:] @ stiffness[-kept:, -kept:]) * parts[:, -kept:]).sum(axis=1) for kept in (1, 2)
            )
            radial += geometric_tail(last, before - last)
        first += modes.count
    return radial + geometric_tail(of_order[:, -2:].sum(axis=1), of_order[:, -4:-2].sum(axis=1))


def _polygon(plate: Plate, index: int, outline: Polygon, polynomials: int, parity: ClassParity) -> PlanPlate:
    modes = polygon_modes(outline.points, plate.poisson_ratio, min(polynomials, _HIGHEST_OF_POLYGON), parity)
    count = len(modes.stiffness) if plate.is_elastic else modes.rigid
    root = float(np.sqrt(outline.area))
    squares = np.full(count, outline.area)
    rigidity = plate.flexural_rigidity if plate.is_elastic else 0.0

    def deflection(points: NDArray[np.float64]) -> NDArray[np.float64]:
        return modes.deflection(points)[:count] * root

    # Of 1, x and y those of the parity.
    rigid = [
        Dof(name)
        for name, own in zip(_RIGID_MOTIONS, ((0, 0), (1, 0), (0, 1)), strict=True)
        if all(wanted in (None, one) for wanted, one in zip(parity, own, strict=True))
    ]
    names = (*rigid, *(Dof.elastic(number + 1) for number in range(count - modes.rigid)))
    bending = rigidity * modes.stiffness[:count] * squares if plate.is_elastic else np.zeros(count)
    return PlanPlate(
        body=_body(plate, index, deflection, names, bending, squares),
        deflection=deflection,
        wavenumber=0.8 * modes.basis.degree / float(modes.basis.half.min()),
        missing_energy=partial(_polygon_tail, modes, rigidity * outline.area, float(plate.hydrostatic) * outline.area),
    )


def _polygon_tail(
    modes: PolygonModes,
    factor: float,
    level: float,
    amplitudes: NDArray[np.float64],
    _eigenvalues: NDArray[np.float64],
    _pressures_of: Pressures,
) -> NDArray[np.float64]:
    """Potential energy of the degrees left out, from that of the last two."""
    if amplitudes.shape[1] < len(modes.stiffness) or not factor:
        return np.zeros(len(amplitudes))
    # Of the functions made orthonormal one after the other, those of the last degrees.
    parts = np.linalg.solve(modes.orthonormal, (amplitudes @ modes.coefficients).T).T
    degree, degrees = modes.basis.degree, modes.basis.degrees

    def beyond(dropped: int) -> NDArray[np.float64]:
        rest = parts * (degrees > degree - dropped)
        energy: NDArray[np.float64] = factor * ((rest @ modes.bending) * rest).sum(axis=1)
        return energy + level * (rest**2).sum(axis=1)

    last = beyond(2)
    return missing_after(last, beyond(4) - last)
