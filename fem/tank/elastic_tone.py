"""The first elastic tone: the mode in which a beam's first dry mode has the largest participation.

pₙ = (e₁ᵀ K φₙ)², with the K-normalised dry mode e₁ and K-orthonormal modes φₙ; Σ pₙ = 1. In a tank with a free surface
the elastic energy is spread over several hybrid modes, the more the shorter the beam compared with the free surface;
the tone then has a runner-up of nearly the same participation. The pressure-release tone, with ψ = 0 on the free
surface, is always a single mode.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Protocol

import numpy as np

from hydroelastic.fem.mode_set import Mode
from hydroelastic.fem.surfaces import Body, LiquidSurface
from hydroelastic.physics.dofs import Dof

SHARED = 0.5
"""A mode that has more than this part of the largest participation shares the tone."""

LEAST_OF_ONE_MODE = 0.25
"""A shared tone whose largest participation is less is not attributed to a single mode."""


@dataclass(frozen=True, kw_only=True)
class ElasticTone:
    """The first elastic tone of one beam among computed modes.

    Attributes:
        body: index of the beam.
        index: index of the mode, from 0.
        participation: pₙ of that mode.
        runner_up: the next largest pₙ.
        sharing: indices of the first and the last mode that share it.
        certain: whether no mode above the computed ones can have a larger participation: their sum is less than the
            largest one, or the computed modes extend well above the tone.
    """

    body: int
    index: int
    participation: float
    runner_up: float
    sharing: tuple[int, int]
    certain: bool

    @property
    def is_shared(self) -> bool:
        """Whether a second mode has a participation nearly as large."""
        return self.runner_up > SHARED * self.participation

    @property
    def is_of_one_mode(self) -> bool:
        """Whether the tone is attributed to a single mode."""
        return not self.is_shared or self.participation >= LEAST_OF_ONE_MODE


class Amplitudes(Protocol):
    """What is asked of modes, as of `fem.mode_set.ModeSet`."""

    @property
    def eigenvalues(self) -> np.ndarray:
        """λ of all modes, ascending."""

    @property
    def elastic_amplitudes(self) -> np.ndarray:
        """Body part of each mode at unit generalized mass, shape (modes, body unknowns)."""


def participations(modes: Amplitudes, bodies: tuple[Body, ...], body: int) -> np.ndarray:
    """Return pₙ of a beam's first dry mode, shape (modes,)."""
    first = next(place for place, dof in enumerate(bodies[body].dofs) if dof.is_first_elastic)
    position, stiffness = sum(other.size for other in bodies[:body]) + first, bodies[body].stiffness[first]
    # Modes have unit generalized mass, so φᵀKφ = λ.
    parts: np.ndarray = stiffness * modes.elastic_amplitudes[:, position] ** 2 / modes.eigenvalues
    return parts


def elastic_tone(
    modes: Amplitudes, bodies: tuple[Body, ...], body: int, *, pressure_release: float | None = None
) -> ElasticTone:
    """Return the mode of largest participation."""
    parts = participations(modes, bodies, body)
    order = np.argsort(parts)[::-1]
    best, second = parts[order[0]], parts[order[1]] if len(parts) > 1 else 0.0
    sharing = np.flatnonzero(parts >= SHARED * best)
    return ElasticTone(
        body=body,
        index=int(order[0]),
        participation=float(best),
        runner_up=float(second),
        sharing=(int(sharing[0]), int(sharing[-1])),
        certain=bool(best > 1.0 - parts.sum()) or _reaches_past(modes, parts, pressure_release),
    )


def _reaches_past(modes: Amplitudes, parts: np.ndarray, tone: float | None) -> bool:
    """Whether the last fifth of the modes lies above a pressure-release tone, with less than half the largest part.

    Participations that decrease there with less than half of the energy found are not those above the tone.
    """
    start = len(parts) - len(parts) // 5
    if tone is None or start == len(parts):
        return False
    past = tone < modes.eigenvalues[start] and parts[start:].max() < 0.5 * parts.max()
    return bool(past and parts.sum() > 0.5)


def mode_kinds(modes: Sequence[Mode], bodies: tuple[Body, ...], surfaces: tuple[LiquidSurface, ...]) -> tuple[str, ...]:
    """Return what has most of the potential energy of each mode: a motion of the bodies ("heave", "pitch", "sway",
    "roll", "elastic"), or the liquids: "sloshing" of one liquid, "interface wave" or "surface wave" of two.
    """
    if not modes:
        return ()
    names, of_kind = _shares_by_kind(
        tuple(body.dofs for body in bodies), tuple((surface.above, surface.below) for surface in surfaces)
    )
    shares = np.array([mode.energy for mode in modes]) @ of_kind
    return tuple(names[place] for place in shares.argmax(axis=1))


@lru_cache(maxsize=64)
def _shares_by_kind(
    dofs: tuple[tuple[Dof, ...], ...], surfaces: tuple[tuple[int | None, int], ...]
) -> tuple[tuple[str, ...], np.ndarray]:
    """The kinds, and the matrix that sums shares in the potential energy of each, shape (shares, kinds); of two equal
    ones the first counts."""
    of_bodies = [dof.kind for own in dofs for dof in own]
    of_surfaces = [
        "interface wave" if above is not None else "surface wave" if below else "sloshing" for above, below in surfaces
    ]
    names, kinds = tuple(dict.fromkeys(["sloshing", *of_surfaces, *of_bodies])), of_bodies + of_surfaces
    of_kind = np.array([[kind == name for name in names] for kind in kinds], dtype=float)
    of_kind.flags.writeable = False
    return names, of_kind


def bending_fractions(modes: Sequence[Mode], bodies: tuple[Body, ...]) -> np.ndarray:
    """Return the strain energy of bending over the total potential energy, shape (modes,)."""
    bending = np.concatenate([body.bending_stiffness for body in bodies] or [np.empty(0)])
    amplitudes = np.array([mode.body_amplitudes for mode in modes]).reshape(len(modes), len(bending))
    fractions: np.ndarray = amplitudes**2 @ bending / np.array([mode.eigenvalue for mode in modes])
    return fractions


def added_mass(stiffness: float, mass: float, eigenvalue: float, relative_error: float) -> tuple[float, float]:
    """Return the added mass m_a = k/λ − m of a tone or a motion from its frequency, with its relative error."""
    whole = stiffness / eigenvalue
    added = whole - mass
    return added, 2.0 * relative_error * whole / abs(added) if added else 1.0
