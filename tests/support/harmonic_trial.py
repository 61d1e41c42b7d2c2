"""Harmonic functions that resolve corners, and their energies, for a liquid in a rectangular tank with bodies.

A potential is a sum of waves cos(nπx/L) e^{±nπy/L} and of poles outside the liquid, which cluster exponentially at its
corners (Gopal & Trefethen 2019, SIAM J. Numer. Anal. 57, "Solving Laplace problems with corner singularities via
rational functions") and fill the bodies. Poles are mirrored in both side walls,

    f(z) = a cot(π(z − p)/2L) − ā cot(π(z + p̄)/2L),

so that nothing is left to do there. Energies are integrals over the rest of the boundary, ∫∇u·∇v = ∮u ∂v/∂n, on
panels that are no longer than their distance from the next pole.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from float_sections import Arc

NODES = 16
Functions = Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]

SMALLEST = 26
"""Panels at a corner are 0.3 to this power of its room."""

RULE = np.polynomial.legendre.leggauss(NODES)


@dataclass(frozen=True, kw_only=True)
class Boundary:
    """Gauss nodes on a piece of boundary.

    Attributes:
        points: z, extended precision, shape (n,).
        normal: the unit normal nx + i ny out of the liquid, shape (n,).
        weights: with ds, shape (n,).
    """

    points: np.ndarray
    normal: np.ndarray
    weights: np.ndarray

    def turned(self, sign: float) -> Boundary:
        """The same with the normal times a sign."""
        return replace(self, normal=sign * self.normal)

    @staticmethod
    def joined(parts: list[Boundary]) -> Boundary:
        """Several pieces as one."""
        return Boundary(
            points=np.concatenate([part.points for part in parts]),
            normal=np.concatenate([part.normal for part in parts]),
            weights=np.concatenate([part.weights for part in parts]),
        )


def nodes_on(arcs: list[Arc], poles: np.ndarray, longest: float, *, reach: float = 0.7) -> Boundary:
    """Gauss nodes on arcs with the liquid to their right."""
    points, slopes, weights = [], [], []
    nodes, rule = (RULE[0].astype(np.longdouble) + 1) / 2, RULE[1] / 2
    for arc in arcs:
        pending = [(np.longdouble(0), np.longdouble(1))]
        while pending:
            start, length = pending.pop()
            places = start + length * nodes
            z, s = arc.point(places), arc.slope(places)
            size = float(length * np.abs(s).max())
            apart = float(np.abs(z[:, None] - poles[None, :]).min()) if len(poles) else np.inf
            if size > min(reach * apart, longest):
                pending += [(start, length / 2), (start + length / 2, length / 2)]
                continue
            points.append(z)
            slopes.append(s)
            weights.append(rule * np.abs(length * s).astype(float))
    slope = np.concatenate(slopes)
    return Boundary(
        points=np.concatenate(points),
        normal=(1j * slope / np.abs(slope)).astype(complex),
        weights=np.concatenate(weights),
    )


def clustered(corner: complex, outward: complex, scale: float, count: int, *, steepness: float = 4.0) -> np.ndarray:
    """Poles corner + scale·e^{−σ(√n − √k)}·outward, k = 1 … n."""
    distances = scale * np.exp(-steepness * (np.sqrt(count) - np.sqrt(np.arange(1, count + 1, dtype=np.longdouble))))
    return np.clongdouble(corner) + distances * np.clongdouble(outward)


@dataclass(frozen=True, kw_only=True)
class Corner:
    """A corner of a liquid: its place, where outside is, how far one may go there, and π over the liquid's angle."""

    place: complex
    outward: complex
    room: float
    exponent: float


@dataclass(frozen=True, kw_only=True)
class Slit:
    """A vertical slit in a liquid, from its tip to its end in the level, where potentials may differ on both sides."""

    tip: complex
    end: complex

    @property
    def beyond(self) -> complex:
        """Where cuts that begin at the tip end, outside."""
        return self.end + (self.end - self.tip)


@dataclass(frozen=True, kw_only=True)
class Trial:
    """Trial potentials of one liquid.

    Attributes:
        length: of the tank, m.
        low, high: y of the bottom and of the top of the liquid, m.
        corners: of the liquid but those of the tank.
        slits: of the liquid.
        inner: poles inside of sections, shape (n,).
        clustered: how many poles at each corner.
        steepness: of their clusters.
        waves: how many cosines, each at the bottom and at the top.
        powers: how many integers are added to the exponents of a corner.
        halves: whether half the exponents are needed too, where ψ is given on one side of a corner.
    """

    length: float
    low: float
    high: float
    corners: tuple[Corner, ...]
    slits: tuple[Slit, ...]
    inner: np.ndarray
    clustered: int
    steepness: float
    waves: int
    powers: int
    halves: bool

    @property
    def poles(self) -> np.ndarray:
        """All poles."""
        clusters = [
            clustered(corner.place, corner.outward, corner.room, self.clustered, steepness=self.steepness)
            for corner in self.corners
        ]
        return np.concatenate([self.inner.astype(np.clongdouble), *clusters])

    @property
    def attractors(self) -> np.ndarray:
        """Places to which panels shrink: the poles, and more of them towards corners."""
        towards = [(corner.place, corner.room * corner.outward) for corner in self.corners]
        for slit in self.slits:
            towards += [(slit.end, slit.end - slit.tip), (slit.tip, 1j * (slit.end - slit.tip))]
        steps = [place + step * np.longdouble(0.3) ** np.arange(SMALLEST) for place, step in towards]
        return np.concatenate([self.poles, *steps])

    def values(self, boundary: Boundary) -> tuple[np.ndarray, np.ndarray]:
        """The trial functions and their normal derivatives, shape (nodes, functions)."""
        pairs = [self._waves(boundary), self._poles(boundary)]
        pairs += [self._powers(boundary, corner) for corner in self.corners]
        pairs += [self._slit(boundary, slit) for slit in self.slits]
        functions = np.hstack([pair[0] for pair in pairs])
        slopes = np.hstack([pair[1] for pair in pairs])
        return functions.real, (slopes * boundary.normal[:, None]).real

    def _waves(self, boundary: Boundary) -> tuple[np.ndarray, np.ndarray]:
        z = boundary.points.astype(complex)[:, None]
        k = np.pi * np.arange(1, self.waves + 1)[None, :] / self.length
        # Re e^{−ik(z − iy₀)} = cos kx e^{k(y − y₀)}.
        at_top = np.exp(-1j * k * (z - 1j * self.high))
        at_bottom = np.exp(1j * k * (z - 1j * self.low))
        uniform = (z - 1j * (self.low + self.high) / 2) / (1j * self.length)
        return (
            np.hstack([uniform, at_top, at_bottom]),
            np.hstack([0 * uniform - 1j / self.length, -1j * k * at_top, 1j * k * at_bottom]),
        )

    def _poles(self, boundary: Boundary) -> tuple[np.ndarray, np.ndarray]:
        scale = np.pi / (2 * self.length)
        z, p = boundary.points[:, None], self.poles[None, :]
        near, image = (scale * (z - p)).astype(complex), (scale * (z + p.conj())).astype(complex)
        distance = np.abs(near).min(axis=0)
        cot, cot_image = _cotangent(near), _cotangent(image)
        # On a side wall a source of flux through the wall is cancelled by its image.
        across = np.minimum(np.abs(self.poles.real), np.abs(self.poles.real - self.length)) > 1e-12 * self.length
        values, slopes = [], []
        for a in (across, 1.0j):
            strength = a * distance
            values.append(strength * cot - np.conj(strength) * cot_image)
            slopes.append(scale * (-strength * (1 + cot**2) + np.conj(strength) * (1 + cot_image**2)))
        return np.hstack(values), np.hstack(slopes)

    def _powers(self, boundary: Boundary, corner: Corner) -> tuple[np.ndarray, np.ndarray]:
        """w^ν, w = sin(π(z − c)/2L)/sin(π(z − c')/2L), cut from the corner c to c' outside; w^ν ln w for whole ν."""
        multiples = (0.5, 1, 1.5, 2) if self.halves else (1, 2)
        exponents = np.array([k * corner.exponent + m for k in multiples for m in range(self.powers)])
        whole = np.abs(exponents - np.rint(exponents)) < 1e-6
        # The same exponent twice would be noise.
        logarithmic = np.unique(np.rint(exponents[whole]))
        exponents = exponents[~whole]
        beyond = corner.place + corner.room * corner.outward

        def powers(z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            logarithm, slope = self._logarithm(z, corner.place, beyond)
            value, integer = np.exp(exponents * logarithm), np.exp(logarithmic * logarithm)
            return (
                np.hstack([value, integer * logarithm]),
                slope * np.hstack([exponents * value, integer * (logarithmic * logarithm + 1)]),
            )

        return self._mirrored(boundary, powers)

    def _slit(self, boundary: Boundary, slit: Slit) -> tuple[np.ndarray, np.ndarray]:
        """Powers and logarithms at the tip, and poles in the plane of √w, where the slit is a straight wall.

        w = sin(π(z − c)/2L)/sin(π(z − c')/2L), cut from the tip c through the slit to c' outside.
        """
        integers = np.arange(1, 2 * self.powers)
        end = np.exp(self._logarithm(np.array([slit.end]), slit.tip, slit.beyond)[0].real[0, 0] / 2)
        outward = np.exp(0.75j * np.pi)
        right = clustered(1j * end, outward, end, self.clustered, steepness=self.steepness).astype(complex)
        inner = end * (-0.6 + 1.5j * np.linspace(-1, 1, self.clustered))
        poles = np.concatenate([right, right.conj(), inner])
        nearest = np.maximum(-poles.real, 0.0)
        # On the slit the sides of the cut are told apart by the normal.
        upwards = float(np.sign((slit.end - slit.tip).imag))
        on = (boundary.points.real == slit.tip.real) & (np.abs(boundary.normal.real) > 0.5)
        sides = np.where(on, -upwards * np.sign(boundary.normal.real), 0.0)

        def functions(z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            logarithm, slope = self._logarithm(z, slit.tip, slit.beyond)
            if z is boundary.points:
                turned = np.where(sides[:, None] != 0, sides[:, None] * np.pi, logarithm.imag)
                logarithm = logarithm.real + 1j * turned
            powers = np.exp(0.5 * integers * logarithm)
            whole = np.exp(integers * logarithm)
            root = np.exp(0.5 * logarithm)
            fractions = nearest / (root - poles)
            return (
                np.hstack([powers, whole * logarithm, fractions]),
                slope
                * np.hstack(
                    [
                        0.5 * integers * powers,
                        whole * (integers * logarithm + 1),
                        -(fractions**2) / nearest * root / 2,
                    ]
                ),
            )

        return self._mirrored(boundary, functions)

    def _logarithm(self, z: np.ndarray, start: complex, end: complex) -> tuple[np.ndarray, np.ndarray]:
        """ln sin(π(z − start)/2L)/sin(π(z − end)/2L) and its derivative, shape (n, 1)."""
        scale = np.pi / (2 * self.length)
        near, far = ((scale * (z - place)).astype(complex)[:, None] for place in (start, end))
        return np.log(np.sin(near) / np.sin(far)), scale * (_cotangent(near) - _cotangent(far))

    def _mirrored(self, boundary: Boundary, functions: Functions) -> tuple[np.ndarray, np.ndarray]:
        """f(z) + f(−z̄)* and i f(z) + (i f(−z̄))*, which do not flow through the side walls."""
        value, slope = functions(boundary.points)
        image, image_slope = (part.conj() for part in functions(-boundary.points.conj()))
        return (
            np.hstack([value + image, 1j * (value - image)]),
            np.hstack([slope - image_slope, 1j * (slope + image_slope)]),
        )


def _cotangent(z: np.ndarray) -> np.ndarray:
    """cot z without overflow far from the real axis."""
    sign = np.where(z.imag > 0, 1.0, -1.0)
    small = np.exp(2j * sign * z)
    # i(e^{iz} + e^{−iz})/(e^{iz} − e^{−iz}); small arguments by expm1 keep their digits.
    return -1j * sign * (1 + small) / (-np.expm1(2j * sign * z))


def energy_basis(functions: np.ndarray, slopes: np.ndarray, weights: np.ndarray, tolerance: float) -> np.ndarray:
    """Coefficients of functions with ∫|∇v|² = 1, orthogonal to each other, without what rounding hides.

    Args:
        functions: on the whole boundary but the walls, shape (nodes, n), made free of their means.
        slopes: normal derivatives there, shape (nodes, n).
        weights: of the nodes, shape (nodes,).
        tolerance: part of the largest eigenvalue of the scaled energies below which they are dropped.

    Returns:
        The coefficients, shape (n, kept).
    """
    energy = functions.T @ (weights[:, None] * slopes)
    energy = (energy + energy.T) / 2
    # What cancels with its image, like a pole on a wall in one direction, is none.
    sizes = np.diag(energy)
    real = np.flatnonzero(sizes > 1e-20 * sizes.max())
    scale = 1 / np.sqrt(sizes[real])
    values, vectors = np.linalg.eigh(energy[np.ix_(real, real)] * scale * scale[:, None])
    kept = values > tolerance * values[-1]
    basis = np.zeros((len(energy), np.count_nonzero(kept)))
    basis[real] = scale[:, None] * vectors[:, kept] / np.sqrt(values[kept])
    return basis
