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
        Rotation and translation. The identity by default.
    scale : float, optional
        Greater than 0.

    Raises
    ------
    ValueError
        If ``scale`` is not above 0.
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
        """Returns the homogeneous matrix, shape (4, 4)."""
    def inverse(self) -> Similarity3:
        """Returns the inverse transform: ``b_from_a``."""
    @overload
    def __matmul__(self, other: Similarity3, /) -> Similarity3:
        """Composes two similarities, or transforms points.

        Parameters
        ----------
        other : Similarity3 or array_like, shape (3,) or (N, 3)

        Returns
        -------
        Similarity3 or ndarray of the same shape
        """
    @overload
    def __matmul__(self, other: ArrayLike, /) -> NDArray[np.float64]:
        """Composes two similarities, or transforms points.

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
        Median; the lower of the middle two for an even number.
    max
        Maximum.
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
        """Median; the lower of the middle two for an even number."""
    @property
    def max(self) -> float:
        """Maximum."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class RelativePoseError:
    """Errors of the motions between frames.

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
    """Additional camera rigidly mounted on each camera of a bundle, such as the right one of a rig.

    Parameters
    ----------
    sensor_from_camera : RigidTransform
        Transform from the camera frame to the sensor frame; not refined.
    camera : Camera
        Image size, intrinsics and lens of the sensor.
    lens : int
        Lens number, as in `Bundle.lens_of_camera`.
    """
    def __new__(
        cls,
        sensor_from_camera: RigidTransform,
        camera: Camera,
        lens: int = 0,
    ) -> Sensor: ...
    @property
    def sensor_from_camera(self) -> RigidTransform:
        """Transform from the camera frame to the sensor frame."""
    @property
    def camera(self) -> Camera:
        """Image size, intrinsics and lens."""
    @property
    def lens(self) -> int:
        """Lens number."""
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
        Lens number of each camera; 0 by default. Cameras with the same number have equal lenses and
        share their refined parameters.
    sensors : list of Sensor, optional
        Additional cameras mounted on each camera.
    sensor_of_observation : array_like of int, optional
        For each observation, 0 if the camera itself made it, k if sensor k - 1 did; 0 by default.
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
        """Lens number of each camera, int64 array."""
    @property
    def sensors(self) -> list[Sensor]:
        """Additional cameras mounted on each camera, a list of `Sensor`."""
    @property
    def sensor_of_observation(self) -> NDArray[np.int64]:
        """Sensor of each observation, int64 array; 0 for the camera itself."""
    def __eq__(self, other: object, /) -> bool: ...
    def residual_px(self, observation: int) -> NDArray[np.float64]:
        """Returns the reprojection error of an observation, predicted minus observed, shape (2,).

        Parameters
        ----------
        observation : int
            Index of the observation.

        Raises
        ------
        IndexError
            If the observation does not exist, or its camera or point does not.
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class BalProblem:
    """Bundle adjustment problem of the BAL data set.

    Parameters
    ----------
    cameras : array_like, shape (C, 9)
        Rotation as axis times angle (radians), translation, focal length (pixels), k1, k2. The
        camera looks along -z; pixels have their origin at the image center, with v up.
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
        """Computes half the sum of the losses, square pixels.

        Parameters
        ----------
        loss : str or dict, optional
            As in `adjust_bal`.

        Raises
        ------
        ValueError
            If the loss width is not above 0.
        IndexError
            If an observation refers to a missing camera or point.
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class PositionPrior:
    """Prior of a camera position, such as from GPS.

    Parameters
    ----------
    center_in_world : array_like, shape (3,)
        Center of the camera.
    sigma : array_like, shape (3,)
        Standard deviation along each world axis, in world units, > 0.
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
        Name, such as the file name.
    keypoints : array_like, shape (N, 2)
        Pixels.
    colors : array_like of uint8, shape (N, 3), optional
        Red, green, blue.
    lens : int, optional
        Lens number. Images with the same number have equal lenses and share their refined
        parameters.
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
        """Lens number."""
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
        Matches between images, including outliers.
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
        Lens number, as in `SfmImage`.
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
        """Lens number."""
    @property
    def position(self) -> PositionPrior | None:
        """Position of the camera, or None."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class PhotoFeatures:
    """Features of a photo, without its pixels.

    Parameters
    ----------
    image : SfmImage
        Size, keypoints and their colors.
    descriptors : array_like, shape (N, D) or uint8 of shape (N, 32)
        Floating-point numbers, or 256 bits.
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
        """Descriptors, float32 of shape (N, D), or uint8 of shape (N, 32) for binary ones."""
    @property
    def keypoints(self) -> Keypoints:
        """Keypoints with scales and directions."""
    def __eq__(self, other: object, /) -> bool: ...
    def __len__(self) -> int: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class Reconstruction:
    """Cameras and points in one frame.

    Scale and pose of the frame are arbitrary unless image positions are known: see `is_placed`.

    Parameters
    ----------
    cameras : list of PosedCamera or None
        Camera of each image; None if it could not be registered.
    points : array_like, shape (P, 3)
        Points in the world.
    tracks : array_like of int, shape (K, 3)
        Observations: indices of the point, of the image, and of the image's keypoint.
    colors : array_like of uint8, shape (P, 3), optional
        Red, green, blue. Gray by default.
    errors_px : array_like, shape (P,), optional
        Root mean square of the reprojection errors of each point, pixels. 0 by default.
    is_placed : bool, optional
        Whether the frame agrees with the known image positions, in their unit of length.

    Raises
    ------
    ValueError
        If a track refers to a missing point.
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
        """Camera of each image, a list of `PosedCamera`; None if it could not be registered."""
    @property
    def points(self) -> NDArray[np.float64]:
        """Points in the world, shape (P, 3)."""
    @property
    def tracks(self) -> NDArray[np.int64]:
        """Observations, int64 of shape (K, 3): indices of the point, the image and its keypoint."""
    @property
    def colors(self) -> NDArray[np.uint8]:
        """Mean color of the keypoints of each point, uint8 of shape (P, 3)."""
    @property
    def errors_px(self) -> NDArray[np.float64]:
        """Root mean square of the reprojection errors of each point, pixels, shape (P,)."""
    @property
    def is_placed(self) -> bool:
        """Whether the frame agrees with the known image positions, in their unit of length."""
    def __eq__(self, other: object, /) -> bool: ...
    def num_registered(self) -> int:
        """Returns the number of images with a camera."""
    def num_observations(self) -> int:
        """Returns the number of observations of all points."""
    def moved(self, to_from_world: Similarity3) -> Reconstruction:
        """Returns the reconstruction in another world, transformed by ``to_from_world``.

        Parameters
        ----------
        to_from_world : Similarity3
        """
    def project(self, image: int, point: ArrayLike) -> NDArray[np.float64] | None:
        """Projects a point into an image.

        Parameters
        ----------
        image : int
            Index of the image.
        point : array_like, shape (3,)

        Returns
        -------
        ndarray or None, shape (2,)
            None if the camera does not see the point.
        """
    def mean_reprojection_px(self, images: Sequence[SfmImage]) -> float:
        """Computes the mean length of all reprojection errors, pixels.

        Parameters
        ----------
        images : list of SfmImage
            Images of the input.

        Raises
        ------
        IndexError
            If a track refers to a keypoint that is missing in ``images``.
        """
    def to_bundle(self, images: Sequence[SfmImage]) -> tuple[Bundle, NDArray[np.int64]]:
        """Converts the reconstruction for bundle adjustment.

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
            If a track refers to a keypoint that is missing in ``images``.
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
        """Estimates the pose of another photo.

        Parameters
        ----------
        features : list of PhotoFeatures
            Features of the images of the reconstruction.
        photo : PhotoFeatures
        camera : Camera
            Camera of the photo.
        progress : callable, optional
            Called with the stage and the completed fraction.
        **options : LocalizeOptions
            ``matching`` and ``ransac``, dicts; ``min_num_inliers``.

        Returns
        -------
        Localization

        Raises
        ------
        epipole.TooFewError
            If fewer than ``min_num_inliers`` points match or agree with a pose.
        epipole.DegenerateError
            If some lists of descriptors are float and others binary.
        epipole.NoConsensusError
            If no pose has 3 inliers.
        ValueError
            If a track refers to a missing keypoint, or an option is out of range.
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class Localization:
    """Photo localized in a reconstruction.

    Parameters
    ----------
    cam_from_world
        Pose of the camera.
    inliers
        Points that agree with the pose: indices of the point and of the photo's keypoint, int64
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
        """Pose of the camera."""
    @property
    def inliers(self) -> NDArray[np.int64]:
        """Points that agree with the pose: indices of the point and of the photo's keypoint, int64
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
        The two images that started a component, the registered one, or none.
    num_registered : int, optional
        Number of registered images in the component.
    num_points : int, optional
        Number of points in the component.
    cost : float, optional
        Cost after the refinement, square pixels.

    Raises
    ------
    ValueError
        If ``kind`` is unknown, or the arguments do not fit it.
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
        """The two images that started a component, the registered one, or none."""
    @property
    def num_registered(self) -> int | None:
        """Number of registered images in the component."""
    @property
    def num_points(self) -> int | None:
        """Number of points in the component."""
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
        """Images in no component."""
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
    """Step-by-step `reconstruct`.

    Parameters
    ----------
    input : SfmInput
    progress : callable, optional
        Called with the stage and the completed fraction while pairs are verified.
    **options : SfmOptions
        See `reconstruct`.

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 2 images.
    epipole.DegenerateError
        If images with the same lens number have cameras with different lenses.
    ValueError
        If an option is out of range, or a match refers to a missing image or keypoint.
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

        After an interruption, the next call resumes.

        Parameters
        ----------
        progress : callable, optional
            Called with the stage and the completed fraction.

        Raises
        ------
        RuntimeError
            If the job is finished, or another thread uses it.
        """
    def current(self) -> Reconstruction | None:
        """Returns the component that currently grows, a `Reconstruction`; None between components.

        Raises
        ------
        RuntimeError
            If the job is finished, or another thread uses it.
        """
    def finish(self) -> SfmResult:
        """Ends the job and returns all components, including the current one.

        Raises
        ------
        RuntimeError
            If the job is finished, or another thread uses it.
        """

@final
class WhyUnregistered:
    """Reason an image is in no reconstruction.

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
        """Frames that provide points."""
    @property
    def lost(self) -> list[int]:
        """Frames that could not be registered."""
    @property
    def reconstruction(self) -> Reconstruction:
        """Cameras and points; for a stereo rig, the left cameras followed by the right ones."""
    @property
    def is_complete(self) -> bool:
        """Whether every frame was tried."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class Odometry:
    """Step-by-step `monocular_odometry` or `stereo_odometry`."""
    @staticmethod
    def monocular(
        input: SfmInput,
        *,
        progress: Callable[[str, float], object] | None = None,
        **options: Unpack[option_types.OdometryOptions],
    ) -> Odometry:
        """Starts with a single camera; see `monocular_odometry`.

        Parameters
        ----------
        input : SfmInput
        progress : callable, optional
            Called with the stage and the completed fraction.
        **options : OdometryOptions
            See `monocular_odometry`.

        Raises
        ------
        epipole.TooFewError
            If there are fewer than 2 images.
        epipole.DegenerateError
            If no two images have enough points at a sufficient angle, or images with the same lens
            number have cameras with different lenses.
        ValueError
            If an option is out of range, or a match refers to a missing image or keypoint.
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
        """Starts with a stereo rig; see `stereo_odometry`.

        Parameters
        ----------
        left : SfmInput
        right : list of SfmImage
        left_right : list of epipole.feature.Matches or array_like of int, shape (M, 2)
        right_from_left : RigidTransform
        right_camera : Camera
        progress : callable, optional
            Called with the stage and the completed fraction.
        **options : OdometryOptions
            See `monocular_odometry`.

        Raises
        ------
        epipole.TooFewError
            If there are fewer than 2 images.
        epipole.DegenerateError
            If the rig has no baseline, the first frame has too few matches, or images with the same
            lens number have cameras with different lenses.
        ValueError
            If an option is out of range, or a match refers to a missing image or keypoint.
        """
    def step(self, *, progress: Callable[[str, float], object] | None = None) -> SfmStep | None:
        """Takes the next step and returns an `SfmStep`; None after the last.

        After an interruption, the next call resumes.

        Parameters
        ----------
        progress : callable, optional
            Called with the stage and the completed fraction.

        Raises
        ------
        RuntimeError
            If the job is finished, or another thread uses it.
        """
    def finish(self) -> OdometryResult:
        """Ends the job and returns the path so far, an `OdometryResult`.

        Raises
        ------
        RuntimeError
            If the job is finished, or another thread uses it.
        """

@final
class PoseGraph:
    """Poses joined by measured relative poses.

    A pose is a row of an array: (x, y, angle) in the plane, (x, y, z, qw, qx, qy, qz) in space, and
    the same followed by a scale for similarities.

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
        Inverse covariances of translation, rotation, log scale: D is 3, 6 or 7. Identities by
        default.
    fixed : array_like of int, optional
        Vertices held fixed. In a connected part without one, the first vertex is held.
    ids : array_like of int, shape (V,), optional
        Number of each vertex in a file.
    landmarks : array_like of int, optional
        Vertices that are points without rotation: edges to them have an information of 0 for the
        rotation.
    prior_vertices : array_like of int, shape (P,), optional
        Vertices whose poses are measured, for example by a GPS receiver.
    priors : array_like, shape (P, 3), (P, 7) or (P, 8), optional
        Measured ``world_from_vertex``.
    prior_information : array_like, shape (P, D, D), optional
        Inverse covariances of the priors. Identities by default.

    Raises
    ------
    ValueError
        If ``kind`` is unknown, a vertex index is out of range, the length of a quaternion is not 1,
        or a scale is not above 0.
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
        """Measured ``world_from_vertex`` of these vertices, shape (P, 3), (P, 7) or (P, 8)."""
    @property
    def prior_information(self) -> NDArray[np.float64]:
        """Inverse covariances of these measurements, shape (P, D, D)."""
    @property
    def fixed(self) -> NDArray[np.int64]:
        """Vertices held fixed, int64 array."""
    @property
    def landmarks(self) -> NDArray[np.int64]:
        """Vertices that are points without rotation, int64 array."""
    @property
    def ids(self) -> NDArray[np.int64]:
        """Number of each vertex in a file, int64 of shape (V,)."""
    def __eq__(self, other: object, /) -> bool: ...
    def chi2(self) -> float:
        """Returns the sum of the squared errors, weighted by their information."""
    def size(self) -> tuple[int, int]:
        """Returns the numbers of vertices and edges."""
    def initialize(
        self,
        *,
        progress: Callable[[str, float], object] | None = None,
    ) -> PoseGraph:
        """Returns a graph with vertices computed from the measurements alone.

        Parameters
        ----------
        progress : callable, optional
            Called with the stage and the completed fraction.

        Returns
        -------
        PoseGraph

        Raises
        ------
        epipole.TooFewError
            If there are no edges and no priors.
        epipole.DegenerateError
            If a vertex depends on measurements without weight.
        ValueError
            If an edge joins a vertex with itself, or an information matrix is asymmetric or has a
            negative eigenvalue.
        """
    def optimize(
        self,
        *,
        loss: str | Mapping[str, Any] | None = None,
        progress: Callable[[str, float], object] | None = None,
        **options: Unpack[option_types.LmOptions],
    ) -> tuple[PoseGraph, PoseGraphReport]:
        """Returns the graph with the smallest sum of squared errors.

        Parameters
        ----------
        loss : str or dict, optional
            ``"trivial"`` or ``{"huber": {"width": 1.0}}``; ``"cauchy"`` and ``"truncated"``
            likewise.
        progress : callable, optional
            Called with the stage and the completed fraction.
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
            If there are no edges and no priors.
        ValueError
            If an edge joins a vertex with itself, an information matrix is asymmetric or has a
            negative eigenvalue, or a loss width is not above 0.
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class PoseGraphReport:
    """Report of the optimization of a pose graph.

    Parameters
    ----------
    initial_chi2
        Initial sum of the weighted squared errors.
    final_chi2
        Final sum of the weighted squared errors.
    iterations
        Number of steps tried.
    termination
        Reason the loop ended, as in `epipole.optim.LmReport`.
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
        """Initial sum of the weighted squared errors."""
    @property
    def final_chi2(self) -> float:
        """Final sum of the weighted squared errors."""
    @property
    def iterations(self) -> int:
        """Number of steps tried."""
    @property
    def termination(self) -> str:
        """Reason the loop ended, as in `epipole.optim.LmReport`."""
    @property
    def num_components(self) -> int:
        """Number of connected parts."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class LoopClosure:
    """Motion between two frames that show the same scene.

    Parameters
    ----------
    from_index, to_index : int
        Indices of the earlier and the later frame.
    from_from_to : Similarity3
        Pose of the later camera in the frame of the earlier one, with the ratio of their scales.
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
        """Pose of the later camera in the frame of the earlier one."""
    @property
    def weight(self) -> float:
        """Weight relative to one step of odometry."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class ClosedPath:
    """Path after loop closing.

    Parameters
    ----------
    world_from_cam
        ``world_from_cam`` of each frame, a list of `RigidTransform`.
    scale
        Scale factor of each frame, shape (N,).
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
        """Scale factor of each frame, shape (N,)."""
    @property
    def report(self) -> PoseGraphReport:
        """`PoseGraphReport` of the optimization."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class VerifiedPair:
    """Geometrically verified pair of images.

    Parameters
    ----------
    pair
        Verified matches.
    cam2_from_cam1
        Motion of the camera, with ``|t| == 1``.
    median_angle_rad
        Median triangulation angle of the matches, radians: small for pure rotations and distant
        scenes; 0 if a plane and a pure rotation explain the matches.
    is_flat
        Whether a homography explains most matches: a flat scene or a pure rotation.
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
        """Verified matches."""
    @property
    def cam2_from_cam1(self) -> RigidTransform:
        """Motion of the camera, with ``|t| == 1``."""
    @property
    def median_angle_rad(self) -> float:
        """Median triangulation angle of the matches, radians: small for pure rotations and distant
        scenes; 0 if a plane and a pure rotation explain the matches.
        """
    @property
    def is_flat(self) -> bool:
        """Whether a homography explains most matches: a flat scene or a pure rotation."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class TwoViewReconstruction:
    """Two cameras at distance 1 and their points, in the frame of camera 1.

    Parameters
    ----------
    cam2_from_cam1
        Refined motion, with ``|t| == 1``.
    points
        Points, shape (P, 3).
    triangulated
        The same points before refinement, shape (P, 3).
    match_of_point
        Index of the match of each point, increasing, int64 of shape (P,).
    num_in_front
        Number of matches in front of both cameras for each motion of E, in descending order.
    rms_before_px
        Root mean square of the reprojection errors before refinement, pixels.
    rms_px
        Root mean square of the reprojection errors after refinement, pixels.
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
        """Refined motion, with ``|t| == 1``."""
    @property
    def points(self) -> NDArray[np.float64]:
        """Points, shape (P, 3)."""
    @property
    def triangulated(self) -> NDArray[np.float64]:
        """The same points before refinement, shape (P, 3)."""
    @property
    def match_of_point(self) -> NDArray[np.int64]:
        """Index of the match of each point, increasing, int64 of shape (P,)."""
    @property
    def num_in_front(self) -> list[int]:
        """Number of matches in front of both cameras for each motion of E, in descending order."""
    @property
    def rms_before_px(self) -> float:
        """Root mean square of the reprojection errors before refinement, pixels."""
    @property
    def rms_px(self) -> float:
        """Root mean square of the reprojection errors after refinement, pixels."""
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
    """Aligns points: finds the ``T`` that minimizes ``sum(|T @ from - to|**2)`` (Umeyama).

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
        If there are fewer than 3 points.
    epipole.DegenerateError
        If the points of either set are equal or on a line.

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
    """Computes the absolute trajectory error: distances of camera centers after alignment.

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
        If there are fewer than 3 points.
    epipole.DegenerateError
        If the points of either set are equal or on a line.
    """
def relative_pose_error(
    estimated: Sequence[RigidTransform],
    truth: Sequence[RigidTransform],
    step: int = 1,
) -> RelativePoseError:
    """Computes the relative pose error: differences of the motions over a number of frames.

    Parameters
    ----------
    estimated, truth : list of RigidTransform
        ``world_from_cam`` of the same frames, in order.
    step : int, optional
        Number of frames from the start to the end of a motion, >= 1.

    Returns
    -------
    RelativePoseError

    Raises
    ------
    epipole.TooFewError
        If there are no more poses than ``step``.
    ValueError
        If ``step`` is 0.
    """
def adjust_bundle(
    bundle: Bundle,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.BundleOptions],
) -> tuple[Bundle, LmReport]:
    """Refines cameras, points and, optionally, lenses by minimizing the reprojection errors.

    Parameters
    ----------
    bundle : Bundle
        Not changed.
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : BundleOptions
        ``loss``, its width in pixels; ``refine_focal``, ``refine_principal_point``,
        ``refine_distortion``, ``refine_tangential``; ``gauge``, ``"two_cameras"`` or ``"free"``;
        ``held_cameras`` and ``held_points``, lists of bool; ``position_priors``, a list of
        `PositionPrior` or None; ``position_loss``; ``lm``, a dict such as ``{"max_iterations":
        50}``.

    Returns
    -------
    bundle : Bundle
    report : epipole.optim.LmReport

    Raises
    ------
    epipole.TooFewError
        If there are no observations.
    epipole.DegenerateError
        If cameras with the same lens number have different lenses.
    ValueError
        If an observation refers to a missing camera, point or sensor, a lens number is out of
        range, the loss width or a standard deviation is not above 0, or the initial cost is not
        finite.
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
        Not changed.
    loss : str or dict, optional
        ``"trivial"``, or ``{"huber": {"width": 1.0}}``; ``"cauchy"`` and ``"truncated"`` likewise.
    progress : callable, optional
        Called with the stage and the completed fraction.
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
        If there are no observations.
    ValueError
        If an observation refers to a missing camera or point, the loss width is not above 0, or the
        initial cost is not finite.
    """
def reconstruct(
    input: SfmInput,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.SfmOptions],
) -> SfmResult:
    """Reconstructs cameras and points from matches between images.

    Parameters
    ----------
    input : SfmInput
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : SfmOptions
        ``ransac``, a dict; ``max_registration_error_px``, ``max_reprojection_error_px``,
        ``min_num_inliers``, ``min_angle_deg``, ``min_start_angle_deg``, ``min_track_length``,
        ``refine_focal``, ``refine_principal_point``, ``refine_distortion``,
        ``refine_tangential``, ``seed``.

    Returns
    -------
    SfmResult
        No components if no pair has enough matches.

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 2 images.
    epipole.DegenerateError
        If images with the same lens number have cameras with different lenses.
    ValueError
        If an option is out of range, or a match refers to a missing image or keypoint.
    """
def why_unregistered(
    input: SfmInput,
    result: SfmResult,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.SfmOptions],
) -> list[WhyUnregistered]:
    """Returns the reasons why images are in no reconstruction.

    Parameters
    ----------
    input : SfmInput
    result : SfmResult
        Result of `reconstruct`.
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : SfmOptions
        Options given to `reconstruct`.

    Returns
    -------
    list of WhyUnregistered
        One for each image of ``result.unregistered``.

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 2 images.
    epipole.DegenerateError
        If images with the same lens number have cameras with different lenses.
    ValueError
        If an option is out of range, a match refers to a missing image or keypoint, or ``result``
        belongs to other images.
    """
def triangulate_tracks(
    input: SfmInput,
    cam_from_world: Sequence[RigidTransform | None],
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.SfmOptions],
) -> Reconstruction:
    """Triangulates points from matches between images with known poses; cameras do not change.

    Parameters
    ----------
    input : SfmInput
    cam_from_world : list of RigidTransform or None
        Pose of each image; images without a pose are ignored.
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : SfmOptions
        See `reconstruct`; used are ``max_reprojection_error_px``, ``min_angle_deg``,
        ``min_track_length``.

    Returns
    -------
    Reconstruction
        Points in the world frame of the poses; few or none if the poses do not match the images.

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 2 images or poses.
    epipole.DegenerateError
        If images with the same lens number have cameras with different lenses.
    ValueError
        If an option is out of range, or a match refers to a missing image or keypoint.
    """
def photo_features(
    photo: Photo,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.PhotoOptions],
) -> PhotoFeatures:
    """Detects keypoints and descriptors of a photo.

    Parameters
    ----------
    photo : Photo
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : PhotoOptions
        ``features``, a dict of the options of `epipole.feature.detect_features`.

    Returns
    -------
    PhotoFeatures

    Raises
    ------
    ValueError
        If an option is out of range.
    """
def match_features(
    features: Sequence[PhotoFeatures],
    /,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.PhotoOptions],
) -> list[PairMatches]:
    """Matches pairs of photos: of some dozens all, of more similar ones or those close in order.

    Parameters
    ----------
    features : list of PhotoFeatures
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : PhotoOptions
        ``matching``, a dict such as ``{"max_ratio": 0.8}``; ``neighbors``, the number of following
        photos to match with each photo; ``similar``, the number of photos that look most like it,
        by default 40 if ``neighbors`` is 0, else 0 (all pairs if both are 0); ``best_first``.

    Returns
    -------
    list of PairMatches

    Raises
    ------
    epipole.DegenerateError
        If some lists of descriptors are float and others binary.
    ValueError
        If an option is out of range.
    """
def match_photos(
    photos: Sequence[Photo],
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.PhotoOptions],
) -> tuple[list[SfmImage], list[PairMatches]]:
    """Detects keypoints in all photos and matches them between all pairs.

    Parameters
    ----------
    photos : list of Photo
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : PhotoOptions
        See `photo_features` and `match_features`.

    Returns
    -------
    images : list of SfmImage
    pairs : list of PairMatches

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 2 photos.
    ValueError
        If an option is out of range.
    """
def match_rectified(
    left: PhotoFeatures,
    right: PhotoFeatures,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.PhotoOptions],
) -> Matches:
    """Matches the two images of a rectified stereo pair.

    Parameters
    ----------
    left, right : PhotoFeatures
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : PhotoOptions
        See `match_features`.

    Returns
    -------
    epipole.feature.Matches

    Raises
    ------
    epipole.DegenerateError
        If one list of descriptors is float and the other binary.
    ValueError
        If an option is out of range.
    """
def reconstruct_photos(
    photos: Sequence[Photo],
    cameras: Sequence[Camera],
    *,
    photo_options: Mapping[str, Any] | None = None,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.SfmOptions],
) -> tuple[SfmInput, SfmResult]:
    """Reconstructs cameras and points from photos: features, matches, and `reconstruct`.

    Parameters
    ----------
    photos : list of Photo
    cameras : list of Camera
        Camera of each photo, or one for all.
    photo_options : dict, optional
        Options of `match_photos`.
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : SfmOptions
        See `reconstruct`.

    Returns
    -------
    input : SfmInput
        Keypoints and matches.
    result : SfmResult

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 2 photos.
    epipole.DegenerateError
        If photos with the same lens number have cameras with different lenses.
    ValueError
        If an option is out of range.
    """
def monocular_odometry(
    input: SfmInput,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.OdometryOptions],
) -> OdometryResult:
    """Estimates the path of a single camera, up to scale.

    Parameters
    ----------
    input : SfmInput
        Frames in order of time, and matches between frames close in time.
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : OdometryOptions
        ``sfm``, a dict of the options of `reconstruct`; ``window``, the number of keyframes refined
        together; ``final_adjustment``.

    Returns
    -------
    OdometryResult

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 2 images.
    epipole.DegenerateError
        If no two images have enough points at a sufficient angle, or images with the same lens
        number have cameras with different lenses.
    ValueError
        If an option is out of range, or a match refers to a missing image or keypoint.
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
    """Estimates the path of a stereo rig, in the unit of its baseline.

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
        Called with the stage and the completed fraction.
    **options : OdometryOptions
        See `monocular_odometry`.

    Returns
    -------
    OdometryResult

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 2 images.
    epipole.DegenerateError
        If the rig has no baseline, the first frame has too few matches, or images with the same
        lens number have cameras with different lenses.
    ValueError
        If an option is out of range, or a match refers to a missing image or keypoint.
    """
def close_loops(
    world_from_cam: Sequence[RigidTransform],
    loops: Sequence[LoopClosure],
    motion: Literal["similarity", "rigid"] | None = None,
    *,
    loss: str | Mapping[str, Any] | None = None,
    progress: Callable[[str, float], object] | None = None,
) -> ClosedPath:
    """Distributes the error of closed loops over a path.

    Parameters
    ----------
    world_from_cam : list of RigidTransform
        Path, frame by frame. The first frame is held fixed.
    loops : list of LoopClosure
    motion : {"similarity", "rigid"}, optional
        With or without a scale of each frame.
    loss : str or dict, optional
        Its width is in standard deviations of a step: ``"trivial"``, or ``{"huber": {"width":
        1.0}}``; ``"cauchy"`` and ``"truncated"`` likewise.
    progress : callable, optional
        Called with the stage and the completed fraction.

    Returns
    -------
    ClosedPath

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 2 poses, or no loops.
    ValueError
        If a loop refers to a missing frame or joins a frame with itself, or a weight or loss width
        is not above 0.
    """
def estimate_similarity_of_points(
    from_points: ArrayLike,
    to_points: ArrayLike,
    max_distance: float,
    seed: int = 0,
) -> tuple[Similarity3, NDArray[np.bool_]]:
    """Estimates the similarity between two reconstructions from point pairs with outliers.

    Parameters
    ----------
    from_points, to_points : array_like, shape (N, 3)
    max_distance : float
        Inlier threshold, in the unit of `to_points`.
    seed : int, optional

    Returns
    -------
    to_from_from : Similarity3
    inliers : ndarray of bool, shape (N,)

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 3 finite points.
    epipole.NoConsensusError
        If fewer than 4 points agree.
    ValueError
        If ``max_distance`` is not above 0.
    """
def average_rotations(
    count: int,
    pairs: ArrayLike,
    to_from_from: ArrayLike,
    *,
    loss: str | Mapping[str, Any] | None = None,
    progress: Callable[[str, float], object] | None = None,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Computes the rotations of views that best fit measured rotations between pairs.

    Parameters
    ----------
    count : int
        Number of views.
    pairs : array_like of int, shape (M, 2)
        Indices of the two views of each measurement.
    to_from_from : array_like, shape (M, 3, 3)
        Rotation from the frame of the first view to the frame of the second.
    loss : str or dict, optional
        Its width is in radians: ``"trivial"``, or ``{"huber": {"width": 0.05}}``; ``"cauchy"`` and
        ``"truncated"`` likewise.
    progress : callable, optional
        Called with the stage and the completed fraction.

    Returns
    -------
    view_from_world : ndarray, shape (count, 3, 3)
        The first view of each connected part has the identity.
    errors_rad : ndarray, shape (M,)
        Error of each measurement, radians.

    Raises
    ------
    epipole.TooFewError
        If there are no measurements.
    ValueError
        If an index is out of range, a view is joined with itself, a matrix is not a rotation, or a
        loss width is not above 0.
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
        Geometrically verified matches. Pairs with many matches take precedence.

    Returns
    -------
    ndarray of int64, shape (K, 3)
        Indices of the track, the image and its keypoint, sorted. A track has at most one keypoint
        per image.

    Raises
    ------
    ValueError
        If a match refers to a missing image or keypoint, or joins an image with itself.
    """
def verify_matches(
    pair: PairMatches,
    images: Sequence[SfmImage],
    cameras: Sequence[Camera],
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.SfmOptions],
) -> VerifiedPair | None:
    """Selects the matches of two images that agree with one motion of the camera.

    Parameters
    ----------
    pair : PairMatches
    images : tuple of SfmImage
        The two images.
    cameras : tuple of Camera
        Cameras of the two images.
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : SfmOptions
        See `reconstruct`; used are ``ransac``, a dict, ``min_num_inliers``, ``seed``.

    Returns
    -------
    VerifiedPair or None
        None if too few matches agree.

    Raises
    ------
    ValueError
        If a match refers to a missing keypoint.
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
    """Triangulates the matches of two views and refines points and motion together.

    Parameters
    ----------
    pixels1, pixels2 : array_like, shape (N, 2)
        Matches without outliers.
    camera1, camera2 : Camera
    cam2_from_cam1 : RigidTransform
        Initial motion; the length of its translation does not matter.
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : TwoViewReconstructionOptions
        ``min_angle_rad``, ``max_error_px``, ``min_num_points``; ``bundle``, a dict of the options
        of `adjust_bundle`.

    Returns
    -------
    TwoViewReconstruction

    Raises
    ------
    epipole.TooFewError
        If fewer than ``min_num_points`` points are left.
    epipole.DegenerateError
        If the motion has no translation.
    ValueError
        If ``min_angle_rad`` is below 0, ``max_error_px`` is not above 0, or an option of ``bundle``
        is out of range.
    """
