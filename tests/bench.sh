#!/bin/sh
# Times the core by criterion, sets it beside its peers natively and in a browser, and times the
# figures: tables, one after the other. EPIPOLE_DATA names the folder with photographs of known
# geometry; without it, what needs them is left out.
set -eu
cd "$(dirname "$0")/.."
target=${CARGO_TARGET_DIR:-target}
python=.venv/bin/python

cargo build --quiet --release -p epipole --example features_time --example features_dump
for threads in 1 "$($python -c 'import os; print(os.cpu_count())')"; do
    $python tests/peers/time_features.py "$target/release/examples/features_time" "$threads"
    echo
done
if [ -d "${EPIPOLE_DATA:-}/homography" ]; then
    $python tests/peers/compare_features.py "$EPIPOLE_DATA/homography" "$target/release/examples/features_dump"
else
    echo "quality of features: left out, EPIPOLE_DATA/homography is not there"
fi
echo

cargo build --quiet -p epipole-tests --example kernels --target wasm32-unknown-unknown --profile web
node web/node_modules/binaryen/bin/wasm-opt -O3 --all-features \
    "$target/wasm32-unknown-unknown/web/examples/kernels.wasm" -o "$target/kernels.wasm"
node tests/browser/opencv.mjs "$target/kernels.wasm"
echo

for bench in core features geometry stereo bundle; do
    cargo bench --quiet -p epipole --bench "$bench" -- --quick >/dev/null
done
$python tests/bench_table.py "$target/criterion"
cargo run --quiet -p epipole-book -- build >/dev/null
node tests/browser/bench.mjs
