#!/usr/bin/env bash
# Installs the wheel of `make python` in an empty environment, runs the package's tests there, and checks its size.
set -euo pipefail
cd "$(dirname "$0")/../.."
target=${CARGO_TARGET_DIR:-target}
wheel=$(ls "$target"/wheels/*.whl)
LARGEST=5000000
rm -rf "$target/wheel-environment"
python3 -m venv "$target/wheel-environment"
python=$target/wheel-environment/bin/python
$python -m pip install --quiet --disable-pip-version-check -r tests/requirements.txt "$wheel"
$python -m twine check --strict "$wheel"
# Without the sources of the package beside them.
cp -r crates/epipole-python/tests "$target/wheel-environment/tests"
$python -m pytest --quiet -rs --rootdir "$target/wheel-environment" "$target/wheel-environment/tests"
bytes=$(wc -c <"$wheel")
echo "$wheel: $bytes bytes"
if [ "$bytes" -gt "$LARGEST" ]; then
    echo "the wheel has $bytes bytes, more than $LARGEST" >&2
    exit 1
fi
