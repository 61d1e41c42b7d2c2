# shellcheck shell=bash
# Entering the private root: what of the host is seen inside, and the command that starts a program there.

# Sets entry: unshare, bwrap or proot, the first that this system allows; entry_program, its path on the host, because
# PATH becomes that of the inside; and namespaces, the options of unshare. Some systems, Ubuntu among them, leave
# namespaces to bwrap and few others.
find_entry() {
    local kind
    for kind in --mount "--user --map-root-user --mount"; do
        read -ra namespaces <<<"$kind"
        if unshare "${namespaces[@]}" mount --rbind / / 2>/dev/null; then
            entry=unshare
            entry_program=$(type -P unshare)
            return
        fi
    done
    entry=bwrap
    if entry_program=$(type -P bwrap) && bwrap --ro-bind / / true 2>/dev/null; then return; fi
    entry=proot
    entry_program=$(type -P proot)
}

# Folders that are the root's own; all others of the host (home, tmp, srv, mnt, data, ...) are seen inside.
is_system_folder() {
    [[ $1 =~ ^/(bin|boot|dev|etc|lib|lib32|lib64|libx32|proc|run|sbin|sys|usr|var|lost\+found)(/|$) ]]
}

# Fills binds with what of the host is to be mounted, and binds_read_only.
list_binds() {
    local path
    binds=(/dev /proc /sys /var/tmp) binds_read_only=()
    for path in /*; do
        if [[ -d $path ]] && ! is_system_folder "$path"; then binds+=("$path"); fi
    done
    # A checkout, home or cache in an unusual place: below a system folder, or in a hidden folder at the root.
    for path in "$checkout" "$HOME" "$cache" "${TMPDIR:-}"; do
        if [[ $path == /?* && -d $path ]] && ! is_bound "$path"; then binds+=("$path"); fi
    done
    # Certificates that a variable names, too.
    for path in /etc/{ssl,resolv.conf,hosts,passwd,group,pip.conf} "${SSL_CERT_FILE:-}" "${SSL_CERT_DIR:-}" \
        "${PIP_CERT:-}" "${REQUESTS_CA_BUNDLE:-}" "${CURL_CA_BUNDLE:-}" "${PIP_CONFIG_FILE:-}"; do
        if [[ -r $path && $path != /etc/ssl/* ]] && is_system_folder "$path"; then binds_read_only+=("$path"); fi
    done
}

# Whether a path is, or is below, one of binds.
is_bound() {
    local bind
    for bind in "${binds[@]}"; do
        if [[ $1/ == "$bind"/* ]]; then return; fi
    done
    return 1
}

# An empty file or folder in the root where something of the host is to appear.
make_mount_point() {
    if [[ -e $root$1 ]]; then return; fi
    if [[ -d $1 ]]; then
        mkdir -p -- "$root$1"
    else
        mkdir -p -- "$(dirname -- "$root$1")" && : >"$root$1"
    fi 2>/dev/null || fail "$1 cannot be shown inside the private root $root, which is read-only"
}

# Sets folder: where the program starts, which is the current directory if it is seen inside.
choose_folder() {
    folder=$PWD
    if is_bound "$PWD" || { is_system_folder "$PWD" && [[ -d $root$PWD ]]; }; then return; fi
    say "the folder $PWD is not seen inside the private root; starting in /"
    folder=/
}

# Sets command: what starts a program in the private root, in the current directory, with the exported environment.
command_in_root() {
    local path folder binds binds_read_only
    list_binds
    choose_folder
    for path in "${binds[@]}" "${binds_read_only[@]}"; do make_mount_point "$path"; done
    "command_by_$entry" "$@"
}

# The mounts live in a namespace of the program and end with it.
command_by_unshare() {
    command=("$entry_program" "${namespaces[@]}" --propagation private "$BASH" "$checkout/launcher/in_root.sh")
    command+=("$root" "$folder" "$EUID" "$(id -g)" "${binds[@]}" -- "${binds_read_only[@]}" -- "$@")
}

command_by_bwrap() {
    local path
    command=(setpriv --pdeathsig KILL -- "$entry_program" --ro-bind "$root" /)
    for path in "${binds[@]}"; do command+=(--dev-bind "$path" "$path"); done
    for path in "${binds_read_only[@]}"; do command+=(--ro-bind "$path" "$path"); done
    command+=(--chdir "$folder" -- "${ends_with_parent[@]}" "$@")
}

command_by_proot() {
    local path
    command=(setpriv --pdeathsig KILL -- "$entry_program" -r "$root" -w "$folder")
    for path in "${binds[@]}" "${binds_read_only[@]}"; do command+=(-b "$path"); done
    command+=("${ends_with_parent[@]}" "$@")
}
