//! Integration tests of the library as one program, so that the generic code under test is compiled
//! once.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

mod absolute_pose_extremes;
mod absolute_pose_with_focal;
mod bundle_real;
mod calibration_real;
mod clustered_matches;
mod examples;
mod invariance_of_points;
mod javascript;
mod mvs_mesh;
mod mvs_rendered;
mod mvs_texture;
mod names;
mod nist_strd;
mod odometry_real;
mod options_in_files;
mod p3p_extremes;
mod pose_graph_real;
mod pose_with_focal;
mod ransac_options;
mod real_matches;
mod rectified_pair;
mod relative_pose;
mod relative_pose_with_gravity;
mod sfm_focal;
mod sfm_lenses;
mod sfm_real;
mod sfm_synthetic;
mod stereo_dense;
mod stereo_pixel_costs;
mod stereo_rectify;
mod threshold_from_noise;
mod triangulation_extremes;
mod two_view_exact;
mod two_view_geometry;
mod two_view_watched;
mod usac_grid;
