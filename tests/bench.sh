#!/bin/sh
# Times the core by criterion and the figures in a browser, and prints both as tables.
set -eu
cd "$(dirname "$0")/.."
for bench in core features geometry stereo bundle; do
    cargo bench --quiet -p epipole --bench "$bench" -- --quick >/dev/null
done
.venv/bin/python tests/bench_table.py target/criterion
tests/peers/time_depth.sh
cargo run --quiet -p epipole-book -- build >/dev/null
node tests/browser/bench.mjs
