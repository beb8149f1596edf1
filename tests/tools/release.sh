#!/bin/sh
# Collects the files of a release in target/release-files: an archive of the book with the Lab, the npm
# packages, the wheels, their checksums, the notes. Times in the archive are that of the commit.
set -eu
cd "$(dirname "$0")/../.."
out=target/release-files
version=$(sed -n '/^\[workspace\.package\]/,/^$/s/^version = "\(.*\)"/\1/p' Cargo.toml)
rm -rf "$out"
mkdir -p "$out/book" "$out/npm" "$out/wheel"
tar --sort=name --mtime="@$(git log -1 --format=%ct)" --owner=0 --group=0 --numeric-owner \
    --mode=a+rX,u+w,go-w -C target/book -cf - . | gzip -n9 >"$out/book/epipole-book-$version.tar.gz"
npm pack ./web --pack-destination "$out/npm" --loglevel error >/dev/null
npm pack ./web/vision --ignore-scripts --pack-destination "$out/npm" --loglevel error >/dev/null
target=${CARGO_TARGET_DIR:-target}
cp "$target"/wheels-linux/* "$target"/wheels/epipole_figures-*.whl "$out/wheel/"
# Names without folders, as the release shows them.
(cd "$out" && sha256sum book/* npm/* wheel/* | sed 's|  .*/|  |' | tee SHA256SUMS)
node tests/tools/release.mjs "v$version" --notes >"$out/notes.md"
