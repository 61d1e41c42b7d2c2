# shellcheck shell=bash
# Messages: all go to the standard error, so that the output of the started program stays clean. Where they cannot be
# read, they are no reason to stop.

say() { printf 'hydro: %s\n' "$*" >&2 2>/dev/null || true; }

# What was asked for goes to the standard output.
print() { printf '%s\n' "$1" 2>/dev/null || fail "the standard output cannot be written"; }

# Every bad situation ends here: one message, exit code 2.
fail() {
    say "$*"
    exit 2
}

# fail, with the ways to get an environment by hand.
explain_ways() {
    local packages
    packages=$(read_list "$checkout/requirements/debian.txt")
    cat >&2 <<END
hydro: no usable environment: $1
hydroelastic needs dolfinx 0.9 or newer with the real PETSc, petsc4py and slepc4py. Any one of these gives it:

  conda     conda env create -f "$checkout/environment.yml" && conda activate hydroelastic
  Docker    docker build -t hydroelastic "$checkout" && docker run --rm -it hydroelastic
  apt       sudo apt-get install ${packages//$'\n'/ }
            (Debian 13, Ubuntu 25.04 or newer; on older ones ./hydro makes a private Debian 13 by itself
            where apt-get is found)

Then start ./hydro again. See docs/install.md.
END
    exit 2
}
