"""Write requirements/lock.txt anew: the newest versions that run.txt and dev.txt allow, with the hashes of their files.

Started as ``HYDROELASTIC_SUITE=trixie ./hydro python requirements/lock.py``. What Debian brings is left out, and bounds
the others: of NumPy, SciPy and h5py the private root has the versions, not pip. The lock is for Linux, and for the
Python of that root and newer ones.
"""

import re
import subprocess
import sys
import tempfile
import venv
from importlib.metadata import distributions
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
HEADER = """\
# Written by requirements/lock.py from run.txt and dev.txt, for the private Debian roots of ./hydro; not to be edited.
"""


def requirements(name: str) -> list[str]:
    """The lines of a requirement file, without comments and blanks."""
    lines = (line.split("#")[0].strip() for line in (FOLDER / name).read_text().splitlines())
    return [line for line in lines if line]


def project(requirement: str) -> str:
    """The normalized name of a project, from a requirement or a name."""
    return re.sub(r"[-_.]+", "-", re.split(r"[^\w.-]", requirement)[0]).lower()


def versions_of_debian() -> dict[str, str]:
    """What is installed below this virtual environment, by normalized names."""
    folders = [folder for folder in sys.path if not Path(folder).is_relative_to(sys.prefix)]
    return {project(found.name): found.version.strip() for found in distributions(path=folders)}


def main() -> None:
    """Let uv resolve the requirements, and write what it found."""
    debian = versions_of_debian()
    if "fenics-dolfinx" not in debian:
        sys.exit(
            "hydro: the lock is made in a private root: HYDROELASTIC_SUITE=trixie ./hydro python requirements/lock.py"
        )
    wanted = requirements("run.txt") + requirements("dev.txt")
    brought = sorted(project(line) for line in wanted if project(line) in debian)
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        texts = {
            "wanted.txt": [line for line in wanted if project(line) not in debian],
            "debian.txt": [f"{name}=={debian[name]}" for name in brought],
            "pyproject.toml": ["[tool.uv]", """environments = ["sys_platform == 'linux'"]"""],
        }
        for file, lines in texts.items():
            (folder / file).write_text("\n".join(lines) + "\n")
        venv.create(folder / "uv", with_pip=True)
        subprocess.run([folder / "uv/bin/python", "-m", "pip", "install", "--quiet", "uv"], check=True)
        uv = folder / "uv/bin/uv"
        resolve = [uv, "pip", "compile", "--quiet", "--universal", "--generate-hashes", "--no-header", "--no-annotate"]
        resolve += ["--python-version", f"{sys.version_info.major}.{sys.version_info.minor}"]
        resolve += ["--constraint", "debian.txt", "wanted.txt"]
        for name in brought:
            resolve += ["--no-emit-package", name]
        lock = subprocess.run(resolve, cwd=folder, check=True, stdout=subprocess.PIPE, text=True).stdout
    (FOLDER / "lock.txt").write_text(HEADER + lock)


if __name__ == "__main__":
    main()
