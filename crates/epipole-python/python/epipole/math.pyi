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
    """Position on the earth (WGS 84).

    Parameters
    ----------
    latitude_deg : float
        Latitude north of the equator, degrees, -90 to 90.
    longitude_deg : float
        Longitude east of Greenwich, degrees, -180 to 180.
    height_m : float
        Height above the ellipsoid, meters.
    """
    def __new__(cls, latitude_deg: float, longitude_deg: float, height_m: float) -> Geodetic: ...
    @property
    def latitude_deg(self) -> float:
        """Latitude north of the equator, degrees."""
    @property
    def longitude_deg(self) -> float:
        """Longitude east of Greenwich, degrees."""
    @property
    def height_m(self) -> float:
        """Height above the ellipsoid, meters."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class Line2:
    """Line ``a*u + b*v + c == 0`` with ``a**2 + b**2 == 1``.

    Parameters
    ----------
    line : array_like, shape (3,)
        Homogeneous line, at any scale.

    Raises
    ------
    epipole.DegenerateError
        If the line is (0, 0, c).
    """
    def __new__(cls, line: ArrayLike) -> Line2: ...
    @property
    def line(self) -> NDArray[np.float64]:
        """(a, b, c), shape (3,)."""
    @property
    def a(self) -> float:
        """Component of the normal along u."""
    @property
    def b(self) -> float:
        """Component of the normal along v."""
    @property
    def c(self) -> float:
        """Negated signed distance of the origin along the normal."""
    def __eq__(self, other: object, /) -> bool: ...
    @staticmethod
    def from_homogeneous(line: ArrayLike) -> Line2:
        """Creates the line of a homogeneous vector.

        Parameters
        ----------
        line : array_like, shape (3,)
            At any scale.

        Raises
        ------
        epipole.DegenerateError
            If the line is (0, 0, c).
        """
    @staticmethod
    def through(p: ArrayLike, q: ArrayLike) -> Line2:
        """Creates the line through two points.

        Parameters
        ----------
        p, q : array_like, shape (2,)

        Raises
        ------
        epipole.DegenerateError
            If the points are equal.
        """
    def homogeneous(self) -> NDArray[np.float64]:
        """Returns (a, b, c), shape (3,)."""
    def signed_distance(self, point: ArrayLike) -> float:
        """Returns the signed distance of a point.

        Parameters
        ----------
        point : array_like, shape (2,)
        """
    def nearest(self, point: ArrayLike) -> NDArray[np.float64]:
        """Returns the point of the line nearest to a point.

        Parameters
        ----------
        point : array_like, shape (2,)

        Returns
        -------
        ndarray, shape (2,)
        """
    def angle_rad(self) -> float:
        """Returns the angle of the line to the u axis, radians."""
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class Svd3:
    """Singular value decomposition: ``A = u @ diag(singular_values) @ v.T``.

    Parameters
    ----------
    u
        Left singular vectors as columns, shape (3, 3).
    singular_values
        Singular values, largest first, none negative, shape (3,).
    v
        Right singular vectors as columns, shape (3, 3).
    """
    def __new__(
        cls,
        u: NDArray[np.float64],
        singular_values: NDArray[np.float64],
        v: NDArray[np.float64],
    ) -> Svd3: ...
    @property
    def u(self) -> NDArray[np.float64]:
        """Left singular vectors as columns, shape (3, 3)."""
    @property
    def singular_values(self) -> NDArray[np.float64]:
        """Singular values, largest first, none negative, shape (3,)."""
    @property
    def v(self) -> NDArray[np.float64]:
        """Right singular vectors as columns, shape (3, 3)."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

def local_from_geodetic(place: Geodetic, origin: Geodetic) -> NDArray[np.float64]:
    """Converts a position to east, north and up relative to an origin.

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
        If the latitude is outside -90° to 90°, or the longitude outside -180° to 180°.
    """
def svd3(matrix: ArrayLike) -> Svd3:
    """Computes the singular value decomposition of a matrix.

    Parameters
    ----------
    matrix : array_like, shape (3, 3)

    Returns
    -------
    Svd3
    """
def length(vector: ArrayLike) -> float:
    """Computes the length of a vector.

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
        """Returns an integer below a bound.

        Parameters
        ----------
        bound : int
            Upper bound, > 0, exclusive.

        Raises
        ------
        ValueError
            If ``bound`` is 0.
        """
    def unit(self) -> float:
        """Returns a number in [0, 1)."""
    def uniform(self, low: float, high: float) -> float:
        """Returns a number in [low, high).

        Parameters
        ----------
        low, high : float
            Bounds of the interval.
        """
    def normal(self) -> float:
        """Returns a number from the standard normal distribution."""
