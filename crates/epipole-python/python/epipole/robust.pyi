# Written by stubs.py. Do not edit.

from collections.abc import Callable
from typing import Any, ClassVar, Generic, TypeVar, final

import numpy as np
from numpy.typing import ArrayLike, NDArray
from typing_extensions import Unpack

from epipole import options as option_types

_Model = TypeVar("_Model")

__all__ = [
    "FARTHEST_PX",
    "LeastMedian",
    "PlaneSimilarity",
    "Ransac",
    "RansacReport",
    "Trial",
    "estimate_line",
    "estimate_similarity",
    "fit_line_huber",
    "fit_line_total_least_squares",
    "fit_similarity",
    "least_median",
    "log10_false_alarms",
    "num_trials_with_replacement",
    "num_trials_without_replacement",
    "ransac",
]

FARTHEST_PX: float
@final
class RansacReport(Generic[_Model]):
    """Result of a robust estimation.

    Parameters
    ----------
    model
        Best model.
    inliers
        Whether each data point is an inlier, boolean array of shape (N,).
    num_inliers
        Number of inliers.
    num_unique_inliers
        Number of unique inliers, which is the support of the model.
    num_left_out
        Number of data points ignored because a coordinate is infinite or beyond 1e9 pixels.
    iterations
        Number of samples drawn.
    required_iterations
        Number of samples required at the final inlier ratio.
    max_error_px
        Inlier threshold, pixels.
    score
        Score of the model.
    log10_false_alarms
        Expected number of models with this support by chance, as log10; None if unknown.
    refinements
        Number of times a model was refined from its inliers.
    stop
        Reason the search ended: "confident", "exhausted" or "interrupted".
    """
    def __new__(
        cls,
        model: _Model,
        inliers: NDArray[np.bool_],
        num_inliers: int,
        num_unique_inliers: int,
        num_left_out: int,
        iterations: int,
        required_iterations: int,
        max_error_px: float,
        score: float,
        log10_false_alarms: float | None,
        refinements: int,
        stop: str,
    ) -> RansacReport[_Model]: ...
    @property
    def model(self) -> _Model:
        """Best model."""
    @property
    def inliers(self) -> NDArray[np.bool_]:
        """Whether each data point is an inlier, boolean array of shape (N,)."""
    @property
    def num_inliers(self) -> int:
        """Number of inliers."""
    @property
    def num_unique_inliers(self) -> int:
        """Number of unique inliers, which is the support of the model."""
    @property
    def num_left_out(self) -> int:
        """Number of data points ignored because a coordinate is infinite or beyond 1e9 pixels."""
    @property
    def iterations(self) -> int:
        """Number of samples drawn."""
    @property
    def required_iterations(self) -> int:
        """Number of samples required at the final inlier ratio."""
    @property
    def max_error_px(self) -> float:
        """Inlier threshold, pixels."""
    @property
    def score(self) -> float:
        """Score of the model."""
    @property
    def log10_false_alarms(self) -> float | None:
        """Expected number of models with this support by chance, as log10; None if unknown."""
    @property
    def refinements(self) -> int:
        """Number of times a model was refined from its inliers."""
    @property
    def stop(self) -> str:
        """Reason the search ended: "confident", "exhausted" or "interrupted"."""
    def __eq__(self, other: object, /) -> bool: ...
    @classmethod
    def __class_getitem__(cls, model: Any) -> Any: ...
    def could_be_random(self) -> bool:
        """Whether unrelated data might have this much support: the model is then not significant."""
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class LeastMedian(Generic[_Model]):
    """Result of `least_median`.

    Parameters
    ----------
    model
        Model, fitted to its inliers.
    median_px
        Median error of the best model from a sample, in the unit of the errors.
    sigma_px
        Standard deviation of the noise, derived from the median, in the same unit.
    num_inliers
        Number of data points within 2.5 standard deviations of the model.
    """
    def __new__(
        cls,
        model: _Model,
        median_px: float,
        sigma_px: float,
        num_inliers: int,
    ) -> LeastMedian[_Model]: ...
    @property
    def model(self) -> _Model:
        """Model, fitted to its inliers."""
    @property
    def median_px(self) -> float:
        """Median error of the best model from a sample, in the unit of the errors."""
    @property
    def sigma_px(self) -> float:
        """Standard deviation of the noise, derived from the median, in the same unit."""
    @property
    def num_inliers(self) -> int:
        """Number of data points within 2.5 standard deviations of the model."""
    def __eq__(self, other: object, /) -> bool: ...
    @classmethod
    def __class_getitem__(cls, model: Any) -> Any: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class Ransac:
    """RANSAC, one sample at a time: to visualize it, or to stop it by a custom rule.

    The constructor takes a custom model; `line`, `similarity`, `fundamental` and `homography` start
    runs for models of the library.

    Parameters
    ----------
    num_data : int
        Number of data points.
    sample_size : int
        Number of data points in a minimal sample.
    fit : callable
        ``fit(indices)`` returns the model of a minimal sample, a list of models, or None.
    errors : callable
        ``errors(model)`` returns the errors of all data points, shape (num_data,), in the unit of
        ``max_error_px``.
    refine : callable, optional
        ``refine(model, indices)`` returns a better model from the inliers, or None.
    **options : RansacOptions
        See `ransac`.

    Raises
    ------
    epipole.TooFewError
        If there are fewer data than a sample needs.
    ValueError
        If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.

    Notes
    -----
    A step raises the exceptions of its callables; the next step continues the run.

    Examples
    --------
    >>> run = Ransac.line([[0, 2], [1, 2], [2, 2], [3, 2], [4, 9]])
    >>> trial = run.step()
    >>> trial.iteration, trial.num_models, len(trial.sample)
    (1, 1, 2)
    >>> sum(trial.is_best for trial in run) <= 199  # draws the other samples
    True
    >>> run.finish().num_inliers
    4
    """
    def __new__(
        cls,
        num_data: int,
        sample_size: int,
        fit: Callable[..., Any],
        errors: Callable[..., Any],
        refine: Callable[..., Any] | None = None,
        **options: Unpack[option_types.RansacOptions],
    ) -> Ransac: ...
    @property
    def best_model(self) -> Any:
        """Best model so far, or None.

        Returns
        -------
        Any
        """
    @property
    def best_score(self) -> float | None:
        """Score of the best model so far, or None."""
    @property
    def iterations(self) -> int:
        """Number of samples drawn so far."""
    @property
    def required_iterations(self) -> int | None:
        """Number of samples required by the best model so far; None before the first model."""
    @property
    def expected_iterations(self) -> int:
        """Number of samples after which the run ends unless a better model is found."""
    @staticmethod
    def line(points: ArrayLike, **options: Unpack[option_types.RansacOptions]) -> Ransac:
        """Starts a run for a line through points; see `estimate_line`.

        Parameters
        ----------
        points : array_like, shape (N, 2)
            Pixels.
        **options : RansacOptions
            See `ransac`.

        Returns
        -------
        Ransac
            Its models are lines (a, b, c).

        Raises
        ------
        epipole.TooFewError
            If there are fewer than 2 points.
        epipole.DegenerateError
            If the points are equal.
        ValueError
            If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.
        """
    @staticmethod
    def similarity(
        pixels1: ArrayLike,
        pixels2: ArrayLike,
        **options: Unpack[option_types.RansacOptions],
    ) -> Ransac:
        """Starts a run for a similarity of the plane; see `estimate_similarity`.

        Parameters
        ----------
        pixels1, pixels2 : array_like, shape (N, 2)
            Matches.
        **options : RansacOptions
            See `ransac`.

        Returns
        -------
        Ransac
            Its models are `PlaneSimilarity`.

        Raises
        ------
        epipole.TooFewError
            If there are fewer than 2 different matches.
        ValueError
            If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.
        """
    @staticmethod
    def fundamental(
        pixels1: ArrayLike,
        pixels2: ArrayLike,
        **options: Unpack[option_types.RansacOptions],
    ) -> Ransac:
        """Starts a run for a fundamental matrix; see `epipole.epipolar.estimate_fundamental`.

        Parameters
        ----------
        pixels1, pixels2 : array_like, shape (N, 2)
            Matches.
        **options : RansacOptions
            See `ransac`.

        Returns
        -------
        Ransac
            Its models are F, shape (3, 3).

        Raises
        ------
        epipole.TooFewError
            If there are fewer than 7 different matches.
        epipole.DegenerateError
            If all pixels of an image are on a line.
        ValueError
            If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.
        """
    @staticmethod
    def homography(
        pixels1: ArrayLike,
        pixels2: ArrayLike,
        **options: Unpack[option_types.RansacOptions],
    ) -> Ransac:
        """Starts a run for a homography; see `epipole.homography.estimate_homography`.

        Parameters
        ----------
        pixels1, pixels2 : array_like, shape (N, 2)
            Matches.
        **options : RansacOptions
            See `ransac`.

        Returns
        -------
        Ransac
            Its models are H, shape (3, 3).

        Raises
        ------
        epipole.TooFewError
            If there are fewer than 4 different matches.
        epipole.DegenerateError
            If all pixels of an image are on a line.
        ValueError
            If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.
        """
    def start_from(self, model: object) -> None:
        """Improves a known model, such as that of the previous frame, and starts from it.

        Parameters
        ----------
        model : object
            Model of the kind that the run estimates.

        Raises
        ------
        epipole.DegenerateError
            If the line of a run of `line` is (0, 0, c).
        RuntimeError
            If the run is finished, or another thread uses it.
        """
    def step(self) -> Trial | None:
        """Draws a sample and returns a `Trial`; None once enough samples were drawn.

        Raises
        ------
        RuntimeError
            If the run is finished, or another thread uses it.
        """
    def __iter__(self, /) -> Ransac: ...
    def __next__(self, /) -> Trial: ...
    def finish(self) -> RansacReport[Any]:
        """Improves the best model once more and ends the run.

        Returns
        -------
        RansacReport of Any
            ``stop`` is "interrupted" if more samples were required.

        Raises
        ------
        epipole.NoConsensusError
            If every model has fewer inliers than a sample has data.
        RuntimeError
            If the run is finished, or another thread uses it.
        """

@final
class Trial:
    """One sample of `Ransac` and its outcome.

    Parameters
    ----------
    iteration
        Number of the sample, from 1.
    sample
        Indices of the data drawn, int64 array of shape (sample_size,).
    num_models
        Number of models from the sample.
    model
        Best of these models, or None.
    score
        Score of `model`; an upper bound if it cannot win and ``score_every_trial`` is not set.
    num_inliers
        Number of inliers of `model`; a lower bound in the same case.
    required_iterations
        Number of samples required by the best model so far; None before the first model.
    is_best
        Whether this step found the best model so far.
    refined
        Best model after local optimization, or None if it was not improved.
    """
    def __new__(
        cls,
        iteration: int,
        sample: NDArray[np.int64],
        num_models: int,
        model: Any | None,
        score: float,
        num_inliers: int,
        required_iterations: int | None,
        is_best: bool,
        refined: Any | None,
    ) -> Trial: ...
    @property
    def iteration(self) -> int:
        """Number of the sample, from 1."""
    @property
    def sample(self) -> NDArray[np.int64]:
        """Indices of the data drawn, int64 array of shape (sample_size,)."""
    @property
    def num_models(self) -> int:
        """Number of models from the sample."""
    @property
    def model(self) -> Any:
        """Best of these models, or None."""
    @property
    def score(self) -> float:
        """Score of `model`; an upper bound if it cannot win and ``score_every_trial`` is not set."""
    @property
    def num_inliers(self) -> int:
        """Number of inliers of `model`; a lower bound in the same case."""
    @property
    def required_iterations(self) -> int | None:
        """Number of samples required by the best model so far; None before the first model."""
    @property
    def is_best(self) -> bool:
        """Whether this step found the best model so far."""
    @property
    def refined(self) -> Any:
        """Best model after local optimization, or None if it was not improved."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class PlaneSimilarity:
    """Rotation, scale and shift in the plane: ``u' = a*u - b*v + tu``, ``v' = b*u + a*v + tv``.

    Parameters
    ----------
    a
        Scale times the cosine of the rotation angle.
    b
        Scale times the sine of the rotation angle.
    tu
        Shift along u, pixels.
    tv
        Shift along v, pixels.
    """
    def __new__(cls, a: float, b: float, tu: float, tv: float) -> PlaneSimilarity: ...
    @property
    def a(self) -> float:
        """Scale times the cosine of the rotation angle."""
    @property
    def b(self) -> float:
        """Scale times the sine of the rotation angle."""
    @property
    def tu(self) -> float:
        """Shift along u, pixels."""
    @property
    def tv(self) -> float:
        """Shift along v, pixels."""
    def __eq__(self, other: object, /) -> bool: ...
    def apply(self, p: ArrayLike) -> NDArray[np.float64]:
        """Maps points.

        Parameters
        ----------
        p : array_like, shape (2,) or (N, 2)

        Returns
        -------
        ndarray of the same shape
        """
    def scale(self) -> float:
        """Returns the scale."""
    def angle_rad(self) -> float:
        """Returns the rotation angle from u towards v, radians."""
    def matrix(self) -> NDArray[np.float64]:
        """Returns the homogeneous matrix, shape (3, 3)."""
    __hash__: ClassVar[None]  # type: ignore[assignment]

def num_trials_with_replacement(
    inlier_ratio: float,
    sample_size: int,
    confidence: float,
) -> int:
    """Returns the required number of samples if data are drawn with replacement (``w**s``).

    Parameters
    ----------
    inlier_ratio : float
        In [0, 1].
    sample_size : int
    confidence : float
        In (0, 1).

    Returns
    -------
    int

    Raises
    ------
    ValueError
        If ``inlier_ratio`` is outside [0, 1], ``sample_size`` is 0, or ``confidence`` is outside
        (0, 1).

    Examples
    --------
    >>> num_trials_with_replacement(0.5, 7, 0.99)
    588
    """
def num_trials_without_replacement(
    num_inliers: int,
    num_data: int,
    sample_size: int,
    confidence: float,
) -> int:
    """Returns the required number of samples if data are drawn without replacement.

    Parameters
    ----------
    num_inliers, num_data, sample_size : int
    confidence : float
        In (0, 1).

    Returns
    -------
    int

    Raises
    ------
    epipole.TooFewError
        If there are fewer data than a sample needs.
    ValueError
        If ``num_inliers`` is above ``num_data``, ``sample_size`` is 0, or ``confidence`` is outside
        (0, 1).
    """
def log10_false_alarms(
    num_inliers: int,
    num_data: int,
    sample_size: int,
    max_models: int,
    random_inlier_probability: float,
) -> float:
    """Returns the expected number of models with this support by chance, as log10.

    Parameters
    ----------
    num_inliers, num_data, sample_size, max_models : int
    random_inlier_probability : float
        Probability that an unrelated data point fits a model.

    Returns
    -------
    float
    """
def fit_line_total_least_squares(points: ArrayLike) -> NDArray[np.float64]:
    """Fits the line with the smallest sum of squared distances.

    Parameters
    ----------
    points : array_like, shape (N, 2)
        Pixels, N >= 2.

    Returns
    -------
    ndarray, shape (3,)
        Line (a, b, c): ``a*u + b*v + c == 0`` with ``a**2 + b**2 == 1``.

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 2 points.
    epipole.DegenerateError
        If the points are equal, or spread equally in all directions.
    """
def fit_line_huber(points: ArrayLike, width_px: float) -> NDArray[np.float64]:
    """Fits the line with the smallest sum of Huber losses of the distances.

    Parameters
    ----------
    points : array_like, shape (N, 2)
        Pixels, N >= 2.
    width_px : float
        Distance at which the loss becomes linear, pixels, > 0.

    Returns
    -------
    ndarray, shape (3,)
        Line (a, b, c): ``a*u + b*v + c == 0`` with ``a**2 + b**2 == 1``.

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 2 points.
    epipole.DegenerateError
        If the points are equal, or spread equally in all directions.
    ValueError
        If ``width_px`` is not above 0.
    """
def estimate_line(
    points: ArrayLike,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.RansacOptions],
) -> RansacReport[NDArray[np.float64]]:
    """Estimates a line from points with outliers, by RANSAC.

    Parameters
    ----------
    points : array_like, shape (N, 2)
        Pixels.
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : RansacOptions
        For example ``max_error_px=1.0``, ``confidence=0.999``, ``seed=0``.

    Returns
    -------
    RansacReport of ndarray
        Its model is the line (a, b, c): ``a*u + b*v + c == 0`` with ``a**2 + b**2 == 1``.

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 2 points.
    epipole.DegenerateError
        If the points are equal.
    epipole.NoConsensusError
        If no line has 2 inliers.
    ValueError
        If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.

    Examples
    --------
    >>> report = estimate_line([[0, 2], [1, 2], [2, 2], [3, 2], [4, 9]])
    >>> report.num_inliers
    4
    """
def fit_similarity(pixels1: ArrayLike, pixels2: ArrayLike) -> PlaneSimilarity:
    """Fits a similarity to matches by least squares, without outliers.

    Parameters
    ----------
    pixels1, pixels2 : array_like, shape (N, 2)
        Matches, N >= 2.

    Returns
    -------
    PlaneSimilarity

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 2 matches.
    epipole.DegenerateError
        If all points of image 1 are equal.
    ValueError
        If a coordinate is beyond 1e9 pixels.

    Examples
    --------
    >>> fit_similarity([[0, 0], [1, 0]], [[3, 1], [3, 3]]).scale()
    2.0
    """
def estimate_similarity(
    pixels1: ArrayLike,
    pixels2: ArrayLike,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.RansacOptions],
) -> RansacReport[PlaneSimilarity]:
    """Estimates a similarity from matches with outliers, by RANSAC.

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
    RansacReport of PlaneSimilarity
        Its model is a `PlaneSimilarity`.

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 2 different matches.
    epipole.NoConsensusError
        If no similarity has 2 inliers.
    ValueError
        If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.
    """
def least_median(
    num_data: int,
    sample_size: int,
    fit: Callable[..., Any],
    errors: Callable[..., Any],
    refine: Callable[..., Any] | None = None,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.LeastMedianOptions],
) -> LeastMedian[Any]:
    """Estimates a custom model by least median of squares, without a threshold.

    Parameters
    ----------
    num_data : int
        Number of data points, fewer than half of them outliers.
    sample_size : int
        Number of data points in a minimal sample.
    fit : callable
        ``fit(indices)`` returns the model of a minimal sample, a list of models, or None.
    errors : callable
        ``errors(model)`` returns the errors of all data points, shape (num_data,).
    refine : callable, optional
        ``refine(model, indices)`` returns a better model from the inliers, or None.
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : LeastMedianOptions
        ``num_samples=500``, ``seed=0``.

    Returns
    -------
    LeastMedian of Any

    Raises
    ------
    epipole.TooFewError
        If ``num_data`` does not exceed ``sample_size``.
    epipole.DegenerateError
        If no sample gives a model.
    ValueError
        If ``num_samples`` is 0.

    Notes
    -----
    An exception in a callable ends the run and propagates.

    Examples
    --------
    >>> import numpy as np
    >>> values = np.array([1.0, 1.1, 0.9, 1.0, 30.0])
    >>> found = least_median(5, 1, lambda i: values[i[0]], lambda model: np.abs(values - model))
    >>> found.num_inliers
    4
    """
def ransac(
    num_data: int,
    sample_size: int,
    fit: Callable[..., Any],
    errors: Callable[..., Any],
    refine: Callable[..., Any] | None = None,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.RansacOptions],
) -> RansacReport[Any]:
    """Estimates a custom model by RANSAC.

    Parameters
    ----------
    num_data : int
        Number of data points.
    sample_size : int
        Number of data points in a minimal sample.
    fit : callable
        ``fit(indices)`` returns the model of a minimal sample, a list of models, or None.
    errors : callable
        ``errors(model)`` returns the errors of all data points, shape (num_data,), in the unit of
        ``max_error_px``.
    refine : callable, optional
        ``refine(model, indices)`` returns a better model from the inliers, or None.
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : RansacOptions
        For example ``max_error_px=1.0``, ``confidence=0.999``, ``seed=0``.

    Returns
    -------
    RansacReport of Any

    Raises
    ------
    epipole.TooFewError
        If there are fewer data than a sample needs.
    epipole.NoConsensusError
        If every model has fewer inliers than a sample has data.
    ValueError
        If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.

    Notes
    -----
    An exception in a callable ends the run and propagates. See `Ransac` for step-by-step runs.
    """
