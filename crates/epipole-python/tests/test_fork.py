"""Forked processes compute, although the threads of their parent are gone."""

import os
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import epipole

pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="there is no fork")


def ends_well(work, timeout_s=20):
    """Whether `work` returns True in a forked process in time."""
    child = os.fork()
    if child == 0:
        os._exit(0 if work() else 1)
    deadline = time.monotonic() + timeout_s
    while time.monotonic() < deadline:
        ended, status = os.waitpid(child, os.WNOHANG)
        if ended:
            return os.waitstatus_to_exitcode(status) == 0
        time.sleep(0.01)
    os.kill(child, 9)
    os.waitpid(child, 0)
    return False


def test_ransac_in_a_child(outliers):
    expected = epipole.estimate_fundamental(*outliers)
    assert ends_well(lambda: epipole.estimate_fundamental(*outliers) == expected)


def test_threads_in_a_child():
    """The blur of a large image uses several threads, in the parent first."""
    imaging = pytest.importorskip("epipole.imaging")
    image = np.random.default_rng(5).uniform(0, 1, (2048, 2048)).astype(np.float32)
    expected = imaging.gaussian_blur(image, 2.0)

    def blur():
        return np.array_equal(imaging.gaussian_blur(image, 2.0), expected)

    assert ends_well(blur)
    assert ends_well(lambda: blur() and ends_well(blur))


def test_block_of_threads_in_a_child(outliers):
    expected = epipole.estimate_fundamental(*outliers)
    with epipole.threads(2):
        assert ends_well(lambda: epipole.estimate_fundamental(*outliers) == expected)


def test_thread_of_a_child(outliers):
    expected = epipole.estimate_fundamental(*outliers)

    def work():
        found = []
        thread = threading.Thread(
            target=lambda: found.append(epipole.estimate_fundamental(*outliers))
        )
        thread.start()
        thread.join()
        return found == [expected]

    assert ends_well(work)


def test_work_gives_up_the_gil_by_one_function():
    """`progress::detach` prepares threads of forked processes; `Python::detach` does not."""
    source = Path(__file__).parents[1] / "src"
    if not source.exists():
        pytest.skip("there is no source of the module")
    files = [f for f in source.rglob("*.rs") if ".detach(" in f.read_text("utf-8")]
    assert files == [source / "progress.rs"], "call progress::detach(py, ...)"
