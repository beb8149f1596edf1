#!/bin/sh
# Asks npm and the RustSec database for known holes in what we build from. What could not be asked is said, and fails.
set -u
cd "$(dirname "$0")/../.."
status=0
for folder in web tests/browser tests/browser/hosts tests/engines tests/bench; do
    echo "npm audit: $folder"
    (cd "$folder" && npm audit --package-lock-only --loglevel error) || status=1
done
if command -v cargo-deny >/dev/null; then
    cargo deny --log-level error check || status=1
else
    echo "cargo deny is missing: install it with \`cargo install --locked cargo-deny\`" >&2
    status=1
fi
exit $status
