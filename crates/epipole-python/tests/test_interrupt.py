"""Ctrl-C in every call that takes long with photos of 12 megapixels."""

import os
import signal
import threading
import time

import numpy as np
import pytest

from epipole import calibration, camera, feature, imaging, stereo

WIDTH, HEIGHT = 4000, 3000
# Time from the first report to the signal; every call takes several times as long.
DELAY_S = 0.05


@pytest.fixture(scope="module")
def photo():
    """Boxes of random size and gray value."""
    random = np.random.default_rng(3)
    image = np.full((HEIGHT, WIDTH), 128, np.uint8)
    for _ in range(20_000):
        u, v = random.integers(WIDTH), random.integers(HEIGHT)
        width, height = random.integers(5, 45, 2)
        image[v : v + height, u : u + width] = random.integers(256)
    return image


@pytest.fixture(scope="module")
def places():
    return np.random.default_rng(5).uniform([20, 20], [WIDTH - 20, HEIGHT - 20], (30_000, 2))


@pytest.fixture(scope="module")
def keypoints(places):
    return feature.Keypoints(places, scales_px=np.full(len(places), 4.0, np.float32))


@pytest.fixture(scope="module")
def descriptors():
    random = np.random.default_rng(7)
    return random.integers(0, 120, (2, 30_000, 128)).astype(np.float32)


@pytest.fixture(scope="module")
def lens():
    intrinsics = camera.Intrinsics(3200, 3200, 1999.5, 1499.5)
    fisheye = camera.Lens("fisheye", [-0.02, 0.008, -0.004, 6e-4])
    return camera.Camera(WIDTH, HEIGHT, intrinsics, fisheye)


@pytest.fixture(scope="module")
def disparity():
    values = np.random.default_rng(9).uniform(5, 9, (HEIGHT, WIDTH)).astype(np.float32)
    values[values < 6] = np.nan
    return values


def matrix(shift):
    return np.array([[1.01, 0.02, shift], [-0.02, 0.99, 4], [1e-6, 0, 1]])


CALLS = {
    "gaussian_blur": lambda f, p: imaging.gaussian_blur(f("photo"), 60, progress=p),
    "gaussian_derivative": lambda f, p: imaging.gaussian_derivative(f("photo"), 60, progress=p),
    "box_filter": lambda f, p: imaging.box_filter(f("photo"), 501, progress=p),
    "correlate": lambda f, p: imaging.correlate(f("photo"), np.ones((9, 9)), progress=p),
    "separable_filter": lambda f, p: imaging.separable_filter(
        f("photo"), np.arange(401.0), np.arange(401.0), progress=p
    ),
    "warp_perspective": lambda f, p: imaging.warp_perspective(
        f("photo"), matrix(5), interpolation="bicubic", width=WIDTH, height=HEIGHT, progress=p
    ),
    "warp_affine": lambda f, p: imaging.warp_affine(
        f("photo"), matrix(5)[:2], interpolation="bicubic", width=WIDTH, height=HEIGHT, progress=p
    ),
    "structure_tensor": lambda f, p: feature.structure_tensor(
        f("photo"), window={"box": 201}, progress=p
    ),
    "harris_response": lambda f, p: feature.harris_response(
        f("photo"), 0.04, window={"box": 201}, progress=p
    ),
    "min_eigenvalue_response": lambda f, p: feature.min_eigenvalue_response(
        f("photo"), window={"box": 201}, progress=p
    ),
    "good_features_to_track": lambda f, p: feature.good_features_to_track(
        f("photo"), tensor={"window": {"box": 201}}, progress=p
    ),
    "non_maximum_suppression": lambda f, p: feature.non_maximum_suppression(
        np.ones((HEIGHT, WIDTH), np.float32), 60, 0.5, progress=p
    ),
    "refine_corners": lambda f, p: feature.refine_corners(
        f("photo"), f("places"), half_window=20, progress=p
    ),
    "describe_patches": lambda f, p: feature.describe_patches(
        f("photo"), f("keypoints"), 64, progress=p
    ),
    "detect_sift": lambda f, p: feature.detect_sift(f("photo"), progress=p),
    "detect_orb": lambda f, p: feature.detect_orb(f("photo"), max_features=30_000, progress=p),
    "detect_features": lambda f, p: feature.detect_features(f("photo"), progress=p),
    "scale_space": lambda f, p: feature.scale_space(f("photo"), progress=p),
    "describe_sift": lambda f, p: feature.describe_sift(f("photo"), f("keypoints"), progress=p),
    "sift_directions": lambda f, p: feature.sift_directions(
        f("photo"), f("keypoints"), progress=p
    ),
    "track_lucas_kanade": lambda f, p: feature.track_lucas_kanade(
        f("photo"), np.roll(f("photo"), 7, axis=1), f("places"), progress=p
    ),
    "match_descriptors": lambda f, p: feature.match_descriptors(*f("descriptors"), progress=p),
    "nearest_two": lambda f, p: feature.nearest_two(*f("descriptors"), progress=p),
    "Undistortion": lambda f, p: calibration.Undistortion(f("lens"), progress=p),
    "render_board": lambda f, p: calibration.render_board(
        calibration.Board("chessboard", 9, 6, 0.03),
        f("lens"),
        camera.RigidTransform(np.eye(3), [-0.12, -0.075, 0.35]),
        progress=p,
    ),
    "find_board": lambda f, p: calibration.find_board(
        f("photo"), calibration.Board("circles", 9, 6, 0.03), progress=p
    ),
    "StereoBm": lambda f, p: stereo.StereoBm().compute(
        f("photo"), np.roll(f("photo"), -9, axis=1), progress=p
    ),
    "StereoSgm": lambda f, p: stereo.StereoSgm().compute(
        f("photo"), np.roll(f("photo"), -9, axis=1), progress=p
    ),
    "fill_gaps": lambda f, p: stereo.fill_gaps(f("disparity"), f("photo"), progress=p),
}


@pytest.mark.parametrize("name", CALLS)
def test_interrupt_stops_long_work(request, name, capsys):
    """Signals after the first report, so that reading the arguments does not count."""
    fractions = []
    signaled = []

    def interrupt():
        signaled.append(time.perf_counter())
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(DELAY_S, interrupt)

    def watch(stage, fraction):
        if not fractions:
            timer.start()
        fractions.append(fraction)

    # A job of a shell in the background ignores the signal.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    has_finished = False
    try:
        with pytest.raises(KeyboardInterrupt):
            CALLS[name](request.getfixturevalue, watch)
            has_finished = True
            # The signal of work that ended too early still comes.
            timer.join()
            time.sleep(1)
        ended = time.perf_counter()
    finally:
        timer.cancel()
        signal.signal(signal.SIGINT, before)
    assert not has_finished and fractions and fractions[-1] < 1
    with capsys.disabled():
        print(f"\n{name}: stopped {1e3 * (ended - signaled[0]):.0f} ms after Ctrl-C", end="")


def test_every_function_with_progress_is_interrupted():
    """Functions of images that take a progress callback are in the list above."""
    missing = [
        name
        for module in (imaging, feature)
        for name, function in vars(module).items()
        if "progress" in (getattr(function, "__text_signature__", None) or "")
        and name not in CALLS
    ]
    assert not missing
