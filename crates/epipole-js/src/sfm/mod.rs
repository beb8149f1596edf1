//! Structure from motion.

pub(crate) mod alignment;
pub(crate) mod bundle;
pub(crate) mod features;
pub(crate) mod known_poses;
pub(crate) mod loops;
pub(crate) mod odometry;
pub(crate) mod photos;
pub(crate) mod pose_graph;
pub(crate) mod reconstruction;
pub(crate) mod scene;
pub(crate) mod tracks;
pub(crate) mod two_view_reconstruction;
pub(crate) mod unregistered;
