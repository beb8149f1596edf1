//! Least-squares fit of a pose to all points, on a plane or not.

use super::dlt::pose_dlt;
use super::p3p::pose_p3p;
use super::refine::refine_absolute_pose;
use crate::camera::{Camera, RigidTransform};
use crate::optim::RobustLoss;
use crate::{Error, Result};
use nalgebra::{Point2, Point3, Vector3};

const WHAT: &str = "a camera pose from points";

/// Relative distance from a line below which points count as collinear.
const FLAT: f64 = 1e-9;

/// Number of P3P poses to refine. For a plane two of them lead to minima, and with noise the wrong
/// one may have the lower initial cost.
const STARTS: usize = 4;

/// Fits the pose with the smallest sum of squared reprojection errors over all points, which may
/// lie on a plane. There is no outlier rejection: see
/// [`estimate_absolute_pose`](super::estimate_absolute_pose) for matches with outliers.
///
/// * `points_in_world`, `pixels`: points and their projections, at least 4
/// * `camera`: with any lens
///
/// Returns `cam_from_world`. Initial poses come from triples of four distant points by
/// [`pose_p3p`], and, from six points on, one from [`pose_dlt`]; the best of them are refined, and
/// the best result is returned. A small or distant plane has two poses that fit nearly as well; the
/// better one is returned.
///
/// # Errors
/// [`Error::TooFew`] for fewer than 4 points, [`Error::SizeMismatch`] for lists of different
/// length, [`Error::NotFinite`] for NaN and infinities, [`Error::Degenerate`] if all points are on
/// one line, or no pose has them all in front of the camera; as [`Camera::unproject`] for a pixel
/// without a ray.
///
/// Source: Hartley & Zisserman 2004, §7.2 (the error); Schweighofer & Pinz 2006, "Robust pose
/// estimation from a planar target" (the two minima).
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::absolute_pose::fit_absolute_pose;
/// use epipole::camera::{Camera, Intrinsics, RigidTransform};
/// use nalgebra::{Point3, Vector3};
/// let camera = Camera::pinhole(Intrinsics::new(700.0, 700.0, 320.0, 240.0)?, 640, 480);
/// let cam_from_world = RigidTransform::new(Vector3::new(0.1, -0.2, 6.0), Vector3::new(0.1, 0.4, 0.3));
/// // A board: z = 0.
/// let points: Vec<_> = (0..12).map(|i| Point3::new(f64::from(i % 4), f64::from(i / 4), 0.0)).collect();
/// let pixels: Vec<_> = points.iter().map(|x| camera.project(&(cam_from_world * x))).collect::<Result<_, _>>()?;
/// let found = fit_absolute_pose(&points, &pixels, &camera)?;
/// assert!(found.rotation.angle_to(&cam_from_world.rotation) < 1e-7);
/// assert!((found.translation.vector - cam_from_world.translation.vector).norm() < 1e-7);
/// # Ok(()) }
/// ```
#[doc(alias = "solvePnP")]
pub fn fit_absolute_pose(
    points_in_world: &[Point3<f64>],
    pixels: &[Point2<f64>],
    camera: &Camera,
) -> Result<RigidTransform> {
    if points_in_world.len() != pixels.len() {
        return Err(Error::SizeMismatch {
            what: "the list of points and that of their pixels",
            first: points_in_world.len(),
            second: pixels.len(),
        });
    }
    if pixels.len() < 4 {
        return Err(Error::TooFew {
            what: WHAT,
            needed: 4,
            got: pixels.len(),
        });
    }
    let finite = |x: &f64| x.is_finite();
    if !points_in_world.iter().all(|p| p.iter().all(finite))
        || !pixels.iter().all(|p| p.iter().all(finite))
    {
        return Err(Error::NotFinite {
            what: "a point or its pixel",
        });
    }
    let rays: Result<Vec<Vector3<f64>>> = pixels.iter().map(|p| camera.ray(p)).collect();
    let rays = rays?;
    let four = far_apart(points_in_world).ok_or(Error::Degenerate {
        what: WHAT,
        why: "all points are on one line",
    })?;
    let cost = |pose: &RigidTransform| -> f64 {
        let error_sq = |(x, pixel): (&Point3<f64>, &Point2<f64>)| {
            let projected = camera.project(&(pose * x));
            projected.map_or(f64::INFINITY, |projected| {
                (projected - pixel).norm_squared()
            })
        };
        points_in_world.iter().zip(pixels).map(error_sq).sum()
    };
    let mut starts: Vec<(f64, RigidTransform)> = Vec::new();
    for left_out in 0..4 {
        let [a, b, c] = [1, 2, 3].map(|i| four[(left_out + i) % 4]);
        let poses = pose_p3p(
            &[rays[a], rays[b], rays[c]],
            &[points_in_world[a], points_in_world[b], points_in_world[c]],
        );
        starts.extend(poses.into_iter().map(|pose| (cost(&pose), pose)));
    }
    // Drop NaN costs.
    starts.retain(|(cost, _)| *cost < f64::INFINITY);
    starts.sort_by(|a, b| a.0.total_cmp(&b.0));
    starts.truncate(STARTS);
    if pixels.len() >= 6 {
        let straight: Result<Vec<_>> = pixels.iter().map(|p| camera.pinhole_pixel(p)).collect();
        let linear =
            straight.and_then(|pixels| pose_dlt(points_in_world, &pixels, &camera.intrinsics));
        starts.extend(linear.map(|pose| (cost(&pose), pose)));
    }
    let refined = starts.iter().flat_map(|(at_start, start)| {
        let found =
            refine_absolute_pose(start, points_in_world, pixels, camera, RobustLoss::Trivial);
        let found = found.ok().map(|pose| (cost(&pose), pose));
        [found, Some((*at_start, *start))].into_iter().flatten()
    });
    refined
        .filter(|(cost, _)| *cost < f64::INFINITY)
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, pose)| pose)
        .ok_or(Error::Degenerate {
            what: WHAT,
            why: "no pose has all points in front of the camera",
        })
}

/// Returns four points far from one another, the first three not on a line; `None` if all are
/// collinear.
fn far_apart(points: &[Point3<f64>]) -> Option<[usize; 4]> {
    let farthest = |distance: &dyn Fn(&Point3<f64>) -> f64| -> usize {
        let distances: Vec<f64> = points.iter().map(distance).collect();
        let by_distance = |&a: &usize, &b: &usize| distances[a].total_cmp(&distances[b]);
        (0..points.len()).max_by(by_distance).unwrap_or(0)
    };
    let a = farthest(&|p| (p - points[0]).norm());
    let b = farthest(&|p| (p - points[a]).norm());
    let along = points[b] - points[a];
    let off = |p: &Point3<f64>| along.cross(&(p - points[a])).norm();
    let c = farthest(&off);
    // Also false if all points are equal, or so far apart that products overflow.
    let triangle = off(&points[c]);
    let is_flat = triangle <= FLAT * along.norm_squared();
    if is_flat || !triangle.is_finite() {
        return None;
    }
    let d = farthest(&|p| {
        let to = |i: usize| (p - points[i]).norm();
        to(a).min(to(b)).min(to(c))
    });
    Some([a, b, c, d])
}

#[cfg(test)]
mod tests {
    use super::super::reprojection_error_px;
    use super::*;
    use crate::camera::{Intrinsics, PosedCamera};
    use crate::math::random::Random;
    use nalgebra::UnitQuaternion;

    struct Scene {
        truth: RigidTransform,
        points: Vec<Point3<f64>>,
        pixels: Vec<Point2<f64>>,
    }

    fn camera() -> Camera {
        let k = Intrinsics::new(700.0, 710.0, 320.0, 240.0).unwrap();
        Camera::pinhole(k, 640, 480)
    }

    /// Points within ±2, six away, in space or on z = 0.
    fn scene(random: &mut Random, count: usize, thickness: f64, noise_px: f64) -> Scene {
        let rotation_vector = Vector3::from_fn(|_, _| 0.5 * random.normal());
        let t = Vector3::new(0.3 * random.normal(), 0.3 * random.normal(), 7.0);
        let truth =
            RigidTransform::from_parts(t.into(), UnitQuaternion::from_scaled_axis(rotation_vector));
        let (mut points, mut pixels) = (Vec::new(), Vec::new());
        for _ in 0..count {
            let mut to = |reach: f64| random.uniform(-reach, reach);
            let x = Point3::new(to(2.0), to(2.0), to(1.0) * thickness);
            let p = camera().project(&(truth * x)).unwrap();
            let noise = [random.normal(), random.normal()].map(|x| noise_px * x);
            points.push(x);
            pixels.push(Point2::new(p.x + noise[0], p.y + noise[1]));
        }
        Scene {
            truth,
            points,
            pixels,
        }
    }

    fn off(found: &RigidTransform, scene: &Scene) -> f64 {
        let shift = found.translation.vector - scene.truth.translation.vector;
        found.rotation.angle_to(&scene.truth.rotation) + shift.norm()
    }

    fn cost(pose: &RigidTransform, scene: &Scene) -> f64 {
        let camera = PosedCamera {
            camera: Camera::pinhole(camera().intrinsics, 640, 480),
            cam_from_world: *pose,
        };
        (scene.points.iter().zip(&scene.pixels))
            .map(|(x, p)| reprojection_error_px(&camera, x, p))
            .map(|error_px| error_px * error_px)
            .sum()
    }

    #[test]
    fn exact_points_give_the_truth_on_planes_and_off_them() {
        let mut random = Random::new(1);
        for count in [4, 5, 6, 7, 12, 200] {
            // Three points have up to four poses; the fourth point disambiguates.
            for thickness in [0.0, 1e-9, 1e-4, 0.1, 2.0] {
                for _ in 0..20 {
                    let scene = scene(&mut random, count, thickness, 0.0);
                    let found = fit_absolute_pose(&scene.points, &scene.pixels, &camera()).unwrap();
                    assert!(cost(&found, &scene) < 1e-12, "{count} {thickness}");
                    assert!(off(&found, &scene) < 1e-4, "{count} {thickness}");
                }
            }
        }
    }

    /// No worse than the minimum next to the truth, and as close to the truth as noise allows.
    #[test]
    fn noise_costs_no_more_than_at_the_truth() {
        let mut random = Random::new(2);
        for (count, limit) in [(8, 0.5), (50, 0.15), (1000, 0.03)] {
            for thickness in [0.0, 1e-3, 2.0] {
                for _ in 0..20 {
                    let scene = scene(&mut random, count, thickness, 0.5);
                    let found = fit_absolute_pose(&scene.points, &scene.pixels, &camera()).unwrap();
                    let best = refine_absolute_pose(
                        &scene.truth,
                        &scene.points,
                        &scene.pixels,
                        &camera(),
                        RobustLoss::Trivial,
                    );
                    let least = cost(&best.unwrap(), &scene);
                    assert!(
                        cost(&found, &scene) <= least * (1.0 + 1e-6),
                        "{count} {thickness}"
                    );
                    let off = off(&found, &scene);
                    assert!(off < limit, "{count} {thickness} {off}");
                }
            }
        }
    }

    #[test]
    fn what_leaves_the_pose_open_is_refused() {
        let k = camera();
        let line: Vec<_> = (0..9)
            .map(|i| Point3::new(f64::from(i), 0.5, 5.0))
            .collect();
        let pixels: Vec<_> = line.iter().map(|x| k.project(x).unwrap()).collect();
        let same = vec![Point3::new(1.0, 2.0, 3.0); 9];
        let far = vec![Point3::new(1e200, -1e200, 1e200); 9];
        for points in [&line, &same, &far] {
            let error = fit_absolute_pose(points, &pixels, &k).unwrap_err();
            assert!(error.to_string().contains("one line"), "{error}");
        }
        let mut random = Random::new(3);
        let Scene { points, pixels, .. } = scene(&mut random, 9, 2.0, 0.0);
        assert!(fit_absolute_pose(&points[..3], &pixels[..3], &k).is_err());
        assert!(fit_absolute_pose(&points[..5], &pixels, &k).is_err());
        for bad in [f64::NAN, f64::INFINITY] {
            let (mut p, mut x) = (pixels.clone(), points.clone());
            p[2].y = bad;
            x[3].z = bad;
            assert!(fit_absolute_pose(&points, &p, &k).is_err());
            assert!(fit_absolute_pose(&x, &pixels, &k).is_err());
        }
        // Scattered points with a single pixel: a finite result, or an error.
        let one = vec![Point2::new(100.0, 100.0); 9];
        if let Ok(pose) = fit_absolute_pose(&points, &one, &k) {
            assert!(pose.to_homogeneous().iter().all(|x| x.is_finite()));
        }
    }
}
