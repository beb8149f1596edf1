# Written by stubs.py. Do not edit.

from collections.abc import Callable
from typing import Any, ClassVar, final

import numpy as np
from numpy.typing import ArrayLike, NDArray
from typing_extensions import Unpack

from epipole import options as option_types
from epipole.camera import Camera
from epipole.camera import Intrinsics
from epipole.camera import RigidTransform

__all__ = [
    "DepthInterval",
    "PixelMap",
    "PixelRect",
    "PointCloud",
    "Rectification",
    "RectifiedPair",
    "StereoBm",
    "StereoSgm",
    "UncalibratedRectification",
    "depth_from_disparity",
    "depth_image",
    "depth_interval",
    "fill_gaps",
    "point_cloud",
    "q_from_rig",
    "rectify_calibrated",
    "rectify_uncalibrated",
    "remove_speckles",
]

@final
class StereoBm:
    """Fast dense stereo of a rectified pair by block matching.

    Parameters
    ----------
    **options : StereoBm
        For example ``num_disparities``, ``min_disparity_px``, ``window_px`` (odd), and
        ``filter``, a dict with entries such as ``"speckle_size"``. ``StereoBm()`` shows all
        options with their defaults.
    """
    def __new__(cls, **options: Unpack[option_types.StereoBm]) -> StereoBm: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __getnewargs_ex__(self, /) -> tuple[tuple[Any, ...], dict[str, Any]]: ...
    def compute(
        self,
        left: ArrayLike,
        right: ArrayLike,
        *,
        progress: Callable[[str, float], object] | None = None,
    ) -> NDArray[np.float32]:
        """Computes disparities ``u_left - u_right`` of the pixels of `left`.

        Parameters
        ----------
        left, right : array_like, shape (H, W)
            Rectified gray images whose matches share a row. Both uint8, or both float with
            any range; their minimum and maximum are mapped to 0 and 255.
        progress : callable, optional
            Called with the stage and the completed fraction.

        Returns
        -------
        ndarray of float32, shape (H, W)
            Pixels; NaN where unknown.

        Raises
        ------
        ValueError
            If an option is out of range, or the volume (pixels × disparities) is too large
            for memory.
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class StereoSgm:
    """Dense stereo of a rectified pair by semi-global matching.

    Parameters
    ----------
    **options : StereoSgm
        For example ``num_disparities``, ``min_disparity_px``, ``paths`` ("four", "five",
        "eight"), and ``filter``, a dict with entries such as ``"speckle_size"``.
        ``StereoSgm()`` shows all options with their defaults.
    """
    def __new__(cls, **options: Unpack[option_types.StereoSgm]) -> StereoSgm: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __getnewargs_ex__(self, /) -> tuple[tuple[Any, ...], dict[str, Any]]: ...
    def compute(
        self,
        left: ArrayLike,
        right: ArrayLike,
        *,
        progress: Callable[[str, float], object] | None = None,
    ) -> NDArray[np.float32]:
        """Computes disparities ``u_left - u_right`` of the pixels of `left`.

        Parameters
        ----------
        left, right : array_like, shape (H, W)
            Rectified gray images whose matches share a row. Both uint8, or both float with
            any range; their minimum and maximum are mapped to 0 and 255.
        progress : callable, optional
            Called with the stage and the completed fraction.

        Returns
        -------
        ndarray of float32, shape (H, W)
            Pixels; NaN where unknown.

        Raises
        ------
        ValueError
            If an option is out of range, or the volume (pixels × disparities) is too large
            for memory.
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class DepthInterval:
    """Depths compatible with an uncertain disparity.

    Parameters
    ----------
    near_m
        Smallest depth, meters.
    far_m
        Largest depth, meters; None if the interval reaches infinity.
    """
    def __new__(cls, near_m: float, far_m: float | None) -> DepthInterval: ...
    @property
    def near_m(self) -> float:
        """Smallest depth, meters."""
    @property
    def far_m(self) -> float | None:
        """Largest depth, meters; None if the interval reaches infinity."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class PointCloud:
    """Points in space.

    Parameters
    ----------
    points : ndarray of float64, shape (N, 3)
    colors : ndarray of uint8, shape (N, 3), optional
        Red, green, blue.
    normals : ndarray of float64, shape (N, 3), optional
        Unit normals.
    confidences : ndarray of float32, shape (N,), optional
        Number of photos that agree on each point.
    """
    def __new__(
        cls,
        points: NDArray[np.float64],
        colors: NDArray[np.uint8] | None = None,
        normals: NDArray[np.float64] | None = None,
        confidences: NDArray[np.float32] | None = None,
    ) -> PointCloud: ...
    @property
    def points(self) -> NDArray[np.float64]:
        """Points, shape (N, 3)."""
    @property
    def colors(self) -> NDArray[np.uint8] | None:
        """Colors, uint8 of shape (N, 3), or None."""
    @property
    def normals(self) -> NDArray[np.float64] | None:
        """Unit normals, shape (N, 3), or None."""
    @property
    def confidences(self) -> NDArray[np.float32] | None:
        """Number of photos that agree on each point, float32 of shape (N,), or None."""
    def __eq__(self, other: object, /) -> bool: ...
    def __len__(self) -> int: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class PixelMap:
    """Map from each pixel of a result to a position in a source image.

    Parameters
    ----------
    sources : array_like of float, shape (H, W, 2)
        (u, v) in the source, pixels; NaN for none. Stored as float32.
    """
    def __new__(cls, sources: ArrayLike) -> PixelMap: ...
    @property
    def width(self) -> int:
        """Width of the result, pixels."""
    @property
    def height(self) -> int:
        """Height of the result, pixels."""
    @property
    def sources(self) -> NDArray[np.float32]:
        """Positions in the source, float32 of shape (H, W, 2); NaN for none."""
    def __eq__(self, other: object, /) -> bool: ...
    @staticmethod
    def from_homography(
        width: int,
        height: int,
        out_from_source: ArrayLike,
        *,
        progress: Callable[[str, float], object] | None = None,
    ) -> PixelMap:
        """Creates the map of a homography.

        Parameters
        ----------
        width, height : int
            Size of the result, pixels.
        out_from_source : array_like, shape (3, 3)
            Homography from pixels of the source to pixels of the result, at any scale.
        progress : callable, optional
            Called with the stage and the completed fraction.

        Raises
        ------
        epipole.DegenerateError
            If the matrix has no inverse.
        ValueError
            If the result has more than 2**32 pixels.
        """
    def source(self, u: int, v: int) -> NDArray[np.float64] | None:
        """Returns the source position of pixel (u, v) of the result, shape (2,), or None.

        Parameters
        ----------
        u, v : int
            Column and row of the result.
        """
    def warp(
        self,
        source: ArrayLike,
        *,
        progress: Callable[[str, float], object] | None = None,
    ) -> NDArray[Any]:
        """Warps an image, bilinearly, with 0 where nothing is read.

        Parameters
        ----------
        source : array_like, shape (h, w) or (h, w, 3)
        progress : callable, optional
            Called with the stage and the completed fraction.

        Returns
        -------
        ndarray of uint8 or float32, shape (H, W) or (H, W, 3)
            uint8 for a uint8 image, else float32.
        """
    def mask(self, source_width: int, source_height: int) -> NDArray[np.uint8]:
        """Returns 255 where an image of the given size is read, else 0; uint8 of shape (H, W).

        Parameters
        ----------
        source_width, source_height : int
            Size of the image, pixels.
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class PixelRect:
    """Rectangle of pixel coordinates.

    Parameters
    ----------
    u_min
        Left edge.
    v_min
        Top edge.
    u_max
        Right edge.
    v_max
        Bottom edge.
    """
    def __new__(cls, u_min: float, v_min: float, u_max: float, v_max: float) -> PixelRect: ...
    @property
    def u_min(self) -> float:
        """Left edge."""
    @property
    def v_min(self) -> float:
        """Top edge."""
    @property
    def u_max(self) -> float:
        """Right edge."""
    @property
    def v_max(self) -> float:
        """Bottom edge."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class Rectification:
    """Rectified rig: two virtual parallel cameras with the same focal length.

    Matches share a row, or a column if `is_vertical`. Created by `rectify_calibrated`.

    Parameters
    ----------
    cameras : tuple of Camera
        Cameras of the photos.
    rect_from_cam : array_like, shape (2, 3, 3)
        Rotations of the cameras' rays into the rectified frame.
    intrinsics : tuple of Intrinsics
        Intrinsics of the rectified images.
    homographies : array_like, shape (2, 3, 3)
        Homographies from undistorted pixels of the photos to rectified pixels.
    q : array_like, shape (4, 4)
        ``(X, Y, Z, W) = q @ (u, v, d, 1)``.
    is_vertical : bool
    baseline_m : float
        Distance between the cameras, meters.
    width, height : int
        Size of the rectified images, pixels.
    valid : tuple of PixelRect
        Part of each rectified image that its photo fills.

    Raises
    ------
    ValueError
        If a matrix in ``rect_from_cam`` is not a rotation.
    """
    def __new__(
        cls,
        cameras: tuple[Camera, Camera],
        rect_from_cam: ArrayLike,
        intrinsics: tuple[Intrinsics, Intrinsics],
        homographies: ArrayLike,
        q: ArrayLike,
        is_vertical: bool,
        baseline_m: float,
        width: int,
        height: int,
        valid: tuple[PixelRect, PixelRect],
    ) -> Rectification: ...
    @property
    def cameras(self) -> tuple[Camera, Camera]:
        """Cameras of the photos, a pair."""
    @property
    def rect_from_cam(self) -> NDArray[np.float64]:
        """Rotations of the cameras' rays into the rectified frame, shape (2, 3, 3)."""
    @property
    def intrinsics(self) -> tuple[Intrinsics, Intrinsics]:
        """Intrinsics of the rectified images, a pair."""
    @property
    def homographies(self) -> NDArray[np.float64]:
        """Homographies from undistorted pixels of the photos to rectified pixels, shape (2, 3, 3)."""
    @property
    def q(self) -> NDArray[np.float64]:
        """Q, ``(X, Y, Z, W) = Q @ (u, v, d, 1)`` in camera 1's rectified frame, shape (4, 4)."""
    @property
    def is_vertical(self) -> bool:
        """Whether matches share a column: the second camera is above or below the first."""
    @property
    def baseline_m(self) -> float:
        """Distance between the cameras, meters."""
    @property
    def width(self) -> int:
        """Width of the rectified images, pixels."""
    @property
    def height(self) -> int:
        """Height of the rectified images, pixels."""
    @property
    def valid(self) -> tuple[PixelRect, PixelRect]:
        """Large rectangles of the rectified images that are full of image content, a pair."""
    def __eq__(self, other: object, /) -> bool: ...
    def rectify_pixel(self, index: int, pixel: ArrayLike) -> NDArray[np.float64]:
        """Maps pixels of photo 0 or 1 to rectified pixels.

        Parameters
        ----------
        index : int
            0 or 1.
        pixel : array_like, shape (2,) or (N, 2)

        Returns
        -------
        ndarray of the same shape
            Rows of NaN for pixels behind the rectified camera.

        Raises
        ------
        epipole.DegenerateError
            If a single pixel is given and has no ray, or its ray is behind the rectified camera.
        ValueError
            If ``index`` is not 0 or 1.
        """
    def source_pixel(self, index: int, rectified: ArrayLike) -> NDArray[np.float64]:
        """Maps rectified pixels to pixels of photo 0 or 1.

        Parameters
        ----------
        index : int
            0 or 1.
        rectified : array_like, shape (2,) or (N, 2)

        Returns
        -------
        ndarray of the same shape
            Rows of NaN for pixels outside the camera's view.

        Raises
        ------
        epipole.DegenerateError
            If a single pixel is given and the camera does not see it.
        ValueError
            If ``index`` is not 0 or 1.
        """
    def map(
        self,
        index: int,
        *,
        progress: Callable[[str, float], object] | None = None,
    ) -> PixelMap:
        """Creates the map that rectifies photo 0 or 1.

        Parameters
        ----------
        index : int
            0 for the first camera, 1 for the second.
        progress : callable, optional
            Called with the stage and the completed fraction.

        Raises
        ------
        ValueError
            If ``index`` is not 0 or 1.
        """
    def disparity_of(self, place: ArrayLike) -> NDArray[np.float64]:
        """Projects points into the first rectified image, with their disparities.

        Parameters
        ----------
        place : array_like, shape (3,) or (N, 3)
            Points in the frame of the first photo's camera, in the unit of the baseline.

        Returns
        -------
        ndarray, shape (3,) or (N, 3)
            (u, v, disparity), pixels. Rows of NaN for points behind the camera.

        Raises
        ------
        epipole.DegenerateError
            If a single point is given and a camera does not see it.
        """
    def disparity_range(self, places: ArrayLike) -> tuple[int, int]:
        """Returns the minimum and maximum disparity to search, pixels, from points in both photos.

        Parameters
        ----------
        places : array_like, shape (N, 3)
            Points in the frame of the first photo's camera, in the unit of the baseline.

        Returns
        -------
        first, last : int

        Raises
        ------
        epipole.TooFewError
            If the first image shows fewer than 8 points.
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class RectifiedPair:
    """Two photos warped by a rectified rig.

    Empty borders get no disparities, and images of vertical rigs are transposed for matching.

    Parameters
    ----------
    rig : Rectification
    image1, image2 : array_like, shape (H, W, 3)
        uint8, with the image sizes of the rig's cameras.
    progress : callable, optional
        Called with the stage and the completed fraction.
    """
    def __new__(
        cls,
        rig: Rectification,
        image1: ArrayLike,
        image2: ArrayLike,
        *,
        progress: Callable[[str, float], object] | None = None,
    ) -> RectifiedPair: ...
    @property
    def rig(self) -> Rectification:
        """Rectified rig."""
    @property
    def image1(self) -> NDArray[np.uint8]:
        """First photo, uint8 of shape (H, W, 3)."""
    @property
    def image2(self) -> NDArray[np.uint8]:
        """Second photo, uint8 of shape (H, W, 3)."""
    @property
    def pictures(self) -> tuple[NDArray[np.uint8], NDArray[np.uint8]]:
        """Rectified photos, black outside the image content.

        Returns
        -------
        first, second : ndarray of uint8, shape (h, w, 3)
        """
    @property
    def num_shown(self) -> int:
        """Number of pixels of the first rectified photo with image content."""
    def __eq__(self, other: object, /) -> bool: ...
    def disparity(
        self,
        matching: StereoSgm | StereoBm | Callable[..., Any],
        *,
        progress: Callable[[str, float], object] | None = None,
    ) -> NDArray[np.float32]:
        """Computes disparities of the first rectified photo, along the columns if the rig is vertical.

        Parameters
        ----------
        matching : StereoSgm, StereoBm or callable
            ``matching(left, right)`` returns the disparities of two uint8 gray images whose matches
            share a row: float of shape (h, w), NaN where unknown.
        progress : callable, optional
            Called with the stage and the completed fraction, for a matcher of this module.

        Returns
        -------
        ndarray of float32, shape (h, w)
            Pixels; NaN where unknown.

        Raises
        ------
        ValueError
            If an option of the matcher is out of range, or the disparities differ in size from the
            images.
        """
    def filled(
        self,
        disparity: ArrayLike,
        *,
        progress: Callable[[str, float], object] | None = None,
    ) -> NDArray[np.float32]:
        """Fills the disparities of all pixels with image content, like `fill_gaps`.

        Parameters
        ----------
        disparity : array_like of float, shape (h, w)
            Pixels; NaN where unknown.
        progress : callable, optional
            Called with the stage and the completed fraction.

        Returns
        -------
        ndarray of float32, shape (h, w)
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class UncalibratedRectification:
    """Homographies that move matches into the same row, or column.

    Parameters
    ----------
    homographies
        Homographies from pixels of the photos to rectified pixels, shape (2, 3, 3).
    is_vertical
        Whether matches share a column instead of a row.
    disparity_range_px
        Minimum and maximum disparity of the matches, pixels.
    outlines
        Bounding rectangles of the rectified photos, a pair.
    """
    def __new__(
        cls,
        homographies: NDArray[np.float64],
        is_vertical: bool,
        disparity_range_px: tuple[float, float],
        outlines: tuple[PixelRect, PixelRect],
    ) -> UncalibratedRectification: ...
    @property
    def homographies(self) -> NDArray[np.float64]:
        """Homographies from pixels of the photos to rectified pixels, shape (2, 3, 3)."""
    @property
    def is_vertical(self) -> bool:
        """Whether matches share a column instead of a row."""
    @property
    def disparity_range_px(self) -> tuple[float, float]:
        """Minimum and maximum disparity of the matches, pixels."""
    @property
    def outlines(self) -> tuple[PixelRect, PixelRect]:
        """Bounding rectangles of the rectified photos, a pair."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

def rectify_calibrated(
    camera1: Camera,
    camera2: Camera,
    cam2_from_cam1: RigidTransform,
    **options: Unpack[option_types.RectifyOptions],
) -> Rectification:
    """Rectifies two calibrated cameras.

    Parameters
    ----------
    camera1, camera2 : Camera
        Cameras of the first (left) and second (right) photo, with equal image sizes.
    cam2_from_cam1 : RigidTransform
        Translation in meters.
    **options : RectifyOptions
        ``alpha=0.0``: from 0, only valid pixels, to 1, all pixels of the photos; ``size=(width,
        height)`` of the rectified images, pixels; ``zero_disparity_at_infinity=True``.

    Returns
    -------
    Rectification

    Raises
    ------
    epipole.DegenerateError
        If the cameras are at the same position, the baseline is more than 60° off the image plane,
        a camera looks along the baseline, or the lens model folds less than halfway to the border.
    ValueError
        If the cameras differ in image size, ``alpha`` is outside [0, 1], or a side is shorter than
        2 pixels.
    """
def q_from_rig(
    focal_px: float,
    baseline_m: float,
    cu_px: float,
    cv_px: float,
) -> NDArray[np.float64]:
    """Computes Q of a rectified pair with common focal length and principal point.

    Parameters
    ----------
    focal_px : float
        Focal length, pixels, > 0.
    baseline_m : float
        Distance between the cameras, meters, > 0.
    cu_px, cv_px : float
        Principal point, pixels.

    Returns
    -------
    ndarray, shape (4, 4)
        ``(X, Y, Z, W) = Q @ (u, v, d, 1)``

    Raises
    ------
    ValueError
        If the focal length or baseline is not above 0.
    """
def rectify_uncalibrated(
    fundamental: ArrayLike,
    pixels1: ArrayLike,
    pixels2: ArrayLike,
    width: int,
    height: int,
) -> UncalibratedRectification:
    """Rectifies a pair from its fundamental matrix and matches (Hartley).

    Parameters
    ----------
    fundamental : array_like, shape (3, 3)
    pixels1, pixels2 : array_like, shape (N, 2)
        Matches, inliers of F, N >= 3.
    width, height : int
        Size of both photos, pixels.

    Returns
    -------
    UncalibratedRectification

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 3 matches.
    epipole.DegenerateError
        If an epipole is in or near its photo, the matrix has rank 1 or 0, or all matches are on a
        line.
    ValueError
        If a side is shorter than 2 pixels.
    """
def remove_speckles(
    disparity: ArrayLike,
    min_size: int,
    range_px: float,
    *,
    progress: Callable[[str, float], object] | None = None,
) -> NDArray[np.float32]:
    """Removes small connected sets of disparities.

    Parameters
    ----------
    disparity : array_like of float, shape (H, W)
        Pixels; NaN where unknown.
    min_size : int
        Sets with fewer pixels are removed.
    range_px : float
        Neighbors are connected if their disparities differ by at most this, pixels, >= 0.
    progress : callable, optional
        Called with the stage and the completed fraction.

    Returns
    -------
    ndarray of float32, shape (H, W)

    Raises
    ------
    ValueError
        If ``range_px`` is below 0.
    """
def fill_gaps(
    disparity: ArrayLike,
    left: ArrayLike,
    *,
    progress: Callable[[str, float], object] | None = None,
) -> NDArray[np.float32]:
    """Fills all gaps with the disparity of the background beside them.

    Parameters
    ----------
    disparity : array_like of float, shape (H, W)
        Pixels; NaN where unknown.
    left : array_like, shape (H, W)
        Gray image of the disparities, uint8 or float in [0, 1].
    progress : callable, optional
        Called with the stage and the completed fraction.

    Returns
    -------
    ndarray of float32, shape (H, W)
        NaN everywhere if no disparity is known.
    """
def depth_from_disparity(
    focal_px: float,
    baseline_m: float,
    disparity_px: float | ArrayLike,
) -> Any:
    """Computes the depth of points in a rectified pair, ``focal_px * baseline_m / disparity_px``.

    Parameters
    ----------
    focal_px : float
        Focal length of both cameras, pixels, > 0.
    baseline_m : float
        Distance between the cameras, meters, > 0.
    disparity_px : float or array_like, shape (N,)
        ``u_left - u_right``, pixels; see `depth_image` for images.

    Returns
    -------
    float or ndarray, shape (N,)
        Meters. NaN for disparities <= 0.

    Raises
    ------
    epipole.DegenerateError
        If a single disparity is given and is not above 0.
    ValueError
        If the focal length or baseline is not above 0.

    Examples
    --------
    >>> depth_from_disparity(500.0, 0.1, 25.0)
    2.0
    """
def depth_interval(
    focal_px: float,
    baseline_m: float,
    disparity_px: float,
    error_px: float,
) -> DepthInterval:
    """Computes the depths between ``f * B / (d + error_px)`` and ``f * B / (d - error_px)``.

    Parameters
    ----------
    focal_px : float
        Focal length of both cameras, pixels, > 0.
    baseline_m : float
        Distance between the cameras, meters, > 0.
    disparity_px : float
        Pixels.
    error_px : float
        Maximum error of the disparity, pixels, >= 0.

    Returns
    -------
    DepthInterval

    Raises
    ------
    epipole.DegenerateError
        If no depth is possible, because ``disparity_px + error_px <= 0``.
    ValueError
        If the focal length or baseline is not above 0, or ``error_px`` is below 0.
    """
def depth_image(
    disparity: ArrayLike,
    focal_px: float,
    baseline_m: float,
) -> NDArray[np.float32]:
    """Computes the depth of every pixel, ``focal_px * baseline_m / disparity``.

    Parameters
    ----------
    disparity : array_like of float, shape (H, W)
        Pixels; NaN where unknown.
    focal_px : float
        Focal length of both cameras, pixels, > 0.
    baseline_m : float
        Distance between the cameras, meters, > 0.

    Returns
    -------
    ndarray of float32, shape (H, W)
        Meters; NaN where the disparity is unknown or <= 0.

    Raises
    ------
    ValueError
        If the focal length or baseline is not above 0.
    """
def point_cloud(
    disparity: ArrayLike,
    q: ArrayLike,
    colors: ArrayLike | None = None,
) -> PointCloud:
    """Computes points in the first camera's frame, ``(X, Y, Z, W) = Q @ (u, v, d, 1)``.

    Parameters
    ----------
    disparity : array_like of float, shape (H, W)
        Pixels; NaN where unknown.
    q : array_like, shape (4, 4)
        `Rectification.q`, or the result of `q_from_rig`.
    colors : array_like, shape (H, W, 3), optional
        Rectified first image, uint8.

    Returns
    -------
    PointCloud
        Omits pixels without disparity, points at infinity and points behind the camera.
    """
