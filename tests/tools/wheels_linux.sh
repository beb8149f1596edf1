#!/usr/bin/env bash
# Builds the wheels for Linux with glibc 2.28 or later, x86-64 and aarch64, and the source distribution.
set -euo pipefail
cd "$(dirname "$0")/../.."
out=${CARGO_TARGET_DIR:-target}/wheels-linux
manifest=crates/epipole-python/Cargo.toml
PATH=$PWD/target/zig/bin:$PATH
rm -rf "$out"
for processor in x86_64 aarch64; do
    target=$processor-unknown-linux-gnu
    rustup target add "$target"
    .venv/bin/python -m maturin build --quiet --locked --manifest-path "$manifest" --out "$out" \
        --target "$target" --zig --compatibility manylinux_2_28
done
.venv/bin/python -m maturin sdist --manifest-path "$manifest" --out "$out"
