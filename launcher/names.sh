# shellcheck shell=bash
# Where the cache is and what its folders are called. Each is named by what it is made from, so a change of a
# requirement file gives a new name, and old and new checkouts share one cache. Runs at every start: milliseconds.

# The lines of a list file that mean something: no comments, no blanks.
read_list() { sed -e 's/#.*//' -e 's/[[:space:]]//g' -e '/^$/d' "$1"; }

# Sets cache, and remedy for messages about it; refuses one that cannot work before anything is written.
choose_cache() {
    remedy="set HYDROELASTIC_CACHE to a folder with 5 GB of room"
    # Without HOME, ~ is the home folder in the list of users. Open MPI does not start without HOME either.
    if [[ -z ${HOME:-} ]]; then HOME=$(unset HOME && echo ~) && export HOME; fi
    if [[ -n ${HYDROELASTIC_CACHE:-} ]]; then
        cache=$HYDROELASTIC_CACHE
    elif [[ -n ${XDG_CACHE_HOME:-} ]]; then
        cache=$XDG_CACHE_HOME/hydroelastic
    else
        if [[ ! -d $HOME || $HOME -ef / ]]; then
            fail "the cache would be in the home folder, and '$HOME' is none; set HOME, or $remedy"
        fi
        cache=$HOME/.cache/hydroelastic
    fi
    [[ $cache == /* ]] || cache=$PWD/$cache
    cache=$(readlink -m -- "$cache")
    # Lists of folders such as PATH are divided by colons; the others belong to the system.
    if [[ $cache =~ :|$'\n'|^/(bin|boot|dev|etc|lib[^/]*|run|sbin|usr|var|(proc|sys)(/.*)?)?$ ]]; then
        fail "the cache cannot be $cache; $remedy, and without a colon in its name"
    fi
}

# Sets cache, and the folders in it: root, venv, forms, overlay.
name_folders() {
    choose_cache
    local file base packages debian run development peers place_and_project
    for file in "$checkout"/requirements/{debian,run,dev,bench,lock}.txt "$checkout/pyproject.toml"; do
        [[ -r $file ]] || fail "the checkout lacks $file"
    done
    debian=$(read_list "$checkout/requirements/debian.txt" | sha256sum)
    run=$(read_list "$checkout/requirements/run.txt" | sha256sum)
    development=$(read_list "$checkout/requirements/dev.txt" | sha256sum)
    peers=$(read_list "$checkout/requirements/bench.txt" | sha256sum)
    place_and_project=$(sha256sum - "$checkout/pyproject.toml" <<<"$checkout")
    local place=${place_and_project%%$'\n'*} project=${place_and_project##*$'\n'}
    project=${project#\\} # sha256sum's mark of a file name with unusual characters

    base=$suite-${debian:0:12}
    packages=$(sha256sum <"$checkout/requirements/lock.txt")
    if [[ $way == active ]]; then
        local python
        python=$(sha256sum <<<"$python_executable $python_version $dolfinx_version")
        base=python$python_version-${python:0:12}
        packages=${run:0:8}${development:0:8}
    fi
    root=$cache/roots/$base
    venv=$cache/venvs/$base-${packages:0:16}
    forms=$cache/forms/$base
    if [[ $way == inside ]]; then
        venv=$HYDROELASTIC_INSIDE forms=${XDG_CACHE_HOME:-$cache/forms/inside}
    fi
    overlay=$cache/checkouts/${place:0:12}-${project:0:8}${run:0:8}${peers:0:4}
}

is_prepared() {
    if [[ $way == root ]]; then is_whole_root || return; fi
    if [[ $way != inside ]]; then is_whole "$venv" || return; fi
    is_whole "$overlay"
}

# Whether a folder of the cache has all that its list of contents names. Caches are also emptied by tidying programs.
is_whole() {
    local path
    [[ -s $1/contents ]] || return
    while IFS= read -r path; do
        # A link may lead to where only the inside of a root can follow.
        [[ -s $1/$path || -L $1/$path ]] || return
    done <"$1/contents"
}

# The same of a root, by some of each part of it.
is_whole_root() {
    local path
    for path in "$root"/{etc/hosts,dev,proc,sys,var/tmp,var/lib/dpkg/status,usr/include,usr/share,usr/lib/petscdir} \
        "$root"/usr/{bin/{env,gcc,mpirun,python3},lib/*/libc.so.6,lib/python3/dist-packages/{h5py,numpy,scipy}}; do
        [[ -e $path || -L $path ]] || return
    done
}
