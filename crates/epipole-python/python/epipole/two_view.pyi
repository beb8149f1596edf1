# Written by stubs.py. Do not edit.

from collections.abc import Callable
from typing import ClassVar, final

import numpy as np
from numpy.typing import ArrayLike, NDArray
from typing_extensions import Unpack

from epipole import options as option_types
from epipole.camera import Camera
from epipole.camera import RigidTransform
from epipole.robust import RansacReport

__all__ = [
    "Degeneracy",
    "ExplainingRotation",
    "PHOTO_MAX_ERROR_PX",
    "RotationAndFocal",
    "TwoViewReport",
    "estimate_rotation",
    "estimate_two_view",
    "estimate_two_view_calibrated",
    "find_degeneracy",
    "find_explaining_rotation",
    "find_rotation_and_focal",
    "find_unmoved",
]

PHOTO_MAX_ERROR_PX: float
@final
class TwoViewReport:
    """Geometry of two views.

    Parameters
    ----------
    configuration
        "general", "planar", "panoramic" or "degenerate".
    kind
        Kind of the model: "fundamental", "essential" or "homography".
    model
        Chosen matrix, shape (3, 3).
    is_of_rays
        Whether `model` and `homography` apply to rays, not pixels: lenses with distortion.
    fundamental
        F, shape (3, 3), or None.
    homography
        H, shape (3, 3), or None.
    cam2_from_cam1
        Motion of calibrated views, or None. Its translation has length 1, or 0 for a rotation.
    other_cam2_from_cam1
        Second motion that explains a plane equally well, or None.
    inliers
        Whether each match is an inlier, boolean array of shape (N,).
    num_inliers
        Number of inliers.
    num_left_out
        Number of matches ignored because a coordinate is infinite or beyond 1e9 pixels.
    max_error_px
        Threshold of F and E, pixels.
    iterations
        Number of samples drawn for all models tried.
    required_iterations
        Number of samples required for the model.
    stop
        Reason the search ended: "confident", "exhausted" or "interrupted".
    median_triangulation_angle_rad
        Median triangulation angle of the inliers, radians, or None.
    """
    def __new__(
        cls,
        configuration: str,
        kind: str,
        model: NDArray[np.float64],
        is_of_rays: bool,
        fundamental: NDArray[np.float64] | None,
        homography: NDArray[np.float64] | None,
        cam2_from_cam1: RigidTransform | None,
        other_cam2_from_cam1: RigidTransform | None,
        inliers: NDArray[np.bool_],
        num_inliers: int,
        num_left_out: int,
        max_error_px: float,
        iterations: int,
        required_iterations: int,
        stop: str,
        median_triangulation_angle_rad: float | None,
    ) -> TwoViewReport: ...
    @property
    def configuration(self) -> str:
        """"general", "planar", "panoramic" or "degenerate"."""
    @property
    def kind(self) -> str:
        """Kind of the model: "fundamental", "essential" or "homography"."""
    @property
    def model(self) -> NDArray[np.float64]:
        """Chosen matrix, shape (3, 3)."""
    @property
    def is_of_rays(self) -> bool:
        """Whether `model` and `homography` apply to rays, not pixels: lenses with distortion."""
    @property
    def fundamental(self) -> NDArray[np.float64] | None:
        """F, shape (3, 3), or None."""
    @property
    def homography(self) -> NDArray[np.float64] | None:
        """H, shape (3, 3), or None."""
    @property
    def cam2_from_cam1(self) -> RigidTransform | None:
        """Motion of calibrated views, or None. Its translation has length 1, or 0 for a rotation."""
    @property
    def other_cam2_from_cam1(self) -> RigidTransform | None:
        """Second motion that explains a plane equally well, or None."""
    @property
    def inliers(self) -> NDArray[np.bool_]:
        """Whether each match is an inlier, boolean array of shape (N,)."""
    @property
    def num_inliers(self) -> int:
        """Number of inliers."""
    @property
    def num_left_out(self) -> int:
        """Number of matches ignored because a coordinate is infinite or beyond 1e9 pixels."""
    @property
    def max_error_px(self) -> float:
        """Threshold of F and E, pixels."""
    @property
    def iterations(self) -> int:
        """Number of samples drawn for all models tried."""
    @property
    def required_iterations(self) -> int:
        """Number of samples required for the model."""
    @property
    def stop(self) -> str:
        """Reason the search ended: "confident", "exhausted" or "interrupted"."""
    @property
    def median_triangulation_angle_rad(self) -> float | None:
        """Median triangulation angle of the inliers, radians, or None."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class ExplainingRotation:
    """Rotation that explains nearly all inliers.

    Parameters
    ----------
    cam2_from_cam1
        Rotation, with a translation of 0.
    num_explained
        Number of inliers that it explains.
    num_inliers
        Number of inliers.
    """
    def __new__(
        cls,
        cam2_from_cam1: RigidTransform,
        num_explained: int,
        num_inliers: int,
    ) -> ExplainingRotation: ...
    @property
    def cam2_from_cam1(self) -> RigidTransform:
        """Rotation, with a translation of 0."""
    @property
    def num_explained(self) -> int:
        """Number of inliers that it explains."""
    @property
    def num_inliers(self) -> int:
        """Number of inliers."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class RotationAndFocal:
    """Rotation and focal length change that explain nearly all inliers.

    Parameters
    ----------
    cam2_from_cam1
        Rotation, with a translation of 0.
    focal_factor
        Ratio of the actual to the given focal lengths, for both cameras.
    num_explained
        Number of unique matches that it explains.
    num_inliers
        Number of unique matches.
    """
    def __new__(
        cls,
        cam2_from_cam1: RigidTransform,
        focal_factor: float,
        num_explained: int,
        num_inliers: int,
    ) -> RotationAndFocal: ...
    @property
    def cam2_from_cam1(self) -> RigidTransform:
        """Rotation, with a translation of 0."""
    @property
    def focal_factor(self) -> float:
        """Ratio of the actual to the given focal lengths, for both cameras."""
    @property
    def num_explained(self) -> int:
        """Number of unique matches that it explains."""
    @property
    def num_inliers(self) -> int:
        """Number of unique matches."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class Degeneracy:
    """Reason the inliers do not determine F.

    Parameters
    ----------
    kind
        "unmoved" or "homography".
    num_explained
        Number of inliers that did not move or that a homography explains.
    num_inliers
        Number of inliers.
    """
    def __new__(cls, kind: str, num_explained: int, num_inliers: int) -> Degeneracy: ...
    @property
    def kind(self) -> str:
        """"unmoved" or "homography"."""
    @property
    def num_explained(self) -> int:
        """Number of inliers that did not move or that a homography explains."""
    @property
    def num_inliers(self) -> int:
        """Number of inliers."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

def estimate_two_view(
    pixels1: ArrayLike,
    pixels2: ArrayLike,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.TwoViewOptions],
) -> TwoViewReport:
    """Estimates the geometry of two uncalibrated views: F or H.

    Parameters
    ----------
    pixels1, pixels2 : array_like, shape (N, 2)
        Matches.
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : TwoViewOptions
        ``min_num_inliers=15``, ``max_homography_ratio=0.8``, ``min_essential_ratio=0.95``, and
        ``ransac``, a dict of RANSAC options.

    Returns
    -------
    TwoViewReport

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 4 different matches.
    epipole.DegenerateError
        If all pixels of an image are on a line.
    epipole.NoConsensusError
        If every model has fewer inliers than its sample has matches.
    ValueError
        If ``ransac``, ``max_homography_ratio`` or ``min_essential_ratio`` is out of range.
    """
def estimate_two_view_calibrated(
    pixels1: ArrayLike,
    pixels2: ArrayLike,
    camera1: Camera,
    camera2: Camera,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.TwoViewOptions],
) -> TwoViewReport:
    """Estimates the geometry of two calibrated views: E, H or a rotation, and the motion.

    Parameters
    ----------
    pixels1, pixels2 : array_like, shape (N, 2)
        Matches.
    camera1, camera2 : Camera
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : TwoViewOptions

    Returns
    -------
    TwoViewReport

    Raises
    ------
    epipole.TooFewError
        If fewer than 4 different matches are given that no rotation explains, or fewer than 5
        through a lens with distortion.
    epipole.DegenerateError
        If all pixels of an image of a pinhole camera are on a line, unless a rotation explains
        them.
    epipole.NoConsensusError
        If every model has fewer inliers than its sample has matches.
    ValueError
        If ``ransac``, ``max_homography_ratio`` or ``min_essential_ratio`` is out of range.
    """
def estimate_rotation(
    pixels1: ArrayLike,
    pixels2: ArrayLike,
    camera1: Camera,
    camera2: Camera,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.RansacOptions],
) -> RansacReport[NDArray[np.float64]]:
    """Estimates the rotation between two calibrated views from the same position, by RANSAC.

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
        Its model is the rotation matrix of ``cam2_from_cam1``, shape (3, 3).

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 2 different matches.
    epipole.NoConsensusError
        If no rotation has 2 inliers.
    ValueError
        If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.
    """
def find_degeneracy(
    pixels1: ArrayLike,
    pixels2: ArrayLike,
    inliers: ArrayLike,
    **options: Unpack[option_types.TwoViewOptions],
) -> Degeneracy | None:
    """Checks whether the inliers determine F: not if nothing moved or a homography explains them.

    Parameters
    ----------
    pixels1, pixels2 : array_like, shape (N, 2)
    inliers : array_like of bool, shape (N,)
    **options : TwoViewOptions

    Returns
    -------
    Degeneracy or None

    Raises
    ------
    ValueError
        If ``ransac``, ``max_homography_ratio`` or ``min_essential_ratio`` is out of range.
    """
def find_unmoved(
    pixels1: ArrayLike,
    pixels2: ArrayLike,
    inliers: ArrayLike,
    **options: Unpack[option_types.TwoViewOptions],
) -> Degeneracy | None:
    """Checks whether nearly all inliers are at the same pixel in both images.

    Parameters
    ----------
    pixels1, pixels2 : array_like, shape (N, 2)
    inliers : array_like of bool, shape (N,)
    **options : TwoViewOptions

    Returns
    -------
    Degeneracy or None

    Raises
    ------
    ValueError
        If ``ransac``, ``max_homography_ratio`` or ``min_essential_ratio`` is out of range.

    Examples
    --------
    >>> pixels = [[i * i % 97, 5 * i] for i in range(20)]
    >>> find_unmoved(pixels, pixels, [True] * 20)
    Degeneracy(kind='unmoved', num_explained=20, num_inliers=20)
    """
def find_explaining_rotation(
    pixels1: ArrayLike,
    pixels2: ArrayLike,
    camera1: Camera,
    camera2: Camera,
    inliers: ArrayLike,
    **options: Unpack[option_types.TwoViewOptions],
) -> ExplainingRotation | None:
    """Finds a rotation that explains nearly all inliers of calibrated views.

    Parameters
    ----------
    pixels1, pixels2 : array_like, shape (N, 2)
    camera1, camera2 : Camera
    inliers : array_like of bool, shape (N,)
    **options : TwoViewOptions

    Returns
    -------
    ExplainingRotation or None

    Raises
    ------
    ValueError
        If ``ransac``, ``max_homography_ratio`` or ``min_essential_ratio`` is out of range.
    """
def find_rotation_and_focal(
    pixels1: ArrayLike,
    pixels2: ArrayLike,
    camera1: Camera,
    camera2: Camera,
    inliers: ArrayLike,
    **options: Unpack[option_types.TwoViewOptions],
) -> RotationAndFocal | None:
    """Finds a rotation and a focal length change that explain nearly all inliers.

    Parameters
    ----------
    pixels1, pixels2 : array_like, shape (N, 2)
    camera1, camera2 : Camera
    inliers : array_like of bool, shape (N,)
    **options : TwoViewOptions

    Returns
    -------
    RotationAndFocal or None

    Raises
    ------
    ValueError
        If ``ransac``, ``max_homography_ratio`` or ``min_essential_ratio`` is out of range.
    """
