"""A process that solves cases of one code for the parent, one line of JSON for each.

    python -m hydroelastic.benchmarks.worker CODE [FOLDER OF PACKAGES]

It imports that code alone. Seconds are taken here, around the solution: neither imports nor what a code prepares are in
them, nor the first solution of a case, which fills the caches of compiled forms.
"""

from __future__ import annotations

import gc
import importlib
import json
import os
import signal
import sys
import time
from dataclasses import asdict
from types import ModuleType
from typing import IO, Any

from hydroelastic.benchmarks.cases import Case
from hydroelastic.benchmarks.machine import linear_algebra

MODULES = {
    "hydroelastic": "tank.hydroelastic",
    "hydroelastic modes": "tank.modes_alone",
    "ngsolve": "tank.ngsolve",
    "scikit-fem": "tank.scikit_fem",
    "lower bound": "tank.lower_bound",
    "sweep": "sweep.hydroelastic",
    "ngsolve loop": "sweep.ngsolve",
    "hydroelastic radiation": "circle.hydroelastic",
    "capytaine": "circle.capytaine",
    "string field": "string.hydroelastic",
    "string series": "string.hydroelastic",
    "string sum": "string.hydroelastic",
    "thread field": "thread.hydroelastic",
    "thread catenary": "thread.hydroelastic",
    "moorpy": "thread.moorpy",
    "moordyn": "thread.moordyn",
    "basin field": "basin.hydroelastic",
    "ngsolve plan": "basin.ngsolve",
    "ngsolve volume": "basin.ngsolve",
    "hydroelastic buoy": "buoy.hydroelastic",
    "capytaine buoy": "buoy.capytaine",
    "open-flash": "buoy.open_flash",
}


def main(arguments: list[str]) -> None:
    """Answer until the parent closes the input."""
    # Ctrl-C reaches the whole group of processes; the parent ends this one.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    answers = _own_output()
    # Behind everything that the environment has: NumPy and SciPy stay its own.
    sys.path.extend(arguments[1:])
    try:
        module = importlib.import_module(f"hydroelastic.benchmarks.{MODULES[arguments[0]]}")
    except (ImportError, OSError, RuntimeError) as error:
        _send(answers, {"problem": f"{type(error).__name__}: {error}"})
        return
    _send(answers, {"versions": module.versions() | _libraries()})
    prepared: dict[Case, Any] = {}
    for line in sys.stdin:
        case = Case(**json.loads(line))
        try:
            _send(answers, _solved(module, case, prepared))
        except Exception as error:  # whatever a code raises is its result
            _send(answers, {"problem": f"{type(error).__name__}: {error}"})


def _solved(module: ModuleType, case: Case, prepared: dict[Case, Any]) -> dict[str, Any]:
    if case not in prepared:
        # Many codes prepare nothing: all that they do is in the seconds.
        prepared[case] = module.prepare(case) if hasattr(module, "prepare") else case
    gc.collect()
    # Processor time: other work of the machine does not enter it. All codes have one thread.
    clock = getattr(module, "CLOCK", time.process_time)
    start = clock()
    answer = module.solve(prepared[case])
    seconds = clock() - start
    return {"seconds": seconds, "answer": asdict(answer)}


def _own_output() -> IO[str]:
    """The output for answers alone: what libraries print goes to the error output instead."""
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)
    return answers


def _libraries() -> dict[str, str]:
    """Versions of NumPy and SciPy, and the dense linear algebra beneath all that was imported."""
    import numpy
    import scipy

    return {"NumPy": numpy.__version__, "SciPy": scipy.__version__, "BLAS": linear_algebra()}


def _send(answers: IO[str], message: dict[str, Any]) -> None:
    print(json.dumps(message), file=answers, flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
