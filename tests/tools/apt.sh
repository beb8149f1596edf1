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
# Another installation may be under way: it is waited for, and the lists that it read will do.
{
    $sudo apt-get update -qq || true
    DEBIAN_FRONTEND=noninteractive $sudo apt-get install -y -qq --no-install-recommends -o DPkg::Lock::Timeout=300 "$@"
} >&2
