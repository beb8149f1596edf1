# Written by stubs.py. Do not edit.

from collections.abc import Callable, Mapping, Sequence
from typing import Any, ClassVar, Literal, final, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray
from typing_extensions import Unpack

from epipole import options as option_types
from epipole.camera import Camera
from epipole.camera import PosedCamera
from epipole.camera import RigidTransform
from epipole.feature import Keypoints
from epipole.feature import Matches
from epipole.optim import LmReport

__all__ = [
    "BalProblem",
    "Bundle",
    "ClosedPath",
    "ErrorStatistics",
    "IncrementalReconstruction",
    "Localization",
    "LoopClosure",
    "Odometry",
    "OdometryResult",
    "PairMatches",
    "Photo",
    "PhotoFeatures",
    "PoseGraph",
    "PoseGraphReport",
    "PositionPrior",
    "Reconstruction",
    "RelativePoseError",
    "Sensor",
    "SfmImage",
    "SfmInput",
    "SfmResult",
    "SfmStep",
    "Similarity3",
    "TwoViewReconstruction",
    "VerifiedPair",
    "WhyUnregistered",
    "absolute_trajectory_error",
    "adjust_bal",
    "adjust_bundle",
    "align_points",
    "average_rotations",
    "build_tracks",
    "close_loops",
    "estimate_similarity_of_points",
    "match_features",
    "match_photos",
    "match_rectified",
    "monocular_odometry",
    "photo_features",
    "reconstruct",
    "reconstruct_photos",
    "relative_pose_error",
    "stereo_odometry",
    "triangulate_tracks",
    "two_view_reconstruction",
    "verify_matches",
    "why_unregistered",
]

@final
class Similarity3:
    """Rotation, translation and scale: ``x_in_a = scale * R @ x_in_b + t``.

    Parameters
    ----------
    isometry : RigidTransform, optional
        Rotation and translation. The identity if not given.
    scale : float, optional
        Greater than 0.

    Raises
    ------
    ValueError
        ``scale`` not above 0.
    """
    def __new__(cls, isometry: RigidTransform | None = None, scale: float = 1.0) -> Similarity3: ...
    @property
    def isometry(self) -> RigidTransform:
        """Rotation and translation."""
    @property
    def scale(self) -> float:
        """Scale."""
    @property
    def rotation(self) -> NDArray[np.float64]:
        """R, shape (3, 3)."""
    @property
    def translation(self) -> NDArray[np.float64]:
        """t, shape (3,)."""
    def __eq__(self, other: object, /) -> bool: ...
    def matrix(self) -> NDArray[np.float64]:
        """Homogeneous matrix, shape (4, 4)."""
    def inverse(self) -> Similarity3:
        """The inverse transform: ``b_from_a``."""
    @overload
    def __matmul__(self, other: Similarity3, /) -> Similarity3:
        """Composition with a similarity, or the image of points.

        Parameters
        ----------
        other : Similarity3 or array_like, shape (3,) or (N, 3)

        Returns
        -------
        Similarity3 or ndarray of the same shape
        """
    @overload
    def __matmul__(self, other: ArrayLike, /) -> NDArray[np.float64]:
        """Composition with a similarity, or the image of points.

        Parameters
        ----------
        other : Similarity3 or array_like, shape (3,) or (N, 3)

        Returns
        -------
        Similarity3 or ndarray of the same shape
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class ErrorStatistics:
    """Statistics of non-negative errors.

    Parameters
    ----------
    rmse
        Root of the mean square.
    mean
        Mean.
    median
        Median, the lower one of an even number.
    max
        Largest.
    """
    def __new__(cls, rmse: float, mean: float, median: float, max: float) -> ErrorStatistics: ...
    @property
    def rmse(self) -> float:
        """Root of the mean square."""
    @property
    def mean(self) -> float:
        """Mean."""
    @property
    def median(self) -> float:
        """Median, the lower one of an even number."""
    @property
    def max(self) -> float:
        """Largest."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class RelativePoseError:
    """Errors of the motion between frames.

    Parameters
    ----------
    translation
        `ErrorStatistics` of the translation, in the unit of the trajectories.
    rotation_deg
        `ErrorStatistics` of the rotation, degrees.
    """
    def __new__(
        cls,
        translation: ErrorStatistics,
        rotation_deg: ErrorStatistics,
    ) -> RelativePoseError: ...
    @property
    def translation(self) -> ErrorStatistics:
        """`ErrorStatistics` of the translation, in the unit of the trajectories."""
    @property
    def rotation_deg(self) -> ErrorStatistics:
        """`ErrorStatistics` of the rotation, degrees."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class Sensor:
    """Further camera rigidly mounted on each camera of a bundle, such as the right one of a rig.

    Parameters
    ----------
    sensor_from_camera : RigidTransform
        From the frame of the camera to that of the sensor; it is not refined.
    camera : Camera
        Image size, intrinsics and lens of the sensor.
    lens : int
        Number of its lens, as in `Bundle.lens_of_camera`.
    """
    def __new__(
        cls,
        sensor_from_camera: RigidTransform,
        camera: Camera,
        lens: int = 0,
    ) -> Sensor: ...
    @property
    def sensor_from_camera(self) -> RigidTransform:
        """From the frame of the camera to that of the sensor."""
    @property
    def camera(self) -> Camera:
        """Image size, intrinsics and lens."""
    @property
    def lens(self) -> int:
        """Number of its lens."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class Bundle:
    """Cameras, points and observations.

    Parameters
    ----------
    cameras : list of PosedCamera
    points : array_like, shape (P, 3)
        Points in the world.
    observations : array_like of int, shape (M, 2)
        Index of the camera and of the point.
    pixels : array_like, shape (M, 2)
        Pixel of each observation.
    lens_of_camera : array_like of int, optional
        Number of the lens of each camera; 0 if missing. Cameras of one lens have equal lenses and
        share what is refined of them.
    sensors : list of Sensor, optional
        Further cameras mounted on each camera.
    sensor_of_observation : array_like of int, optional
        0 if the camera itself made the observation, k if sensor k - 1 did; 0 if missing.
    """
    def __new__(
        cls,
        cameras: Sequence[PosedCamera],
        points: ArrayLike,
        observations: ArrayLike,
        pixels: ArrayLike,
        lens_of_camera: ArrayLike | None = None,
        sensors: Sequence[Sensor] | None = None,
        sensor_of_observation: ArrayLike | None = None,
    ) -> Bundle: ...
    @property
    def cameras(self) -> list[PosedCamera]:
        """Cameras, a list of `PosedCamera`."""
    @property
    def points(self) -> NDArray[np.float64]:
        """Points in the world, shape (P, 3)."""
    @property
    def observations(self) -> NDArray[np.int64]:
        """Index of the camera and of the point, int64 of shape (M, 2)."""
    @property
    def pixels(self) -> NDArray[np.float64]:
        """Pixel of each observation, shape (M, 2)."""
    @property
    def lens_of_camera(self) -> NDArray[np.int64]:
        """Number of the lens of each camera, int64 array."""
    @property
    def sensors(self) -> list[Sensor]:
        """Further cameras mounted on each camera, a list of `Sensor`."""
    @property
    def sensor_of_observation(self) -> NDArray[np.int64]:
        """Sensor of each observation, int64 array; 0 for the camera itself."""
    def __eq__(self, other: object, /) -> bool: ...
    def residual_px(self, observation: int) -> NDArray[np.float64]:
        """Reprojection error of an observation, predicted minus observed pixel, shape (2,).

        Parameters
        ----------
        observation : int
            Index of the observation.

        Raises
        ------
        IndexError
            Observation that does not exist, or whose camera or point does not.
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class BalProblem:
    """Bundle adjustment problem of the BAL data set.

    Parameters
    ----------
    cameras : array_like, shape (C, 9)
        Rotation as axis times angle (radians), translation, focal length (pixels), k1, k2. The
        camera looks along -z; pixels have the origin in the middle of the image and v up.
    points : array_like, shape (P, 3)
    observations : array_like of int, shape (M, 2)
        Index of the camera and of the point.
    pixels : array_like, shape (M, 2)
    """
    def __new__(
        cls,
        cameras: ArrayLike,
        points: ArrayLike,
        observations: ArrayLike,
        pixels: ArrayLike,
    ) -> BalProblem: ...
    @property
    def cameras(self) -> NDArray[np.float64]:
        """Cameras, shape (C, 9): rotation, translation, focal length, k1, k2."""
    @property
    def points(self) -> NDArray[np.float64]:
        """Points, shape (P, 3)."""
    @property
    def observations(self) -> NDArray[np.int64]:
        """Index of the camera and of the point, int64 of shape (M, 2)."""
    @property
    def pixels(self) -> NDArray[np.float64]:
        """Pixel of each observation, shape (M, 2), v up."""
    def __eq__(self, other: object, /) -> bool: ...
    def cost(self, loss: str | Mapping[str, Any] | None = None) -> float:
        """Half the sum of the losses, square pixels.

        Parameters
        ----------
        loss : str or dict, optional
            As in `adjust_bal`.

        Raises
        ------
        ValueError
            Loss width not above 0.
        IndexError
            Observation of a camera or point that does not exist.
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class PositionPrior:
    """Camera position measured otherwise, such as by GPS.

    Parameters
    ----------
    center_in_world : array_like, shape (3,)
        Center of the camera.
    sigma : array_like, shape (3,)
        Standard deviation along each axis of the world, in its unit, > 0.
    """
    def __new__(cls, center_in_world: ArrayLike, sigma: ArrayLike) -> PositionPrior: ...
    @property
    def center_in_world(self) -> NDArray[np.float64]:
        """Center of the camera, shape (3,)."""
    @property
    def sigma(self) -> NDArray[np.float64]:
        """Standard deviations, shape (3,)."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class SfmImage:
    """Image, reduced to its keypoints.

    Parameters
    ----------
    name : str
        Name, such as that of its file.
    keypoints : array_like, shape (N, 2)
        Pixels.
    colors : array_like of uint8, shape (N, 3), optional
        Red, green, blue.
    lens : int, optional
        Number of its lens. Images with the same number have equal lenses and share what is refined
        of them.
    position : PositionPrior, optional
        Position of the camera, if known.
    """
    def __new__(
        cls,
        name: str,
        keypoints: ArrayLike,
        colors: ArrayLike | None = None,
        lens: int = 0,
        position: PositionPrior | None = None,
    ) -> SfmImage: ...
    @property
    def name(self) -> str:
        """Name."""
    @property
    def keypoints(self) -> NDArray[np.float64]:
        """Keypoints, pixels, shape (N, 2)."""
    @property
    def colors(self) -> NDArray[np.uint8] | None:
        """Colors of the keypoints, uint8 of shape (N, 3), or None."""
    @property
    def lens(self) -> int:
        """Number of its lens."""
    @property
    def position(self) -> PositionPrior | None:
        """Position of the camera, or None."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class PairMatches:
    """Matches between the keypoints of two images.

    Parameters
    ----------
    image1, image2 : int
        Indices of the images.
    matches : epipole.feature.Matches or array_like of int, shape (M, 2)
        Indices of the matching keypoints.
    """
    def __new__(cls, image1: int, image2: int, matches: Matches | ArrayLike) -> PairMatches: ...
    @property
    def image1(self) -> int:
        """Index of the first image."""
    @property
    def image2(self) -> int:
        """Index of the second image."""
    @property
    def matches(self) -> Matches:
        """Matching keypoints.

        Returns
        -------
        epipole.feature.Matches
        """
    def __eq__(self, other: object, /) -> bool: ...
    def __len__(self) -> int: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class SfmInput:
    """Images, their cameras, and matches between them.

    Parameters
    ----------
    images : list of SfmImage
    cameras : list of Camera
        Camera of each image, or one for all.
    pairs : list of PairMatches
        Matches between images, wrong ones among them.
    """
    def __new__(
        cls,
        images: Sequence[SfmImage],
        cameras: Sequence[Camera],
        pairs: Sequence[PairMatches],
    ) -> SfmInput: ...
    @property
    def images(self) -> list[SfmImage]:
        """Images, a list of `SfmImage`."""
    @property
    def cameras(self) -> list[Camera]:
        """Camera of each image, or one for all."""
    @property
    def pairs(self) -> list[PairMatches]:
        """Matches between images, a list of `PairMatches`."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class Photo:
    """Photo with a name.

    Parameters
    ----------
    name : str
        Name, such as the file name.
    image : array_like of uint8, shape (H, W, 3)
        Red, green, blue.
    lens : int, optional
        Number of its lens, as in `SfmImage`.
    position : PositionPrior, optional
        Position of the camera, if known.
    """
    def __new__(
        cls,
        name: str,
        image: ArrayLike,
        lens: int = 0,
        position: PositionPrior | None = None,
    ) -> Photo: ...
    @property
    def name(self) -> str:
        """Name."""
    @property
    def image(self) -> NDArray[np.uint8]:
        """Pixels, uint8 of shape (H, W, 3)."""
    @property
    def lens(self) -> int:
        """Number of its lens."""
    @property
    def position(self) -> PositionPrior | None:
        """Position of the camera, or None."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class PhotoFeatures:
    """Features of a photo; its pixels are no longer needed.

    Parameters
    ----------
    image : SfmImage
        Size, keypoints and their colors.
    descriptors : array_like, shape (N, D) or uint8 of shape (N, 32)
        Numbers, or 256 bits.
    keypoints : epipole.feature.Keypoints
        Keypoints with scales and directions.
    """
    def __new__(
        cls,
        image: SfmImage,
        descriptors: ArrayLike,
        keypoints: Keypoints,
    ) -> PhotoFeatures: ...
    @property
    def image(self) -> SfmImage:
        """Keypoints and their colors, `SfmImage`."""
    @property
    def descriptors(self) -> NDArray[Any]:
        """Descriptors, float32 of shape (N, D), or uint8 of shape (N, 32) for bits."""
    @property
    def keypoints(self) -> Keypoints:
        """Keypoints with scales and directions."""
    def __eq__(self, other: object, /) -> bool: ...
    def __len__(self) -> int: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class Reconstruction:
    """Cameras and points that share one frame.

    Its scale and pose are arbitrary, unless positions of images are known: see `is_placed`.

    Parameters
    ----------
    cameras : list of PosedCamera or None
        Camera of each image, None if it could not be registered.
    points : array_like, shape (P, 3)
        Points in the world.
    tracks : array_like of int, shape (K, 3)
        Observations: index of the point, of the image, and of its keypoint.
    colors : array_like of uint8, shape (P, 3), optional
        Red, green, blue. Gray if not given.
    errors_px : array_like, shape (P,), optional
        Root mean square of the reprojection errors of each point, pixels. 0 if not given.
    is_placed : bool, optional
        Whether it stands where the known positions of its images are, in their unit of length.

    Raises
    ------
    ValueError
        Track of a point that does not exist.
    """
    def __new__(
        cls,
        cameras: Sequence[PosedCamera | None],
        points: ArrayLike,
        tracks: ArrayLike,
        colors: ArrayLike | None = None,
        errors_px: ArrayLike | None = None,
        is_placed: bool = False,
    ) -> Reconstruction: ...
    @property
    def cameras(self) -> list[PosedCamera | None]:
        """Camera of each image, a list of `PosedCamera`, None if it could not be registered."""
    @property
    def points(self) -> NDArray[np.float64]:
        """Points in the world, shape (P, 3)."""
    @property
    def tracks(self) -> NDArray[np.int64]:
        """Observations: index of the point, of the image, and of its keypoint, int64 of shape (K, 3)."""
    @property
    def colors(self) -> NDArray[np.uint8]:
        """Mean color of the keypoints of each point, uint8 of shape (P, 3)."""
    @property
    def errors_px(self) -> NDArray[np.float64]:
        """Root mean square of the reprojection errors of each point, pixels, shape (P,)."""
    @property
    def is_placed(self) -> bool:
        """Whether it stands where the known positions of its images are, in their unit of length."""
    def __eq__(self, other: object, /) -> bool: ...
    def num_registered(self) -> int:
        """Number of images with a camera."""
    def num_observations(self) -> int:
        """Number of observations of all points."""
    def moved(self, to_from_world: Similarity3) -> Reconstruction:
        """The same in another world, moved by ``to_from_world``.

        Parameters
        ----------
        to_from_world : Similarity3
        """
    def project(self, image: int, point: ArrayLike) -> NDArray[np.float64] | None:
        """Pixel of a point in an image.

        Parameters
        ----------
        image : int
            Index of the image.
        point : array_like, shape (3,)

        Returns
        -------
        ndarray or None, shape (2,)
            None if the camera does not see it.
        """
    def mean_reprojection_px(self, images: Sequence[SfmImage]) -> float:
        """Mean length of all reprojection errors, pixels.

        Parameters
        ----------
        images : list of SfmImage
            Images of the input.

        Raises
        ------
        IndexError
            Track of a keypoint that ``images`` do not have.
        """
    def to_bundle(self, images: Sequence[SfmImage]) -> tuple[Bundle, NDArray[np.int64]]:
        """The same for bundle adjustment.

        Parameters
        ----------
        images : list of SfmImage

        Returns
        -------
        bundle : Bundle
        image_of_camera : ndarray of int64
            Index of the image of each camera.

        Raises
        ------
        IndexError
            Track of a keypoint that ``images`` do not have.
        """
    def localize(
        self,
        features: Sequence[PhotoFeatures],
        photo: PhotoFeatures,
        camera: Camera,
        *,
        progress: Callable[[str, float], object] | None = None,
        **options: Unpack[option_types.LocalizeOptions],
    ) -> Localization:
        """Pose of another photo.

        Parameters
        ----------
        features : list of PhotoFeatures
            Those of the images of the reconstruction.
        photo : PhotoFeatures
        camera : Camera
            Camera of the photo.
        progress : callable, optional
            Called with the stage and the completed share.
        **options : LocalizeOptions
            ``matching`` and ``ransac``, dicts; ``min_num_inliers``.

        Returns
        -------
        Localization

        Raises
        ------
        epipole.TooFewError
            Fewer than ``min_num_inliers`` points that match or agree with a pose.
        epipole.DegenerateError
            Numbers in one list of descriptors and bits in another.
        epipole.NoConsensusError
            No pose with 3 inliers.
        ValueError
            Track of a keypoint that does not exist, or an option out of range.
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class Localization:
    """Photo localized in a reconstruction.

    Parameters
    ----------
    cam_from_world
        Pose of its camera.
    inliers
        Points that agree with the pose: index of the point and of the photo's keypoint, int64
        of shape (M, 2).
    num_matches
        Number of matches between keypoints of the photo and points.
    """
    def __new__(
        cls,
        cam_from_world: RigidTransform,
        inliers: NDArray[np.int64],
        num_matches: int,
    ) -> Localization: ...
    @property
    def cam_from_world(self) -> RigidTransform:
        """Pose of its camera."""
    @property
    def inliers(self) -> NDArray[np.int64]:
        """Points that agree with the pose: index of the point and of the photo's keypoint, int64
        of shape (M, 2).
        """
    @property
    def num_matches(self) -> int:
        """Number of matches between keypoints of the photo and points."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class SfmStep:
    """One step of structure from motion or of odometry.

    Parameters
    ----------
    kind : {"started", "registered", "adjusted"}
    images : list of int
        Two images that started a component, the registered one, or none.
    num_registered : int, optional
        Number of registered images of the component.
    num_points : int, optional
        Number of points of the component.
    cost : float, optional
        Cost of the refinement, square pixels.

    Raises
    ------
    ValueError
        Unknown ``kind``, or arguments that do not fit it.
    """
    def __new__(
        cls,
        kind: str,
        images: Sequence[int],
        num_registered: int | None = None,
        num_points: int | None = None,
        cost: float | None = None,
    ) -> SfmStep: ...
    @property
    def kind(self) -> str:
        """"started", "registered" or "adjusted"."""
    @property
    def images(self) -> list[int]:
        """Two images that started a component, the registered one, or none."""
    @property
    def num_registered(self) -> int | None:
        """Number of registered images of the component."""
    @property
    def num_points(self) -> int | None:
        """Number of points of the component."""
    @property
    def cost(self) -> float | None:
        """Half the sum of the losses after the refinement, square pixels; None if it failed."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class SfmResult:
    """Result of structure from motion.

    Parameters
    ----------
    components : list of Reconstruction
    unregistered : list of int
    steps : list of SfmStep
    is_complete : bool
    """
    def __new__(
        cls,
        components: Sequence[Reconstruction],
        unregistered: Sequence[int],
        steps: Sequence[SfmStep],
        is_complete: bool,
    ) -> SfmResult: ...
    @property
    def components(self) -> list[Reconstruction]:
        """Reconstructions that could not be connected, largest first, each in its own frame."""
    @property
    def unregistered(self) -> list[int]:
        """Images that are in none."""
    @property
    def steps(self) -> list[SfmStep]:
        """Steps taken, in order."""
    @property
    def is_complete(self) -> bool:
        """Whether every image was tried."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class IncrementalReconstruction:
    """`reconstruct`, step by step.

    Parameters
    ----------
    input : SfmInput
    progress : callable, optional
        Called with the stage and the completed share while pairs are tested.
    **options : SfmOptions
        Those of `reconstruct`.

    Raises
    ------
    epipole.TooFewError
        Fewer than 2 images.
    epipole.DegenerateError
        Images of one lens number whose cameras have different lenses.
    ValueError
        Option out of range, or a match of an image or keypoint that does not exist.
    """
    def __new__(
        cls,
        input: SfmInput,
        *,
        progress: Callable[[str, float], object] | None = None,
        **options: Unpack[option_types.SfmOptions],
    ) -> IncrementalReconstruction: ...
    def step(self, *, progress: Callable[[str, float], object] | None = None) -> SfmStep | None:
        """Takes the next step and returns it; None after the last.

        After an interruption the next call continues from there.

        Parameters
        ----------
        progress : callable, optional
            Called with the stage and the completed share.

        Raises
        ------
        RuntimeError
            Work that is finished, or that another thread uses.
        """
    def current(self) -> Reconstruction | None:
        """Component that grows now, a `Reconstruction`; None between two components.

        Raises
        ------
        RuntimeError
            Work that is finished, or that another thread uses.
        """
    def finish(self) -> SfmResult:
        """All components, including the current one. Ends the work.

        Raises
        ------
        RuntimeError
            Work that is finished, or that another thread uses.
        """

@final
class WhyUnregistered:
    """Why an image is in no reconstruction.

    Parameters
    ----------
    kind
        "few_features", "few_matches", "no_motion", "no_baseline", "no_start", "few_points",
        "no_pose" or "not_tried".
    message
        Reason as a sentence.
    """
    def __new__(cls, kind: str, message: str) -> WhyUnregistered: ...
    @property
    def kind(self) -> str:
        """"few_features", "few_matches", "no_motion", "no_baseline", "no_start", "few_points",
        "no_pose" or "not_tried".
        """
    @property
    def message(self) -> str:
        """Reason as a sentence."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class OdometryResult:
    """Path of a camera.

    Parameters
    ----------
    world_from_cam : list of RigidTransform or None
    keyframes, lost : list of int
    reconstruction : Reconstruction
    is_complete : bool
    """
    def __new__(
        cls,
        world_from_cam: Sequence[RigidTransform | None],
        keyframes: Sequence[int],
        lost: Sequence[int],
        reconstruction: Reconstruction,
        is_complete: bool,
    ) -> OdometryResult: ...
    @property
    def world_from_cam(self) -> list[RigidTransform | None]:
        """``world_from_cam`` of each frame, None if it was lost. The first frame found is the origin."""
    @property
    def keyframes(self) -> list[int]:
        """Frames that gave points."""
    @property
    def lost(self) -> list[int]:
        """Frames that could not be placed."""
    @property
    def reconstruction(self) -> Reconstruction:
        """Cameras and points; of a stereo rig the left cameras, then the right ones."""
    @property
    def is_complete(self) -> bool:
        """Whether every frame was tried."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class Odometry:
    """`monocular_odometry` or `stereo_odometry`, step by step."""
    @staticmethod
    def monocular(
        input: SfmInput,
        *,
        progress: Callable[[str, float], object] | None = None,
        **options: Unpack[option_types.OdometryOptions],
    ) -> Odometry:
        """Start with a single camera.

        Parameters
        ----------
        input : SfmInput
        progress : callable, optional
            Called with the stage and the completed share.
        **options : OdometryOptions
            Those of `monocular_odometry`.

        Raises
        ------
        epipole.TooFewError
            Fewer than 2 images.
        epipole.DegenerateError
            No two images with enough points under a sufficient angle, or images of one lens number
            whose cameras have different lenses.
        ValueError
            Option out of range, or a match of an image or keypoint that does not exist.
        """
    @staticmethod
    def stereo(
        left: SfmInput,
        right: Sequence[SfmImage],
        left_right: Sequence[Matches] | ArrayLike,
        right_from_left: RigidTransform,
        right_camera: Camera,
        *,
        progress: Callable[[str, float], object] | None = None,
        **options: Unpack[option_types.OdometryOptions],
    ) -> Odometry:
        """Start with a stereo rig; see `stereo_odometry`.

        Parameters
        ----------
        left : SfmInput
        right : list of SfmImage
        left_right : list of epipole.feature.Matches or array_like of int, shape (M, 2)
        right_from_left : RigidTransform
        right_camera : Camera
        progress : callable, optional
            Called with the stage and the completed share.
        **options : OdometryOptions
            Those of `monocular_odometry`.

        Raises
        ------
        epipole.TooFewError
            Fewer than 2 images.
        epipole.DegenerateError
            Rig without a baseline, too few matches in the first frame, or images of one lens number
            whose cameras have different lenses.
        ValueError
            Option out of range, or a match of an image or keypoint that does not exist.
        """
    def step(self, *, progress: Callable[[str, float], object] | None = None) -> SfmStep | None:
        """Takes the next step and returns an `SfmStep`; None after the last.

        After an interruption the next call continues from there.

        Parameters
        ----------
        progress : callable, optional
            Called with the stage and the completed share.

        Raises
        ------
        RuntimeError
            Work that is finished, or that another thread uses.
        """
    def finish(self) -> OdometryResult:
        """Path so far, an `OdometryResult`. Ends the work.

        Raises
        ------
        RuntimeError
            Work that is finished, or that another thread uses.
        """

@final
class PoseGraph:
    """Poses, joined by measured relative poses.

    A pose is a row of an array: (x, y, angle) in the plane; (x, y, z, qw, qx, qy, qz) in space; the
    same with a scale behind it for similarities.

    Parameters
    ----------
    kind : {"se2", "se3", "sim3"}
    vertices : array_like, shape (V, 3), (V, 7) or (V, 8)
        ``world_from_vertex`` of each vertex.
    edges : array_like of int, shape (E, 2)
        Indices of the vertices where each edge starts and ends.
    measurements : array_like, shape (E, 3), (E, 7) or (E, 8)
        Pose of the end in the frame of the start.
    information : array_like, shape (E, D, D), optional
        Inverse covariances of translation, rotation, log scale: D is 3, 6 or 7. Identities if not
        given.
    fixed : array_like of int, optional
        Vertices that stay. In a connected part without one, its first vertex stays.
    ids : array_like of int, shape (V,), optional
        Number of each vertex in a file.
    landmarks : array_like of int, optional
        Vertices that are points, which have no rotation: edges to them have an information of 0
        for it.
    prior_vertices : array_like of int, shape (P,), optional
        Vertices whose poses are measured, such as by a GPS receiver.
    priors : array_like, shape (P, 3), (P, 7) or (P, 8), optional
        ``world_from_vertex`` as measured.
    prior_information : array_like, shape (P, D, D), optional
        Inverse covariances of these. Identities if not given.

    Raises
    ------
    ValueError
        Unknown ``kind``, an index of no vertex, a quaternion whose length is not 1, or a scale not
        above 0.
    """
    def __new__(
        cls,
        kind: str,
        vertices: ArrayLike,
        edges: ArrayLike,
        measurements: ArrayLike,
        information: ArrayLike | None = None,
        fixed: ArrayLike | None = None,
        ids: ArrayLike | None = None,
        landmarks: ArrayLike | None = None,
        prior_vertices: ArrayLike | None = None,
        priors: ArrayLike | None = None,
        prior_information: ArrayLike | None = None,
    ) -> PoseGraph: ...
    @property
    def kind(self) -> str:
        """"se2", "se3" or "sim3"."""
    @property
    def vertices(self) -> NDArray[np.float64]:
        """``world_from_vertex`` of each vertex, shape (V, 3), (V, 7) or (V, 8)."""
    @property
    def edges(self) -> NDArray[np.int64]:
        """Vertices where each edge starts and ends, int64 of shape (E, 2)."""
    @property
    def measurements(self) -> NDArray[np.float64]:
        """Pose of the end in the frame of the start of each edge, shape (E, 3), (E, 7) or (E, 8)."""
    @property
    def information(self) -> NDArray[np.float64]:
        """Inverse covariances of the measurements, shape (E, D, D)."""
    @property
    def prior_vertices(self) -> NDArray[np.int64]:
        """Vertices whose poses are measured, int64 of shape (P,)."""
    @property
    def priors(self) -> NDArray[np.float64]:
        """Measured ``world_from_vertex`` of these, shape (P, 3), (P, 7) or (P, 8)."""
    @property
    def prior_information(self) -> NDArray[np.float64]:
        """Inverse covariances of these measurements, shape (P, D, D)."""
    @property
    def fixed(self) -> NDArray[np.int64]:
        """Vertices that stay, int64 array."""
    @property
    def landmarks(self) -> NDArray[np.int64]:
        """Vertices that are points, whose rotation is none, int64 array."""
    @property
    def ids(self) -> NDArray[np.int64]:
        """Number of each vertex in a file, int64 of shape (V,)."""
    def __eq__(self, other: object, /) -> bool: ...
    def chi2(self) -> float:
        """Sum of the squared errors, weighted by their information."""
    def size(self) -> tuple[int, int]:
        """Number of vertices and of edges."""
    def initialize(
        self,
        *,
        progress: Callable[[str, float], object] | None = None,
    ) -> PoseGraph:
        """Graph with vertices computed from the measurements alone.

        Parameters
        ----------
        progress : callable, optional
            Called with the stage and the completed share.

        Returns
        -------
        PoseGraph

        Raises
        ------
        epipole.TooFewError
            No edges and no priors.
        epipole.DegenerateError
            Vertex that hangs on measurements without weight.
        ValueError
            Edge from a vertex to itself, or an information matrix that is asymmetric or has a
            negative eigenvalue.
        """
    def optimize(
        self,
        *,
        loss: str | Mapping[str, Any] | None = None,
        progress: Callable[[str, float], object] | None = None,
        **options: Unpack[option_types.LmOptions],
    ) -> tuple[PoseGraph, PoseGraphReport]:
        """Graph with the least sum of squared errors.

        Parameters
        ----------
        loss : str or dict, optional
            ``"trivial"``, or ``{"huber": {"width": 1.0}}``, ``"cauchy"``, ``"truncated"`` likewise.
        progress : callable, optional
            Called with the stage and the completed share.
        **options : LmOptions
            ``max_iterations``, ``gradient_tolerance``, ``step_tolerance``, ``cost_tolerance``,
            ``initial_damping``, ``patience``.

        Returns
        -------
        graph : PoseGraph
        report : PoseGraphReport

        Raises
        ------
        epipole.TooFewError
            No edges and no priors.
        ValueError
            Edge from a vertex to itself, an information matrix that is asymmetric or has a negative
            eigenvalue, or a loss width not above 0.
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class PoseGraphReport:
    """Report of the optimization of a pose graph.

    Parameters
    ----------
    initial_chi2
        Sum of the weighted squared errors at the start.
    final_chi2
        Sum of the weighted squared errors at the end.
    iterations
        Steps tried.
    termination
        Why the loop ended, as in `epipole.optim.LmReport`.
    num_components
        Number of connected parts.
    """
    def __new__(
        cls,
        initial_chi2: float,
        final_chi2: float,
        iterations: int,
        termination: str,
        num_components: int,
    ) -> PoseGraphReport: ...
    @property
    def initial_chi2(self) -> float:
        """Sum of the weighted squared errors at the start."""
    @property
    def final_chi2(self) -> float:
        """Sum of the weighted squared errors at the end."""
    @property
    def iterations(self) -> int:
        """Steps tried."""
    @property
    def termination(self) -> str:
        """Why the loop ended, as in `epipole.optim.LmReport`."""
    @property
    def num_components(self) -> int:
        """Number of connected parts."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class LoopClosure:
    """Frame that shows part of an earlier one.

    Parameters
    ----------
    from_index, to_index : int
        Indices of the earlier and of the later frame.
    from_from_to : Similarity3
        Later camera in the frame of the earlier one, with the ratio of their scales.
    weight : float, optional
        Weight relative to one step of odometry.
    """
    def __new__(
        cls,
        from_index: int,
        to_index: int,
        from_from_to: Similarity3,
        weight: float = 1.0,
    ) -> LoopClosure: ...
    @property
    def from_index(self) -> int:
        """Index of the earlier frame."""
    @property
    def to_index(self) -> int:
        """Index of the later frame."""
    @property
    def from_from_to(self) -> Similarity3:
        """Later camera in the frame of the earlier one."""
    @property
    def weight(self) -> float:
        """Weight relative to one step of odometry."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class ClosedPath:
    """Path after its loops were closed.

    Parameters
    ----------
    world_from_cam
        ``world_from_cam`` of each frame, a list of `RigidTransform`.
    scale
        Factor of lengths around each frame, shape (N,).
    report
        `PoseGraphReport` of the optimization.
    """
    def __new__(
        cls,
        world_from_cam: Sequence[RigidTransform],
        scale: NDArray[np.float64],
        report: PoseGraphReport,
    ) -> ClosedPath: ...
    @property
    def world_from_cam(self) -> list[RigidTransform]:
        """``world_from_cam`` of each frame, a list of `RigidTransform`."""
    @property
    def scale(self) -> NDArray[np.float64]:
        """Factor of lengths around each frame, shape (N,)."""
    @property
    def report(self) -> PoseGraphReport:
        """`PoseGraphReport` of the optimization."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class VerifiedPair:
    """Pair of images that passed the test of epipolar geometry.

    Parameters
    ----------
    pair
        Matches that passed.
    cam2_from_cam1
        Motion of the camera, ``|t| == 1``.
    median_angle_rad
        Median angle between the two rays of a match, radians: small for pure rotations and far
        scenes; 0 if a plane and a pure rotation explain the matches.
    is_flat
        Whether a homography explains most matches: a flat scene, or a pure rotation.
    """
    def __new__(
        cls,
        pair: PairMatches,
        cam2_from_cam1: RigidTransform,
        median_angle_rad: float,
        is_flat: bool,
    ) -> VerifiedPair: ...
    @property
    def pair(self) -> PairMatches:
        """Matches that passed."""
    @property
    def cam2_from_cam1(self) -> RigidTransform:
        """Motion of the camera, ``|t| == 1``."""
    @property
    def median_angle_rad(self) -> float:
        """Median angle between the two rays of a match, radians: small for pure rotations and far
        scenes; 0 if a plane and a pure rotation explain the matches.
        """
    @property
    def is_flat(self) -> bool:
        """Whether a homography explains most matches: a flat scene, or a pure rotation."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class TwoViewReconstruction:
    """Two cameras and their points, in the frame of camera 1; the cameras have distance 1.

    Parameters
    ----------
    cam2_from_cam1
        Refined motion, ``|t| == 1``.
    points
        Points, shape (P, 3).
    triangulated
        The same points as first triangulated, shape (P, 3).
    match_of_point
        Index of the match of each point, increasing, int64 of shape (P,).
    num_in_front
        Number of matches in front of both cameras by each of the four motions of E, most first.
    rms_before_px
        Root mean square of the reprojection errors as first triangulated, pixels.
    rms_px
        Root mean square after the refinement, pixels.
    report
        `epipole.optim.LmReport` of the last refinement.
    """
    def __new__(
        cls,
        cam2_from_cam1: RigidTransform,
        points: NDArray[np.float64],
        triangulated: NDArray[np.float64],
        match_of_point: NDArray[np.int64],
        num_in_front: Sequence[int],
        rms_before_px: float,
        rms_px: float,
        report: LmReport,
    ) -> TwoViewReconstruction: ...
    @property
    def cam2_from_cam1(self) -> RigidTransform:
        """Refined motion, ``|t| == 1``."""
    @property
    def points(self) -> NDArray[np.float64]:
        """Points, shape (P, 3)."""
    @property
    def triangulated(self) -> NDArray[np.float64]:
        """The same points as first triangulated, shape (P, 3)."""
    @property
    def match_of_point(self) -> NDArray[np.int64]:
        """Index of the match of each point, increasing, int64 of shape (P,)."""
    @property
    def num_in_front(self) -> list[int]:
        """Number of matches in front of both cameras by each of the four motions of E, most first."""
    @property
    def rms_before_px(self) -> float:
        """Root mean square of the reprojection errors as first triangulated, pixels."""
    @property
    def rms_px(self) -> float:
        """Root mean square after the refinement, pixels."""
    @property
    def report(self) -> LmReport:
        """`epipole.optim.LmReport` of the last refinement."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

def align_points(
    from_points: ArrayLike,
    to_points: ArrayLike,
    kind: Literal["similarity", "rigid"] | None = None,
) -> Similarity3:
    """Transform ``T`` with the least ``sum(|T @ from - to|**2)``, in closed form (Umeyama).

    Parameters
    ----------
    from_points, to_points : array_like, shape (N, 3)
        Matched points, N >= 3, not on a line.
    kind : {"similarity", "rigid"}, optional
        With or without a scale.

    Returns
    -------
    Similarity3

    Raises
    ------
    epipole.TooFewError
        Fewer than 3 points.
    epipole.DegenerateError
        Points of either set equal or on one line.

    Examples
    --------
    >>> round(align_points(np.eye(3), 2 * np.eye(3)).scale, 6)
    2.0
    """
def absolute_trajectory_error(
    estimated: ArrayLike,
    truth: ArrayLike,
    kind: Literal["similarity", "rigid"] | None = None,
) -> tuple[ErrorStatistics, Similarity3]:
    """Absolute trajectory error: distances between camera centers after the best alignment.

    Parameters
    ----------
    estimated, truth : array_like, shape (N, 3)
        Centers of the same cameras, in the same order.
    kind : {"similarity", "rigid"}, optional
        Alignment with or without a scale.

    Returns
    -------
    errors : ErrorStatistics
        In the unit of `truth`.
    truth_from_estimated : Similarity3

    Raises
    ------
    epipole.TooFewError
        Fewer than 3 points.
    epipole.DegenerateError
        Points of either set equal or on one line.
    """
def relative_pose_error(
    estimated: Sequence[RigidTransform],
    truth: Sequence[RigidTransform],
    step: int = 1,
) -> RelativePoseError:
    """Relative pose error: difference of the motions over some frames.

    Parameters
    ----------
    estimated, truth : list of RigidTransform
        ``world_from_cam`` of the same frames, in order.
    step : int, optional
        Number of frames between the two ends of a motion, >= 1.

    Returns
    -------
    RelativePoseError

    Raises
    ------
    epipole.TooFewError
        No more poses than ``step``.
    ValueError
        ``step`` of 0.
    """
def adjust_bundle(
    bundle: Bundle,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.BundleOptions],
) -> tuple[Bundle, LmReport]:
    """Refines cameras and points, and their lenses if asked, by the reprojection errors.

    Parameters
    ----------
    bundle : Bundle
        It is not changed.
    progress : callable, optional
        Called with the stage and the completed share.
    **options : BundleOptions
        ``loss``, of pixels; ``refine_focal``, ``refine_principal_point``, ``refine_distortion``,
        ``refine_tangential``; ``gauge``, ``"two_cameras"`` or ``"free"``; ``held_cameras`` and
        ``held_points``, lists of bool; ``position_priors``, a list of `PositionPrior` or None;
        ``position_loss``; ``lm``, a dict such as ``{"max_iterations": 50}``.

    Returns
    -------
    bundle : Bundle
    report : epipole.optim.LmReport

    Raises
    ------
    epipole.TooFewError
        No observations.
    epipole.DegenerateError
        Cameras of one lens number with different lenses.
    ValueError
        Observation of a camera, point or sensor that does not exist, a lens number out of range,
        loss width or standard deviation not above 0, or no finite cost at the start.
    """
def adjust_bal(
    problem: BalProblem,
    *,
    loss: str | Mapping[str, Any] | None = None,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.LmOptions],
) -> tuple[BalProblem, LmReport]:
    """Refines all cameras and points of a BAL problem.

    Parameters
    ----------
    problem : BalProblem
        It is not changed.
    loss : str or dict, optional
        ``"trivial"``, or ``{"huber": {"width": 1.0}}``, ``"cauchy"``, ``"truncated"`` likewise.
    progress : callable, optional
        Called with the stage and the completed share.
    **options : LmOptions
        ``max_iterations``, ``gradient_tolerance``, ``step_tolerance``, ``cost_tolerance``,
        ``initial_damping``, ``patience``.

    Returns
    -------
    problem : BalProblem
    report : epipole.optim.LmReport

    Raises
    ------
    epipole.TooFewError
        No observations.
    ValueError
        Observation of a camera or point that does not exist, loss width not above 0, or no finite
        cost at the start.
    """
def reconstruct(
    input: SfmInput,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.SfmOptions],
) -> SfmResult:
    """Cameras and points from matches between images.

    Parameters
    ----------
    input : SfmInput
    progress : callable, optional
        Called with the stage and the completed share.
    **options : SfmOptions
        ``ransac``, a dict; ``max_registration_error_px``, ``max_reprojection_error_px``,
        ``min_num_inliers``, ``min_angle_deg``, ``min_start_angle_deg``, ``min_track_length``,
        ``refine_focal``, ``refine_principal_point``, ``refine_distortion``,
        ``refine_tangential``, ``seed``.

    Returns
    -------
    SfmResult
        Without components if no pair has enough matches.

    Raises
    ------
    epipole.TooFewError
        Fewer than 2 images.
    epipole.DegenerateError
        Images of one lens number whose cameras have different lenses.
    ValueError
        Option out of range, or a match of an image or keypoint that does not exist.
    """
def why_unregistered(
    input: SfmInput,
    result: SfmResult,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.SfmOptions],
) -> list[WhyUnregistered]:
    """Reasons why images are in no reconstruction.

    Parameters
    ----------
    input : SfmInput
    result : SfmResult
        Result of `reconstruct`.
    progress : callable, optional
        Called with the stage and the completed share.
    **options : SfmOptions
        Those given to `reconstruct`.

    Returns
    -------
    list of WhyUnregistered
        One for each image of ``result.unregistered``.

    Raises
    ------
    epipole.TooFewError
        Fewer than 2 images.
    epipole.DegenerateError
        Images of one lens number whose cameras have different lenses.
    ValueError
        Option out of range, a match of an image or keypoint that does not exist, or ``result`` of
        other images.
    """
def triangulate_tracks(
    input: SfmInput,
    cam_from_world: Sequence[RigidTransform | None],
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.SfmOptions],
) -> Reconstruction:
    """Points from matches between images whose poses are known; cameras stay as they are.

    Parameters
    ----------
    input : SfmInput
    cam_from_world : list of RigidTransform or None
        Pose of each image; one without takes no part.
    progress : callable, optional
        Called with the stage and the completed share.
    **options : SfmOptions
        Those of `reconstruct`: ``max_reprojection_error_px``, ``min_angle_deg``,
        ``min_track_length``.

    Returns
    -------
    Reconstruction
        Points in the world of the poses; few or none if the poses are not those of the images.

    Raises
    ------
    epipole.TooFewError
        Fewer than 2 images or poses.
    epipole.DegenerateError
        Images of one lens number whose cameras have different lenses.
    ValueError
        Option out of range, or a match of an image or keypoint that does not exist.
    """
def photo_features(
    photo: Photo,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.PhotoOptions],
) -> PhotoFeatures:
    """Keypoints and descriptors of a photo.

    Parameters
    ----------
    photo : Photo
    progress : callable, optional
        Called with the stage and the completed share.
    **options : PhotoOptions
        ``features``, a dict of the options of `epipole.feature.detect_features`.

    Returns
    -------
    PhotoFeatures

    Raises
    ------
    ValueError
        Option out of range.
    """
def match_features(
    features: Sequence[PhotoFeatures],
    /,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.PhotoOptions],
) -> list[PairMatches]:
    """Matches between all pairs of photos, or between those that are near in order.

    Parameters
    ----------
    features : list of PhotoFeatures
    progress : callable, optional
        Called with the stage and the completed share.
    **options : PhotoOptions
        ``matching``, a dict such as ``{"max_ratio": 0.8}``; ``neighbors``, the number of following
        photos to match each with, 0 for all; ``best_first``.

    Returns
    -------
    list of PairMatches

    Raises
    ------
    epipole.DegenerateError
        Numbers in one list of descriptors and bits in another.
    ValueError
        Option out of range.
    """
def match_photos(
    photos: Sequence[Photo],
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.PhotoOptions],
) -> tuple[list[SfmImage], list[PairMatches]]:
    """Keypoints of all photos and matches between all pairs of them.

    Parameters
    ----------
    photos : list of Photo
    progress : callable, optional
        Called with the stage and the completed share.
    **options : PhotoOptions
        Those of `photo_features` and `match_features`.

    Returns
    -------
    images : list of SfmImage
    pairs : list of PairMatches

    Raises
    ------
    epipole.TooFewError
        Fewer than 2 photos.
    ValueError
        Option out of range.
    """
def match_rectified(
    left: PhotoFeatures,
    right: PhotoFeatures,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.PhotoOptions],
) -> Matches:
    """Matches between the two images of a rectified stereo pair.

    Parameters
    ----------
    left, right : PhotoFeatures
    progress : callable, optional
        Called with the stage and the completed share.
    **options : PhotoOptions
        Those of `match_features`.

    Returns
    -------
    epipole.feature.Matches

    Raises
    ------
    epipole.DegenerateError
        Numbers in one list of descriptors and bits in the other.
    ValueError
        Option out of range.
    """
def reconstruct_photos(
    photos: Sequence[Photo],
    cameras: Sequence[Camera],
    *,
    photo_options: Mapping[str, Any] | None = None,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.SfmOptions],
) -> tuple[SfmInput, SfmResult]:
    """Cameras and points from photos: features, matches, and `reconstruct`.

    Parameters
    ----------
    photos : list of Photo
    cameras : list of Camera
        Camera of each photo, or one for all.
    photo_options : dict, optional
        Options of `match_photos`.
    progress : callable, optional
        Called with the stage and the completed share.
    **options : SfmOptions
        Those of `reconstruct`.

    Returns
    -------
    input : SfmInput
        Keypoints and matches.
    result : SfmResult

    Raises
    ------
    epipole.TooFewError
        Fewer than 2 photos.
    epipole.DegenerateError
        Photos of one lens number whose cameras have different lenses.
    ValueError
        Option out of range.
    """
def monocular_odometry(
    input: SfmInput,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.OdometryOptions],
) -> OdometryResult:
    """Path of a single camera, up to scale.

    Parameters
    ----------
    input : SfmInput
        Frames in order of time, and matches between frames that are near in time.
    progress : callable, optional
        Called with the stage and the completed share.
    **options : OdometryOptions
        ``sfm``, a dict of the options of `reconstruct`; ``window``, the number of keyframes that
        are refined together; ``final_adjustment``.

    Returns
    -------
    OdometryResult

    Raises
    ------
    epipole.TooFewError
        Fewer than 2 images.
    epipole.DegenerateError
        No two images with enough points under a sufficient angle, or images of one lens number
        whose cameras have different lenses.
    ValueError
        Option out of range, or a match of an image or keypoint that does not exist.
    """
def stereo_odometry(
    left: SfmInput,
    right: Sequence[SfmImage],
    left_right: Sequence[Matches] | ArrayLike,
    right_from_left: RigidTransform,
    right_camera: Camera,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.OdometryOptions],
) -> OdometryResult:
    """Path of a stereo rig, in the unit of its baseline.

    Parameters
    ----------
    left : SfmInput
        Frames of the left camera in order of time, and matches between them.
    right : list of SfmImage
        The same frames of the right camera.
    left_right : list of epipole.feature.Matches or array_like of int, shape (M, 2)
        Matches between the two images of each frame, left first.
    right_from_left : RigidTransform
    right_camera : Camera
    progress : callable, optional
        Called with the stage and the completed share.
    **options : OdometryOptions
        Those of `monocular_odometry`.

    Returns
    -------
    OdometryResult

    Raises
    ------
    epipole.TooFewError
        Fewer than 2 images.
    epipole.DegenerateError
        Rig without a baseline, too few matches in the first frame, or images of one lens number
        whose cameras have different lenses.
    ValueError
        Option out of range, or a match of an image or keypoint that does not exist.
    """
def close_loops(
    world_from_cam: Sequence[RigidTransform],
    loops: Sequence[LoopClosure],
    motion: Literal["similarity", "rigid"] | None = None,
    *,
    loss: str | Mapping[str, Any] | None = None,
    progress: Callable[[str, float], object] | None = None,
) -> ClosedPath:
    """Spreads the error of closed loops over a path.

    Parameters
    ----------
    world_from_cam : list of RigidTransform
        Path, frame after frame. The first frame stays.
    loops : list of LoopClosure
    motion : {"similarity", "rigid"}, optional
        With or without a scale of each frame.
    loss : str or dict, optional
        Of standard deviations of a step: ``"trivial"``, or ``{"huber": {"width": 1.0}}``,
        ``"cauchy"``, ``"truncated"`` likewise.
    progress : callable, optional
        Called with the stage and the completed share.

    Returns
    -------
    ClosedPath

    Raises
    ------
    epipole.TooFewError
        Fewer than 2 poses, or no loops.
    ValueError
        Loop of a frame that does not exist or with itself, or a weight or loss width not above 0.
    """
def estimate_similarity_of_points(
    from_points: ArrayLike,
    to_points: ArrayLike,
    max_distance: float,
    seed: int = 0,
) -> tuple[Similarity3, NDArray[np.bool_]]:
    """Similarity between two reconstructions of the same points, some of which are wrong.

    Parameters
    ----------
    from_points, to_points : array_like, shape (N, 3)
    max_distance : float
        Threshold of inliers, in the unit of `to_points`.
    seed : int, optional

    Returns
    -------
    to_from_from : Similarity3
    inliers : ndarray of bool, shape (N,)

    Raises
    ------
    epipole.TooFewError
        Fewer than 3 finite points.
    epipole.NoConsensusError
        Fewer than 4 points that agree.
    ValueError
        ``max_distance`` not above 0.
    """
def average_rotations(
    count: int,
    pairs: ArrayLike,
    to_from_from: ArrayLike,
    *,
    loss: str | Mapping[str, Any] | None = None,
    progress: Callable[[str, float], object] | None = None,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Rotations of views that agree best with those measured between pairs of them.

    Parameters
    ----------
    count : int
        Number of views.
    pairs : array_like of int, shape (M, 2)
        Indices of the two views of each measurement.
    to_from_from : array_like, shape (M, 3, 3)
        Rotation from the frame of the first view to that of the second.
    loss : str or dict, optional
        Of radians: ``"trivial"``, or ``{"huber": {"width": 0.05}}``, ``"cauchy"``,
        ``"truncated"`` likewise.
    progress : callable, optional
        Called with the stage and the completed share.

    Returns
    -------
    view_from_world : ndarray, shape (count, 3, 3)
        The first view of each connected part has the identity.
    errors_rad : ndarray, shape (M,)
        Error of each measurement, radians.

    Raises
    ------
    epipole.TooFewError
        No measurements.
    ValueError
        Index of no view, a view joined with itself, a matrix that is no rotation, or a loss width
        not above 0.
    """
def build_tracks(
    num_keypoints: Sequence[int],
    pairs: Sequence[PairMatches],
) -> NDArray[np.int64]:
    """Joins matches into tracks.

    Parameters
    ----------
    num_keypoints : list of int
        Number of keypoints of each image.
    pairs : list of PairMatches
        Matches that passed a geometric test. Those of pairs with many matches are trusted first.

    Returns
    -------
    ndarray of int64, shape (K, 3)
        Index of the track, of the image, and of its keypoint, sorted. A track has at most one
        keypoint of an image.

    Raises
    ------
    ValueError
        Match of an image or keypoint that does not exist, or of an image with itself.
    """
def verify_matches(
    pair: PairMatches,
    images: Sequence[SfmImage],
    cameras: Sequence[Camera],
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.SfmOptions],
) -> VerifiedPair | None:
    """Matches of two images that agree with one motion of the camera.

    Parameters
    ----------
    pair : PairMatches
    images : tuple of SfmImage
        The two images.
    cameras : tuple of Camera
        Their cameras.
    progress : callable, optional
        Called with the stage and the completed share.
    **options : SfmOptions
        Those of `reconstruct`: ``ransac``, a dict, ``min_num_inliers``, ``seed``.

    Returns
    -------
    VerifiedPair or None
        None if too few agree.

    Raises
    ------
    ValueError
        Match of a keypoint that does not exist.
    """
def two_view_reconstruction(
    pixels1: ArrayLike,
    pixels2: ArrayLike,
    camera1: Camera,
    camera2: Camera,
    cam2_from_cam1: RigidTransform,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.TwoViewReconstructionOptions],
) -> TwoViewReconstruction:
    """Points of the matches of two views, refined together with the motion.

    Parameters
    ----------
    pixels1, pixels2 : array_like, shape (N, 2)
        Matches without outliers.
    camera1, camera2 : Camera
    cam2_from_cam1 : RigidTransform
        Motion to start from; the length of its translation does not matter.
    progress : callable, optional
        Called with the stage and the completed share.
    **options : TwoViewReconstructionOptions
        ``min_angle_rad``, ``max_error_px``, ``min_num_points``; ``bundle``, a dict of the options
        of `adjust_bundle`.

    Returns
    -------
    TwoViewReconstruction

    Raises
    ------
    epipole.TooFewError
        Fewer than ``min_num_points`` points left.
    epipole.DegenerateError
        Motion without translation.
    ValueError
        ``min_angle_rad`` below 0, ``max_error_px`` not above 0, or an option of ``bundle`` out of
        range.
    """
