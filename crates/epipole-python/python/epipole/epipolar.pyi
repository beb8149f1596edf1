# Written by stubs.py. Do not edit.

from collections.abc import Callable, Mapping, Sequence
from typing import Any, ClassVar, final

import numpy as np
from numpy.typing import ArrayLike, NDArray
from typing_extensions import Unpack

from epipole import options as option_types
from epipole.camera import Camera
from epipole.camera import Intrinsics
from epipole.camera import PosedCamera
from epipole.camera import RigidTransform
from epipole.robust import RansacReport

__all__ = [
    "EightPoint",
    "EssentialWithFocal",
    "PoseWithFocal",
    "RelativePose",
    "SelectedPose",
    "decompose_essential",
    "enforce_rank2",
    "epipolar_line1",
    "epipolar_line2",
    "epipolar_row",
    "epipoles",
    "essential_5point",
    "essential_6point",
    "essential_8point",
    "essential_from_fundamental",
    "essential_from_motion",
    "estimate_essential",
    "estimate_fundamental",
    "estimate_relative_pose",
    "estimate_relative_pose_and_focal",
    "estimate_relative_pose_with_gravity",
    "focal_lengths_from_fundamental",
    "fundamental_7point",
    "fundamental_8point",
    "fundamental_8point_explained",
    "fundamental_8point_unnormalized",
    "fundamental_from_cameras",
    "fundamental_from_essential",
    "project_to_essential",
    "refine_fundamental",
    "refine_relative_pose",
    "relative_pose_3point",
    "sampson_px",
    "select_pose",
    "symmetric_epipolar_px",
    "tangent_sampson_px",
]

@final
class RelativePose:
    """Camera motion with a translation of length 1.

    Parameters
    ----------
    rotation : array_like, shape (3, 3)
        R of ``cam2_from_cam1``.
    direction : array_like, shape (3,)
        t of ``cam2_from_cam1``, of length 1.

    Raises
    ------
    ValueError
        If the matrix is not a rotation, or the length of the direction is not 1.
    """
    def __new__(cls, rotation: ArrayLike, direction: ArrayLike) -> RelativePose: ...
    @property
    def rotation(self) -> NDArray[np.float64]:
        """R of ``cam2_from_cam1``, shape (3, 3)."""
    @property
    def direction(self) -> NDArray[np.float64]:
        """t of ``cam2_from_cam1``, of length 1, shape (3,)."""
    def __eq__(self, other: object, /) -> bool: ...
    @staticmethod
    def from_motion(cam2_from_cam1: RigidTransform) -> RelativePose:
        """Creates a relative pose from a motion, without the length of its translation.

        Parameters
        ----------
        cam2_from_cam1 : epipole.camera.RigidTransform

        Raises
        ------
        epipole.DegenerateError
            If the motion has no translation.
        """
    def essential(self) -> NDArray[np.float64]:
        """Returns E, shape (3, 3)."""
    def fundamental(self, k1: Intrinsics, k2: Intrinsics) -> NDArray[np.float64]:
        """Returns F for the pixels of two pinhole cameras, shape (3, 3).

        Parameters
        ----------
        k1, k2 : epipole.camera.Intrinsics
            Intrinsics of the two cameras.
        """
    def cam2_from_cam1(self) -> RigidTransform:
        """Returns the motion as a rigid transform."""
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class PoseWithFocal:
    """Relative pose and common focal length of two cameras.

    Parameters
    ----------
    pose
        Motion.
    fundamental
        F for pixels, shape (3, 3).
    focal_px
        Focal length of both cameras, pixels.
    focal_std_px
        Standard deviation of the focal length, pixels; None if the focal length has no effect.
    """
    def __new__(
        cls,
        pose: RelativePose,
        fundamental: NDArray[np.float64],
        focal_px: float,
        focal_std_px: float | None,
    ) -> PoseWithFocal: ...
    @property
    def pose(self) -> RelativePose:
        """Motion."""
    @property
    def fundamental(self) -> NDArray[np.float64]:
        """F for pixels, shape (3, 3)."""
    @property
    def focal_px(self) -> float:
        """Focal length of both cameras, pixels."""
    @property
    def focal_std_px(self) -> float | None:
        """Standard deviation of the focal length, pixels; None if the focal length has no effect."""
    def __eq__(self, other: object, /) -> bool: ...
    def constrains_focal(self) -> bool:
        """Whether the matches determine the focal length."""
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class EssentialWithFocal:
    """Essential matrix and common focal length of two cameras.

    Parameters
    ----------
    essential
        E, shape (3, 3).
    focal_px
        Focal length of both cameras, pixels.
    """
    def __new__(cls, essential: NDArray[np.float64], focal_px: float) -> EssentialWithFocal: ...
    @property
    def essential(self) -> NDArray[np.float64]:
        """E, shape (3, 3)."""
    @property
    def focal_px(self) -> float:
        """Focal length of both cameras, pixels."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class SelectedPose:
    """Motion of an essential matrix that puts most points in front of both cameras.

    Parameters
    ----------
    cam2_from_cam1
        Motion, with a translation of length 1.
    num_in_front
        Number of points in front of both cameras.
    second_num_in_front
        Number of points in front of both cameras for the second best motion.
    """
    def __new__(
        cls,
        cam2_from_cam1: RigidTransform,
        num_in_front: int,
        second_num_in_front: int,
    ) -> SelectedPose: ...
    @property
    def cam2_from_cam1(self) -> RigidTransform:
        """Motion, with a translation of length 1."""
    @property
    def num_in_front(self) -> int:
        """Number of points in front of both cameras."""
    @property
    def second_num_in_front(self) -> int:
        """Number of points in front of both cameras for the second best motion."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class EightPoint:
    """Fundamental matrix by the eight-point method, with intermediate results.

    Parameters
    ----------
    fundamental
        F of rank 2, shape (3, 3).
    full_rank
        Least-squares solution before its rank is reduced to 2, shape (3, 3).
    singular_values
        Singular values of the linear system, largest first, shape (9,).
    condition_number
        Ratio of the largest to the eighth singular value: amplification of data errors.
    """
    def __new__(
        cls,
        fundamental: NDArray[np.float64],
        full_rank: NDArray[np.float64],
        singular_values: NDArray[np.float64],
        condition_number: float,
    ) -> EightPoint: ...
    @property
    def fundamental(self) -> NDArray[np.float64]:
        """F of rank 2, shape (3, 3)."""
    @property
    def full_rank(self) -> NDArray[np.float64]:
        """Least-squares solution before its rank is reduced to 2, shape (3, 3)."""
    @property
    def singular_values(self) -> NDArray[np.float64]:
        """Singular values of the linear system, largest first, shape (9,)."""
    @property
    def condition_number(self) -> float:
        """Ratio of the largest to the eighth singular value: amplification of data errors."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

def estimate_fundamental(
    pixels1: ArrayLike,
    pixels2: ArrayLike,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.RansacOptions],
) -> RansacReport[NDArray[np.float64]]:
    """Estimates a fundamental matrix from matches with outliers, by RANSAC.

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
        Its model is F, shape (3, 3), with ``x2 @ F @ x1 == 0`` and unit norm.

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 7 different matches.
    epipole.DegenerateError
        If all pixels of an image are on a line.
    epipole.NoConsensusError
        If no matrix has 7 inliers.
    ValueError
        If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.
    """
def estimate_essential(
    pixels1: ArrayLike,
    pixels2: ArrayLike,
    camera1: Camera,
    camera2: Camera,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.RansacOptions],
) -> RansacReport[NDArray[np.float64]]:
    """Estimates an essential matrix from matches with outliers, by RANSAC.

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
        Its model is E, shape (3, 3), of unit norm.

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 5 different matches.
    epipole.DegenerateError
        If all pixels of an image of a pinhole camera are on a line.
    epipole.NoConsensusError
        If no matrix has 5 inliers.
    ValueError
        If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.
    """
def estimate_relative_pose(
    pixels1: ArrayLike,
    pixels2: ArrayLike,
    camera1: Camera,
    camera2: Camera,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.RansacOptions],
) -> RansacReport[RelativePose]:
    """Estimates the relative pose of two calibrated cameras from matches with outliers, by RANSAC.

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
    RansacReport of RelativePose
        Its model is a `RelativePose`.

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 5 different matches.
    epipole.DegenerateError
        If all pixels of an image of a pinhole camera are on a line.
    epipole.NoConsensusError
        If no pose has 5 inliers.
    ValueError
        If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.
    """
def estimate_relative_pose_with_gravity(
    pixels1: ArrayLike,
    pixels2: ArrayLike,
    camera1: Camera,
    camera2: Camera,
    gravity1: ArrayLike,
    gravity2: ArrayLike,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.RansacOptions],
) -> RansacReport[RelativePose]:
    """Estimates the relative pose of two calibrated cameras with known gravity, by RANSAC.

    Parameters
    ----------
    pixels1, pixels2 : array_like, shape (N, 2)
        Matches.
    camera1, camera2 : Camera
    gravity1, gravity2 : array_like, shape (3,)
        Direction of gravity in each camera's frame.
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : RansacOptions
        For example ``max_error_px=1.0``, ``confidence=0.999``, ``seed=0``.

    Returns
    -------
    RansacReport of RelativePose
        Its model is a `RelativePose`.

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 5 different matches.
    epipole.DegenerateError
        If a gravity vector has length 0, or all pixels of an image of a pinhole camera are on a
        line.
    epipole.NoConsensusError
        If no pose has 3 inliers.
    ValueError
        If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.
    """
def estimate_relative_pose_and_focal(
    pixels1: ArrayLike,
    pixels2: ArrayLike,
    principal1: ArrayLike,
    principal2: ArrayLike,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.RansacOptions],
) -> RansacReport[PoseWithFocal]:
    """Estimates the relative pose and common focal length of two cameras, by RANSAC.

    Parameters
    ----------
    pixels1, pixels2 : array_like, shape (N, 2)
        Matches.
    principal1, principal2 : array_like, shape (2,)
        Principal points, pixels.
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : RansacOptions
        For example ``max_error_px=1.0``, ``confidence=0.999``, ``seed=0``.

    Returns
    -------
    RansacReport of PoseWithFocal
        Its model is a `PoseWithFocal`.

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 6 different matches.
    epipole.DegenerateError
        If all pixels of an image are on a line.
    epipole.NoConsensusError
        If no pose has 6 inliers.
    ValueError
        If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.
    """
def fundamental_7point(pixels1: ArrayLike, pixels2: ArrayLike) -> NDArray[np.float64]:
    """Computes the fundamental matrices of seven matches.

    Parameters
    ----------
    pixels1, pixels2 : array_like, shape (7, 2)

    Returns
    -------
    ndarray, shape (K, 3, 3)
        K <= 3, and 0 for a degenerate sample.
    """
def fundamental_8point(pixels1: ArrayLike, pixels2: ArrayLike) -> NDArray[np.float64]:
    """Fits a fundamental matrix by the normalized eight-point method, without outliers.

    Parameters
    ----------
    pixels1, pixels2 : array_like, shape (N, 2)
        Matches, N >= 8.

    Returns
    -------
    ndarray, shape (3, 3)

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 8 matches.
    epipole.DegenerateError
        If the matches do not determine F: on a plane or a line, equal, or from a camera that only
        rotated.
    """
def fundamental_8point_explained(pixels1: ArrayLike, pixels2: ArrayLike) -> EightPoint:
    """Returns the result of `fundamental_8point` with intermediate results.

    Parameters
    ----------
    pixels1, pixels2 : array_like, shape (N, 2)
        Matches, N >= 8.

    Returns
    -------
    EightPoint

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 8 matches.
    epipole.DegenerateError
        If the matches do not determine F: on a plane or a line, equal, or from a camera that only
        rotated.
    """
def fundamental_8point_unnormalized(pixels1: ArrayLike, pixels2: ArrayLike) -> EightPoint:
    """Applies the eight-point method without normalizing the pixels, for comparison.

    Parameters
    ----------
    pixels1, pixels2 : array_like, shape (N, 2)
        Matches, N >= 8.

    Returns
    -------
    EightPoint

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 8 matches.
    epipole.DegenerateError
        If the matches do not determine F: on a plane or a line, equal, or from a camera that only
        rotated.
    """
def essential_5point(rays1: ArrayLike, rays2: ArrayLike) -> NDArray[np.float64]:
    """Computes the essential matrices of five pairs of rays.

    Parameters
    ----------
    rays1, rays2 : array_like, shape (5, 3)

    Returns
    -------
    ndarray, shape (K, 3, 3)
        K <= 10, and 0 for a degenerate sample.
    """
def essential_8point(rays1: ArrayLike, rays2: ArrayLike) -> NDArray[np.float64]:
    """Fits an essential matrix to rays by linear least squares, without outliers.

    Parameters
    ----------
    rays1, rays2 : array_like, shape (N, 3)
        Pairs of rays, N >= 8.

    Returns
    -------
    ndarray, shape (3, 3)

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 8 pairs of rays.
    epipole.DegenerateError
        If the rays do not determine the matrix, as for a camera that only rotated.
    ValueError
        If a ray has length 0.
    """
def essential_6point(
    pixels1: ArrayLike,
    pixels2: ArrayLike,
    principal1: ArrayLike,
    principal2: ArrayLike,
) -> list[EssentialWithFocal]:
    """Computes the essential matrices and common focal lengths of six matches.

    Parameters
    ----------
    pixels1, pixels2 : array_like, shape (6, 2)
    principal1, principal2 : array_like, shape (2,)
        Principal points, pixels.

    Returns
    -------
    list of EssentialWithFocal
        At most 15.
    """
def relative_pose_3point(
    rays1: ArrayLike,
    rays2: ArrayLike,
    gravity1: ArrayLike,
    gravity2: ArrayLike,
) -> list[RigidTransform]:
    """Computes the motions from three pairs of rays and known directions of gravity.

    Parameters
    ----------
    rays1, rays2 : array_like, shape (3, 3)
        A ray in each row.
    gravity1, gravity2 : array_like, shape (3,)
        Direction of gravity in each camera's frame.

    Returns
    -------
    list of RigidTransform
        At most 4, each ``cam2_from_cam1`` with a translation of length 1.
    """
def refine_fundamental(
    fundamental: ArrayLike,
    pixels1: ArrayLike,
    pixels2: ArrayLike,
    loss: str | Mapping[str, Any] | None = None,
) -> NDArray[np.float64]:
    """Refines a fundamental matrix by minimizing the Sampson errors of matches.

    Parameters
    ----------
    fundamental : array_like, shape (3, 3)
    pixels1, pixels2 : array_like, shape (N, 2)
    loss : str or dict, optional
        ``"trivial"``, or ``{"huber": {"width": 1.0}}``; ``"cauchy"`` and ``"truncated"`` likewise.

    Returns
    -------
    ndarray, shape (3, 3)

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 7 different matches.
    epipole.DegenerateError
        If the matrix has rank 1 or 0.
    ValueError
        If the loss width is not above 0, or a coordinate is beyond 1e9 pixels.
    """
def refine_relative_pose(
    pose: RelativePose,
    pixels1: ArrayLike,
    pixels2: ArrayLike,
    camera1: Camera,
    camera2: Camera,
    loss: str | Mapping[str, Any] | None = None,
) -> RelativePose:
    """Refines a relative pose by minimizing the Sampson errors of matches.

    Parameters
    ----------
    pose : RelativePose
    pixels1, pixels2 : array_like, shape (N, 2)
    camera1, camera2 : Camera
    loss : str or dict, optional
        ``"trivial"``, or ``{"huber": {"width": 1.0}}``; ``"cauchy"`` and ``"truncated"`` likewise.

    Returns
    -------
    RelativePose

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 5 different matches.
    epipole.DegenerateError
        If a pixel has no ray.
    ValueError
        If the loss width is not above 0, or a coordinate is beyond 1e9 pixels.
    """
def sampson_px(fundamental: ArrayLike, pixel1: ArrayLike, pixel2: ArrayLike) -> Any:
    """Computes the Sampson distances of matches from a fundamental matrix.

    Parameters
    ----------
    fundamental : array_like, shape (3, 3)
    pixel1, pixel2 : array_like, shape (2,) or (N, 2)

    Returns
    -------
    float or ndarray, shape (N,)
        Pixels.

    Examples
    --------
    >>> sideways = [[0, 0, 0], [0, 0, -1], [0, 1, 0]]
    >>> sampson_px(sideways, [[0, 0], [10, 20]], [[5, 0], [14, 20]])
    array([0., 0.])
    """
def tangent_sampson_px(
    cam2_from_cam1: RigidTransform,
    camera1: Camera,
    camera2: Camera,
    pixel1: ArrayLike,
    pixel2: ArrayLike,
) -> Any:
    """Computes the tangent Sampson errors of matches between cameras with any lens.

    Parameters
    ----------
    cam2_from_cam1 : RigidTransform
        The length of its translation does not matter.
    camera1, camera2 : Camera
    pixel1, pixel2 : array_like, shape (2,) or (N, 2)

    Returns
    -------
    float or ndarray, shape (N,)
        Pixels of both images; inf where the rays cannot meet in front of both cameras, NaN where a
        pixel has no ray. Nearly equal to `sampson_px` for pinhole cameras.
    """
def symmetric_epipolar_px(fundamental: ArrayLike, pixel1: ArrayLike, pixel2: ArrayLike) -> Any:
    """Computes the symmetric epipolar distances of matches from a fundamental matrix.

    Parameters
    ----------
    fundamental : array_like, shape (3, 3)
    pixel1, pixel2 : array_like, shape (2,) or (N, 2)

    Returns
    -------
    float or ndarray, shape (N,)
        Pixels.
    """
def epipolar_row(x1: ArrayLike, x2: ArrayLike) -> NDArray[np.float64]:
    """Returns the rows of the eight-point system: ``row @ F.ravel() == x2 @ F @ x1``.

    Parameters
    ----------
    x1, x2 : array_like, shape (2,) or (N, 2)

    Returns
    -------
    ndarray, shape (9,) or (N, 9)

    Examples
    --------
    >>> epipolar_row([2, 3], [5, 7])
    array([10., 15.,  5., 14., 21.,  7.,  2.,  3.,  1.])
    """
def epipolar_line1(fundamental: ArrayLike, pixel2: ArrayLike) -> NDArray[np.float64]:
    """Computes the epipolar lines in image 1 of pixels in image 2.

    Parameters
    ----------
    fundamental : array_like, shape (3, 3)
    pixel2 : array_like, shape (2,) or (N, 2)

    Returns
    -------
    ndarray, shape (3,) or (N, 3)
        Lines (a, b, c): ``a*u + b*v + c == 0`` with ``a**2 + b**2 == 1``. Rows of NaN for
        epipoles.

    Raises
    ------
    epipole.DegenerateError
        If a single pixel is given and it is the epipole or its line is at infinity.
    """
def epipolar_line2(fundamental: ArrayLike, pixel1: ArrayLike) -> NDArray[np.float64]:
    """Computes the epipolar lines in image 2 of pixels in image 1.

    Parameters
    ----------
    fundamental : array_like, shape (3, 3)
    pixel1 : array_like, shape (2,) or (N, 2)

    Returns
    -------
    ndarray, shape (3,) or (N, 3)
        Lines (a, b, c): ``a*u + b*v + c == 0`` with ``a**2 + b**2 == 1``. Rows of NaN for
        epipoles.

    Raises
    ------
    epipole.DegenerateError
        If a single pixel is given and it is the epipole or its line is at infinity.
    """
def epipoles(fundamental: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Computes the epipoles of image 1 and image 2.

    Parameters
    ----------
    fundamental : array_like, shape (3, 3)

    Returns
    -------
    epipole1, epipole2 : ndarray, shape (3,)
        (u, v, 1), or (u, v, 0) with a unit direction for an epipole at infinity.

    Raises
    ------
    epipole.DegenerateError
        If the matrix has rank 1 or 0.
    """
def enforce_rank2(matrix: ArrayLike) -> NDArray[np.float64]:
    """Returns the nearest matrix of rank 2, with unit norm.

    Parameters
    ----------
    matrix : array_like, shape (3, 3)

    Returns
    -------
    ndarray, shape (3, 3)
    """
def project_to_essential(matrix: ArrayLike) -> NDArray[np.float64]:
    """Returns the nearest essential matrix, with unit norm.

    Parameters
    ----------
    matrix : array_like, shape (3, 3)

    Returns
    -------
    ndarray, shape (3, 3)

    Raises
    ------
    epipole.DegenerateError
        If the matrix has rank 1 or 0.
    """
def decompose_essential(essential: ArrayLike) -> list[RigidTransform]:
    """Decomposes an essential matrix into its four motions.

    Parameters
    ----------
    essential : array_like, shape (3, 3)

    Returns
    -------
    list of RigidTransform
        Each ``cam2_from_cam1`` with a translation of length 1.

    Raises
    ------
    epipole.DegenerateError
        If the matrix has rank 1 or 0.
    """
def select_pose(
    motions: Sequence[RigidTransform],
    pixels1: ArrayLike,
    pixels2: ArrayLike,
    k1: Intrinsics,
    k2: Intrinsics,
) -> SelectedPose:
    """Selects the motion that puts most points in front of both cameras.

    Parameters
    ----------
    motions : sequence of RigidTransform
        Candidates, such as those from `decompose_essential`.
    pixels1, pixels2 : array_like, shape (N, 2)
        Matches without outliers.
    k1, k2 : Intrinsics

    Returns
    -------
    SelectedPose

    Raises
    ------
    epipole.TooFewError
        If there are no motions or no matches.
    """
def essential_from_motion(cam2_from_cam1: RigidTransform) -> NDArray[np.float64]:
    """Computes the essential matrix of a motion, with unit norm.

    Parameters
    ----------
    cam2_from_cam1 : RigidTransform

    Returns
    -------
    ndarray, shape (3, 3)

    Raises
    ------
    epipole.DegenerateError
        If the motion has no translation.
    """
def fundamental_from_cameras(cam1: PosedCamera, cam2: PosedCamera) -> NDArray[np.float64]:
    """Computes the fundamental matrix of two cameras, with unit norm, for undistorted pixels.

    Parameters
    ----------
    cam1, cam2 : PosedCamera

    Returns
    -------
    ndarray, shape (3, 3)

    Raises
    ------
    epipole.DegenerateError
        If both cameras are at the same position.
    """
def fundamental_from_essential(
    essential: ArrayLike,
    k1: Intrinsics,
    k2: Intrinsics,
) -> NDArray[np.float64]:
    """Computes the fundamental matrix of an essential matrix, with unit norm.

    Parameters
    ----------
    essential : array_like, shape (3, 3)
    k1, k2 : Intrinsics

    Returns
    -------
    ndarray, shape (3, 3)

    Raises
    ------
    epipole.DegenerateError
        If the matrix is zero.
    """
def essential_from_fundamental(
    fundamental: ArrayLike,
    k1: Intrinsics,
    k2: Intrinsics,
) -> NDArray[np.float64]:
    """Computes the essential matrix ``K2.T @ F @ K1``, with unit norm.

    Parameters
    ----------
    fundamental : array_like, shape (3, 3)
    k1, k2 : Intrinsics

    Returns
    -------
    ndarray, shape (3, 3)

    Raises
    ------
    epipole.DegenerateError
        If the matrix is zero.
    """
def focal_lengths_from_fundamental(
    fundamental: ArrayLike,
    principal1: ArrayLike,
    principal2: ArrayLike,
) -> tuple[float, float]:
    """Computes the focal lengths of two cameras from their fundamental matrix.

    Parameters
    ----------
    fundamental : array_like, shape (3, 3)
    principal1, principal2 : array_like, shape (2,)
        Principal points, pixels.

    Returns
    -------
    focal1_px, focal2_px : float

    Raises
    ------
    epipole.DegenerateError
        If the optical axes meet or are parallel, or noise makes a squared focal length negative.
    """
