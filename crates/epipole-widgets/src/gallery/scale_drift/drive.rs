//! A drive: the true path of the camera, and its estimate by odometry.

use epipole::camera::RigidTransform;
use epipole::math::random::Random;
use nalgebra::{Point3, Vector3};
use serde::{Deserialize, Serialize};
use std::f64::consts::FRAC_PI_2;
use std::ops::RangeInclusive;

/// Range of the number of steps of a drive, which is even.
pub(super) const STEPS: RangeInclusive<usize> = 40..=120;

/// Maximum number of steps per corner of the block.
const CORNER: usize = 5;
/// Ratio of the block's longer side to its shorter side.
const ASPECT: f64 = 1.5;

/// Errors of odometry in each step.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Errors {
    /// Relative growth of the scale per step.
    pub(super) rate: f64,
    /// Standard deviation of the random errors: relative for the scale, and an angle in radians.
    pub(super) noise: f64,
    /// Whether each step is measured in meters, which prevents scale errors from accumulating.
    pub(super) is_metric: bool,
    pub(super) seed: u64,
}

/// A drive once around the block; lengths are in true steps.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Drive {
    /// True `world_from_cam` of each frame; the last equals the first.
    pub(super) truth: Vec<RigidTransform>,
    /// Accumulated `world_from_cam` estimates of odometry.
    pub(super) believed: Vec<RigidTransform>,
    /// Scale of the reconstruction around each frame, relative to the truth.
    pub(super) scale: Vec<f64>,
}

impl Drive {
    /// Simulates a drive of `num_steps` steps, an even number.
    pub(super) fn new(num_steps: usize, errors: &Errors) -> Self {
        let mut random = Random::new(errors.seed);
        let mut truth = vec![RigidTransform::identity()];
        let mut believed = truth.clone();
        let mut scale = vec![1.0];
        for (index, turn) in turns(num_steps).into_iter().enumerate() {
            let (stretch, swerve) = (random.normal(), random.normal());
            let stretched = libm::exp(errors.noise * stretch);
            truth.push(truth[index] * step(1.0, turn));
            let turned = turn + errors.noise * swerve;
            if errors.is_metric {
                believed.push(believed[index] * step(stretched, turned));
                scale.push(1.0);
            } else {
                believed.push(believed[index] * step(scale[index], turned));
                scale.push(scale[index] * (1.0 + errors.rate) * stretched);
            }
        }
        Self {
            truth,
            believed,
            scale,
        }
    }

    /// Returns the index of the last frame.
    pub(super) fn last(&self) -> usize {
        self.truth.len() - 1
    }
}

/// Returns a step straight ahead followed by a left turn; y points down.
fn step(length: f64, left_rad: f64) -> RigidTransform {
    RigidTransform::new(
        Vector3::new(0.0, 0.0, length),
        Vector3::new(0.0, -left_rad, 0.0),
    )
}

/// Returns the left turn at each step, radians: around a block, starting in the middle of a long
/// side.
fn turns(num_steps: usize) -> Vec<f64> {
    let half = num_steps / 2;
    let corner = (num_steps / 16).clamp(1, CORNER);
    let straight = half - 2 * corner;
    let long = (straight as f64 * ASPECT / (1.0 + ASPECT)).round() as usize;
    // Two halves, equal up to a rotation by 180°, return to the start.
    let mut around = vec![0.0; long];
    around.extend(vec![FRAC_PI_2 / corner as f64; corner]);
    around.extend(vec![0.0; straight - long]);
    around.extend(vec![FRAC_PI_2 / corner as f64; corner]);
    let mut turns = around.repeat(2);
    turns.rotate_left(long / 2);
    turns
}

/// Returns the centers of cameras.
pub(super) fn centers(world_from_cam: &[RigidTransform]) -> Vec<Point3<f64>> {
    let center = |pose: &RigidTransform| Point3::from(pose.translation.vector);
    world_from_cam.iter().map(center).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const PERFECT: Errors = Errors {
        rate: 0.0,
        noise: 0.0,
        is_metric: false,
        seed: 1,
    };

    #[test]
    fn the_true_path_comes_home_and_has_steps_of_length_1() {
        for num_steps in [40, 42, 62, 80, 120] {
            let drive = Drive::new(num_steps, &PERFECT);
            assert_eq!(drive.last(), num_steps);
            let home = drive.truth[num_steps];
            assert!(home.translation.vector.norm() < 1e-12, "{num_steps}");
            assert!(home.rotation.angle() < 1e-12, "{num_steps}");
            for pair in centers(&drive.truth).windows(2) {
                assert!(((pair[1] - pair[0]).norm() - 1.0).abs() < 1e-12);
            }
            assert_eq!(drive.truth, drive.believed);
        }
    }

    #[test]
    fn scale_compounds_and_shows_in_the_length_of_steps() {
        let drive = Drive::new(
            80,
            &Errors {
                rate: 0.01,
                ..PERFECT
            },
        );
        // Python: 1.01 ** 80 and 1.01 ** 50
        assert!((drive.scale[80] - 2.216_715).abs() < 1e-6);
        let path = centers(&drive.believed);
        assert!(((path[51] - path[50]).norm() - 1.644_632).abs() < 1e-6);
    }

    #[test]
    fn the_scale_of_a_metric_path_stays_while_its_steps_are_noisy() {
        let drive = Drive::new(
            80,
            &Errors {
                rate: 0.02,
                noise: 0.01,
                is_metric: true,
                seed: 3,
            },
        );
        assert!(drive.scale.iter().all(|scale| *scale == 1.0));
        let path = centers(&drive.believed);
        let lengths = path.windows(2).map(|pair| (pair[1] - pair[0]).norm());
        let spread: f64 = lengths.map(|length| (length - 1.0) * (length - 1.0)).sum();
        let sigma = (spread / 80.0).sqrt();
        assert!((0.007..0.013).contains(&sigma), "{sigma}");
    }
}
