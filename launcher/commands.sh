# shellcheck shell=bash
# The commands test, lint, docs and env.

# pytest on everything, then the tests marked mpi again under two MPI ranks; a selection runs once.
command_test() {
    local argument markers='not slow' arguments=() flags=() whole=yes cores=() status=0 previous=''
    for argument in "$@"; do
        case $previous:$argument in
            -m:*) markers=$argument arguments+=("$argument") ;;
            *:--all) markers='' arguments+=(-m '') ;; # an empty expression of markers, which the slow tests fit as well
            *:-m) arguments+=("$argument") ;;
            *:--junitxml=*) arguments+=("$argument") ;; # of the first run only
            *:-[qvxsl]* | *:-r* | *:--tb=* | *:--durations=* | *:--maxfail=* | *:--color=*)
                arguments+=("$argument") flags+=("$argument") ;;
            *) # a selection; relative paths of the caller are made absolute, because the tests run in the checkout
                whole=''
                if [[ $argument != [-/]* && -e ${argument%%::*} ]]; then argument=$PWD/$argument; fi
                arguments+=("$argument")
                ;;
        esac
        previous=$argument
    done
    cd -- "$checkout"
    # On all cores, a file at a time on each, because the tests of a file share what is solved once; the longest first.
    if [[ -n $whole ]]; then cores=(-n auto --maxprocesses 4 --dist loadfile --no-loadscope-reorder); fi
    inside python -m pytest -o "cache_dir=$forms/pytest" "${cores[@]}" "${arguments[@]}" || status=$?
    if [[ -n $whole ]]; then run_mpi_tests || status=$((status ? status : $?)); fi
    return "$status"
}

run_mpi_tests() {
    local status=0 rank folder color=no files
    if [[ -t 1 ]]; then color=yes; fi # mpirun gives the ranks a terminal in any case
    if [[ $way == active && $(nproc) == 1 ]]; then # under the names of all versions of Open MPI
        export OMPI_MCA_rmaps_base_oversubscribe=true PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe PRTE_MCA_mapby=:oversubscribe
    fi
    export OMPI_MCA_mpi_yield_when_idle=1 # two spinning ranks on a busy machine take several times as long
    say "again under two MPI ranks: the tests marked mpi"
    folder=$(mktemp -d -- "$forms/mpi.XXXXXX")
    mapfile -t files < <(grep -lE 'mark\.mpi\b' tests/test_*.py) # to collect the others takes half a minute
    # The time limits are for ranks that wait for each other after a failure on one.
    inside timeout --foreground 3600 mpirun -n 2 sh "$checkout/launcher/rank.sh" "$folder" \
        -p no:cacheprovider --import-mode=importlib --color="$color" -o faulthandler_timeout=300 \
        "${flags[@]}" -m "mpi${markers:+ and ($markers)}" "${files[@]}" || status=$?
    for rank in 0 1; do
        if ((status == 0)); then status=$(cat "$folder/status-$rank" 2>/dev/null || echo 1); fi
    done
    if ((status == 5)); then # pytest: no tests collected
        say "no test marked mpi fits -m '$markers'"
        status=0
    elif ((status)); then
        say "the run under two MPI ranks failed or took more than an hour; the end of rank 1:"
        tail -n 40 -- "$folder/output" >&2 || true
    fi
    rm -rf -- "$folder"
    return "$status"
}

command_lint() {
    (($# == 0)) || fail "lint takes no arguments, and was given $1"
    local failed=()
    cd -- "$checkout"
    say "ruff check" && inside ruff check . || failed+=("ruff check")
    say "ruff format --check" && inside ruff format --check . || failed+=("ruff format --check")
    # Through the links, so that the folders have their names in the import package; said as files of the checkout.
    say "mypy" && inside mypy -p hydroelastic > >(sed "s|^$overlay/hydroelastic/||") || failed+=(mypy)
    wait "$!" || true # for sed
    say "import-linter" && inside lint-imports --cache-dir "$forms/import-linter/${overlay##*/}" || failed+=(import-linter)
    if ((${#failed[@]})); then
        say "lint failed: $(printf '%s, ' "${failed[@]}" | sed 's/, $//')"
        return 1
    fi
}

# The documentation as a site to be read from the disk. A warning, a dead link say, is an error.
command_docs() {
    local out=$forms/docs/${overlay##*/}
    case ${1:-} in
        '') ;;
        --out) out=${2:-} && [[ -n $out ]] || fail "--out needs a folder: ./hydro docs --out FOLDER" ;;
        --out=?*) out=${1#--out=} ;;
        *) fail "docs takes --out FOLDER only, and was given $1" ;;
    esac
    out=$(readlink -m -- "$out")
    if [[ -e $out && ! -f $out/.buildinfo ]] && { [[ ! -d $out ]] || compgen -G "$out/*" >/dev/null; }; then
        fail "$out holds something else than the documentation; name an empty folder"
    fi
    inside python -m sphinx --builder html --fresh-env --fail-on-warning --keep-going --quiet \
        --conf-dir "$checkout/docs" --doctree-dir "$forms/doctrees/${overlay##*/}" "$checkout" "$out" || return
    say "the documentation is $out/index.html"
}

command_env() {
    (($# == 0)) || fail "env takes no arguments, and was given $1"
    local text
    case $way in
        root) text="private Debian root ($suite), entered by $entry; not the active Python: $python_reason" ;;
        active) text="active Python $python_executable, with a virtual environment on top" ;;
        inside) text="already inside" ;;
    esac
    print "way          $text"
    inside python - <<'END'
import importlib.metadata as metadata, platform
import hydroelastic  # with it MPI leaves no folder
from petsc4py import PETSc
print(f"python       {platform.python_version()}")
for name in ("fenics-dolfinx", "petsc4py", "slepc4py", "gmsh", "vtk", "hydroelastic"):
    print(f"{name:<12} {metadata.version(name).strip()}")
print(f"scalars      {PETSc.ScalarType.__name__}")
END
    print "checkout     $checkout"$'\n'"cache        $cache"
    du -sh -- "$root" "$venv" "$forms" "$overlay" 2>/dev/null | sed 's/^/    /' || true
}
