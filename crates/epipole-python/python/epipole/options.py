# Written by stubs.py. Do not edit.

"""Keyword options with their types and defaults, for annotations.

>>> from epipole.options import RansacOptions
>>> options: RansacOptions = {"max_error_px": 0.5, "seed": 3}

Each function takes them as keywords: ``estimate_fundamental(pixels1, pixels2, **options)``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal, TypedDict


class BundleOptions(TypedDict, total=False):
    lm: LmOptions
    loss: Literal["trivial"] | Mapping[str, Any]
    gauge: Literal["two_cameras", "free"]
    held_cameras: Sequence[bool]
    held_points: Sequence[bool]
    refine_focal: bool
    refine_principal_point: bool
    refine_distortion: bool
    refine_tangential: bool
    position_priors: Sequence[PositionPrior | None]
    position_loss: Literal["trivial"] | Mapping[str, Any]


class CalibrationOptions(TypedDict, total=False):
    lens: Literal["brown", "rational", "fisheye", "division"]  # 'brown'
    max_iterations: int  # 200


class DisparityFilter(TypedDict, total=False):
    uniqueness_percent: int
    left_right_max_px: int | None
    speckle_size: int
    speckle_range_px: float
    max_gap_px: int


class FeatureOptions(TypedDict, total=False):
    kind: Literal["sift", "root_sift", "orb", "harris"]  # 'root_sift'
    max_features: int  # 8192
    contrast_threshold: float | None  # None
    upright: bool  # False
    max_upsampled_pixels: int  # 1500000
    input_blur_px: float  # 0.5
    sigma_px: float  # 1.6
    layers_per_octave: int  # 3
    edge_threshold: float  # 10.0
    max_orientations: int  # 2
    orientation_peak_ratio: float  # 0.800000011920929
    num_levels: int  # 8
    scale_factor: float  # 1.2
    harris_k: float  # 0.03999999910593033
    min_distance_px: float  # 8.0
    tensor_window_px: int  # 3
    patch_px: int  # 11


class GoodFeaturesOptions(TypedDict, total=False):
    max_corners: int  # 1000
    quality: float  # 0.009999999776482582
    min_distance_px: float  # 8.0
    measure: Literal["shi_tomasi"] | Mapping[str, Any]  # 'shi_tomasi'
    tensor: StructureTensorOptions
    grid: Grid | None  # None


class Grid(TypedDict, total=False):
    columns: int
    rows: int


class LeastMedianOptions(TypedDict, total=False):
    num_samples: int  # 500
    seed: int  # 0


class LmOptions(TypedDict, total=False):
    max_iterations: int  # 50
    gradient_tolerance: float  # 1e-10
    step_tolerance: float  # 1e-10
    cost_tolerance: float  # 1e-09
    initial_damping: float  # 0.0001
    patience: int  # 0


class LocalizeOptions(TypedDict, total=False):
    matching: MatchOptions
    ransac: RansacOptions
    min_num_inliers: int  # 15


class MarkerOptions(TypedDict, total=False):
    max_hamming: int | None  # None
    border_bits: int  # 1
    min_side_px: float  # 0.0


class MatchOptions(TypedDict, total=False):
    max_ratio: float | None  # 0.800000011920929
    mutual: bool  # True
    max_distance: float | None  # None
    unique: bool  # True


class MeshOptions(TypedDict, total=False):
    voxel_size: float | None  # None
    voxel_size_px: float  # 1.5
    min_triangles: int  # 100


class MultiViewProblemOptions(TypedDict, total=False):
    num_cameras: int  # 8
    num_points: int  # 200
    structure: Mapping[str, Any]
    path: Mapping[str, Any]
    visible_fraction: float  # 1.0
    noise_px: float  # 0.0
    outlier_fraction: float  # 0.0
    seed: int  # 0


class MvsOptions(TypedDict, total=False):
    max_size_px: int  # 2048
    num_neighbors: int  # 6
    num_best_neighbors: int  # 3
    min_angle_deg: float  # 1.0
    num_rounds: int  # 1
    min_correlation: float  # 0.3
    min_views: int  # 3
    max_reprojection_error_px: float  # 1.0
    max_depth_difference: float  # 0.01
    max_normal_angle_deg: float  # 30.0
    seed: int  # 0


class OdometryOptions(TypedDict, total=False):
    sfm: SfmOptions
    window: int  # 8
    final_adjustment: bool  # True


class OrbOptions(TypedDict, total=False):
    max_features: int  # 1000
    scale_factor: float  # 1.2
    num_levels: int  # 8
    fast_threshold: float  # 0.0784313753247261
    upright: bool  # False


class OverlapOptions(TypedDict, total=False):
    ransac: RansacOptions
    min_num_inliers: int  # 12


class PhotoOptions(TypedDict, total=False):
    features: FeatureOptions
    matching: MatchOptions
    neighbors: int  # 0
    similar: int | None  # None
    best_first: bool  # False


class PositionPrior(TypedDict, total=False):
    center_in_world: Sequence[float]
    sigma: Sequence[float]


class RansacOptions(TypedDict, total=False):
    max_error_px: float  # 1.0
    threshold: Literal["given", "noise"]  # 'given'
    confidence: float  # 0.999
    min_iterations: int  # 200
    max_iterations: int  # 10000
    seed: int  # 0
    sampler: Literal["uniform", "prosac"]  # 'uniform'
    score: Literal["msac", "inlier_count"]  # 'msac'
    local_optimization: bool  # True
    inner_iterations: int  # 4
    budget: Literal["with_replacement", "without_replacement"]  # 'without_replacement'
    score_every_trial: bool  # False


class RectifyOptions(TypedDict, total=False):
    alpha: float  # 0.0
    size: Sequence[int] | None  # None
    zero_disparity_at_infinity: bool  # True


class RefineOptions(TypedDict, total=False):
    half_window: int  # 5
    max_iterations: int  # 40
    tolerance_px: float  # 0.001


class RenderOptions(TypedDict, total=False):
    surface: Literal["plane", "cylinder", "sphere"]  # 'cylinder'
    blend: Literal["bands", "feather", "seams"]  # 'bands'
    gains: bool  # True
    max_pixels: int  # 100000000


class SfmOptions(TypedDict, total=False):
    ransac: RansacOptions
    max_registration_error_px: float  # 6.0
    max_reprojection_error_px: float  # 4.0
    min_num_inliers: int  # 15
    min_angle_deg: float  # 1.5
    min_start_angle_deg: float  # 16.0
    min_track_length: int  # 2
    refine_focal: bool  # False
    refine_principal_point: bool  # False
    refine_distortion: bool  # False
    refine_tangential: bool  # False
    seed: int  # 0


class SiftOptions(TypedDict, total=False):
    max_features: int  # 0
    layers_per_octave: int  # 3
    sigma_px: float  # 1.6
    input_blur_px: float  # 0.3
    upsample: bool  # True
    contrast_threshold: float  # 0.03999999910593033
    edge_threshold: float  # 10.0
    max_orientations: int  # 2
    orientation_peak_ratio: float  # 0.800000011920929
    upright: bool  # False
    normalization: Literal["l2", "root"]  # 'l2'


class StereoBm(TypedDict, total=False):
    min_disparity_px: int  # 0
    num_disparities: int  # 64
    window_px: int  # 15
    prefilter: Literal["x_sobel", "local_mean"]  # 'x_sobel'
    prefilter_cap: int  # 31
    min_texture: float  # 0.5
    filter: DisparityFilter


class StereoSgm(TypedDict, total=False):
    min_disparity_px: int  # 0
    num_disparities: int  # 64
    cost: Literal["census", "birchfield_tomasi", "both"]  # 'both'
    gray_cap: int  # 30
    paths: Literal["four", "five", "eight"]  # 'eight'
    small_step_penalty: int  # 20
    large_step_penalty: int  # 100
    edge_gray: int  # 10
    filter: DisparityFilter


class StructureTensorOptions(TypedDict, total=False):
    derivative: Literal["sobel3", "sobel5", "scharr"]
    window: Mapping[str, Any]
    scaling: Literal["textbook", "open_cv"]
    border: Literal["replicate", "reflect101"] | Mapping[str, Any]


class TextureOptions(TypedDict, total=False):
    max_size_px: int  # 8192
    seam_cost: float  # 0.5


class TrackOptions(TypedDict, total=False):
    half_window: int  # 10
    num_levels: int  # 4
    max_iterations: int  # 30
    tolerance_px: float  # 0.01
    min_eigenvalue: float  # 1e-06
    max_forward_backward_px: float | None  # 1.0


class TwoViewOptions(TypedDict, total=False):
    ransac: RansacOptions
    min_num_inliers: int  # 15
    max_homography_ratio: float  # 0.8
    min_essential_ratio: float  # 0.95


class TwoViewProblemOptions(TypedDict, total=False):
    num_points: int  # 100
    structure: Mapping[str, Any]
    baseline_m: float  # 1.0
    distance_m: float  # 5.0
    noise_px: float  # 0.0
    outlier_fraction: float  # 0.0
    seed: int  # 0


class TwoViewReconstructionOptions(TypedDict, total=False):
    min_angle_rad: float  # 0.008726646259971648
    max_error_px: float  # 4.0
    min_num_points: int  # 15
    bundle: BundleOptions


class WarpOptions(TypedDict, total=False):
    width: int  # 0
    height: int  # 0
    interpolation: Literal["bilinear", "bicubic"]  # 'bilinear'
    border: Literal["replicate", "reflect101"] | Mapping[str, Any]
