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
    """One attempted step.

    Parameters
    ----------
    index
        Index from 1; 0 is the initial state.
    cost
        Best cost so far.
    damping
        Damping of this step.
    accepted
        Whether the step reduced the cost and was accepted.
    """
    def __new__(cls, index: int, cost: float, damping: float, accepted: bool) -> Iteration: ...
    @property
    def index(self) -> int:
        """Index from 1; 0 is the initial state."""
    @property
    def cost(self) -> float:
        """Best cost so far."""
    @property
    def damping(self) -> float:
        """Damping of this step."""
    @property
    def accepted(self) -> bool:
        """Whether the step reduced the cost and was accepted."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class LmReport:
    """Report of a minimization.

    Parameters
    ----------
    initial_cost
        Cost of the initial parameters.
    final_cost
        Cost of the final parameters.
    iterations
        Number of steps tried.
    accepted
        Number of steps accepted.
    termination
        Reason the loop ended: "small_gradient", "small_step", "small_cost_change",
        "max_iterations" or "stuck".
    history
        Initial state and every step tried, a list of `Iteration`.
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
        """Cost of the initial parameters."""
    @property
    def final_cost(self) -> float:
        """Cost of the final parameters."""
    @property
    def iterations(self) -> int:
        """Number of steps tried."""
    @property
    def accepted(self) -> int:
        """Number of steps accepted."""
    @property
    def termination(self) -> str:
        """Reason the loop ended: "small_gradient", "small_step", "small_cost_change",
        "max_iterations" or "stuck".
        """
    @property
    def history(self) -> list[Iteration]:
        """Initial state and every step tried, a list of `Iteration`."""
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
    """Minimizes the sum of squared residuals by Levenberg-Marquardt with QR.

    Parameters
    ----------
    residuals : callable
        Residuals of shape (M,) at parameters of shape (N,).
    jacobian : callable
        Jacobian of shape (M, N) at parameters of shape (N,).
    parameters : array_like, shape (N,)
        Initial parameters.
    loss : str or dict, optional
        Loss of each residual: ``"trivial"``, or ``{"huber": {"width": 1.0}}``; ``"cauchy"`` and
        ``"truncated"`` likewise.
    held : list of bool, optional
        Parameters held fixed; missing entries are free.
    progress : callable, optional
        Called with the stage and the completed fraction.
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
        If there are no residuals or no parameters.
    ValueError
        If the loss width is not above 0, or the initial cost or gradient is not finite.
    """
def check_jacobian(
    analytic: ArrayLike,
    residuals: Callable[..., Any],
    step: float = 1e-06,
) -> float:
    """Computes the maximum difference between a Jacobian and central differences.

    Parameters
    ----------
    analytic : array_like, shape (M, N)
    residuals : callable
        Residuals of shape (M,) after a step of shape (N,).
    step : float, optional
        Step size of the differences.

    Returns
    -------
    float
        Each difference is relative to the entry's magnitude or 1, whichever is larger; infinity for
        other shapes and NaN.

    Raises
    ------
    ValueError
        If ``step`` is not above 0.

    Examples
    --------
    >>> check_jacobian(np.eye(2), lambda step: step) < 1e-6
    True
    """
