"""Conversion of cameras, poses, keypoints and clouds to and from other libraries.

These are OpenCV, pycolmap, PoseLib and Open3D; each function imports its library when called.
Pixel centers are at integers in Epipole, OpenCV and Open3D, and at half-integers in COLMAP; these
functions shift principal points accordingly.
"""

from __future__ import annotations

from typing import Any, Sequence

import numpy as np
from epipole.camera import Camera, Intrinsics, Lens, PosedCamera, RigidTransform
from epipole.sfm import Reconstruction
from epipole.stereo import PointCloud

__all__ = [
    "from_open3d",
    "from_opencv",
    "from_poselib",
    "from_pycolmap",
    "points_from_opencv",
    "points_to_opencv",
    "to_open3d",
    "to_opencv",
    "to_poselib",
    "to_pycolmap",
]


def to_opencv(camera: Camera) -> tuple[Any, Any]:
    """Converts a camera to OpenCV's camera matrix and distortion coefficients.

    Parameters
    ----------
    camera : Camera

    Returns
    -------
    camera_matrix : ndarray, shape (3, 3)
    dist_coeffs : ndarray, shape (5,), (8,) or (4,)
        Shape (4,) is for a fisheye, for use with the functions of ``cv2.fisheye``.

    Raises
    ------
    ValueError
        If the lens is a division model, which OpenCV lacks.
    """
    if camera.lens.kind == "division":
        raise ValueError("OpenCV has no division model")
    return camera.intrinsics.matrix(), np.array(camera.lens.coefficients)


def from_opencv(
    camera_matrix: Any, dist_coeffs: Any, width: int, height: int, *, fisheye: bool = False
) -> Camera:
    """Converts OpenCV's camera matrix and distortion coefficients to a camera.

    Parameters
    ----------
    camera_matrix : array_like, shape (3, 3)
    dist_coeffs : array_like of 0, 4, 5 or 8 numbers, or None
        Additional coefficients must be 0.
    width, height : int
        Image size, pixels.
    fisheye : bool
        Whether the coefficients are for ``cv2.fisheye``.

    Returns
    -------
    Camera

    Raises
    ------
    ValueError
        If no lens model has these coefficients.
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
    used = numbers[:wanted]
    coefficients[: len(used)] = used
    lens = Lens(kind, list(coefficients)) if np.any(coefficients) or fisheye else None
    return Camera(width, height, Intrinsics.from_matrix(camera_matrix), lens)


def points_from_opencv(keypoints: Sequence[Any]) -> Any:
    """Converts keypoints to an array of pixels.

    Parameters
    ----------
    keypoints : sequence of cv2.KeyPoint

    Returns
    -------
    ndarray, shape (N, 2)
    """
    return np.array([keypoint.pt for keypoint in keypoints], float).reshape(-1, 2)


def points_to_opencv(points: Any, size_px: float = 1.0) -> list[Any]:
    """Converts pixels to a list of ``cv2.KeyPoint``.

    Parameters
    ----------
    points : array_like, shape (N, 2)
    size_px : float
        Diameter of the keypoints, pixels.

    Returns
    -------
    list of cv2.KeyPoint
    """
    import cv2

    return [cv2.KeyPoint(float(u), float(v), size_px) for u, v in np.asarray(points)]


def to_pycolmap(value: Camera | RigidTransform) -> Any:
    """Converts a camera to a ``pycolmap.Camera``, a transform to a ``pycolmap.Rigid3d``.

    Parameters
    ----------
    value : Camera or RigidTransform

    Returns
    -------
    pycolmap.Camera or pycolmap.Rigid3d

    Raises
    ------
    ValueError
        If the lens is a division model, which COLMAP lacks.
    """
    import pycolmap

    if isinstance(value, RigidTransform):
        w, x, y, z = value.quaternion
        return pycolmap.Rigid3d(pycolmap.Rotation3d(np.array([x, y, z, w])), value.translation)
    model, params = _colmap_model(value, value.intrinsics.to_colmap())
    return pycolmap.Camera(model=model, width=value.width, height=value.height, params=params)


def from_pycolmap(value: Any) -> Camera | RigidTransform:
    """Converts a ``pycolmap.Camera`` to a camera, a ``pycolmap.Rigid3d`` to a transform.

    Parameters
    ----------
    value : pycolmap.Camera or pycolmap.Rigid3d

    Returns
    -------
    Camera or RigidTransform

    Raises
    ------
    ValueError
        If the camera model has no equivalent lens.
    """
    if hasattr(value, "translation"):
        x, y, z, w = value.rotation.quat
        return RigidTransform.from_quaternion(np.array([w, x, y, z]), value.translation)
    focal_and_center, lens = _from_colmap_model(value.model_name, list(value.params))
    return Camera(value.width, value.height, Intrinsics.from_colmap(focal_and_center), lens)


def to_poselib(value: Camera | RigidTransform) -> Any:
    """Converts a camera to PoseLib's dictionary, a transform to a ``poselib.CameraPose``.

    Parameters
    ----------
    value : Camera or RigidTransform

    Returns
    -------
    dict or poselib.CameraPose

    Raises
    ------
    ValueError
        If the lens is a division model, which PoseLib lacks.
    """
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
    """Converts PoseLib's dictionary to a camera, a ``poselib.CameraPose`` to a transform.

    Parameters
    ----------
    value : dict or poselib.CameraPose

    Returns
    -------
    Camera or RigidTransform

    Raises
    ------
    ValueError
        If the camera model has no equivalent lens.
    """
    if isinstance(value, dict):
        k, lens = _from_colmap_model(value["model"], list(value["params"]))
        return Camera(value["width"], value["height"], Intrinsics(*k), lens)
    return RigidTransform.from_quaternion(np.asarray(value.q), np.asarray(value.t))


def to_open3d(value: Camera | PosedCamera | PointCloud | Reconstruction) -> Any:
    """Converts a camera, posed camera or cloud to Open3D, which uses matrices as transforms.

    Parameters
    ----------
    value : Camera, PosedCamera, epipole.stereo.PointCloud or epipole.sfm.Reconstruction
        Cameras must have no distortion; the points of a reconstruction are converted.

    Returns
    -------
    open3d.camera.PinholeCameraIntrinsic, PinholeCameraParameters or open3d.geometry.PointCloud

    Raises
    ------
    ValueError
        If a camera has distortion, which Open3D does not support.
    TypeError
        If Open3D has no class for the value.
    """
    import open3d

    if isinstance(value, Camera):
        if not value.is_pinhole():
            raise ValueError(
                f"Open3D has no lens, but the camera has a {value.lens.kind} lens; undistort first"
            )
        k = value.intrinsics
        numbers = (value.width, value.height, k.fu_px, k.fv_px, k.cu_px, k.cv_px)
        return open3d.camera.PinholeCameraIntrinsic(*numbers)
    if isinstance(value, PosedCamera):
        posed = open3d.camera.PinholeCameraParameters()
        posed.intrinsic = to_open3d(value.camera)
        posed.extrinsic = value.cam_from_world.matrix()
        return posed
    if isinstance(value, (PointCloud, Reconstruction)):
        cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(value.points))
        if value.colors is not None:
            cloud.colors = open3d.utility.Vector3dVector(value.colors / 255.0)
        return cloud
    raise TypeError(f"Open3D has no class for {type(value).__name__}; it takes transforms as matrix()")


def from_open3d(value: Any) -> Camera | PosedCamera | PointCloud:
    """Converts a camera, posed camera or cloud from Open3D.

    Parameters
    ----------
    value : open3d.camera.PinholeCameraIntrinsic, PinholeCameraParameters or open3d.geometry.PointCloud

    Returns
    -------
    Camera, PosedCamera or epipole.stereo.PointCloud
        Colors of a cloud are rounded to uint8.

    Raises
    ------
    TypeError
        If the value has another class.
    """
    import open3d

    if isinstance(value, open3d.camera.PinholeCameraIntrinsic):
        intrinsics = Intrinsics.from_matrix(value.intrinsic_matrix)
        return Camera.pinhole(intrinsics, value.width, value.height)
    if isinstance(value, open3d.camera.PinholeCameraParameters):
        extrinsic = np.asarray(value.extrinsic)
        camera = from_open3d(value.intrinsic)
        assert isinstance(camera, Camera)
        return PosedCamera(camera, RigidTransform(extrinsic[:3, :3], extrinsic[:3, 3]))
    if isinstance(value, open3d.geometry.PointCloud):
        colors = None
        if value.has_colors():
            colors = np.rint(255 * np.clip(np.asarray(value.colors), 0, 1)).astype(np.uint8)
        return PointCloud(np.array(value.points), colors)
    raise TypeError(f"value must be a camera or a cloud of Open3D, but is {type(value).__name__}")


def _colmap_model(
    camera: Camera, focal_and_center: Sequence[float]
) -> tuple[str, list[float]]:
    """Returns name and parameters of COLMAP's camera model, which PoseLib also uses."""
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
    """Returns the focal lengths with the principal point, and the lens."""
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
