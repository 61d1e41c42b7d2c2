# shellcheck shell=bash
# Entering the private root: what of the host is seen inside, and the command that starts a program there.

# Sets entry: bwrap, chroot or proot, the first that this system allows.
find_entry() {
    if type -P bwrap >/dev/null && bwrap --ro-bind / / true 2>/dev/null; then
        entry=bwrap
    elif ((EUID == 0)) && unshare --mount true 2>/dev/null; then
        entry=chroot
    elif type -P proot >/dev/null; then
        entry=proot
    else
        return 1
    fi
    # By its path on the host, because PATH becomes that of the inside.
    entry_program=$(type -P "${entry/#chroot/unshare}")
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
    # A checkout, home or cache in an unusual place, and certificates that a variable names.
    for path in "$checkout" "${HOME:-}" "$cache" "${TMPDIR:-}"; do
        if [[ -d $path ]] && is_system_folder "$path"; then binds+=("$path"); fi
    done
    for path in /etc/{ssl,resolv.conf,hosts,passwd,group,pip.conf} "${SSL_CERT_FILE:-}" "${SSL_CERT_DIR:-}" \
        "${PIP_CERT:-}" "${REQUESTS_CA_BUNDLE:-}" "${CURL_CA_BUNDLE:-}" "${PIP_CONFIG_FILE:-}"; do
        if [[ -r $path && $path != /etc/ssl/* ]] && is_system_folder "$path"; then binds_read_only+=("$path"); fi
    done
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
    local bind
    folder=$PWD
    if ! is_system_folder "$PWD" || [[ -d $root$PWD ]]; then return; fi
    for bind in "${binds[@]}"; do
        if [[ $PWD/ == "$bind"/* ]]; then return; fi
    done
    say "the folder $PWD is not seen inside the private root; starting in /"
    folder=/
}

# Sets command: what starts a program in the private root, in the current directory, with the exported environment.
command_in_root() {
    local path folder binds binds_read_only
    list_binds
    choose_folder
    for path in "${binds[@]}" "${binds_read_only[@]}"; do
        # bwrap mounts on an empty / and makes what is not in a folder of the root by itself.
        if [[ $entry != bwrap ]] || is_system_folder "$path"; then make_mount_point "$path"; fi
    done
    command=("$entry_program")
    "options_of_$entry"
    command+=("$@")
}

# The folders of the root on an empty /, so that all others can be added without writing into the root.
options_of_bwrap() {
    local path name
    for path in "$root"/*; do
        name=/${path##*/}
        if [[ -L $path ]]; then
            command+=(--symlink "$(readlink -- "$path")" "$name")
        elif [[ $name =~ ^/(usr|etc|var|lib.*|bin|sbin)$ ]]; then
            command+=(--ro-bind "$path" "$name")
        fi
    done
    for path in "${binds[@]}"; do command+=(--dev-bind "$path" "$path"); done
    for path in "${binds_read_only[@]}"; do command+=(--ro-bind "$path" "$path"); done
    command+=(--chdir "$folder" --)
}

# The mounts live in a namespace of the program and end with it.
options_of_chroot() {
    command+=(--mount --propagation private "$BASH" "$checkout/launcher/in_chroot.sh" "$root" "$folder")
    command+=("${binds[@]}" "${binds_read_only[@]}" --)
}

options_of_proot() {
    local path
    command+=(-r "$root" -w "$folder")
    for path in "${binds[@]}" "${binds_read_only[@]}"; do command+=(-b "$path"); done
    command+=(/usr/bin/env --)
}
