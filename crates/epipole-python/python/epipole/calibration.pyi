# Written by stubs.py. Do not edit.

from collections.abc import Callable, Mapping, Sequence
from typing import Any, ClassVar, Literal, final

import numpy as np
from numpy.typing import ArrayLike, NDArray
from typing_extensions import Unpack

from epipole import options as option_types
from epipole.camera import Camera
from epipole.camera import Intrinsics
from epipole.camera import RigidTransform
from epipole.stereo import PixelMap
from epipole.stereo import PixelRect

__all__ = [
    "Board",
    "BoardDrawing",
    "BoardSearch",
    "BoardView",
    "CalibratedView",
    "Calibration",
    "CalibrationWarning",
    "Marker",
    "MarkerDictionary",
    "RigCalibration",
    "Undistortion",
    "calibrate",
    "calibrate_rig",
    "detect_markers",
    "find_board",
    "intrinsics_from_planes",
    "render_board",
]

@final
class Board:
    """Flat board with marks at known positions: x along its columns, y along its rows, z = 0.

    Parameters
    ----------
    pattern : str or dict
        ``"chessboard"``, ``"circles"``, ``"asymmetric_circles"``,
        ``{"charuco": {"dictionary": "Aruco4x4_50", "marker_ratio": 0.75}}`` or
        ``{"april_grid": {"spacing": 0.3}}``.
    columns, rows : int
        Inner corners of a chessboard; squares of a ChArUco board; tags of an AprilGrid; disks per
        row and rows of disks in a circle grid.
    square_m : float
        Side of a square or tag, or distance between two rows of circles, meters.

    Raises
    ------
    ValueError
        If there are fewer than 3 or more than 1000 columns or rows (minimum: 2 columns for shifted
        circles, one tag for an AprilGrid), ``square_m`` is not above 0, a marker size is out of
        range, or the dictionary has too few markers.

    Examples
    --------
    >>> Board("chessboard", 9, 6, 0.03).num_marks
    54
    """
    def __new__(
        cls,
        pattern: str | Mapping[str, Any],
        columns: int,
        rows: int,
        square_m: float,
    ) -> Board: ...
    @property
    def pattern(self) -> str | dict[str, Any]:
        """Pattern, as in the constructor.

        Returns
        -------
        str or dict
        """
    @property
    def columns(self) -> int:
        """Columns, as in the constructor."""
    @property
    def rows(self) -> int:
        """Rows, as in the constructor."""
    @property
    def mark_columns(self) -> int:
        """Number of marks per row: inner corners of squares, corners of tags, or disks."""
    @property
    def mark_rows(self) -> int:
        """Number of rows of marks."""
    @property
    def square_m(self) -> float:
        """Side of a square or tag, or distance between two rows of circles, meters."""
    @property
    def num_marks(self) -> int:
        """Number of marks."""
    def mark(self, index: int) -> NDArray[np.float64]:
        """Returns the position of a mark on the board, meters, shape (2,). Marks are counted by row.

        Parameters
        ----------
        index : int
            Index of the mark, from 0.

        Raises
        ------
        IndexError
            If the board has no such mark.
        """
    def marks(self) -> NDArray[np.float64]:
        """Returns the positions of all marks on the board, meters, shape (N, 2)."""
    def drawing(self) -> BoardDrawing:
        """Returns the black shapes of the board.

        Returns
        -------
        BoardDrawing
        """
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class BoardDrawing:
    """Black shapes of a board, in squares; the first mark is at the origin, y points down.

    Parameters
    ----------
    rectangles
        Upper left and lower right corner of each rectangle, shape (N, 2, 2).
    disks
        Centers of disks, shape (M, 2).
    disk_radius
        Radius of the disks.
    """
    def __new__(
        cls,
        rectangles: NDArray[np.float64],
        disks: NDArray[np.float64],
        disk_radius: float,
    ) -> BoardDrawing: ...
    @property
    def rectangles(self) -> NDArray[np.float64]:
        """Upper left and lower right corner of each rectangle, shape (N, 2, 2)."""
    @property
    def disks(self) -> NDArray[np.float64]:
        """Centers of disks, shape (M, 2)."""
    @property
    def disk_radius(self) -> float:
        """Radius of the disks."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class BoardView:
    """Marks of a board in one photo.

    Parameters
    ----------
    pixels : array_like, shape (N, 2)
        Pixel of each mark of the board, row by row; NaN where not visible.
    """
    def __new__(cls, pixels: ArrayLike) -> BoardView: ...
    @property
    def pixels(self) -> NDArray[np.float64]:
        """Pixel of each mark of the board, shape (N, 2); NaN where not visible."""
    def __eq__(self, other: object, /) -> bool: ...
    def visible(self) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
        """Returns the visible marks with their pixels.

        Returns
        -------
        marks : ndarray of int64, shape (M,)
        pixels : ndarray, shape (M, 2)
        """
    def num_visible(self) -> int:
        """Returns the number of visible marks."""
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class BoardSearch:
    """Result of a search for a board.

    Parameters
    ----------
    kind
        "found"; "partial", a grid of another size; "markers", too few marks of the board; or
        "nothing".
    view
        Visible marks, if the board was found.
    columns
        Number of marks along the longer side of a partial board.
    rows
        Number of marks along the shorter side of a partial board.
    num_visible
        Number of visible marks of a partial board.
    num_of_board
        Number of markers that belong to the board.
    num_others
        Number of other markers of the dictionary.
    """
    def __new__(
        cls,
        kind: str,
        view: BoardView | None,
        columns: int | None,
        rows: int | None,
        num_visible: int | None,
        num_of_board: int | None,
        num_others: int | None,
    ) -> BoardSearch: ...
    @property
    def kind(self) -> str:
        """"found"; "partial", a grid of another size; "markers", too few marks of the board; or
        "nothing".
        """
    @property
    def view(self) -> BoardView | None:
        """Visible marks, if the board was found."""
    @property
    def columns(self) -> int | None:
        """Number of marks along the longer side of a partial board."""
    @property
    def rows(self) -> int | None:
        """Number of marks along the shorter side of a partial board."""
    @property
    def num_visible(self) -> int | None:
        """Number of visible marks of a partial board."""
    @property
    def num_of_board(self) -> int | None:
        """Number of markers that belong to the board."""
    @property
    def num_others(self) -> int | None:
        """Number of other markers of the dictionary."""
    def __eq__(self, other: object, /) -> bool: ...
    def problem(self, board: Board) -> str | None:
        """Returns the reason the board was not found, as a sentence; None if it was.

        Parameters
        ----------
        board : Board
            Board of the search.

        Raises
        ------
        ValueError
            If ``kind`` is unknown.
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class Marker:
    """Square marker in a photo.

    Parameters
    ----------
    id
        Number in the dictionary.
    corners
        Corners of the black border, pixels, shape (4, 2): clockwise from the upper left one of
        the upright marker.
    hamming
        Number of bits that differ from the dictionary.
    """
    def __new__(cls, id: int, corners: NDArray[np.float64], hamming: int) -> Marker: ...
    @property
    def id(self) -> int:
        """Number in the dictionary."""
    @property
    def corners(self) -> NDArray[np.float64]:
        """Corners of the black border, pixels, shape (4, 2): clockwise from the upper left one of
        the upright marker.
        """
    @property
    def hamming(self) -> int:
        """Number of bits that differ from the dictionary."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class MarkerDictionary:
    """Set of square markers, with OpenCV's names and numbers.

    Parameters
    ----------
    name : str
        For example ``"Aruco4x4_50"``, ``"4x4_50"``, ``"AprilTag36h11"`` or ``"36h11"``.
    """
    def __new__(cls, name: str) -> MarkerDictionary: ...
    @property
    def name(self) -> str:
        """Name as in OpenCV, without the prefix, such as "4x4_50"."""
    @property
    def num_markers(self) -> int:
        """Number of markers."""
    @property
    def num_bits(self) -> int:
        """Number of bits along a side, without the border."""
    @property
    def max_hamming(self) -> int:
        """Maximum number of wrong bits at which markers are accepted by default."""
    def __eq__(self, other: object, /) -> bool: ...
    @staticmethod
    def all() -> list[MarkerDictionary]:
        """Returns the dictionaries of all kinds."""
    def is_white(self, id: int, row: int, column: int) -> bool:
        """Returns whether a bit of an upright marker is white.

        Parameters
        ----------
        id : int
            Number of the marker.
        row, column : int
            From the upper left bit, without the border.

        Raises
        ------
        IndexError
            If the dictionary has no such marker or bit.
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class CalibratedView:
    """Calibration result of one view.

    Parameters
    ----------
    cam_from_board : RigidTransform
        Pose of the board, meters.
    rms_px : float
        Root mean square of the reprojection errors of the view, pixels.
    num_marks : int
        Number of visible marks.
    """
    def __new__(
        cls,
        cam_from_board: RigidTransform,
        rms_px: float,
        num_marks: int,
    ) -> CalibratedView: ...
    @property
    def cam_from_board(self) -> RigidTransform:
        """Pose of the board, meters."""
    @property
    def rms_px(self) -> float:
        """Root mean square of the reprojection errors of the view, pixels."""
    @property
    def num_marks(self) -> int:
        """Number of visible marks."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class CalibrationWarning:
    """Cause of uncertainty that the errors of a calibration do not reveal.

    Parameters
    ----------
    kind
        "parallel", "uncertain_focal", "low_coverage" or "bad_view".
    message
        Cause in words, as a sentence.
    """
    def __new__(cls, kind: str, message: str) -> CalibrationWarning: ...
    @property
    def kind(self) -> str:
        """"parallel", "uncertain_focal", "low_coverage" or "bad_view"."""
    @property
    def message(self) -> str:
        """Cause in words, as a sentence."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class Calibration:
    """Calibrated camera and its uncertainty.

    Parameters
    ----------
    camera
        Camera.
    rms_px
        Root mean square of all reprojection errors (distances), pixels.
    std_dev_k
        Standard deviation of fu, fv, cu, cv, pixels, shape (4,).
    std_dev_lens
        Standard deviation of each lens coefficient.
    coverage
        Fraction of the image area covered by marks of some view, 0 to 1.
    views
        `CalibratedView` of each given view, or None where none was given.
    warnings
        List of `CalibrationWarning`.
    """
    def __new__(
        cls,
        camera: Camera,
        rms_px: float,
        std_dev_k: NDArray[np.float64],
        std_dev_lens: NDArray[np.float64],
        coverage: float,
        views: Sequence[CalibratedView | None],
        warnings: Sequence[CalibrationWarning],
    ) -> Calibration: ...
    @property
    def camera(self) -> Camera:
        """Camera."""
    @property
    def rms_px(self) -> float:
        """Root mean square of all reprojection errors (distances), pixels."""
    @property
    def std_dev_k(self) -> NDArray[np.float64]:
        """Standard deviation of fu, fv, cu, cv, pixels, shape (4,)."""
    @property
    def std_dev_lens(self) -> NDArray[np.float64]:
        """Standard deviation of each lens coefficient."""
    @property
    def coverage(self) -> float:
        """Fraction of the image area covered by marks of some view, 0 to 1."""
    @property
    def views(self) -> list[CalibratedView | None]:
        """`CalibratedView` of each given view, or None where none was given."""
    @property
    def warnings(self) -> list[CalibrationWarning]:
        """List of `CalibrationWarning`."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class RigCalibration:
    """Calibrated rig of two cameras.

    Parameters
    ----------
    right_from_left
        ``x_in_right = right_from_left @ x_in_left``, meters.
    baseline_m
        Distance between the cameras, meters.
    rms_px
        Root mean square of the reprojection errors in both cameras, pixels.
    std_dev_rotation_rad
        Standard deviation of the rotation about the axes of the right camera, radians, shape
        (3,).
    std_dev_translation_m
        Standard deviation of the translation, meters, shape (3,).
    pairs_rms_px
        Root mean square of each pair, pixels; None unless both cameras see the board.
    """
    def __new__(
        cls,
        right_from_left: RigidTransform,
        baseline_m: float,
        rms_px: float,
        std_dev_rotation_rad: NDArray[np.float64],
        std_dev_translation_m: NDArray[np.float64],
        pairs_rms_px: Sequence[float | None],
    ) -> RigCalibration: ...
    @property
    def right_from_left(self) -> RigidTransform:
        """``x_in_right = right_from_left @ x_in_left``, meters."""
    @property
    def baseline_m(self) -> float:
        """Distance between the cameras, meters."""
    @property
    def rms_px(self) -> float:
        """Root mean square of the reprojection errors in both cameras, pixels."""
    @property
    def std_dev_rotation_rad(self) -> NDArray[np.float64]:
        """Standard deviation of the rotation about the axes of the right camera, radians, shape
        (3,).
        """
    @property
    def std_dev_translation_m(self) -> NDArray[np.float64]:
        """Standard deviation of the translation, meters, shape (3,)."""
    @property
    def pairs_rms_px(self) -> list[float | None]:
        """Root mean square of each pair, pixels; None unless both cameras see the board."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class Undistortion:
    """Best undistorted camera for the photos of a camera, and the map to it.

    Parameters
    ----------
    camera : Camera
    keep : {"valid", "all"}, optional
        Only the area that is valid everywhere, or the whole image with black borders.
    progress : callable, optional
        Called with the stage and the completed fraction.

    Raises
    ------
    epipole.DegenerateError
        If the lens model folds less than halfway to the border, or, with ``keep="all"``, the lens
        sees more than 80° to a side.
    ValueError
        If a side of the image is shorter than 2 pixels, or the image has more than 2**32 pixels.
    """
    def __new__(
        cls,
        camera: Camera,
        keep: Literal["valid", "all"] | None = None,
        *,
        progress: Callable[[str, float], object] | None = None,
    ) -> Undistortion: ...
    @property
    def camera(self) -> Camera:
        """Camera with distortion."""
    @property
    def keep(self) -> str:
        """Kept area.

        Returns
        -------
        str
            "valid" or "all".
        """
    @property
    def intrinsics(self) -> Intrinsics:
        """K of the undistorted camera. Its pixels are square."""
    @property
    def valid(self) -> PixelRect:
        """Part of the result in which every pixel has image content.

        Returns
        -------
        epipole.stereo.PixelRect
        """
    @property
    def map(self) -> PixelMap:
        """Source position of every pixel of the result.

        Returns
        -------
        epipole.stereo.PixelMap
        """
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

def find_board(
    image: ArrayLike,
    board: Board,
    *,
    progress: Callable[[str, float], object] | None = None,
) -> BoardSearch:
    """Finds the marks of a board in a photo.

    Parameters
    ----------
    image : array_like, shape (H, W)
        Gray, uint8 or float in [0, 1].
    board : Board
    progress : callable, optional
        Called with the stage and the completed fraction.

    Returns
    -------
    BoardSearch
        Marks are in `view`, which is None if the board was not found.

    Raises
    ------
    ValueError
        If gray values are outside [-0.5, 1.5].
    """
def detect_markers(
    image: ArrayLike,
    dictionary: str | MarkerDictionary,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.MarkerOptions],
) -> list[Marker]:
    """Finds ArUco markers and AprilTags.

    Parameters
    ----------
    image : array_like, shape (H, W)
        Gray, uint8 or float in [0, 1].
    dictionary : str or MarkerDictionary
        For example ``"4x4_50"`` or ``"36h11"``.
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : MarkerOptions
        ``max_hamming``, ``border_bits``, ``min_side_px``.

    Returns
    -------
    list of Marker
        Sorted by number.

    Raises
    ------
    ValueError
        If gray values are outside [-0.5, 1.5].
    """
def render_board(
    board: Board,
    camera: Camera,
    cam_from_board: RigidTransform,
    noise: float = 0.0,
    seed: int = 0,
    *,
    progress: Callable[[str, float], object] | None = None,
) -> NDArray[np.float32]:
    """Renders a photo of a board with known ground truth.

    Parameters
    ----------
    board : Board
    camera : Camera
    cam_from_board : RigidTransform
        Pose of the board, meters.
    noise : float, optional
        Standard deviation of the gray values.
    seed : int, optional
    progress : callable, optional
        Called with the stage and the completed fraction.

    Returns
    -------
    ndarray of float32, shape (H, W)
        Gray, in [0, 1].

    Raises
    ------
    ValueError
        If the result has more than 2**32 pixels.
    """
def calibrate(
    board: Board,
    views: Sequence[BoardView | None],
    size: tuple[int, int],
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.CalibrationOptions],
) -> Calibration:
    """Calibrates a camera: estimates intrinsics, lens and board poses with minimal error.

    Parameters
    ----------
    board : Board
    views : list of BoardView or None
        Marks in each photo; None for a photo without a board.
    size : tuple of int
        Width and height of all photos, pixels.
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : CalibrationOptions
        ``lens``, the lens model, such as ``"brown"`` or ``"fisheye"``; ``max_iterations``.

    Returns
    -------
    Calibration

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 2 views, or a view has fewer than 4 marks.
    epipole.DegenerateError
        If the marks of a view lie on a line, or the boards are parallel or fit no camera.
    ValueError
        If the image size is 0.
    """
def calibrate_rig(
    board: Board,
    cameras: Sequence[Camera],
    left: Sequence[BoardView | None],
    right: Sequence[BoardView | None],
    *,
    progress: Callable[[str, float], object] | None = None,
) -> RigCalibration:
    """Calibrates the relative pose of two calibrated cameras that see the same boards.

    Parameters
    ----------
    board : Board
    cameras : tuple of Camera
        Left and right camera.
    left, right : list of BoardView or None
        Marks in the photos of each camera, in pairs.
    progress : callable, optional
        Called with the stage and the completed fraction.

    Returns
    -------
    RigCalibration

    Raises
    ------
    epipole.TooFewError
        If the cameras see no board in common, or a view has fewer than 4 marks.
    epipole.DegenerateError
        If the marks of a view lie on a line, or not on a plane in front of the camera.
    ValueError
        If the image size of the camera is 0.
    """
def intrinsics_from_planes(pixels_from_plane: ArrayLike) -> Intrinsics:
    """Computes K from homographies of planes, in closed form (Zhang).

    Parameters
    ----------
    pixels_from_plane : array_like, shape (N, 3, 3)
        Homographies from a plane, in its own unit, to pixels, N >= 3.

    Returns
    -------
    Intrinsics

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 2 homographies.
    epipole.DegenerateError
        If the planes are parallel, or the noise is so strong that no camera fits.
    """
