"""Commands as pages show them: run as `./hydro` would run them, or read without running them."""

import re
import shlex
import shutil
import subprocess
import sys

import click
from command import main, run_command
from markdown_blocks import ROOT

_STARTS_OF_LAUNCHER = ("test", "lint", "docs", "python", "mpirun", "exec", "shell", "env", "help")
_EXIT_CODE = re.compile(r"#\s*exit code (\d)")


def commands_of(text: str) -> list[str]:
    """The commands of a block of a shell, one a line, with their comments."""
    return [line for line in text.splitlines() if line.strip() and not line.lstrip().startswith("#")]


def plain(command: str) -> str:
    """A command without its comment."""
    return shlex.join(shlex.split(command, comments=True))


def run_shown(command: str) -> str:
    """Run a command of the launcher in the current folder, in this environment; or copy a file.

    Returns:
        What it prints.

    Raises:
        AssertionError: if its exit code is not 0, or that which its comment tells.
    """
    start, word, *arguments = shlex.split(command, comments=True)
    if start == "cp":
        shutil.copy(word, *arguments)
        return ""
    assert start == "./hydro", f"{command}: neither ./hydro nor cp"
    if word == "python":
        done = subprocess.run([sys.executable, *arguments], capture_output=True, text=True, check=False)
        code, printed = done.returncode, done.stdout + done.stderr
    else:
        assert word in main.commands, f"{command}: no such command"
        result = run_command(word, *arguments)
        if result.exception is not None and not isinstance(result.exception, SystemExit):
            raise result.exception
        code, printed = result.exit_code, result.output
    told = _EXIT_CODE.search(command)
    assert code == int(told.group(1) if told else 0), f"{command}: exit code {code}\n{printed}"
    return printed


def read_command(command: str) -> None:
    """See that a command exists and takes the arguments given, if there are any, without running it.

    Raises:
        AssertionError: if not.
    """
    words = shlex.split(command, comments=True)
    while words and "=" in words[0]:
        words.pop(0)
    start, word, *arguments = words
    assert start == "./hydro", f"{command}: not a command of the project"
    if word in main.commands:
        if not arguments:
            return
        try:
            main.commands[word].make_context(word, arguments)
        except click.UsageError as error:
            raise AssertionError(f"{command}: {error.format_message()}") from error
        return
    assert word in _STARTS_OF_LAUNCHER, f"{command}: no such command"
    for name in arguments:
        if "/" in name and not name.startswith("-"):
            assert (ROOT / name).exists(), f"{command}: there is no {name}"
