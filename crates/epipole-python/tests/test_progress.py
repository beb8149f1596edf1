"""Progress callbacks, exceptions in callables, Ctrl-C, threads."""

import contextlib
import os
import signal
import threading
import time

import numpy as np
import pytest

import epipole


@pytest.fixture
def long_work():
    """Matches without structure, and options that keep RANSAC busy for minutes."""
    pixels1, pixels2 = np.random.default_rng(3).uniform(0, 1000, (2, 20_000, 2))
    return (pixels1, pixels2), {"max_iterations": 10**9, "min_iterations": 10**9}


def test_callback_receives_stage_and_fraction(outliers):
    reports = []
    epipole.estimate_fundamental(*outliers, progress=lambda *status: reports.append(status))
    assert reports and reports[0][0] == "drawing samples" and 0 <= reports[0][1] <= 1


def test_exception_of_a_callback_stops_the_work(long_work):
    matches, options = long_work

    def stop(stage, fraction):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        epipole.estimate_fundamental(*matches, progress=stop, **options)


@pytest.mark.parametrize("num_threads", [None, 2])
def test_interrupt_stops_the_work(long_work, num_threads):
    matches, options = long_work
    block = contextlib.nullcontext() if num_threads is None else epipole.threads(num_threads)
    # A job of a shell in the background ignores the signal.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)

    def interrupt():
        time.sleep(0.3)
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=interrupt)
    thread.start()
    with pytest.raises(KeyboardInterrupt), block:
        epipole.estimate_fundamental(*matches, **options)
    thread.join()
    signal.signal(signal.SIGINT, before)


def test_other_threads_run_meanwhile(long_work):
    matches, options = long_work
    counter, done = 0, threading.Event()

    def work():
        try:
            epipole.estimate_fundamental(*matches, progress=watch, **options)
        except TimeoutError:
            done.set()

    start = time.perf_counter()

    def watch(stage, fraction):
        if time.perf_counter() - start > 0.3:
            raise TimeoutError

    threading.Thread(target=work).start()
    while not done.is_set():
        counter += 1
        time.sleep(0.001)
    assert counter > 5


def test_threads_give_the_same_result(outliers):
    expected = epipole.estimate_fundamental(*outliers)
    found = [None] * 8

    def work(i):
        found[i] = epipole.estimate_fundamental(*outliers)

    threads = [threading.Thread(target=work, args=(i,)) for i in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(report == expected for report in found)


def test_threads_of_a_block(outliers):
    before = epipole.num_threads()
    expected = epipole.estimate_fundamental(*outliers)
    with epipole.threads(3):
        assert epipole.num_threads() == 3
        with epipole.threads(1):
            assert epipole.num_threads() == 1
            assert epipole.estimate_fundamental(*outliers) == expected
        assert epipole.num_threads() == 3
    assert epipole.num_threads() == before


def test_wrong_number_of_threads():
    for count in (0, 1025, 2**40):
        with pytest.raises(ValueError, match=f"count must be 1 to 1024, but is {count}"):
            epipole.threads(count)
    with pytest.raises((OverflowError, TypeError)):
        epipole.threads(-1)
    with pytest.raises(TypeError):
        epipole.threads("all")
    with pytest.raises(RuntimeError, match="another thread"):
        epipole.threads(1).__exit__(None, None, None)


def test_a_block_passes_exceptions(outliers):
    def stop(stage, fraction):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"), epipole.threads(2):
        epipole.estimate_fundamental(*outliers, progress=stop)
    assert "threads(2)" in repr(epipole.threads(2))
