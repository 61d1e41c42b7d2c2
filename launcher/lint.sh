# shellcheck shell=bash
# ./hydro lint: all checks of the code, whatever the first ones give.

lint() {
    local failed=()
    cd -- "$checkout"
    say "ruff check" && inside ruff check . || failed+=("ruff check")
    say "ruff format --check" && inside ruff format --check . || failed+=("ruff format --check")
    # Through the links, so that the folders have their names in the import package; said as files of the checkout.
    say "mypy" && inside mypy -p hydroelastic > >(sed "s|^$overlay/hydroelastic/||") || failed+=(mypy)
    wait "$!" || true # for sed
    say "import-linter" && inside lint-imports --cache-dir "$forms/import-linter" || failed+=(import-linter)
    if ((${#failed[@]})); then
        say "lint failed: $(printf '%s, ' "${failed[@]}" | sed 's/, $//')"
        return 1
    fi
}
