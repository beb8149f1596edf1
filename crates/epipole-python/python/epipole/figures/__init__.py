"""Interactive figures of multi-view geometry in notebooks; needs ``pip install epipole[figures]``."""

try:
    import anywidget  # noqa: F401
    import epipole_figures  # noqa: F401
except ImportError as error:
    raise ImportError(
        f"epipole.figures needs {error.name}: pip install epipole[figures]", name=error.name
    ) from error

from ._figure import Figure

__all__ = ["Figure"]
