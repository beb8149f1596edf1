"""SupeRANSAC (Barath 2025), called as its own examples call it; models and a mask of inliers, or `None` twice."""
import cv2
import numpy as np
import pysuperansac


def settings(max_error_px, confidence, max_iterations):
    """What its examples set, anew for each call, which changes them."""
    chosen = pysuperansac.RANSACSettings()
    chosen.inlier_threshold, chosen.confidence = max_error_px, confidence
    chosen.min_iterations, chosen.max_iterations = 1000, max_iterations
    chosen.sampler = pysuperansac.SamplerType.PROSAC
    chosen.scoring = pysuperansac.ScoringType.MAGSAC
    chosen.local_optimization = pysuperansac.LocalOptimizationType.NestedRANSAC
    chosen.final_optimization = pysuperansac.LocalOptimizationType.IteratedLSQ
    return chosen


def matched(a, b):
    """Matches as it wants them, and the sizes of images that hold them."""
    rows = np.ascontiguousarray(np.hstack([a, b]), dtype=float)
    return rows, list(rows.max(0) + 1)


def mask(inliers, count):
    told = np.zeros(count, np.uint8)
    told[list(inliers)] = 1
    return told


def found(model, inliers, count):
    model = np.asarray(model)
    if len(inliers) == 0 or not np.any(model):
        return None, None
    return model, mask(inliers, count)


def fundamental(a, b, chosen):
    rows, sizes = matched(a, b)
    return found(*pysuperansac.estimateFundamentalMatrix(rows, sizes, [], config=chosen)[:2], len(a))


def homography(a, b, chosen):
    rows, sizes = matched(a, b)
    return found(*pysuperansac.estimateHomography(rows, sizes, [], config=chosen)[:2], len(a))


def relative_pose(a, b, k, chosen):
    """[R t] for two cameras that have `k`."""
    rows, sizes = matched(a, b)
    e, inliers = found(*pysuperansac.estimateEssentialMatrix(rows, k, k, sizes, [], config=chosen)[:2], len(a))
    if e is None:
        return None, None
    return np.hstack(cv2.recoverPose(e, a, b, k, mask=inliers.copy())[1:3]), inliers


def absolute_pose(pixels, points, focal_px, center, chosen):
    """[R t]. It wants points above zero."""
    least = points.min(0)
    rows = np.ascontiguousarray(np.hstack([pixels, points - least]), dtype=float)
    rotation, translation, inliers = pysuperansac.estimateAbsolutePose(
        rows, pysuperansac.CameraType.SimplePinhole, [focal_px, *center], list(rows.max(0)), [], config=chosen)[:3]
    if len(inliers) == 0:
        return None
    return np.hstack([rotation, np.reshape(translation, (3, 1)) - rotation @ least[:, None]])
