"""No module imports itself by way of others: the layers are checked by import-linter, cycles within one here."""

from graphlib import TopologicalSorter

import grimp

PACKAGES = ("physics", "meshes", "modal", "fem", "output", "scenes", "benchmarks")


def test_imports_have_no_cycle() -> None:
    graph = grimp.build_graph(*(f"hydroelastic.{name}" for name in PACKAGES), cache_dir=None)
    order = TopologicalSorter({module: graph.find_modules_directly_imported_by(module) for module in graph.modules})
    # Raises CycleError, which names the modules of a cycle. Imports for type checking count too.
    assert len(list(order.static_order())) == len(graph.modules) > 400
