"""Control of the step length of a time integration: equal steps, or adapted to a tolerance."""

from __future__ import annotations

from math import ceil, inf

# A step's error is of the third order. Exponents of a controller with proportional and integral part (K. Gustafsson,
# ACM Trans. Math. Softw. 17 (1991) 533).
_PROPORTIONAL, _INTEGRAL = 0.4 / 3.0, 0.7 / 3.0
_SAFETY, _LEAST, _MOST = 0.9, 0.2, 2.0
# First step after a start or a discontinuity, of the longest one; number of halvings at which a step is too short.
_FIRST_PART = 0.125
_HALVINGS = 12


class StepControl:
    """Lengths of the steps of a time integration.

    Args:
        longest: of all steps.
        tolerance: of a step's error; equal steps without it.

    Attributes:
        longest: as given.
        adaptive: whether there is a tolerance.
    """

    def __init__(self, longest: float, tolerance: float | None) -> None:
        self.longest, self.adaptive = longest, tolerance is not None
        self._tolerance = inf if tolerance is None else tolerance
        self._length, self._last_error = longest, inf
        self.restart()

    def restart(self) -> None:
        """Start anew after a discontinuity, with a short step if steps adapt."""
        self._length = _FIRST_PART * self.longest if self.adaptive else self.longest
        self._last_error = self._tolerance

    def next_length(self, remaining: float) -> float:
        """Return the length of the next step, such that equal ones end at the end of the remaining time."""
        return remaining / max(1, ceil(remaining / self._length * (1.0 - 1e-9)))

    def is_acceptable(self, error: float) -> bool:
        """Whether the error of a step is within the tolerance."""
        return error <= self._tolerance

    def reject(self, length: float, error: float) -> float:
        """Return the length of the repeated step, after one that failed (infinite error) or was not accurate enough."""
        if error == inf:
            self._length = 0.5 * length
        else:
            self._length = length * max(_LEAST, _SAFETY * (self._tolerance / error) ** (1.0 / 3.0))
        return self._length

    def is_too_short(self, length: float) -> bool:
        """Whether a step is so short that the integration is to be given up."""
        return length < self.longest * 0.5**_HALVINGS * (1e-3 if self.adaptive else 1.0)

    def accept(self, length: float, error: float) -> None:
        """Adapt the length after an accepted step."""
        if not self.adaptive:
            # Steps that had to be halved grow again.
            self._length = min(self.longest, 2.0 * length)
            return
        error = max(error, 1e-6 * self._tolerance)
        growth = (self._tolerance / error) ** _INTEGRAL * (self._last_error / error) ** _PROPORTIONAL
        # By the allowed length, which may be longer than the time that was left to the next stop.
        base = max(length, min(self._length, 2.0 * length))
        self._length = min(self.longest, base * min(_MOST, max(_LEAST, _SAFETY * growth)))
        self._last_error = error
