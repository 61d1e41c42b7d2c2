"""Fixtures of more than one test file, and the order of the files."""

import csv
import gc
import os
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any

import pytest

RANKS = [int(os.environ.get(name, "1")) for name in ("OMPI_COMM_WORLD_SIZE", "PMI_SIZE")]
ON_RANKS = max(RANKS) > 1
SLOWEST = Path(__file__).with_name("slowest.csv")
FOLDER = str(Path(__file__).parent)


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Mark as slow what `slow_but` leaves out, and `slow_on_ranks_but` under ranks; order the files by `slowest.csv`.

    Without ranks `only_on_ranks` is left out.
    The files that take longest start first, so that the cores end at about the same time; before them those that the
    table does not know, which may be long.
    """
    if not ON_RANKS:
        config.hook.pytest_deselected(items=[item for item in items if item.get_closest_marker("only_on_ranks")])
        items[:] = [item for item in items if not item.get_closest_marker("only_on_ranks")]
    kept: dict[str, bool] = {}
    markers = ("slow_but", "slow_on_ranks_but") if ON_RANKS else ("slow_but",)
    for item in items:
        for marker in (marker for name in markers for marker in item.iter_markers(name)):
            case = item.callspec.id if isinstance(item, pytest.Function) and hasattr(item, "callspec") else ""
            fast = any(fnmatchcase(case, pattern) for pattern in marker.args)
            test = item.nodeid.partition("[")[0]
            kept[test] = kept.get(test, False) or fast
            if not fast:
                item.add_marker("slow")
    # Where whole files are collected, a case that was renamed shall not take its test out of the run unseen.
    lost = [test for test, fast in kept.items() if not fast]
    if lost and not ON_RANKS and not any("::" in argument for argument in config.args):
        raise pytest.UsageError(f"slow_but names no case of {', '.join(lost)}")
    column = "seconds" if "not slow" in config.option.markexpr else "seconds_of_all"
    with SLOWEST.open(encoding="utf-8", newline="") as file:
        seconds = {row["file"]: float(row[column]) for row in csv.DictReader(file)}
    items.sort(key=lambda item: -seconds.get(item.path.name, float("inf")))


def pytest_collection_finish() -> None:
    """Keep the garbage collector from visiting all tests and modules each time it runs."""
    gc.collect()
    gc.freeze()


@pytest.hookimpl(trylast=True)
def pytest_runtest_teardown(item: pytest.Item, nextitem: pytest.Item | None) -> None:
    """After the last test of a file forget what its functions keep: all solutions together take gigabytes."""
    if nextitem is None or nextitem.path != item.path:
        for value in vars(getattr(item, "module", None) or object).values():
            code = getattr(getattr(value, "__wrapped__", None), "__code__", None)
            if code is not None and code.co_filename.startswith(FOLDER) and hasattr(value, "cache_clear"):
                value.cache_clear()


@pytest.fixture(scope="module")
def tanks() -> Any:
    """The tanks of `tanks.py`, each solved once in a file; imported here because most tests need no dolfinx."""
    from tanks import Tanks

    return Tanks()
