"""Parts of libraries are imported without the rest, which can be imported afterwards."""

import subprocess
import sys

import pytest

from hydroelastic.output.bare_package import bare_package


def _succeeds(program: str) -> None:
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False, timeout=60)
    assert ended.returncode == 0, ended.stderr


def test_a_module_comes_without_its_package_and_is_the_one_that_the_package_has_later() -> None:
    _succeeds(
        "import sys\n"
        "from hydroelastic.output.bare_package import bare_package\n"
        "with bare_package('scipy.io'):\n"
        "    from scipy.io._netcdf import netcdf_file\n"
        "assert not {'scipy.io', 'scipy.linalg', 'scipy.io.matlab'} & sys.modules.keys()\n"
        "import scipy.io\n"
        "assert scipy.io.netcdf_file is netcdf_file and scipy.io.loadmat\n"
    )


def test_a_class_that_is_imported_when_called_is_the_real_one() -> None:
    _succeeds(
        "import sys\n"
        "from hydroelastic.output.bare_package import imported_when_called\n"
        "with imported_when_called('rich.console', 'Console'):\n"
        "    from rich.console import Console\n"
        "assert 'rich.console' not in sys.modules\n"
        "made = Console(width=33)\n"
        "import rich.console\n"
        "assert isinstance(made, rich.console.Console) and made.width == 33\n"
    )


def test_a_package_that_is_missing_is_named() -> None:
    with pytest.raises(ModuleNotFoundError, match="no_such_package"), bare_package("no_such_package"):
        pass
