# shellcheck shell=bash
# The environment variables of the started program, and starting it.

# Before a command: the system sends it SIGTERM when its parent ends, even by SIGKILL.
ends_with_parent=()
if type -P setpriv >/dev/null; then ends_with_parent=(setpriv --pdeathsig TERM --); fi

set_variables() {
    local path=$venv/bin:$overlay/bin
    if [[ $way == root ]]; then
        set_variables_of_root "$path"
        set_open_mpi_of_root
        export PYTHONPATH=$overlay
    else
        export PATH=$path:$PATH
        export PYTHONPATH=$overlay${PYTHONPATH:+:$PYTHONPATH}
    fi
    export MYPYPATH=$overlay
    export HYDROELASTIC_CACHE=$cache HYDROELASTIC_INSIDE=$venv
    # dolfinx keeps compiled forms in $XDG_CACHE_HOME/fenics. Forms of two PETSc or Python builds must not mix.
    export XDG_CACHE_HOME=$forms
    # What else would appear in the checkout. As bytecode does not, it may be written: without any, each start compiles
    # all libraries anew, because with a prefix Python does not see the bytecode beside them.
    unset PYTHONDONTWRITEBYTECODE
    export PYTHONPYCACHEPREFIX=${PYTHONPYCACHEPREFIX:-$forms/pycache} HYPOTHESIS_STORAGE_DIRECTORY=$forms/hypothesis
    export RUFF_CACHE_DIR=$forms/ruff MYPY_CACHE_DIR=$forms/mypy
    export OMP_NUM_THREADS=${OMP_NUM_THREADS:-1}
    export OPENBLAS_NUM_THREADS=${OPENBLAS_NUM_THREADS:-$OMP_NUM_THREADS}
    export PYVISTA_OFF_SCREEN=${PYVISTA_OFF_SCREEN:-true}
    if ((EUID == 0)); then export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1; fi
}

# What a private root needs, whatever the host's shell has set. The first argument comes first in PATH.
set_variables_of_root() {
    export PATH=$1:/usr/local/bin:/usr/bin:/bin:/usr/sbin:/sbin
    export LC_ALL=C.UTF-8 SHELL=/bin/bash PYTHONNOUSERSITE=1
    unset LANGUAGE PYTHONHOME PYTHONSTARTUP PYTHONPATH VIRTUAL_ENV CONDA_PREFIX LD_LIBRARY_PATH LD_PRELOAD
    unset PETSC_DIR PETSC_ARCH SLEPC_DIR
}

# One machine only: without the TCP transport there is nothing to complain about in a sandbox. More ranks than cores
# are slow but right. Unbound, because two runs at a time would otherwise share the first cores.
set_open_mpi_of_root() {
    export OMPI_MCA_btl=${OMPI_MCA_btl:-self,sm}
    if [[ $suite == trixie ]]; then
        export PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe PRTE_MCA_hwloc_default_binding_policy=none
    else # the runtime of Open MPI renamed its variables, and complains of the old names
        export PRTE_MCA_mapby=:oversubscribe PRTE_MCA_bindto=none
    fi
    # Open MPI's shared table of processes wants fixed addresses, which proot does not give.
    if [[ $entry == proot ]]; then export PMIX_MCA_gds=${PMIX_MCA_gds:-hash}; fi
}

# Sets command: what starts a program in the environment.
command_inside() {
    if [[ $way == root ]]; then command_in_root "$@"; else command=("$@"); fi
}

# Runs a program in the environment. It ends with this script, however the script is ended.
inside() {
    local command
    command_inside "$@"
    "${ends_with_parent[@]}" "${command[@]}"
}

# The same in place of this script, so that signals arrive at the program.
exec_inside() {
    local command
    if [[ ${entry:-} == @(bwrap|proot) ]]; then # it has to stay beside the program, and is deaf to signals
        inside "$@"
        return
    fi
    command_inside "$@"
    exec -- "${command[@]}"
}
