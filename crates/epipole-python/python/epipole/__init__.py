"""Multi-view geometry: robust estimation, pose, triangulation, stereo, reconstruction.

The modules are those of the Rust library. The items of its prelude are also here.

Conventions
-----------
* Pixels are (u, v) = (column, row), pixel centers at integers.
* Camera frame: x right, y down, z forward; ``x_in_cam = cam_from_world @ x_in_world``.
* Input arrays are ``(N, 2)`` or ``(N, 3)``, of any real dtype, or lists; output is float64.
* Equal seeds give equal results on every platform.

Errors
------
* Data without a result raise a subclass of ``epipole.Error``, as listed under ``Raises``.
* In every function, wrong types, unknown options, wrong shapes, unequal lengths and non-finite
  numbers raise a ValueError or TypeError that names the argument. ``Raises`` lists other causes.
"""

from epipole._epipole import (
    DegenerateError,
    Error,
    NoConsensusError,
    TooFewError,
    __version__,
    absolute_pose,
    calibration,
    camera,
    epipolar,
    feature,
    homography,
    imaging,
    io,
    math,
    mvs,
    num_threads,
    optim,
    robust,
    sfm,
    stereo,
    stitch,
    synthetic,
    threads,
    triangulation,
    two_view,
)
from epipole.absolute_pose import estimate_absolute_pose
from epipole.calibration import Board, calibrate, calibrate_rig, find_board
from epipole.camera import Camera, Intrinsics, Lens, PosedCamera, RigidTransform
from epipole.epipolar import (
    decompose_essential,
    estimate_essential,
    estimate_fundamental,
    estimate_relative_pose,
    sampson_px,
)
from epipole.feature import detect_features, detect_sift, match_descriptors, refine_corners
from epipole.homography import estimate_homography, transfer
from epipole.imaging import gray_to_f32, rgb_to_gray, rgb_to_gray_f32, warp_perspective
from epipole.robust import RansacReport, ransac
from epipole.sfm import reconstruct_photos
from epipole.stereo import StereoSgm, rectify_calibrated
from epipole.triangulation import triangulate_dlt, triangulate_nview
from epipole.two_view import estimate_two_view, estimate_two_view_calibrated

__all__ = [
    "Board",
    "Camera",
    "DegenerateError",
    "Error",
    "Intrinsics",
    "Lens",
    "NoConsensusError",
    "PosedCamera",
    "RansacReport",
    "RigidTransform",
    "StereoSgm",
    "TooFewError",
    "__version__",
    "absolute_pose",
    "calibrate",
    "calibrate_rig",
    "calibration",
    "camera",
    "decompose_essential",
    "detect_features",
    "detect_sift",
    "epipolar",
    "estimate_absolute_pose",
    "estimate_essential",
    "estimate_fundamental",
    "estimate_homography",
    "estimate_relative_pose",
    "estimate_two_view",
    "estimate_two_view_calibrated",
    "feature",
    "find_board",
    "gray_to_f32",
    "homography",
    "imaging",
    "io",
    "match_descriptors",
    "math",
    "mvs",
    "num_threads",
    "optim",
    "ransac",
    "reconstruct_photos",
    "rectify_calibrated",
    "refine_corners",
    "rgb_to_gray",
    "rgb_to_gray_f32",
    "robust",
    "sampson_px",
    "sfm",
    "stereo",
    "stitch",
    "synthetic",
    "threads",
    "transfer",
    "triangulate_dlt",
    "triangulate_nview",
    "triangulation",
    "two_view",
    "warp_perspective",
]
