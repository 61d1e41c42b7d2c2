"""Thin boundary against exact boundary: how their difference falls as a float gets thinner.

The same float is solved with its conditions on the contour itself and on its middle line, its half width halved again
and again; by Archimedes its mass follows. Relative to each other the two models differ

    in ω of heave and its modal mass           like the square of the thinness
    in the added mass at infinite frequency      like the thinness
    in ω of waves in a tank of length L        like half width/L: the thin float leaves its area to the liquid

as theory says: the source of the next order on the middle line is that of the squared thinness, and added mass is
itself a part of the mass that falls like the thinness. See docs, studies.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, Literal, TypeAlias

import numpy as np
from pydantic import ValidationError

from hydroelastic.scenes.errors import Problem, SceneError, scene_error
from hydroelastic.scenes.models.bodies import THIN_SHAPES
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.study.rates import DIFFERENCE, fitted_slope
from hydroelastic.scenes.tank.run import run_tank

Boundary: TypeAlias = Literal["thin", "exact"]

ASKED = 1e-8
"""Relative error asked of both models: far below their difference."""

_WAVES = 2
# Differences within so many times what both models may be out say little of the boundary.
_CLEAR = 10.0
_POINTS = 3


@dataclass(frozen=True, kw_only=True)
class Comparison:
    """One number by both models.

    Attributes:
        thin: with conditions on the middle line.
        exact: with conditions on the contour.
        uncertainty: sum of the estimated relative errors of both.
    """

    thin: float
    exact: float
    uncertainty: float

    @property
    def difference(self) -> float:
        """thin/exact − 1."""
        return self.thin / self.exact - 1.0

    @property
    def is_clear(self) -> bool:
        """Whether the difference is that of the boundaries, and not of the solutions."""
        return abs(self.difference) > _CLEAR * self.uncertainty


@dataclass(frozen=True, kw_only=True)
class ThinnessRow:
    """Both models of one float.

    Attributes:
        half_width: of the float, m.
        thinness: half width over half height.
        breadth: half width over tank length.
        compared: what both models say, by the name in `QUANTITIES`; a heave that neither model finds is not there.
        shared: whether heave is shared with waves in one of the models, so that its modal mass says little.
    """

    half_width: float
    thinness: float
    breadth: float
    compared: dict[str, Comparison]
    shared: bool


@dataclass(frozen=True, kw_only=True)
class ThinnessRate:
    """An observed rate, difference ~ (half width)^rate.

    Attributes:
        quantity: name in `QUANTITIES`.
        observed: rate, fitted to the thinnest three floats whose difference is clear.
        deviation: standard error of the fit.
        expected: rate of theory.
        shared: whether one of these floats shares its heave with waves: its numbers then follow those of the waves.
    """

    quantity: str
    observed: float
    deviation: float
    expected: float
    shared: bool

    @property
    def agrees(self) -> bool:
        """Whether it differs by at most a tenth from theory."""
        return abs(self.observed - self.expected) <= DIFFERENCE * self.expected


QUANTITIES: dict[str, tuple[str, float]] = {
    "heave": ("ω of heave, rad/s", 2.0),
    "modal mass": ("modal mass of heave, kg/m", 2.0),
    "added mass": ("added mass at infinite frequency, kg/m", 1.0),
    **{f"wave {number}": (f"ω of wave {number}, rad/s", 1.0) for number in range(1, _WAVES + 1)},
}
"""What is compared, by name: in words, and the power of the thinness with which the difference falls."""

OF_HEAVE = ("heave", "modal mass")
"""Those of one mode, which may be shared with waves."""


def check_thinness(scene: TankScene) -> None:
    """Refuse scenes whose float only one of the boundaries knows.

    Raises:
        SceneError: saying which float is needed.
    """
    floats = [body for _, body in scene.floats]
    if len(floats) == 1 and floats[0].shape in THIN_SHAPES and set(floats[0].motions) == {"heave"}:
        return
    raise SceneError(
        Problem(
            key="families",
            value="thinness",
            wrong="it compares both boundary conditions of one float, and the scene has none that allows both",
            allowed=f"scenes with one float, of shape {', '.join(THIN_SHAPES)}, that heaves alone",
            remedy="Leave it out, or see float_parabola",
        )
    )


def thinness_rows(scene: TankScene, halvings: int) -> Iterator[ThinnessRow]:
    """Solve both models of a float of its own width, a half of it, a quarter and so on (collective).

    It ends early where a model does not keep what is asked, or the float is narrower than a mesh can follow.

    Args:
        scene: one that `check_thinness` accepts; its own tolerance plays no part.
        halvings: how often the width is halved, at most.

    Raises:
        SceneError: if one of the models is refused at the float's own width.
        UnsolvedError: if the eigen-solver fails.
    """
    for halving in range(halvings + 1):
        try:
            thin, exact = (_with_boundary(scene, 0.5**halving, boundary) for boundary in ("thin", "exact"))
        except SceneError:
            if halving:
                return
            raise
        summaries = [run_tank(variant).summary for variant in (thin, exact)]
        if any(summary["reasons"] for summary in summaries):
            return
        yield _row(thin, *summaries)


def fitted_thinness(rows: Sequence[ThinnessRow]) -> tuple[ThinnessRate, ...]:
    """Fit the rate of every quantity that three floats show clearly."""
    rates = []
    for quantity, (_, expected) in QUANTITIES.items():
        used = [row for row in rows if quantity in row.compared and row.compared[quantity].is_clear][-_POINTS:]
        if len(used) < _POINTS:
            continue
        slope, deviation = fitted_slope(
            np.log([row.thinness for row in used]), np.log([abs(row.compared[quantity].difference) for row in used])
        )
        shared = quantity in OF_HEAVE and any(row.shared for row in used)
        rates.append(
            ThinnessRate(quantity=quantity, observed=slope, deviation=deviation, expected=expected, shared=shared)
        )
    return tuple(rates)


def _with_boundary(scene: TankScene, factor: float, boundary: Boundary) -> TankScene:
    """The scene with a float of another width: by Archimedes a given mass goes with it."""
    index, body = scene.floats[0]
    assert body.half_width is not None
    changed = body.model_copy(
        update={
            "half_width": factor * body.half_width,
            "mass": None if body.mass is None else factor * body.mass,
            "boundary": boundary,
        }
    )
    bodies = (*scene.body[:index], changed, *scene.body[index + 1 :])
    accuracy = scene.accuracy.model_copy(update={"tolerance": ASKED})
    try:
        return TankScene.model_validate(scene.model_copy(update={"body": bodies, "accuracy": accuracy}).model_dump())
    except ValidationError as error:
        raise scene_error(error, TankScene) from error


def _row(scene: TankScene, thin: dict[str, Any], exact: dict[str, Any]) -> ThinnessRow:
    readings: dict[str, Callable[[dict[str, Any]], tuple[float, float] | None]] = {
        "heave": partial(_of_heave, key="omega", error="relative_error"),
        "modal mass": partial(_of_heave, key="modal_mass", error="relative_error"),
        "added mass": _added_mass,
        **{f"wave {number}": partial(_wave, number=number) for number in range(1, _WAVES + 1)},
    }
    compared = {}
    for name, read in readings.items():
        one, other = read(thin), read(exact)
        if one is not None and other is not None:
            compared[name] = Comparison(thin=one[0], exact=other[0], uncertainty=one[1] + other[1])
    body = scene.floats[0][1]
    assert body.half_width is not None
    assert body.half_height is not None
    return ThinnessRow(
        half_width=body.half_width,
        thinness=body.half_width / body.half_height,
        breadth=body.half_width / scene.tank.length,
        compared=compared,
        shared=any(bool(_heave(summary)["shared"]) for summary in (thin, exact)),
    )


def _heave(summary: dict[str, Any]) -> dict[str, Any]:
    mode: dict[str, Any] = summary["floats"][0]["modes"][0]
    return mode


def _of_heave(summary: dict[str, Any], key: str, error: str) -> tuple[float, float] | None:
    mode = _heave(summary)
    return None if mode["index"] is None else (mode[key], mode[error])


def _added_mass(summary: dict[str, Any]) -> tuple[float, float] | None:
    found = summary["floats"][0]["high_frequency"]
    return None if found is None else (found["added_mass"][0][0], found["relative_error"])


def _wave(summary: dict[str, Any], number: int) -> tuple[float, float] | None:
    """The lowest modes but for that of heave."""
    heave = _heave(summary)["index"]
    waves = [mode for index, mode in enumerate(summary["modes"], 1) if index != heave]
    return (waves[number - 1]["omega"], waves[number - 1]["relative_error"]) if number <= len(waves) else None
