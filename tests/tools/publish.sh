#!/bin/sh
# Publishes the crates to crates.io, each after those it depends on. Skips published versions, so that a run
# that was interrupted can be repeated.
set -eu
cd "$(dirname "$0")/../.."
version=$(sed -n '/^\[workspace\.package\]/,/^$/s/^version = "\(.*\)"/\1/p' Cargo.toml)
for crate in epipole epipole-scenes epipole-io epipole-canvas epipole-widgets epipole-cli; do
    if cargo info --quiet --registry crates-io "$crate@$version" >/dev/null 2>&1; then
        echo "$crate $version is published"
    else
        cargo publish --locked --package "$crate"
    fi
done
