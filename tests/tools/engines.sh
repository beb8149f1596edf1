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
command -v apt-get >/dev/null 2>&1 || {
    echo "missing:$wanted; install them with your system's packages" >&2
    exit 1
}
echo "installing$wanted for the tests of engines" >&2
sudo=
[ "$(id -u)" = 0 ] || sudo="sudo -n"
# shellcheck disable=SC2086
{ $sudo apt-get update -qq && DEBIAN_FRONTEND=noninteractive $sudo apt-get install -y -qq $wanted; } >&2
