# shellcheck shell=bash
# ./hydro docs: the documentation as a site to be read from the disk. A warning, a dead link say, is an error.

build_docs() {
    local out=$forms/docs/${overlay##*/}
    while (($#)); do
        case $1 in
            --out)
                (($# > 1)) || fail "--out needs a folder: ./hydro docs --out FOLDER"
                out=$2
                shift
                ;;
            --out=?*) out=${1#--out=} ;;
            *) fail "docs takes --out FOLDER only, and was given $1" ;;
        esac
        shift
    done
    out=$(readlink -m -- "$out")
    may_be_replaced "$out" || fail "$out holds something else than the documentation; name an empty folder"
    inside python -m sphinx --builder html --fresh-env --fail-on-warning --keep-going --quiet \
        --conf-dir "$checkout/docs" --doctree-dir "$forms/doctrees/${overlay##*/}" "$checkout" "$out" || return
    say "the documentation is $out/index.html"
}

# Whether a folder is empty, or not there, or holds what an earlier call has built.
may_be_replaced() {
    if [[ ! -e $1 || -f $1/.buildinfo ]]; then return; fi
    [[ -d $1 ]] && ! compgen -G "$1/*" >/dev/null
}
