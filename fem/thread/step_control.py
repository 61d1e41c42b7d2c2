"""How long the steps of a motion are: equal, or as long as their errors allow."""

from __future__ import annotations

from math import ceil, inf

# A step's error is of the third order. Exponents of a controller with proportional and integral part (K. Gustafsson,
# ACM Trans. Math. Softw. 17 (1991) 533).
_PROPORTIONAL, _INTEGRAL = 0.4 / 3.0, 0.7 / 3.0
_SAFETY, _LEAST, _MOST = 0.9, 0.2, 2.0
# After a start or a break: how often the first step is halved before its error is known.
_FIRST_PART = 0.125
_HALVINGS = 12


class StepControl:
    """Lengths of steps.

    Args:
        longest: of all steps.
        tolerance: of a step's error; equal steps without it.

    Attributes:
        longest: as given.
        adaptive: whether there is a tolerance.
    """

    def __init__(self, longest: float, tolerance: float | None) -> None:
        """Begin."""
        self.longest, self.adaptive = longest, tolerance is not None
        self._tolerance = inf if tolerance is None else tolerance
        self._length, self._last_error = longest, inf
        self.restart()

    def restart(self) -> None:
        """Begin anew, with a short step if errors are looked at."""
        self._length = _FIRST_PART * self.longest if self.adaptive else self.longest
        self._last_error = self._tolerance

    def next(self, remaining: float) -> float:
        """Length of the next step, so that equal ones land on the end of what remains."""
        return remaining / max(1, ceil(remaining / self._length * (1.0 - 1e-9)))

    def accepts(self, error: float) -> bool:
        """Whether a step is good enough."""
        return error <= self._tolerance

    def shorter(self, length: float, error: float) -> float:
        """Length to try again with after a step that failed or was too long."""
        if error == inf:
            self._length = 0.5 * length
        else:
            self._length = length * max(_LEAST, _SAFETY * (self._tolerance / error) ** (1.0 / 3.0))
        return self._length

    def exhausted(self, length: float) -> bool:
        """Whether steps have become so short that there is no hope."""
        return length < self.longest * 0.5**_HALVINGS * (1e-3 if self.adaptive else 1.0)

    def done(self, length: float, error: float) -> None:
        """Tell of an accepted step."""
        if not self.adaptive:
            # Steps that had to be halved grow again.
            self._length = min(self.longest, 2.0 * length)
            return
        error = max(error, 1e-6 * self._tolerance)
        growth = (self._tolerance / error) ** _INTEGRAL * (self._last_error / error) ** _PROPORTIONAL
        # Of what was allowed, not of what was left to the next stop.
        base = max(length, min(self._length, 2.0 * length))
        self._length = min(self.longest, base * min(_MOST, max(_LEAST, _SAFETY * growth)))
        self._last_error = error
