#!/bin/sh
# Sets the core beside its peers, natively and in a browser, and times the figures: tables, one
# after the other. EPIPOLE_DATA names the folder with real photographs and problems, else it is
# looked for beside the project; without it, what needs them is left out and says so.
set -eu
cd "$(dirname "$0")/.."
target=${CARGO_TARGET_DIR:-target}
python=target/peers/bin/python
: "${EPIPOLE_DATA:=$PWD/../shared/data}"
export EPIPOLE_DATA
all_threads=$($python -c 'import os; print(os.cpu_count())')

cargo build --quiet --release -p epipole \
    --example features_time --example features_dump --example geometry_time --example geometry_fit \
    --example depth_time
examples=$target/release/examples
for threads in 1 "$all_threads"; do
    $python tests/peers/time_features.py "$examples/features_time" "$threads"
    echo
done
if [ -d "$EPIPOLE_DATA/homography" ]; then
    $python tests/peers/compare_features.py "$EPIPOLE_DATA/homography" "$examples/features_dump"
else
    echo "quality of features: left out, $EPIPOLE_DATA/homography is not there"
fi
echo
$python tests/peers/time_geometry.py "$examples/geometry_time"
echo
if [ -d "$EPIPOLE_DATA" ]; then
    $python tests/peers/compare_geometry.py "$EPIPOLE_DATA" "$examples/geometry_fit"
else
    echo "quality of geometry: left out, $EPIPOLE_DATA is not there"
fi
echo
for threads in 1 "$all_threads"; do
    $python tests/peers/time_depth.py "$examples/depth_time" "$threads"
    echo
done

cargo build --quiet -p epipole-tests --example kernels --target wasm32-unknown-unknown --profile web-worker
node tests/browser/opencv.mjs "$target/wasm32-unknown-unknown/web-worker/examples/kernels.wasm"
echo
cargo run --quiet --bin epipole-book -- build >/dev/null
# Linked as one, as readers get it.
cargo rustc --quiet --package epipole-web --lib --crate-type cdylib --no-default-features --features figures \
    --target wasm32-unknown-unknown --profile web
python3 tests/weight.py "$target/wasm32-unknown-unknown/web/epipole_web.wasm" "$target"/book/assets/epipole-figures-*.wasm
echo
node tests/browser/bench.mjs
echo

for bench in core features geometry stereo bundle; do
    cargo bench --quiet -p epipole --bench "$bench" -- --quick >/dev/null
done
$python tests/bench_table.py "$target/criterion"
