# shellcheck shell=bash
# Preparing what is missing in the cache: the order of the steps, their messages, and what a signal does.

source "$checkout/launcher/cache.sh"

child='' # the process group at work, if any

prepare() {
    trap 'interrupted 130' INT
    trap 'interrupted 143' TERM
    trap 'interrupted 129' HUP
    trap clean_up EXIT
    take_lock
    remove_stale
    log=$cache/prepare.log
    if [[ $way == root ]]; then prepare_root; fi
    if [[ $way != inside ]] && ! is_whole "$venv"; then
        source "$checkout/launcher/venv.sh"
        clear_damaged "$venv"
        make_venv
    fi
    if ! is_whole "$overlay"; then
        source "$checkout/launcher/overlay.sh"
        clear_damaged "$overlay"
        make_overlay
    fi
    trap - INT TERM HUP EXIT
    close_lock
}

prepare_root() {
    source "$checkout/launcher/host_packages.sh"
    if ! is_whole_root; then
        source "$checkout/launcher/root.sh"
        clear_damaged "$root"
        make_root
    fi
    if ! find_entry; then
        say "this system refuses namespaces; proot works without them"
        install_on_host proot
        find_entry || fail "proot was not found after its installation"
    fi
}

# timed "what, how long" COMMAND ...
timed() {
    local start=$SECONDS what=$1
    shift
    say "preparing $what ..."
    interruptible logged "$@"
    if ((outcome)); then
        tail -n 15 -- "$log" >&2
        fail "this failed after $((SECONDS - start)) s; the whole log is $log"
    fi
    say "done in $((SECONDS - start)) s"
}

logged() { "$@" >"$log" 2>&1; }

# Runs a command that a signal can end at any time. Bash delays its traps until a command in the foreground ends,
# hence the background; monitor mode gives the command its own process group, so that all of it can be ended.
# The exit code goes to `outcome`: called as a condition, `set -e` would be off in all that the command does.
interruptible() {
    set -m
    "$@" </dev/null &
    child=$!
    set +m
    outcome=0
    wait "$child" || outcome=$?
    child=''
}

interrupted() {
    trap '' INT TERM HUP # finish the cleaning
    say "interrupted; removing what was unfinished"
    clean_up
    exit "$1"
}

clean_up() {
    local waited
    if [[ -n $child ]]; then
        kill -TERM -- "-$child" 2>/dev/null || true
        for ((waited = 0; waited < 100; waited++)); do # mmdebstrap needs a moment to unmount
            kill -0 -- "-$child" 2>/dev/null || break
            sleep 0.1
        done
        kill -KILL -- "-$child" 2>/dev/null || true
        child=''
    fi
    if [[ -n $building ]]; then
        remove_building "$building"
        building=''
    fi
}
