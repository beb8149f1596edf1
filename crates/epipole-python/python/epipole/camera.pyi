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
    """Calibrated camera of any lens.

    Parameters
    ----------
    width, height : int
        Image size, pixels.
    intrinsics : Intrinsics
    lens : Lens, optional
        Without distortion if not given.
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
        """Camera without distortion.

        Parameters
        ----------
        intrinsics : Intrinsics
        width, height : int
            Image size, pixels.
        """
    def is_pinhole(self) -> bool:
        """Whether the camera is without distortion."""
    def project(self, x_in_cam: ArrayLike) -> NDArray[np.float64]:
        """Pixels of points in the camera frame.

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
            Single point that the lens does not see.
        """
    def unproject(self, pixel: ArrayLike) -> NDArray[np.float64]:
        """Unit rays through pixels, in the camera frame.

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
            Single pixel without a ray.
        """
    def pinhole_pixel(self, pixel: ArrayLike) -> NDArray[np.float64]:
        """Undistorted pixels: those of a camera with the same K and no distortion.

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
            Single pixel without a ray, or with one 90° or more off the axis.
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
        Focal length not above 0.
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
        """Intrinsics with square pixels and the principal point in the middle of the image.

        Parameters
        ----------
        focal_px : float
            Focal length, pixels, > 0.
        width, height : int
            Image size, pixels.

        Raises
        ------
        ValueError
            Focal length not above 0.
        """
    @staticmethod
    def from_matrix(k: ArrayLike) -> Intrinsics:
        """Intrinsics of a matrix K without skew.

        Parameters
        ----------
        k : array_like, shape (3, 3)

        Raises
        ------
        ValueError
            Focal length not above 0, or a matrix of another form than K without skew.
        """
    @staticmethod
    def from_colmap(parameters: Sequence[float]) -> Intrinsics:
        """Intrinsics of COLMAP's parameters fx, fy, cx, cy, with pixel centers at halves.

        Parameters
        ----------
        parameters : sequence of float
            fx, fy, cx, cy, pixels.

        Raises
        ------
        ValueError
            Focal length not above 0.
        """
    def to_colmap(self) -> tuple[float, float, float, float]:
        """COLMAP's parameters fx, fy, cx, cy, with pixel centers at halves."""
    def principal_point(self) -> NDArray[np.float64]:
        """Principal point, pixels, shape (2,)."""
    def matrix(self) -> NDArray[np.float64]:
        """K, shape (3, 3)."""
    def inverse_matrix(self) -> NDArray[np.float64]:
        """Inverse of K, shape (3, 3)."""
    def project(self, x_in_cam: ArrayLike) -> NDArray[np.float64]:
        """Pixels of points in the camera frame.

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
            Single point with ``z <= 0``.
        """
    def ray(self, pixel: ArrayLike) -> NDArray[np.float64]:
        """Rays through pixels, in the camera frame, with z = 1.

        Parameters
        ----------
        pixel : array_like, shape (2,) or (N, 2)

        Returns
        -------
        ndarray, shape (3,) or (N, 3)
        """
    def scaled(self, factor: float) -> Intrinsics:
        """Intrinsics after the image is resized by a factor; 0.5 halves both sides.

        Parameters
        ----------
        factor : float
            Scale of the image, > 0.

        Raises
        ------
        ValueError
            Factor not above 0.
        """
    def zoomed(self, factor: float) -> Intrinsics:
        """Intrinsics with both focal lengths multiplied by a factor.

        Parameters
        ----------
        factor : float
            Factor of the focal lengths, > 0.

        Raises
        ------
        ValueError
            Factor not above 0.
        """
    def resized(self, old: tuple[int, int], new: tuple[int, int]) -> Intrinsics:
        """Intrinsics after the image is resized from one (width, height) to another, pixels.

        Parameters
        ----------
        old, new : tuple of int
            Width and height before and after, pixels.

        Raises
        ------
        ValueError
            New side of 0 pixels.
        """
    def turned(self, quarters: int, size: tuple[int, int]) -> Intrinsics:
        """Intrinsics after the image is turned clockwise by quarter turns.

        Parameters
        ----------
        quarters : int
        size : tuple of int
            Width and height before the turn, pixels.
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class Lens:
    """Lens model with its coefficients.

    Parameters
    ----------
    kind : {"brown", "rational", "fisheye", "division"}
        Model, those of OpenCV but for the last.
    coefficients : sequence of float
        5, 8, 4 or 1 numbers, in OpenCV's order. Zeros if not given.

    Raises
    ------
    ValueError
        Another number of coefficients than the kind has.
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
        """Whether the lens is without distortion."""
    def project(self, x_in_cam: ArrayLike) -> NDArray[np.float64]:
        """Distorted image points, for a focal length of 1.

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
            Single point that the lens does not see.
        """
    def ray(self, seen: ArrayLike) -> NDArray[np.float64]:
        """Rays of distorted image points, for a focal length of 1.

        Parameters
        ----------
        seen : array_like, shape (2,) or (N, 2)

        Returns
        -------
        ndarray, shape (3,) or (N, 3)

        Raises
        ------
        epipole.DegenerateError
            Single image point without a ray; among several, a row of NaN.
        """
    def turned(self, quarters: int) -> Lens:
        """Lens after the image is turned clockwise by quarter turns.

        Parameters
        ----------
        quarters : int
            Number of quarter turns.
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class PosedCamera:
    """Camera in the world.

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
        """Center of the camera in the world, shape (3,)."""
    def projection_matrix(self) -> NDArray[np.float64]:
        """``P = K [R t]``, shape (3, 4), for undistorted pixels."""
    def project(self, x_in_world: ArrayLike) -> NDArray[np.float64]:
        """Pixels of points in the world.

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
            Single point that the lens does not see.
        """
    def ray_in_world(self, pinhole_pixel: ArrayLike) -> NDArray[np.float64]:
        """Directions of the rays through undistorted pixels, in the world, with a depth of 1.

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
        Rotation matrix. The identity if not given.
    translation : array_like, shape (3,), optional
        Zero if not given.

    Raises
    ------
    ValueError
        Matrix that is no rotation.

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
        """Angle of the rotation, radians in [0, pi]."""
    @staticmethod
    def from_quaternion(
        quaternion: ArrayLike,
        translation: ArrayLike | None = None,
    ) -> RigidTransform:
        """Transform of a quaternion (w, x, y, z), of length 1.

        Parameters
        ----------
        quaternion : array_like, shape (4,)
        translation : array_like, shape (3,), optional

        Raises
        ------
        ValueError
            Quaternion whose length is not 1.
        """
    def matrix(self) -> NDArray[np.float64]:
        """Homogeneous matrix, shape (4, 4)."""
    def inverse(self) -> RigidTransform:
        """The inverse transform: ``b_from_a``."""
    @overload
    def __matmul__(self, other: RigidTransform, /) -> RigidTransform:
        """Composition with a transform, or the image of points.

        Parameters
        ----------
        other : RigidTransform or array_like, shape (3,) or (N, 3)

        Returns
        -------
        RigidTransform or ndarray of the same shape
        """
    @overload
    def __matmul__(self, other: ArrayLike, /) -> NDArray[np.float64]:
        """Composition with a transform, or the image of points.

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
    """Cross-product matrix: `cross_matrix(t) @ x == np.cross(t, x)`.

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
    """Motion from the frame of camera 1 to that of camera 2.

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
    """Pose of an upright camera that looks at a point.

    Parameters
    ----------
    center_in_world, target_in_world : array_like, shape (3,)
        Center of the camera and the point it looks at.
    up_in_world : array_like, shape (3,)
        Direction that is up in the image.

    Returns
    -------
    RigidTransform
        ``cam_from_world``

    Raises
    ------
    epipole.DegenerateError
        Target at the center, or ``up_in_world`` zero or along the line of sight.
    """
def pixel_to_colmap(pixel: ArrayLike) -> NDArray[np.float64]:
    """Pixels in COLMAP's convention, with pixel centers at halves.

    Parameters
    ----------
    pixel : array_like, shape (2,) or (N, 2)

    Returns
    -------
    ndarray of the same shape
    """
def pixel_from_colmap(pixel: ArrayLike) -> NDArray[np.float64]:
    """Pixels from COLMAP's convention, with pixel centers at halves.

    Parameters
    ----------
    pixel : array_like, shape (2,) or (N, 2)

    Returns
    -------
    ndarray of the same shape
    """
