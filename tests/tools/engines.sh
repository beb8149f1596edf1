#!/bin/sh
# Sees to it that Firefox, and WebKit with its driver and a display for it, are there for the tests of engines.
set -eu
missing() {
    ! command -v "$1" >/dev/null 2>&1
}
wanted=
missing firefox-esr && missing firefox && [ -z "${FIREFOX:-}" ] && wanted="$wanted firefox-esr"
missing WebKitWebDriver && wanted="$wanted webkit2gtk-driver"
missing Xvfb && wanted="$wanted xvfb"
[ -z "$wanted" ] && exit
# shellcheck disable=SC2086
"$(dirname "$0")/apt.sh" "the tests of engines" $wanted
