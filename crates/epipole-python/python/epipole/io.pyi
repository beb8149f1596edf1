# Written by stubs.py. Do not edit.

import os
from collections.abc import Sequence
from typing import Any, ClassVar, Literal, final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from epipole.calibration import Undistortion
from epipole.camera import Camera
from epipole.camera import Intrinsics
from epipole.camera import RigidTransform
from epipole.math import Geodetic
from epipole.mvs import Mesh
from epipole.mvs import MeshTexture
from epipole.sfm import BalProblem
from epipole.sfm import PoseGraph
from epipole.sfm import Reconstruction
from epipole.sfm import SfmImage
from epipole.stereo import PointCloud

__all__ = [
    "Cameras",
    "Decoded",
    "Model",
    "ModelImage",
    "NamedCamera",
    "PreparedPhoto",
    "ReadModel",
    "Rig",
    "Trajectory",
    "decode_gray",
    "decode_rgb",
    "prepare_photo",
    "read_bal",
    "read_cameras",
    "read_g2o",
    "read_matches",
    "read_model_file",
    "read_model_folder",
    "read_pfm",
    "read_ply",
    "read_points",
    "read_points_with_pixels",
    "read_q",
    "read_trajectory",
    "sensor_size",
    "write_bal",
    "write_cameras",
    "write_g2o",
    "write_matches",
    "write_mesh",
    "write_pfm",
    "write_ply",
    "write_png16",
    "write_trajectory",
]

@final
class NamedCamera:
    """Camera and its name in a file.

    Parameters
    ----------
    name : str
    camera : Camera
    cam_from_world : RigidTransform, optional
        Pose, of a format that has one.
    """
    def __new__(
        cls,
        name: str,
        camera: Camera,
        cam_from_world: RigidTransform | None = None,
    ) -> NamedCamera: ...
    @property
    def name(self) -> str:
        """Name, number or image that the file gives; "camera", or "left" and "right", without one."""
    @property
    def camera(self) -> Camera:
        """Camera."""
    @property
    def cam_from_world(self) -> RigidTransform | None:
        """Pose, or None."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class Cameras:
    """Content of a file of cameras.

    Parameters
    ----------
    cameras : list of NamedCamera
    right_from_left : RigidTransform, optional
        Motion of a rig, from the first camera to the second, in the unit of the file.
    notes : list of str, optional
        Sentences on cameras of a file that are left out.
    """
    def __new__(
        cls,
        cameras: Sequence[NamedCamera],
        right_from_left: RigidTransform | None = None,
        notes: Sequence[str] | None = None,
    ) -> Cameras: ...
    @property
    def cameras(self) -> list[NamedCamera]:
        """Cameras in the order of the file, a list of `NamedCamera`."""
    @property
    def right_from_left(self) -> RigidTransform | None:
        """Motion of a rig, from the first camera to the second, or None."""
    @property
    def notes(self) -> list[str]:
        """Sentences on cameras of the file that are left out, as there is no such lens, a list of str."""
    def __eq__(self, other: object, /) -> bool: ...
    @staticmethod
    def of(camera: Camera) -> Cameras:
        """Content with one camera.

        Parameters
        ----------
        camera : epipole.camera.Camera
        """
    @staticmethod
    def of_rig(cameras: Sequence[Camera], right_from_left: RigidTransform) -> Cameras:
        """Content with the two cameras of a rig.

        Parameters
        ----------
        cameras : sequence of epipole.camera.Camera
            Left and right camera.
        right_from_left : epipole.camera.RigidTransform
        """
    def named(self, name: str) -> Camera:
        """Camera of a name; `KeyError` without one.

        Parameters
        ----------
        name : str

        Raises
        ------
        KeyError
            No camera of this name.
        """
    def __len__(self) -> int: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

def read_cameras(
    source: str | os.PathLike[str] | bytes,
    size: tuple[int, int] | None = None,
) -> tuple[str, Cameras]:
    """Reads the cameras of a file; the format follows from its content.

    Parameters
    ----------
    source : str, os.PathLike or bytes
        File of Epipole, OpenCV, ROS, Kalibr, KITTI, ORB-SLAM, Middlebury, COLMAP, nerfstudio,
        Metashape or MATLAB, or of plain numbers.
    size : tuple of int, optional
        Width and height of the images, pixels, for a file without them.

    Returns
    -------
    format : str
    cameras : Cameras

    Raises
    ------
    ValueError
        Unknown format, wrong or missing values, or a lens that the library does not have.
    OSError
        File that cannot be read.
    """
def read_q(source: str | os.PathLike[str] | bytes) -> NDArray[np.float64]:
    """Reads Q of a rectified pair, from pixels with disparities to points.

    Parameters
    ----------
    source : str, os.PathLike or bytes
        File with the key ``Q`` of OpenCV or of ``epipole rectify --json``, or sixteen numbers row
        by row.

    Returns
    -------
    ndarray, shape (4, 4)

    Raises
    ------
    ValueError
        No 16 finite numbers, or not the Q of a rectified pair.
    OSError
        File that cannot be read.
    """
def write_cameras(
    path: str | os.PathLike[str],
    cameras: Cameras,
    format: str = 'epipole',
) -> None:
    """Writes cameras with all digits.

    Parameters
    ----------
    path : str or os.PathLike
    cameras : Cameras
    format : {"epipole", "opencv", "ros", "colmap"}, optional

    Raises
    ------
    ValueError
        Unknown format, or a lens or number of cameras that it cannot hold.
    OSError
        File that cannot be written.
    """
@final
class Decoded:
    """Image and its file's data about the camera.

    Parameters
    ----------
    image
        Pixels: uint8 of shape (H, W, 3), or float32 of shape (H, W) in [0, 1].
    focal_px
        First guess of the focal length from the EXIF data, pixels of this image, or None.
    focal_mm
        Focal length from the EXIF data, millimeters, or None.
    place
        Position of the camera, `epipole.math.Geodetic`, if the file has GPS data.
    orientation
        EXIF orientation of the file, 1 to 8, applied or not.
    range
        Sample values that became black and white, if not those of the format.
    """
    def __new__(
        cls,
        image: Any,
        focal_px: float | None,
        focal_mm: float | None,
        place: Geodetic | None,
        orientation: int,
        range: Sequence[float] | None,
    ) -> Decoded: ...
    @property
    def image(self) -> NDArray[Any]:
        """Pixels: uint8 of shape (H, W, 3), or float32 of shape (H, W) in [0, 1]."""
    @property
    def focal_px(self) -> float | None:
        """First guess of the focal length from the EXIF data, pixels of this image, or None."""
    @property
    def focal_mm(self) -> float | None:
        """Focal length from the EXIF data, millimeters, or None."""
    @property
    def place(self) -> Geodetic | None:
        """Position of the camera, `epipole.math.Geodetic`, if the file has GPS data."""
    @property
    def orientation(self) -> int:
        """EXIF orientation of the file, 1 to 8, applied or not."""
    @property
    def range(self) -> list[float] | None:
        """Sample values that became black and white, if not those of the format."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class PreparedPhoto:
    """Photo that was turned upright, undistorted and downscaled.

    Parameters
    ----------
    image : array_like of uint8, shape (H, W, 3)
    focal_px, focal_mm : float, optional
    place : epipole.math.Geodetic, optional
    intrinsics : Intrinsics, optional
    full_size, sensor_size : tuple of int
    quarters : int, optional
    range : tuple of float, optional
    is_as_stored : bool
    """
    def __new__(
        cls,
        image: ArrayLike,
        focal_px: float | None,
        focal_mm: float | None,
        place: Geodetic | None,
        intrinsics: Intrinsics | None,
        full_size: tuple[int, int],
        sensor_size: tuple[int, int],
        quarters: int | None,
        range: Sequence[float] | None,
        is_as_stored: bool,
    ) -> PreparedPhoto: ...
    @property
    def image(self) -> NDArray[np.uint8]:
        """Pixels, upright, uint8 of shape (H, W, 3)."""
    @property
    def focal_px(self) -> float | None:
        """First guess of the focal length from the EXIF data, pixels of `image`, or None."""
    @property
    def focal_mm(self) -> float | None:
        """Focal length from the EXIF data, millimeters, or None."""
    @property
    def place(self) -> Geodetic | None:
        """Position of the camera, `epipole.math.Geodetic`, or None."""
    @property
    def intrinsics(self) -> Intrinsics | None:
        """K, if the distortion of a known lens was removed, or None."""
    @property
    def full_size(self) -> tuple[int, int]:
        """Width and height before it was reduced, upright."""
    @property
    def sensor_size(self) -> tuple[int, int]:
        """Width and height before it was turned upright."""
    @property
    def quarters(self) -> int | None:
        """Number of clockwise quarter turns that made it upright; None if it was mirrored."""
    @property
    def range(self) -> list[float] | None:
        """Sample values that became black and white, if not those of the format."""
    @property
    def is_as_stored(self) -> bool:
        """Whether the pixels are those of the file."""
    def __eq__(self, other: object, /) -> bool: ...
    def reduced_focal_px(self, focal_px: float) -> float:
        """Focal length in pixels of `image`, from one in pixels before it was reduced.

        Parameters
        ----------
        focal_px : float
            Focal length in the file, pixels.
        """
    def camera(self, camera: Camera) -> Camera | None:
        """Camera of `image`; None for another size or a mirrored photo.

        Parameters
        ----------
        camera : epipole.camera.Camera
            That of the sensor, or of the photo upright.
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

def decode_rgb(
    source: str | os.PathLike[str] | bytes,
    *,
    max_pixels: int | None = None,
    apply_orientation: bool = True,
    range: str | Sequence[float] | None = None,
) -> Decoded:
    """Color image of a PNG, JPEG, WebP, TIFF, BMP or PNM file, with its EXIF data.

    Parameters
    ----------
    source : str, os.PathLike or bytes
    max_pixels : int, optional
        Larger images are refused. 64 million if not given.
    apply_orientation : bool, optional
        Whether to turn the image upright by its EXIF orientation.
    range : str or tuple of float, optional
        ``"auto"`` or ``"full"``, or the values that become black and white.
        Sample values that become black and white: those in use, all of the format, or these.

    Returns
    -------
    Decoded
        Its `image` is uint8 of shape (H, W, 3).

    Raises
    ------
    ValueError
        File that is no image or a damaged one, more than ``max_pixels`` pixels, or ``range``
        unknown or empty.
    OSError
        File that cannot be read.
    """
def decode_gray(
    source: str | os.PathLike[str] | bytes,
    *,
    max_pixels: int | None = None,
    apply_orientation: bool = True,
    range: str | Sequence[float] | None = None,
) -> Decoded:
    """Gray image of a PNG, JPEG, WebP, TIFF, BMP or PNM file, with its EXIF data.

    Parameters
    ----------
    source : str, os.PathLike or bytes
    max_pixels : int, optional
        Larger images are refused. 64 million if not given.
    apply_orientation : bool, optional
        Whether to turn the image upright by its EXIF orientation.
    range : str or tuple of float, optional
        ``"auto"`` or ``"full"``, or the values that become black and white.
        Sample values that become black and white: those in use, all of the format, or these.

    Returns
    -------
    Decoded
        Its `image` is float32 of shape (H, W), in [0, 1].

    Raises
    ------
    ValueError
        File that is no image or a damaged one, more than ``max_pixels`` pixels, or ``range``
        unknown or empty.
    OSError
        File that cannot be read.
    """
def sensor_size(source: str | os.PathLike[str] | bytes) -> tuple[int, int]:
    """Width and height of an image before its orientation is applied, from the header alone.

    Parameters
    ----------
    source : str, os.PathLike or bytes

    Returns
    -------
    tuple of int

    Raises
    ------
    ValueError
        File that is no image, or one with a damaged header.
    OSError
        File that cannot be read.
    """
def prepare_photo(
    source: str | os.PathLike[str] | bytes,
    *,
    max_pixels: int | None = None,
    max_file_pixels: int | None = None,
    range: str | Sequence[float] | None = None,
    sensor_width_mm: float | None = None,
    undistortion: Undistortion | None = None,
) -> PreparedPhoto:
    """Color image of a file, undistorted, turned upright and downscaled.

    Parameters
    ----------
    source : str, os.PathLike or bytes
    max_pixels : int, optional
        Maximum number of pixels of the result.
    max_file_pixels : int, optional
        Larger files are refused. 64 million if not given.
    range : str or tuple of float, optional
        ``"auto"`` or ``"full"``, or the values that become black and white.
        As in `decode_rgb`.
    sensor_width_mm : float, optional
        Length of the longer side of the sensor, millimeters, for files that have the focal length
        in millimeters only.
    undistortion : epipole.calibration.Undistortion, optional
        Applied to images with the size of its camera.

    Returns
    -------
    PreparedPhoto

    Raises
    ------
    ValueError
        File that is no image or a damaged one, more than ``max_file_pixels`` pixels, or ``range``
        unknown or empty.
    OSError
        File that cannot be read.
    """
@final
class ModelImage:
    """Image with a known pose.

    Parameters
    ----------
    id : int
        Number of the image in files that number them; no two are equal.
    name : str
        Name, mostly the path of its file within a folder of images.
    camera : int
        Index of its camera.
    cam_from_world : RigidTransform
    keypoints : array_like, shape (N, 2)
        Pixels.
    """
    def __new__(
        cls,
        id: int,
        name: str,
        camera: int,
        cam_from_world: RigidTransform,
        keypoints: ArrayLike,
    ) -> ModelImage: ...
    @property
    def id(self) -> int:
        """Number of the image."""
    @property
    def name(self) -> str:
        """Name."""
    @property
    def camera(self) -> int:
        """Index of its camera."""
    @property
    def cam_from_world(self) -> RigidTransform:
        """Pose: ``x_in_cam = cam_from_world @ x_in_world``."""
    @property
    def keypoints(self) -> NDArray[np.float64]:
        """Keypoints, pixels, shape (N, 2)."""
    def __eq__(self, other: object, /) -> bool: ...
    def center_in_world(self) -> NDArray[np.float64]:
        """Center of the camera in the world, shape (3,)."""
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class Rig:
    """Cameras that are fixed to each other, and the moments in which they took images.

    Parameters
    ----------
    id : int
        Number of the rig in files that number them; no two are equal.
    cameras : list of tuple
        Index of each camera and its ``cam_from_rig``, the identity of the first one.
    frames : list of tuple
        Number of each frame, its ``rig_from_world``, and the indices of its images.
    """
    def __new__(
        cls,
        id: int,
        cameras: Sequence[tuple[int, RigidTransform]],
        frames: Sequence[tuple[int, RigidTransform, Sequence[int]]],
    ) -> Rig: ...
    @property
    def id(self) -> int:
        """Number of the rig."""
    @property
    def cameras(self) -> list[tuple[int, RigidTransform]]:
        """Index of each camera and its ``cam_from_rig``, a list of tuple."""
    @property
    def frames(self) -> list[tuple[int, RigidTransform, list[int]]]:
        """Number of each frame, its ``rig_from_world``, the indices of its images, a list of tuple."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class Model:
    """Cameras, the images that they took, and points of the scene.

    Parameters
    ----------
    cameras : list of Camera
    images : list of ModelImage
    points : array_like, shape (P, 3)
    tracks : array_like of int, shape (K, 3)
        Observations: index of the point, of the image, and of its keypoint.
    colors : array_like of uint8, shape (P, 3), optional
        Red, green, blue. Gray if not given.
    errors_px : list of float or None, optional
        Mean reprojection error of each point, pixels.
    camera_ids : list of int, optional
        Number of each camera in files that number them. Counted from 1 if not given.
    point_ids : list of int, optional
        The same of the points.
    rigs : list of Rig, optional
        Cameras that are fixed to each other.

    Raises
    ------
    ValueError
        Track of a point that does not exist.
    """
    def __new__(
        cls,
        cameras: Sequence[Camera],
        images: Sequence[ModelImage],
        points: ArrayLike,
        tracks: ArrayLike,
        colors: ArrayLike | None = None,
        errors_px: Sequence[float | None] | None = None,
        camera_ids: Sequence[int] | None = None,
        point_ids: Sequence[int] | None = None,
        rigs: Sequence[Rig] | None = None,
    ) -> Model: ...
    @property
    def cameras(self) -> list[Camera]:
        """Cameras, a list of `Camera`."""
    @property
    def images(self) -> list[ModelImage]:
        """Images with a known pose, a list of `ModelImage`."""
    @property
    def points(self) -> NDArray[np.float64]:
        """Points, shape (P, 3)."""
    @property
    def tracks(self) -> NDArray[np.int64]:
        """Observations: index of the point, of the image, and of its keypoint, int64 of shape (K, 3)."""
    @property
    def colors(self) -> NDArray[np.uint8]:
        """Colors of the points, uint8 of shape (P, 3)."""
    @property
    def errors_px(self) -> list[float | None]:
        """Mean reprojection error of each point, pixels; None if the file has none."""
    @property
    def camera_ids(self) -> list[int]:
        """Number of each camera in files that number them."""
    @property
    def point_ids(self) -> list[int]:
        """Number of each point in files that number them."""
    @property
    def rigs(self) -> list[Rig]:
        """Cameras that are fixed to each other, a list of `Rig`."""
    def __eq__(self, other: object, /) -> bool: ...
    @staticmethod
    def from_reconstruction(
        reconstruction: Reconstruction,
        images: Sequence[SfmImage],
    ) -> Model:
        """Model of a reconstruction; `images` are those that it was made from.

        Parameters
        ----------
        reconstruction : epipole.sfm.Reconstruction
        images : list of epipole.sfm.SfmImage
            Images of the input.
        """
    def to_reconstruction(self) -> tuple[Reconstruction, list[SfmImage]]:
        """Reconstruction and its images.

        Raises
        ------
        ValueError
            Index of something that the model does not have.
        """
    def cloud(self) -> PointCloud:
        """Points without observations.

        Returns
        -------
        epipole.stereo.PointCloud
        """
    def num_observations(self) -> int:
        """Number of observations of all points."""
    def mean_reprojection_px(self) -> float | None:
        """Mean length of all reprojection errors, pixels; None without observations.

        Raises
        ------
        ValueError
            Index of something that the model does not have.
        """
    def oddities(self) -> list[str]:
        """Oddities of the model, such as points behind cameras, a sentence each.

        Raises
        ------
        ValueError
            Index of something that the model does not have.
        """
    def losses(self, format: str) -> list[str]:
        """Losses of a format, a sentence each.

        Parameters
        ----------
        format : str
            Format of a file.

        Raises
        ------
        ValueError
            Unknown format.
        """
    def to_files(self, format: str) -> dict[str, Any]:
        """Files of the model.

        Parameters
        ----------
        format : str
            "colmap-text", "colmap-binary", "bundler", "transforms", "openmvg", "ply", "glb" or
            "html".

        Returns
        -------
        dict
            Bytes of each file by its usual name.

        Raises
        ------
        ValueError
            Unknown format, a camera that it cannot hold, or an index of something that the model
            does not have.
        """
    def write(self, folder: str | os.PathLike[str], format: str) -> list[Any]:
        """Writes the files of the model into a folder, which is created if needed.

        Parameters
        ----------
        folder : str or os.PathLike
        format : str
            As in `to_files`.

        Returns
        -------
        list of Any
            Paths of the files, `pathlib.Path`.

        Raises
        ------
        ValueError
            Unknown format, a camera that it cannot hold, or an index of something that the model
            does not have.
        OSError
            Folder or file that cannot be written.
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class ReadModel:
    """Model that was read.

    Parameters
    ----------
    format
        Format: "colmap-text", "colmap-binary", "bundler", "transforms", "openmvg" or "ply".
    model
        Model.
    notes
        Sentences on what was left out or assumed.
    """
    def __new__(cls, format: str, model: Model, notes: Sequence[str]) -> ReadModel: ...
    @property
    def format(self) -> str:
        """Format: "colmap-text", "colmap-binary", "bundler", "transforms", "openmvg" or "ply"."""
    @property
    def model(self) -> Model:
        """Model."""
    @property
    def notes(self) -> list[str]:
        """Sentences on what was left out or assumed."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

def read_model_folder(folder: str | os.PathLike[str]) -> ReadModel:
    """Reads the model in a folder.

    Parameters
    ----------
    folder : str or os.PathLike
        Folder with COLMAP's files, or with one of transforms.json, sfm_data.json, bundle.out,
        points.ply.

    Returns
    -------
    ReadModel

    Raises
    ------
    ValueError
        Damaged or incomplete model, or a camera that the library does not have.
    FileNotFoundError
        No model in the folder, or no folder.
    OSError
        Folder that cannot be read.
    """
def read_model_file(path: str | os.PathLike[str]) -> ReadModel:
    """Reads a model of one file; files beside it are read if the format needs them.

    Parameters
    ----------
    path : str or os.PathLike

    Returns
    -------
    ReadModel

    Raises
    ------
    ValueError
        Unknown format, damaged model, or a camera that the library does not have.
    OSError
        File that cannot be read.
    """
def read_ply(source: str | os.PathLike[str] | bytes) -> tuple[PointCloud, list[str]]:
    """Reads the points of a PLY file.

    Parameters
    ----------
    source : str, os.PathLike or bytes

    Returns
    -------
    cloud : epipole.stereo.PointCloud
    notes : list of str
        Sentences on what was left out: points with NaN or infinity, faces of a mesh.

    Raises
    ------
    ValueError
        File that is no PLY, or a damaged one.
    OSError
        File that cannot be read.
    """
def write_ply(path: str | os.PathLike[str], cloud: PointCloud | ArrayLike) -> None:
    """Writes points as a binary PLY file.

    Parameters
    ----------
    path : str or os.PathLike
    cloud : epipole.stereo.PointCloud or array_like, shape (N, 3)

    Raises
    ------
    OSError
        File that cannot be written.
    """
def read_pfm(source: str | os.PathLike[str] | bytes) -> NDArray[np.float32]:
    """Reads the disparities of a gray PFM file.

    Parameters
    ----------
    source : str, os.PathLike or bytes

    Returns
    -------
    ndarray of float32, shape (H, W)
        NaN where unknown.

    Raises
    ------
    ValueError
        File that is no gray PFM, or a truncated one.
    OSError
        File that cannot be read.
    """
def write_pfm(path: str | os.PathLike[str], disparity: ArrayLike) -> None:
    """Writes disparities as a gray PFM file, the format of Middlebury.

    Parameters
    ----------
    path : str or os.PathLike
    disparity : array_like of float, shape (H, W)
        NaN where unknown.

    Raises
    ------
    OSError
        File that cannot be written.
    """
def write_png16(path: str | os.PathLike[str], disparity: ArrayLike) -> None:
    """Writes disparities times 256 as a 16-bit PNG file, the format of KITTI.

    Parameters
    ----------
    path : str or os.PathLike
    disparity : array_like of float, shape (H, W)
        NaN where unknown. Values outside [1/256, 255.996] are written as unknown.

    Raises
    ------
    OSError
        File that cannot be written.
    """
def read_g2o(source: str | os.PathLike[str] | bytes) -> PoseGraph:
    """Reads a pose graph in the text format of g2o: SE2, SE3:QUAT or SIM3:QUAT, with priors.

    Landmarks that are points are vertices without a rotation; others are left out, with a warning.

    Parameters
    ----------
    source : str, os.PathLike or bytes

    Returns
    -------
    epipole.sfm.PoseGraph

    Raises
    ------
    ValueError
        Unknown tag, mixed kinds, vertices that are missing or double, wrong numbers, or no
        vertices.
    OSError
        File that cannot be read.
    """
def write_g2o(path: str | os.PathLike[str], graph: PoseGraph) -> None:
    """Writes a pose graph in the text format of g2o.

    Parameters
    ----------
    path : str or os.PathLike
    graph : epipole.sfm.PoseGraph

    Raises
    ------
    OSError
        File that cannot be written.
    """
def read_bal(source: str | os.PathLike[str] | bytes) -> BalProblem:
    """Reads a bundle adjustment problem of the BAL data set.

    Parameters
    ----------
    source : str, os.PathLike or bytes

    Returns
    -------
    epipole.sfm.BalProblem

    Raises
    ------
    ValueError
        Missing, surplus or infinite numbers, or an index of no camera or point.
    OSError
        File that cannot be read.
    """
def write_bal(path: str | os.PathLike[str], problem: BalProblem) -> None:
    """Writes a bundle adjustment problem of the BAL data set, with all digits.

    Parameters
    ----------
    path : str or os.PathLike
    problem : epipole.sfm.BalProblem

    Raises
    ------
    OSError
        File that cannot be written.
    """
def write_mesh(
    path: str | os.PathLike[str],
    mesh: Mesh,
    texture: MeshTexture | None = None,
) -> None:
    """Writes a mesh as PLY, glTF or OBJ, by the extension of the file.

    Parameters
    ----------
    path : str or os.PathLike
        Ends in ``.ply``, ``.glb`` or ``.obj``.
    mesh : epipole.mvs.Mesh
    texture : epipole.mvs.MeshTexture, optional
        Instead of the colors of the vertices, for ``.glb`` and ``.obj``. The material and the image
        of an OBJ file are written beside it, with the extensions ``.mtl`` and ``.jpg``.

    Raises
    ------
    ValueError
        Another extension, a texture for PLY, or a triangle of a vertex that does not exist.
    """
def read_matches(
    source: str | os.PathLike[str] | bytes,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Reads matches of two images: ``u1 v1 u2 v2`` a line, pixels.

    Parameters
    ----------
    source : str, os.PathLike or bytes
        Numbers between commas, semicolons, tabs or spaces; a first line of names allows any order.

    Returns
    -------
    pixels1, pixels2 : ndarray, shape (N, 2)

    Raises
    ------
    ValueError
        Line with a missing number, NaN or an ambiguous comma, or a first column that counts the
        rows.
    OSError
        File that cannot be read.
    """
def read_points(source: str | os.PathLike[str] | bytes) -> NDArray[np.float64]:
    r"""Reads points of an image: ``u v`` a line, pixels.

    Parameters
    ----------
    source : str, os.PathLike or bytes

    Returns
    -------
    ndarray, shape (N, 2)

    Raises
    ------
    ValueError
        Line with a missing number, NaN or an ambiguous comma, or a first column that counts the
        rows.
    OSError
        File that cannot be read.

    Examples
    --------
    >>> read_points(b"1 2\n3 4\n").tolist()
    [[1.0, 2.0], [3.0, 4.0]]
    """
def read_points_with_pixels(
    source: str | os.PathLike[str] | bytes,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Reads points of the world with their pixels: ``x y z u v`` a line.

    Parameters
    ----------
    source : str, os.PathLike or bytes

    Returns
    -------
    pixels : ndarray, shape (N, 2)
    points : ndarray, shape (N, 3)

    Raises
    ------
    ValueError
        Line with a missing number, NaN or an ambiguous comma, or a first column that counts the
        rows.
    OSError
        File that cannot be read.
    """
def write_matches(
    path: str | os.PathLike[str],
    pixels1: ArrayLike,
    pixels2: ArrayLike,
    distances: ArrayLike | None = None,
    ratios: ArrayLike | None = None,
    layout: str = 'text',
) -> None:
    """Writes matches: ``u1 v1 u2 v2 distance ratio`` a line, or ``u1 v1 u2 v2`` without ``distances``
    and ``ratios``.

    Parameters
    ----------
    path : str or os.PathLike
    pixels1, pixels2 : array_like, shape (N, 2)
    distances, ratios : array_like, shape (N,), optional
        Distance of the descriptors, and its ratio to that of the second nearest. 0 if only the
        other is given.
    layout : {"text", "csv"}, optional

    Raises
    ------
    ValueError
        Unknown ``layout``.
    OSError
        File that cannot be written.
    """
@final
class Trajectory:
    """Poses of one camera over time.

    Parameters
    ----------
    world_from_cam : list of RigidTransform
    stamps_ns : array_like of int, shape (N,), optional
        Time of each pose, nanoseconds, not descending.
    notes : list of str, optional
        Sentences on what a reader assumed.
    """
    def __new__(
        cls,
        world_from_cam: Sequence[RigidTransform],
        stamps_ns: Sequence[int] | None = None,
        notes: Sequence[str] | None = None,
    ) -> Trajectory: ...
    @property
    def world_from_cam(self) -> list[RigidTransform]:
        """``x_in_world = world_from_cam @ x_in_cam``, a list of `RigidTransform`."""
    @property
    def stamps_ns(self) -> NDArray[np.int64] | None:
        """Time of each pose, nanoseconds, int64 of shape (N,), or None."""
    @property
    def notes(self) -> list[str]:
        """Sentences on what a reader assumed, a list of str."""
    def __eq__(self, other: object, /) -> bool: ...
    def __len__(self) -> int: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

def read_trajectory(
    source: str | os.PathLike[str] | bytes,
) -> tuple[Literal["tum", "kitti", "euroc"], Trajectory]:
    """Reads a trajectory; the format follows from its content.

    Parameters
    ----------
    source : str, os.PathLike or bytes
        File of TUM, KITTI or EuRoC.

    Returns
    -------
    format : {"tum", "kitti", "euroc"}
    trajectory : Trajectory

    Raises
    ------
    ValueError
        Unknown format, wrong numbers, zero quaternions, matrices that are no rotation, or times
        that go backwards.
    OSError
        File that cannot be read.
    """
def write_trajectory(
    path: str | os.PathLike[str],
    trajectory: Trajectory,
    format: str = 'tum',
) -> None:
    """Writes a trajectory with all digits.

    Parameters
    ----------
    path : str or os.PathLike
    trajectory : Trajectory
    format : {"tum", "kitti", "euroc"}, optional
        "kitti" has no times, the others need them.

    Raises
    ------
    ValueError
        Unknown format, or no times for TUM or EuRoC.
    OSError
        File that cannot be written.
    """
