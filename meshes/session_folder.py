"""The folder that Open MPI makes in the temporary folder for a process that starts alone, and leaves there.

Nothing is put into it, and it is needed only while MPI is initialized, which is when `mpi4py.MPI` is imported, wherever
that is, before the other libraries that would initialize it. That import is given a temporary folder of its own, which
is then removed. Open MPI would end the process by a segmentation fault where it cannot make its folder.
"""

import os
import sys
from importlib import import_module
from importlib.machinery import ExtensionFileLoader, ModuleSpec, PathFinder
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence
    from types import ModuleType

_MPI = "mpi4py.MPI"
_WITH_MPI = ("dolfinx.cpp", "petsc4py.PETSc", "slepc4py.SLEPc")


class _Loader(ExtensionFileLoader):
    def exec_module(self, module: "ModuleType") -> None:
        # Who imports the package need not import these.
        from pathlib import Path
        from tempfile import TemporaryDirectory

        from hydroelastic.meshes.interrupts import unfinished

        # Where Open MPI looks, in this order.
        name = next((name for name in ("TMPDIR", "TEMP", "TMP") if os.environ.get(name)), "TMPDIR")
        before = os.environ.get(name)
        place = before or "/tmp"
        try:
            folder = TemporaryDirectory(prefix="hydroelastic_", dir=place, ignore_cleanup_errors=True)
        except OSError as error:
            wrong = f"no temporary file can be made ({error.strerror}); set TMPDIR to a folder that can be written"
            raise OSError(error.errno, wrong, place) from None
        with unfinished(Path(folder.name)), folder:
            os.environ[name] = folder.name
            try:
                super().exec_module(module)
            finally:
                del os.environ[name]
                if before is not None:
                    os.environ[name] = before


class _Finder:
    def find_spec(
        self, fullname: str, path: "Sequence[str] | None", target: "ModuleType | None" = None
    ) -> ModuleSpec | None:
        if fullname in _WITH_MPI and _MPI not in sys.modules:
            import_module(_MPI)
        spec = PathFinder.find_spec(fullname, path, target) if fullname == _MPI else None
        if spec is not None and isinstance(spec.loader, ExtensionFileLoader):
            spec.loader = _Loader(spec.loader.name, spec.loader.path)
        return spec


def remove_session_folder() -> None:
    """Let an import of MPI that is still to come leave no folder."""
    if _MPI not in sys.modules and not any(isinstance(finder, _Finder) for finder in sys.meta_path):
        sys.meta_path.insert(0, _Finder())
