"""Round plates in waves: deflection, moments and shear force along the diameter of the waves, strain and stress.

With w = Σ Wₙ(r) cos nθ the curvatures along r, across it and the twist are Σ Wₙ″ cos nθ, Σ (Wₙ′/r − n²Wₙ/r²) cos nθ
and Σ −n(Wₙ′/r − Wₙ/r²) sin nθ. Along the diameter θ = 0, π, where x is ±r, the moment is D(w_xx + νw_yy) and the shear
force D ∂Δw/∂x; ΔₙWₙ follows from the load that bends the plate, see `RoundShapes`.

At the faces the principal strains are h/2 times the principal curvatures a ± √(b² + c²), a half the sum of both
curvatures, b half their difference, c the twist; the principal stresses are 6D/h² times (1 + ν)a ± (1 − ν)√(b² + c²).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np
from scipy.optimize import minimize_scalar

from hydroelastic.fem.bodies.round_plate import plate_of
from hydroelastic.fem.open_water.bent_plates import bent
from hydroelastic.fem.open_water.field_model import OpenModel
from hydroelastic.fem.open_water.frequency import OpenResponse
from hydroelastic.fem.open_water.results import Floats, PlateDeflection, RoundDeflection
from hydroelastic.physics.round_plates import RoundPlate
from hydroelastic.physics.tank import Tank

OF_LOADS = 0.1
"""Deflection of an order, over the tolerance, below which higher ones are left out: their loads fall more slowly."""

# Angles from 0 to π, and phases of half a period, among which the largest strain is sought.
_ANGLES, _PHASES = 73, 24
# Ratio of successive orders beyond the last ones, at most, and a margin of what these add.
_SLOWEST, _MARGIN = 0.5, 3.0


def deflections_of_order(
    model: OpenModel,
    responses: list[OpenResponse],
    moved: list[tuple[np.ndarray, np.ndarray]],
    towards: int,
    reduced: Floats,
    of_loads: dict[int, np.ndarray],
    radii_of: Callable[[int], Floats],
) -> Iterator[RoundDeflection]:
    """Yield the deflection of each round plate in the waves of one order (collective)."""
    factors = np.array([one.per_elevation(towards) for one in responses])[..., None]
    length = model.basin.units.length
    for index, modes in model.plate_modes.items():
        radii = radii_of(index)
        scaled = np.asarray(radii / length, dtype=np.float64)
        values = modes.shapes.bent(scaled)[0] / length ** np.arange(4.0)[:, None, None]
        amplitudes = [bent(modes, one, *own) for one, own in zip(responses, moved, strict=True)]
        derivatives = (factors * np.array(amplitudes) @ values[:, None])[..., None, :]
        order = np.array([model.basin.tank.geometry.order])
        largest = np.abs(bent_by(plate_of(model.basin.tank.bodies[index]), radii, derivatives, order)).max(axis=-1)
        meshed = of_loads.get(index, np.zeros((len(responses), 2, 1))).swapaxes(0, 1) * np.abs(factors[..., 0])
        meshed = meshed / length ** np.array([2.0, 3.0])[:, None, None]
        yield RoundDeflection(
            body=index,
            radii=radii,
            derivatives=derivatives,
            uncertain=meshed[..., None] + reduced[:, None, None] * largest,
        )


def radii_along(tank: Tank, index: int, positions: int) -> Floats:
    """Return radii of a round plate at equal distances, of half as many points as along a diameter."""
    plate = plate_of(tank.bodies[index])
    return np.linspace(plate.inner_radius, plate.radius, (positions + 1) // 2, dtype=np.float64)


def joined(parts: list[RoundDeflection]) -> RoundDeflection:
    """Return the deflections of a plate of the orders 0, 1 … as one."""
    return replace(
        parts[0],
        derivatives=np.concatenate([part.derivatives for part in parts], axis=-2),
        uncertain=np.concatenate([part.uncertain for part in parts], axis=-1),
    )


def along_diameter(tank: Tank, found: RoundDeflection, error: Floats) -> PlateDeflection:
    """Return the deflection of a round plate along the diameter of the waves."""
    plate = plate_of(tank.bodies[found.body])
    deflection, along = found.derivatives[0], found.derivatives[2]
    orders = np.arange(deflection.shape[-2])
    rigidity = plate.flexural_rigidity if plate.bends else 0.0
    moment, shear = rigidity * bent_by(plate, found.radii, found.derivatives, orders)
    moment_error, shear_error = rigidity * found.uncertain.sum(axis=-1) + [left_out(moment), left_out(shear)]
    behind = (-1.0) ** orders[:, None]

    def whole(values: np.ndarray, sign: float = 1.0) -> np.ndarray:
        # From the edge at θ = π to that at θ = 0; the axis, of a disc, is one point.
        left = (sign * behind * values).sum(axis=-2)[..., ::-1]
        return np.concatenate([left[..., : left.shape[-1] - is_disc], values.sum(axis=-2)], axis=-1)

    is_disc = int(found.radii[0] == 0.0)
    return PlateDeflection(
        body=found.body,
        positions=np.concatenate([-found.radii[is_disc:][::-1], found.radii]),
        deflection=whole(deflection),
        bending_moment=whole(moment),
        shear_force=whole(shear, -1.0),
        deflection_error=error[:, None] * np.maximum(np.abs(deflection).max(axis=(-2, -1)), 1.0) + left_out(deflection),
        bending_moment_error=moment_error,
        shear_force_error=shear_error,
        strain=None if plate.thickness is None else whole(0.5 * plate.thickness * along),
    )


def with_largest(tank: Tank, plate: PlateDeflection, found: RoundDeflection) -> PlateDeflection:
    """Return a deflection with the largest strain and stress of the plate."""
    strain, stress = _largest(plate_of(tank.bodies[found.body]), found)
    return replace(plate, largest_strain=strain, largest_stress=stress)


def bent_by(plate: RoundPlate, radii: Floats, derivatives: np.ndarray, orders: np.ndarray) -> np.ndarray:
    """Bending moment and shear force along the radius over the rigidity, each as one of the derivatives."""
    along, across, _ = _polar(radii, derivatives, orders)
    return np.array([along + plate.poisson_ratio * across, derivatives[3]])


def left_out(orders: np.ndarray) -> Floats:
    """Return what the orders left out add to a sum over the orders anywhere, if they go on as the last two."""
    sizes = np.abs(orders).max(axis=-1)
    before, last = sizes[..., -2], sizes[..., -1]
    falls = last < _SLOWEST * before
    ratio = np.divide(last, before, out=np.full_like(last, _SLOWEST), where=falls)
    left: Floats = _MARGIN * last * ratio / (1.0 - ratio)
    return left


def _polar(radii: Floats, derivatives: np.ndarray, orders: np.ndarray) -> tuple[np.ndarray, ...]:
    """The curvatures along and across the radius and the twist, each as the deflections.

    On the axis, where Wₙ ~ rⁿ, they are limits.
    """
    value, first, second, _ = derivatives
    n, r = orders[:, None], radii
    on_axis = r == 0.0
    r = np.where(on_axis, 1.0, r)
    across = np.where(on_axis, second * (1.0 - 0.5 * n**2), first / r - n**2 * value / r**2)
    twist = np.where(on_axis, -0.5 * n * second, -n * (first / r - value / r**2))
    return second, across, twist


def _largest(plate: RoundPlate, found: RoundDeflection) -> tuple[Floats | None, Floats | None]:
    """Largest principal strain and stress at the faces of a plate, over all its points and times."""
    if plate.thickness is None or not plate.bends:
        return None, None
    orders = np.arange(found.derivatives.shape[-2])
    along, across, twist = _polar(found.radii, found.derivatives, orders)
    angles = np.linspace(0.0, np.pi, _ANGLES) * orders[:, None]
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
