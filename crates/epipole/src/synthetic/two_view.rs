//! Two cameras and their common points.

use super::{
    Structure, WIDTH, camera_at, check_world, choose_inliers, draw_points, measured, observe,
};
use crate::camera::PosedCamera;
use crate::math::random::Random;
use crate::{Error, Result};
use derive_setters::Setters;
use nalgebra::{Point2, Point3};

/// Options of a [`TwoViewProblem`].
#[derive(Debug, Clone, Copy, PartialEq, Setters)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct TwoViewProblemOptions {
    /// Number of matches, including outliers.
    pub num_points: usize,
    /// Structure of the points, around the world's origin.
    pub structure: Structure,
    /// Distance between the camera centers, meters; 0 for a pure rotation.
    pub baseline_m: f64,
    /// Distance of the first camera from the world's origin, meters.
    pub distance_m: f64,
    /// Standard deviation of the Gaussian noise of each pixel coordinate, pixels.
    pub noise_px: f64,
    /// Fraction of the matches with a wrong second pixel, 0 to 1.
    pub outlier_fraction: f64,
    /// Seed of all randomness.
    pub seed: u64,
}

impl Default for TwoViewProblemOptions {
    /// Returns a hundred noise-free matches of a cube of 2 m, seen from 5 m with a baseline of 1 m.
    fn default() -> Self {
        Self {
            num_points: 100,
            structure: Structure::Cube { half_side_m: 1.0 },
            baseline_m: 1.0,
            distance_m: 5.0,
            noise_px: 0.0,
            outlier_fraction: 0.0,
            seed: 0,
        }
    }
}

/// Matches between two images of 640 × 480 pixels, with ground truth.
#[derive(Debug, Clone, PartialEq)]
pub struct TwoViewProblem {
    /// The first camera, at (0, 0, −distance), which looks along +z.
    pub camera1: PosedCamera,
    /// The second camera, to the right of the first, which looks at the world's origin.
    pub camera2: PosedCamera,
    /// Measured pixels in the first image.
    pub pixels1: Vec<Point2<f64>>,
    /// Their matches in the second image.
    pub pixels2: Vec<Point2<f64>>,
    /// Whether a match is correct up to noise. A wrong one is at least 20 px from the true pixel,
    /// but may lie on the epipolar line by chance.
    pub is_inlier: Vec<bool>,
    /// The points, in the world; for an outlier the point of its first pixel.
    pub points: Vec<Point3<f64>>,
}

impl TwoViewProblem {
    /// Draws a problem.
    ///
    /// # Errors
    /// [`Error::NotFinite`] or [`Error::OutOfRange`] for invalid options; [`Error::Degenerate`] if
    /// the cameras' overlap is too small for `num_points` points.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::synthetic::{TwoViewProblemOptions, TwoViewProblem};
    /// let options = TwoViewProblemOptions::default().with_outlier_fraction(0.3);
    /// let problem = TwoViewProblem::new(&options)?;
    /// assert_eq!(problem.is_inlier.iter().filter(|inlier| **inlier).count(), 70);
    /// // Without noise an inlier's pixels are the projections of its point.
    /// let i = problem.is_inlier.iter().position(|inlier| *inlier).unwrap_or(0);
    /// assert_eq!(problem.camera2.project(&problem.points[i])?, problem.pixels2[i]);
    /// # Ok(()) }
    /// ```
    pub fn new(options: &TwoViewProblemOptions) -> Result<Self> {
        check_world(
            options.structure,
            options.noise_px,
            options.outlier_fraction,
        )?;
        Error::check_range(
            "the baseline",
            "between 0 and 1000 meters",
            options.baseline_m,
            0.0..=1e3,
        )?;
        Error::check_range(
            "the distance",
            "between 0.001 and 10 000 meters",
            options.distance_m,
            1e-3..=1e4,
        )?;
        // On a circle around the origin, at equal distances.
        let sin = (options.baseline_m / (2.0 * options.distance_m)).min(1.0);
        let (chord_sin, chord_cos) = libm::sincos(2.0 * libm::asin(sin));
        let center1 = Point3::new(0.0, 0.0, -options.distance_m);
        let center2 = Point3::new(chord_sin, 0.0, -chord_cos) * options.distance_m;
        let camera1 = camera_at(&center1, &Point3::origin())?;
        let camera2 = if options.baseline_m == 0.0 {
            // A tenth of the field of view to the right.
            let target = f64::from(WIDTH) / 6000.0 * options.distance_m;
            camera_at(&center1, &Point3::new(target, 0.0, 0.0))?
        } else {
            camera_at(&center2, &Point3::origin())?
        };
        let mut random = Random::new(options.seed);
        let is_inlier = choose_inliers(&mut random, options.num_points, options.outlier_fraction);
        let (mut pixels1, mut pixels2) = (Vec::new(), Vec::new());
        let nothing = Error::Degenerate {
            what: "a problem of two views",
            why: "the two cameras see too little in common",
        };
        let (num, noise_px) = (options.num_points, options.noise_px);
        let points = draw_points(
            &mut random,
            options.structure,
            num,
            nothing,
            |random, i, point| {
                let pixels = observe(&camera1, point).zip(observe(&camera2, point));
                if let Some((pixel1, pixel2)) = pixels {
                    pixels2.push(measured(random, &pixel2, noise_px, is_inlier[i]));
                    pixels1.push(measured(random, &pixel1, noise_px, true));
                }
                pixels.is_some()
            },
        )?;
        Ok(Self {
            camera1,
            camera2,
            pixels1,
            pixels2,
            is_inlier,
            points,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{cross_matrix, relative_motion};

    #[test]
    fn inliers_fulfill_the_epipolar_constraint_and_outliers_do_not() {
        let options = TwoViewProblemOptions {
            num_points: 400,
            outlier_fraction: 0.25,
            seed: 3,
            ..TwoViewProblemOptions::default()
        };
        let problem = TwoViewProblem::new(&options).unwrap();
        let (camera1, camera2) = (&problem.camera1, &problem.camera2);
        let baseline = camera2.center_in_world() - camera1.center_in_world();
        assert!((baseline.norm() - 1.0).abs() < 1e-12);
        let motion = relative_motion(&camera1.cam_from_world, &camera2.cam_from_world);
        let essential = cross_matrix(&motion.translation.vector)
            * motion.rotation.to_rotation_matrix().into_inner();
        let k_inverse = camera1.camera.intrinsics.inverse_matrix();
        let f = k_inverse.transpose() * essential * k_inverse;
        let mut num_off = 0;
        for i in 0..400 {
            let line = f * problem.pixels1[i].to_homogeneous();
            let distance_px = line.dot(&problem.pixels2[i].to_homogeneous()).abs()
                / (line.x * line.x + line.y * line.y).sqrt();
            if problem.is_inlier[i] {
                assert!(distance_px < 1e-9, "{i}: {distance_px}");
            } else {
                num_off += usize::from(distance_px > 2.0);
            }
        }
        // By chance about 4/480 of the outliers lie within 2 px of their line.
        assert!(num_off >= 95, "{num_off} of 100");
    }

    #[test]
    fn the_noise_has_its_size_and_the_seed_decides() {
        let options = TwoViewProblemOptions {
            num_points: 2000,
            noise_px: 0.5,
            seed: 8,
            ..TwoViewProblemOptions::default()
        };
        let problem = TwoViewProblem::new(&options).unwrap();
        let sum_sq: f64 = (0..2000)
            .map(|i| {
                let exact = problem.camera1.project(&problem.points[i]).unwrap();
                (problem.pixels1[i] - exact).norm_squared()
            })
            .sum();
        assert!(((sum_sq / 4000.0).sqrt() - 0.5).abs() < 0.02);
        assert_eq!(problem, TwoViewProblem::new(&options).unwrap());
        let other = TwoViewProblemOptions { seed: 9, ..options };
        assert_ne!(problem, TwoViewProblem::new(&other).unwrap());
    }

    #[test]
    fn a_rotating_camera_stays_in_its_place() {
        let options = TwoViewProblemOptions {
            baseline_m: 0.0,
            ..TwoViewProblemOptions::default()
        };
        let problem = TwoViewProblem::new(&options).unwrap();
        let moved = problem.camera2.center_in_world() - problem.camera1.center_in_world();
        assert!(moved.norm() < 1e-12);
        assert_ne!(problem.camera1, problem.camera2);
    }

    #[test]
    fn senseless_options_are_refused() {
        let good = TwoViewProblemOptions::default();
        for bad in [
            TwoViewProblemOptions {
                noise_px: f64::NAN,
                ..good
            },
            TwoViewProblemOptions {
                outlier_fraction: 1.5,
                ..good
            },
            TwoViewProblemOptions {
                baseline_m: -1.0,
                ..good
            },
            TwoViewProblemOptions {
                distance_m: 0.0,
                ..good
            },
        ] {
            assert!(TwoViewProblem::new(&bad).is_err(), "{bad:?}");
        }
        // A tiny object very far away still projects to one pixel, without an error.
        assert!(
            TwoViewProblem::new(&TwoViewProblemOptions {
                distance_m: 1e4,
                ..good
            })
            .is_ok()
        );
        let empty = TwoViewProblemOptions {
            num_points: 0,
            ..good
        };
        assert!(TwoViewProblem::new(&empty).unwrap().points.is_empty());
    }
}
