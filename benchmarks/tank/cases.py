"""The tanks of the benchmark, with their ten lowest exact frequencies."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

from hydroelastic.modal.beam.floating_beam import FloatingBeam

MODES = 10


@dataclass(frozen=True, kw_only=True)
class BenchmarkTank:
    """A tank and what is certain of it.

    Attributes:
        name: of the tank.
        beam: tank, liquid and beam.
        frequencies: the ten lowest ω, rad/s, motions without stiffness left out.
    """

    name: str
    beam: FloatingBeam
    frequencies: tuple[float, ...]

    @property
    def water_wavelength(self) -> float:
        """Wavelength 2πg/ω² of the highest of these frequencies on deep water, m."""
        return 2.0 * pi * self.beam.gravity / self.frequencies[-1] ** 2

    @property
    def beam_wavelength(self) -> float:
        """Wavelength of the highest of these frequencies under the beam, from EI k⁵ = ρω², m."""
        return 2.0 * pi * (self.beam.flexural_rigidity / self.beam.density / self.frequencies[-1] ** 2) ** 0.2


def _base(**changes: float | bool) -> FloatingBeam:
    values: dict[str, float | bool] = {
        "tank_length": 10.0,
        "depth": 5.0,
        "density": 1000.0,
        "gravity": 9.81,
        "start": 3.0,
        "length": 4.0,
        "flexural_rigidity": 5e3,
        "mass_per_length": 50.0,
        "hydrostatic": False,
    }
    return FloatingBeam(**(values | changes))  # type: ignore[arg-type]


# Modes 1 to 8 are the project's reference solutions (theory of the aquarium, docs, § 3): four methods that share no
# code, 11 to 14 certain digits. Modes 9 and 10 are those of `hydroelastic.modal.gravity_tones` with 200 to 320 dry
# shapes, where its modes 1 to 8 are within 6e-14 of the reference.
TANKS = (
    BenchmarkTank(
        name="base_s0",
        beam=_base(),
        frequencies=(
            *(1.6497043164885137, 1.925832261889947, 3.4279476377111306, 3.6710721394108345, 4.230523984246685),
            *(4.8301634192367215, 5.027306155027752, 5.770058266014046, 5.876352666616824, 6.58243354921272),
        ),
    ),
    BenchmarkTank(
        name="base_s1",
        beam=_base(hydrostatic=True),
        frequencies=(
            *(1.6800675521662354, 2.477469424702905, 3.0220093082833537, 3.665122462633953, 4.006580554424623),
            *(4.683049691723844, 4.959332567160733, 5.534490226654431, 5.830455893962756, 6.242243306250041),
        ),
    ),
    BenchmarkTank(
        name="offcentre_s0",
        beam=_base(start=1.0),
        frequencies=(
            *(1.324226086204025, 2.760919383552515, 2.998466995171221, 3.7097229339126594, 4.238423981060944),
            *(4.6277558579611835, 5.175809029398169, 5.712780407706876, 6.186999269519366, 6.309240867737421),
        ),
    ),
    BenchmarkTank(
        name="narrow_s1",
        beam=_base(tank_length=4.4, start=0.2, hydrostatic=True),
        frequencies=(
            *(2.613352189026766, 4.636506217391478, 6.425210407745465, 7.813394372872904, 12.919432810392795),
            *(13.468778327587875, 15.448971868109819, 18.18620732385127, 18.392451075158803, 21.972925733083112),
        ),
    ),
    BenchmarkTank(
        name="vlfs_dock_s1",
        beam=_base(
            tank_length=320.0,
            depth=20.0,
            density=1025.0,
            start=8.0,
            length=300.0,
            flexural_rigidity=8e9,
            mass_per_length=512.5,
            hydrostatic=True,
        ),
        frequencies=(
            *(0.1367686725164633, 0.2748426355064432, 0.4477750389110166, 0.6970365693631135, 0.9241784364077726),
            *(1.1354928065313503, 1.5352789011463437, 1.7761174184898725, 2.1076178579402556, 2.3235451276452377),
        ),
    ),
)


def tank_named(name: str) -> BenchmarkTank:
    """The tank of that name."""
    return {tank.name: tank for tank in TANKS}[name]
