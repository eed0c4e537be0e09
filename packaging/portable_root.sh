# shellcheck shell=bash disable=SC2154,SC2016  # limpet_root comes from packaging/cmake/setup.sh
# Sourced by packaging/portable, after packaging/cmake/setup.sh and packaging/root.sh: a root folder of Debian 11 with the compiler
# and all that the portable program is built of. Made once, in a minute; build/portable/root, or LIMPET_PORTABLE_ROOT.
. "$limpet_root/packaging/cmake/mirror.sh"

portable_root=${LIMPET_PORTABLE_ROOT:-$limpet_root/build/portable/root}

# newer_packages SUITE KIND: named in portable_newer.txt
newer_packages() { awk -v suite="$1" -v kind="$2" '$1 == suite && $2 == kind { print $3 }' "$limpet_root/packaging/portable_newer.txt"; }

# fetch_newer FOLDER MIRROR SUITE: packages and sources, fetched by apt's own means and not installed. Headers go to
# usr below it, sources to source/, libm.a to libm/.
fetch_newer() {
    local folder=$1 mirror=$2 suite=$3
    mkdir -p "$folder"
    mmdebstrap --mode=root --variant=custom --format=directory --extract-hook='cd "$1" && mkdir headers libm source &&
        export APT_CONFIG=$MMDEBSTRAP_APT_CONFIG
        if [ -n "$headers" ]; then (cd headers && apt-get download $headers) || exit 1; fi
        if [ -n "$libm" ]; then (cd libm && apt-get download $libm) || exit 1; fi
        if [ -n "$source" ]; then (cd source && apt-get source --download-only $source) || exit 1; fi' \
        "$suite" "$folder/fetched" "deb $mirror $suite main" "deb-src $mirror $suite main" || return 1
    for package in "$folder"/fetched/headers/*.deb; do
        dpkg-deb -x "$package" "$folder" || return 1
    done
    mkdir -p "$folder/source" "$folder/libm"
    for package in "$folder"/fetched/libm/*.deb; do
        [ ! -e "$package" ] || dpkg-deb --fsys-tarfile "$package" | tar -x -C "$folder/libm" --wildcards --transform 's|.*/||' './usr/lib/*/libm-*.a' ||
            return 1
    done
    for archive in "$folder"/fetched/source/*.orig.tar.*; do
        [ ! -e "$archive" ] || tar -x -C "$folder/source" -f "$archive" || return 1
    done
    rm -rf --one-file-system "$folder/fetched"
}

# add_newer ROOT MIRROR: into ROOT/opt/limpet, which is passed to CMake
add_newer() {
    local root=$1 mirror=$2 suite kind folder=$1/opt/newer
    for suite in $(awk '!/^#/ { print $1 }' "$limpet_root/packaging/portable_newer.txt" | sort -u); do
        for kind in headers libm source; do
            export "$kind=$(newer_packages "$suite" "$kind" | paste -sd' ')"
        done
        fetch_newer "$folder" "$mirror" "$suite" || return 1
    done
    rm -rf "$folder"/usr/lib/*/*.so "$folder"/usr/lib/python*  # a library of a newer glibc is no use
    mv "$folder/usr" "$root/opt/limpet" || return 1
    within "$root" "$limpet_root/packaging=/packaging" -- sh -c '/packaging/portable_math /opt/newer/libm/libm-*.a /opt/limpet/lib/portable_math.o' ||
        return 1
    within "$root" -- sh -e -c 'for source in /opt/newer/source/*; do
            cmake -S "$source" -B /tmp/build -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=OFF \
                -DCMAKE_POSITION_INDEPENDENT_CODE=ON -DCMAKE_INSTALL_PREFIX=/opt/limpet -DFMT_TEST=OFF -DFMT_DOC=OFF \
                -DSQLITECPP_INTERNAL_SQLITE=OFF -DSQLITECPP_RUN_CPPLINT=OFF -DSQLITECPP_RUN_CPPCHECK=OFF
            ninja -C /tmp/build install
            rm -rf /tmp/build
        done'
}

prepare_portable() {
    local names made mirror making=$portable_root.making
    names=$(grep -v '^#' "$limpet_root/packaging/portable_packages.txt" | paste -sd,)
    made=$(cat "$limpet_root"/packaging/portable_{packages.txt,newer.txt,math,math.c} | cksum)
    [ "$(cat "$portable_root/made" 2>/dev/null)" != "$made" ] || return 0
    [ ! -d "$portable_root" ] || rm -rf --one-file-system "$portable_root" || exit 1
    [ ! -e "$making" ] || rm -rf --one-file-system "$making" || exit 1 # of a first time that was broken off
    mkdir -p "$(dirname "$portable_root")"
    mirror=$(find_mirror bullseye) || exit 1
    LIMPET_MIRROR=$mirror root_folder "$making" bullseye --components=main --include="$names" \
        --aptopt='APT::Install-Recommends "false"' --dpkgopt='path-exclude=/usr/share/man/*'
    step "  headers of newer suites ..." add_newer "$making" "$mirror"
    echo "$made" >"$making/made"
    mv "$making" "$portable_root" || exit 1
}

# there COMMAND...: in that root, in the repository at its own path
there() {
    within "$portable_root" "$limpet_root=$limpet_root" ${CCACHE_DIR:+"$CCACHE_DIR=$CCACHE_DIR"} -- \
        env ${CCACHE_DIR:+CCACHE_DIR="$CCACHE_DIR" CCACHE_SLOPPINESS=pch_defines,time_macros CMAKE_CXX_COMPILER_LAUNCHER=ccache} \
        bash -c 'cd "$0" && exec "$@"' "$limpet_root" "$@"
}
