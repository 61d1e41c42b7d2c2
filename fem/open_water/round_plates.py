"""Round plates in waves: deflection, moments and shear force along the diameter of the waves, strain and stress.

With w = Σ Wₙ(r) cos nθ the curvatures along r, across it and the twist are Σ Wₙ″ cos nθ, Σ (Wₙ′/r − n²Wₙ/r²) cos nθ
and Σ −n(Wₙ′/r − Wₙ/r²) sin nθ. Along the diameter θ = 0, π, where x is ±r, the moment is D(w_xx + νw_yy) and the shear
force D ∂Δw/∂x, with

    ∂(ΔₙWₙ)/∂r = Wₙ‴ + Wₙ″/r − (1 + n²)Wₙ′/r² + 2n²Wₙ/r³.

At the faces the principal strains are h/2 times the principal curvatures a ± √(b² + c²), a half the sum of both
curvatures, b half their difference, c the twist; the principal stresses are 6D/h² times (1 + ν)a ± (1 − ν)√(b² + c²).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.optimize import minimize_scalar

from hydroelastic.fem.bodies.round_plate import RoundShapes, plate_of
from hydroelastic.fem.open_water.field_model import OpenModel
from hydroelastic.fem.open_water.results import Floats, PlateDeflection, RoundDeflection
from hydroelastic.physics.round_plates import RoundPlate
from hydroelastic.physics.tank import Tank

# Angles from 0 to π, and phases of half a period, among which the largest strain is sought.
_ANGLES, _PHASES = 73, 24


def deflections_of_order(model: OpenModel, motions: np.ndarray, positions: int) -> tuple[RoundDeflection, ...]:
    """Return the deflection of each round plate in the waves of one order.

    Args:
        model: the problem of the order.
        motions: unknowns of all bodies per dimensionless elevation, shape (frequencies, waves, unknowns).
        positions: number of points along a diameter.
    """
    found, first = [], 0
    for index, (body, own) in enumerate(zip(model.basin.tank.bodies, model.pencil.bodies, strict=True)):
        part, first = motions[..., first : first + own.size], first + own.size
        if isinstance(body, RoundPlate):
            radii = np.linspace(body.inner_radius, body.radius, (positions + 1) // 2, dtype=np.float64)
            shapes, length = RoundShapes(body, own.size), model.basin.units.length
            derivatives = [part @ shapes.values(radii, order) / length**order for order in range(4)]
            found.append(
                RoundDeflection(body=index, radii=length * radii, derivatives=np.array(derivatives)[..., None, :])
            )
    return tuple(found)


def joined(parts: list[RoundDeflection]) -> RoundDeflection:
    """Return the deflections of a plate of the orders 0, 1 … as one."""
    return replace(parts[0], derivatives=np.concatenate([part.derivatives for part in parts], axis=-2))


def along_diameter(tank: Tank, found: RoundDeflection, error: Floats) -> PlateDeflection:
    """Return the deflection of a round plate along the diameter of the waves, and its largest strain and stress.

    Args:
        tank: the sea in SI units.
        found: the deflections of all orders.
        error: of the deflection relative to the larger of it and the wave, shape (frequencies,); those of its
            derivatives are not estimated.
    """
    plate = plate_of(tank.bodies[found.body])
    rigidity = plate.flexural_rigidity if plate.bends else 0.0
    deflection, along, across, _, slope = _polar(found)
    moment = rigidity * (along + plate.poisson_ratio * across)
    orders = np.arange(deflection.shape[-2])[:, None]
    behind = (-1.0) ** orders

    def whole(values: np.ndarray, sign: float = 1.0) -> np.ndarray:
        # From the edge at θ = π to that at θ = 0; the axis, of a disc, is one point.
        left = (sign * behind * values).sum(axis=-2)[..., ::-1]
        return np.concatenate([left[..., : left.shape[-1] - is_disc], values.sum(axis=-2)], axis=-1)

    is_disc = int(found.radii[0] == 0.0)
    strain, stress = _largest(plate, found)
    return PlateDeflection(
        body=found.body,
        positions=np.concatenate([-found.radii[is_disc:][::-1], found.radii]),
        deflection=whole(deflection),
        bending_moment=whole(moment),
        shear_force=whole(rigidity * slope, -1.0),
        deflection_error=error[:, None] * np.maximum(np.abs(deflection).max(axis=(-2, -1)), 1.0),
        bending_moment_error=np.full(moment.shape[:2], np.nan),
        shear_force_error=np.full(moment.shape[:2], np.nan),
        largest_strain=strain,
        largest_stress=stress,
    )


def _polar(found: RoundDeflection) -> tuple[np.ndarray, ...]:
    """Wₙ, the curvatures along and across the radius, the twist, and ∂(ΔₙWₙ)/∂r, each as the deflections.

    On the axis, where Wₙ ~ rⁿ, they are limits.
    """
    value, first, second, third = found.derivatives
    n, r = np.arange(value.shape[-2])[:, None], found.radii
    on_axis = r == 0.0
    r = np.where(on_axis, 1.0, r)
    across = np.where(on_axis, second * (1.0 - 0.5 * n**2), first / r - n**2 * value / r**2)
    twist = np.where(on_axis, -0.5 * n * second, -n * (first / r - value / r**2))
    slope = np.where(
        on_axis,
        third * (1.5 - n**2 / 6.0),
        third + second / r - (1.0 + n**2) * first / r**2 + 2.0 * n**2 * value / r**3,
    )
    return value, second, across, twist, slope


def _largest(plate: RoundPlate, found: RoundDeflection) -> tuple[Floats | None, Floats | None]:
    """Largest principal strain and stress at the faces of a plate, over all its points and times."""
    if plate.thickness is None or not plate.bends:
        return None, None
    _, along, across, twist, _ = _polar(found)
    angles = np.linspace(0.0, np.pi, _ANGLES) * np.arange(along.shape[-2])[:, None]
    cosine, sine = np.cos(angles), np.sin(angles)
    half_sum, half_difference = (
        0.5 * np.einsum("fwnp,na->fwpa", values, cosine) for values in (along + across, along - across)
    )
    twisted = np.einsum("fwnp,na->fwpa", twist, sine)
    nu, height = plate.poisson_ratio, plate.thickness
    strain = _largest_principal(half_sum, half_difference, twisted)
    stress = _largest_principal((1.0 + nu) * half_sum, (1.0 - nu) * half_difference, (1.0 - nu) * twisted)
    return 0.5 * height * strain, 6.0 * plate.flexural_rigidity / height**2 * stress


def _largest_principal(a: np.ndarray, b: np.ndarray, c: np.ndarray) -> Floats:
    """Largest |Re a| + √((Re b)² + (Re c)²) over points and phases, shape (frequencies, waves)."""

    def at(phase: float, *values: np.ndarray) -> np.ndarray:
        one, other, third = (np.real(value * np.exp(-1j * phase)) for value in values)
        return np.asarray(np.abs(one) + np.hypot(other, third))

    found = np.zeros(a.shape[:2])
    phases = np.linspace(0.0, np.pi, _PHASES, endpoint=False)
    for place in np.ndindex(found.shape):
        sizes = np.array([at(phase, a[place], b[place], c[place]) for phase in phases])
        number, *point = np.unravel_index(np.argmax(sizes), sizes.shape)
        near = phases[number] + np.array([-1.0, 1.0]) * np.pi / _PHASES
        own = [values[(*place, *point)] for values in (a, b, c)]
        found[place] = -minimize_scalar(lambda phase, own=own: -at(phase, *own), bounds=near, method="bounded").fun
    return found
