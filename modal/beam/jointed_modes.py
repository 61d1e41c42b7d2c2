"""Dry modes of a beam with free ends whose rigidity and mass vary, step, or that has joints and hinges: piecewise
polynomials from one singular-value problem.

The unknowns are what carries strain: the curvature w″ of each smooth span, in polynomials that are orthonormal in the
strain energy, those of Legendre where the rigidity is constant, and the
slope jump of each elastic joint. Scaled by the roots of their stiffnesses they have the strain energy |y|²; the
deflection that follows from them, without its rigid part and weighed with the root of the mass, is B y, exact at Gauss
points. So with B = Σ uₙ σₙ vₙᵀ

    ωₙ = 1/σₙ,    vₙ: curvatures orthonormal in the strain energy,    uₙ: deflections orthonormal in the mass.

Continuity needs no condition, K and M are never formed, and rounding grows with the ratio σ₁/σₙ of the frequencies
only, where a stiffness matrix of polynomials would lose (p²/h)⁴. Rigid shapes are linear between hinges.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from math import ceil, pi, sqrt
from typing import Literal

import numpy as np
from numpy.polynomial import legendre
from scipy.linalg import lapack, qr, solve_triangular

from hydroelastic.modal.beam.dry_modes import RIGID_SHAPES
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.beam_parts import Section
from hydroelastic.physics.beams import Beam, defines_shape_direction
from hydroelastic.physics.dofs import Dof

Side = Literal["left", "right"]


# LAPACK's JOBA = 'F': columns of any sizes.
_FULL = 2
# Gauss points beyond the degree: exact for rigidities and masses that are cubic.
_MORE_POINTS = 3
# Points of a span at which the slowest wave is looked for.
_SAMPLES = np.linspace(0.005, 0.995, 100)


@dataclass(frozen=True, kw_only=True)
class JointedModes:
    """The lowest dry modes, of unit generalized mass ∫m w² = 1: heave, pitch, one for each hinge, then elastic ones."""

    beam: Beam
    squared_frequencies: FloatArray  # λ of each mode, (rad/s)²; exactly 0 for the rigid ones; shape (modes,)
    # +1 or −1 for each mode of a beam that is its own mirror image, by which w(l − x) = ± w(x); all +1 for any other
    # beam, whose mirror image has the mirrored shapes
    parities: tuple[int, ...]
    deflections: tuple[FloatArray, ...]  # Legendre coefficients of w on each span, arrays (modes, degree + 1)
    curvatures: tuple[FloatArray, ...]  # those of w″

    @property
    def rigid(self) -> int:
        """Number of modes without strain."""
        return RIGID_SHAPES + len(self.beam.hinges)

    @property
    def dofs(self) -> tuple[Dof, ...]:
        """What each mode is."""
        return self.beam.dofs(len(self.squared_frequencies))

    @property
    def wavenumbers(self) -> FloatArray:
        """κ = (m λ/EI)^{1/4} of the highest mode in each span, 1/m."""
        highest = float(self.squared_frequencies.max(initial=0.0))
        return highest**0.25 * _slowness(self.beam)

    def shapes(self, x: FloatArray, derivative: int = 0, side: Side = "right") -> FloatArray:
        """Evaluate w of all modes or a derivative of it.

        Args:
            x: distances from the left end, m, in [0, l], shape (points,).
            derivative: order 0 … 3.
            side: of which limit at joints and steps.

        Returns:
            The values, shape (modes, points).
        """
        if derivative not in (0, 1, 2, 3):
            raise ValueError(f"derivative is {derivative}; orders 0, 1, 2 and 3 are available")
        edges = np.array(self.beam.edges)
        if not np.all((x >= edges[0]) & (x <= edges[-1])):
            raise ValueError("x must lie on the beam")
        owners = np.searchsorted(edges[1:-1], x, side=side)
        tables, order = (self.deflections, derivative) if derivative < 2 else (self.curvatures, derivative - 2)
        values = np.empty((len(self.squared_frequencies), len(x)))
        for span, table in enumerate(tables):
            here = owners == span
            half = 0.5 * (edges[span + 1] - edges[span])
            slopes = legendre.legder(table, order, axis=1) / half**order
            t = np.clip((x[here] - edges[span]) / half - 1.0, -1.0, 1.0)
            values[:, here] = slopes @ legendre.legvander(t, slopes.shape[1] - 1).T
        return values

    def bending_moments(self, x: FloatArray, side: Side = "right") -> FloatArray:
        """EI w″ of all modes of a beam of uniform sections, N per metre of width for w in metres; continuous."""
        return self._rigidities(x, side) * self.shapes(x, 2, side)

    def shear_forces(self, x: FloatArray, side: Side = "right") -> FloatArray:
        """(EI w″)′ of all modes of a beam of uniform sections; continuous, 0 at free ends."""
        return self._rigidities(x, side) * self.shapes(x, 3, side)

    def _rigidities(self, x: FloatArray, side: Side) -> FloatArray:
        owners = np.searchsorted(np.array(self.beam.edges[1:-1]), x, side=side)
        found: FloatArray = np.array([part.flexural_rigidity for part in self.beam.spans])[owners]
        return found

    def products(self, beam: Beam) -> FloatArray:
        """∫m wᵢ wⱼ with the mass of a beam of the same spans, shape (modes, modes)."""
        total = np.zeros((len(self.squared_frequencies),) * 2)
        for span, (part, table) in enumerate(zip(beam.spans, self.deflections, strict=True)):
            nodes, weights = legendre.leggauss(table.shape[1] + _MORE_POINTS)
            values = table @ legendre.legvander(nodes, table.shape[1] - 1).T
            mass = beam.mass_of(span, 0.5 * (1.0 + nodes))
            total += (values * (0.5 * part.length * weights * mass)) @ values.T
        return total


@lru_cache(maxsize=64)
def jointed_modes(beam: Beam, count: int) -> JointedModes:
    """Return the first dry modes of a beam.

    Args:
        count: how many, rigid ones included.

    Returns:
        The modes; frequencies and shapes keep about 1e-16 times the ratio of the highest to the lowest frequency.

    Source: Euler–Bernoulli beams with jumps of EI, m and, at springs, of the slope; the Ritz method in complete
    polynomials of each span.
    """
    if count < 0:
        raise ValueError(f"count is {count}; it must not be negative")
    if not defines_shape_direction(beam):
        return _mirrored(jointed_modes(beam.reversed, count), beam)
    basis = _Basis(beam, _degrees(beam, count))
    rigid, rigid_parities = basis.rigid_shapes()
    wanted = max(count - rigid.shape[1], 0)
    # A beam that is its own mirror image has modes of either parity, apart even where frequencies coincide.
    found = [_elastic(basis, rigid, parity, wanted) for parity in ((1, -1) if beam.is_mirror_image else (0,))]
    deflections = np.hstack([rigid, *(modes.deflections for modes in found)])
    amplitudes = np.hstack([np.zeros((basis.size, rigid.shape[1])), *(modes.amplitudes for modes in found)])
    values = np.concatenate([np.zeros(rigid.shape[1]), *(modes.squared_frequencies for modes in found)])
    parities = np.concatenate([rigid_parities, *(modes.parities for modes in found)])
    order = np.argsort(values, kind="stable")[:count]
    curvatures = basis.curvature_coefficients(amplitudes[:, order])
    return JointedModes(
        beam=beam,
        squared_frequencies=values[order],
        parities=tuple(int(parity) for parity in parities[order]),
        deflections=basis.deflection_coefficients(deflections[:, order], curvatures, values[order]),
        curvatures=curvatures,
    )


def _mirrored(modes: JointedModes, beam: Beam) -> JointedModes:
    def turned(tables: tuple[FloatArray, ...]) -> tuple[FloatArray, ...]:
        return tuple(table * (-1.0) ** np.arange(table.shape[1]) for table in reversed(tables))

    return JointedModes(
        beam=beam,
        squared_frequencies=modes.squared_frequencies,
        parities=modes.parities,
        deflections=turned(modes.deflections),
        curvatures=turned(modes.curvatures),
    )


def _degrees(beam: Beam, count: int) -> list[int]:
    """Degree of the curvature on each span, up to the highest mode.

    Modes are counted as half waves, Σ κl/π, and one more for each end of a span. A wave has Legendre coefficients like
    the spherical Bessel functions jₙ(z), z = κh/2, which vanish to rounding a dozen Airy widths beyond n = z.
    """
    phases = [part.length * slowness for part, slowness in zip(beam.spans, _slowness(beam), strict=True)]
    half_waves = count + 2 + 2 * len(phases)
    waves = [0.5 * pi * half_waves * phase / sum(phases) for phase in phases]
    return [ceil(z + 13.0 * (0.5 * z) ** (1.0 / 3.0)) + 10 for z in waves]


def _slowness(beam: Beam) -> FloatArray:
    """The largest (m/EI)^{1/4} of each span, whose product with λ^{1/4} is the wavenumber of the shortest wave."""
    ratios = (beam.mass_of(span, _SAMPLES) / beam.rigidity_of(span, _SAMPLES) for span in range(len(beam.spans)))
    return np.array([float(ratio.max()) ** 0.25 for ratio in ratios])


class _Basis:
    """Curvatures in Legendre polynomials and slope jumps of joints, and the deflections that follow from them.

    Columns: polynomials of the spans from left to right, then joints; each of unit strain energy. Rows: Gauss points.
    """

    def __init__(self, beam: Beam, degrees: list[int]) -> None:
        self.beam, self.degrees = beam, degrees
        self.edges = np.array(beam.edges)
        self.joints = [joint for joint in beam.joints if joint.rotational_stiffness > 0.0]
        rules = [legendre.leggauss(degree + _MORE_POINTS) for degree in degrees]
        self._local = [nodes for nodes, _ in rules]
        self._weights = [weights for _, weights in rules]
        spans = list(zip(beam.spans, self._local, self._weights, self.edges, strict=False))
        self.x = np.concatenate([left + 0.5 * part.length * (1.0 + t) for part, t, _, left in spans])
        masses = [beam.mass_of(span, 0.5 * (1.0 + t)) for span, t in enumerate(self._local)]
        self.root_mass = np.concatenate(
            [np.sqrt(0.5 * part.length * mass * w) for mass, (part, _, w, _) in zip(masses, spans, strict=True)]
        )
        self._orthonormal = [self._orthonormal_polynomials(span) for span in range(len(degrees))]
        self._rows = np.cumsum([0, *(len(nodes) for nodes in self._local)])
        self._columns = np.cumsum([0, *(degree + 1 for degree in degrees)])
        self.size = int(self._columns[-1]) + len(self.joints)

    def table(self) -> FloatArray:
        """B: weighed deflections of each column, up to rigid motions."""
        table = np.zeros((len(self.x), self.size))
        for span, (part, degree) in enumerate(zip(self.beam.spans, self.degrees, strict=True)):
            first, last = self._columns[span], self._columns[span + 1]
            table[:, first:last] = self._deflections(span, part, degree)
        for number, joint in enumerate(self.joints, int(self._columns[-1])):
            arm = np.maximum(self.x - self.edges[self.beam.node_of(joint)], 0.0)
            table[:, number] = arm / sqrt(joint.rotational_stiffness)
        return self.root_mass[:, None] * table

    def _orthonormal_polynomials(self, span: int) -> FloatArray:
        """Legendre coefficients, as columns, of the polynomials of one span with ∫EI pᵢ pⱼ = δᵢⱼ."""
        half, nodes, degree = 0.5 * self.beam.spans[span].length, self._local[span], self.degrees[span]
        rigidities = self.beam.rigidity_of(span, 0.5 * (1.0 + nodes))
        if np.all(rigidities == rigidities[0]):
            return np.diag(np.sqrt((np.arange(degree + 1) + 0.5) / (half * rigidities[0])))
        roots = np.sqrt(half * rigidities * self._weights[span])
        triangle = qr(roots[:, None] * legendre.legvander(nodes, degree), mode="economic")[1]
        # Of one sign, so that mirror images are.
        found: FloatArray = solve_triangular(triangle, np.diag(np.sign(np.diag(triangle))))
        return found

    def _deflections(self, span: int, part: Section, degree: int) -> FloatArray:
        """∬ of the orthonormal polynomials of one span, straight on beyond it."""
        half = 0.5 * part.length
        slopes = legendre.legint(np.eye(degree + 1), lbnd=-1)
        integrals = legendre.legint(slopes, lbnd=-1)
        found = np.zeros((len(self.x), degree + 1))
        rows = slice(self._rows[span], self._rows[span + 1])
        found[rows] = half**2 * legendre.legvander(self._local[span], degree + 2) @ integrals
        beyond = self.x[self._rows[span + 1] :] - self.edges[span + 1]
        # Of degree 2 and more nothing is left at the end.
        for number, (slope, end) in enumerate(((2.0, 2.0), (0.0, -2.0 / 3.0))):
            found[self._rows[span + 1] :, number] = half**2 * end + half * slope * beyond
        return found @ self._orthonormal[span]

    def rigid_shapes(self) -> tuple[FloatArray, FloatArray]:
        """Weighed rigid shapes, orthonormal, and their parities."""
        middle, hinges = 0.5 * self.beam.length, list(self.beam.hinges)
        columns, parities = [np.ones_like(self.x), self.x - middle], [1, -1]
        if self.beam.is_mirror_image:
            pairs = [(hinge, image) for hinge, image in zip(hinges, hinges[::-1], strict=True) if hinge <= image]
            for number, (hinge, image) in enumerate(pairs):
                if 2 * number + 1 == len(hinges):
                    columns.append(np.abs(self.x - middle))
                    parities.append(1)
                else:
                    both = np.abs(self.x - hinge), np.abs(self.x - image)
                    columns += [both[0] + both[1], both[0] - both[1]]
                    parities += [1, -1]
        else:
            columns += [np.abs(self.x - hinge) for hinge in hinges]
            parities += [1] * (len(hinges))
            parities[1] = 1
        shapes, triangle = qr(self.root_mass[:, None] * np.array(columns).T, mode="economic")
        return shapes * np.sign(np.diag(triangle)), np.array(parities)

    def images(self) -> tuple[FloatArray, FloatArray]:
        """Of each column the number of its mirror image, and the sign of that."""
        numbers = np.empty(self.size, dtype=int)
        signs = np.ones(self.size)
        spans = len(self.degrees)
        for span, degree in enumerate(self.degrees):
            own = np.arange(degree + 1)
            numbers[self._columns[span] + own] = self._columns[spans - 1 - span] + own
            signs[self._columns[span] + own] = (-1.0) ** own
        joints = np.arange(len(self.joints))
        numbers[self._columns[-1] + joints] = self._columns[-1] + joints[::-1]
        return numbers, signs

    def combinations(self, parity: int) -> FloatArray:
        """Columns of one parity as combinations of all, orthonormal; every column for parity 0."""
        if parity == 0:
            return np.eye(self.size)
        numbers, signs = self.images()
        columns = []
        for number, image in enumerate(numbers):
            column = np.zeros(self.size)
            column[number] += 1.0
            column[image] += parity * signs[number]
            if number <= image and np.any(column):
                columns.append(column / np.linalg.norm(column))
        return np.array(columns).T

    def deflection_coefficients(
        self, weighed: FloatArray, curvatures: tuple[FloatArray, ...], squared_frequencies: FloatArray
    ) -> tuple[FloatArray, ...]:
        """Legendre coefficients on each span of weighed deflections at the points.

        Those of low degree follow from the values, the others from the curvatures: integrated twice, rounding dies out
        with the degree, where slopes at the ends would multiply it. Rounding of a curvature grows like κ², so what is
        low grows with κ.
        """
        values = weighed / self.root_mass[:, None]
        slowness = _slowness(self.beam)
        tables = []
        for span, (part, degree) in enumerate(zip(self.beam.spans, self.degrees, strict=True)):
            table = (0.5 * part.length) ** 2 * legendre.legint(curvatures[span], 2, axis=1)
            wave = 0.5 * part.length * slowness[span] * squared_frequencies**0.25
            low = np.clip(np.ceil(wave ** (2.0 / 3.0)), 1, degree)
            numbers = np.arange(table.shape[1])
            polynomials = legendre.legvander(self._local[span], degree + 2) * self._weights[span][:, None]
            rows = values[self._rows[span] : self._rows[span + 1]]
            tables.append(np.where(numbers <= low[:, None], (polynomials.T @ rows).T * (numbers + 0.5), table))
        return tuple(tables)

    def curvature_coefficients(self, amplitudes: FloatArray) -> tuple[FloatArray, ...]:
        """Legendre coefficients on each span of curvatures with the given amplitudes of the columns."""
        return tuple(
            amplitudes[self._columns[span] : self._columns[span + 1]].T @ polynomials.T
            for span, polynomials in enumerate(self._orthonormal)
        )


@dataclass(frozen=True, kw_only=True)
class _Elastic:
    """Elastic modes: weighed deflections and amplitudes of the basis as columns, λ and parities."""

    deflections: FloatArray
    amplitudes: FloatArray
    squared_frequencies: FloatArray
    parities: FloatArray


def _elastic(basis: _Basis, rigid: FloatArray, parity: int, count: int) -> _Elastic:
    """The lowest elastic modes of one parity, or of none with 0."""
    combinations = basis.combinations(parity)
    table = basis.table() @ combinations
    # Twice, for what is rigid may be much the larger part.
    for _ in range(2):
        table -= rigid @ (rigid.T @ table)
    left, sizes, right = _singular_values(table)
    left, sizes, right = left[:, :count], sizes[:count], right[:, :count]
    # Upwards at the left end, where that moves.
    first = (left / basis.root_mass[:, None])[0]
    signs = np.where(first < 0.0, -1.0, 1.0)
    return _Elastic(
        deflections=left * signs,
        amplitudes=combinations @ (right * (signs / sizes)),
        squared_frequencies=1.0 / sizes**2,
        parities=np.full(len(sizes), parity or 1),
    )


def _singular_values(table: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Singular values, descending, with left and right vectors as columns, by Jacobi's method.

    It keeps the digits of small ones beside a column of any size: soft joints have large ones.
    """
    sizes, left, right, work, _, info = lapack.dgejsv(table, joba=_FULL, jobt=0, jobp=0)
    if info != 0:
        raise np.linalg.LinAlgError(f"the singular values did not converge: {info}")
    return left, sizes * (work[0] / work[1]), right
