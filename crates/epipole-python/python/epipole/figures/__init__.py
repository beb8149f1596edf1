"""Interactive figures of multi-view geometry in notebooks; needs ``pip install epipole[figures]``."""

try:
    import anywidget  # noqa: F401
except ImportError as error:
    raise ImportError(
        "epipole.figures needs anywidget: pip install epipole[figures]", name="anywidget"
    ) from error

from ._figure import Figure

__all__ = ["Figure"]
