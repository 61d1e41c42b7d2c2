"""Cases of a hanging string that are hard for one formula or another, by name."""

from __future__ import annotations

import math
from dataclasses import dataclass

from string_bromwich import Transform, bromwich, ramp_image, sine_image, smooth_image, step_image
from uniform_strings import uniform_string

from hydroelastic.physics.string import HangingString
from hydroelastic.physics.string_motions import Ramp, Sine, Smooth, Step

FIRST, SECOND, THIRD = 2.404825557695773, 5.520078110286311, 8.653727912911013


@dataclass(frozen=True, kw_only=True)
class StringCase:
    """A string, the motion of its upper end, a position (m) and a time (s)."""

    string: HangingString
    motion: Ramp | Sine | Smooth | Step
    position: float
    time: float

    def by_integral(self) -> float:
        """Return U(x, t) by the Bromwich integral."""
        return bromwich(
            image_of(self.motion),
            length=self.string.length,
            damping=self.string.damping,
            gravity=self.string.gravity,
            position=self.position,
            time=self.time,
            highest=self.motion.omega if isinstance(self.motion, Sine) else 0.0,
        )


def image_of(motion: Ramp | Sine | Smooth | Step) -> Transform:
    """Return the Laplace image of a motion."""
    match motion:
        case Ramp(speed=speed):
            return ramp_image(speed)
        case Sine(amplitude=amplitude, omega=omega):
            return sine_image(amplitude, omega)
        case Smooth(amplitude=amplitude, rate=rate):
            return smooth_image(amplitude, rate)
        case Step(amplitude=amplitude):
            return step_image(amplitude)


def _unit(damping: float) -> HangingString:
    """A string of R = 2: l = g."""
    return uniform_string(length=9.81, damping=damping, gravity=9.81)


def _case(motion: Ramp | Sine | Smooth | Step, damping: float, ratio: float, phase: float) -> StringCase:
    """On a string of R = 2 s, at r = ratio and t = phase R; damping in 1/s."""
    return StringCase(string=_unit(damping), motion=motion, position=9.81 * ratio**2, time=2 * phase)


def slow_root(damping: float, zero: float) -> float:
    """Return −p of the slow root for μ = zero on the string of R = 2, 1/s."""
    return (zero / 2) ** 2 / fast_root(damping, zero)


def fast_root(damping: float, zero: float) -> float:
    """Return −p of the fast root."""
    return damping + math.sqrt(damping**2 - (zero / 2) ** 2)


CASES = {
    "ramp, undamped": _case(Ramp(speed=1.0), 0.0, 0.7, 2.35),
    "ramp, x = 0 undamped between focusings": _case(Ramp(speed=1.0), 0.0, 0.0, 4.2),
    "ramp, first mode critical": _case(Ramp(speed=1.0), FIRST / 2, 0.45, 1.8),
    "ramp, second mode critical": _case(Ramp(speed=1.0), SECOND / 2, 0.8, 0.9),
    "ramp, alpha R = 128": _case(Ramp(speed=1.0), 64.0, 0.6, 80.0),
    "ramp, alpha R = 1.3e3": _case(Ramp(speed=1.0), 650.0, 0.5, 30.0),
    "ramp, alpha R = 1.3e3, early": _case(Ramp(speed=1.0), 650.0, 0.97, 0.08),
    "ramp, x = .999 l": StringCase(string=_unit(0.4), motion=Ramp(speed=1.0), position=0.999 * 9.81, time=1.3),
    "ramp, x = .99 l at t = .02": StringCase(
        string=uniform_string(damping=1.1), motion=Ramp(speed=2.0), position=0.99, time=0.02
    ),
    "ramp, l = 100, alpha = 0.1": StringCase(
        string=uniform_string(length=100.0, damping=0.1), motion=Ramp(speed=1.0), position=30.0, time=9.0
    ),
    "ramp, late": _case(Ramp(speed=1.0), 0.02, 0.3, 201.9),
    "sine, at the first frequency": _case(Sine(amplitude=1.0, omega=FIRST / 2), 0.0, 0.5, 3.3),
    "sine, at the third frequency": _case(Sine(amplitude=1.0, omega=THIRD / 2), 0.0, 0.2, 2.6),
    "sine, 1e-9 from the second frequency": _case(Sine(amplitude=1.0, omega=SECOND / 2 * (1 + 1e-9)), 0.0, 0.35, 5.1),
    "sine, 1e-4 from the first frequency, late": _case(
        Sine(amplitude=1.0, omega=FIRST / 2 * (1 - 1e-4)), 0.0, 0.35, 151.1
    ),
    "sine, alpha = omega = Omega_2": _case(Sine(amplitude=1.0, omega=SECOND / 2), SECOND / 2, 0.4, 2.2),
    "sine, x = 0 at the damped frequency": _case(
        Sine(amplitude=1.0, omega=math.sqrt(FIRST**2 / 4 - 0.09)), 0.3, 0.0, 4.6
    ),
    "sine, omega R = 38": _case(Sine(amplitude=1.0, omega=19.0), 0.6, 0.3, 1.17),
    "sine, omega R = 38 at x = 0": _case(Sine(amplitude=1.0, omega=19.3), 0.02, 0.0, 1.4),
    "sine, slow": _case(Sine(amplitude=1.0, omega=0.003), 0.15, 0.45, 400.0),
    "sine, omega = 0": _case(Sine(amplitude=1.0, omega=0.0), 0.15, 0.45, 4.0),
    "smooth, beta = 2 alpha": _case(Smooth(amplitude=1.0, rate=1.6), 0.8, 0.3, 1.2),
    "smooth, beta = alpha": _case(Smooth(amplitude=1.0, rate=0.8), 0.8, 0.3, 1.2),
    "smooth, alpha/2 < beta < alpha": _case(Smooth(amplitude=1.0, rate=1.3), 1.9, 0.6, 1.3),
    "smooth, beta < alpha/2": _case(Smooth(amplitude=1.0, rate=0.2), 1.0, 0.1, 2.4),
    "smooth, beta R = 319": _case(Smooth(amplitude=1.0, rate=159.5), 0.5, 0.4, 1.1),
    "smooth, beta R = 1e4": _case(Smooth(amplitude=1.0, rate=5e3), 0.5, 0.4, 1.1),
    "smooth, beta at the slow root": _case(Smooth(amplitude=1.0, rate=slow_root(2.0, FIRST)), 2.0, 0.3, 1.9),
    "smooth, 2 beta at the slow root": _case(Smooth(amplitude=1.0, rate=slow_root(2.0, FIRST) / 2), 2.0, 0.3, 1.9),
    "smooth, beta at the fast root": _case(Smooth(amplitude=1.0, rate=fast_root(1.5, FIRST)), 1.5, 0.7, 0.8),
    "smooth, 2 beta at the fast root": _case(Smooth(amplitude=1.0, rate=fast_root(1.5, FIRST) / 2), 1.5, 0.7, 0.8),
    "smooth, beta at the slow root of mode 2": _case(Smooth(amplitude=1.0, rate=slow_root(4.0, SECOND)), 4.0, 0.2, 2.3),
    "smooth, beta near the slow root": _case(Smooth(amplitude=1.0, rate=slow_root(2.0, FIRST) * 1.0001), 2.0, 0.3, 1.9),
    "smooth, triple": _case(Smooth(amplitude=1.0, rate=FIRST / 2), FIRST / 2, 0.55, 1.7),
    "smooth, triple with 2 beta": _case(Smooth(amplitude=1.0, rate=SECOND / 4), SECOND / 2, 0.55, 1.7),
    "smooth, nearly triple": _case(
        Smooth(amplitude=1.0, rate=FIRST / 2 * (1 + 3e-8)), FIRST / 2 * (1 - 1e-8), 0.55, 1.7
    ),
    "smooth, accidental near-coincidence": StringCase(
        string=uniform_string(damping=25.0), motion=Smooth(amplitude=1.0, rate=4.0), position=0.3, time=1.1
    ),
    "smooth, alpha R = 1.3e3": _case(Smooth(amplitude=1.0, rate=0.9), 650.0, 0.95, 3.0),
    "smooth, x = 0 undamped": _case(Smooth(amplitude=1.0, rate=3.0), 0.0, 0.0, 2.1),
    "step, critical": _case(Step(amplitude=1.0), FIRST / 2, 0.6, 1.2),
    "step, viscous": _case(Step(amplitude=1.0), 6.0, 0.8, 2.5),
    "step, undamped": _case(Step(amplitude=1.0), 0.0, 0.5, 2.2),
    "step, x = 0 undamped": _case(Step(amplitude=1.0), 0.0, 0.0, 2.1),
    "step, 2 % of R after the front": _case(Step(amplitude=1.0), 0.9, 0.3, 0.72),
    "step, 0.5 % of R after the front": _case(Step(amplitude=1.0), 0.9, 0.3, 0.705),
    "step, a long string": StringCase(
        string=uniform_string(length=400.0, damping=0.05, gravity=9.81),
        motion=Step(amplitude=0.5),
        position=90.0,
        time=31.0,
    ),
}
