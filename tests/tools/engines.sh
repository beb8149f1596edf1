#!/bin/sh
# Sees to it that Firefox, and WebKit with its driver and a display for it, are there for the tests of engines; only
# one of them with ONLY=firefox or ONLY=webkit.
set -eu
missing() {
    ! command -v "$1" >/dev/null 2>&1
}
wanted=
case firefox in *"${ONLY:-}"*)
    missing firefox-esr && missing firefox && [ -z "${FIREFOX:-}" ] && wanted="$wanted firefox-esr" ;;
esac
case webkit in *"${ONLY:-}"*)
    missing WebKitWebDriver && wanted="$wanted webkit2gtk-driver"
    missing Xvfb && wanted="$wanted xvfb" ;;
esac
[ -z "$wanted" ] && exit
# shellcheck disable=SC2086
"$(dirname "$0")/apt.sh" "the tests of engines" $wanted
