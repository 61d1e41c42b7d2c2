"""Waves on the interface of two liquids, with or without a thin elastic plate on it, in closed form."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from hydroelastic.modal.liquid.sloshing import wavenumbers
from hydroelastic.physics.arrays import FloatArray

LayerTop = Literal["free", "rigid", "pressure_release"]
Branch = Literal["internal", "surface"]
"""``surface``: interface and free top move in phase, the faster wave; ``internal``: in opposite phase, the slower one.
With a top that is not free only the interface moves: ``internal`` between two liquids, ``surface`` on a single one."""


@dataclass(frozen=True, kw_only=True)
class TwoLayers:
    """A lower liquid 2 in −h₂ < y < 0 over a flat bottom, and an upper, lighter liquid 1 in 0 < y < h₁.

    Raises:
        ValueError: on construction, if a quantity is out of its range.
    """

    density_below: float  # ρ₂, kg/m³
    density_above: float = 0.0  # ρ₁ < ρ₂, kg/m³; 0 leaves one liquid with an ordinary free surface, whatever the top
    depth_below: float  # h₂, m; ``math.inf`` for deep liquid
    depth_above: float = math.inf  # h₁, m; ``math.inf`` for deep liquid; not used for ρ₁ = 0
    gravity: float  # g, m/s²
    top: LayerTop = "rigid"  # what closes the upper liquid: a free surface, a rigid lid, or ψ = 0

    def __post_init__(self) -> None:
        for name in ("density_below", "gravity"):
            if not (math.isfinite(getattr(self, name)) and getattr(self, name) > 0):
                raise ValueError(f"{name} is {getattr(self, name)}; it must be finite and positive")
        for name in ("depth_below", "depth_above"):
            if not getattr(self, name) > 0:
                raise ValueError(f"{name} is {getattr(self, name)}; it must be positive")
        if not 0 <= self.density_above < self.density_below:
            raise ValueError(
                f"density_above is {self.density_above}; it must be at least 0 and less than density_below, "
                f"{self.density_below}: a heavier liquid on top overturns"
            )

    @property
    def branches(self) -> tuple[Branch, ...]:
        """The waves there are for each wavenumber, slower one first."""
        if not self.density_above:
            return ("surface",)
        return ("internal", "surface") if self.top == "free" else ("internal",)


@dataclass(frozen=True, kw_only=True)
class InterfacePlate:
    """A thin elastic plate that covers the interface, its ends guided by the walls, per metre of width.

    Raises:
        ValueError: on construction, if a quantity is out of its range.
    """

    flexural_rigidity: float  # EI, N·m, not negative
    mass_per_length: float  # m, kg/m², not negative
    hydrostatic: bool = True  # whether (ρ₂ − ρ₁) g w restores it

    def __post_init__(self) -> None:
        for name in ("flexural_rigidity", "mass_per_length"):
            if not (math.isfinite(getattr(self, name)) and getattr(self, name) >= 0):
                raise ValueError(f"{name} is {getattr(self, name)}; it must be finite and not negative")


@dataclass(frozen=True, kw_only=True)
class LayerMode:
    """A standing wave of a closed tank."""

    omega: float  # angular frequency, rad/s
    branch: Branch  # which wave of its wavenumber
    number: int  # n of the wavenumber nπ/L


def interface_frequencies(
    layers: TwoLayers, wavenumber: npt.ArrayLike, plate: InterfacePlate | None = None
) -> dict[Branch, FloatArray]:
    """Return ω of free waves cos kx of each branch.

    With D = (ρ₂ − ρ₁) g, or EI k⁴ + s (ρ₂ − ρ₁) g under a plate of mass m, C_j = coth k h_j,

        rigid lid          ω² = D / (m + (ρ₁C₁ + ρ₂C₂)/k)
        pressure release   ω² = D / (m + (ρ₁/C₁ + ρ₂C₂)/k)
        free top           det [ D − ω²(m + (ρ₁C₁ + ρ₂C₂)/k)    ω² ρ₁/(k sinh kh₁) ]  = 0
                               [ ω²/(k sinh kh₁)                g − ω² C₁/k        ]

    Both roots of the last come from sums of positive terms: the internal wave keeps its relative precision for
    ρ₁ → ρ₂, and for layers and waves of any ratio.

    Args:
        wavenumber: k > 0, 1/m.
        plate: a plate on the interface, or ``None``.

    Returns:
        Angular frequencies, rad/s, in the shape of ``wavenumber``, by branch.

    Source: H. Lamb, "Hydrodynamics", art. 231.
    """
    k = np.asarray(wavenumber, dtype=np.float64)
    if not np.all(k > 0):
        raise ValueError("wavenumbers must be positive")
    stiffness, mass = _interface(layers, k, plate)
    mass = mass + layers.density_below / (k * np.tanh(k * layers.depth_below))
    if not layers.density_above:
        return {"surface": np.sqrt(stiffness / mass)}
    tanh_above = np.tanh(k * layers.depth_above)
    if layers.top == "rigid":
        return {"internal": np.sqrt(stiffness / (mass + layers.density_above / (k * tanh_above)))}
    if layers.top == "pressure_release":
        return {"internal": np.sqrt(stiffness / (mass + layers.density_above * tanh_above / k))}
    slow, fast = _free_top_roots(layers, k, stiffness, mass)
    return {"internal": np.sqrt(slow), "surface": np.sqrt(fast)}


def tank_modes(
    layers: TwoLayers, tank_length: float, count: int, plate: InterfacePlate | None = None
) -> tuple[LayerMode, ...]:
    """Return the lowest modes of the closed tank, k = nπ/L, of all branches together.

    Args:
        tank_length: L, m.
        plate: a plate from wall to wall with guided ends, or ``None``.

    Returns:
        Modes by ascending frequency, ``count`` of them.
    """
    if not (math.isfinite(tank_length) and tank_length > 0):
        raise ValueError(f"tank_length is {tank_length}; it must be finite and positive")
    if count < 1:
        raise ValueError(f"count is {count}; it must be at least 1")
    frequencies = interface_frequencies(layers, wavenumbers(tank_length, count), plate)
    modes = [
        LayerMode(omega=float(omega), branch=branch, number=number)
        for branch, values in frequencies.items()
        for number, omega in enumerate(values, start=1)
    ]
    # Every branch rises with n, so that the lowest `count` of all are among the first `count` of each.
    return tuple(sorted(modes, key=lambda mode: mode.omega)[:count])


def _interface(layers: TwoLayers, k: FloatArray, plate: InterfacePlate | None) -> tuple[FloatArray, float]:
    """Return the stiffness of the interface, N/m³, and the mass on it, kg/m²."""
    restoring = (layers.density_below - layers.density_above) * layers.gravity
    if plate is None:
        return np.full_like(k, restoring), 0.0
    return plate.flexural_rigidity * k**4 + plate.hydrostatic * restoring, plate.mass_per_length


def _free_top_roots(
    layers: TwoLayers, k: FloatArray, stiffness: FloatArray, mass: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return both ω² under a free top; ``mass`` is that of plate and lower liquid, m + ρ₂C₂/k.

    Of a λ² − b λ + D g = 0 the discriminant is written as a sum of squares, and the smaller root as a quotient.
    """
    g, density = layers.gravity, layers.density_above
    depth = k * layers.depth_above
    own = 1 / (k * np.tanh(depth))
    cross = 2 * np.exp(-depth) / (-np.expm1(-2 * depth) * k)
    total = mass + density * own
    quadratic = mass * own + density / k**2
    root = np.hypot(stiffness * own - g * total, 2 * np.sqrt(stiffness * g * density) * cross)
    linear = stiffness * own + g * total + root
    return 2 * stiffness * g / linear, linear / (2 * quadratic)
