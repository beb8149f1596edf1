#!/bin/sh
# Names a missing program in one line, with the remedy: need.sh cargo node npm python3
for program in "$@"; do
    if ! command -v "$program" >/dev/null 2>&1; then
        case $program in
        cargo | rustup) remedy="install Rust from https://rustup.rs" ;;
        node | npm) remedy="install Node.js 20 or newer from https://nodejs.org" ;;
        python3) remedy="install Python 3.11 or newer from https://www.python.org" ;;
        *) remedy="install it" ;;
        esac
        echo "missing: $program; $remedy" >&2
        exit 1
    fi
    if [ "$program" = node ] && ! node -e 'process.exit(parseInt(process.versions.node, 10) < 20 ? 1 : 0)'; then
        echo "Node.js $(node --version) is too old; install 20 or newer from https://nodejs.org" >&2
        exit 1
    fi
done
