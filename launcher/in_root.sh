#!/usr/bin/env bash
# in_root.sh ROOT FOLDER USER GROUP MOUNT ... -- READ_ONLY_MOUNT ... -- PROGRAM [ARGUMENT ...]
# Makes a root the root folder of this process, with folders and files of the host in it, and becomes the program;
# started in a mount namespace of its own, see enter.sh. No step forks off the program: a signal to the process that
# the user has started arrives at the program itself.
set -euo pipefail

inside_path=$PATH
PATH=/usr/sbin:/usr/bin:/sbin:/bin
root=$1 folder=$2 user=$3 group=$4
shift 4

# As a mount of its own the root can be read-only; unbindable, lest it is seen again in the folder above it.
mount --bind --make-unbindable -- "$root" "$root" || exit 2
while [[ $1 != -- ]]; do
    mount --rbind -- "$1" "$root$1" || exit 2
    shift
done
shift
# Against accidents of the superuser, who alone could write there.
options=bind
if ! ((user)); then options=bind,ro; fi
while [[ $1 != -- ]]; do
    mount -o "$options" -- "$1" "$root$1" || exit 2
    shift
done
shift
mount -o remount,bind,ro -- "$root" 2>/dev/null || true # an ordinary user may be refused

identity=()
# Mounting made the user the root of a namespace; in a second one the user is back, and without rights again.
if ((user)); then identity=(--user --map-user="$user" --map-group="$group"); fi
exec unshare "${identity[@]}" --root="$root" --wd="$folder" -- /usr/bin/env "PATH=$inside_path" "$@"
