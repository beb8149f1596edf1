#!/usr/bin/env bash
# Builds what the hosts install: the npm package, packed and unpacked by npm, and the Python wheel.
set -euo pipefail
cd "$(dirname "$0")/../../.."
work=${CARGO_TARGET_DIR:-target}/hosts
mkdir -p "$work"
rm -rf "$work/package" "$work"/*.tgz "$work/wheel"
(cd web && node build.mjs)
npm pack ./web --pack-destination "$work" --loglevel error >/dev/null
tar -xzf "$work"/*.tgz -C "$work"
rm -rf python/epipole_figures/static
mkdir -p python/epipole_figures/static
cp web/dist/{index.js,worker.js,epipole-figures.wasm,epipole-jobs.wasm,THIRD-PARTY.txt} python/epipole_figures/static/
cargo run --locked --quiet --bin epipole-book -- stills python/epipole_figures/static/stills >/dev/null
"$work/python/bin/python" -m build --quiet --wheel --no-isolation --outdir "$work/wheel" python
"$work/python/bin/python" -m pip install --quiet --disable-pip-version-check --no-deps --force-reinstall "$work"/wheel/*.whl
