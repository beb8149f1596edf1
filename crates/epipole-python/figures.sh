#!/usr/bin/env bash
# Writes the files that epipole.figures sends to the page: scripts, modules and pictures of the book.
set -euo pipefail
cd "$(dirname "$0")/../.."
static=crates/epipole-python/python/epipole_figures/static
(cd web && node build.mjs)
rm -rf "$static"
mkdir -p "$static"
cp web/dist/{index.js,worker.js,epipole-figures.wasm,epipole-jobs.wasm,THIRD-PARTY.txt} "$static"
cargo run --locked --quiet --bin epipole-book -- stills "$static/stills" >/dev/null
