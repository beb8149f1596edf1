//! Texts of trajectories.

use super::format::TrajectoryFormat;
use super::path::Trajectory;
use super::{euroc, kitti, tum};
use crate::{Error, Result};

/// Writes a trajectory. Numbers have all digits; KITTI's format has no times.
///
/// # Errors
/// [`Error::Unsupported`] for TUM and EuRoC unless the trajectory has a time for each pose.
///
/// ```
/// # fn main() -> Result<(), epipole_io::Error> {
/// use epipole::camera::RigidTransform;
/// use epipole_io::trajectory::{Trajectory, TrajectoryFormat, write_trajectory};
/// let trajectory = Trajectory {
///     stamps_ns: Some(vec![500_000_000]),
///     world_from_cam: vec![RigidTransform::translation(1.0, 2.0, 3.0)],
///     ..Trajectory::default()
/// };
/// let text = write_trajectory(TrajectoryFormat::Tum, &trajectory)?;
/// assert_eq!(text.lines().last(), Some("0.5 1 2 3 0 0 0 1"));
/// # Ok(()) }
/// ```
pub fn write_trajectory(format: TrajectoryFormat, trajectory: &Trajectory) -> Result<String> {
    let stamps = || {
        let stamps = trajectory.stamps_ns.as_deref();
        stamps
            .filter(|stamps| stamps.len() == trajectory.world_from_cam.len())
            .ok_or_else(|| {
                Error::unsupported(format!(
                    "{} needs a time for each pose, and these poses have none: images that are named by their times, such \
                     as 1305031102.175304.png, give them; KITTI needs none",
                    format.name()
                ))
            })
    };
    Ok(match format {
        TrajectoryFormat::Tum => tum::write(stamps()?, trajectory),
        TrajectoryFormat::EuRoC => euroc::write(stamps()?, trajectory),
        TrajectoryFormat::Kitti => kitti::write(trajectory),
    })
}
