"""The workflow of the hosted checks runs on both suites and names only what the checkout has."""

import os
import re
from pathlib import Path

import pytest
import yaml

CHECKOUT = Path(__file__).resolve().parent.parent
WORKFLOW = CHECKOUT / ".github" / "workflows" / "checks.yml"
# What a runner, or the image that a job names, has.
OF_THE_SYSTEM = {"apt-get", "docker", "$CONDA/bin/conda"}


@pytest.fixture(scope="module")
def jobs():
    return yaml.safe_load(WORKFLOW.read_text())["jobs"]


def test_all_checks_run_on_both_suites(jobs):
    job = jobs["suite"]
    assert set(job["strategy"]["matrix"]["suite"]) == {"trixie", "sid"}
    assert job["env"]["HYDROELASTIC_SUITE"] == "${{ matrix.suite }}"
    assert {"run": ".ci/run"} in job["steps"]


def test_image_and_conda_environment_are_built(jobs):
    commands = [step.get("run", "") for job in jobs.values() for step in job["steps"]]
    assert any(command.startswith("docker build") for command in commands)
    assert any("conda env create --file environment.yml" in command for command in commands)


def test_commands_and_files_exist(jobs):
    for job in jobs.values():
        for step in job["steps"]:
            if "uses" in step:
                assert re.fullmatch(r"actions/[a-z-]+@v\d+", step["uses"])
                continue
            for command in step["run"].split(" && "):
                program, *arguments = command.split()
                files = [word for word in arguments if word.startswith(("./", ".ci/")) or word.endswith(".yml")]
                if program not in OF_THE_SYSTEM:
                    files.append(program)
                    assert os.access(CHECKOUT / program, os.X_OK), command
                assert all((CHECKOUT / file).exists() for file in files), command
                scenes = re.findall(r"hydro run (\w+)", command)
                assert all((CHECKOUT / "scenes" / f"{scene}.toml").exists() for scene in scenes), command


def test_nothing_belongs_to_one_machine():
    text = WORKFLOW.read_text()
    assert not re.search(r"https?://|self-hosted|secrets\.|/(home|root|work|srv)/", text)
