"""Type and error of the asymptotic solutions of a thread."""

from __future__ import annotations

from dataclasses import dataclass

from hydroelastic.modal.thread.shape import ThreadShape


class NoAsymptoticError(ValueError):
    """The conditions of an asymptotic solution do not hold."""


@dataclass(frozen=True)
class AsymptoticThread:
    """An asymptotic solution with its truncation error."""

    shape: ThreadShape  # positions and contact forces
    order: int  # of the last terms that are kept
    small: float  # the small parameter of the expansion
    # estimate of the largest error of a position, m: the next term, or the last one times the small parameter
    position_truncation: float
    force_truncation: float  # the same of a contact force, N
