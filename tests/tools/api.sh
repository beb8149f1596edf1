#!/bin/sh
# Reports changes of the library's public API since a revision, and whether they break its users: by
# name with cargo-public-api, by rule with cargo-semver-checks. A missing tool is reported and fails.
set -u
cd "$(dirname "$0")/../.."
since=${1:-$(git describe --tags --abbrev=0 2>/dev/null || git rev-list --max-parents=0 HEAD)}
status=0
echo "the library since $since"
if command -v cargo-semver-checks >/dev/null; then
    cargo semver-checks --package epipole --baseline-rev "$since" || status=1
else
    echo "cargo semver-checks is missing: install it with \`cargo install --locked cargo-semver-checks@0.51.0\`" >&2
    status=1
fi
if command -v cargo-public-api >/dev/null; then
    cargo public-api --package epipole -ss diff "$since..HEAD" || status=1
else
    echo "cargo public-api is missing: install it with \`cargo install --locked cargo-public-api@0.52.0\`, and a nightly toolchain" >&2
    status=1
fi
exit $status
