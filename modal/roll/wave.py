"""Response of a ship at rest to one wave, a sine that begins."""

from __future__ import annotations

import cmath

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hydroelastic.modal.damped_pair import damped_pair


def response_from_rest(
    natural_frequency: float, damping: float, frequencies: ArrayLike, times: ArrayLike
) -> NDArray[np.complex128]:
    """Return y(t) of y'' + 2ny' + k²y = k² e^{iωt} from rest: Im y answers k² sin ωt, and its rate is ω Re y.

    y is k² times the divided difference of e^{zt} at iω and at the roots z₁, z₂ of z² + 2nz + k²,

        y = k² (E − S)/(iω − z₂),    E = (e^{z₁t} − e^{iωt})/(z₁ − iω),    S = (e^{z₁t} − e^{z₂t})/(z₁ − z₂).

    The amplitude k²/(k² − ω² + 2inω) of the steady motion does not occur, which is infinite in resonance without
    damping and takes all digits near it. z₁ is the root next to iω, so that iω − z₂ is not small; beyond critical
    damping it may be either. E goes by expm1, and S is regular at critical damping.

    Args:
        natural_frequency: k, rad/s.
        damping: n, 1/s, from 0.
        frequencies: ω, rad/s, shape (times,).
        times: t, s, from 0, shape (times,). Beyond a few periods of the wave the phase ωt loses digits.

    Returns:
        y, shape (times,).
    """
    frequencies, times = np.asarray(frequencies, float), np.asarray(times, float)
    k, n = natural_frequency, damping
    root = cmath.sqrt((k - n) * (k + n))
    if n < k:
        near, far = -n + 1j * root.real, -n - 1j * root.real
    else:
        near, far = complex(-(k**2) / (n + root.imag)), complex(-(n + root.imag))
    apart = near - 1j * frequencies
    # Where both coincide E is t e^{iωt}.
    exponent = apart * times
    small = np.abs(exponent) < np.finfo(float).tiny
    ratio = np.where(small, 1.0, np.expm1(exponent) / np.where(small, 1.0, exponent))
    forced = times * np.exp(1j * frequencies * times) * ratio
    second = damped_pair(k, n, times)[1][0]
    return k**2 * (forced - second) / (1j * frequencies - far)
