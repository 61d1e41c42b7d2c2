"""Whether this computer can render surfaces in space without a screen, which VTK does."""

from __future__ import annotations

import ctypes

_MESA_LIBRARIES = ("libOSMesa.so", "libOSMesa.so.8", "libOSMesa.so.6", "osmesa.dll", "libOSMesa.dll")


class NoRendererError(RuntimeError):
    """Neither an X server nor EGL nor OSMesa can render on this computer."""


def require_renderer() -> None:
    """Refuse before VTK renders without a library, which would end the process."""
    # The first one provides the classes that render.
    import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
    from vtkmodules.vtkCommonCore import vtkLogger
    from vtkmodules.vtkRenderingCore import vtkRenderWindow

    # VTK tries X, EGL and OSMesa in turn and reports each that is absent.
    verbosity = vtkLogger.GetCurrentVerbosityCutoff()
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_ERROR)
    try:
        _require_renderer(vtkRenderWindow().GetClassName())
    finally:
        vtkLogger.SetStderrVerbosity(verbosity)


def _require_renderer(window: str) -> None:
    if window != "vtkOSOpenGLRenderWindow":
        return
    for name in _MESA_LIBRARIES:
        try:
            ctypes.CDLL(name)
        except OSError:
            continue
        return
    raise NoRendererError(
        "pictures need a library that renders without a screen: install EGL (libegl1 on Debian and Ubuntu) "
        "or OSMesa (libosmesa6)"
    )
