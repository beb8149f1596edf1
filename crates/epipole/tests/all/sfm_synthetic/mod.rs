//! Structure from motion and odometry on made worlds, where the truth is known.

mod along_the_way;
mod known_poses;
mod odometry;
mod reconstruction;
mod world;
