# Sourced by ./run, ./test and .ci/run: installs what is missing, configures, builds.
# Quiet when all is there: a second run takes seconds.

limpet_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
limpet_log=$limpet_root/build/setup.log

say() { printf '%s\n' "$*" >&2; }

# step TEXT COMMAND...: runs it into the log; on failure shows the log's end and stops.
step() {
    local text=$1
    shift
    say "$text"
    if ! "$@" >>"$limpet_log" 2>&1; then
        tail -n 30 "$limpet_log" >&2
        say "limpet: this failed: $* (all of it: $limpet_log)"
        exit 1
    fi
}

as_root() {
    if [ "$(id -u)" = 0 ]; then
        "$@"
    elif command -v sudo >/dev/null; then
        sudo "$@"
    else
        say "limpet: packages are missing and this needs root: $*"
        return 1
    fi
}

missing_packages() {
    local package
    grep -hv '^#' "$@" | while read -r package; do
        dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || echo "$package"
    done
}

# known_packages NAME...: without those that this distribution does not have (Ubuntu has chromium as a snap alone);
# a library that is missed so is named by cmake, a program by the test that is skipped.
known_packages() {
    local package
    for package in "$@"; do
        if apt-cache show "$package" >/dev/null 2>&1; then
            echo "$package"
        else
            say "  not in this distribution: $package"
        fi
    done
}

# install_packages FILE...: the packages listed in the files
install_packages() {
    local missing
    missing=$(missing_packages "$@")
    [ -n "$missing" ] || return 0
    if ! command -v apt-get >/dev/null; then
        say "limpet: install these by your package manager:" $missing
        exit 1
    fi
    say "installing:" $missing
    export DEBIAN_FRONTEND=noninteractive
    step "  fetching the package lists ..." as_root apt-get update
    missing=$(known_packages $missing)
    [ -n "$missing" ] || return 0
    # shellcheck disable=SC2086  # a list of words
    # Another program may be installing, as a machine does by itself at night: it is waited for.
    step "  installing ..." as_root apt-get -o DPkg::Lock::Timeout=600 install -y --no-install-recommends $missing
}

# install_node: for the pages; another Node than the distribution's will do
install_node() {
    command -v npm >/dev/null || install_packages "$limpet_root/packaging/cmake/node_packages.txt"
}

# fetch_node_packages FROM TO: the packages of a folder's package.json; without npm or network the tests
# that need them report it and are skipped.
fetch_node_packages() {
    local from=$limpet_root/$1 to=$limpet_root/$2
    command -v npm >/dev/null || return 0
    cmp -s "$from/package-lock.json" "$to/fetched.json" && return 0
    mkdir -p "$to"
    cp "$from/package.json" "$from/package-lock.json" "$to"
    [ ! -f "$from/.npmrc" ] || cp "$from/.npmrc" "$to"
    say "fetching the packages of $1 ..."
    if (cd "$to" && timeout 300 npm ci --ignore-scripts --legacy-peer-deps --no-audit --no-fund) \
        >>"$limpet_log" 2>&1; then
        cp "$from/package-lock.json" "$to/fetched.json"
    else
        say "  not there, the tests against it are skipped"
    fi
}

# looked_for: what a configuration may find on this machine, with versions: packages of the lists, and Node
looked_for() {
    (cd "$limpet_root" && grep -hv '^#' packaging/cmake/*packages.txt tests/packages.txt adapters/ros2/packages.txt) | sort -u |
        xargs dpkg-query -W -f '${db:Status-Abbrev}${Package} ${Version}\n' 2>/dev/null | grep '^ii'
    command -v npm node
}

# configure_if_new TREE KNOWN CMAKE...: configures a tree that is not, and anew one that was when KNOWN was another: from
# nothing, so that what was not found then is looked for again. Options that somebody has set stay, unless CMAKE or the
# presets differ today. A tree that cannot be configured keeps its cache.
configure_if_new() {
    local tree=$limpet_root/build/$1 known=$2 option name kept=() cache preset
    cache=$tree/CMakeCache.txt
    preset=$(sed -n "/\"name\": \"$(basename "$1")\",/,/}}/p" "$limpet_root/CMakePresets.json")
    shift 2
    [ -f "$tree/build.ninja" ] && [ "$known" = "$(cat "$tree/configured_with" 2>/dev/null)" ] && return
    [ -f "$cache" ] || [ ! -f "$cache.before" ] || mv "$cache.before" "$cache"  # of a time that was broken off
    if [ -f "$cache" ]; then
        while read -r option; do
            name=${option%%:*}
            [[ " $*" == *" -D$name"[:=]* ]] || [[ $preset == *"\"$name\""* ]] || kept+=("-D$option")
        done < <(grep -E '^((LIMPET_[A-Z0-9_]*|CMAKE_CXX_(FLAGS|COMPILER_LAUNCHER)|CMAKE_BUILD_TYPE|CPACK_PACKAGE_CONTACT):(BOOL|STRING)|(CMAKE_PREFIX_PATH|Python_EXECUTABLE):[A-Z]*)=.' "$cache" |
            grep -v '^LIMPET_WERROR:BOOL=ON')  # which follows from the compiler
        mv "$cache" "$cache.before"
        find "$tree/web" -maxdepth 1 -name '*.html' -empty -delete 2>/dev/null  # pages that had no Node
    fi
    (step "configuring ($(basename "$tree")) ..." "$@" "${kept[@]}") || {
        [ ! -f "$cache.before" ] || mv "$cache.before" "$cache"
        exit 1
    }
    rm -f "$cache.before"
    printf '%s\n' "$known" >"$tree/configured_with"
}

# build PRESET [TARGET...]: builds what changed
build() {
    local preset=$1
    shift
    cd "$limpet_root" || exit 1
    configure_if_new "$preset" "$(looked_for)" cmake --preset "$preset"
    if ! ninja -C "build/$preset" -n "$@" 2>/dev/null | grep -q 'no work to do'; then
        if [ -t 2 ]; then
            say "building ($preset), a few minutes the first time ..."
            ninja -C "build/$preset" "$@" >&2 || exit 1
        else
            step "building ($preset), a few minutes the first time ..." ninja -C "build/$preset" "$@"
        fi
    fi
}

# tell_left_out PRESET: what was not built, and for want of which packages. Fails where all of them are here: then a list
# of packages promises more than CMake finds.
tell_left_out() {
    local what needs broken=0
    while IFS='|' read -r what needs; do
        # shellcheck disable=SC2086  # a list of words
        if [ -n "$(printf '%s\n' $needs | missing_packages -)" ]; then
            say "not built, for want of$needs: $what"
        else
            say "limpet: not built, though its packages are here ($needs): $what ($limpet_root/build/$1/CMakeCache.txt says what was found)"
            broken=1
        fi
    done <"$limpet_root/build/$1/left_out.txt"
    return $broken
}

mkdir -p "$limpet_root/build" && : >>"$limpet_log" # by who calls, before any sudo
