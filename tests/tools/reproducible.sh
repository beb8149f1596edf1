#!/bin/sh
# Builds the site of the last commit twice from nothing, in two folders with other names and another home of cargo, in
# another time zone and language, and compares all files by hash. Takes as long as two first builds; BUILDER=path uses
# a builder that is there already and makes everything else anew.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
work=$root/target/reproducible
rm -rf "$work"
mkdir -p "$work"
unset CARGO_TARGET_DIR
commit=$(git -C "$root" rev-parse HEAD)

site() { # place: a folder to build in
    mkdir -p "$1"
    git -C "$root" archive "$commit" | tar -x -C "$1"
    (cd "$1/web" && npm ci --no-audit --no-fund --loglevel error)
    if [ -n "${BUILDER:-}" ]; then
        (cd "$1" && "$BUILDER" build)
    else
        (cd "$1" && cargo run --locked --quiet --bin epipole-book -- build)
    fi
    (cd "$1/target/book" && find . -type f -print0 | LC_ALL=C sort -z | xargs -0 sha256sum) >"$2"
}

echo "first build: $work/one"
site "$work/one" "$work/one.sums"

# A home of another name, with the same packages and tools in it.
cargo_home=${CARGO_HOME:-$HOME/.cargo}
other=$work/another/home/.cargo
mkdir -p "$other"
for part in "$cargo_home"/* "$cargo_home"/.[!.]*; do
    [ -e "$part" ] && ln -s "$part" "$other/"
done
echo "second build: $work/another/place of longer name"
(
    export CARGO_HOME="$other" TZ=Pacific/Chatham LC_ALL=C
    umask 077
    site "$work/another/place of longer name" "$work/another.sums"
)

if ! diff "$work/one.sums" "$work/another.sums" >"$work/differences"; then
    echo "the same source gives other files:" >&2
    grep '^[<>]' "$work/differences" | awk '{ print $3 }' | sort -u >&2
    exit 1
fi
echo "$(wc -l <"$work/one.sums") files are the same, byte by byte"
rm -rf "$work"
