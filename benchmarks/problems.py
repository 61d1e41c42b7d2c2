"""What is measured: problems, the codes that solve them, and their resolutions, as data.

`references.json` has the exact numbers of each problem: tanks by four methods that share no code, 11 to 14 digits;
sweeps by dry modes in gravity waves; circles by Ursell's multipoles with 800 terms, 13 digits; the hemisphere by those
of Hulme and cylinders by a Galerkin method, 11 digits; the plate in a basin by two methods, 10 digits; the cube of
water in closed form; strings by their series to 1e-15, null where a wave front is nearer than 5 % of its travel time;
catenaries by Newton's method with 40 digits, lines in a stream by shooting to 1e-13; the jumper that is moved by a fine
run of its field, 40 elements of degree 4 and steps of 0.025 s, good to 2e-5.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import inf, pi
from typing import Any

import numpy as np

Resolution = dict[str, Any]


@dataclass(frozen=True)
class Method:
    """A code in one way of its use: the function that solves, its resolutions, and the cases that it can solve."""

    name: str
    function: str
    resolutions: tuple[Resolution, ...]
    cases: tuple[str, ...] = ()
    peer: str = ""

    @property
    def own(self) -> bool:
        """Whether it is this project's."""
        return not self.peer


@dataclass(frozen=True)
class Problem:
    """Cases, and methods that solve them.

    Attributes:
        title: of its page.
        file: name of its files.
        told: what its page says of it.
        cases: what is given, by name.
        methods: in the order of tables.
        errors: at which seconds are compared.
        common: whether errors are relative to the largest number, and not each to its own.
        repeats: rounds that count.
        base: the method by whose seconds all others are divided, if any.
    """

    title: str
    file: str
    told: str
    cases: dict[str, Any]
    methods: tuple[Method, ...]
    errors: tuple[float, ...] = ()
    common: bool = False
    repeats: int = 3
    base: str = ""
    references: dict[str, str] = field(default_factory=dict)


def _each(key: str, values: Any, **fixed: Any) -> tuple[Resolution, ...]:
    return tuple({key: value, **fixed} for value in values)


_POWERS = tuple(10.0**-digits for digits in range(3, 11))
_BASE = {
    **{"length": 10.0, "depth": 5.0, "density": 1000.0, "gravity": 9.81, "start": 3.0, "beam_length": 4.0},
    **{"rigidity": 5e3, "mass": 50.0, "hydrostatic": False, "highest": 6.58243354921272},
}
_TANKS = {
    "base_s0": _BASE,
    "base_s1": _BASE | {"hydrostatic": True, "highest": 6.242243306250041},
    "offcentre_s0": _BASE | {"start": 1.0, "highest": 6.309240867737421},
    "narrow_s1": _BASE | {"length": 4.4, "start": 0.2, "hydrostatic": True, "highest": 21.972925733083112},
    "vlfs_dock_s1": _BASE
    | {"length": 320.0, "depth": 20.0, "density": 1025.0, "start": 8.0, "beam_length": 300.0, "rigidity": 8e9}
    | {"mass": 512.5, "hydrostatic": True, "highest": 2.3235451276452377},
}
_CENTRED = ("base_s0", "base_s1", "narrow_s1", "vlfs_dock_s1")
_SWEEPS = {
    "position": _BASE | {"key": "start", "values": np.linspace(0.5, 5.5, 40).round(6).tolist(), "compared": 8},
    "stiffness": _BASE | {"key": "rigidity", "values": np.geomspace(5e2, 5e4, 100).round(6).tolist(), "compared": 20},
}
_CATENARY: dict[str, Any] = {
    **{"a": (0.0, -100.0), "b": (89.9, -40.8), "length": 130.0, "diameter": 0.1, "weight": 881.05},
    **{"rigidity": 7.51e8, "density": 1025.0, "gravity": 9.81, "normal_drag": 1.0, "tangential_drag": 0.0},
    **{"stream": 0.0, "shear": 0.0},
}
_JUMPER = _CATENARY | {
    **{"a": (-100.0, -55.0), "b": (0.0, -5.0), "length": 170.0, "diameter": 0.396, "rigidity": 5e8},
    **{"weight": (165.0 - 1000.0 * pi * 0.396**2 / 4.0) * 9.807, "density": 1000.0, "gravity": 9.807},
}
_STREAM = _CATENARY | {
    **{"a": (0.0, -60.0), "b": (80.0, -30.0), "length": 100.0, "diameter": 0.02, "weight": 5.0, "rigidity": 1e5},
    **{"normal_drag": 2.0 * 12.3 / 20.5, "tangential_drag": 2.0 * 0.644 / (20.5 * pi), "stream": 0.7},
}
_LINES: dict[str, dict[str, Any]] = {
    "catenary": _CATENARY,
    "jumper at rest": _JUMPER,
    "uniform stream": _STREAM,
    "sheared stream": _STREAM | {"stream": 0.4, "shear": 0.02},
    "jumper moved": _JUMPER
    | {"amplitude": 10.0, "period": 27.0, "largest": 52333.0, "times": np.linspace(54.0, 81.0, 109).tolist()},
}
for _line in _LINES.values():
    _line["mass"] = _line["weight"] / _line["gravity"] + _line["density"] * pi * _line["diameter"] ** 2 / 4.0

_NGSOLVE = Method("NGSolve", "ngsolve_tank:tank", _each("degree", range(4, 13), halves=False), peer="ngsolve")
_LOOP = Method("NGSolve", "ngsolve_tank:sweep", _each("degree", (8, 10), halves=True), peer="ngsolve")
_RUN = ["-m", "hydroelastic.scenes", "run", "aquarium", "--quiet", "--out", "{out}"]
_IMPORT = "import of the libraries"

PROBLEMS = {
    "start": Problem(
        "Start, and what single runs cost",
        "start",
        """Whole processes, warm and with an empty cache of compiled forms (*cold*), beside the bare import of dolfinx,
petsc4py, slepc4py and gmsh; in a warm process a sweep of 100 stiffnesses, and the base tank at a tolerance of 1e-8,
beside the script on NGSolve.""",
        {"processes": {}, "stiffness": _SWEEPS["stiffness"], "base_s0": _BASE},
        (
            Method(
                *(_IMPORT, "ours:command", ({"arguments": ["-c", "import dolfinx, petsc4py, slepc4py, gmsh"]},)),
                cases=("processes",),
            ),
            Method(
                "run aquarium --no-images", "ours:command", ({"arguments": [*_RUN, "--no-images"]},), ("processes",)
            ),
            Method("run aquarium", "ours:command", ({"arguments": _RUN},), ("processes",)),
            Method("hydroelastic", "ours:sweep", ({"tolerance": 1e-7},), ("stiffness",)),
            Method("NGSolve", "ngsolve_tank:sweep", _LOOP.resolutions, ("stiffness",), "ngsolve"),
            Method("hydroelastic", "ours:tank", ({"tolerance": 1e-8},), ("base_s0",)),
            Method("NGSolve", "ngsolve_tank:tank", _NGSOLVE.resolutions[3:7], ("base_s0",), "ngsolve"),
        ),
        (1e-8,),
        base=_IMPORT,
        references={"stiffness": "sweeps", "base_s0": "tanks"},
    ),
    "tanks": Problem(
        "Speed against error",
        "speed_against_error",
        """The ten lowest frequencies of tanks with a beam. *Error* is the largest relative error of ω.

- **hydroelastic** is all of `he.solve` for an asked tolerance: frequencies, an error estimate for each, a count of
  modes by an independent factorization, the first elastic tone, the pressure-release tone, and what older theories say.
- **NGSolve**, **scikit-fem** solve once at a chosen degree and give frequencies; mesh and dry modes were tuned to these
  tanks by search. A tank that is its own mirror image is solved whole, or as two *halves* with a wall, or ψ = 0, in the
  middle.""",
        _TANKS,
        (
            Method("hydroelastic", "ours:tank", _each("tolerance", _POWERS[:7])),
            _NGSOLVE,
            Method("NGSolve", "ngsolve_tank:tank", _each("degree", range(4, 13), halves=True), _CENTRED, "ngsolve"),
            Method("scikit-fem", "scikit_fem_tank:tank", _each("degree", range(4, 11), halves=False), (), "scikit-fem"),
            Method(
                "scikit-fem", "scikit_fem_tank:tank", _each("degree", range(4, 11), halves=True), _CENTRED, "scikit-fem"
            ),
        ),
        (1e-4, 1e-6, 1e-8, 1e-9),
    ),
    "sweeps": Problem(
        "Sweeps",
        "sweeps",
        """The tank base_s0 at 40 positions of its beam, and for 100 flexural rigidities: its ten lowest frequencies at
every point. *Error* is the largest relative error at every eighth position, or every twentieth rigidity. Seconds are
those of the whole sweep.

- **hydroelastic** is `he.sweep` without following modes: at every point an error estimate for each frequency, a count
  of the modes, both tones. Points that differ in rigidity share the answer of the liquid.
- **NGSolve** is a loop over the script of the tanks, which gives frequencies alone.""",
        _SWEEPS,
        (Method("hydroelastic", "ours:sweep", _each("tolerance", _POWERS[1:5])), _LOOP),
        (1e-7, 1e-8),
    ),
    "circle": Problem(
        "A circle in open water: error against seconds",
        "open_circle",
        """Added mass and radiation damping of a half-immersed circle of radius 1 m in infinitely deep water, heave and
sway, at one frequency Ka = ω²a/g. *Error* is the larger one of |h − h_exact|/|h_exact|, h = a + ib/ω.

**This is not a comparison of like with like.** Capytaine is a three-dimensional code: it is asked here for the section
of a long cylinder, which is not what it is made for.

- **hydroelastic** gets a tolerance, and gives an error estimate and the excitation forces of waves from both sides.
- **Capytaine** gets a cylinder with end discs, a quarter of it mirrored twice: panels on a quarter of the circle, and a
  length in radii. *two*: (A(L) − A(L/2))/(L/2), which removes what belongs to the ends alone.""",
        {f"Ka = {ka:g}": {"omega": (ka * 9.81) ** 0.5} for ka in (0.25, 1.0, 2.5)},
        (
            Method("hydroelastic", "ours:circle", _each("tolerance", _POWERS[:6])),
            Method(
                "Capytaine",
                "capytaine_bodies:circle",
                tuple(
                    {"length": length, "panels": panels, **({"two": True} if two else {})}
                    for two in (False, True)
                    for length in (20.0, 40.0, 80.0)[two:]
                    for panels in (4, 8, 12)
                    if two or length * panels < 800.0
                ),
                peer="capytaine",
            ),
        ),
        (5e-2, 2e-2, 1e-2, 5e-3),
    ),
    "buoys": Problem(
        "Heaving buoys: error against seconds",
        "buoys",
        """Added mass and radiation damping in heave of solids of revolution of radius 1 m at one frequency Ka = ω²a/g:
a half-immersed sphere in infinitely deep water, and two upright cylinders of draught d over a bed at depth H. *Error*
is |h − h_exact|/|h_exact|, h = a + ib/ω.

- **hydroelastic** gets a tolerance, and gives an error estimate and the excitation forces of waves.
- **Capytaine** gets flat panels from axis to water line in a wedge that is turned about the axis, its symmetry of
  rotation, four times as many around; with and without a lid on the water inside.
- **OpenFLASH** matches eigenfunctions of the water under and beside a cylinder, as many in each.""",
        {
            "hemisphere, deep, Ka = 1.5": {"draught": None, "depth": inf, "omega": 3.8360135557633264},
            "cylinder d = a/2, H = 2a, Ka = 0.5": {"draught": 0.5, "depth": 2.0, "omega": 2.2147234590350102},
            "cylinder d = 0.9a, H = a, Ka = 1": {"draught": 0.9, "depth": 1.0, "omega": 3.132091952673165},
        },
        (
            Method("hydroelastic", "ours:buoy", _each("tolerance", _POWERS[:5])),
            Method("Capytaine", "capytaine_bodies:buoy", _each("panels", (8, 14, 20)), peer="capytaine"),
            Method("Capytaine, lid", "capytaine_bodies:buoy", _each("panels", (8, 14, 20), lid=True), peer="capytaine"),
            Method(
                *("OpenFLASH", "open_flash_buoy:buoy", _each("terms", (10, 40, 160, 320))),
                ("cylinder d = a/2, H = 2a, Ka = 0.5", "cylinder d = 0.9a, H = a, Ka = 1"),
                "open-flash",
            ),
        ),
        (1e-2, 3e-3, 5e-4, 1e-4, 1e-6),
    ),
    "string": Problem(
        "A hanging string: error against seconds",
        "hanging_string",
        """Displacements of a hanging string of 1 m in a resisting medium, λ/ρ = 0.5 1/s, whose upper end is moved, at 7
heights and 13 times up to three travel times. *Error* is the largest difference away from wave fronts, relative to the
largest displacement. Both methods get a tolerance and give an error for each value.""",
        {
            "smooth": {"motion": {"kind": "smooth", "amplitude": 1.0, "rate": 4.0}},
            "ramp": {"motion": {"kind": "ramp", "speed": 1.0}},
            "sine": {"motion": {"kind": "sine", "amplitude": 1.0, "omega": 8.0}},
            "step": {"motion": {"kind": "step", "amplitude": 1.0}},
        },
        (
            Method("field", "ours:string", _each("tolerance", (1e-2, 1e-3, 1e-4, 1e-5), method="field")),
            Method("series", "ours:string", _each("tolerance", _POWERS[1::2], method="series")),
        ),
        (1e-3, 1e-5, 1e-7, 1e-9),
        common=True,
    ),
    "thread": Problem(
        "Flexible threads: error against seconds",
        "threads",
        """Lines at rest, and a jumper whose top is moved by 10 m in 27 s. *Error*, at rest: the larger one of the
errors of the forces on both ends, over the larger force; in motion: the largest error of the top tension in the third
period, over the largest tension. All codes get the same weight, stiffness, drag and added mass, no bending stiffness.

- **hydroelastic** gets a tolerance, chooses meshes and steps, and gives error estimates, in motion by several runs.
- **MoorPy**: its function `catenary`, whose tolerance is a displacement in metres; in a uniform stream, catenaries in a
  row, each with its mean drag as a weight. It knows neither sheared streams nor, in this use, motion.
- **MoorDyn**: point masses in time; a line at rest by its two ways to initial conditions, in a stream followed until it
  is at rest.""",
        _LINES,
        (
            Method("hydroelastic", "ours:line", _each("tolerance", (1e-2, 1e-4, 1e-6, 1e-8)), tuple(_LINES)[:4]),
            Method("hydroelastic", "ours:moved", _each("tolerance", (1e-3, 1e-4)), ("jumper moved",)),
            Method("MoorPy", "moorpy_lines:line", _each("tolerance", (1e-2, 1e-6, 1e-10)), tuple(_LINES)[:2], "moorpy"),
            Method("MoorPy", "moorpy_lines:line", _each("catenaries", (1, 2, 4, 8, 16)), ("uniform stream",), "moorpy"),
            Method("MoorDyn", "moordyn_lines:line", _each("segments", (10, 20, 40)), tuple(_LINES)[:4], "moordyn"),
            Method("MoorDyn", "moordyn_lines:line", _each("segments", (80,)), tuple(_LINES)[2:4], "moordyn"),
            Method(
                *("MoorDyn", "moordyn_lines:line", _each("segments", (10, 20, 40), in_motion=True), tuple(_LINES)[:2]),
                "moordyn",
            ),
            Method("MoorDyn", "moordyn_lines:moved", _each("segments", (17, 34)), ("jumper moved",), "moordyn"),
        ),
        (1e-2, 1e-3, 2e-4),
        common=True,
    ),
    "basin": Problem(
        "Tanks in three dimensions: error against seconds",
        "basins",
        """The twelve lowest modes of a tank of 10 m × 8 m × 3 m with an elastic plate of 6 m × 4 m on the middle of its
surface, and the six lowest of a cube of water of 1 m, meshed in its volume. *Error* is the largest one of ω.

- **hydroelastic** gets a tolerance, and gives an error estimate and an independent count of the modes.
- **NGSolve, plan**: ψ on triangles of a quarter of the plan with hp-refinement at the plate's edge, the depth in poles.
- **NGSolve, volume**: tetrahedra of a quarter of the tank, small ones at the plate's edge.""",
        {
            "soft plate": _BASE
            | {"width": 8.0, "depth": 3.0, "plate": (6.0, 4.0), "rigidity": 50.0, "mass": 20.0, "modes": 12}
            | {"poisson_ratio": 0.3},
            "cube of water": _BASE | {"length": 1.0, "width": 1.0, "depth": 1.0, "plate": (0.0, 0.0), "modes": 6},
        },
        (
            Method("hydroelastic", "ours:volume", _each("tolerance", _POWERS[:3])),
            Method("NGSolve, plan", "ngsolve_volume:tank", _each("degree", (3, 4, 5)), ("soft plate",), "ngsolve"),
            Method(
                "NGSolve, volume",
                "ngsolve_volume:tank",
                tuple({"degree": degree, "size": size} for degree, size in ((2, 0.5), (3, 0.5), (3, 0.3))),
                *(("soft plate",), "ngsolve"),
            ),
            Method(
                "NGSolve, volume",
                "ngsolve_volume:tank",
                _each("degree", (2, 3, 4), cells=4),
                ("cube of water",),
                "ngsolve",
            ),
        ),
        (1e-3, 1e-4, 1e-5),
    ),
}
