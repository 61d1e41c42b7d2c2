#!/usr/bin/env bash
# in_chroot.sh ROOT FOLDER MOUNT ... -- PROGRAM [ARGUMENT ...]
# Shows folders and files of the host in a root, and starts a program in it; run by `unshare --mount`, see enter.sh.
set -euo pipefail

inside_path=$PATH
PATH=/usr/sbin:/usr/bin:/sbin:/bin
root=$1 folder=$2
shift 2
while [[ $1 != -- ]]; do
    mount --rbind -- "$1" "$root$1" || exit 2
    shift
done
shift
chroot=$(type -P chroot)
export PATH=$inside_path
exec "$chroot" "$root" /usr/bin/env --chdir="$folder" "$@"
