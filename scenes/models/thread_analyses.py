"""Analyses of a thread besides its equilibrium: modes, stability in a growing stream, motion in time. SI units."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal, TypeAlias

from pydantic import Discriminator, Field, Strict, Tag

from hydroelastic.scenes.models.scene_model import PositiveNumber, SceneModel
from hydroelastic.scenes.models.thread_tables import Vector
from hydroelastic.scenes.models.values import OR_SWEEP, NumberFromZero, ascending_values, kind_of

MOST_TIMES = 100_000
EndName: TypeAlias = Literal["a", "b"]


class ThreadModes(SceneModel):
    """Small free motions about the equilibrium."""

    kind: Literal["modes"] = Field(default="modes", description="kind of the analysis")
    count: Annotated[int, Strict(), Field(ge=1, le=100)] = Field(
        default=6, description="how many oscillating ones, from the slowest"
    )
    velocity_damping: Annotated[bool, Strict()] = Field(
        default=True, description="whether the change of drag with the thread's velocity damps them"
    )


class ThreadStability(SceneModel):
    """Stream factors at which an equilibrium begins to diverge or to flutter."""

    kind: Literal["stability"] = Field(default="stability", description="kind of the analysis")
    factors: Annotated[tuple[PositiveNumber, ...], *ascending_values(1000)] = Field(
        description=f"factors of the stream in the sweep, {OR_SWEEP}"
    )


class EndMotion(SceneModel):
    """Displacement of a fixed end from its position; the given parts add up."""

    end: EndName = Field(description="which end")
    velocity: Vector = Field(default=(0.0, 0.0, 0.0), description="steady velocity, m/s")
    amplitude: Vector = Field(default=(0.0, 0.0, 0.0), description="of the displacement × sin ωt, m")
    omega: PositiveNumber = Field(default=1.0, description="angular frequency ω, rad/s")
    phase: NumberFromZero = Field(default=0.0, description="added to ωt, rad; the displacement at t = 0 is taken off")
    rise: NumberFromZero = Field(default=0.0, description="time in which the motion sets in smoothly, s")
    file: Path | None = Field(
        default=None,
        description="text file with four columns, time in s and displacement (x, y, z) in m, between which a smooth "
        "curve is laid; relative to the folder of the scene",
    )


class EndRelease(SceneModel):
    """Release of an end."""

    end: EndName = Field(description="which end")
    time: NumberFromZero = Field(default=0.0, description="when, s")


class VortexForce(SceneModel):
    """Force across thread and stream of vortices that are shed, (ρ d/2) C |u_n|² sin 2π St ∫|u_n|dt/d."""

    lift: PositiveNumber = Field(description="coefficient C of the force")
    strouhal: PositiveNumber = Field(default=0.2, description="Strouhal number St")


class ThreadMotion(SceneModel):
    """Motion in time."""

    kind: Literal["motion"] = Field(default="motion", description="kind of the analysis")
    times: Annotated[tuple[NumberFromZero, ...], *ascending_values(MOST_TIMES)] = Field(
        description=f"times at which the motion is reported, s, {OR_SWEEP}"
    )
    start: Literal["equilibrium", "still_liquid", "straight"] = Field(
        default="equilibrium",
        description="from the equilibrium, from that without a stream, or straight and at rest",
    )
    direction: Vector = Field(default=(0.0, 0.0, -1.0), description="of a straight start, from end A to end B")
    move: tuple[EndMotion, ...] = Field(default=(), description="how ends are moved")
    release: tuple[EndRelease, ...] = Field(default=(), description="ends that are released, and when")
    vortices: VortexForce | None = Field(default=None, description="force of vortices; by default none")
    integrator: Literal["midpoint", "generalized_alpha"] = Field(
        default="midpoint",
        description="midpoint rule, which keeps energy, or generalised-α, which damps what the steps do not resolve",
    )
    spectral_radius: Annotated[float, Strict(), Field(ge=0, le=0.95)] = Field(
        default=0.6, description="of generalised-α at infinite frequency; 0.5 to 0.7"
    )
    step: PositiveNumber | None = Field(default=None, description="fixed step, s; by default it adapts")
    tolerance: Annotated[float, Strict(), Field(ge=1e-9, le=1e-1)] = Field(
        default=1e-3, description="asked error of positions, relative to the length"
    )


ThreadAnalysis: TypeAlias = Annotated[
    Annotated[ThreadModes, Tag("modes")]
    | Annotated[ThreadStability, Tag("stability")]
    | Annotated[ThreadMotion, Tag("motion")],
    Discriminator(kind_of),
]
"""Any analysis: the key ``kind`` tells which."""
