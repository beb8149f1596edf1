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
    """Dense disparity of a rectified pair by block matching: fast.

    Parameters
    ----------
    **options : StereoBm
        Such as ``num_disparities``, ``min_disparity_px``, ``window_px`` (odd), and ``filter``,
        a dict with entries such as ``"speckle_size"``. ``StereoBm()`` shows all, with defaults.
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
        """Disparities ``u_left - u_right`` of the pixels of `left`.

        Parameters
        ----------
        left, right : array_like, shape (H, W)
            Rectified gray images: matches share a row. Both uint8, or both float of any
            range, whose smallest and largest value become 0 and 255.
        progress : callable, optional
            Called with the stage and the completed share.

        Returns
        -------
        ndarray of float32, shape (H, W)
            Pixels; NaN where unknown.

        Raises
        ------
        ValueError
            Option out of range, or too many pixels times disparities for the memory.
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class StereoSgm:
    """Dense disparity of a rectified pair by semi-global matching.

    Parameters
    ----------
    **options : StereoSgm
        Such as ``num_disparities``, ``min_disparity_px``, ``paths`` ("four", "five", "eight"),
        and ``filter``, a dict with entries such as ``"speckle_size"``. ``StereoSgm()`` shows
        all, with defaults.
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
        """Disparities ``u_left - u_right`` of the pixels of `left`.

        Parameters
        ----------
        left, right : array_like, shape (H, W)
            Rectified gray images: matches share a row. Both uint8, or both float of any
            range, whose smallest and largest value become 0 and 255.
        progress : callable, optional
            Called with the stage and the completed share.

        Returns
        -------
        ndarray of float32, shape (H, W)
            Pixels; NaN where unknown.

        Raises
        ------
        ValueError
            Option out of range, or too many pixels times disparities for the memory.
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class DepthInterval:
    """Depths that an uncertain disparity allows.

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
        Numbers of photos that agree on a point.
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
        """Numbers of photos that agree on a point, float32 of shape (N,), or None."""
    def __eq__(self, other: object, /) -> bool: ...
    def __len__(self) -> int: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class PixelMap:
    """Place in a source image that each pixel of a result is read from.

    Parameters
    ----------
    sources : array_like of float, shape (H, W, 2)
        (u, v) in the source, pixels; NaN for none. Kept as float32.
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
        """Places in the source, float32 of shape (H, W, 2); NaN for none."""
    def __eq__(self, other: object, /) -> bool: ...
    @staticmethod
    def from_homography(
        width: int,
        height: int,
        out_from_source: ArrayLike,
        *,
        progress: Callable[[str, float], object] | None = None,
    ) -> PixelMap:
        """Map of a homography.

        Parameters
        ----------
        width, height : int
            Size of the result, pixels.
        out_from_source : array_like, shape (3, 3)
            Pixels of the source to pixels of the result, up to scale.
        progress : callable, optional
            Called with the stage and the completed share.

        Raises
        ------
        epipole.DegenerateError
            Matrix without an inverse.
        ValueError
            Result of more than 2**32 pixels.
        """
    def source(self, u: int, v: int) -> NDArray[np.float64] | None:
        """Place in the source that pixel (u, v) of the result is read from, shape (2,), or None.

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
        """Redrawn image, bilinear, 0 where nothing is read.

        Parameters
        ----------
        source : array_like, shape (h, w) or (h, w, 3)
        progress : callable, optional
            Called with the stage and the completed share.

        Returns
        -------
        ndarray of uint8 or float32, shape (H, W) or (H, W, 3)
            uint8 for uint8, else float32.
        """
    def mask(self, source_width: int, source_height: int) -> NDArray[np.uint8]:
        """Mask of the pixels that read an image of the given size, uint8 of shape (H, W): 255 or 0.

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
        Left end.
    v_min
        Upper end.
    u_max
        Right end.
    v_max
        Lower end.
    """
    def __new__(cls, u_min: float, v_min: float, u_max: float, v_max: float) -> PixelRect: ...
    @property
    def u_min(self) -> float:
        """Left end."""
    @property
    def v_min(self) -> float:
        """Upper end."""
    @property
    def u_max(self) -> float:
        """Right end."""
    @property
    def v_max(self) -> float:
        """Lower end."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class Rectification:
    """Rectified rig: two virtual cameras that are parallel and share a focal length.

    Matches share a row, or a column if `is_vertical`. `rectify_calibrated` makes it.

    Parameters
    ----------
    cameras : tuple of Camera
        Of the photos.
    rect_from_cam : array_like, shape (2, 3, 3)
        Rotations of the cameras' rays into the rectified frame.
    intrinsics : tuple of Intrinsics
        Of the rectified pictures.
    homographies : array_like, shape (2, 3, 3)
        From pixels of the photos to those of the pictures, for a pinhole.
    q : array_like, shape (4, 4)
        ``(X, Y, Z, W) = q @ (u, v, d, 1)``.
    is_vertical : bool
    baseline_m : float
        Meters.
    width, height : int
        Size of the pictures, pixels.
    valid : tuple of PixelRect
        Part of each picture that its photo fills.

    Raises
    ------
    ValueError
        Matrix in ``rect_from_cam`` that is no rotation.
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
        """Q of ``(X, Y, Z, W) = Q @ (u, v, d, 1)``, in the rectified frame of the first camera, shape
        (4, 4).
        """
    @property
    def is_vertical(self) -> bool:
        """Whether matches share a column: the second camera is above or below the first."""
    @property
    def baseline_m(self) -> float:
        """Distance of the cameras, meters."""
    @property
    def width(self) -> int:
        """Width of the rectified images, pixels."""
    @property
    def height(self) -> int:
        """Height of the rectified images, pixels."""
    @property
    def valid(self) -> tuple[PixelRect, PixelRect]:
        """Large rectangles in the rectified images that the cameras saw whole, a pair."""
    def __eq__(self, other: object, /) -> bool: ...
    def rectify_pixel(self, index: int, pixel: ArrayLike) -> NDArray[np.float64]:
        """Rectified pixels of pixels of photo 0 or 1.

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
            Single pixel without a ray, or with one behind the rectified camera.
        ValueError
            ``index`` not 0 or 1.
        """
    def source_pixel(self, index: int, rectified: ArrayLike) -> NDArray[np.float64]:
        """Pixels of photo 0 or 1 that rectified pixels are read from.

        Parameters
        ----------
        index : int
            0 or 1.
        rectified : array_like, shape (2,) or (N, 2)

        Returns
        -------
        ndarray of the same shape
            Rows of NaN for pixels that the camera cannot see.

        Raises
        ------
        epipole.DegenerateError
            Single pixel that the camera does not see.
        ValueError
            ``index`` not 0 or 1.
        """
    def map(
        self,
        index: int,
        *,
        progress: Callable[[str, float], object] | None = None,
    ) -> PixelMap:
        """Map that redraws photo 0 or 1.

        Parameters
        ----------
        index : int
            0 for the first camera, 1 for the second.
        progress : callable, optional
            Called with the stage and the completed share.

        Raises
        ------
        ValueError
            ``index`` not 0 or 1.
        """
    def disparity_of(self, place: ArrayLike) -> NDArray[np.float64]:
        """Pixels of the first rectified image that show points, and their disparities.

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
            Single point that a camera does not see.
        """
    def disparity_range(self, places: ArrayLike) -> tuple[int, int]:
        """Smallest and largest disparity to search, pixels, from points that both photos show.

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
            Fewer than 8 points that the first image shows.
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class RectifiedPair:
    """Two photos as a rectified rig sees them.

    Borders that no photo fills have no disparities, and vertical rigs are turned for matching.

    Parameters
    ----------
    rig : Rectification
    photograph1, photograph2 : array_like, shape (H, W, 3)
        uint8, of the sizes of the rig's cameras.
    progress : callable, optional
        Called with the stage and the completed share.
    """
    def __new__(
        cls,
        rig: Rectification,
        photograph1: ArrayLike,
        photograph2: ArrayLike,
        *,
        progress: Callable[[str, float], object] | None = None,
    ) -> RectifiedPair: ...
    @property
    def rig(self) -> Rectification:
        """Rectified rig."""
    @property
    def photograph1(self) -> NDArray[np.uint8]:
        """First photo, uint8 of shape (H, W, 3)."""
    @property
    def photograph2(self) -> NDArray[np.uint8]:
        """Second photo, uint8 of shape (H, W, 3)."""
    @property
    def pictures(self) -> tuple[NDArray[np.uint8], NDArray[np.uint8]]:
        """Redrawn photos, black where they fill nothing.

        Returns
        -------
        first, second : ndarray of uint8, shape (h, w, 3)
        """
    @property
    def num_shown(self) -> int:
        """Number of pixels of the first picture that its photo fills."""
    def __eq__(self, other: object, /) -> bool: ...
    def disparity(
        self,
        matching: StereoSgm | StereoBm | Callable[..., Any],
        *,
        progress: Callable[[str, float], object] | None = None,
    ) -> NDArray[np.float32]:
        """Disparities of the first picture, along the columns if the rig is vertical.

        Parameters
        ----------
        matching : StereoSgm, StereoBm or callable
            ``matching(left, right)`` returns the disparities of two uint8 gray images whose matches
            share a row, float of shape (h, w), NaN where unknown.
        progress : callable, optional
            Called with the stage and the completed share, for a matcher of this module.

        Returns
        -------
        ndarray of float32, shape (h, w)
            Pixels; NaN where unknown.

        Raises
        ------
        ValueError
            Option of the matcher out of range, or disparities of another size than the images.
        """
    def filled(
        self,
        disparity: ArrayLike,
        *,
        progress: Callable[[str, float], object] | None = None,
    ) -> NDArray[np.float32]:
        """Disparities of every pixel that the first photo fills, as `fill_gaps`.

        Parameters
        ----------
        disparity : array_like of float, shape (h, w)
            Pixels; NaN where unknown.
        progress : callable, optional
            Called with the stage and the completed share.

        Returns
        -------
        ndarray of float32, shape (h, w)
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class UncalibratedRectification:
    """Homographies that put matches into the same row, or column.

    Parameters
    ----------
    homographies
        Homographies from pixels of the photos to rectified pixels, shape (2, 3, 3).
    is_vertical
        Whether matches share a column instead of a row.
    disparity_range_px
        Smallest and largest disparity among the matches, pixels.
    outlines
        Smallest rectangles around the rectified photos, a pair.
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
        """Smallest and largest disparity among the matches, pixels."""
    @property
    def outlines(self) -> tuple[PixelRect, PixelRect]:
        """Smallest rectangles around the rectified photos, a pair."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

def rectify_calibrated(
    camera1: Camera,
    camera2: Camera,
    cam2_from_cam1: RigidTransform,
    **options: Unpack[option_types.RectifyOptions],
) -> Rectification:
    """Rectification of two calibrated cameras.

    Parameters
    ----------
    camera1, camera2 : Camera
        Cameras of the first (left) and second (right) photo, of the same size.
    cam2_from_cam1 : RigidTransform
        Translation in meters.
    **options : RectifyOptions
        ``alpha=0.0``: from 0, only valid pixels, to 1, all pixels of the photos; ``size=(width,
        height)`` of the results, pixels; ``zero_disparity_at_infinity=True``.

    Returns
    -------
    Rectification

    Raises
    ------
    epipole.DegenerateError
        Cameras at the same place, a baseline more than 60° off the image plane, a photo that looks
        along the baseline, or a lens model that folds less than half-way to the border.
    ValueError
        Cameras of different image size, ``alpha`` outside [0, 1], or a side of less than 2 pixels.
    """
def q_from_rig(
    focal_px: float,
    baseline_m: float,
    cu_px: float,
    cv_px: float,
) -> NDArray[np.float64]:
    """Q of a rectified pair with common focal length and principal point.

    Parameters
    ----------
    focal_px : float
        Pixels, > 0.
    baseline_m : float
        Meters, > 0.
    cu_px, cv_px : float
        Principal point, pixels.

    Returns
    -------
    ndarray, shape (4, 4)
        ``(X, Y, Z, W) = Q @ (u, v, d, 1)``

    Raises
    ------
    ValueError
        Focal length or baseline not above 0.
    """
def rectify_uncalibrated(
    fundamental: ArrayLike,
    pixels1: ArrayLike,
    pixels2: ArrayLike,
    width: int,
    height: int,
) -> UncalibratedRectification:
    """Rectification from a fundamental matrix and matches (Hartley).

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
        Fewer than 3 matches.
    epipole.DegenerateError
        Epipole in or near its photo, matrix of rank 1 or 0, or all matches on one line.
    ValueError
        Side of less than 2 pixels.
    """
def remove_speckles(
    disparity: ArrayLike,
    min_size: int,
    range_px: float,
    *,
    progress: Callable[[str, float], object] | None = None,
) -> NDArray[np.float32]:
    """Disparities without small connected sets.

    Parameters
    ----------
    disparity : array_like of float, shape (H, W)
        Pixels; NaN where unknown.
    min_size : int
        Sets of fewer pixels are removed.
    range_px : float
        Neighbors are connected if they differ by at most this, pixels, >= 0.
    progress : callable, optional
        Called with the stage and the completed share.

    Returns
    -------
    ndarray of float32, shape (H, W)

    Raises
    ------
    ValueError
        ``range_px`` below 0.
    """
def fill_gaps(
    disparity: ArrayLike,
    left: ArrayLike,
    *,
    progress: Callable[[str, float], object] | None = None,
) -> NDArray[np.float32]:
    """Disparities of every pixel: gaps take those of the background beside them.

    Parameters
    ----------
    disparity : array_like of float, shape (H, W)
        Pixels; NaN where unknown.
    left : array_like, shape (H, W)
        Gray image that the disparities belong to, uint8 or float in [0, 1].
    progress : callable, optional
        Called with the stage and the completed share.

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
    """Depth of a point seen by a rectified pair, ``focal_px * baseline_m / disparity_px``.

    Parameters
    ----------
    focal_px : float
        Focal length of both cameras, pixels, > 0.
    baseline_m : float
        Distance of the cameras, meters, > 0.
    disparity_px : float or array_like, shape (N,)
        ``u_left - u_right``, pixels; `depth_image` takes images.

    Returns
    -------
    float or ndarray, shape (N,)
        Meters. NaN for disparities <= 0.

    Raises
    ------
    epipole.DegenerateError
        Single disparity not above 0.
    ValueError
        Focal length or baseline not above 0.

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
    """Depths between ``f * B / (d + error_px)`` and ``f * B / (d - error_px)``.

    Parameters
    ----------
    focal_px : float
        Focal length of both cameras, pixels, > 0.
    baseline_m : float
        Distance of the cameras, meters, > 0.
    disparity_px : float
        Pixels.
    error_px : float
        Largest error of the disparity, pixels, >= 0.

    Returns
    -------
    DepthInterval

    Raises
    ------
    epipole.DegenerateError
        No possible depth, as ``disparity_px + error_px <= 0``.
    ValueError
        Focal length or baseline not above 0, or ``error_px`` below 0.
    """
def depth_image(
    disparity: ArrayLike,
    focal_px: float,
    baseline_m: float,
) -> NDArray[np.float32]:
    """Depth of every pixel, ``focal_px * baseline_m / disparity``.

    Parameters
    ----------
    disparity : array_like of float, shape (H, W)
        Pixels; NaN where unknown.
    focal_px : float
        Focal length of both cameras, pixels, > 0.
    baseline_m : float
        Distance of the cameras, meters, > 0.

    Returns
    -------
    ndarray of float32, shape (H, W)
        Meters; NaN where the disparity is unknown or <= 0.

    Raises
    ------
    ValueError
        Focal length or baseline not above 0.
    """
def point_cloud(
    disparity: ArrayLike,
    q: ArrayLike,
    colors: ArrayLike | None = None,
) -> PointCloud:
    """Points of a rectified pair, ``(X, Y, Z, W) = Q @ (u, v, d, 1)``, in the first camera's frame.

    Parameters
    ----------
    disparity : array_like of float, shape (H, W)
        Pixels; NaN where unknown.
    q : array_like, shape (4, 4)
        `Rectification.q`, or that of `q_from_rig`.
    colors : array_like, shape (H, W, 3), optional
        Rectified first image, uint8.

    Returns
    -------
    PointCloud
        Without pixels of unknown disparity, points at infinity and points behind the camera.
    """
