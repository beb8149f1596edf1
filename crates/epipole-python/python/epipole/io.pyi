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
    """Camera with its name in a file.

    Parameters
    ----------
    name : str
    camera : Camera
    cam_from_world : RigidTransform, optional
        Pose, for formats that have one.
    """
    def __new__(
        cls,
        name: str,
        camera: Camera,
        cam_from_world: RigidTransform | None = None,
    ) -> NamedCamera: ...
    @property
    def name(self) -> str:
        """Name, number or image in the file; otherwise "camera", or "left" and "right"."""
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
    """Content of a camera file.

    Parameters
    ----------
    cameras : list of NamedCamera
    right_from_left : RigidTransform, optional
        Motion of a rig from the first to the second camera, in the unit of the file.
    notes : list of str, optional
        Notes on cameras of the file that were skipped, as sentences.
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
        """Motion of a rig from the first to the second camera, or None."""
    @property
    def notes(self) -> list[str]:
        """Notes on cameras skipped because their lens is not supported, a list of str."""
    def __eq__(self, other: object, /) -> bool: ...
    @staticmethod
    def of(camera: Camera) -> Cameras:
        """Creates content with one camera.

        Parameters
        ----------
        camera : epipole.camera.Camera
        """
    @staticmethod
    def of_rig(cameras: Sequence[Camera], right_from_left: RigidTransform) -> Cameras:
        """Creates content with the two cameras of a rig.

        Parameters
        ----------
        cameras : sequence of epipole.camera.Camera
            Left and right camera.
        right_from_left : epipole.camera.RigidTransform
        """
    def named(self, name: str) -> Camera:
        """Returns the camera with a name; `KeyError` if there is none.

        Parameters
        ----------
        name : str

        Raises
        ------
        KeyError
            If there is no camera of this name.
        """
    def __len__(self) -> int: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

def read_cameras(
    source: str | os.PathLike[str] | bytes,
    size: tuple[int, int] | None = None,
) -> tuple[str, Cameras]:
    """Reads the cameras of a file; the format is detected from its content.

    Parameters
    ----------
    source : str, os.PathLike or bytes
        File of Epipole, OpenCV, ROS, Kalibr, KITTI, ORB-SLAM, Middlebury, COLMAP, nerfstudio,
        Metashape or MATLAB, or plain numbers.
    size : tuple of int, optional
        Width and height of the images, pixels, for files that lack them.

    Returns
    -------
    format : str
    cameras : Cameras

    Raises
    ------
    ValueError
        If the format is unknown, values are wrong or missing, or the lens model is not supported.
    OSError
        If the file cannot be read.
    """
def read_q(source: str | os.PathLike[str] | bytes) -> NDArray[np.float64]:
    """Reads Q of a rectified pair, which maps pixels with disparities to points.

    Parameters
    ----------
    source : str, os.PathLike or bytes
        File with the key ``Q`` from OpenCV or ``epipole rectify --json``, or sixteen numbers, row
        by row.

    Returns
    -------
    ndarray, shape (4, 4)

    Raises
    ------
    ValueError
        If there are not 16 finite numbers, or they are not the Q of a rectified pair.
    OSError
        If the file cannot be read.
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
        If the format is unknown, or cannot hold a lens or this number of cameras.
    OSError
        If the file cannot be written.
    """
@final
class Decoded:
    """Image, with camera data from its file.

    Parameters
    ----------
    image
        Pixels: uint8 of shape (H, W, 3), or float32 of shape (H, W) in [0, 1].
    focal_px
        Initial guess of the focal length from the EXIF data, pixels of this image, or None.
    focal_mm
        Focal length from the EXIF data, millimeters, or None.
    place
        Position of the camera, an `epipole.math.Geodetic`, or None without GPS data.
    orientation
        EXIF orientation of the file, 1 to 8, whether applied or not.
    range
        Sample values that became black and white; None for those of the format.
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
        """Initial guess of the focal length from the EXIF data, pixels of this image, or None."""
    @property
    def focal_mm(self) -> float | None:
        """Focal length from the EXIF data, millimeters, or None."""
    @property
    def place(self) -> Geodetic | None:
        """Position of the camera, an `epipole.math.Geodetic`, or None without GPS data."""
    @property
    def orientation(self) -> int:
        """EXIF orientation of the file, 1 to 8, whether applied or not."""
    @property
    def range(self) -> list[float] | None:
        """Sample values that became black and white; None for those of the format."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class PreparedPhoto:
    """Photo after it was rotated upright, undistorted and downscaled.

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
        """Initial guess of the focal length from the EXIF data, pixels of `image`, or None."""
    @property
    def focal_mm(self) -> float | None:
        """Focal length from the EXIF data, millimeters, or None."""
    @property
    def place(self) -> Geodetic | None:
        """Position of the camera, an `epipole.math.Geodetic`, or None."""
    @property
    def intrinsics(self) -> Intrinsics | None:
        """K if the distortion of a known lens was removed, else None."""
    @property
    def full_size(self) -> tuple[int, int]:
        """Width and height before downscaling, upright."""
    @property
    def sensor_size(self) -> tuple[int, int]:
        """Width and height before the rotation."""
    @property
    def quarters(self) -> int | None:
        """Number of clockwise quarter turns to the upright image; None if it was mirrored."""
    @property
    def range(self) -> list[float] | None:
        """Sample values that became black and white; None for those of the format."""
    @property
    def is_as_stored(self) -> bool:
        """Whether the pixels are unchanged from the file."""
    def __eq__(self, other: object, /) -> bool: ...
    def reduced_focal_px(self, focal_px: float) -> float:
        """Converts a focal length to pixels of `image`, from pixels before downscaling.

        Parameters
        ----------
        focal_px : float
            Focal length in the file, pixels.
        """
    def camera(self, camera: Camera) -> Camera | None:
        """Returns the camera of `image`; None for another size or a mirrored photo.

        Parameters
        ----------
        camera : epipole.camera.Camera
            Camera of the sensor, or of the upright photo.
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

def decode_rgb(
    source: str | os.PathLike[str] | bytes,
    *,
    max_pixels: int | None = None,
    apply_orientation: bool = True,
    range: str | Sequence[float] | None = None,
) -> Decoded:
    """Decodes a PNG, JPEG, WebP, TIFF, BMP or PNM file to a color image, with its EXIF data.

    Parameters
    ----------
    source : str, os.PathLike or bytes
    max_pixels : int, optional
        Larger images are rejected. 64 million by default.
    apply_orientation : bool, optional
        Whether to rotate the image upright by its EXIF orientation.
    range : str or tuple of float, optional
        Sample values that become black and white: ``"auto"`` for those in use, ``"full"`` for all
        of the format, or a pair of values.

    Returns
    -------
    Decoded
        `image` is uint8 of shape (H, W, 3).

    Raises
    ------
    ValueError
        If the file is damaged or not an image, it has more than ``max_pixels`` pixels, or ``range``
        is unknown or empty.
    OSError
        If the file cannot be read.
    """
def decode_gray(
    source: str | os.PathLike[str] | bytes,
    *,
    max_pixels: int | None = None,
    apply_orientation: bool = True,
    range: str | Sequence[float] | None = None,
) -> Decoded:
    """Decodes a PNG, JPEG, WebP, TIFF, BMP or PNM file to a gray image, with its EXIF data.

    Parameters
    ----------
    source : str, os.PathLike or bytes
    max_pixels : int, optional
        Larger images are rejected. 64 million by default.
    apply_orientation : bool, optional
        Whether to rotate the image upright by its EXIF orientation.
    range : str or tuple of float, optional
        Sample values that become black and white: ``"auto"`` for those in use, ``"full"`` for all
        of the format, or a pair of values.

    Returns
    -------
    Decoded
        `image` is float32 of shape (H, W), in [0, 1].

    Raises
    ------
    ValueError
        If the file is damaged or not an image, it has more than ``max_pixels`` pixels, or ``range``
        is unknown or empty.
    OSError
        If the file cannot be read.
    """
def sensor_size(source: str | os.PathLike[str] | bytes) -> tuple[int, int]:
    """Reads width and height of an image before its orientation is applied, from the header alone.

    Parameters
    ----------
    source : str, os.PathLike or bytes

    Returns
    -------
    tuple of int

    Raises
    ------
    ValueError
        If the file is not an image, or its header is damaged.
    OSError
        If the file cannot be read.
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
    """Reads a color image, undistorts it, rotates it upright and downscales it.

    Parameters
    ----------
    source : str, os.PathLike or bytes
    max_pixels : int, optional
        Maximum number of pixels of the result.
    max_file_pixels : int, optional
        Larger files are rejected. 64 million by default.
    range : str or tuple of float, optional
        Same as for `decode_rgb`.
    sensor_width_mm : float, optional
        Length of the longer side of the sensor, millimeters, for files that give the focal length
        in millimeters only.
    undistortion : epipole.calibration.Undistortion, optional
        Applied to images with the size of its camera.

    Returns
    -------
    PreparedPhoto

    Raises
    ------
    ValueError
        If the file is damaged or not an image, it has more than ``max_file_pixels`` pixels, or
        ``range`` is unknown or empty.
    OSError
        If the file cannot be read.
    """
@final
class ModelImage:
    """Image with a known pose.

    Parameters
    ----------
    id : int
        Number of the image in files with numbered images; unique.
    name : str
        Name, usually the path of its file within a folder of images.
    camera : int
        Index of the image's camera.
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
        """Index of the image's camera."""
    @property
    def cam_from_world(self) -> RigidTransform:
        """Pose: ``x_in_cam = cam_from_world @ x_in_world``."""
    @property
    def keypoints(self) -> NDArray[np.float64]:
        """Keypoints, pixels, shape (N, 2)."""
    def __eq__(self, other: object, /) -> bool: ...
    def center_in_world(self) -> NDArray[np.float64]:
        """Returns the center of the camera in the world, shape (3,)."""
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class Rig:
    """Cameras mounted rigidly on each other, and the frames that they took.

    Parameters
    ----------
    id : int
        Number of the rig in files with numbered rigs; unique.
    cameras : list of tuple
        Index of each camera and its ``cam_from_rig``, which is the identity for the first one.
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
    """Cameras, their images, and points of the scene.

    Parameters
    ----------
    cameras : list of Camera
    images : list of ModelImage
    points : array_like, shape (P, 3)
    tracks : array_like of int, shape (K, 3)
        Observations: indices of the point, of the image, and of the image's keypoint.
    colors : array_like of uint8, shape (P, 3), optional
        Red, green, blue. Gray by default.
    errors_px : list of float or None, optional
        Mean reprojection error of each point, pixels.
    camera_ids : list of int, optional
        Number of each camera in files with numbered cameras. Counted from 1 by default.
    point_ids : list of int, optional
        Number of each point in files with numbered points. Counted from 1 by default.
    rigs : list of Rig, optional
        Cameras mounted rigidly on each other.

    Raises
    ------
    ValueError
        If a track refers to a missing point.
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
        """Observations, int64 of shape (K, 3): indices of the point, the image and its keypoint."""
    @property
    def colors(self) -> NDArray[np.uint8]:
        """Colors of the points, uint8 of shape (P, 3)."""
    @property
    def errors_px(self) -> list[float | None]:
        """Mean reprojection error of each point, pixels; None if the file lacks it."""
    @property
    def camera_ids(self) -> list[int]:
        """Number of each camera in files with numbered cameras."""
    @property
    def point_ids(self) -> list[int]:
        """Number of each point in files with numbered points."""
    @property
    def rigs(self) -> list[Rig]:
        """Cameras mounted rigidly on each other, a list of `Rig`."""
    def __eq__(self, other: object, /) -> bool: ...
    @staticmethod
    def from_reconstruction(
        reconstruction: Reconstruction,
        images: Sequence[SfmImage],
    ) -> Model:
        """Creates the model of a reconstruction and its `images`.

        Parameters
        ----------
        reconstruction : epipole.sfm.Reconstruction
        images : list of epipole.sfm.SfmImage
            Images of the input.
        """
    def to_reconstruction(self) -> tuple[Reconstruction, list[SfmImage]]:
        """Returns the reconstruction and its images.

        Raises
        ------
        ValueError
            If an index refers to a missing item of the model.
        """
    def cloud(self) -> PointCloud:
        """Returns the points without their observations.

        Returns
        -------
        epipole.stereo.PointCloud
        """
    def num_observations(self) -> int:
        """Returns the number of observations of all points."""
    def mean_reprojection_px(self) -> float | None:
        """Computes the mean length of all reprojection errors, pixels; None without observations.

        Raises
        ------
        ValueError
            If an index refers to a missing item of the model.
        """
    def oddities(self) -> list[str]:
        """Returns oddities of the model, such as points behind cameras, as sentences.

        Raises
        ------
        ValueError
            If an index refers to a missing item of the model.
        """
    def losses(self, format: str) -> list[str]:
        """Returns the information that a format loses, as sentences.

        Parameters
        ----------
        format : str
            File format.

        Raises
        ------
        ValueError
            If the format is unknown.
        """
    def to_files(self, format: str) -> dict[str, Any]:
        """Returns the files of the model.

        Parameters
        ----------
        format : str
            "colmap-text", "colmap-binary", "bundler", "transforms", "openmvg", "ply", "glb" or
            "html".

        Returns
        -------
        dict
            Content of each file by its usual name, as bytes.

        Raises
        ------
        ValueError
            If the format is unknown or cannot hold a camera, or an index refers to a missing item
            of the model.
        """
    def write(self, folder: str | os.PathLike[str], format: str) -> list[Any]:
        """Writes the files of the model to a folder, which is created if needed.

        Parameters
        ----------
        folder : str or os.PathLike
        format : str
            Same as for `to_files`.

        Returns
        -------
        list of Any
            Paths of the files, `pathlib.Path`.

        Raises
        ------
        ValueError
            If the format is unknown or cannot hold a camera, or an index refers to a missing item
            of the model.
        OSError
            If a folder or file cannot be written.
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class ReadModel:
    """Model as read from files.

    Parameters
    ----------
    format
        Format: "colmap-text", "colmap-binary", "bundler", "transforms", "openmvg" or "ply".
    model
        Model.
    notes
        Notes on skipped content and assumptions, as sentences.
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
        """Notes on skipped content and assumptions, as sentences."""
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
        If the model is damaged or incomplete, or a camera model is not supported.
    FileNotFoundError
        If the folder does not exist or holds no model.
    OSError
        If the folder cannot be read.
    """
def read_model_file(path: str | os.PathLike[str]) -> ReadModel:
    """Reads a model from one file; related files are read if the format needs them.

    Parameters
    ----------
    path : str or os.PathLike

    Returns
    -------
    ReadModel

    Raises
    ------
    ValueError
        If the format is unknown, the model is damaged, or a camera model is not supported.
    OSError
        If the file cannot be read.
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
        Notes on skipped content, as sentences: points with NaN or infinity, faces of a mesh.

    Raises
    ------
    ValueError
        If the file is damaged or is not a PLY file.
    OSError
        If the file cannot be read.
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
        If the file cannot be written.
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
        If the file is truncated or is not a gray PFM file.
    OSError
        If the file cannot be read.
    """
def write_pfm(path: str | os.PathLike[str], disparity: ArrayLike) -> None:
    """Writes disparities as a gray PFM file, the format of the Middlebury benchmark.

    Parameters
    ----------
    path : str or os.PathLike
    disparity : array_like of float, shape (H, W)
        NaN where unknown.

    Raises
    ------
    OSError
        If the file cannot be written.
    """
def write_png16(path: str | os.PathLike[str], disparity: ArrayLike) -> None:
    """Writes disparities times 256 as a 16-bit PNG file, the format of the KITTI benchmark.

    Parameters
    ----------
    path : str or os.PathLike
    disparity : array_like of float, shape (H, W)
        NaN where unknown. Values outside [1/256, 255.996] are written as unknown.

    Raises
    ------
    OSError
        If the file cannot be written.
    """
def read_g2o(source: str | os.PathLike[str] | bytes) -> PoseGraph:
    """Reads a pose graph in the text format of g2o: SE2, SE3:QUAT or SIM3:QUAT, with priors.

    Point landmarks become vertices without a rotation; others are skipped, with a warning.

    Parameters
    ----------
    source : str, os.PathLike or bytes

    Returns
    -------
    epipole.sfm.PoseGraph

    Raises
    ------
    ValueError
        If a tag is unknown, kinds are mixed, vertices are missing or duplicate, numbers are wrong,
        or there are no vertices.
    OSError
        If the file cannot be read.
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
        If the file cannot be written.
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
        If numbers are missing, surplus or infinite, or an index refers to a missing camera or
        point.
    OSError
        If the file cannot be read.
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
        If the file cannot be written.
    """
def write_mesh(
    path: str | os.PathLike[str],
    mesh: Mesh,
    texture: MeshTexture | None = None,
) -> None:
    """Writes a mesh as PLY, glTF or OBJ, depending on the extension of the file.

    Parameters
    ----------
    path : str or os.PathLike
        Ends in ``.ply``, ``.glb`` or ``.obj``.
    mesh : epipole.mvs.Mesh
    texture : epipole.mvs.MeshTexture, optional
        Replaces the vertex colors, for ``.glb`` and ``.obj``. Material and image of an OBJ file are
        written to the same folder, with the extensions ``.mtl`` and ``.jpg``.

    Raises
    ------
    ValueError
        If the extension is another one, a PLY file is to get a texture, or a triangle refers to a
        missing vertex.
    """
def read_matches(
    source: str | os.PathLike[str] | bytes,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Reads matches of two images: ``u1 v1 u2 v2`` per line, pixels.

    Parameters
    ----------
    source : str, os.PathLike or bytes
        Numbers separated by commas, semicolons, tabs or spaces, in any order if a header names
        them.

    Returns
    -------
    pixels1, pixels2 : ndarray, shape (N, 2)

    Raises
    ------
    ValueError
        If a line has a missing number, NaN or an ambiguous comma, or the first column counts the
        rows.
    OSError
        If the file cannot be read.
    """
def read_points(source: str | os.PathLike[str] | bytes) -> NDArray[np.float64]:
    r"""Reads points of an image: ``u v`` per line, pixels.

    Parameters
    ----------
    source : str, os.PathLike or bytes

    Returns
    -------
    ndarray, shape (N, 2)

    Raises
    ------
    ValueError
        If a line has a missing number, NaN or an ambiguous comma, or the first column counts the
        rows.
    OSError
        If the file cannot be read.

    Examples
    --------
    >>> read_points(b"1 2\n3 4\n").tolist()
    [[1.0, 2.0], [3.0, 4.0]]
    """
def read_points_with_pixels(
    source: str | os.PathLike[str] | bytes,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Reads world points with their pixels: ``x y z u v`` per line.

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
        If a line has a missing number, NaN or an ambiguous comma, or the first column counts the
        rows.
    OSError
        If the file cannot be read.
    """
def write_matches(
    path: str | os.PathLike[str],
    pixels1: ArrayLike,
    pixels2: ArrayLike,
    distances: ArrayLike | None = None,
    ratios: ArrayLike | None = None,
    layout: str = 'text',
) -> None:
    """Writes matches, one per line: ``u1 v1 u2 v2``, then distance and ratio if given.

    Parameters
    ----------
    path : str or os.PathLike
    pixels1, pixels2 : array_like, shape (N, 2)
    distances, ratios : array_like, shape (N,), optional
        Distance between the descriptors, and its ratio to the distance of the second nearest
        descriptor. If only one of the two is given, the other is written as 0.
    layout : {"text", "csv"}, optional

    Raises
    ------
    ValueError
        If ``layout`` is unknown.
    OSError
        If the file cannot be written.
    """
@final
class Trajectory:
    """Poses of one camera over time.

    Parameters
    ----------
    world_from_cam : list of RigidTransform
    stamps_ns : array_like of int, shape (N,), optional
        Time of each pose, nanoseconds, not decreasing.
    notes : list of str, optional
        Assumptions of a reader, as sentences.
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
        """Assumptions of a reader, as sentences, a list of str."""
    def __eq__(self, other: object, /) -> bool: ...
    def __len__(self) -> int: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

def read_trajectory(
    source: str | os.PathLike[str] | bytes,
) -> tuple[Literal["tum", "kitti", "euroc"], Trajectory]:
    """Reads a trajectory; the format is detected from its content.

    Parameters
    ----------
    source : str, os.PathLike or bytes
        TUM, KITTI or EuRoC file.

    Returns
    -------
    format : {"tum", "kitti", "euroc"}
    trajectory : Trajectory

    Raises
    ------
    ValueError
        If the format is unknown, numbers are wrong, a quaternion is zero, a matrix is not a
        rotation, or times decrease.
    OSError
        If the file cannot be read.
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
        "kitti" has no times, the other formats require them.

    Raises
    ------
    ValueError
        If the format is unknown, or times are missing for TUM or EuRoC.
    OSError
        If the file cannot be written.
    """
