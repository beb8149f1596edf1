#!/bin/sh
# Prints the path of a Chromium for the browser tests, and installs one where there is none: best the
# headless shell, the same engine without windows.
set -eu
found() {
    for candidate in "$@"; do
        if [ -n "$candidate" ] && command -v "$candidate" >/dev/null 2>&1; then
            command -v "$candidate"
            return 0
        fi
    done
    return 1
}
apt_install() {
    command -v apt-get >/dev/null 2>&1 || return 0
    sudo=
    [ "$(id -u)" = 0 ] || sudo="sudo -n"
    # Another installation may be under way: it is waited for, and the lists that it read will do.
    { $sudo apt-get update -qq || true; $sudo apt-get install -y -qq -o DPkg::Lock::Timeout=300 "$1"; } >&2 || true
}
found "${CHROMIUM:-}" chromium-headless-shell && exit
echo "installing a headless Chromium for the browser tests" >&2
apt_install chromium-headless-shell
found chromium-headless-shell chromium chromium-browser google-chrome google-chrome-stable \
    "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome" && exit
apt_install chromium
found chromium && exit
(cd "$(dirname "$0")/../browser" && npx playwright-core install chromium-headless-shell) >&2 || {
    echo "missing: a Chromium browser; install Chromium or Google Chrome, or set CHROMIUM=path" >&2
    exit 1
}
