#!/usr/bin/env bash
# Installs the wheels of `make python python-figures` in an empty environment, runs the package's tests there, and
# checks the size of the package without the figures.
set -euo pipefail
cd "$(dirname "$0")/../.."
target=${CARGO_TARGET_DIR:-target}
wheel=$(ls "$target"/wheels/epipole-*.whl)
figures=$(ls "$target"/wheels/epipole_figures-*.whl)
LARGEST=5000000
rm -rf "$target/wheel-environment"
python3 -m venv "$target/wheel-environment"
python=$target/wheel-environment/bin/python
$python -m pip install --quiet --disable-pip-version-check -r tests/requirements.txt "$wheel[figures]" "$figures"
$python -m twine check --strict "$wheel" "$figures"
# Without the sources of the package beside them.
cp -r crates/epipole-python/tests "$target/wheel-environment/tests"
$python -m pytest --quiet -rs --rootdir "$target/wheel-environment" "$target/wheel-environment/tests"
bytes=$(wc -c <"$wheel")
echo "$wheel: $bytes bytes"
if [ "$bytes" -gt "$LARGEST" ]; then
    echo "the wheel has $bytes bytes, more than $LARGEST" >&2
    exit 1
fi
