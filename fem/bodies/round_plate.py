"""A round plate as a body of the field model: its dry modes of one azimuthal order as displacements of its lower side.

Shapes W(r) cos nθ are scaled to W(a) = 1, but the pitch r of order 1, whose amplitude is an angle. With the factor c of
the geometry, their generalized mass and stiffness are c m∫W² r dr and c (D∫… + T∫… + Δρ g∫W² r dr).
"""

from __future__ import annotations

from math import ceil, pi

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray

from hydroelastic.fem.bodies.model import BodyModel
from hydroelastic.fem.surfaces import Body
from hydroelastic.modal.plate.line_modes import FEW_MODES, PlateLine, dry_modes
from hydroelastic.physics.dofs import Dof, body_name
from hydroelastic.physics.round_plates import LOWEST_BENT, RoundPlate
from hydroelastic.physics.symmetry import Parity

# Error of the deflection by the first N dry modes, _ERROR (_MODES/N)⁵, measured at the edge of discs.
_ERROR, _MODES = 6e-5, 4.0
# The added mass of rigid discs on deep liquids with ψ = 0 beside them is that of a depth of a/2.36 in heave and of
# a/4.4 in pitch: of about a/(2.4 + 2n) in shapes of order n.
_OF_HEAVE, _OF_AN_ORDER = 2.4, 2.0


class RoundPlateModel(BodyModel):
    """A round plate in its first dry modes of the order of its tank."""

    @property
    def plate(self) -> RoundPlate:
        """The plate."""
        return plate_of(self.tank.bodies[self.index])

    def moving(self, count: int, parity: Parity | None) -> Body:
        """See `BodyModel.moving`; a rigid plate has its rigid motions alone."""
        return self.in_shapes(RoundShapes(self.plate.of_order(self.tank.geometry.order), count))

    def in_shapes(self, shapes: RoundShapes) -> Body:
        """Return the plate in given shapes."""
        plate, measure = self.plate, self.tank.geometry.measure
        squares, bending = measure * shapes.squares, measure * shapes.bending
        # Not asked for: half-planes have no halves.
        symmetric: Parity = "symmetric"
        restoring = float(plate.hydrostatic) * self.tank.level_of(self.index).jump * squares
        return Body(
            surface=body_name(self.index + 1),
            shapes=lambda points, normals: shapes.values(points[0]) * normals[1],
            wavenumber=pi * shapes.count / (plate.radius - plate.inner_radius),
            dofs=shapes.dofs,
            parities=(symmetric,) * shapes.count,
            motions=np.eye(shapes.count),
            stiffness=bending + restoring,
            bending_stiffness=bending,
            mass=np.diag(plate.mass_per_area * squares),
        )

    def dry_mode_count(self, wavenumber: float, tolerance: float) -> int:
        """Return the number of dry modes up to the shortest wave, and of a tail whose error falls like N⁻⁵."""
        if not self.plate.bends:
            return 0
        half_waves = wavenumber * (self.plate.radius - self.plate.inner_radius) / pi
        # The errors of all orders add up, and about so many of them bend the plate.
        orders = 1.0 + wavenumber * self.plate.radius
        return ceil(half_waves + _MODES * (_ERROR * orders / tolerance) ** 0.2) + 2

    def expected_tones(self) -> tuple[float, ...]:
        """Estimate λ of the lowest elastic dry mode on a deep open liquid, where it is one of the tank's order."""
        if not self.elastic_shapes(1):
            return ()
        plate, order, level = self.plate, self.tank.geometry.order, self.tank.level_of(self.index)
        shapes = RoundShapes(plate.of_order(order), len(plate.of_order(order).rigid_motions) + 1)
        stiffness = shapes.bending[-1] / shapes.squares[-1] + float(plate.hydrostatic) * level.jump
        liquid = self.tank.density_at(level) * plate.radius / (_OF_HEAVE + _OF_AN_ORDER * order)
        return (float(stiffness / (plate.mass_per_area + liquid)),)

    def elastic_shapes(self, count: int) -> int:
        """See `BodyModel.elastic_shapes`."""
        counts = lowest_elastic(self.plate, count)
        return dict(enumerate(counts)).get(self.tank.geometry.order, 0)


def lowest_elastic(plate: RoundPlate, count: int) -> tuple[int, ...]:
    """Return how many of the lowest elastic dry modes are of each order 0, 1 …; none of a rigid plate."""
    found: list[tuple[float, int]] = []
    # From the second order on the lowest mode rises with the order.
    for order in range(count + LOWEST_BENT if plate.bends else 0):
        shapes = RoundShapes(plate.of_order(order), len(plate.of_order(order).rigid_motions) + count)
        own = [(float(one / other), order) for one, other in zip(shapes.bending, shapes.squares, strict=True) if one]
        if len(found) == count and order >= LOWEST_BENT and min(own)[0] > found[-1][0]:
            break
        found = sorted([*found, *own])[:count]
    orders = [order for _, order in found]
    return tuple(orders.count(order) for order in range(max(orders, default=-1) + 1))


class RoundShapes:
    """The first dry modes of a round plate of one order.

    Args:
        plate: the plate, with its order.
        count: number of shapes, rigid ones included; of a rigid plate these alone.
        spare: polynomials beyond this number: with more of them than shapes, all of these are dry modes.

    Attributes:
        squares: ∫W² r dr, shape (shapes,).
        bending: the energy of bending and tension likewise, shape (shapes,).
    """

    def __init__(self, plate: RoundPlate, count: int, spare: int | None = None) -> None:
        assert plate.order is not None
        self._plate, rigid = plate, plate.rigid_motions
        self.count = count if plate.bends else min(count or len(rigid), len(rigid))
        line = PlateLine(
            start=plate.inner_radius,
            end=plate.radius,
            round=True,
            transverse=float(plate.order),
            poisson_ratio=plate.poisson_ratio,
            edges=("free", "free"),
            rigidity=plate.flexural_rigidity if plate.bends else 1.0,
            tension=plate.tension if plate.bends else 0.0,
        )
        # A rigid plate has no shape of order 2 or more.
        polynomials = max(self.count + (max(FEW_MODES, self.count) if spare is None else spare), 1)
        self._modes = dry_modes(line, polynomials)
        edge = self._modes.values(np.array([plate.radius]))[0, : self.count]
        self._factors = np.where([dof.is_rotation for dof in self.dofs], plate.radius, 1.0) / edge
        self.squares: NDArray[np.float64] = self._modes.squares[: self.count] * self._factors**2
        self.bending: NDArray[np.float64] = self._modes.bending[: self.count] * self._factors**2

    @property
    def dofs(self) -> tuple[Dof, ...]:
        """Rigid motions, then elastic shapes by their number of nodal diameters."""
        rigid = self._plate.rigid_motions
        elastic = (Dof.elastic(number + 1, self._plate.order) for number in range(self.count - len(rigid)))
        return (*rigid, *elastic)[: self.count]

    def values(self, radii: NDArray[np.float64], derivative: int = 0) -> NDArray[np.float64]:
        """Return W, or a derivative, at radii of the plate, shape (shapes, points)."""
        inside = np.clip(radii, self._plate.inner_radius, self._plate.radius)
        values: NDArray[np.float64] = (self._modes.values(inside, derivative)[:, : self.count] * self._factors).T
        return values

    def bent(self, radii: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return W, W′, W″ and ∂(ΔₙW)/∂r at radii by the loads that bend the plate like its shapes, and the part of
        them in the last third of the polynomials, shape (2, 4, shapes, points); of shapes without `spare` polynomials.

        The last one is zero of membranes and rigid plates.
        """
        values = np.zeros((2, 4, self.count, len(radii)))
        values[0, :3] = [self.values(radii, derivative) for derivative in range(3)]
        if self._plate.bends and self._plate.flexural_rigidity:
            laplacian, values[:, 3] = self._laplacians(radii).swapaxes(0, 1)
            off_axis, order = radii > 0.0, self._plate.order or 0
            r, (value, slope) = radii[off_axis], values[0, :2][..., off_axis]
            values[0, 2][:, off_axis] = laplacian[0][:, off_axis] - slope / r + order**2 * value / r**2
            values[1, 2] = laplacian[1]
        return values

    def _laplacians(self, radii: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return Δₙw and its derivative at radii, and the part of both in the last polynomials, shape (2, 2, shapes,
        points).

        With u = DΔₙw − Tw the load is Δₙu, and u = (1 − ν)D(w′/r − n²w/r²) − Tw at free edges. Sums over the shapes
        converge faster than those of the derivatives of w.
        """
        count = self.count
        plate, order = self._plate, float(self._plate.order or 0)
        nodes, weights = leggauss(2 * count + int(order) + 4)
        half = 0.5 * (plate.radius - plate.inner_radius)
        inside = plate.inner_radius + half * (1.0 + nodes)
        parts = [self.values(inside, 1), order / inside * self.values(inside)]
        energy = sum((part * (half * weights * inside)) @ part.T for part in parts)
        edges = np.array([plate.inner_radius, plate.radius])[int(plate.inner_radius == 0.0) :]
        value, slope = (self.values(edges, derivative) for derivative in (0, 1))
        rigidity = plate.flexural_rigidity
        held = (1.0 - plate.poisson_ratio) * rigidity * (slope / edges - order**2 * value / edges**2)
        held -= plate.tension * value
        # ∫(u′v′ + n²uv/r²) r dr = −∫Δₙu v r dr for all v that vanish at the edges.
        scale = 1.0 / np.sqrt(np.diag(energy) + self.squares)
        corner = np.zeros((len(edges), len(edges)))
        system = np.block([[scale[:, None] * energy * scale, scale[:, None] * value], [value.T * scale, corner]])
        loads = np.vstack([-np.diag(self.bending) * scale[:, None], held.T])
        combined = np.linalg.solve(system, loads)[:count] * scale[:, None]
        whole = (combined + plate.tension * np.eye(count)) / rigidity
        polynomials = self._modes.coefficients @ (self._factors[:, None] * whole)
        degrees = np.arange(len(polynomials))
        is_last = degrees >= count - count // 3
        found = [
            [(self._modes.plate.raw(len(degrees), radii, derivative) * kept) @ polynomials for derivative in (0, 1)]
            for kept in (1.0, is_last)
        ]
        return np.array(found).swapaxes(-1, -2)


def plate_of(body: object) -> RoundPlate:
    """Return a body that is a round plate."""
    assert isinstance(body, RoundPlate)
    return body
