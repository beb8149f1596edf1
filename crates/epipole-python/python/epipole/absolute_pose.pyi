# Written by stubs.py. Do not edit.

from collections.abc import Callable, Mapping
from typing import Any, ClassVar, final

from numpy.typing import ArrayLike
from typing_extensions import Unpack

from epipole import options as option_types
from epipole.camera import Camera
from epipole.camera import Intrinsics
from epipole.camera import PosedCamera
from epipole.camera import RigidTransform
from epipole.robust import RansacReport

__all__ = [
    "AbsolutePoseWithFocal",
    "estimate_absolute_pose",
    "estimate_absolute_pose_and_focal",
    "find_flipped_pose",
    "fit_absolute_pose",
    "pose_dlt",
    "pose_p3p",
    "pose_p4pf",
    "refine_absolute_pose",
    "reprojection_error_px",
]

@final
class AbsolutePoseWithFocal:
    """Pose of a camera with its focal length.

    Parameters
    ----------
    cam_from_world
        Pose.
    focal_px
        Focal length, pixels.
    focal_std_px
        Standard deviation of the focal length, pixels; None if the focal length has no effect.
    """
    def __new__(
        cls,
        cam_from_world: RigidTransform,
        focal_px: float,
        focal_std_px: float | None,
    ) -> AbsolutePoseWithFocal: ...
    @property
    def cam_from_world(self) -> RigidTransform:
        """Pose."""
    @property
    def focal_px(self) -> float:
        """Focal length, pixels."""
    @property
    def focal_std_px(self) -> float | None:
        """Standard deviation of the focal length, pixels; None if the focal length has no effect."""
    def __eq__(self, other: object, /) -> bool: ...
    def constrains_focal(self) -> bool:
        """Whether the points determine the focal length."""
    __hash__: ClassVar[None]  # type: ignore[assignment]

def estimate_absolute_pose(
    points_in_world: ArrayLike,
    pixels: ArrayLike,
    camera: Camera,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.RansacOptions],
) -> RansacReport[RigidTransform]:
    """Estimates the pose of a calibrated camera from points with outliers, by RANSAC.

    Parameters
    ----------
    points_in_world : array_like, shape (N, 3)
    pixels : array_like, shape (N, 2)
        Where the camera sees the points.
    camera : Camera
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : RansacOptions
        For example ``max_error_px=1.0``, ``confidence=0.999``, ``seed=0``.

    Returns
    -------
    RansacReport of RigidTransform
        Its model is ``cam_from_world``, a `RigidTransform`.

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 4 different matches.
    epipole.NoConsensusError
        If no pose has 3 inliers.
    ValueError
        If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.
    """
def estimate_absolute_pose_and_focal(
    points_in_world: ArrayLike,
    pixels: ArrayLike,
    principal: ArrayLike,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.RansacOptions],
) -> RansacReport[AbsolutePoseWithFocal]:
    """Estimates pose and focal length of a camera from points with outliers, by RANSAC.

    Parameters
    ----------
    points_in_world : array_like, shape (N, 3)
    pixels : array_like, shape (N, 2)
        Where the camera sees the points.
    principal : array_like, shape (2,)
        Principal point, pixels.
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : RansacOptions
        For example ``max_error_px=1.0``, ``confidence=0.999``, ``seed=0``.

    Returns
    -------
    RansacReport of AbsolutePoseWithFocal
        Its model is an `AbsolutePoseWithFocal`.

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 5 different matches.
    epipole.NoConsensusError
        If no pose has 4 inliers.
    ValueError
        If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.
    """
def pose_p3p(rays: ArrayLike, points_in_world: ArrayLike) -> list[RigidTransform]:
    """Computes the poses from three rays and their points.

    Parameters
    ----------
    rays : array_like, shape (3, 3)
        A ray in each row.
    points_in_world : array_like, shape (3, 3)
        A point in each row.

    Returns
    -------
    list of RigidTransform
        At most 4, each ``cam_from_world``.
    """
def pose_p4pf(
    pixels: ArrayLike,
    points_in_world: ArrayLike,
    principal: ArrayLike,
) -> list[AbsolutePoseWithFocal]:
    """Computes the poses and focal lengths from four points.

    Parameters
    ----------
    pixels : array_like, shape (4, 2)
    points_in_world : array_like, shape (4, 3)
    principal : array_like, shape (2,)
        Principal point, pixels.

    Returns
    -------
    list of AbsolutePoseWithFocal
        At most 7.
    """
def pose_dlt(
    points_in_world: ArrayLike,
    pixels: ArrayLike,
    intrinsics: Intrinsics,
) -> RigidTransform:
    """Computes a pose by linear least squares (DLT), without outliers.

    Parameters
    ----------
    points_in_world : array_like, shape (N, 3)
        N >= 6, not on a plane.
    pixels : array_like, shape (N, 2)
    intrinsics : Intrinsics

    Returns
    -------
    RigidTransform
        ``cam_from_world``

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 6 points.
    epipole.DegenerateError
        If the points lie on a plane, or are otherwise degenerate.
    """
def fit_absolute_pose(
    points_in_world: ArrayLike,
    pixels: ArrayLike,
    camera: Camera,
) -> RigidTransform:
    """Computes the pose with the least reprojection error, without outliers.

    Parameters
    ----------
    points_in_world : array_like, shape (N, 3)
    pixels : array_like, shape (N, 2)
    camera : Camera

    Returns
    -------
    RigidTransform
        ``cam_from_world``

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 4 points.
    epipole.DegenerateError
        If the points lie on a line, no pose has all of them in front of the camera, or a pixel has
        no ray.
    """
def find_flipped_pose(
    cam_from_world: RigidTransform,
    points_in_world: ArrayLike,
    pixels: ArrayLike,
    camera: Camera,
) -> RigidTransform | None:
    """Finds a second pose that explains a plane nearly as well.

    Parameters
    ----------
    cam_from_world : RigidTransform
        Known pose.
    points_in_world : array_like, shape (N, 3)
    pixels : array_like, shape (N, 2)
    camera : Camera

    Returns
    -------
    RigidTransform or None

    Raises
    ------
    epipole.TooFewError
        If fewer than 3 points are in front of the flipped camera.
    epipole.DegenerateError
        If a pixel has no ray.
    """
def refine_absolute_pose(
    cam_from_world: RigidTransform,
    points_in_world: ArrayLike,
    pixels: ArrayLike,
    camera: Camera,
    loss: str | Mapping[str, Any] | None = None,
) -> RigidTransform:
    """Refines a pose by minimizing the reprojection errors.

    Parameters
    ----------
    cam_from_world : RigidTransform
    points_in_world : array_like, shape (N, 3)
    pixels : array_like, shape (N, 2)
    camera : Camera
    loss : str or dict, optional
        ``"trivial"``, or ``{"huber": {"width": 1.0}}``; ``"cauchy"`` and ``"truncated"`` likewise.

    Returns
    -------
    RigidTransform
        ``cam_from_world``

    Raises
    ------
    epipole.TooFewError
        If fewer than 3 points are in front of the camera.
    epipole.DegenerateError
        If a pixel has no ray.
    ValueError
        If the loss width is not above 0.
    """
def reprojection_error_px(
    camera: PosedCamera,
    point_in_world: ArrayLike,
    pixel: ArrayLike,
) -> Any:
    """Computes the distances between projected points and pixels.

    Parameters
    ----------
    camera : PosedCamera
    point_in_world : array_like, shape (3,) or (N, 3)
    pixel : array_like, shape (2,) or (N, 2)

    Returns
    -------
    float or ndarray, shape (N,)
        Pixels; infinite for a point that the camera does not see.

    Examples
    --------
    >>> from epipole import Camera, Intrinsics, PosedCamera, RigidTransform
    >>> camera = Camera.pinhole(Intrinsics(100, 100, 50, 50), 101, 101)
    >>> reprojection_error_px(PosedCamera(camera, RigidTransform()), [0, 0, 2], [53, 54])
    5.0
    """
