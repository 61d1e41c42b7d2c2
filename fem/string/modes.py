"""Free motions e^{pt} of the hanging string with resistance.

    (p² M + p C + K) φ = 0

Where the drag is everywhere in proportion to the mass, C = 2αM, the shapes are those without resistance and
p² + 2αp + ω² = 0 gives the roots, also near a double one. Elsewhere SLEPc solves the quadratic eigenvalue problem by
its two-level orthogonal Arnoldi method, inverted at zero.

Natural modes of the hanging string without resistance, by SLEPc.

K φ = ω² M φ        by shift-and-invert at zero, with a Cholesky factorization
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from mpi4py import MPI
from numpy.typing import NDArray
from petsc4py import PETSc
from slepc4py import SLEPc

from hydroelastic.fem.direct import configure_direct
from hydroelastic.fem.solver_error import EigenSolverError
from hydroelastic.fem.string.pencil import StringPencil, build_string_pencil, string_nodes
from hydroelastic.fem.string.probe import StringProbe
from hydroelastic.meshes.interrupts import interrupts_deferred
from hydroelastic.physics.string import HangingString

_RESIDUAL = 1e-12

MODE_DEGREE = 10
"""Polynomial degree for modes."""

# The change by polynomials two degrees higher estimates the error.
_RICHER = 2


@dataclass(frozen=True, kw_only=True)
class DampedModes:
    """Free motions e^{pt}, oscillating and aperiodic ones."""

    # p, 1/s, by ascending magnitude; of a conjugate pair the one above the real axis; shape (modes,)
    roots: NDArray[np.complex128]
    errors: NDArray[np.float64]  # estimate of their absolute errors, 1/s, shape (modes,)
    # φ at the positions asked, ∫m |φ|² + M |φ(0)|² = ρl, real and above zero at the lower end, shape (modes, positions)
    shapes: NDArray[np.complex128]


def damped_modes(
    comm: MPI.Comm,
    string: HangingString,
    count: int,
    positions: NDArray[np.float64],
    *,
    elements: int | None = None,
    degree: int = MODE_DEGREE,
    quadratic: bool = False,
) -> DampedModes:
    """Return the free motions with the roots of smallest magnitude."""
    if string.uniform_damping is not None and not quadratic:
        undamped = string_modes(comm, string, count, positions, elements=elements, degree=degree)
        return _from_undamped(undamped, string.uniform_damping)
    pencil, richer = mode_pencils(comm, string, count, elements, degree)
    roots, vectors = _quadratic_pairs(pencil, count)
    closer, _ = _quadratic_pairs(richer, count)
    probe = StringProbe(pencil, np.asarray(positions, float) / string.length)
    tip = StringProbe(pencil, np.zeros(1))
    differences = np.min(np.abs(roots[:, None] - closer), axis=1)
    rounded = np.array([_rounding(pencil, root, *parts) for root, parts in zip(roots, vectors, strict=True)])
    shapes = []
    for parts in vectors:
        at_end, shape = (p.values(parts[0]) + 1j * p.values(parts[1]) for p in (tip, probe))
        norm = sum(_product(pencil.mass, part, part) for part in parts)
        shapes.append(shape * np.conj(at_end[0]) / abs(at_end[0]) / np.sqrt(norm))
    return DampedModes(
        roots=roots / string.time_unit,
        errors=(differences + rounded + _RESIDUAL * np.abs(roots)) / string.time_unit,
        shapes=np.array(shapes),
    )


def _from_undamped(modes: StringModes, damping: float) -> DampedModes:
    """Return both roots of p² + 2αp + ω² = 0 of each mode, the slow one without the cancellation of −α + σ."""
    frequencies = modes.frequencies
    root = np.sqrt((frequencies - damping) * (frequencies + damping) + 0j)
    over = root.imag != 0.0
    fast = -(damping + root.imag)
    first = np.where(over, frequencies**2 / np.where(over, fast, 1.0), -damping + 1j * root.real)
    roots = np.concatenate([first, fast[over]])
    numbers = np.concatenate([np.arange(len(frequencies)), np.flatnonzero(over)])
    # 2(p + α) dp = −2ω dω, and next to a double root dp² = −2ω dω.
    change = 2.0 * frequencies[numbers] * modes.errors[numbers]
    errors = np.minimum(np.sqrt(change), change / np.maximum(2.0 * np.abs(roots + damping), np.finfo(float).tiny))
    order = np.argsort(np.abs(roots), kind="stable")[: len(frequencies)]
    return DampedModes(roots=roots[order], errors=errors[order], shapes=modes.shapes[numbers[order]].astype(complex))


def _quadratic_pairs(
    pencil: StringPencil, count: int
) -> tuple[NDArray[np.complex128], list[tuple[PETSc.Vec, PETSc.Vec]]]:
    """Return roots on and above the real axis, and the real and imaginary parts of their vectors (collective)."""
    solver = SLEPc.PEP().create(pencil.comm)
    solver.setOperators([pencil.stiffness, pencil.resistance, pencil.mass])
    solver.setProblemType(SLEPc.PEP.ProblemType.HERMITIAN)
    solver.setType(SLEPc.PEP.Type.TOAR)
    solver.setWhichEigenpairs(SLEPc.PEP.Which.TARGET_MAGNITUDE)
    solver.setTarget(0.0)
    # Each complex one comes with its conjugate.
    wanted = min(2 * count, 2 * pencil.size)
    solver.setDimensions(wanted, min(2 * wanted + 20, 2 * pencil.size))
    solver.setTolerances(_RESIDUAL, 200)
    transformation = solver.getST()
    transformation.setType(SLEPc.ST.Type.SINVERT)
    pencil.stiffness.setOption(PETSc.Mat.Option.SPD, True)
    configure_direct(transformation.getKSP())
    with interrupts_deferred():
        solver.solve()
    roots, vectors = [], []
    for number in range(solver.getConverged()):
        real, imaginary = pencil.zeros(), pencil.zeros()
        root = solver.getEigenpair(number, real, imaginary)
        if root.imag >= 0.0:
            roots.append(root)
            vectors.append((real, imaginary))
    if len(roots) < count:
        raise EigenSolverError(f"{len(roots)} of {count} roots converged")
    order = np.argsort(np.abs(roots), kind="stable")[:count]
    return np.array(roots)[order], [vectors[number] for number in order]


def _rounding(pencil: StringPencil, root: complex, real: PETSc.Vec, imaginary: PETSc.Vec) -> float:
    """Return the change of p by rounding of K: φᵀδKφ over φᵀ(2pM + C)φ, the root of it next to a double root."""
    change = rounding(pencil.stiffness, real) + rounding(pencil.stiffness, imaginary)
    mass, resistance = (
        _product(matrix, real, real) - _product(matrix, imaginary, imaginary) + 2j * _product(matrix, real, imaginary)
        for matrix in (pencil.mass, pencil.resistance)
    )
    slope = abs(2.0 * root * mass + resistance)
    return float(min(np.sqrt(change / abs(mass)), change / max(slope, np.finfo(float).tiny)))


def _product(matrix: PETSc.Mat, left: PETSc.Vec, right: PETSc.Vec) -> float:
    image = left.duplicate()
    matrix.mult(right, image)
    return float(left.dot(image))


@dataclass(frozen=True, kw_only=True)
class StringModes:
    """Undamped modes in ascending order."""

    frequencies: NDArray[np.float64]  # ω, rad/s, shape (modes,)
    # estimate of their absolute errors, rad/s, from polynomials of a higher degree, and rounding
    errors: NDArray[np.float64]
    # φ at the positions asked, ∫m φ² + M φ(0)² = ρl, above zero at the lower end, shape (modes, positions)
    shapes: NDArray[np.float64]


def string_modes(
    comm: MPI.Comm,
    string: HangingString,
    count: int,
    positions: NDArray[np.float64],
    *,
    elements: int | None = None,
    degree: int = MODE_DEGREE,
) -> StringModes:
    """Return the lowest modes without resistance."""
    pencil, richer = mode_pencils(comm, string, count, elements, degree)
    squares, vectors = undamped_pairs(pencil, count)
    closer, _ = undamped_pairs(richer, count)
    frequencies, better = np.sqrt(squares), np.sqrt(closer)
    rounded = [0.5 * rounding(pencil.stiffness, vector) for vector in vectors] / frequencies
    probe = StringProbe(pencil, np.asarray(positions, float) / string.length)
    tip = StringProbe(pencil, np.zeros(1))
    shapes = [probe.values(vector) * np.sign(tip.values(vector)[0]) for vector in vectors]
    last_place = 4.0 * np.finfo(float).eps * frequencies
    return StringModes(
        frequencies=frequencies / string.time_unit,
        errors=(np.abs(frequencies - better) + rounded + last_place) / string.time_unit,
        shapes=np.array(shapes),
    )


def mode_pencils(
    comm: MPI.Comm, string: HangingString, count: int, elements: int | None, degree: int
) -> tuple[StringPencil, StringPencil]:
    """Return matrices on one mesh with polynomials of a degree, and of a higher one for the error (collective)."""
    # With degree 10, one and a half half-waves in an element leave thirteen digits.
    nodes = string_nodes(string, elements or 3 + (2 * count) // 3)
    return (
        build_string_pencil(comm, string, degree, nodes),
        build_string_pencil(comm, string, degree + _RICHER, nodes),
    )


def undamped_pairs(pencil: StringPencil, count: int) -> tuple[NDArray[np.float64], list[PETSc.Vec]]:
    """Return the lowest dimensionless ω² of Kφ = ω²Mφ, and φ with φᵀMφ = 1 (collective)."""
    if not 1 <= count <= pencil.size:
        raise EigenSolverError(f"{count} modes are asked of {pencil.size} unknowns")
    solver = SLEPc.EPS().create(pencil.comm)
    solver.setOperators(pencil.stiffness, pencil.mass)
    solver.setProblemType(SLEPc.EPS.ProblemType.GHEP)
    solver.setWhichEigenpairs(SLEPc.EPS.Which.TARGET_MAGNITUDE)
    solver.setTarget(0.0)
    solver.setDimensions(count, min(2 * count + 12, pencil.size))
    solver.setTolerances(_RESIDUAL, 200)
    transformation = solver.getST()
    transformation.setType(SLEPc.ST.Type.SINVERT)
    pencil.stiffness.setOption(PETSc.Mat.Option.SPD, True)
    configure_direct(transformation.getKSP())
    with interrupts_deferred():
        solver.solve()
    if solver.getConverged() < count:
        raise EigenSolverError(f"{solver.getConverged()} of {count} modes converged")
    vectors = []
    for number in range(count):
        vector = pencil.zeros()
        solver.getEigenvector(number, vector)
        vectors.append(vector)
    return np.array([solver.getEigenvalue(number).real for number in range(count)]), vectors


def rounding(stiffness: PETSc.Mat, vector: PETSc.Vec) -> float:
    """Return the change of φᵀKφ by independent rounding of the entries of K (collective).

    Measured against Bessel's zeros on 40 to 450 unknowns: the errors of the lowest frequencies are up to 3.6 times
    those from half a unit in the last place of the diagonal alone.
    """
    diagonal = stiffness.getDiagonal()
    terms = diagonal.array_r * vector.array_r**2
    total = stiffness.comm.tompi4py().allreduce(float(terms @ terms), op=MPI.SUM)
    return float(4.0 * np.finfo(float).eps * np.sqrt(total))
