# shellcheck shell=bash
# Making what is missing in the cache: a private Debian root, the packages from PyPI, this checkout as a package.
# One start at a time; a folder that is complete has a file `ready`, any other is removed and made anew.

building='' child='' # the unfinished folder and the process group at work, if any

prepare() {
    trap clean_up EXIT
    trap 'say "interrupted; removing what was unfinished"; exit 143' INT TERM HUP
    { mkdir -p -- "$cache" && : >>"$cache/lock"; } 2>/dev/null || fail "cannot write to the cache $cache; $remedy"
    exec 9>>"$cache/lock"
    if ! flock --nonblock 9; then
        say "another start is preparing $cache; waiting for it"
        flock 9
    fi
    log=$cache/prepare.log
    if [[ $way == root ]]; then build "$root" 4500 make_root; fi
    if [[ $way != inside ]]; then build "$venv" 1500 make_venv; fi
    build "$overlay" 1 make_overlay
    trap - INT TERM HUP EXIT
    exec 9>&-
}

# timed "what, how long" COMMAND ...: bash delays its traps until a command in the foreground ends, hence the background;
# monitor mode gives it a process group of its own, which a signal can end at any time.
timed() {
    local start=$SECONDS what=$1 outcome=0
    shift
    say "preparing $what ..."
    set -m
    "$@" </dev/null >"$log" 2>&1 &
    child=$!
    set +m
    wait "$child" || outcome=$?
    child=''
    if ((outcome)); then
        tail -n 15 -- "$log" >&2
        fail "this failed after $((SECONDS - start)) s; the whole log is $log"
    fi
    say "done in $((SECONDS - start)) s"
}

clean_up() {
    trap '' INT TERM HUP
    if [[ -n $child ]]; then
        kill -TERM -- "-$child" 2>/dev/null || true
        wait "$child" 2>/dev/null || true # mmdebstrap needs a moment to unmount
    fi
    # Never into another file system: while a root is being made, /dev and /proc may be mounted in it.
    if [[ -n $building ]]; then rm -rf --one-file-system -- "$building"; fi
}

# build FOLDER MEGABYTES COMMAND
build() {
    local free
    if [[ -e $1/ready ]]; then return; fi
    building=$1
    { rm -rf --one-file-system -- "$building"; mkdir -p -- "$building"; } || fail "cannot write to the cache $cache; $remedy"
    free=$(df -Pk -- "$cache" | awk 'NR == 2 { print int($4 / 1024) }')
    ((free >= $2)) || fail "the cache $cache has $free MB free and needs $2 MB; $remedy"
    "$3"
    touch -- "$building/ready"
    building=''
}

make_root() {
    local packages=()
    type -P mmdebstrap >/dev/null || packages+=(mmdebstrap)
    ((EUID == 0)) || type -P newuidmap >/dev/null || packages+=(uidmap)
    [[ -r /usr/share/keyrings/debian-archive-keyring.gpg ]] || packages+=(debian-archive-keyring)
    if ((${#packages[@]})); then # the only thing that is changed outside of the cache
        local install="apt-get update && apt-get install --yes --no-install-recommends ${packages[*]}"
        ((EUID == 0)) || fail "the private Debian root needs host packages; install them with: sudo sh -c '$install'
and start again (docs/install.md has other ways: conda, Docker)"
        timed "the host packages ${packages[*]}" env DEBIAN_FRONTEND=noninteractive sh -c "$install"
    fi
    timed "a private Debian root ($suite, 2.9 GB, about two minutes) in $root" run_mmdebstrap
    # What is bound inside must have a place, because the root is bound read-only.
    mkdir -p -- "$building"/etc/ssl "$building"/{tmp,proc,sys,dev,var/tmp}
    touch -- "$building"/etc/{resolv.conf,hosts,passwd,group,pip.conf}
}

# As root mmdebstrap writes the folder itself. An ordinary user gets an archive and unpacks it, because the files
# would otherwise belong to the user's subordinate ids, and the user could not remove them.
run_mmdebstrap() {
    local include options codename mirror=''
    include=$(read_list "$checkout/requirements/debian.txt" | paste -sd, -)
    options=(--variant=apt "--include=$include" --aptopt='APT::Install-Recommends "false"')
    options+=(--keyring=/usr/share/keyrings/debian-archive-keyring.gpg)
    # A suite such as sid is often seen through mirrors that lag behind the validity of its index.
    if [[ $suite != trixie ]]; then options+=(--aptopt='Acquire::Check-Valid-Until "false"'); fi
    # The mirror of a host that is Debian itself is the archive that has the updates of its release; else mmdebstrap's own.
    codename=$(sed -n 's/^VERSION_CODENAME=//p' /etc/os-release)
    # shellcheck disable=SC2016
    mirror=$(apt-get indextargets --format '$(SITE) $(RELEASE)' 'Origin: Debian' 2>/dev/null |
        awk -v name="$codename-updates" '$2 == name { print $1; exit }')
    if ((EUID == 0)); then
        mmdebstrap "${options[@]}" "$suite" "$building" ${mirror:+"$mirror"}
    else
        # /tmp may be held in memory, and the mapped user of mmdebstrap cannot enter a private home.
        TMPDIR=/var/tmp mmdebstrap "${options[@]}" --format=tar "$suite" - ${mirror:+"$mirror"} |
            tar --extract --no-same-owner --exclude='./dev/*' --directory="$building"
    fi
}

make_venv() {
    local above="the private root"
    if [[ $way == active ]]; then above="$python_executable ($python_versions)"; fi
    timed "the Python packages above $above (1.1 GB, about a minute) in $venv" build_venv
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
    # A virtual environment of a virtual environment sees the packages of the system only; a .pth adds its parent.
    parent=$(inside "$above" -I -c 'import site, sys; sys.prefix != sys.base_prefix and print(*site.getsitepackages(), sep="\n")')
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
    # By import, once, what the probe believed by metadata.
    inside "$python" -c '
import dolfinx, slepc4py.SLEPc, gmsh, meshio, pyvista, pydantic, click, rich, pytest, xdist, hypothesis, numpy
from petsc4py import PETSc
assert tuple(map(int, dolfinx.__version__.split(".")[:2])) >= (0, 9), f"dolfinx {dolfinx.__version__} is older than 0.9"
assert PETSc.ScalarType is numpy.float64, f"PETSc computes with {PETSc.ScalarType.__name__}; the real build is needed"'
}

# This checkout as an import package. Several checkouts share one virtual environment, so none is installed into it:
# a folder of links on PYTHONPATH gives `hydroelastic`, `hydroelastic.fem` and so on, and metadata beside it the version.
make_overlay() {
    local folder version metadata
    version=$(sed -n 's/^version = "\(.*\)"/\1/p' "$checkout/pyproject.toml" | head -n 1)
    metadata=$building/hydroelastic-$version.dist-info
    mkdir -- "$building/hydroelastic" "$building/bin" "$metadata"
    for folder in physics meshes fem modal output scenes benchmarks; do
        ln -s -- "$checkout/$folder" "$building/hydroelastic/$folder"
    done
    ln -s -- "$checkout"/api/{__init__.py,py.typed} "$building/hydroelastic"
    {
        printf 'Metadata-Version: 2.1\nName: hydroelastic\nVersion: %s\n' "$version"
        read_list "$checkout/requirements/run.txt" | sed 's/^/Requires-Dist: /'
        printf 'Provides-Extra: bench\n'
        read_list "$checkout/requirements/bench.txt" | sed 's/.*/Requires-Dist: &; extra == "bench"/'
    } >"$metadata/METADATA"
    printf '[console_scripts]\nhydroelastic = hydroelastic.scenes.__main__:start\n' >"$metadata/entry_points.txt"
    # shellcheck disable=SC2016
    printf '#!/bin/sh\nexec python -m hydroelastic.scenes "$@"\n' >"$building/bin/hydroelastic"
    chmod +x -- "$building/bin/hydroelastic"
}
