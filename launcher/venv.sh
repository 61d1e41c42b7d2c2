# shellcheck shell=bash
# The packages from PyPI: a virtual environment above the private root or the active Python.

make_venv() {
    need_room 1500
    new_building
    local above="the private root" file
    if [[ $way == active ]]; then above="$python_executable with dolfinx $dolfinx_version"; fi
    timed "the Python packages above $above (1.1 GB, about a minute) in $venv" build_venv
    # Scripts name the folder in which they were installed; it is about to get its lasting name.
    for file in "$building"/bin/* "$building"/pyvenv.cfg; do
        if [[ -f $file && ! -L $file ]] && grep -qIF -- "$building" "$file"; then
            sed -i "s|$building|${venv//&/\\&}|g" "$file"
        fi
    done
    # Of each distribution a little, so that the list is read in milliseconds.
    list_contents -maxdepth 5 \( -path './bin/*' -o -name RECORD -o -name __init__.py \)
    publish "$venv"
}

# Runs within `timed`, in a subshell: what it exports ends with it.
build_venv() {
    local above=$python_executable python=$building/bin/python parent
    if [[ $way == root ]]; then
        above=python3
        set_variables_of_root "$building/bin"
    fi
    export PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_ROOT_USER_ACTION=ignore
    unset PIP_TARGET PIP_PREFIX PIP_USER
    cd -- "$checkout"
    # Isolated: packages of the system only, and nothing of the current directory.
    parent=$(inside "$above" -I -c "$parent_code")
    inside "$above" -m venv --system-site-packages "$building"
    if [[ -n $parent ]]; then
        printf '%s\n' "$parent" >"$("$python" -c 'import sysconfig; print(sysconfig.get_path("purelib"))')/parent.pth"
    fi
    if [[ $way == root ]]; then
        # The same files everywhere. What they need besides is of the root, and bound the lock when it was made.
        inside "$python" -m pip install --no-deps --require-hashes -r requirements/lock.txt
    else # to other versions of NumPy or of Python other versions of the rest may belong
        inside "$python" -m pip install -r requirements/run.txt -r requirements/dev.txt
    fi
    inside "$python" -c "$verify_code"
}

# A virtual environment of a virtual environment sees the packages of the system only; the .pth adds its parent.
parent_code='
import site, sys
if sys.prefix != sys.base_prefix:
    print(*site.getsitepackages(), sep="\n")
'

# Checks by import, once, what the probe believed by metadata.
verify_code='
import dolfinx, slepc4py.SLEPc, gmsh, meshio, pyvista, pydantic, click, rich, pytest, xdist, hypothesis
from petsc4py import PETSc
import numpy
version = tuple(int(part) for part in dolfinx.__version__.split(".")[:2])
assert version >= (0, 9), f"dolfinx {dolfinx.__version__} is older than 0.9"
assert PETSc.ScalarType is numpy.float64, f"PETSc computes with {PETSc.ScalarType.__name__}; the real build is needed"
'
