//! Many cameras on a path around the points.

use super::{Structure, camera_at, check_world, choose_inliers, draw_points, measured, observe};
use crate::camera::PosedCamera;
use crate::math::random::Random;
use crate::{Error, Result};
use derive_setters::Setters;
use nalgebra::{Point2, Point3, Vector3};

/// Positions of the cameras of a world.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
pub enum Path {
    /// Arc around the world's origin, with cameras looking at it; `span_rad` = 2π closes the
    /// circle.
    Arc {
        /// Distance from the origin, meters.
        radius_m: f64,
        /// Angle from the first to the last camera (for 2π: to the first again), radians.
        span_rad: f64,
    },
    /// Straight line along x at a distance in front of the points, with cameras looking along +z.
    Line {
        /// Distance from the origin, meters.
        distance_m: f64,
        /// Distance between consecutive cameras, meters.
        spacing_m: f64,
    },
}

/// Options of a [`MultiViewProblem`].
#[derive(Debug, Clone, Copy, PartialEq, Setters)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct MultiViewProblemOptions {
    /// Number of cameras, at least 2.
    pub num_cameras: usize,
    /// Number of points; each is seen by at least two cameras.
    pub num_points: usize,
    /// Structure of the points, around the world's origin.
    pub structure: Structure,
    /// Positions of the cameras.
    pub path: Path,
    /// Fraction of the observations made, 0 to 1; 1 for every point in every image.
    pub visible_fraction: f64,
    /// Standard deviation of the Gaussian noise of each pixel coordinate, pixels.
    pub noise_px: f64,
    /// Fraction of the observations with a wrong pixel, 0 to 1.
    pub outlier_fraction: f64,
    /// Seed of all randomness.
    pub seed: u64,
}

impl Default for MultiViewProblemOptions {
    /// Returns eight cameras on an arc of a radian and 200 points of a cube, without noise.
    fn default() -> Self {
        Self {
            num_cameras: 8,
            num_points: 200,
            structure: Structure::Cube { half_side_m: 1.0 },
            path: Path::Arc {
                radius_m: 5.0,
                span_rad: 1.0,
            },
            visible_fraction: 1.0,
            noise_px: 0.0,
            outlier_fraction: 0.0,
            seed: 0,
        }
    }
}

/// A point seen by a camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sighting {
    /// Index of the camera.
    pub camera: usize,
    /// Index of the point.
    pub point: usize,
    /// The measured pixel.
    pub pixel: Point2<f64>,
    /// Whether it is correct up to noise; a wrong one is at least 20 px off.
    pub is_inlier: bool,
}

/// Cameras, points and observations, in images of 640 × 480 pixels.
#[derive(Debug, Clone, PartialEq)]
pub struct MultiViewProblem {
    /// The true cameras.
    pub cameras: Vec<PosedCamera>,
    /// The true points, in the world.
    pub points: Vec<Point3<f64>>,
    /// All observations, sorted by point, then by camera.
    pub observations: Vec<Sighting>,
}

impl MultiViewProblem {
    /// Draws a problem.
    ///
    /// # Errors
    /// [`Error::TooFew`] for fewer than two cameras; [`Error::NotFinite`] or [`Error::OutOfRange`]
    /// for invalid options; [`Error::Degenerate`] if too few points are seen twice.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::synthetic::{MultiViewProblemOptions, MultiViewProblem};
    /// let problem = MultiViewProblem::new(&MultiViewProblemOptions::default())?;
    /// // The whole cube is in every image.
    /// assert_eq!(problem.observations.len(), 8 * 200);
    /// let observation = problem.observations[17];
    /// let exact = problem.cameras[observation.camera].project(&problem.points[observation.point])?;
    /// assert_eq!(exact, observation.pixel);
    /// # Ok(()) }
    /// ```
    pub fn new(options: &MultiViewProblemOptions) -> Result<Self> {
        if options.num_cameras < 2 {
            return Err(Error::TooFew {
                what: "a problem of several views",
                needed: 2,
                got: options.num_cameras,
            });
        }
        check_world(
            options.structure,
            options.noise_px,
            options.outlier_fraction,
        )?;
        Error::check_range(
            "the visible fraction",
            "between 0 and 1",
            options.visible_fraction,
            0.0..=1.0,
        )?;
        let cameras = cameras(options)?;
        let mut random = Random::new(options.seed);
        let mut exact = Vec::new();
        let nothing = Error::Degenerate {
            what: "a problem of several views",
            why: "too few points are seen by two cameras",
        };
        let num = options.num_points;
        let points = draw_points(
            &mut random,
            options.structure,
            num,
            nothing,
            |random, i, point| {
                let projected: Vec<_> = (cameras.iter().enumerate())
                    .filter_map(|(camera, view)| Some((camera, i, observe(view, point)?)))
                    .filter(|_| random.unit() < options.visible_fraction)
                    .collect();
                let is_observed = projected.len() >= 2;
                if is_observed {
                    exact.extend(projected);
                }
                is_observed
            },
        )?;
        let is_inlier = choose_inliers(&mut random, exact.len(), options.outlier_fraction);
        let observations = exact
            .into_iter()
            .zip(is_inlier)
            .map(|((camera, point, pixel), is_inlier)| Sighting {
                camera,
                point,
                pixel: measured(&mut random, &pixel, options.noise_px, is_inlier),
                is_inlier,
            })
            .collect();
        Ok(Self {
            cameras,
            points,
            observations,
        })
    }

    /// Returns the tracks: the observations of each point, as ranges into
    /// [`MultiViewProblem::observations`].
    pub fn tracks(&self) -> Vec<std::ops::Range<usize>> {
        let mut start = 0;
        (0..self.points.len())
            .map(|point| {
                let rest = &self.observations[start..];
                let length = rest
                    .iter()
                    .take_while(|observation| observation.point == point)
                    .count();
                start += length;
                start - length..start
            })
            .collect()
    }
}

fn cameras(options: &MultiViewProblemOptions) -> Result<Vec<PosedCamera>> {
    let num = options.num_cameras as f64;
    match options.path {
        Path::Arc { radius_m, span_rad } => {
            let circle = std::f64::consts::TAU;
            Error::check_range(
                "the radius of the path",
                "between 0.001 and 10 000 meters",
                radius_m,
                1e-3..=1e4,
            )?;
            Error::check_range(
                "the span of the path",
                "between 0 and 2π radians",
                span_rad,
                0.0..=circle,
            )?;
            // The last camera of a full circle must not coincide with the first.
            let num_steps = if span_rad < circle { num - 1.0 } else { num };
            (0..options.num_cameras)
                .map(|i| {
                    let angle = span_rad * (i as f64 / num_steps - 0.5);
                    let (sin, cos) = libm::sincos(angle);
                    let center = Point3::new(sin, -0.15, -cos) * radius_m;
                    camera_at(&center, &Point3::origin())
                })
                .collect()
        }
        Path::Line {
            distance_m,
            spacing_m,
        } => {
            Error::check_range(
                "the distance of the path",
                "between 0.001 and 10 000 meters",
                distance_m,
                1e-3..=1e4,
            )?;
            Error::check_range(
                "the spacing of the cameras",
                "between 0 and 1000 meters",
                spacing_m,
                0.0..=1e3,
            )?;
            (0..options.num_cameras)
                .map(|i| {
                    let x = spacing_m * (i as f64 - (num - 1.0) / 2.0);
                    let center = Point3::new(x, 0.0, -distance_m);
                    camera_at(&center, &(center + Vector3::z()))
                })
                .collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tracks_partition_the_observations() {
        let options = MultiViewProblemOptions {
            visible_fraction: 0.6,
            noise_px: 0.4,
            outlier_fraction: 0.1,
            seed: 5,
            ..MultiViewProblemOptions::default()
        };
        let problem = MultiViewProblem::new(&options).unwrap();
        let tracks = problem.tracks();
        assert_eq!(tracks.len(), 200);
        let mut next = 0;
        for (point, track) in tracks.into_iter().enumerate() {
            assert_eq!(track.start, next);
            assert!(track.len() >= 2);
            next = track.end;
            let observations = &problem.observations[track];
            assert!(
                observations
                    .iter()
                    .all(|observation| observation.point == point)
            );
            assert!(
                observations
                    .windows(2)
                    .all(|pair| pair[0].camera < pair[1].camera)
            );
        }
        assert_eq!(next, problem.observations.len());
        let fraction = next as f64 / 1600.0;
        assert!((fraction - 0.6).abs() < 0.05, "{fraction}");
        for observations in &problem.observations {
            let exact = problem.cameras[observations.camera]
                .project(&problem.points[observations.point])
                .unwrap();
            let error_px = (observations.pixel - exact).norm();
            assert_eq!(observations.is_inlier, error_px < 5.0, "{error_px}");
        }
    }

    #[test]
    fn a_full_circle_has_no_camera_twice() {
        let options = MultiViewProblemOptions {
            path: Path::Arc {
                radius_m: 4.0,
                span_rad: std::f64::consts::TAU,
            },
            ..MultiViewProblemOptions::default()
        };
        let problem = MultiViewProblem::new(&options).unwrap();
        let centers: Vec<_> = problem
            .cameras
            .iter()
            .map(PosedCamera::center_in_world)
            .collect();
        for i in 0..8 {
            for j in 0..i {
                assert!((centers[i] - centers[j]).norm() > 1.0);
            }
        }
    }

    #[test]
    fn cameras_on_a_line_look_ahead() {
        let options = MultiViewProblemOptions {
            num_cameras: 3,
            path: Path::Line {
                distance_m: 6.0,
                spacing_m: 0.5,
            },
            ..MultiViewProblemOptions::default()
        };
        let problem = MultiViewProblem::new(&options).unwrap();
        let center = problem.cameras[2].center_in_world();
        assert!((center - Point3::new(0.5, 0.0, -6.0)).norm() < 1e-12);
        assert!(problem.cameras[2].cam_from_world.rotation.angle() < 1e-12);
    }

    #[test]
    fn senseless_options_are_refused() {
        let good = MultiViewProblemOptions::default();
        for bad in [
            MultiViewProblemOptions {
                num_cameras: 1,
                ..good
            },
            MultiViewProblemOptions {
                visible_fraction: 0.0,
                ..good
            },
            MultiViewProblemOptions {
                outlier_fraction: -0.1,
                ..good
            },
            MultiViewProblemOptions {
                noise_px: f64::INFINITY,
                ..good
            },
            MultiViewProblemOptions {
                path: Path::Line {
                    distance_m: 6.0,
                    spacing_m: 900.0,
                },
                ..good
            },
        ] {
            assert!(MultiViewProblem::new(&bad).is_err(), "{bad:?}");
        }
    }
}
