# Written by stubs.py. Do not edit.

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar, final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from epipole.camera import PosedCamera
from epipole.camera import RigidTransform

__all__ = [
    "NviewPoint",
    "correct_matches",
    "point_covariance",
    "triangulate_angular",
    "triangulate_dlt",
    "triangulate_midpoint",
    "triangulate_nview",
    "triangulate_nview_dlt",
    "triangulate_optimal",
    "triangulate_weighted_midpoint",
    "triangulation_angle_rad",
]

@final
class NviewPoint:
    """Point triangulated from several views.

    Parameters
    ----------
    point_in_world
        Point, shape (3,).
    rms_error_px
        Root mean square of the distances between projections and pixels.
    """
    def __new__(cls, point_in_world: NDArray[np.float64], rms_error_px: float) -> NviewPoint: ...
    @property
    def point_in_world(self) -> NDArray[np.float64]:
        """Point, shape (3,)."""
    @property
    def rms_error_px(self) -> float:
        """Root mean square of the distances between projections and pixels."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

def triangulate_dlt(
    p1: ArrayLike,
    p2: ArrayLike,
    pixel1: ArrayLike,
    pixel2: ArrayLike,
) -> NDArray[np.float64]:
    """Triangulates points of two views by linear least squares (DLT).

    Parameters
    ----------
    p1, p2 : array_like, shape (3, 4)
        Projection matrices.
    pixel1, pixel2 : array_like, shape (2,) or (N, 2)
        Undistorted pixels.

    Returns
    -------
    ndarray, shape (3,) or (N, 3)
        Rows of NaN for parallel rays and points behind a camera.

    Raises
    ------
    epipole.DegenerateError
        If a single match is given and its rays are parallel, its point is not in front of both
        cameras, the cameras are at the same position, or a matrix has rank below 3.
    """
def triangulate_midpoint(
    cam2_from_cam1: RigidTransform,
    ray1: ArrayLike,
    ray2: ArrayLike,
) -> NDArray[np.float64]:
    """Triangulates points of two views: the midpoints where rays are nearest to each other.

    Parameters
    ----------
    cam2_from_cam1 : RigidTransform
    ray1, ray2 : array_like, shape (3,) or (N, 3)
        Rays in the frames of camera 1 and camera 2.

    Returns
    -------
    ndarray, shape (3,) or (N, 3)
        Points in the frame of camera 1. Rows of NaN for parallel rays and points behind a camera.

    Raises
    ------
    epipole.DegenerateError
        If a single pair is given and its rays are parallel or diverge, or the cameras are at the
        same position.
    ValueError
        If a single pair is given and a ray has length 0.

    Examples
    --------
    >>> from epipole import RigidTransform
    >>> motion = RigidTransform(translation=[-1, 0, 0])
    >>> triangulate_midpoint(motion, [0, 0, 1], [-0.25, 0, 1])
    array([0., 0., 4.])
    """
def triangulate_weighted_midpoint(
    cam2_from_cam1: RigidTransform,
    ray1: ArrayLike,
    ray2: ArrayLike,
) -> NDArray[np.float64]:
    """Triangulates points of two views: midpoints of rays, weighted by inverse depth.

    Parameters
    ----------
    cam2_from_cam1 : RigidTransform
    ray1, ray2 : array_like, shape (3,) or (N, 3)
        Rays in the frames of camera 1 and camera 2.

    Returns
    -------
    ndarray, shape (3,) or (N, 3)
        Same as for `triangulate_midpoint`.

    Raises
    ------
    epipole.DegenerateError
        If a single pair is given and its rays are parallel or diverge, or the cameras are at the
        same position; for several pairs, its row is NaN.
    ValueError
        If a single pair is given and a ray has length 0.
    """
def triangulate_angular(
    cam2_from_cam1: RigidTransform,
    ray1: ArrayLike,
    ray2: ArrayLike,
) -> NDArray[np.float64]:
    """Triangulates points of two views with the smallest sum of angular errors.

    Parameters
    ----------
    cam2_from_cam1 : RigidTransform
    ray1, ray2 : array_like, shape (3,) or (N, 3)
        Rays in the frames of camera 1 and camera 2.

    Returns
    -------
    ndarray, shape (3,) or (N, 3)
        Same as for `triangulate_midpoint`.

    Raises
    ------
    epipole.DegenerateError
        If a single pair is given and its rays are parallel or diverge, or the cameras are at the
        same position; for several pairs, its row is NaN.
    ValueError
        If a single pair is given and a ray has length 0.
    """
def triangulate_optimal(
    cam1: PosedCamera,
    cam2: PosedCamera,
    pixel1: ArrayLike,
    pixel2: ArrayLike,
) -> NDArray[np.float64]:
    """Triangulates points of two views with the smallest reprojection error.

    Parameters
    ----------
    cam1, cam2 : PosedCamera
    pixel1, pixel2 : array_like, shape (2,) or (N, 2)

    Returns
    -------
    ndarray, shape (3,) or (N, 3)
        Rows of NaN for parallel rays and points behind a camera.

    Raises
    ------
    epipole.DegenerateError
        If a single match is given and its rays are parallel or diverge, it is an epipole, a pixel
        has no ray, or the cameras are at the same position.
    """
def correct_matches(
    fundamental: ArrayLike,
    pixel1: ArrayLike,
    pixel2: ArrayLike,
) -> NDArray[np.float64]:
    """Computes the nearest matches that satisfy the epipolar constraint exactly.

    Parameters
    ----------
    fundamental : array_like, shape (3, 3)
    pixel1, pixel2 : array_like, shape (2,) or (N, 2)

    Returns
    -------
    ndarray, shape (4,) or (N, 4)
        Corrected (u1, v1, u2, v2). Rows of NaN for matches at an epipole.

    Raises
    ------
    epipole.DegenerateError
        If a single match is given and it consists of the two epipoles or its lines are at infinity,
        or if the matrix is zero.
    """
def triangulate_nview_dlt(
    cameras: Sequence[PosedCamera],
    pixels: ArrayLike,
) -> NDArray[np.float64]:
    """Triangulates a point of several views by linear least squares.

    Parameters
    ----------
    cameras : sequence of PosedCamera
        At least 2.
    pixels : array_like, shape (N, 2)
        Pixel in each camera.

    Returns
    -------
    ndarray, shape (3,)

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 2 views.
    epipole.DegenerateError
        If the rays are parallel, the cameras are at the same position, a camera does not see the
        point, or a pixel has no ray.
    """
def triangulate_nview(
    cameras: Sequence[PosedCamera],
    pixels: ArrayLike,
    loss: str | Mapping[str, Any] | None = None,
) -> NviewPoint:
    """Triangulates a point of several views with the smallest reprojection error.

    Parameters
    ----------
    cameras : sequence of PosedCamera
        At least 2.
    pixels : array_like, shape (N, 2)
        Pixel in each camera.
    loss : str or dict, optional
        ``"trivial"``, or ``{"huber": {"width": 1.0}}``; ``"cauchy"`` and ``"truncated"`` likewise.

    Returns
    -------
    NviewPoint

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 2 views.
    epipole.DegenerateError
        If the rays are parallel, the cameras are at the same position, a camera does not see the
        point, or a pixel has no ray.
    ValueError
        If the loss width is not above 0.
    """
def triangulation_angle_rad(
    center1_in_world: ArrayLike,
    center2_in_world: ArrayLike,
    point_in_world: ArrayLike,
) -> Any:
    """Computes the angle between the rays that meet in a point.

    Parameters
    ----------
    center1_in_world, center2_in_world : array_like, shape (3,)
        Centers of the cameras.
    point_in_world : array_like, shape (3,) or (N, 3)

    Returns
    -------
    float or ndarray, shape (N,)
        Radians.
    """
def point_covariance(
    cameras: Sequence[PosedCamera],
    point_in_world: ArrayLike,
    sigma_px: float,
) -> NDArray[np.float64]:
    """Computes the covariance of a triangulated point, to first order.

    Parameters
    ----------
    cameras : sequence of PosedCamera
    point_in_world : array_like, shape (3,)
    sigma_px : float
        Standard deviation of each pixel coordinate.

    Returns
    -------
    ndarray, shape (3, 3)

    Raises
    ------
    epipole.DegenerateError
        If a camera does not see the point, or the views do not constrain it along a ray.
    ValueError
        If ``sigma_px`` is not above 0.
    """
