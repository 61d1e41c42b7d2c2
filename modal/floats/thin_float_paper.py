"""The paper on a thin float between two liquids: printed constants beside corrected ones, and the list of errata."""

from __future__ import annotations

import math

from hydroelastic.modal.beam.paper_model import Erratum, PrintedAndCorrected
from hydroelastic.modal.estimate import NoEstimateError
from hydroelastic.modal.floats.thin_float import thin_constants, thin_float_added_mass, thin_float_mass
from hydroelastic.modal.liquid.two_layer import TwoLayers
from hydroelastic.physics.profiles import Profile

THIN_FLOAT_SOURCE = (
    'L. D. Akulenko, S. V. Nesterov, "Oscillations of a rigid body on the interface of two liquids", '
    "Izv. AN SSSR, Mekhanika Tverdogo Tela, late 1980s (in Russian)"
)


def printed_constants(profile: Profile, layers: TwoLayers) -> dict[str, PrintedAndCorrected]:
    """Return the constants of the paper for an exponential float, as printed and corrected.

    With τ = αμl = b/h, and α = 1, since only b = αl matters; corrected values stand last:

        inertia_factor       J/l²: 1/2, 1                                    dimensionless
        inertia_ratio        I = (m + a_∞)/m: 1 + τ/2π, 1 + τ/π              dimensionless
        added_mass           a_∞ = (2/π)(ρ₁ + ρ₂) α²J                         kg/m
        coupling             ε_*: 2τ/I, 2τ/(πI)                               dimensionless
        frequency_squared    Ω_*² = 1/I                                       dimensionless
        omega                Ω = Ω_* √(g*μ)                                   rad/s
        kernel               δ = 4αg*(ρ₁ + ρ₂)/M, 4αg*(ρ₁ + ρ₂)/(πM)          1/(m s²)
        tail                 t² f for t → ∞: + ε_*/(g*μ), −2ε_*/(Ω_*² g*μ)    s²

    Args:
        profile: the exponential; its ``tail`` is not used, the paper's shape has no end. b = αl, h = 1/μ.
        layers: the liquids; their depths are not used.

    Returns:
        Both values by name.

    Raises:
        NoEstimateError: for other shapes, for which the paper prints no constants.
    """
    if profile.shape != "exponential":
        raise NoEstimateError(f"the paper prints no constants for the {profile.shape}")
    infinite = Profile(shape="exponential", half_width=profile.half_width, half_height=profile.half_height)
    corrected = _corrected(infinite, layers)
    printed = _printed(infinite, layers)
    return {name: PrintedAndCorrected(printed=printed[name], corrected=corrected[name]) for name in corrected}


def _corrected(profile: Profile, layers: TwoLayers) -> dict[str, float]:
    constants = thin_constants(profile)
    density, reduced = _total_density(layers), _reduced_gravity(layers)
    rate_squared = reduced / profile.half_height
    mass = thin_float_mass(profile, layers.density_below, layers.density_above)
    added_mass = thin_float_added_mass(profile, layers.density_below, layers.density_above)
    return {
        "inertia_factor": constants.inertia_factor,
        "inertia_ratio": (mass + added_mass) / mass,
        "added_mass": added_mass,
        "coupling": constants.coupling,
        "frequency_squared": constants.frequency_squared,
        "omega": math.sqrt(constants.frequency_squared * rate_squared),
        # αM = m + a_∞.
        "kernel": 4 / math.pi * reduced * density / (mass + added_mass),
        "tail": -2 * constants.coupling / (constants.frequency_squared * rate_squared),
    }


def _printed(profile: Profile, layers: TwoLayers) -> dict[str, float]:
    slenderness = profile.half_width / profile.half_height
    density, reduced = _total_density(layers), _reduced_gravity(layers)
    rate_squared = reduced / profile.half_height
    mass = thin_float_mass(profile, layers.density_below, layers.density_above)
    ratio = 1 + slenderness / (2 * math.pi)
    coupling = 2 * slenderness / ratio
    return {
        "inertia_factor": 0.5,
        "inertia_ratio": ratio,
        "added_mass": (ratio - 1) * mass,
        "coupling": coupling,
        "frequency_squared": 1 - coupling / (4 * math.pi),
        "omega": math.sqrt(rate_squared / ratio),
        "kernel": 4 * reduced * density / (mass * ratio),
        "tail": coupling / rate_squared,
    }


def _total_density(layers: TwoLayers) -> float:
    return layers.density_below + layers.density_above


def _reduced_gravity(layers: TwoLayers) -> float:
    """Return g* = g (ρ₂ − ρ₁)/(ρ₂ + ρ₁), m/s²."""
    return layers.gravity * (layers.density_below - layers.density_above) / _total_density(layers)


THIN_FLOAT_ERRATA: tuple[Erratum, ...] = (
    Erratum(
        number=1,
        printed="(3.1): … ± (α/π) φ*_{1,2}",
        corrected="… + (α/π) φ*_{1,2}",
        consequence="(3.2) and (3.3), which are right, do not follow.",
    ),
    Erratum(
        number=2,
        printed="(3.8): first term (α/2π) c … without a sign",
        corrected="± (α/2π) c …, + for y > 0 and − for y < 0",
        consequence="The potential is not odd in y.",
    ),
    Erratum(
        number=3,
        printed="(4.1): s = c(t)",
        corrected="s' = c(t)",
        consequence="A displacement equals a velocity.",
    ),
    Erratum(
        number=4,
        printed="(4.3): memory term with s''(τ)",
        corrected="memory term with s'(τ), as in (4.4)",
        consequence="(4.3) and (4.4) disagree.",
    ),
    Erratum(
        number=5,
        printed="(4.4): kernel factor (4α/M) g*(ρ₁ + ρ₂)",
        corrected="(4α/(πM)) g*(ρ₁ + ρ₂)",
        consequence="The damping by waves is π times too large.",
    ),
    Erratum(
        number=6,
        printed="(5.1): δ = 4αg*(ρ₁ + ρ₂)/M",
        corrected="δ = 4αg*(ρ₁ + ρ₂)/(πM)",
        consequence="As number 5.",
    ),
    Erratum(
        number=7,
        printed="(5.5): θ = t − τ; K = −2/θ² − 24/θ⁴ − …",
        corrected="θ = ν(t − τ); K/(μl²) = −2/θ² − 24/θ⁴ − 720/θ⁶ − …",
        consequence="The argument has a dimension.",
    ),
    Erratum(
        number=8,
        printed="after (5.5): K cannot be found analytically",
        corrected="K/(μl²) = 1 − (θ/2) [e^{−θ} Ei(θ) + e^{θ} E₁(θ)]",
        consequence="None; there is a closed form.",
    ),
    Erratum(
        number=9,
        printed="(5.6): I = 1 + αμl/(2π), that is J = l²/2",
        corrected="I = 1 + αμl/π, J = l²",
        consequence="The added mass is half of what it should be.",
    ),
    Erratum(
        number=10,
        printed="(5.8): ε_* = 4πε/I, Ω_*² = 1 − ε_*/4π, with ε = αμl/(2π)",
        corrected="ε_* = 2αμl/(πI) = 4ε/I, Ω_*² = 1/I = 1 − ε_*/2",
        consequence="Damping π times too large, frequency too high; with the corrected values 0 < ε_* < 2.",
    ),
    Erratum(
        number=11,
        printed="(5.9), (5.10): denominator (z² + Ω_*²)(z² − 1) + …",
        corrected="(z² + Ω_*²)(z² − 1)² + …, and ln z² is 2 Ln z",
        consequence="The transform grows like z and has no f(0).",
    ),
    Erratum(
        number=12,
        printed="(5.12): κ ≥ 0 with ±",
        corrected="the upper sign for κ > 0, the lower one for κ < 0",
        consequence="Both sides of the cut are confused.",
    ),
    Erratum(
        number=13,
        printed="(5.13): prefactor s₀/2π",
        corrected="s₀/π",
        consequence="The motion is halved: f(0) = 1/2.",
    ),
    Erratum(
        number=14,
        printed="(5.14): f → + ε_*/θ²",
        corrected="f → −2ε_*/(Ω_*²θ²) = −(4/π) αl/(g*t²)",
        consequence="Sign and size of the late motion are wrong; mass, shape and I drop out of it.",
    ),
    Erratum(
        number=15,
        printed="one pair of poles and a cut along z < 0",
        corrected="two pairs of poles on the plane cut along z < 0, for every 0 < ε_* < 2",
        consequence="An error of the order √ε_* at early times.",
    ),
)
