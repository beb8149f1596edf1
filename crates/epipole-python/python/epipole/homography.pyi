# Written by stubs.py. Do not edit.

from collections.abc import Callable, Mapping
from typing import Any, ClassVar, final

import numpy as np
from numpy.typing import ArrayLike, NDArray
from typing_extensions import Unpack

from epipole import options as option_types
from epipole.camera import Camera
from epipole.camera import Intrinsics
from epipole.camera import RigidTransform
from epipole.robust import RansacReport

__all__ = [
    "PlaneMotion",
    "decompose_homography",
    "estimate_homography",
    "estimate_homography_calibrated",
    "fit_homography",
    "homography_4point",
    "homography_from_motion",
    "homography_sampson_px",
    "refine_homography",
    "transfer",
    "transfer_error_px",
]

@final
class PlaneMotion:
    """Motion and plane of a homography.

    Parameters
    ----------
    cam2_from_cam1
        Motion; its translation is in units of the plane's distance from camera 1.
    normal_in_cam1
        Unit normal of the plane in the frame of camera 1, shape (3,).
    """
    def __new__(
        cls,
        cam2_from_cam1: RigidTransform,
        normal_in_cam1: NDArray[np.float64],
    ) -> PlaneMotion: ...
    @property
    def cam2_from_cam1(self) -> RigidTransform:
        """Motion; its translation is in units of the plane's distance from camera 1."""
    @property
    def normal_in_cam1(self) -> NDArray[np.float64]:
        """Unit normal of the plane in the frame of camera 1, shape (3,)."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

def estimate_homography(
    pixels1: ArrayLike,
    pixels2: ArrayLike,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.RansacOptions],
) -> RansacReport[NDArray[np.float64]]:
    """Estimates a homography from matches with outliers, by RANSAC.

    Parameters
    ----------
    pixels1, pixels2 : array_like, shape (N, 2)
        Matches.
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : RansacOptions
        For example ``max_error_px=1.0``, ``confidence=0.999``, ``seed=0``.

    Returns
    -------
    RansacReport of ndarray
        Its model is H, shape (3, 3), with ``x2 ~ H @ x1``.

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 4 different matches.
    epipole.DegenerateError
        If all pixels of an image are on a line.
    epipole.NoConsensusError
        If no homography has 4 inliers.
    ValueError
        If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.
    """
def estimate_homography_calibrated(
    pixels1: ArrayLike,
    pixels2: ArrayLike,
    camera1: Camera,
    camera2: Camera,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.RansacOptions],
) -> RansacReport[NDArray[np.float64]]:
    """Estimates a homography between the rays of two calibrated cameras, by RANSAC.

    Parameters
    ----------
    pixels1, pixels2 : array_like, shape (N, 2)
        Matches.
    camera1, camera2 : Camera
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : RansacOptions
        For example ``max_error_px=1.0``, ``confidence=0.999``, ``seed=0``.

    Returns
    -------
    RansacReport of ndarray
        Its model is the H that maps rays, shape (3, 3).

    Raises
    ------
    epipole.TooFewError
        If fewer than 4 different matches are within the range of both lenses.
    epipole.DegenerateError
        If all pixels of an image of a pinhole camera are on a line.
    epipole.NoConsensusError
        If no homography has 4 inliers.
    ValueError
        If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.
    """
def homography_4point(pixels1: ArrayLike, pixels2: ArrayLike) -> NDArray[np.float64]:
    """Computes the homographies of four matches.

    Parameters
    ----------
    pixels1, pixels2 : array_like, shape (4, 2)

    Returns
    -------
    ndarray, shape (K, 3, 3)
        K is 1, or 0 for a degenerate sample.
    """
def fit_homography(pixels1: ArrayLike, pixels2: ArrayLike) -> NDArray[np.float64]:
    """Fits a homography to matches by linear least squares, without outliers.

    Parameters
    ----------
    pixels1, pixels2 : array_like, shape (N, 2)
        Matches, N >= 4.

    Returns
    -------
    ndarray, shape (3, 3)

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 4 matches.
    epipole.DegenerateError
        If all points, or all but one, are on a line.
    """
def refine_homography(
    homography: ArrayLike,
    pixels1: ArrayLike,
    pixels2: ArrayLike,
    loss: str | Mapping[str, Any] | None = None,
) -> NDArray[np.float64]:
    """Refines a homography from matches.

    Parameters
    ----------
    homography : array_like, shape (3, 3)
    pixels1, pixels2 : array_like, shape (N, 2)
    loss : str or dict, optional
        ``"trivial"``, or ``{"huber": {"width": 1.0}}``; ``"cauchy"`` and ``"truncated"`` likewise.

    Returns
    -------
    ndarray, shape (3, 3)

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 4 different matches.
    ValueError
        If the loss width is not above 0, a coordinate is beyond 1e9 pixels, or the initial
        homography maps a pixel to infinity.
    """
def transfer(homography: ArrayLike, pixel1: ArrayLike) -> NDArray[np.float64]:
    """Maps pixels of image 1 to image 2 by a homography.

    Parameters
    ----------
    homography : array_like, shape (3, 3)
    pixel1 : array_like, shape (2,) or (N, 2)

    Returns
    -------
    ndarray of the same shape
        Rows of NaN for pixels mapped to infinity.

    Raises
    ------
    epipole.DegenerateError
        If a single pixel is given and is mapped to infinity.

    Examples
    --------
    >>> transfer([[2, 0, 1], [0, 2, 0], [0, 0, 1]], [3, 4])
    array([7., 8.])
    """
def transfer_error_px(homography: ArrayLike, pixel1: ArrayLike, pixel2: ArrayLike) -> Any:
    """Computes the distances in image 2 between mapped pixels and their matches.

    Parameters
    ----------
    homography : array_like, shape (3, 3)
    pixel1, pixel2 : array_like, shape (2,) or (N, 2)

    Returns
    -------
    float or ndarray, shape (N,)
        Pixels.
    """
def homography_sampson_px(homography: ArrayLike, pixel1: ArrayLike, pixel2: ArrayLike) -> Any:
    """Computes the Sampson distances of matches from a homography.

    Parameters
    ----------
    homography : array_like, shape (3, 3)
    pixel1, pixel2 : array_like, shape (2,) or (N, 2)

    Returns
    -------
    float or ndarray, shape (N,)
        Pixels.
    """
def decompose_homography(
    homography: ArrayLike,
    k1: Intrinsics,
    k2: Intrinsics,
) -> list[PlaneMotion]:
    """Decomposes a homography into its possible motions and planes.

    Parameters
    ----------
    homography : array_like, shape (3, 3)
    k1, k2 : Intrinsics

    Returns
    -------
    list of PlaneMotion

    Raises
    ------
    epipole.DegenerateError
        If the matrix is singular.
    """
def homography_from_motion(
    cam2_from_cam1: RigidTransform,
    normal_in_cam1: ArrayLike,
    distance: float,
    k1: Intrinsics,
    k2: Intrinsics,
) -> NDArray[np.float64]:
    """Computes the homography of a plane between two cameras.

    Parameters
    ----------
    cam2_from_cam1 : RigidTransform
    normal_in_cam1 : array_like, shape (3,)
        Unit normal: points of the plane satisfy ``normal @ x == -distance``.
    distance : float
        Distance of the plane from camera 1.
    k1, k2 : Intrinsics

    Returns
    -------
    ndarray, shape (3, 3)
    """
