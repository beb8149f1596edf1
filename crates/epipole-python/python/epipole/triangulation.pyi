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
    """Point of several views.

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
    """Points of two views by linear least squares (DLT).

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
        Single match of parallel rays, of a point not in front of both cameras, of cameras at the
        same place, or of a matrix of rank below 3.
    """
def triangulate_midpoint(
    cam2_from_cam1: RigidTransform,
    ray1: ArrayLike,
    ray2: ArrayLike,
) -> NDArray[np.float64]:
    """Points of two views: where rays come nearest to each other.

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
        Single pair of parallel or diverging rays, or cameras at the same place.
    ValueError
        Single pair with a ray of length 0.

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
    """Points of two views: midpoints of rays, weighted by inverse depth.

    Parameters
    ----------
    cam2_from_cam1 : RigidTransform
    ray1, ray2 : array_like, shape (3,) or (N, 3)
        Rays in the frames of camera 1 and camera 2.

    Returns
    -------
    ndarray, shape (3,) or (N, 3)
        As `triangulate_midpoint`.

    Raises
    ------
    epipole.DegenerateError
        Single pair of parallel or diverging rays, or cameras at the same place; among several, a
        row of NaN.
    ValueError
        Single pair with a ray of length 0.
    """
def triangulate_angular(
    cam2_from_cam1: RigidTransform,
    ray1: ArrayLike,
    ray2: ArrayLike,
) -> NDArray[np.float64]:
    """Points of two views with the least sum of angular errors.

    Parameters
    ----------
    cam2_from_cam1 : RigidTransform
    ray1, ray2 : array_like, shape (3,) or (N, 3)
        Rays in the frames of camera 1 and camera 2.

    Returns
    -------
    ndarray, shape (3,) or (N, 3)
        As `triangulate_midpoint`.

    Raises
    ------
    epipole.DegenerateError
        Single pair of parallel or diverging rays, or cameras at the same place; among several, a
        row of NaN.
    ValueError
        Single pair with a ray of length 0.
    """
def triangulate_optimal(
    cam1: PosedCamera,
    cam2: PosedCamera,
    pixel1: ArrayLike,
    pixel2: ArrayLike,
) -> NDArray[np.float64]:
    """Points of two views with the least reprojection error.

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
        Single match of parallel or diverging rays, of an epipole, of a pixel without a ray, or of
        cameras at the same place.
    """
def correct_matches(
    fundamental: ArrayLike,
    pixel1: ArrayLike,
    pixel2: ArrayLike,
) -> NDArray[np.float64]:
    """Nearest matches that satisfy the epipolar constraint exactly.

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
        Single match of the two epipoles, one whose lines are infinitely far away, or a matrix of
        zeros.
    """
def triangulate_nview_dlt(
    cameras: Sequence[PosedCamera],
    pixels: ArrayLike,
) -> NDArray[np.float64]:
    """Point of several views by linear least squares.

    Parameters
    ----------
    cameras : sequence of PosedCamera
        At least 2.
    pixels : array_like, shape (N, 2)
        Pixel of each camera.

    Returns
    -------
    ndarray, shape (3,)

    Raises
    ------
    epipole.TooFewError
        Fewer than 2 views.
    epipole.DegenerateError
        Parallel rays, cameras at the same place, a camera that does not see the point, or a pixel
        without a ray.
    """
def triangulate_nview(
    cameras: Sequence[PosedCamera],
    pixels: ArrayLike,
    loss: str | Mapping[str, Any] | None = None,
) -> NviewPoint:
    """Point of several views with the least reprojection error.

    Parameters
    ----------
    cameras : sequence of PosedCamera
        At least 2.
    pixels : array_like, shape (N, 2)
        Pixel of each camera.
    loss : str or dict, optional
        ``"trivial"``, or ``{"huber": {"width": 1.0}}``, ``"cauchy"``, ``"truncated"`` likewise.

    Returns
    -------
    NviewPoint

    Raises
    ------
    epipole.TooFewError
        Fewer than 2 views.
    epipole.DegenerateError
        Parallel rays, cameras at the same place, a camera that does not see the point, or a pixel
        without a ray.
    ValueError
        Loss width not above 0.
    """
def triangulation_angle_rad(
    center1_in_world: ArrayLike,
    center2_in_world: ArrayLike,
    point_in_world: ArrayLike,
) -> Any:
    """Angle at which the rays to a point meet.

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
    """Covariance of a triangulated point, to first order.

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
        Camera that does not see the point, or views that leave it free to move along a ray.
    ValueError
        ``sigma_px`` not above 0.
    """
