#!/bin/sh
# Sees to it that Jekyll is there for the tests of hosts.
set -eu
command -v jekyll >/dev/null 2>&1 || "$(dirname "$0")/apt.sh" "the tests of hosts" jekyll
