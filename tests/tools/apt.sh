#!/bin/sh
# Installs packages of the system, where apt-get can: apt.sh WHAT_FOR PACKAGES…
set -eu
what_for=$1
shift
command -v apt-get >/dev/null 2>&1 || {
    echo "missing for $what_for: $*; install that with your system's packages" >&2
    exit 1
}
echo "installing $* for $what_for" >&2
sudo=
[ "$(id -u)" = 0 ] || sudo="sudo -n"
{ $sudo apt-get update -qq && DEBIAN_FRONTEND=noninteractive $sudo apt-get install -y -qq --no-install-recommends "$@"; } >&2
