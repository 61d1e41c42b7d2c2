"""The command line: in this process by click's runner, or in a process of its own."""

import os
import subprocess
import sys
from typing import Any

from click.testing import CliRunner, Result

from hydroelastic.scenes.command_line import main


def run_command(*arguments: str, **settings: Any) -> Result:
    """Exit code, `stdout`, `stderr` and both as `output`; settings are those of click's runner (`input`, `env`)."""
    return CliRunner().invoke(main, list(arguments), **settings)


def run_process(*arguments: str, timeout: float = 120.0, **environment: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "hydroelastic.scenes", *arguments]
    told = {"capture_output": True, "encoding": "utf-8", "env": os.environ | environment}
    return subprocess.run(command, check=False, timeout=timeout, **told)  # type: ignore[call-overload,no-any-return]


def assert_refused(result: Result, *words: str) -> None:
    """One message of one or two lines that holds these words, and exit code 2."""
    assert result.exit_code == 2, result.output
    assert result.stdout == ""
    lines = result.stderr.strip().splitlines()
    assert 1 <= len(lines) <= 2, result.stderr
    assert lines[0].startswith("Error: ")
    for word in words:
        assert word in result.stderr
