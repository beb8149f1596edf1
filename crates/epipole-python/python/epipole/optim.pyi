# Written by stubs.py. Do not edit.

from collections.abc import Callable, Mapping, Sequence
from typing import Any, ClassVar, final

import numpy as np
from numpy.typing import ArrayLike, NDArray
from typing_extensions import Unpack

from epipole import options as option_types

__all__ = [
    "Iteration",
    "LmReport",
    "check_jacobian",
    "minimize_dense",
]

@final
class Iteration:
    """One tried step.

    Parameters
    ----------
    index
        Counted from 1; 0 is the start.
    cost
        Best cost so far.
    damping
        Damping of this step.
    accepted
        Whether the step lowered the cost and was kept.
    """
    def __new__(cls, index: int, cost: float, damping: float, accepted: bool) -> Iteration: ...
    @property
    def index(self) -> int:
        """Counted from 1; 0 is the start."""
    @property
    def cost(self) -> float:
        """Best cost so far."""
    @property
    def damping(self) -> float:
        """Damping of this step."""
    @property
    def accepted(self) -> bool:
        """Whether the step lowered the cost and was kept."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class LmReport:
    """Outcome of a minimization.

    Parameters
    ----------
    initial_cost
        Cost of the starting parameters.
    final_cost
        Cost of the parameters returned.
    iterations
        Steps tried.
    accepted
        Steps kept.
    termination
        Why the loop ended: "small_gradient", "small_step", "small_cost_change",
        "max_iterations" or "stuck".
    history
        The start and every step tried, a list of `Iteration`.
    """
    def __new__(
        cls,
        initial_cost: float,
        final_cost: float,
        iterations: int,
        accepted: int,
        termination: str,
        history: Sequence[Iteration],
    ) -> LmReport: ...
    @property
    def initial_cost(self) -> float:
        """Cost of the starting parameters."""
    @property
    def final_cost(self) -> float:
        """Cost of the parameters returned."""
    @property
    def iterations(self) -> int:
        """Steps tried."""
    @property
    def accepted(self) -> int:
        """Steps kept."""
    @property
    def termination(self) -> str:
        """Why the loop ended: "small_gradient", "small_step", "small_cost_change",
        "max_iterations" or "stuck".
        """
    @property
    def history(self) -> list[Iteration]:
        """The start and every step tried, a list of `Iteration`."""
    def __eq__(self, other: object, /) -> bool: ...
    def is_converged(self) -> bool:
        """Whether the loop converged."""
    __hash__: ClassVar[None]  # type: ignore[assignment]

def minimize_dense(
    residuals: Callable[..., Any],
    jacobian: Callable[..., Any],
    parameters: ArrayLike,
    *,
    loss: str | Mapping[str, Any] | None = None,
    held: Sequence[bool] | None = None,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.LmOptions],
) -> tuple[NDArray[np.float64], LmReport]:
    """Parameters with the least sum of squared residuals, by Levenberg-Marquardt and QR.

    Parameters
    ----------
    residuals : callable
        Residuals of shape (M,) at parameters of shape (N,).
    jacobian : callable
        Jacobian of shape (M, N) at parameters of shape (N,).
    parameters : array_like, shape (N,)
        Start.
    loss : str or dict, optional
        Loss of each residual: ``"trivial"``, or ``{"huber": {"width": 1.0}}``, ``"cauchy"``,
        ``"truncated"`` likewise.
    held : list of bool, optional
        Parameters that stay fixed; missing entries are free.
    progress : callable, optional
        Called with the stage and the completed share.
    **options : LmOptions
        ``max_iterations``, ``gradient_tolerance``, ``step_tolerance``, ``cost_tolerance``,
        ``initial_damping``, ``patience``.

    Returns
    -------
    parameters : ndarray, shape (N,)
    report : LmReport

    Raises
    ------
    epipole.TooFewError
        No residuals or no parameters.
    ValueError
        Loss width not above 0, or no finite cost or gradient at the start.
    """
def check_jacobian(
    analytic: ArrayLike,
    residuals: Callable[..., Any],
    step: float = 1e-06,
) -> float:
    """Largest difference between a Jacobian and central differences.

    Parameters
    ----------
    analytic : array_like, shape (M, N)
    residuals : callable
        Residuals of shape (M,) after a step of shape (N,).
    step : float, optional
        Length of the differences.

    Returns
    -------
    float
        Each entry relative to the larger of 1 and its size; infinity for other shapes and NaN.

    Raises
    ------
    ValueError
        ``step`` not above 0.

    Examples
    --------
    >>> check_jacobian(np.eye(2), lambda step: step) < 1e-6
    True
    """
