# shellcheck shell=bash disable=SC2154,SC2016  # limpet_log comes from packaging/cmake/setup.sh
# Sourced after packaging/cmake/setup.sh: where Debian's suites come from.
#
# LIMPET_MIRROR   where Debian comes from (the machine's own mirror)

stop() {
    say "limpet: $*"
    exit 1
}

# serves MIRROR SUITE: by apt's own means, so with the machine's proxy
serves() {
    local file
    file=$(mktemp) || return 1
    timeout 60 /usr/lib/apt/apt-helper download-file "$1/dists/$2/Release" "$file" >>"$limpet_log" 2>&1
    local result=$?
    rm -f "$file"
    return $result
}

# find_mirror SUITE: the first of the machine's own mirrors that has it
find_mirror() {
    local site
    if [ -n "${LIMPET_MIRROR:-}" ]; then
        serves "$LIMPET_MIRROR" "$1" || stop "LIMPET_MIRROR: $LIMPET_MIRROR does not serve Debian's $1"
        echo "$LIMPET_MIRROR"
        return
    fi
    for site in $(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' | awk '!seen[$0]++' | grep -v security); do
        if serves "$site" "$1"; then
            echo "$site"
            return
        fi
    done
    stop "no package mirror of this machine serves Debian's $1: is there a network? Else set LIMPET_MIRROR=URL (tried: see $limpet_log)"
}
