# Written by stubs.py. Do not edit.

from collections.abc import Sequence
from typing import ClassVar, Literal, final, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = [
    "Camera",
    "Intrinsics",
    "Lens",
    "PosedCamera",
    "RigidTransform",
    "cross_matrix",
    "look_at",
    "pixel_from_colmap",
    "pixel_to_colmap",
    "relative_motion",
]

@final
class Camera:
    """Calibrated camera with any lens.

    Parameters
    ----------
    width, height : int
        Image size, pixels.
    intrinsics : Intrinsics
    lens : Lens, optional
        No distortion by default.
    """
    def __new__(
        cls,
        width: int,
        height: int,
        intrinsics: Intrinsics,
        lens: Lens | None = None,
    ) -> Camera: ...
    @property
    def width(self) -> int:
        """Image width, pixels."""
    @property
    def height(self) -> int:
        """Image height, pixels."""
    @property
    def intrinsics(self) -> Intrinsics:
        """K."""
    @property
    def lens(self) -> Lens:
        """Lens."""
    def __eq__(self, other: object, /) -> bool: ...
    @staticmethod
    def pinhole(intrinsics: Intrinsics, width: int, height: int) -> Camera:
        """Creates a camera without distortion.

        Parameters
        ----------
        intrinsics : Intrinsics
        width, height : int
            Image size, pixels.
        """
    def is_pinhole(self) -> bool:
        """Whether the camera has no distortion."""
    def project(self, x_in_cam: ArrayLike) -> NDArray[np.float64]:
        """Projects points in the camera frame to pixels.

        Parameters
        ----------
        x_in_cam : array_like, shape (3,) or (N, 3)

        Returns
        -------
        ndarray, shape (2,) or (N, 2)
            Rows of NaN for points that the lens does not see.

        Raises
        ------
        epipole.DegenerateError
            If a single point is given and the lens does not see it.
        """
    def unproject(self, pixel: ArrayLike) -> NDArray[np.float64]:
        """Computes the unit rays through pixels, in the camera frame.

        Parameters
        ----------
        pixel : array_like, shape (2,) or (N, 2)

        Returns
        -------
        ndarray, shape (3,) or (N, 3)
            Rows of NaN for pixels without a ray.

        Raises
        ------
        epipole.DegenerateError
            If a single pixel is given and has no ray.
        """
    def pinhole_pixel(self, pixel: ArrayLike) -> NDArray[np.float64]:
        """Undistorts pixels: maps them to a camera with the same K and no distortion.

        Parameters
        ----------
        pixel : array_like, shape (2,) or (N, 2)

        Returns
        -------
        ndarray of the same shape
            Rows of NaN for pixels without a ray.

        Raises
        ------
        epipole.DegenerateError
            If a single pixel is given and has no ray, or its ray is 90° or more off the axis.
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class Intrinsics:
    """Pinhole intrinsics ``K = [fu 0 cu; 0 fv cv; 0 0 1]``, pixel centers at integers.

    Parameters
    ----------
    fu_px, fv_px : float
        Focal lengths along u and v, pixels, > 0.
    cu_px, cv_px : float
        Principal point, pixels.

    Raises
    ------
    ValueError
        If the focal length is not above 0.
    """
    def __new__(cls, fu_px: float, fv_px: float, cu_px: float, cv_px: float) -> Intrinsics: ...
    @property
    def fu_px(self) -> float:
        """Focal length along u, pixels."""
    @property
    def fv_px(self) -> float:
        """Focal length along v, pixels."""
    @property
    def cu_px(self) -> float:
        """Principal point along u, pixels."""
    @property
    def cv_px(self) -> float:
        """Principal point along v, pixels."""
    def __eq__(self, other: object, /) -> bool: ...
    @staticmethod
    def centered(focal_px: float, width: int, height: int) -> Intrinsics:
        """Creates intrinsics with square pixels and the principal point at the image center.

        Parameters
        ----------
        focal_px : float
            Focal length, pixels, > 0.
        width, height : int
            Image size, pixels.

        Raises
        ------
        ValueError
            If the focal length is not above 0.
        """
    @staticmethod
    def from_matrix(k: ArrayLike) -> Intrinsics:
        """Creates intrinsics from a matrix K without skew.

        Parameters
        ----------
        k : array_like, shape (3, 3)

        Raises
        ------
        ValueError
            If the focal length is not above 0, or the matrix is not a K without skew.
        """
    @staticmethod
    def from_colmap(parameters: Sequence[float]) -> Intrinsics:
        """Creates intrinsics from COLMAP's fx, fy, cx, cy, with pixel centers at half-integers.

        Parameters
        ----------
        parameters : sequence of float
            fx, fy, cx, cy, pixels.

        Raises
        ------
        ValueError
            If the focal length is not above 0.
        """
    def to_colmap(self) -> tuple[float, float, float, float]:
        """Returns COLMAP's parameters fx, fy, cx, cy, with pixel centers at half-integers."""
    def principal_point(self) -> NDArray[np.float64]:
        """Returns the principal point, pixels, shape (2,)."""
    def matrix(self) -> NDArray[np.float64]:
        """Returns K, shape (3, 3)."""
    def inverse_matrix(self) -> NDArray[np.float64]:
        """Returns the inverse of K, shape (3, 3)."""
    def project(self, x_in_cam: ArrayLike) -> NDArray[np.float64]:
        """Projects points in the camera frame to pixels.

        Parameters
        ----------
        x_in_cam : array_like, shape (3,) or (N, 3)

        Returns
        -------
        ndarray, shape (2,) or (N, 2)
            Rows of NaN for points behind the camera.

        Raises
        ------
        epipole.DegenerateError
            If a single point is given and has ``z <= 0``.
        """
    def ray(self, pixel: ArrayLike) -> NDArray[np.float64]:
        """Computes the rays through pixels, in the camera frame, with z = 1.

        Parameters
        ----------
        pixel : array_like, shape (2,) or (N, 2)

        Returns
        -------
        ndarray, shape (3,) or (N, 3)
        """
    def scaled(self, factor: float) -> Intrinsics:
        """Returns the intrinsics for an image resized by a factor; 0.5 halves both sides.

        Parameters
        ----------
        factor : float
            Scale factor of the image, > 0.

        Raises
        ------
        ValueError
            If the factor is not above 0.
        """
    def zoomed(self, factor: float) -> Intrinsics:
        """Returns the intrinsics with both focal lengths multiplied by a factor.

        Parameters
        ----------
        factor : float
            Factor of the focal lengths, > 0.

        Raises
        ------
        ValueError
            If the factor is not above 0.
        """
    def resized(self, old: tuple[int, int], new: tuple[int, int]) -> Intrinsics:
        """Returns the intrinsics for an image resized from one (width, height) to another, pixels.

        Parameters
        ----------
        old, new : tuple of int
            Width and height before and after resizing, pixels.

        Raises
        ------
        ValueError
            If a new side is 0 pixels long.
        """
    def rotated(self, quarters: int, size: tuple[int, int]) -> Intrinsics:
        """Returns the intrinsics for an image rotated clockwise by quarter turns.

        Parameters
        ----------
        quarters : int
        size : tuple of int
            Width and height before the rotation, pixels.
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class Lens:
    """Lens model with its coefficients.

    Parameters
    ----------
    kind : {"brown", "rational", "fisheye", "division"}
        Model; all but the last are OpenCV's.
    coefficients : sequence of float
        5, 8, 4 or 1 numbers, in OpenCV's order. Zeros by default.

    Raises
    ------
    ValueError
        If the number of coefficients does not match the kind.
    """
    def __new__(
        cls,
        kind: Literal["brown", "rational", "fisheye", "division"] | None = None,
        coefficients: Sequence[float] | None = None,
    ) -> Lens: ...
    @property
    def kind(self) -> str:
        """Name of the model."""
    @property
    def coefficients(self) -> list[float]:
        """Coefficients of the model."""
    def __eq__(self, other: object, /) -> bool: ...
    def is_none(self) -> bool:
        """Whether the lens has no distortion."""
    def project(self, x_in_cam: ArrayLike) -> NDArray[np.float64]:
        """Projects points to distorted image points, for a focal length of 1.

        Parameters
        ----------
        x_in_cam : array_like, shape (3,) or (N, 3)

        Returns
        -------
        ndarray, shape (2,) or (N, 2)
            Rows of NaN for points that the lens does not see.

        Raises
        ------
        epipole.DegenerateError
            If a single point is given and the lens does not see it.
        """
    def ray(self, distorted: ArrayLike) -> NDArray[np.float64]:
        """Computes the rays of distorted image points, for a focal length of 1.

        Parameters
        ----------
        distorted : array_like, shape (2,) or (N, 2)

        Returns
        -------
        ndarray, shape (3,) or (N, 3)

        Raises
        ------
        epipole.DegenerateError
            If a single image point is given and has no ray; for several points, its row is NaN.
        """
    def rotated(self, quarters: int) -> Lens:
        """Returns the lens for an image rotated clockwise by quarter turns.

        Parameters
        ----------
        quarters : int
            Number of quarter turns.
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class PosedCamera:
    """Camera with a pose in the world.

    Parameters
    ----------
    camera : Camera
    cam_from_world : RigidTransform
        ``x_in_cam = cam_from_world @ x_in_world``
    """
    def __new__(cls, camera: Camera, cam_from_world: RigidTransform) -> PosedCamera: ...
    @property
    def camera(self) -> Camera:
        """Image size, intrinsics and lens."""
    @property
    def cam_from_world(self) -> RigidTransform:
        """Pose: ``x_in_cam = cam_from_world @ x_in_world``."""
    def __eq__(self, other: object, /) -> bool: ...
    def center_in_world(self) -> NDArray[np.float64]:
        """Returns the center of the camera in the world, shape (3,)."""
    def projection_matrix(self) -> NDArray[np.float64]:
        """Returns ``P = K [R t]``, shape (3, 4), for undistorted pixels."""
    def project(self, x_in_world: ArrayLike) -> NDArray[np.float64]:
        """Projects points in the world to pixels.

        Parameters
        ----------
        x_in_world : array_like, shape (3,) or (N, 3)

        Returns
        -------
        ndarray, shape (2,) or (N, 2)
            Rows of NaN for points that the lens does not see.

        Raises
        ------
        epipole.DegenerateError
            If a single point is given and the lens does not see it.
        """
    def ray_in_world(self, pinhole_pixel: ArrayLike) -> NDArray[np.float64]:
        """Computes the rays through undistorted pixels, in the world, with a depth of 1.

        Parameters
        ----------
        pinhole_pixel : array_like, shape (2,) or (N, 2)

        Returns
        -------
        ndarray, shape (3,) or (N, 3)
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class RigidTransform:
    """Rotation and translation: ``x_in_a = a_from_b @ x_in_b``.

    Parameters
    ----------
    rotation : array_like, shape (3, 3), optional
        Rotation matrix. The identity by default.
    translation : array_like, shape (3,), optional
        Zero by default.

    Raises
    ------
    ValueError
        If the matrix is not a rotation.

    Examples
    --------
    >>> world_from_cam = RigidTransform(translation=[1, 2, 3])
    >>> world_from_cam @ [0, 0, 5]
    array([1., 2., 8.])
    >>> (world_from_cam @ world_from_cam.inverse()).translation
    array([0., 0., 0.])
    """
    def __new__(
        cls,
        rotation: ArrayLike | None = None,
        translation: ArrayLike | None = None,
    ) -> RigidTransform: ...
    @property
    def rotation(self) -> NDArray[np.float64]:
        """R, shape (3, 3)."""
    @property
    def translation(self) -> NDArray[np.float64]:
        """t, shape (3,)."""
    @property
    def quaternion(self) -> NDArray[np.float64]:
        """Quaternion (w, x, y, z) of the rotation, shape (4,)."""
    @property
    def angle_rad(self) -> float:
        """Rotation angle, radians in [0, pi]."""
    @staticmethod
    def from_quaternion(
        quaternion: ArrayLike,
        translation: ArrayLike | None = None,
    ) -> RigidTransform:
        """Creates a transform from a unit quaternion (w, x, y, z).

        Parameters
        ----------
        quaternion : array_like, shape (4,)
        translation : array_like, shape (3,), optional

        Raises
        ------
        ValueError
            If the length of the quaternion is not 1.
        """
    def matrix(self) -> NDArray[np.float64]:
        """Returns the homogeneous matrix, shape (4, 4)."""
    def inverse(self) -> RigidTransform:
        """Returns the inverse transform: ``b_from_a``."""
    @overload
    def __matmul__(self, other: RigidTransform, /) -> RigidTransform:
        """Composes two transforms, or transforms points.

        Parameters
        ----------
        other : RigidTransform or array_like, shape (3,) or (N, 3)

        Returns
        -------
        RigidTransform or ndarray of the same shape
        """
    @overload
    def __matmul__(self, other: ArrayLike, /) -> NDArray[np.float64]:
        """Composes two transforms, or transforms points.

        Parameters
        ----------
        other : RigidTransform or array_like, shape (3,) or (N, 3)

        Returns
        -------
        RigidTransform or ndarray of the same shape
        """
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

def cross_matrix(t: ArrayLike) -> NDArray[np.float64]:
    """Returns the cross-product matrix: `cross_matrix(t) @ x == np.cross(t, x)`.

    Parameters
    ----------
    t : array_like, shape (3,)

    Returns
    -------
    ndarray, shape (3, 3)
    """
def relative_motion(
    cam1_from_world: RigidTransform,
    cam2_from_world: RigidTransform,
) -> RigidTransform:
    """Computes the motion from the frame of camera 1 to that of camera 2.

    Parameters
    ----------
    cam1_from_world, cam2_from_world : RigidTransform

    Returns
    -------
    RigidTransform
        ``cam2_from_cam1``
    """
def look_at(
    center_in_world: ArrayLike,
    target_in_world: ArrayLike,
    up_in_world: ArrayLike,
) -> RigidTransform:
    """Computes the pose of an upright camera that looks at a point.

    Parameters
    ----------
    center_in_world, target_in_world : array_like, shape (3,)
        Center of the camera, and the point at which it looks.
    up_in_world : array_like, shape (3,)
        Up direction in the image.

    Returns
    -------
    RigidTransform
        ``cam_from_world``

    Raises
    ------
    epipole.DegenerateError
        If the target is at the center, or ``up_in_world`` is zero or parallel to the line of sight.
    """
def pixel_to_colmap(pixel: ArrayLike) -> NDArray[np.float64]:
    """Converts pixels to COLMAP's convention, with pixel centers at half-integers.

    Parameters
    ----------
    pixel : array_like, shape (2,) or (N, 2)

    Returns
    -------
    ndarray of the same shape
    """
def pixel_from_colmap(pixel: ArrayLike) -> NDArray[np.float64]:
    """Converts pixels from COLMAP's convention, with pixel centers at half-integers.

    Parameters
    ----------
    pixel : array_like, shape (2,) or (N, 2)

    Returns
    -------
    ndarray of the same shape
    """
