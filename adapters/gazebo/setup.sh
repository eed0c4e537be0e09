# shellcheck shell=bash disable=SC2154  # limpet_root and limpet_log come from packaging/cmake/setup.sh
# Sourced by adapters/gazebo/run and adapters/gazebo/test, after packaging/cmake/setup.sh: Gazebo 11 and ROS 1, where the machine
# has them, else in a root folder of Debian 11 that is made once and entered by bubblewrap.
#
#   prepare_gazebo       sees to Gazebo 11; seconds when it is there
#   enter COMMAND...     runs there, in this folder, with the repository at its own path; the network is
#                        the machine's, /tmp and HOME are private, the root folder is read-only
#   enter_at=(PATH...)   further folders that `enter` shows, writable
#   enter_reads=(PATH...) further files and folders that it shows, read-only
#
# LIMPET_GAZEBO_ROOT   the root folder (~/.cache/limpet/gazebo-DIGEST of the package list)
# LIMPET_MIRROR        where Debian comes from (packaging/cmake/mirror.sh)

. "$limpet_root/packaging/cmake/mirror.sh"

gazebo_suite=bullseye
gazebo_packages=$limpet_root/adapters/gazebo/packages.txt
gazebo_needs_MB=3500
enter_at=()
enter_reads=()

package_names() { sed -e 's/#.*//' -e 's/[[:space:]]//g' -e '/^$/d' "$@"; }

has_gazebo() { command -v gzserver >/dev/null && pkg-config --exists 'gazebo >= 11' 2>/dev/null; }

gazebo_root_folder() {
    local digest
    digest=$({ echo "$gazebo_suite" && package_names "$gazebo_packages" | sort; } | sha256sum | cut -c 1-12)
    echo "${LIMPET_GAZEBO_ROOT:-${XDG_CACHE_HOME:-$HOME/.cache}/limpet/gazebo-$digest}"
}

# remove_root FOLDER: a root folder that was not finished
remove_root() {
    case $1 in
        /*.making) ;;
        *) stop "not removing $1" ;;
    esac
    [ -d "$1" ] || return 0
    if awk '{ print $5 }' /proc/self/mountinfo | grep -qF "$1"; then
        stop "something is mounted below $1: unmount it, then remove that folder"
    fi
    rm -rf --one-file-system "$1" || stop "$1 is left from an earlier run and cannot be removed"
}

# bootstrap MIRROR FOLDER: Debian 11 with the packages, by mmdebstrap. A plain user's comes as an archive:
# made among user ids that are not his, it would not be his to remove.
bootstrap() {
    local options=(--variant=minbase --components=main
        --include="$(package_names "$gazebo_packages" | paste -sd,)"
        --aptopt='APT::Install-Recommends "false"'
        --dpkgopt='path-exclude=/usr/share/doc/*' --dpkgopt='path-exclude=/usr/share/man/*'
        --dpkgopt='path-exclude=/usr/share/locale/*'
        --customize-hook='echo "127.0.0.1 localhost" >"$1/etc/hosts"')
    if [ "$(id -u)" = 0 ]; then
        mmdebstrap --mode=root --format=directory "${options[@]}" "$gazebo_suite" "$2" "$1"
    else
        mkdir -p "$2" && mmdebstrap --mode=unshare --format=tar "${options[@]}" "$gazebo_suite" - "$1" |
            tar -x -C "$2" --exclude='./dev/*'
    fi
}

# make_root FOLDER: whole or not at all. Runs under a lock: who waited finds it made.
make_root() {
    local root=$1 making=$1.making mirror free_MB
    [ ! -x "$root/usr/bin/gzserver" ] || return 0
    [ ! -e "$root" ] || rmdir "$root" 2>/dev/null ||
        stop "LIMPET_GAZEBO_ROOT: $root is neither empty nor a root folder with Gazebo"
    remove_root "$making"
    free_MB=$(df --output=avail -BM "$(dirname "$root")" | tail -n 1 | tr -dc 0-9)
    [ "$free_MB" -ge "$gazebo_needs_MB" ] ||
        stop "the root folder with Gazebo needs $gazebo_needs_MB MB in $(dirname "$root"), there are $free_MB; LIMPET_GAZEBO_ROOT names another place"
    mirror=$(find_mirror "$gazebo_suite") || exit 1
    # shellcheck disable=SC2064  # the folder as it is named now
    trap "remove_root '$making'" EXIT
    trap 'exit 130' INT TERM HUP
    say "making a root folder of Debian 11 with Gazebo 11 and ROS 1, once: $root"
    say "  530 MB to download, 2.0 GB on disk, three to five minutes ..."
    if [ -t 2 ]; then
        bootstrap "$mirror" "$making" >&2 || stop "mmdebstrap failed; its output is above"
    else
        step "  downloading and unpacking ..." bootstrap "$mirror" "$making"
    fi
    [ -x "$making/usr/bin/gzserver" ] || stop "the root folder came without gzserver ($limpet_log)"
    mv "$making" "$root" || exit 1
}

prepare_gazebo() {
    if has_gazebo; then
        install_packages "$gazebo_packages"
        return
    fi
    command -v apt-get >/dev/null || stop "neither Gazebo 11 nor apt-get here: use adapters/gazebo/Dockerfile (docs/gazebo.md)"
    install_packages "$limpet_root/adapters/gazebo/host_packages.txt"
    gazebo_root=$(gazebo_root_folder)
    case $gazebo_root in
        / | *[[:space:]]* | */../* | */..) stop "LIMPET_GAZEBO_ROOT: not this folder: '$gazebo_root'" ;;
        /*) ;;
        *) stop "LIMPET_GAZEBO_ROOT: must begin with /: '$gazebo_root'" ;;
    esac
    if [ ! -x "$gazebo_root/usr/bin/gzserver" ]; then
        mkdir -p "$(dirname "$gazebo_root")" || exit 1
        (
            flock 9 || exit 1
            make_root "$gazebo_root" 9>&-
        ) 9>"$gazebo_root.lock" || exit 1
    fi
    enter true || stop "bubblewrap does not get into $gazebo_root; it needs user namespaces, or root"
}

# holds_more PATH: all of / or of a home below it, or what the root folder has a place of its own for
holds_more() {
    case ${HOME%/}/ in "${1%/}"/*) return 0 ;; esac
    case $1 in / | /tmp) return 0 ;; esac
    ! has_gazebo || return 1
    case $1/ in
        /bin/* | /etc/* | /lib/* | /lib32/* | /lib64/* | /libx32/* | /opt/* | /proc/* | /sbin/* | /sys/* | /usr/* | /var/*) return 0 ;;
    esac
    return 1
}

# show_file FILE: to `enter`, with the files next to and below it, read-only; alone where that is too much
show_file() {
    local file folder
    file=$(realpath -ms "$1")
    folder=$(dirname "$file")
    if ! holds_more "$folder"; then
        enter_reads+=("$folder")
    elif [ "$folder" = /tmp ] || [ "$folder" = "${HOME%/}" ]; then
        enter_reads+=("$file")
    else
        stop "$file: Gazebo's root folder has its own $folder; copy it to another folder"
    fi
}

# enter_environment: what of the caller's environment goes inside
enter_environment() {
    local name
    for name in $(compgen -e); do
        case $name in
            CCACHE_* | CMAKE_CXX_COMPILER_LAUNCHER | LIMPET_* | GAZEBO_* | ROS_* | DISPLAY | TERM | NINJA_STATUS) printf '%s=%s\0' "$name" "${!name}" ;;
        esac
    done
    printf 'PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin\0LANG=C.UTF-8\0'
}

# enter COMMAND...: ends with all that it started
enter() {
    if has_gazebo; then
        "$@"
        return
    fi
    local folder binds=() environment=()
    mapfile -d '' environment < <(enter_environment)
    for folder in usr etc var opt; do
        binds+=(--ro-bind-try "$gazebo_root/$folder" "/$folder")
    done
    for folder in bin sbin lib lib32 lib64 libx32; do
        if [ -L "$gazebo_root/$folder" ]; then
            binds+=(--symlink "usr/$folder" "/$folder")
        else
            binds+=(--ro-bind-try "$gazebo_root/$folder" "/$folder")
        fi
    done
    binds+=(--dev /dev --proc /proc --ro-bind-try /sys /sys --tmpfs /tmp --tmpfs /run --dir /tmp/home)
    for folder in "${enter_reads[@]}"; do
        binds+=(--ro-bind-try "$folder" "$folder")
    done
    for folder in "$limpet_root" ${CCACHE_DIR:+"$CCACHE_DIR"} "${enter_at[@]}"; do
        mkdir -p "$folder" && binds+=(--bind "$folder" "$folder")
    done
    [ -z "${DISPLAY:-}" ] || binds+=(--bind-try /tmp/.X11-unix /tmp/.X11-unix)
    env -i "${environment[@]}" HOME=/tmp/home bwrap "${binds[@]}" \
        --chdir "$PWD" --unshare-pid --die-with-parent "$@"
}

# build_gazebo [TARGET...]: the plugins and their tests, where Gazebo is
build_gazebo() {
    cd "$limpet_root" || exit 1
    configure_if_new bullseye "$(package_names "$gazebo_packages" | enter xargs dpkg-query -W)" \
        enter cmake -S adapters/gazebo -B build/bullseye -G Ninja
    if ! enter ninja -C build/bullseye -n "$@" 2>/dev/null | grep -q 'no work to do'; then
        step "building (Gazebo), a few minutes the first time ..." enter ninja -C build/bullseye "$@"
    fi
}
