"""Multi-view geometry: robust estimation, pose, triangulation, stereo, reconstruction.

The modules are those of the Rust library. What its prelude has is also here.

Conventions
-----------
* Pixels are (u, v) = (column, row), pixel centers at integers.
* Camera frame: x right, y down, z forward; ``x_in_cam = cam_from_world @ x_in_world``.
* Arrays in are ``(N, 2)`` or ``(N, 3)`` of any real dtype, lists included; arrays out are float64.
* Equal seeds give equal results on every platform.
"""

from epipole._epipole import (
    DegenerateError,
    Error,
    NoConsensusError,
    TooFewError,
    __version__,
    absolute_pose,
    camera,
    epipolar,
    homography,
    robust,
    triangulation,
    two_view,
)
from epipole.absolute_pose import estimate_absolute_pose
from epipole.camera import Camera, Intrinsics, Lens, PosedCamera, RigidTransform
from epipole.epipolar import (
    decompose_essential,
    estimate_essential,
    estimate_fundamental,
    estimate_relative_pose,
    sampson_px,
)
from epipole.homography import estimate_homography, transfer
from epipole.robust import RansacReport, ransac
from epipole.triangulation import triangulate_dlt, triangulate_nview
from epipole.two_view import estimate_two_view, estimate_two_view_calibrated

__all__ = [
    "Camera",
    "DegenerateError",
    "Error",
    "Intrinsics",
    "Lens",
    "NoConsensusError",
    "PosedCamera",
    "RansacReport",
    "RigidTransform",
    "TooFewError",
    "__version__",
    "absolute_pose",
    "camera",
    "decompose_essential",
    "epipolar",
    "estimate_absolute_pose",
    "estimate_essential",
    "estimate_fundamental",
    "estimate_homography",
    "estimate_relative_pose",
    "estimate_two_view",
    "estimate_two_view_calibrated",
    "homography",
    "ransac",
    "robust",
    "sampson_px",
    "transfer",
    "triangulate_dlt",
    "triangulate_nview",
    "triangulation",
    "two_view",
]
