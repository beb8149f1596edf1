//! Triangulation: points from their images in two or more views.
//!
//! | method | views | takes | minimizes |
//! |---|---|---|---|
//! | [`triangulate_dlt`] | two | projection matrices | an algebraic error; fast |
//! | [`triangulate_midpoint`] | two | a motion and rays | the distance from both rays, in space |
//! | [`triangulate_angular`] | two | a motion and rays | the angles from both rays |
//! | [`triangulate_optimal`] | two | cameras | the reprojection error |
//! | [`triangulate_nview`] | two or more | cameras | the reprojection error, iteratively |
//!
//! Each takes only what it needs. Reprojection errors need cameras. Rays suffice for distances and
//! angles, so those methods work with any lens ([`Lens::ray`](crate::camera::Lens::ray)). The
//! linear transform needs no intrinsics, so it also accepts matrices derived from F; that of a
//! camera is [`projection_matrix`](crate::camera::PosedCamera::projection_matrix).
//!
//! Cameras at the same place see every point along the same rays. All methods reject them with
//! [`Error::Degenerate`](crate::Error::Degenerate), before they look at the pixels.

mod dlt;
mod midpoint;
mod null_point;
mod nview;
mod nview_problem;
mod optimal;
mod quality;
mod starts;

const NO_BASELINE: crate::Error = crate::Error::Degenerate {
    what: "the distance of a point",
    why: "the cameras are at the same place",
};

/// Error for a point whose coordinates overflow.
const BEYOND_NUMBERS: crate::Error = crate::Error::NotFinite {
    what: "each coordinate of the point",
};

pub use dlt::{triangulate_dlt, triangulate_dlt_all};
pub use midpoint::{triangulate_angular, triangulate_midpoint, triangulate_weighted_midpoint};
pub use nview::{NviewPoint, triangulate_nview, triangulate_nview_dlt};
pub use optimal::{correct_matches, triangulate_optimal};
pub use quality::{point_covariance, triangulation_angle_rad};
