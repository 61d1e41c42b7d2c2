# shellcheck shell=bash
# ./hydro test: pytest on everything, then the tests marked mpi again under two MPI ranks; a selection runs once.

run_tests() {
    local arguments markers flags cores=() status=0
    choose_markers "$@"
    set -- "${arguments[@]}"
    absolute_arguments "$@"
    cd -- "$checkout"
    # The whole suite on all cores, a file at a time on each, because the tests of a file share what is solved once;
    # in the order of tests/conftest.py, which is the longest first. A selection runs plainly.
    if selects_nothing "$@"; then cores=(-n auto --maxprocesses 4 --dist loadfile --no-loadscope-reorder); fi
    inside python -m pytest -o "cache_dir=$forms/pytest" "${cores[@]}" "${arguments[@]}" || status=$?
    if selects_nothing "$@"; then run_mpi_tests "$@" || status=$((status ? status : $?)); fi
    return "$status"
}

# Sets arguments: --all becomes an empty expression of markers, which the slow tests fit as well.
choose_markers() {
    local argument
    arguments=()
    for argument in "$@"; do
        if [[ $argument == --all ]]; then arguments+=(-m ''); else arguments+=("$argument"); fi
    done
}

# Makes relative paths of the caller absolute, because the tests run in the checkout.
absolute_arguments() {
    local argument
    arguments=()
    for argument in "$@"; do
        if [[ $argument != -* && $argument != /* && -e ${argument%%::*} ]]; then argument=$PWD/$argument; fi
        arguments+=("$argument")
    done
}

# Whether the arguments leave the choice of tests open, but for -m: sets markers to its expression, and flags to the
# other arguments.
selects_nothing() {
    markers='not slow' flags=()
    while (($#)); do
        case $1 in
            -m)
                markers=${2:-}
                shift
                ;;
            -m*) markers=${1#-m} ;;
            -q | -qq | -v | -vv | -x | -s | -l | -r* | --tb=* | --durations=* | --maxfail=* | --color=*)
                flags+=("$1")
                ;;
            --junitxml=*) ;; # of the first run only
            *) return 1 ;;
        esac
        shift || true
    done
}

# The tests marked mpi, under two ranks. The time limit is for ranks that wait for each other after a failure on one.
run_mpi_tests() {
    local status=0 rank_status=0 rank folder color=no files
    if [[ -t 1 ]]; then color=yes; fi # mpirun gives the ranks a terminal in any case
    if [[ $way == active && $(nproc) == 1 ]]; then
        # Two ranks on one core, under the names of all versions of Open MPI.
        export OMPI_MCA_rmaps_base_oversubscribe=true
        export PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe PRTE_MCA_mapby=:oversubscribe
    fi
    # A rank that waits gives its core away: on a busy machine two spinning ranks take several times as long.
    export OMPI_MCA_mpi_yield_when_idle=1
    say "again under two MPI ranks: the tests marked mpi"
    folder=$(mktemp -d -- "$forms/mpi.XXXXXX")
    mapfile -t files < <(grep -lE 'mark\.mpi\b' tests/test_*.py) # to collect the others takes half a minute
    inside timeout --foreground 3600 mpirun -n 2 sh "$checkout/launcher/rank.sh" "$folder" \
        -p no:cacheprovider --import-mode=importlib --color="$color" -o faulthandler_timeout=300 \
        "${flags[@]}" -m "mpi${markers:+ and ($markers)}" "${files[@]}" || status=$?
    for rank in 0 1; do
        if ((status == 0)); then
            read -r rank_status 2>/dev/null <"$folder/status-$rank" || rank_status=1
            status=$rank_status
        fi
    done
    case $status in
        0) ;;
        5) # pytest: no tests collected
            say "no test marked mpi fits -m '$markers'"
            status=0
            ;;
        124) say "the run under two MPI ranks took more than an hour and was ended" ;;
        *)
            say "the run under two MPI ranks failed; the end of rank 1:"
            tail -n 40 -- "$folder/output" >&2 || true
            ;;
    esac
    rm -rf -- "$folder"
    return "$status"
}
