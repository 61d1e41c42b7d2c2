# shellcheck shell=bash
# Writing into the cache: the lock, and folders that are made aside and then get their name at once.

building='' # the unfinished folder, if any

open_lock() {
    if ! { mkdir -p -- "$cache" && : >>"$cache/lock"; } 2>/dev/null; then
        fail "cannot write to the cache $cache; $remedy"
    fi
    exec 9>>"$cache/lock"
}

close_lock() { exec 9>&-; }

# Takes the lock, waiting for another start that prepares this cache.
take_lock() {
    open_lock
    if flock --nonblock 9; then return; fi
    say "another start is preparing $cache; waiting for it"
    interruptible flock 9
    ((outcome == 0)) || fail "no lock could be had on $cache/lock"
}

need_room() {
    local free
    free=$(df -Pk -- "$cache" | awk 'NR == 2 { print int($4 / 1024) }')
    ((free >= $1)) ||
        fail "the cache $cache has $free MB free and needs $1 MB; $remedy"
}

new_building() {
    building=$(mktemp -d -- "$cache/building.XXXXXX") || fail "cannot write to the cache $cache; $remedy"
    chmod 755 -- "$building"
}

# Takes what is damaged out of the way of what is about to be made.
clear_damaged() {
    [[ -e $1 || -L $1 ]] || return 0
    say "$1 is damaged and made anew"
    new_building
    mv -T -- "$1" "$building/damaged"
    remove_building "$building"
    building=''
}

# list_contents FILTER ...: the list by which is_whole knows the unfinished folder, of what `find` finds with a filter.
list_contents() {
    (cd -- "$building" && find . \( -type l -o -type f -size +0 \) "$@" ! -name contents) >"$building/contents"
}

# A rename is atomic: the name exists only when all of the content does.
publish() {
    mkdir -p -- "$(dirname -- "$1")"
    mv -T -- "$building" "$1"
    building=''
}

# Never crosses into another file system: while a root is being made, /dev and /proc may be mounted in it.
remove_building() {
    [[ -e $1 ]] || return 0
    if grep -qF -- " $1/" /proc/self/mountinfo; then
        say "something is mounted in $1; unmount and remove it"
        return 0
    fi
    rm -rf --one-file-system -- "$1"
}

# What a power cut or `kill -9` left. Only the holder of the lock makes folders called building.*, so whoever has
# it may remove all.
remove_stale() {
    local folder
    for folder in "$cache"/building.*; do
        remove_building "$folder"
    done
}

# The same at a prepared start: silent, and not while somebody prepares.
remove_stale_if_unlocked() {
    open_lock
    if flock --nonblock 9; then remove_stale; fi
    close_lock
}
