"""Thin floats of the reference cases, and what tests of them share."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import numpy.typing as npt
from numpy.polynomial.legendre import leggauss

from hydroelastic.modal.liquid.two_layer import TwoLayers
from hydroelastic.physics.profiles import FloatShape, Profile, float_profile

REFERENCE = json.loads((Path(__file__).parents[1] / "reference" / "two_fluid_float.json").read_text(encoding="utf-8"))
CASES = {case["id"]: case for case in REFERENCE["cases"]}
EPS = np.finfo(float).eps
SHAPES: tuple[FloatShape, ...] = ("exponential", "wedge", "parabola", "ellipse")
# Half-height, total density and g* are 1, so that SI values are those in units of b².
UNIT = TwoLayers(density_below=1.0, depth_below=math.inf, gravity=1.0)
CHANNEL = TwoLayers(density_below=1.0, density_above=0.8, depth_below=2.0, depth_above=1.5, gravity=9.81)


def thin(shape: FloatShape, slenderness: float, tail: float = 0.0) -> Profile:
    return float_profile(shape, slenderness, 1.0, tail=tail)


def of_case(name: str) -> Profile:
    inputs = CASES[name]["inputs"]
    # A half-height other than 1 shows that only τ counts.
    return float_profile(inputs["shape"], 2.5 * float(inputs["tau"]), 2.5, tail=0.0)


def of_coupling(coupling: float) -> Profile:
    return thin("exponential", math.pi * coupling / (2 - coupling))


def number(pair: list[str]) -> complex:
    return complex(float(pair[0]), float(pair[1]))


def gauss(edges: npt.ArrayLike, points: int = 20) -> tuple[npt.NDArray, npt.NDArray]:
    nodes, weights = leggauss(points)
    half = np.diff(np.asarray(edges, dtype=float))[:, None] / 2
    return (np.asarray(edges)[:-1, None] + half * (nodes + 1)).ravel(), (half * weights).ravel()
