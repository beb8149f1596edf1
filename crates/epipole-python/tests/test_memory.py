"""Calls, also those that fail, keep no memory."""

import gc
import os
import pickle
import sys
import tracemalloc
from pathlib import Path

import epipole
import numpy as np
import pytest
from conftest import make_world

CALLS = 1000
# Free lists of Python and NumPy grow for some rounds, a leak in every round.
MAX_ROUNDS = 8
# Each of the thousand calls handles arrays of kilobytes; the smallest object has 16 bytes.
MAX_RESIDENT_BYTES, MAX_TRACED_BYTES = 1_000_000, 12_000

world = make_world(500)
matches = world.pixels1, world.pixels2
few_matches = world.pixels1[:40], world.pixels2[:40]
motion, camera, intrinsics = world.motion, world.camera, world.intrinsics
image = np.random.default_rng(4).integers(0, 255, (32, 40)).astype(np.uint8)
color = np.dstack([image, image, image])
few = {"max_iterations": 10, "min_iterations": 1}
features = epipole.detect_sift(image)


def failing():
    with pytest.raises(ValueError):
        epipole.epipolar.fundamental_8point(world.pixels1, world.pixels2[:, :1])


def raising():
    def stop(stage, fraction):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError):
        epipole.detect_sift(image, progress=stop)


FUNCTIONS = {
    "fundamental_8point": lambda: epipole.epipolar.fundamental_8point(*matches),
    "fundamental_7point": lambda: epipole.epipolar.fundamental_7point(*(x[:7] for x in matches)),
    "sampson_px": lambda: epipole.epipolar.sampson_px(world.fundamental, *matches),
    "epipolar_line2": lambda: epipole.epipolar.epipolar_line2(world.fundamental, world.pixels1),
    "essential_5point": lambda: epipole.epipolar.essential_5point(world.rays1[:5], world.rays2[:5]),
    "decompose_essential": lambda: epipole.decompose_essential(world.essential),
    "estimate_fundamental": lambda: epipole.estimate_fundamental(*few_matches, **few),
    "estimate_relative_pose": lambda: epipole.estimate_relative_pose(
        *few_matches, camera, camera, **few
    ),
    "estimate_homography": lambda: epipole.estimate_homography(
        few_matches[0], few_matches[0], **few
    ),
    "ransac with a callable": lambda: epipole.ransac(
        len(world.points),
        3,
        lambda indices: world.points[indices].mean(axis=0),
        lambda model: np.linalg.norm(world.points - model, axis=1),
        max_error_px=5.0,
        **few,
    ),
    "ransac by steps": lambda: sum(
        trial.is_best for trial in epipole.robust.Ransac.fundamental(*few_matches, **few)
    ),
    "transfer": lambda: epipole.homography.transfer(np.eye(3), world.pixels1),
    "pose_p3p": lambda: epipole.absolute_pose.pose_p3p(world.rays1[:3], world.points[:3]),
    "reprojection_error_px": lambda: epipole.absolute_pose.reprojection_error_px(
        world.posed[0], world.points, world.pixels1
    ),
    "triangulate_dlt": lambda: epipole.triangulate_dlt(
        *(posed.projection_matrix() for posed in world.posed), *matches
    ),
    "project": lambda: camera.project(world.points),
    "unproject": lambda: camera.unproject(world.pixels1),
    "transform": lambda: motion @ world.points,
    "gaussian_blur": lambda: epipole.imaging.gaussian_blur(image, 1.0),
    "pyramid": lambda: epipole.imaging.gaussian_pyramid(image, 3),
    "warp_affine": lambda: epipole.imaging.warp_affine(color, np.eye(2, 3)),
    "good_features_to_track": lambda: epipole.feature.good_features_to_track(image),
    "detect_orb": lambda: epipole.feature.detect_orb(image, num_levels=1),
    "match_descriptors": lambda: epipole.match_descriptors(
        features.descriptors, features.descriptors
    ),
    "block matching": lambda: epipole.stereo.StereoBm(num_disparities=8).compute(image, image),
    "semi-global matching": lambda: epipole.stereo.StereoSgm(num_disparities=8).compute(image, image),
    "pickle": lambda: pickle.loads(pickle.dumps(features)),
    "repr": lambda: repr(features) + features._repr_html_(),
    "threads": lambda: epipole.threads(2),
    "an error": failing,
    "an exception of a callback": raising,
}


def in_use():
    """Bytes of the process in memory, and those that Python and NumPy hold."""
    gc.collect()
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return np.array([pages * os.sysconf("SC_PAGE_SIZE"), tracemalloc.get_traced_memory()[0]])


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="reads /proc")
@pytest.mark.parametrize("name", FUNCTIONS)
def test_a_thousand_calls_keep_nothing(name):
    call = FUNCTIONS[name]
    limits = MAX_RESIDENT_BYTES, MAX_TRACED_BYTES
    growths = []
    tracemalloc.start()
    before = in_use()
    while not (growths and np.all(growths[-1] < limits)):
        assert len(growths) < MAX_ROUNDS, growths
        for _ in range(CALLS):
            call()
        now = in_use()
        growths.append(now - before)
        before = now
    tracemalloc.stop()
