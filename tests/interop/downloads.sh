# Sourced by what installs: downloads are tried three times. A mirror or a registry that does not
# answer once, or somebody else's apt at work on a new machine, is no failure of what is tested.
try() {
    local pause
    for pause in 10 30; do
        "$@" && return
        printf 'again in %s s: %s\n' "$pause" "$*" >&2
        sleep "$pause"
    done
    "$@"
}

apt_install() {
    try apt-get -o DPkg::Lock::Timeout=300 -o Acquire::Retries=3 install -y -qq \
        --no-install-recommends "$@" >/dev/null
}

npm_install() {
    try npm install --no-audit --no-fund --no-package-lock --ignore-scripts --loglevel=error
}
