# shellcheck shell=bash
# Debian packages of the host that a private root needs; the only thing that is changed outside of the cache.

# Installs packages: by itself as root, else after a question, else by telling the command.
install_on_host() {
    local install="apt-get update && apt-get install --yes --no-install-recommends $*" answer=''
    if ((EUID == 0)); then
        timed "the host packages $*" env DEBIAN_FRONTEND=noninteractive sh -c "$install"
        return
    fi
    if [[ -t 0 && -t 2 ]] && type -P sudo >/dev/null; then
        read -r -p "hydro: the private Debian root needs the packages $*; install them with sudo? [y/N] " answer || true
        if [[ $answer == [yY]* ]]; then
            sudo sh -c "$install" >&2 || fail "the packages could not be installed"
            return
        fi
    fi
    fail "the private Debian root needs host packages; install them with:
    sudo sh -c '$install'
then start again (docs/install.md has other ways: conda, Docker)"
}

install_what_root_needs() {
    local packages=()
    type -P mmdebstrap >/dev/null || packages+=(mmdebstrap)
    ((EUID == 0)) || type -P newuidmap >/dev/null || packages+=(uidmap)
    [[ -r /usr/share/keyrings/debian-archive-keyring.gpg ]] || packages+=(debian-archive-keyring)
    ((${#packages[@]} == 0)) || install_on_host "${packages[@]}"
}
