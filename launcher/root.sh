# shellcheck shell=bash
# Making the private Debian root with mmdebstrap.

source "$checkout/launcher/mirror.sh"

make_root() {
    install_what_root_needs
    need_room 4500
    find_mirror
    new_building
    timed "a private Debian root ($suite, 2.9 GB, about two minutes) in $root" run_mmdebstrap
    # What `inside` binds must exist, because the root is bound read-only.
    mkdir -p -- "$building"/etc/ssl "$building"/{tmp,proc,sys,dev,var/tmp}
    touch -- "$building"/etc/{resolv.conf,hosts,passwd,group,pip.conf}
    publish "$root"
    is_whole_root || fail "the private root $root lacks what it needs; the log is $log"
}

# As root mmdebstrap writes the folder itself. An ordinary user gets an archive and unpacks it, because the files
# would otherwise belong to the user's subordinate ids, and the user could not remove them.
run_mmdebstrap() {
    local include
    include=$(read_list "$checkout/requirements/debian.txt" | paste -sd, -)
    # A suite such as sid is often seen through mirrors that lag behind the validity of its index.
    local options=(--variant=apt "--include=$include" --aptopt='APT::Install-Recommends "false"' "${keyrings[@]}")
    if [[ $suite != trixie ]]; then options+=(--aptopt='Acquire::Check-Valid-Until "false"'); fi
    if ((EUID == 0)); then
        mmdebstrap "${options[@]}" "$suite" "$building" ${mirror:+"$mirror"}
    else
        # /tmp may be held in memory, and the mapped user of mmdebstrap cannot enter a private home.
        TMPDIR=/var/tmp mmdebstrap "${options[@]}" --format=tar "$suite" - ${mirror:+"$mirror"} |
            tar --extract --no-same-owner --exclude='./dev/*' --directory="$building"
    fi
}
