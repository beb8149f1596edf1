#!/usr/bin/env bash
# Builds what the hosts install: the npm package, packed and unpacked by npm; and the files of epipole.figures.
set -euo pipefail
cd "$(dirname "$0")/../../.."
work=${CARGO_TARGET_DIR:-target}/hosts
mkdir -p "$work"
rm -rf "$work/package" "$work"/*.tgz
crates/epipole-python/figures.sh
npm pack ./web --pack-destination "$work" --loglevel error >/dev/null
tar -xzf "$work"/*.tgz -C "$work"
