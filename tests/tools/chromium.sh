#!/bin/sh
# Prints the path of a Chromium for the browser tests, and installs one where there is none.
set -eu
found() {
    for candidate in "${CHROMIUM:-}" chromium chromium-browser google-chrome google-chrome-stable \
        "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome"; do
        if [ -n "$candidate" ] && command -v "$candidate" >/dev/null 2>&1; then
            command -v "$candidate"
            return 0
        fi
    done
    return 1
}
if ! found; then
    echo "installing Chromium for the browser tests" >&2
    if command -v apt-get >/dev/null 2>&1; then
        sudo=
        [ "$(id -u)" = 0 ] || sudo=sudo
        $sudo apt-get update -qq >&2 && $sudo apt-get install -y -qq chromium >&2 || true
    fi
    found || {
        (cd "$(dirname "$0")/../browser" && npx playwright-core install chromium-headless-shell) >&2 || {
            echo "missing: a Chromium browser; install Chromium or Google Chrome, or set CHROMIUM=path" >&2
            exit 1
        }
    }
fi
