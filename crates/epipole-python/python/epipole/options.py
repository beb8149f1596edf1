# Written by stubs.py. Do not edit.

"""Keyword options with their types and defaults, for annotations.

>>> from epipole.options import RansacOptions
>>> options: RansacOptions = {"max_error_px": 0.5, "seed": 3}

Each function takes them as keywords: ``estimate_fundamental(pixels1, pixels2, **options)``.
"""

from __future__ import annotations

from typing import Literal, TypedDict


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


class TwoViewOptions(TypedDict, total=False):
    ransac: RansacOptions
    min_num_inliers: int  # 15
    max_homography_share: float  # 0.8
    min_essential_share: float  # 0.95
