"""The modes of one solution as vectors that can be compared with those of another, on another mesh."""

from __future__ import annotations

from base64 import b64decode, b64encode
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Self

import numpy as np

Array = np.ndarray


@dataclass(frozen=True, kw_only=True)
class ModeVectors:
    """The lowest modes at one value of a parameter.

    In a mode φ of unit energy φᵀKφ = 1 the entries are roots of energies with their signs: √kᵢ aᵢ of the dry modes and
    motions of each body, and √(Δρ g w) η at points of weights w of each free piece of a still level, the points at the
    same fractions of its length. The product of two vectors is the K-inner product: at one value of the parameter
    the modes are orthonormal.

    Attributes:
        omega: ω of each mode, rad/s, ascending, shape (modes,).
        relative_error: estimated relative error of ω; NaN where there is no estimate.
        symmetry: 1 of symmetric modes, −1 of antisymmetric ones, 0 where a tank has no symmetry.
        blocks: entries by body and by piece, each of shape (modes, entries).
        participation: part of each mode in the first elastic tone of each beam, shape (beams, modes).
        pressure_release: ω of the pressure-release tone of each beam, rad/s; NaN without one.
    """

    omega: Array
    relative_error: Array
    symmetry: Array
    blocks: Mapping[str, Array]
    participation: Array
    pressure_release: Array

    def as_texts(self) -> dict[str, Any]:
        """Return the arrays as texts of JSON, without loss."""
        arrays = {name: value for name, value in vars(self).items() if name != "blocks"}
        return {name: array_text(value) for name, value in arrays.items()} | {
            "blocks": {name: array_text(value) for name, value in self.blocks.items()}
        }

    @classmethod
    def of_texts(cls, content: Mapping[str, Any]) -> Self:
        """Return the vectors of `as_texts`."""
        arrays = {name: array_of_text(value) for name, value in content.items() if name != "blocks"}
        return cls(**arrays, blocks={name: array_of_text(value) for name, value in content["blocks"].items()})

    def overlaps(self, other: ModeVectors) -> Array:
        """Return the K-inner product of each mode with each of another solution, shape (modes, other modes).

        Modes of opposite symmetry have none. Dry modes beyond those of the coarser solution count as zero.
        """
        products = np.zeros((len(self.omega), len(other.omega)))
        for name in self.blocks.keys() & other.blocks.keys():
            one, two = self.blocks[name], other.blocks[name]
            shared = min(one.shape[1], two.shape[1])
            products += one[:, :shared] @ two[:, :shared].T
        opposite = self.symmetry[:, None] * other.symmetry < 0
        return np.where(opposite, 0.0, products)


def array_text(array: Array) -> list[Any]:
    """Return type, shape and bytes of an array in types of JSON; texts as they are."""
    if array.dtype.kind in "UO":
        return ["", list(array.shape), array.ravel().tolist()]
    return [array.dtype.str, list(array.shape), b64encode(array.tobytes()).decode()]


def array_of_text(text: Sequence[Any]) -> Array:
    """Return the array of `array_text`."""
    kind, shape, content = text
    return np.frombuffer(b64decode(content), dtype=kind).reshape(shape) if kind else np.array(content).reshape(shape)
