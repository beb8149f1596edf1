//! Points from their images in two or more views.
//!
//! | method | views | minimizes |
//! |---|---|---|
//! | [`triangulate_dlt`] | two | an algebraic error; fast |
//! | [`triangulate_midpoint`] | two | the distance from both rays, in space |
//! | [`triangulate_angular`] | two | the angles from both rays |
//! | [`triangulate_optimal`] | two | the reprojection error |
//! | [`triangulate_nview`] | two or more | the reprojection error, iteratively |

mod dlt;
mod midpoint;
mod nview;
mod optimal;
mod quality;

pub use dlt::{triangulate_dlt, triangulate_dlt_all};
pub use midpoint::{triangulate_angular, triangulate_midpoint, triangulate_weighted_midpoint};
pub use nview::{NviewPoint, triangulate_nview, triangulate_nview_dlt};
pub use optimal::{correct_matches, triangulate_optimal};
pub use quality::{point_covariance, triangulation_angle_rad};
