//! Synthetic scenes with random points and known cameras.
//!
//! The idea of generated datasets with noise and outliers for testing reconstruction is from
//! COLMAP's synthetic datasets; the generators here are our own.

mod multi_view;
mod two_view;

pub use multi_view::{MultiViewProblem, MultiViewProblemOptions, Path, Sighting};
pub use two_view::{TwoViewProblem, TwoViewProblemOptions};

use crate::camera::{Camera, Intrinsics, PosedCamera, look_at};
use crate::math::random::Random;
use crate::{Error, Result};
use nalgebra::{Point2, Point3, Vector3};

/// Structure of the points of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
pub enum Structure {
    /// Points in a cube.
    Cube {
        /// Half of the cube's side, meters.
        half_side_m: f64,
    },
    /// Points on a square plane, tilted by half a radian about the vertical: a homography explains
    /// everything.
    Plane {
        /// Half of the square's side, meters.
        half_side_m: f64,
    },
    /// Points on two perpendicular planes that meet in a vertical edge, like the corner of a house.
    Corner {
        /// Width and half height of each wall, meters.
        half_side_m: f64,
    },
}

impl Structure {
    fn half_side_m(self) -> f64 {
        match self {
            Self::Cube { half_side_m }
            | Self::Plane { half_side_m }
            | Self::Corner { half_side_m } => half_side_m,
        }
    }

    /// Draws a point around the world's origin, y down.
    fn draw(self, random: &mut Random) -> Point3<f64> {
        let half = self.half_side_m();
        let (a, b) = (random.uniform(-half, half), random.uniform(-half, half));
        match self {
            Self::Cube { .. } => Point3::new(a, b, random.uniform(-half, half)),
            Self::Plane { .. } => {
                let (sin, cos) = libm::sincos(0.5);
                Point3::new(a * cos, b, a * sin)
            }
            Self::Corner { .. } => {
                // The edge is closest to a camera at negative z; the walls recede from it.
                let diagonal = std::f64::consts::FRAC_1_SQRT_2;
                Point3::new(a * diagonal, b, (a.abs() - half / 2.0) * diagonal)
            }
        }
    }
}

/// Checks the common parameters of all scenes.
fn check_world(structure: Structure, noise_px: f64, outlier_fraction: f64) -> Result<()> {
    Error::check_range(
        "the half side of the structure",
        "between 0.001 and 1000 meters",
        structure.half_side_m(),
        1e-3..=1e3,
    )?;
    Error::check_range(
        "the noise",
        "between 0 and 100 pixels",
        noise_px,
        0.0..=100.0,
    )?;
    Error::check_range(
        "the fraction of outliers",
        "between 0 and 1",
        outlier_fraction,
        0.0..=1.0,
    )
}

/// Image size of all cameras of a scene: 640 × 480, focal length 600 px.
const WIDTH: u32 = 640;
const HEIGHT: u32 = 480;

fn intrinsics() -> Intrinsics {
    Intrinsics::centered(600.0, WIDTH, HEIGHT).expect("600 px is a focal length")
}

/// Returns an upright camera at a position that looks at a target.
fn camera_at(center: &Point3<f64>, target: &Point3<f64>) -> Result<PosedCamera> {
    Ok(PosedCamera {
        camera: Camera::pinhole(intrinsics(), 640, 480),
        cam_from_world: look_at(center, target, &Vector3::new(0.0, -1.0, 0.0))?,
    })
}

fn in_picture(pixel: &Point2<f64>) -> bool {
    (0.0..=f64::from(WIDTH - 1)).contains(&pixel.x)
        && (0.0..=f64::from(HEIGHT - 1)).contains(&pixel.y)
}

/// Returns the pixel of a point, if it is in the camera's image.
fn observe(camera: &PosedCamera, x_in_world: &Point3<f64>) -> Option<Point2<f64>> {
    camera.project(x_in_world).ok().filter(in_picture)
}

/// Draws points until `num` of them are seen: `observe` takes a point and its index, and returns
/// whether it is seen.
///
/// # Errors
/// `nothing` after a thousand attempts per point.
fn draw_points(
    random: &mut Random,
    structure: Structure,
    num: usize,
    nothing: Error,
    mut observe: impl FnMut(&mut Random, usize, &Point3<f64>) -> bool,
) -> Result<Vec<Point3<f64>>> {
    let mut points = Vec::new();
    let mut num_tries = 0;
    while points.len() < num {
        num_tries += 1;
        if num_tries > 1000 * (num + 1) {
            return Err(nothing);
        }
        let point = structure.draw(random);
        if observe(random, points.len(), &point) {
            points.push(point);
        }
    }
    Ok(points)
}

/// Returns a measurement of a pixel: with noise, or wrong.
fn measured(
    random: &mut Random,
    pixel: &Point2<f64>,
    noise_px: f64,
    is_inlier: bool,
) -> Point2<f64> {
    if !is_inlier {
        return wrong(random, pixel);
    }
    Point2::new(
        pixel.x + noise_px * random.normal(),
        pixel.y + noise_px * random.normal(),
    )
}

/// Returns a wrong pixel: anywhere in the image, but not near the true one.
fn wrong(random: &mut Random, right: &Point2<f64>) -> Point2<f64> {
    loop {
        let pixel = Point2::new(
            random.uniform(0.0, f64::from(WIDTH - 1)),
            random.uniform(0.0, f64::from(HEIGHT - 1)),
        );
        // Only a small disc is excluded, so this ends soon.
        if (pixel - right).norm() > 20.0 {
            return pixel;
        }
    }
}

/// Chooses which of `num` items are inliers: all but exactly `round(fraction × num)`, at random.
fn choose_inliers(random: &mut Random, num: usize, outlier_fraction: f64) -> Vec<bool> {
    let num_outliers = (outlier_fraction * num as f64).round() as usize;
    let mut is_inlier = vec![true; num];
    let mut order: Vec<usize> = (0..num).collect();
    for i in 0..num_outliers.min(num) {
        let other = i + random.below(num - i);
        order.swap(i, other);
        is_inlier[order[i]] = false;
    }
    is_inlier
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_number_of_outliers_is_exact() {
        let mut random = Random::new(1);
        for (num, fraction, expected) in [(10, 0.3, 3), (7, 1.0, 7), (5, 0.0, 0), (0, 0.5, 0)] {
            let inliers = choose_inliers(&mut random, num, fraction);
            assert_eq!(inliers.iter().filter(|inlier| !**inlier).count(), expected);
        }
    }

    #[test]
    fn structures_have_their_shape() {
        let mut random = Random::new(2);
        for _ in 0..100 {
            let on_plane = Structure::Plane { half_side_m: 2.0 }.draw(&mut random);
            assert!((on_plane.z - on_plane.x * libm::tan(0.5)).abs() < 1e-12);
            let corner = Structure::Corner { half_side_m: 2.0 }.draw(&mut random);
            let edge_z = -std::f64::consts::FRAC_1_SQRT_2;
            assert!((corner.z - edge_z - corner.x.abs()).abs() < 1e-12);
        }
    }
}
