"""Cameras, poses and key points of OpenCV, pycolmap and PoseLib, in both directions.

Each function imports the other library when it is called. Pixel centers are at integers in
Epipole and OpenCV, and at halves in COLMAP; these functions shift principal points accordingly.
"""

from __future__ import annotations

from typing import Any, Sequence

import numpy as np
from epipole.camera import Camera, Intrinsics, Lens, RigidTransform

__all__ = [
    "from_opencv",
    "from_poselib",
    "from_pycolmap",
    "points_from_opencv",
    "points_to_opencv",
    "to_opencv",
    "to_poselib",
    "to_pycolmap",
]


def to_opencv(camera: Camera) -> tuple[Any, Any]:
    """Camera matrix and distortion coefficients of OpenCV.

    Returns
    -------
    camera_matrix : ndarray, shape (3, 3)
    dist_coeffs : ndarray, shape (5,), (8,) or (4,)
        The last for a fisheye, which takes the functions of ``cv2.fisheye``.
    """
    if camera.lens.kind == "division":
        raise ValueError("OpenCV has no division model")
    return camera.intrinsics.matrix(), np.array(camera.lens.coefficients)


def from_opencv(
    camera_matrix: Any, dist_coeffs: Any, width: int, height: int, *, fisheye: bool = False
) -> Camera:
    """Camera of OpenCV's matrix and distortion coefficients.

    Parameters
    ----------
    camera_matrix : array_like, shape (3, 3)
    dist_coeffs : array_like of 0, 4, 5 or 8 numbers, or None
        Further coefficients must be 0.
    width, height : int
        Image size, pixels.
    fisheye : bool
        Whether the coefficients are those of ``cv2.fisheye``.
    """
    numbers = np.zeros(0) if dist_coeffs is None else np.asarray(dist_coeffs, float).ravel()
    if not np.isfinite(numbers).all():
        raise ValueError("dist_coeffs must be finite")
    if fisheye:
        if len(numbers) not in (0, 4):
            raise ValueError(f"a fisheye has 4 coefficients, but dist_coeffs has {len(numbers)}")
        kind, wanted = "fisheye", 4
    else:
        if np.any(numbers[8:]):
            raise ValueError("dist_coeffs has thin-prism or tilt coefficients, which no lens has")
        kind, wanted = ("rational", 8) if np.any(numbers[5:8]) else ("brown", 5)
    coefficients = np.zeros(wanted)
    given = numbers[:wanted]
    coefficients[: len(given)] = given
    lens = Lens(kind, list(coefficients)) if np.any(coefficients) or fisheye else None
    return Camera(width, height, Intrinsics.from_matrix(camera_matrix), lens)


def points_from_opencv(keypoints: Sequence[Any]) -> Any:
    """Pixels of ``cv2.KeyPoint``, shape (N, 2)."""
    return np.array([keypoint.pt for keypoint in keypoints], float).reshape(-1, 2)


def points_to_opencv(points: Any, size_px: float = 1.0) -> list[Any]:
    """``cv2.KeyPoint`` of pixels.

    Parameters
    ----------
    points : array_like, shape (N, 2)
    size_px : float
        Diameter of the key points, pixels.
    """
    import cv2

    return [cv2.KeyPoint(float(u), float(v), size_px) for u, v in np.asarray(points)]


def to_pycolmap(value: Camera | RigidTransform) -> Any:
    """``pycolmap.Camera`` of a camera, ``pycolmap.Rigid3d`` of a transform."""
    import pycolmap

    if isinstance(value, RigidTransform):
        w, x, y, z = value.quaternion
        return pycolmap.Rigid3d(pycolmap.Rotation3d(np.array([x, y, z, w])), value.translation)
    model, params = _colmap_model(value, value.intrinsics.to_colmap())
    return pycolmap.Camera(model=model, width=value.width, height=value.height, params=params)


def from_pycolmap(value: Any) -> Camera | RigidTransform:
    """Camera of a ``pycolmap.Camera``, transform of a ``pycolmap.Rigid3d``."""
    if hasattr(value, "translation"):
        x, y, z, w = value.rotation.quat
        return RigidTransform.from_quaternion(np.array([w, x, y, z]), value.translation)
    focal_and_center, lens = _from_colmap_model(value.model_name, list(value.params))
    return Camera(value.width, value.height, Intrinsics.from_colmap(focal_and_center), lens)


def to_poselib(value: Camera | RigidTransform) -> Any:
    """PoseLib's dictionary of a camera, ``poselib.CameraPose`` of a transform."""
    if isinstance(value, RigidTransform):
        import poselib

        pose = poselib.CameraPose()
        pose.q = value.quaternion
        pose.t = value.translation
        return pose
    k = value.intrinsics
    model, params = _colmap_model(value, (k.fu_px, k.fv_px, k.cu_px, k.cv_px))
    return {"model": model, "width": value.width, "height": value.height, "params": params}


def from_poselib(value: Any) -> Camera | RigidTransform:
    """Camera of PoseLib's dictionary, transform of a ``poselib.CameraPose``."""
    if isinstance(value, dict):
        k, lens = _from_colmap_model(value["model"], list(value["params"]))
        return Camera(value["width"], value["height"], Intrinsics(*k), lens)
    return RigidTransform.from_quaternion(np.asarray(value.q), np.asarray(value.t))


def _colmap_model(
    camera: Camera, focal_and_center: Sequence[float]
) -> tuple[str, list[float]]:
    """Name and parameters of COLMAP's camera model, which PoseLib shares."""
    kind, c = camera.lens.kind, list(camera.lens.coefficients)
    start = list(focal_and_center)
    if camera.is_pinhole():
        return "PINHOLE", start
    if kind == "fisheye":
        return "OPENCV_FISHEYE", start + c
    if kind == "brown" and c[4] == 0:
        return "OPENCV", start + c[:4]
    if kind in ("brown", "rational"):
        return "FULL_OPENCV", start + (c + [0.0] * 3)[:8]
    raise ValueError(f"no camera model of COLMAP has the lens {kind}")


def _from_colmap_model(
    model: str, params: list[float]
) -> tuple[list[float], Lens | None]:
    """Focal lengths with principal point, and the lens."""
    if model in ("SIMPLE_PINHOLE", "SIMPLE_RADIAL", "RADIAL"):
        focal, cx, cy, *c = params
        brown = (c + [0.0] * 5)[:2] + [0.0] * 3
        return [focal, focal, cx, cy], Lens("brown", brown) if any(c) else None
    start, c = params[:4], params[4:]
    if model == "PINHOLE":
        return start, None
    if model == "OPENCV":
        return start, Lens("brown", c + [0.0])
    if model == "FULL_OPENCV":
        return start, Lens("rational", c)
    if model == "OPENCV_FISHEYE":
        return start, Lens("fisheye", c)
    raise ValueError(f"the camera model {model} has no equal here")
