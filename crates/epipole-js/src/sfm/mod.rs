//! Structure from motion.

pub(crate) mod bundle;
pub(crate) mod photos;
pub(crate) mod pose_graph;
pub(crate) mod reconstruction;
pub(crate) mod two_view_reconstruction;
