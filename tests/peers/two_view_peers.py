"""OpenCV and PoseLib on a problem of two_view_problems.py: model and inliers of matches `a`, `b`."""
import cv2
import numpy as np
import poselib

CONFIDENCE = 0.999


def intrinsics(k):
    return [k[0, 0], k[1, 1], k[0, 2], k[1, 2]]


def opencv(p, a, b, _):
    if p.kind == "F":
        f, inliers = cv2.findFundamentalMat(a, b, cv2.USAC_MAGSAC, p.threshold_px, CONFIDENCE, p.trials)
        return None if f is None else f[:3], inliers
    if p.kind == "H":
        return cv2.findHomography(a, b, cv2.USAC_MAGSAC, p.threshold_px, maxIters=p.trials, confidence=CONFIDENCE)
    e, inliers = cv2.findEssentialMat(a, b, p.k, cv2.USAC_MAGSAC, CONFIDENCE, p.threshold_px, maxIters=p.trials)
    if e is None:
        return None, None
    return np.hstack(cv2.recoverPose(e[:3], a, b, p.k, mask=inliers.copy())[1:3]), inliers


def pose_lib(p, a, b, seed):
    ransac = {"max_epipolar_error": p.threshold_px, "max_reproj_error": p.threshold_px, "success_prob": CONFIDENCE,
              "max_iterations": p.trials, "seed": seed}
    if p.kind == "F":
        model, told = poselib.estimate_fundamental(a, b, ransac, {})
    elif p.kind == "H":
        model, told = poselib.estimate_homography(a, b, ransac, {})
    else:
        camera = {"model": "PINHOLE", "width": -1, "height": -1, "params": intrinsics(p.k)}
        pose, told = poselib.estimate_relative_pose(a, b, camera, camera, ransac, {})
        model = pose.Rt
    return model, told["inliers"]
