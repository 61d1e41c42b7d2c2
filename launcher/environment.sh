# shellcheck shell=bash
# Which environment is used, where the cache has it, and how a program is started in it.

# Sets way: inside (started by a program that ./hydro started), active (the active Python has dolfinx) or root.
choose_environment() {
    suite=${HYDROELASTIC_SUITE:-trixie}
    [[ $suite =~ ^[a-z]+$ ]] || fail "HYDROELASTIC_SUITE must be a Debian suite such as trixie or sid, not '$suite'"
    python_executable='' python_reason="HYDROELASTIC_SUITE asks for a private root"
    way=root
    if [[ -d ${HYDROELASTIC_INSIDE:-} ]]; then
        way=inside
    elif [[ -z ${HYDROELASTIC_SUITE:-} ]] && probe_active_python; then
        way=active
    elif [[ $OSTYPE != linux* || -z $(type -P apt-get) ]]; then
        say "no usable environment: $python_reason, and a private root needs Linux with apt-get"
        fail "hydroelastic needs dolfinx 0.9 or newer with the real PETSc, petsc4py and slepc4py. One of these gives it:
  conda env create -f '$checkout/environment.yml' && conda activate hydroelastic
  docker build -t hydroelastic '$checkout' && docker run --rm -it hydroelastic
  sudo apt-get install $(read_list "$checkout/requirements/debian.txt" | paste -sd' ')
Then start ./hydro again. See docs/install.md."
    fi
}

# Sets python_executable and python_versions, or python_reason. It looks at metadata only: an import takes a second.
probe_active_python() {
    local python report
    python=$(type -P python3 || type -P python) || {
        python_reason="there is no Python on the path"
        return 1
    }
    report=$("$python" - 2>/dev/null <<'END'
import sys
from importlib import metadata, util
missing = [name for name in ("dolfinx", "petsc4py", "slepc4py") if util.find_spec(name) is None]
if missing:
    sys.exit(print("lacks", *missing))
dolfinx = metadata.version("fenics-dolfinx")
if tuple(int(part) for part in dolfinx.split(".")[:2]) < (0, 9):
    sys.exit(print("has dolfinx", dolfinx))
print("usable", sys.executable, sys.version.split()[0] + " " + dolfinx, sep="\n")
END
    ) || report="does not start"
    python_reason="$python $report"
    { read -r report && read -r python_executable && read -r python_versions; } <<<"$report" || return 1
}

# The lines of a list file that mean something: no comments, no blanks.
read_list() { sed -e 's/#.*//' -e 's/[[:space:]]//g' -e '/^$/d' "$1"; }

# Sets cache, root, venv, forms, overlay: each is named by what it is made from, so that checkouts share them, and a
# change of a requirement gives a new one.
name_folders() {
    remedy="set HYDROELASTIC_CACHE to a folder with 5 GB of room"
    if [[ -z ${HOME:-} ]]; then HOME=$(unset HOME && echo ~) && export HOME; fi # Open MPI does not start without HOME
    cache=${HYDROELASTIC_CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/hydroelastic}
    if [[ -z ${HYDROELASTIC_CACHE:-}${XDG_CACHE_HOME:-} && (! -d $HOME || $HOME -ef /) ]]; then
        fail "the cache would be in the home folder, and '$HOME' is none; set HOME, or $remedy"
    fi
    cache=$(readlink -m -- "$cache")
    # Lists of folders such as PATH are divided by colons; the others belong to the system.
    if [[ $cache =~ :|$'\n'|^/(bin|boot|dev|etc|lib[^/]*|run|sbin|usr|var|(proc|sys)(/.*)?)?$ ]]; then
        fail "the cache cannot be $cache; $remedy, and without a colon in its name"
    fi
    local file base
    for file in "$checkout"/requirements/{debian,run,dev,bench,lock}.txt "$checkout/pyproject.toml"; do
        [[ -r $file ]] || fail "the checkout lacks $file"
    done
    base=$suite-$(digest debian.txt)
    if [[ $way == active ]]; then base=python-$(sha256sum <<<"$python_executable $python_versions" | cut -c 1-12); fi
    root=$cache/roots/$base forms=$cache/forms/$base venv=$cache/venvs/$base-$(digest lock.txt)
    if [[ $way == active ]]; then venv=$cache/venvs/$base-$(digest run.txt dev.txt); fi
    if [[ $way == inside ]]; then venv=$HYDROELASTIC_INSIDE forms=${XDG_CACHE_HOME:-$cache/forms/inside}; fi
    overlay=$cache/checkouts/$(sha256sum <<<"$checkout" | cut -c 1-12)-$(digest run.txt bench.txt ../pyproject.toml)
}

digest() { (cd -- "$checkout/requirements" && for file; do read_list "$file"; done | sha256sum | cut -c 1-12); }

is_prepared() { [[ -e $overlay/ready && ($way == inside || -e $venv/ready) && ($way != root || -e $root/ready) ]]; }

# Before a command: the system sends it SIGTERM when its parent ends, even by SIGKILL.
ends_with_parent=()
if type -P setpriv >/dev/null; then ends_with_parent=(setpriv --pdeathsig TERM --); fi

set_variables() {
    if [[ $way == root ]]; then
        set_variables_of_root "$venv/bin:$overlay/bin"
        export PYTHONPATH=$overlay
    else
        export PATH=$venv/bin:$overlay/bin:$PATH
        export PYTHONPATH=$overlay${PYTHONPATH:+:$PYTHONPATH}
    fi
    [[ -L $venv/bin/python || -x $venv/bin/python ]] || fail "the environment $venv is damaged: remove it, and start again"
    # dolfinx keeps compiled forms in $XDG_CACHE_HOME/fenics. Forms of two PETSc or Python builds must not mix.
    export HYDROELASTIC_CACHE=$cache HYDROELASTIC_INSIDE=$venv XDG_CACHE_HOME=$forms MYPYPATH=$overlay
    # What else would appear in the checkout. Without any bytecode each start compiles all libraries anew.
    unset PYTHONDONTWRITEBYTECODE
    export PYTHONPYCACHEPREFIX=${PYTHONPYCACHEPREFIX:-$forms/pycache} HYPOTHESIS_STORAGE_DIRECTORY=$forms/hypothesis
    export RUFF_CACHE_DIR=$forms/ruff MYPY_CACHE_DIR=$forms/mypy PYVISTA_OFF_SCREEN=${PYVISTA_OFF_SCREEN:-true}
    export OMP_NUM_THREADS=${OMP_NUM_THREADS:-1}
    export OPENBLAS_NUM_THREADS=${OPENBLAS_NUM_THREADS:-$OMP_NUM_THREADS}
    if ((EUID == 0)); then export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1; fi
}

# What a private root needs, whatever the host's shell has set. The first argument comes first in PATH.
set_variables_of_root() {
    find_entry
    export PATH=$1:/usr/local/bin:/usr/bin:/bin:/usr/sbin:/sbin LC_ALL=C.UTF-8 SHELL=/bin/bash PYTHONNOUSERSITE=1
    unset LANGUAGE PYTHONHOME PYTHONSTARTUP PYTHONPATH VIRTUAL_ENV CONDA_PREFIX LD_LIBRARY_PATH LD_PRELOAD
    unset PETSC_DIR PETSC_ARCH SLEPC_DIR
    # One machine only: no TCP. More ranks than cores are slow but right. Unbound, because two runs at a time would
    # share the first cores. The runtime of Open MPI renamed its variables, and complains of the old names.
    export OMPI_MCA_btl=${OMPI_MCA_btl:-self,sm}
    local names=(mapby bindto)
    if [[ $suite == trixie ]]; then names=(rmaps_default_mapping_policy hwloc_default_binding_policy); fi
    export "PRTE_MCA_${names[0]}=:oversubscribe" "PRTE_MCA_${names[1]}=none"
}

# Runs a program in the environment; it ends with this script, however the script is ended.
inside() {
    local command=("$@")
    if [[ $way == root ]]; then command_in_root "$@"; fi
    "${ends_with_parent[@]}" "${command[@]}"
}

# The same in place of this script, so that signals arrive at the program; bwrap stays beside it, and is deaf to signals.
exec_inside() {
    local command=("$@")
    if [[ ${entry:-} == bwrap ]]; then inside "$@" && exit || exit; fi
    if [[ $way == root ]]; then command_in_root "$@"; fi
    exec -- "${command[@]}"
}

# Sets entry: unshare, or bwrap where the system leaves namespaces to few programs; entry_program, its path on the
# host; namespaces, the options of unshare.
find_entry() {
    local kind
    if [[ -n ${entry:-} ]]; then return; fi
    for kind in --mount "--user --map-root-user --mount"; do
        read -ra namespaces <<<"$kind"
        entry=unshare entry_program=$(type -P unshare)
        if unshare "${namespaces[@]}" mount --rbind / / 2>/dev/null; then return; fi
    done
    entry=bwrap
    if entry_program=$(type -P bwrap) && bwrap --ro-bind / / true 2>/dev/null; then return; fi
    fail "this system refuses namespaces: install bubblewrap, which may have them, or use conda or Docker"
}

# Sets command: the program in the private root, in the current folder. Of the host all folders but the system's are seen
# (home, tmp, srv, data, ...), checkout, home and cache wherever they are, and read-only what certificates and names need.
command_in_root() {
    local path folder=$PWD binds=(/dev /proc /sys /var/tmp) binds_read_only=()
    local system='^/(bin|boot|dev|etc|lib|lib32|lib64|libx32|proc|run|sbin|sys|usr|var|lost\+found)(/|$)'
    for path in /* "$PWD"; do
        if [[ $path == /?* && -d $path && ! $path =~ $system ]]; then binds+=("$path"); fi
    done
    for path in "$checkout" "$HOME" "$cache" "${TMPDIR:-}"; do
        if [[ $path == /?* && -d $path ]]; then binds+=("$path"); fi
    done
    for path in /etc/{ssl,resolv.conf,hosts,passwd,group,pip.conf} "${SSL_CERT_FILE:-}" "${SSL_CERT_DIR:-}" \
        "${PIP_CERT:-}" "${REQUESTS_CA_BUNDLE:-}" "${CURL_CA_BUNDLE:-}" "${PIP_CONFIG_FILE:-}"; do
        if [[ -r $path && $path != /etc/ssl/* && $path =~ $system ]]; then binds_read_only+=("$path"); fi
    done
    if [[ $PWD =~ $system && ! -d $root$PWD && "$PWD/" != "$checkout"/* && "$PWD/" != "$HOME"/* ]]; then
        say "the folder $PWD is not seen inside the private root; starting in /"
        folder=/
    fi
    for path in "${binds[@]}" "${binds_read_only[@]}"; do # a mount point is all that is ever written into the root
        if [[ ! -e $root$path ]]; then
            { if [[ -d $path ]]; then mkdir -p -- "$root$path"; else install -D /dev/null "$root$path"; fi; } 2>/dev/null ||
                fail "$path cannot be shown inside the private root $root, which is read-only"
        fi
    done
    if [[ $entry == unshare ]]; then # the mounts live in a namespace of the program and end with it
        command=("$entry_program" "${namespaces[@]}" --propagation private "$BASH" "$checkout/launcher/in_root.sh")
        command+=("$root" "$folder" "$EUID" "$(id -g)" "${binds[@]}" -- "${binds_read_only[@]}" -- "$@")
    else
        command=(setpriv --pdeathsig KILL -- "$entry_program" --ro-bind "$root" /)
        for path in "${binds[@]}"; do command+=(--dev-bind "$path" "$path"); done
        for path in "${binds_read_only[@]}"; do command+=(--ro-bind "$path" "$path"); done
        command+=(--chdir "$folder" -- "${ends_with_parent[@]}" "$@")
    fi
}
