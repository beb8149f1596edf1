"""The command `epipole`, and a model with known numbers."""

import json
import os
import pathlib
import subprocess

import numpy as np
import pytest

ROOT = pathlib.Path(__file__).parents[2]
# Blanks, accents, dots, folders: each broke a reader once.
NAMES = ["left/0001.jpg", "right/0001.jpg", "Bild 1.jpg", "Bild 2.jpg", "été.août.jpeg", "a.b.c.png"]


def program():
    """Path of the newest build, or of the one that `EPIPOLE` names."""
    if "EPIPOLE" in os.environ:
        return pathlib.Path(os.environ["EPIPOLE"])
    target = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    builds = [target / kind / "epipole" for kind in ("debug", "release")]
    builds = [path for path in builds if path.exists()]
    if not builds:
        pytest.skip("there is no command `epipole`: run `cargo build --bin epipole`")
    return max(builds, key=lambda path: path.stat().st_mtime)


@pytest.fixture(scope="session")
def epipole():
    """Runs a command and returns its JSON; a failure raises `CalledProcessError`."""
    path = program()

    def run(*arguments):
        done = subprocess.run([path, *map(str, arguments), "--json", "--quiet"], capture_output=True, check=True)
        return json.loads(done.stdout)

    return run


def quaternion(random):
    """A random rotation as x, y, z, w."""
    values = random.normal(size=4)
    return values / np.linalg.norm(values)


def rotation(x, y, z, w):
    """The matrix of a quaternion of any length."""
    x, y, z, w = np.array([x, y, z, w]) / np.linalg.norm([x, y, z, w])
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ])
