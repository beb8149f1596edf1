#!/bin/sh
# Dense stereo beside OpenCV and bundle adjustment beside Ceres; arguments: [THREADS] [TURNS].
set -eu
cd "$(dirname "$0")/../.."
venv=target/peers-depth
if [ ! -f "$venv/.installed" ]; then
    python3 -m venv "$venv"
    "$venv/bin/python" -m pip install --quiet --disable-pip-version-check -r tests/peers/requirements-depth.txt
    touch "$venv/.installed"
fi
cargo build --quiet --release -p epipole --example depth_time
"$venv/bin/python" tests/peers/time_depth.py "${CARGO_TARGET_DIR:-target}/release/examples/depth_time" "$@"
