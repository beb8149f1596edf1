"""Stubs that are up to date, agree with the module, and satisfy mypy and pyright."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

import epipole

HERE = Path(__file__).parent
EXAMPLES = HERE / "typing_examples.py"
ROOT = Path(epipole.__file__).parents[1]


def run(*command, cwd=None):
    """Runs a module of this Python, which finds the package under test."""
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    if ROOT.name != "site-packages":
        environment["MYPYPATH"] = str(ROOT)
    done = subprocess.run(
        [sys.executable, *command], capture_output=True, text=True, env=environment, cwd=cwd
    )
    assert done.returncode == 0, done.stdout + done.stderr


def test_stubs_are_up_to_date():
    generator = HERE.parent / "stubs.py"
    if not generator.exists():
        pytest.skip("there is no generator of the stubs")
    run(str(generator), "--check")


def test_mypy(tmp_path):
    pytest.importorskip("mypy")
    run("-m", "mypy", "--strict", f"--cache-dir={tmp_path}", str(EXAMPLES), cwd=tmp_path)


def test_stubs_agree_with_the_module(tmp_path):
    pytest.importorskip("mypy")
    # PyO3 fills the slot of the reflected operator, too.
    (tmp_path / "allowed").write_text(r"epipole\..*\.__r\w+__" + "\n")
    stubs = Path(epipole.__file__).parent.glob("*.pyi")
    modules = [f"epipole.{path.stem}" for path in stubs]
    options = ["--allowlist", "allowed", "--ignore-unused-allowlist"]
    run("-m", "mypy.stubtest", *modules, *options, cwd=tmp_path)


def test_pyright(tmp_path):
    pytest.importorskip("pyright")
    (tmp_path / "epipole").symlink_to(Path(epipole.__file__).parent)
    (tmp_path / "examples.py").write_text(EXAMPLES.read_text())
    config = {"include": ["examples.py"], "typeCheckingMode": "strict"}
    config["reportUnnecessaryTypeIgnoreComment"] = "error"
    (tmp_path / "pyrightconfig.json").write_text(json.dumps(config))
    run("-m", "pyright", "--pythonpath", sys.executable, cwd=tmp_path)
