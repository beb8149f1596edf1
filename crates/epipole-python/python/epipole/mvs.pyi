# Written by stubs.py. Do not edit.

from collections.abc import Callable, Sequence
from typing import ClassVar, final

import numpy as np
from numpy.typing import ArrayLike, NDArray
from typing_extensions import Unpack

from epipole import options as option_types
from epipole.camera import PosedCamera
from epipole.sfm import Reconstruction
from epipole.stereo import PointCloud

__all__ = [
    "DepthMap",
    "Mesh",
    "MeshTexture",
    "MvsView",
    "estimate_depth_maps",
    "fuse_depth_maps",
    "mesh_depth_maps",
    "prepare_views",
    "texture_mesh",
]

@final
class MvsView:
    """Undistorted photo with its neighbors and depth range.

    Parameters
    ----------
    photo : int
        Index of the image in the reconstruction.
    camera : PosedCamera
        Camera without distortion, with the size of the image.
    image : array_like of uint8, shape (H, W, 3)
        Red, green, blue.
    neighbors : list of int
        Indices of the views to compare with, best first.
    depth_range : tuple of float
        Minimum and maximum depth to search.
    """
    def __new__(
        cls,
        photo: int,
        camera: PosedCamera,
        image: ArrayLike,
        neighbors: Sequence[int],
        depth_range: tuple[float, float],
    ) -> MvsView: ...
    @property
    def photo(self) -> int:
        """Index of the image in the reconstruction."""
    @property
    def camera(self) -> PosedCamera:
        """Camera without distortion."""
    @property
    def image(self) -> NDArray[np.uint8]:
        """Undistorted pixels, uint8 of shape (H, W, 3)."""
    @property
    def neighbors(self) -> list[int]:
        """Indices of the views to compare with, best first."""
    @property
    def depth_range(self) -> tuple[float, float]:
        """Minimum and maximum depth to search."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class DepthMap:
    """Depth and normal of each pixel of a view.

    Parameters
    ----------
    depth : array_like of float, shape (H, W)
        Along the optical axis, in the unit of the reconstruction; NaN where unknown.
    normals : array_like, shape (H, W, 3)
        Unit normals in the camera's frame, towards the camera; zero where unknown.
    num_views : array_like of uint8, shape (H, W)
        Number of photos that agree on the depth, including this one; 0 where unknown.

    Examples
    --------
    >>> normals = np.array([[[0, 0, -1.0], [0, 0, 0]]])
    >>> DepthMap(np.array([[2.0, np.nan]]), normals, np.array([[3, 0]], np.uint8)).density
    0.5
    """
    def __new__(cls, depth: ArrayLike, normals: ArrayLike, num_views: ArrayLike) -> DepthMap: ...
    @property
    def depth(self) -> NDArray[np.float32]:
        """Depth along the optical axis, float32 of shape (H, W); NaN where unknown."""
    @property
    def normals(self) -> NDArray[np.float32]:
        """Unit normals in the camera's frame, float32 of shape (H, W, 3)."""
    @property
    def num_views(self) -> NDArray[np.uint8]:
        """Number of photos that agree on the depth, including this one, uint8 of shape (H, W)."""
    @property
    def density(self) -> float:
        """Fraction of pixels with a depth."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

def prepare_views(
    reconstruction: Reconstruction,
    photos: Sequence[ArrayLike],
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.MvsOptions],
) -> list[MvsView]:
    """Undistorts and downscales photos, and chooses neighbors and a depth range for each.

    Photos without common points with another one at a sufficient angle are skipped.

    Parameters
    ----------
    reconstruction : epipole.sfm.Reconstruction
    photos : list of array_like
        uint8 of shape (H, W, 3), one per image of the reconstruction, with its camera's size.
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : MvsOptions
        Relevant here are ``max_size_px``, ``num_neighbors`` and ``min_angle_deg``.

    Returns
    -------
    list of MvsView

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 2 images with a camera, or no points.
    epipole.DegenerateError
        If no two photos show the same points from different positions.
    ValueError
        If an option is out of range.
    """
def estimate_depth_maps(
    views: Sequence[MvsView],
    /,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.MvsOptions],
) -> list[DepthMap]:
    """Estimates depth and normal of each pixel of each view by PatchMatch.

    A depth is kept if enough views agree on it.

    Parameters
    ----------
    views : list of MvsView
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : MvsOptions

    Returns
    -------
    list of DepthMap

    Raises
    ------
    epipole.DegenerateError
        If a camera has distortion.
    ValueError
        If an option, neighbor or depth range is out of range.
    """
def fuse_depth_maps(
    views: Sequence[MvsView],
    maps: Sequence[DepthMap],
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.MvsOptions],
) -> PointCloud:
    """Fuses depth maps to a point cloud with normals, colors and confidences.

    Parameters
    ----------
    views : list of MvsView
    maps : list of DepthMap
        See `estimate_depth_maps`.
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : MvsOptions

    Returns
    -------
    epipole.stereo.PointCloud

    Raises
    ------
    ValueError
        If an option is out of range.
    """
@final
class Mesh:
    """Triangle mesh.

    Parameters
    ----------
    vertices : epipole.stereo.PointCloud
        Points with normals and colors.
    triangles : ndarray of uint32, shape (M, 3)
        Indices of the vertices, counterclockwise when viewed from outside.
    """
    def __new__(cls, vertices: PointCloud, triangles: NDArray[np.uint32]) -> Mesh: ...
    @property
    def vertices(self) -> PointCloud:
        """Vertices."""
    @property
    def triangles(self) -> NDArray[np.uint32]:
        """Indices of the vertices, uint32 of shape (M, 3), counterclockwise when viewed from outside."""
    def __eq__(self, other: object, /) -> bool: ...
    def __len__(self) -> int: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

def mesh_depth_maps(
    views: Sequence[MvsView],
    maps: Sequence[DepthMap],
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.MeshOptions],
) -> Mesh:
    """Fuses depth maps to a mesh with normals and colors.

    The surface has holes where no photo shows it.

    Parameters
    ----------
    views : list of MvsView
    maps : list of DepthMap
        See `estimate_depth_maps`.
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : MeshOptions

    Returns
    -------
    Mesh

    Raises
    ------
    epipole.TooFewError
        If no pixel has a depth.
    ValueError
        If the voxels are too small for the scene.
    """
@final
class MeshTexture:
    """Texture of a mesh: an image, with a pixel position for each corner of each triangle.

    Parameters
    ----------
    image
        Red, green and blue, uint8 of shape (H, W, 3).
    corners
        Pixel of each corner of each triangle, centers at integers, float32 of shape (M, 3, 2).
    """
    def __new__(cls, image: NDArray[np.uint8], corners: NDArray[np.float32]) -> MeshTexture: ...
    @property
    def image(self) -> NDArray[np.uint8]:
        """Red, green and blue, uint8 of shape (H, W, 3)."""
    @property
    def corners(self) -> NDArray[np.float32]:
        """Pixel of each corner of each triangle, centers at integers, float32 of shape (M, 3, 2)."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

def texture_mesh(
    mesh: Mesh,
    views: Sequence[MvsView],
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.TextureOptions],
) -> MeshTexture:
    """Textures a mesh with the photos.

    Each triangle is textured from the photo that shows it at the largest size, with few seams;
    colors are adjusted to agree along seams.

    Parameters
    ----------
    mesh : Mesh
    views : list of MvsView
        See `prepare_views`.
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : TextureOptions

    Returns
    -------
    MeshTexture

    Raises
    ------
    epipole.TooFewError
        If there are no views or no triangles.
    ValueError
        If an option is out of range, or a triangle refers to a missing vertex.
    """
