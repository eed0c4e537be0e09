# shellcheck shell=bash disable=SC2016
# Sourced by packaging/test, arm64, portable and portable_test, after packaging/cmake/setup.sh: root folders of Debian, and commands in them.

# root_folder FOLDER SUITE OPTION...: by mmdebstrap, whole or not at all
root_folder() {
    local folder=$1 suite=$2
    shift 2
    rm -rf --one-file-system "$folder.making"
    step "a root folder of $suite, once ..." mmdebstrap --mode=root --variant=apt --format=directory \
        --dpkgopt='path-exclude=/usr/share/locale/*' "$@" "$suite" "$folder.making" ${LIMPET_MIRROR:+"$LIMPET_MIRROR"}
    mv "$folder.making" "$folder" || exit 1
}

# within ROOT [FOLDER=PLACE]... -- COMMAND...: there, with these folders at these places; /tmp is its own, mounts and
# processes end with it
within() {
    unshare --mount --pid --fork --kill-child bash -e -c '
        root=$0
        mount -t proc proc "$root/proc"
        mount --rbind /dev "$root/dev"
        mount --rbind /sys "$root/sys"
        mount -t tmpfs tmpfs "$root/tmp"
        while [ "$1" != -- ]; do
            mkdir -p "$root${1#*=}"
            mount --bind "${1%%=*}" "$root${1#*=}"
            shift
        done
        shift
        exec chroot "$root" env -i HOME=/tmp PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 MPLBACKEND=agg \
            DEBIAN_FRONTEND=noninteractive "$@"' "$@"
}
