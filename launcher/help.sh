# shellcheck shell=bash
# ./hydro COMMAND --help, of the commands that are the launcher's own.

# Prints the help of a command if its arguments ask for that; fails if they do not, or if the help is another program's.
print_help_if_asked() {
    local word=$1 argument
    shift
    case $word in
        test | lint | docs | env) ;;
        exec | shell) set -- "${@:1:1}" ;; # what follows is the program's, or the shell's
        *) return 1 ;;
    esac
    for argument in "$@"; do
        if [[ $argument == --help || $argument == -h ]]; then
            print "$("help_of_$word")"
            return
        fi
    done
    return 1
}

help_of_test() {
    cat <<'EOF'
usage: ./hydro test [--all] [ARGUMENT ...]

Runs pytest on all tests that are not slow, then those marked `mpi` again under two MPI ranks. With a path, -k or any
other selection it runs only what was selected, once. --all adds the slow tests, on one rank and on two. The other
arguments are pytest's: ./hydro python -m pytest --help

  ./hydro test                               everything that is not slow: minutes
  ./hydro test --all                         everything: an hour and more
  ./hydro test tests/test_modal_grammel.py   one file
  ./hydro test -k grammel -x                 tests by name, up to the first failure
  ./hydro test -m slow                       what --all adds
EOF
}

help_of_lint() {
    cat <<'EOF'
usage: ./hydro lint

Checks the code by ruff check, ruff format --check, mypy and import-linter, whatever the first ones give.
Exit code 1 if one of them fails. `./hydro exec ruff format .` formats the code.
EOF
}

help_of_docs() {
    cat <<'EOF'
usage: ./hydro docs [--out FOLDER]

Builds the documentation as a site to be read from the disk, in the cache or in FOLDER, and tells its first page.
A warning, a dead link say, is an error. FOLDER has to be new, empty, or a site that was built before.

  ./hydro docs --out /tmp/site
EOF
}

help_of_env() {
    cat <<'EOF'
usage: ./hydro env

Tells which environment is used and why, the versions of Python, dolfinx, PETSc and others, and the folders of the
cache with their sizes. The first call prepares the environment.
EOF
}

help_of_exec() {
    cat <<'EOF'
usage: ./hydro exec PROGRAM [ARGUMENT ...]

Runs any program in the environment, in the current folder; its exit code is that of the program.

  ./hydro exec ruff format .
EOF
}

help_of_shell() {
    cat <<'EOF'
usage: ./hydro shell [ARGUMENT ...]

Starts an interactive bash in the environment, where `hydroelastic`, `python` and `mpirun` are found; `exit` leaves it.
The arguments are bash's.

  ./hydro shell -c 'hydroelastic list | head'
EOF
}
