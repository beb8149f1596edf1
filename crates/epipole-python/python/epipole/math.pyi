# Written by stubs.py. Do not edit.

from typing import ClassVar, final

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = [
    "Geodetic",
    "Line2",
    "Random",
    "Svd3",
    "length",
    "local_from_geodetic",
    "svd3",
]

@final
class Geodetic:
    """Place on the earth (WGS 84).

    Parameters
    ----------
    latitude_deg : float
        North of the equator, degrees, -90 to 90.
    longitude_deg : float
        East of Greenwich, degrees, -180 to 180.
    height_m : float
        Above the ellipsoid, meters.
    """
    def __new__(cls, latitude_deg: float, longitude_deg: float, height_m: float) -> Geodetic: ...
    @property
    def latitude_deg(self) -> float:
        """North of the equator, degrees."""
    @property
    def longitude_deg(self) -> float:
        """East of Greenwich, degrees."""
    @property
    def height_m(self) -> float:
        """Above the ellipsoid, meters."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class Line2:
    """Line ``a*u + b*v + c == 0`` with ``a**2 + b**2 == 1``.

    Parameters
    ----------
    line : array_like, shape (3,)
        Homogeneous line, of any scale.

    Raises
    ------
    epipole.DegenerateError
        Line (0, 0, c).
    """
    def __new__(cls, line: ArrayLike) -> Line2: ...
    @property
    def line(self) -> NDArray[np.float64]:
        """(a, b, c), shape (3,)."""
    @property
    def a(self) -> float:
        """The normal's component along u."""
    @property
    def b(self) -> float:
        """The normal's component along v."""
    @property
    def c(self) -> float:
        """Minus the signed distance of the origin along the normal."""
    def __eq__(self, other: object, /) -> bool: ...
    @staticmethod
    def from_homogeneous(line: ArrayLike) -> Line2:
        """Line of a homogeneous vector.

        Parameters
        ----------
        line : array_like, shape (3,)
            Of any scale.

        Raises
        ------
        epipole.DegenerateError
            Line (0, 0, c).
        """
    @staticmethod
    def through(p: ArrayLike, q: ArrayLike) -> Line2:
        """Line through two points.

        Parameters
        ----------
        p, q : array_like, shape (2,)

        Raises
        ------
        epipole.DegenerateError
            Equal points.
        """
    def homogeneous(self) -> NDArray[np.float64]:
        """(a, b, c), shape (3,)."""
    def signed_distance(self, point: ArrayLike) -> float:
        """Signed distance of a point.

        Parameters
        ----------
        point : array_like, shape (2,)
        """
    def nearest(self, point: ArrayLike) -> NDArray[np.float64]:
        """Point of the line nearest to a point.

        Parameters
        ----------
        point : array_like, shape (2,)

        Returns
        -------
        ndarray, shape (2,)
        """
    def angle_rad(self) -> float:
        """Angle of the line against u, radians."""
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class Svd3:
    """Singular value decomposition: ``A = u @ diag(singular_values) @ v.T``.

    Parameters
    ----------
    u
        Left singular vectors in its columns, shape (3, 3).
    singular_values
        Largest first, none negative, shape (3,).
    v
        Right singular vectors in its columns, shape (3, 3).
    """
    def __new__(
        cls,
        u: NDArray[np.float64],
        singular_values: NDArray[np.float64],
        v: NDArray[np.float64],
    ) -> Svd3: ...
    @property
    def u(self) -> NDArray[np.float64]:
        """Left singular vectors in its columns, shape (3, 3)."""
    @property
    def singular_values(self) -> NDArray[np.float64]:
        """Largest first, none negative, shape (3,)."""
    @property
    def v(self) -> NDArray[np.float64]:
        """Right singular vectors in its columns, shape (3, 3)."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

def local_from_geodetic(place: Geodetic, origin: Geodetic) -> NDArray[np.float64]:
    """East, north and up of a place relative to another.

    Parameters
    ----------
    place, origin : Geodetic

    Returns
    -------
    ndarray, shape (3,)
        Meters.

    Raises
    ------
    ValueError
        Latitude outside -90° to 90°, or longitude outside -180° to 180°.
    """
def svd3(matrix: ArrayLike) -> Svd3:
    """Singular value decomposition of a matrix.

    Parameters
    ----------
    matrix : array_like, shape (3, 3)

    Returns
    -------
    Svd3
    """
def length(vector: ArrayLike) -> float:
    """Length of a vector.

    Parameters
    ----------
    vector : array_like, shape (N,)
        N from 1 to 4.

    Returns
    -------
    float

    Examples
    --------
    >>> length([3.0, 4.0])
    5.0
    """
@final
class Random:
    """Seeded stream of random numbers, equal on every platform.

    Parameters
    ----------
    seed : int
    """
    def __new__(cls, seed: int) -> Random: ...
    def below(self, bound: int) -> int:
        """Integer below a bound, which is > 0.

        Parameters
        ----------
        bound : int
            Upper end, > 0.

        Raises
        ------
        ValueError
            ``bound`` of 0.
        """
    def unit(self) -> float:
        """Number in [0, 1)."""
    def uniform(self, low: float, high: float) -> float:
        """Number in [low, high).

        Parameters
        ----------
        low, high : float
            Ends of the interval.
        """
    def normal(self) -> float:
        """Number of the standard normal distribution."""
