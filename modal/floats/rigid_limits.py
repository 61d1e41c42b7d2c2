"""Added masses of rigid sections far above the frequencies of the waves, in unbounded liquids, in closed form."""

from __future__ import annotations

import math
from dataclasses import dataclass

from scipy.optimize import brentq
from scipy.special import elliprd, elliprf, gamma

from hydroelastic.modal.estimate import NoEstimateError
from hydroelastic.physics.profiles import Profile

_LEAST_STEP = 1e-15


@dataclass(frozen=True, kw_only=True)
class RigidAddedMass:
    """Added masses of a section for motions about a point of its vertical axis, per metre of width."""

    heave: float  # kg/m
    sway: float  # kg/m
    roll: float  # kg·m, for a roll anticlockwise
    sway_roll: float  # kg, their coupling

    def about(self, height: float) -> RigidAddedMass:
        """Return the added masses for a roll about a point that is ``height`` above the present one, m.

        A roll about it displaces like a roll about the present point and ``height`` of sway.
        """
        return RigidAddedMass(
            heave=self.heave,
            sway=self.sway,
            roll=self.roll + 2 * height * self.sway_roll + height**2 * self.sway,
            sway_roll=self.sway_roll + height * self.sway,
        )


def half_immersed_ellipse(half_width: float, draught: float, density: float) -> RigidAddedMass:
    """Return the added masses of an ellipse with its axis in the surface ψ = 0, about the middle of its waterline:

        heave (π/2) ρ b²,   sway (2/π) ρ d²,   roll (π/16) ρ (b² − d²)²,   sway and roll (1/3) ρ d (d² − b²)

    from ψ = Σ A_n r^{−n} sin nθ outside a circle, to which the section is mapped. d = 0 is a flat plate on the
    surface, b = 0 a vertical plate that pierces it.

    Args:
        half_width: b, m, not negative.
        draught: d, m, not negative.
        density: ρ, kg/m³.
    """
    _check_lengths(half_width, draught)
    b, d = half_width, draught
    return RigidAddedMass(
        heave=math.pi / 2 * density * b**2,
        sway=2 / math.pi * density * d**2,
        roll=math.pi / 16 * density * (b**2 - d**2) ** 2,
        sway_roll=density * d * (d**2 - b**2) / 3,
    )


def interface_ellipse(
    half_width: float, half_height: float, density_below: float, density_above: float
) -> RigidAddedMass:
    """Return the added masses of an ellipse with an axis in the interface of two liquids, about its centre.

    There ρψ is continuous, and ∂ψ/∂y. Heave and roll have ψ = 0 on the interface, as if it were free from both sides:
    (ρ₁ + ρ₂) takes the place of ρ. Sway mixes the motions with ψ = 0 and with ∂ψ/∂y = 0 on it:

        sway = 4ρ₁ρ₂/(ρ₁ + ρ₂) (π/2) h² + (ρ₂ − ρ₁)²/(ρ₁ + ρ₂) (2/π) h²,   sway and roll (ρ₂ − ρ₁) h (h² − b²)/3.

    Args:
        half_width: b, m, not negative.
        half_height: h, m, not negative.
        density_below: ρ₂, kg/m³.
        density_above: ρ₁, kg/m³.
    """
    total, difference = density_below + density_above, density_below - density_above
    half = half_immersed_ellipse(half_width, half_height, 1.0)
    level = math.pi / 2 * half_height**2
    return RigidAddedMass(
        heave=total * half.heave,
        sway=(4 * density_below * density_above * level + difference**2 * half.sway) / total,
        roll=total * half.roll,
        sway_roll=difference * half.sway_roll,
    )


def section_heave_added_mass(profile: Profile, density_below: float, density_above: float = 0.0) -> float:
    """Return the exact added mass in heave, kg/m, of a section whose level y = 0 lies in the interface or surface.

    ψ = 0 there makes it half of (ρ₁ + ρ₂) times that of the whole section in one unbounded liquid of density 1, which
    is 2π(R² + C) − area for the map z = Rζ + C/(Rζ) + … of the outside of a circle:

        ellipse    π b²
        wedge      4π s R² − 2bh,      s = (2/π) arctan(b/h),  R = √(b² + h²) Γ(3/2)/(Γ((1 + s)/2) Γ(1 − s/2))
        rectangle  4π R² (1 − m) − 4bh,    h = 2R [E(m) − (1 − m)K(m)],  b = 2R [E(1 − m) − mK(1 − m)]

    with the complete elliptic integrals of the parameter m.

    Args:
        density_below: ρ₂, kg/m³.
        density_above: ρ₁, kg/m³; 0 for a single liquid.
    """
    b, h = profile.half_width, profile.half_height
    if profile.shape == "ellipse":
        whole = math.pi * b**2
    elif profile.shape == "wedge":
        whole = _rhombus(b, h)
    elif profile.shape == "rectangle":
        whole = _rectangle(b, h)
    else:
        raise NoEstimateError(f"the added mass of the {profile.shape} has no closed form")
    return (density_below + density_above) / 2 * whole


def _rhombus(b: float, h: float) -> float:
    angle = 2 / math.pi * math.atan2(b, h)
    radius = math.hypot(b, h) * gamma(1.5) / (gamma((1 + angle) / 2) * gamma(1 - angle / 2))
    return float(4 * math.pi * angle * radius**2 - 2 * b * h)


def _rectangle(b: float, h: float) -> float:
    def excess(logarithm: float) -> float:
        """ln of the ratio of the sides less that asked for; the logarithm is that of m/(1 − m)."""
        m, complement = 1 / (1 + math.exp(-logarithm)), 1 / (1 + math.exp(logarithm))
        return math.log(_side(m, complement) / _side(complement, m)) - math.log(h / b)

    # m/(1 − m) is between the ratio of the sides and its square.
    reach = 2 * abs(math.log(h / b)) + 2
    logarithm = brentq(excess, -reach, reach, xtol=_LEAST_STEP)
    m, complement = 1 / (1 + math.exp(-logarithm)), 1 / (1 + math.exp(logarithm))
    radius = h / (2 * _side(m, complement))
    return 4 * math.pi * radius**2 * complement - 4 * b * h


def _side(m: float, complement: float) -> float:
    """Return E(m) − (1 − m) K(m) = m (K − D), without cancellation for small m."""
    return float(m * (elliprf(0, complement, 1) - elliprd(0, complement, 1) / 3))


def _check_lengths(*lengths: float) -> None:
    if not all(math.isfinite(length) and length >= 0 for length in lengths):
        raise ValueError(f"lengths are {lengths}; they must be finite and not negative")
