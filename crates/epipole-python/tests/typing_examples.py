"""Calls with the types that type checkers must find, and calls that they must refuse."""

import epipole
import numpy as np
from epipole import camera, epipolar, robust, triangulation, two_view
from epipole.options import RansacOptions
from numpy.typing import NDArray
from typing_extensions import assert_type

Floats = NDArray[np.float64]

pixels1 = np.zeros((20, 2), np.float32)
pixels2 = [(1, 2.5)] * 20

options: RansacOptions = {"max_error_px": 0.5, "score": "msac"}
report = epipole.estimate_fundamental(pixels1, pixels2, **options)
assert_type(report, robust.RansacReport[Floats])
assert_type(report.inliers, NDArray[np.bool_])
assert_type(report.log10_false_alarms, float | None)
assert_type(report.model, Floats)
epipole.estimate_fundamental(pixels1, pixels2, progress=lambda stage, fraction: print(stage, fraction))
epipole.estimate_fundamental(pixels1, pixels2, max_eror_px=1)  # type: ignore[call-arg]
epipole.estimate_fundamental(pixels1, pixels2, score="mac")  # type: ignore[arg-type]

motion = epipole.RigidTransform(translation=[0, 1, 2])
assert_type(motion @ motion, camera.RigidTransform)
assert_type(motion @ [[0, 1, 2], [3, 4, 5]], Floats)
assert_type(motion.inverse().rotation, Floats)
motion.rotation = np.eye(3)  # type: ignore[misc]

intrinsics = camera.Intrinsics.centered(600, 640, 480)
view = camera.Camera.pinhole(intrinsics, 640, 480)
assert_type(intrinsics.to_colmap(), tuple[float, float, float, float])
assert_type(view.project([0, 0, 1]), Floats)
camera.Camera(640, 480, np.eye(3))  # type: ignore[arg-type]
camera.Lens("fish")  # type: ignore[arg-type]

assert_type(epipolar.decompose_essential(np.eye(3)), list[camera.RigidTransform])
assert_type(epipolar.epipoles(np.eye(3)), tuple[Floats, Floats])
assert_type(epipolar.focal_lengths_from_fundamental(np.eye(3), [0, 0], [0, 0]), tuple[float, float])
number: float = epipolar.sampson_px(np.eye(3), [0, 0], [1, 1])

views = (camera.PosedCamera(view, motion), camera.PosedCamera(view, motion))
point = triangulation.triangulate_nview(views, pixels1, loss={"huber": {"width": 1.0}})
assert_type(point.rms_error_px, float)

found = epipole.estimate_two_view(pixels1, pixels2, ransac={"seed": 3})
assert_type(found, two_view.TwoViewReport)
assert_type(found.fundamental, Floats | None)
assert_type(found.cam2_from_cam1, camera.RigidTransform | None)
wrong: RansacOptions = {"sed": 3}  # type: ignore[typeddict-unknown-key]
