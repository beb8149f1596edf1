#!/bin/sh
# Installs a virtual display, synthetic mouse and keyboard input (xdotool), and software OpenGL.
set -eu
missing() {
    ! command -v "$1" >/dev/null 2>&1
}
wanted=
missing Xvfb && wanted="$wanted xvfb"
missing xdotool && wanted="$wanted xdotool"
# Libraries that a window loads when it opens.
if command -v ldconfig >/dev/null 2>&1; then
    has() {
        ldconfig -p | grep -q "$1"
    }
    has libGL.so.1 || wanted="$wanted libgl1 libgl1-mesa-dri"
    has libEGL.so.1 || wanted="$wanted libegl1"
    has libxkbcommon-x11.so.0 || wanted="$wanted libxkbcommon-x11-0"
    has libXcursor.so.1 || wanted="$wanted libxcursor1"
    has libXi.so.6 || wanted="$wanted libxi6"
    has libXrandr.so.2 || wanted="$wanted libxrandr2"
    has libX11-xcb.so.1 || wanted="$wanted libx11-xcb1"
fi
[ -z "$wanted" ] && exit
# shellcheck disable=SC2086
"$(dirname "$0")/apt.sh" "the window of the Lab" $wanted
