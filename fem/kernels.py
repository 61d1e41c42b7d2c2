"""Kernels of forms and expressions, which dolfinx compiles for the vector instructions of this processor."""

from __future__ import annotations

import platform
from functools import cache
from pathlib import Path
from typing import Any
from zlib import crc32

import ufl
from dolfinx import fem
from dolfinx.fem import petsc as fem_petsc
from numpy.typing import ArrayLike
from petsc4py import PETSc
from ufl.domain import extract_unique_domain

from hydroelastic.fem.kernel_cache import cache_folder, kernels_locked

_PROCESSOR = Path("/proc/cpuinfo")
# Time for which a process waits for another one that compiles the same kernel without locks, s; dolfinx: 10.
_PATIENCE = 300


def compiled_form(form: ufl.Form) -> fem.Form:
    """Return a form with its kernels (collective)."""
    with kernels_locked(form.ufl_domain().ufl_cargo().comm):
        return fem.form(form, jit_options=jit_options())


def compiled_expression(expression: ufl.core.expr.Expr, points: ArrayLike) -> fem.Expression:
    """Return an expression with the kernel that evaluates it (collective)."""
    with kernels_locked(extract_unique_domain(expression).ufl_cargo().comm):
        return fem.Expression(expression, points, jit_options=jit_options())


def assembled(form: fem.Form) -> PETSc.Mat:
    """Assemble the matrix of a form (collective)."""
    matrix = fem_petsc.assemble_matrix(form)
    matrix.assemble()
    return matrix


@cache
def jit_options() -> dict[str, Any]:
    """Options of the compilation.

    Measured at degree 9: a Laplace matrix is assembled in 40 % of the time that plain -O2 takes. A name for the
    instructions enters the arguments, and so the key of dolfinx's cache, for a cache may be shared by machines of
    different processors.
    """
    arguments = ["-g0", "-O3"]
    instructions = _instructions()
    if instructions is not None:
        arguments += ["-march=native", f"-DINSTRUCTIONS_{crc32(instructions.encode()):08x}"]
    return {"cache_dir": cache_folder(), "cffi_extra_compile_args": arguments, "timeout": _PATIENCE}


def _instructions() -> str | None:
    """The processor's instruction sets as Linux lists them; ``None`` where unknown."""
    if platform.machine() not in ("x86_64", "aarch64") or not _PROCESSOR.is_file():
        return None
    for line in _PROCESSOR.read_text(encoding="utf-8").splitlines():
        key, _, value = line.partition(":")
        if key.strip() in ("flags", "Features"):
            return value
    return None
