# shellcheck shell=bash
# Which environment is used: the active Python if it has dolfinx, else a private Debian root.

# Sets python_executable, python_version, dolfinx_version of the active Python; fails where it cannot be used,
# with the reason in python_reason. It looks at metadata only: importing dolfinx would cost a second at every start.
probe_active_python() {
    local python report
    python=$(type -P python3 || type -P python) || {
        python_reason="there is no Python on the path"
        return 1
    }
    report=$("$python" - 2>/dev/null <<'END'
import sys
from importlib.util import find_spec
missing = [name for name in ("dolfinx", "petsc4py", "slepc4py") if find_spec(name) is None]
if missing:
    sys.exit(print("lacks", *missing))
import importlib.metadata as metadata
try:
    dolfinx = metadata.version("fenics-dolfinx")
except metadata.PackageNotFoundError:
    sys.exit(print("lacks the metadata of fenics-dolfinx"))
if tuple(int(part) for part in dolfinx.split(".")[:2]) < (0, 9):
    sys.exit(print("has dolfinx", dolfinx))
print("usable", sys.executable, "%d.%d.%d" % sys.version_info[:3], dolfinx, sep="\n")
END
    ) || report="does not start"
    if [[ $report != usable$'\n'* ]]; then
        python_reason="$python $report"
        return 1
    fi
    { read -r _ && read -r python_executable && read -r python_version && read -r dolfinx_version; } <<<"$report"
}

# Sets way: inside (started by a program that ./hydro started), active or root.
choose_environment() {
    suite=${HYDROELASTIC_SUITE:-trixie}
    [[ $suite =~ ^[a-z]+$ ]] || fail "HYDROELASTIC_SUITE must be a Debian suite such as trixie or sid, not '$suite'"
    python_executable='' python_version='' dolfinx_version='' python_reason=''
    if [[ -d ${HYDROELASTIC_INSIDE:-} ]]; then
        way=inside
    elif [[ -n ${HYDROELASTIC_SUITE:-} ]]; then
        way=root python_reason="HYDROELASTIC_SUITE asks for a private root"
    elif probe_active_python; then
        way=active
    else
        way=root
    fi
    if [[ $way == root && ($OSTYPE != linux* || -z $(type -P apt-get)) ]]; then
        explain_ways "$python_reason, and a private root needs Linux with apt-get"
    fi
}
