# shellcheck shell=bash
# Where the cache is and what its folders are called. Each is named by what it is made from, so a change of a
# requirement file gives a new name, and old and new checkouts share one cache. Runs at every start: milliseconds.

# The lines of a list file that mean something: no comments, no blanks.
read_list() { sed -e 's/#.*//' -e 's/[[:space:]]//g' -e '/^$/d' "$1"; }

# Sets cache, and the folders in it: root, venv, forms, overlay.
name_folders() {
    cache=${HYDROELASTIC_CACHE:-${XDG_CACHE_HOME:-${HOME:-}/.cache}/hydroelastic}
    [[ $cache == /* ]] || cache=$PWD/$cache
    cache=$(readlink -m -- "$cache")

    local file base debian run development peers place_and_project
    for file in "$checkout"/requirements/{debian,run,dev,bench}.txt "$checkout/pyproject.toml"; do
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
    if [[ $way == active ]]; then
        local python
        python=$(sha256sum <<<"$python_executable $python_version $dolfinx_version")
        base=python$python_version-${python:0:12}
    fi
    root=$cache/roots/$base
    venv=$cache/venvs/$base-${run:0:8}${development:0:8}
    forms=$cache/forms/$base
    if [[ $way == inside ]]; then
        venv=$HYDROELASTIC_INSIDE forms=${XDG_CACHE_HOME:-$cache/forms/inside}
    fi
    overlay=$cache/checkouts/${place:0:12}-${project:0:8}${run:0:8}${peers:0:4}
}

is_prepared() {
    [[ $way != root || -d $root ]] && [[ -d $venv && -d $overlay ]]
}
