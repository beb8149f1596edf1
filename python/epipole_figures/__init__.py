"""Interactive figures of multi-view geometry in notebooks."""

from ._figure import Figure

__all__ = ["Figure"]
__version__ = "0.1.0"
