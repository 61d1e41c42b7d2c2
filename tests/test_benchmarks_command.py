"""`hydroelastic bench` hands over to a process of its own, and `python -m hydroelastic.benchmarks` refuses in words."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from hydroelastic.scenes import command_line


class Child:
    """Stands for the other process."""

    def __init__(self, code: int | type[BaseException]) -> None:
        self.code, self.command, self.terminated = code, [], False

    def __call__(self, command: list[str]) -> Child:
        self.command = command
        return self

    def wait(self, timeout: float | None = None) -> int:
        if isinstance(self.code, int):
            return self.code
        if timeout is not None:
            raise subprocess.TimeoutExpired("bench", timeout)
        raise self.code

    def terminate(self) -> None:
        self.terminated = True


def bench(monkeypatch: pytest.MonkeyPatch, child: Child, *arguments: str) -> Any:
    monkeypatch.setattr(command_line.subprocess, "Popen", child)
    return CliRunner().invoke(command_line.main, ["bench", *arguments])


@pytest.mark.parametrize(
    ("given", "handed_over"),
    [
        ([], []),
        (["--quick", "--repeats", "2"], ["--quick", "--repeats", "2"]),
        (["--problem", "circle"], ["--problem", "circle"]),
        (["--no-install", "--out", "my folder"], ["--no-install", "--out", "my folder"]),
    ],
)
def test_arguments_are_handed_over(monkeypatch: pytest.MonkeyPatch, given: list[str], handed_over: list[str]) -> None:
    child = Child(0)
    assert bench(monkeypatch, child, *given).exit_code == 0
    assert child.command == [sys.executable, "-m", "hydroelastic.benchmarks", *handed_over]


@pytest.mark.parametrize(("code", "expected"), [(0, 0), (2, 2), (3, 3), (130, 130), (-15, 143)])
def test_the_exit_code_is_that_of_the_process(monkeypatch: pytest.MonkeyPatch, code: int, expected: int) -> None:
    assert bench(monkeypatch, Child(code)).exit_code == expected


def test_an_interrupt_ends_both(monkeypatch: pytest.MonkeyPatch) -> None:
    child = Child(KeyboardInterrupt)
    assert bench(monkeypatch, child).exit_code == 130
    assert child.terminated


@pytest.mark.parametrize(
    "arguments", [["--repeats", "0"], ["--repeats", "many"], ["--fast"], ["aquarium"], ["--problem", "sea"]]
)
def test_bad_arguments_are_refused_at_once(monkeypatch: pytest.MonkeyPatch, arguments: list[str]) -> None:
    child = Child(0)
    result = bench(monkeypatch, child, *arguments)
    assert result.exit_code == 2
    assert "Error" in result.stderr
    assert child.command == []


def process(*arguments: str, folder: Path) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "hydroelastic.benchmarks", *arguments]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, encoding="utf-8", timeout=60)


@pytest.mark.slow
def test_a_folder_that_cannot_be_written_is_one_line(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("", encoding="utf-8")
    ended = process("--out", "file", folder=tmp_path)
    assert (ended.returncode, ended.stdout) == (2, "")
    assert len(ended.stderr.strip().splitlines()) == 1
    assert "file" in ended.stderr
    assert "--out" in ended.stderr


@pytest.mark.slow
def test_both_commands_have_the_same_options(tmp_path: Path) -> None:
    inner = process("--help", folder=tmp_path).stdout
    outer = CliRunner().invoke(command_line.main, ["bench", "--help"]).stdout
    options = [word for word in outer.split() if word.startswith("--")]
    assert {"--out", "--problem", "--quick", "--repeats", "--no-install"} <= set(options)
    assert all(option in inner for option in options)
    assert "Example:" in inner
    assert "Example:" in outer
