//! Rotation-only motion with a wrong focal length: its homographies look like those of planes.

use super::TwoViewOptions;
use super::explaining_rotation::{homography_of_rotation, motion_of_rotation};
use super::pairs::inliers_of;
use super::rotation::align_rays;
use crate::Result;
use crate::camera::{Camera, Intrinsics, RigidTransform};
use crate::homography::{fit_homography, homography_sampson_sq, refine_homography};
use crate::optim::RobustLoss;
use crate::robust::MatchSet;
use nalgebra::{Matrix3, Point2, Vector3};

/// Maximum ratio between the estimated focal length and the given one, either way.
const WIDEST: f64 = 4.0;
/// The cosine of 50°: up to this angle off the axis a lens is close enough to a pinhole camera.
const NARROW: f64 = 0.642_787_609_686_539_3;
/// Number of factors tried, evenly spaced by logarithm. The cost has one valley, far wider than
/// their spacing of 9 %.
const NUM_TRIED: usize = 33;
/// Number of golden-section steps from there: the factor is then accurate to six digits.
const NUM_NARROWED: usize = 26;
/// A rotation and a focal length have four unknowns, so they fit any two matches. H has eight, so
/// more than four matches are informative.
const MIN_NUM_MATCHES: usize = 6;
/// Maximum ratio of the RMS error to that of the best homography. Noise with four parameters fewer
/// and residual distortion stay within a few percent, while planes exceed it by half and more.
const MAX_RMS_RATIO: f64 = 1.1;
/// Slack as a fraction of the threshold, for noise-free matches.
const RMS_SLACK: f64 = 0.02;

/// A rotation and a focal length that explain nearly all of some matches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RotationAndFocal {
    /// The rotation, as a motion without translation.
    pub cam2_from_cam1: RigidTransform,
    /// Ratio of the actual focal lengths to the given ones.
    pub focal_factor: f64,
    /// Number of unique matches that it explains.
    pub num_explained: usize,
    /// Number of unique matches.
    pub num_inliers: usize,
}

/// The best rotation for one focal length.
struct Candidate {
    rotation: Matrix3<f64>,
    homography: Matrix3<f64>,
    /// Sum of the squared errors, each clipped at the square of the inlier threshold, px².
    cost: f64,
}

struct Search<'a> {
    pairs: Vec<(Point2<f64>, Point2<f64>)>,
    intrinsics: [&'a Intrinsics; 2],
    options: &'a TwoViewOptions,
}

/// Finds the rotation that explains the inliers of a homography equally well if the given focal
/// lengths are off by a common factor, and this factor. If there is one, the matches are not on a
/// plane and give no depth.
///
/// `x2 ∝ K2 R K1⁻¹ x1`, where the focal lengths in K1 and K2 are `focal_factor` times those given.
/// Factors from ¼ to 4 are searched, each with the rotation that aligns the rays best.
///
/// * `pixels1`, `pixels2`: the matches from which H was estimated
/// * `cameras`: the two cameras; principal points and lenses are trusted, focal lengths are not
/// * `inliers`: for each match, whether it is an inlier of H
/// * `options`: [`TwoViewOptions::max_homography_ratio`] defines "nearly all", and
///   [`RansacOptions::max_error_px`](crate::robust::RansacOptions::max_error_px) should be that of
///   the search
///
/// `None` for inliers 50° or more off the axis, where a lens is not close enough to a pinhole
/// camera; if the rotation does not explain nearly all matches, or its error exceeds 1.1 times that
/// of the best homography, as for planes. Also `None` if the longest focal length fits equally
/// well, since a rotation then moves the whole image uniformly, as does a sideways step before a
/// wall. A camera that looks straight at a wall, and rotates a little while it steps aside, cannot
/// be distinguished from a rotation.
///
/// # Errors
/// [`Error::SizeMismatch`](crate::Error::SizeMismatch) if the lists differ in length, and as
/// [`TwoViewOptions::check`] and [`MatchSet::new`].
///
/// Source: Hartley & Zisserman 2004, §8.4 (rotations in pixels); Szeliski 2022, §8.2 (focal lengths
/// from homographies of panoramas; replaced by a search, which needs no accurate H).
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Camera, Intrinsics};
/// use epipole::two_view::{Configuration, TwoViewOptions, estimate_two_view_calibrated, find_rotation_and_focal};
/// use nalgebra::{Point2, Rotation3, Vector3};
/// let k = Intrinsics::centered(600.0, 640, 480)?;
/// let rotation = Rotation3::from_scaled_axis(Vector3::new(0.0, 0.2, 0.0));
/// let p1: Vec<_> = (0..60).map(|i| Point2::new(f64::from(i * 37 % 640), f64::from(i * 71 % 480))).collect();
/// let p2: Vec<_> = p1.iter().map(|p| {
///     let x = k.matrix() * (rotation * k.ray(p));
///     Point2::new(x.x / x.z, x.y / x.z)
/// }).collect();
/// // With the wrong 480 px this looks like a plane.
/// let guess = Intrinsics::centered(480.0, 640, 480)?;
/// let options = TwoViewOptions::default();
/// let camera = Camera::pinhole(guess, 640, 480);
/// let report = estimate_two_view_calibrated(&p1, &p2, [&camera; 2], &options, &mut ())?;
/// assert_eq!(report.configuration, Configuration::Planar);
/// let found = find_rotation_and_focal(&p1, &p2, [&camera; 2], &report.inliers, &options)?.unwrap();
/// assert!((found.focal_factor - 600.0 / 480.0).abs() < 1e-3);
/// assert!((found.cam2_from_cam1.rotation.angle() - 0.2).abs() < 1e-3);
/// # Ok(()) }
/// ```
pub fn find_rotation_and_focal(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    cameras: [&Camera; 2],
    inliers: &[bool],
    options: &TwoViewOptions,
) -> Result<Option<RotationAndFocal>> {
    options.check()?;
    let [in1, in2] = inliers_of(pixels1, pixels2, inliers)?;
    let straight = |camera: &Camera, pixels: &[Point2<f64>]| -> Option<Vec<Point2<f64>>> {
        pixels
            .iter()
            .map(|pixel| narrow_pixel(camera, pixel))
            .collect()
    };
    let (Some(in1), Some(in2)) = (straight(cameras[0], &in1), straight(cameras[1], &in2)) else {
        return Ok(None);
    };
    let set = MatchSet::new(&in1, &in2)?;
    let search = Search {
        pairs: (0..set.len()).map(|index| set.pair(index)).collect(),
        intrinsics: cameras.map(|camera| &camera.intrinsics),
        options,
    };
    if set.len() < MIN_NUM_MATCHES {
        return Ok(None);
    }
    // Collinear matches have no homography, and too many rotations fit.
    let homography = search.homography().ok();
    Ok(homography.and_then(|homography| search.rotation_and_focal(search.cost(&homography))))
}

/// Returns the undistorted pixel; `None` too far off the axis.
fn narrow_pixel(camera: &Camera, pixel: &Point2<f64>) -> Option<Point2<f64>> {
    if camera.is_pinhole() {
        return Some(*pixel);
    }
    let ray = camera.unproject(pixel).ok()?;
    (ray.z > NARROW).then(|| camera.pinhole_pixel(pixel).ok())?
}

impl Search<'_> {
    /// Returns the best homography of any kind.
    fn homography(&self) -> Result<Matrix3<f64>> {
        let (pixels1, pixels2): (Vec<_>, Vec<_>) = self.pairs.iter().copied().unzip();
        let start = fit_homography(&pixels1, &pixels2)?;
        refine_homography(&start, &pixels1, &pixels2, RobustLoss::Trivial)
    }

    /// Returns the rotation, if it is as good as a homography with this cost.
    fn rotation_and_focal(&self, cost: f64) -> Option<RotationAndFocal> {
        let count = self.pairs.len() as f64;
        let needed = self.options.max_homography_ratio * count;
        let explained = |found: &Candidate| {
            let fits = |(p1, p2): &&(_, _)| self.options.fits_homography(&found.homography, p1, p2);
            self.pairs.iter().filter(fits).count()
        };
        if self
            .at(WIDEST)
            .is_some_and(|found| explained(&found) as f64 >= needed)
        {
            return None;
        }
        let focal_factor = self.best_factor()?;
        let found = self.at(focal_factor)?;
        let num_explained = explained(&found);
        let rms = |cost: f64| (cost / count).sqrt();
        let most = MAX_RMS_RATIO * rms(cost) + RMS_SLACK * self.options.ransac.max_error_px;
        (num_explained as f64 >= needed && rms(found.cost) <= most).then(|| RotationAndFocal {
            cam2_from_cam1: motion_of_rotation(&found.rotation),
            focal_factor,
            num_explained,
            num_inliers: self.pairs.len(),
        })
    }

    fn cost(&self, homography: &Matrix3<f64>) -> f64 {
        let reach_px = self.options.reach_in_two_dimensions_px();
        let errors = (self.pairs.iter()).map(|(p1, p2)| homography_sampson_sq(homography, p1, p2));
        errors
            .map(|error_sq| error_sq.min(reach_px * reach_px))
            .sum()
    }

    /// Returns the rotation that explains the matches best with this factor of the focal lengths.
    fn at(&self, factor: f64) -> Option<Candidate> {
        let [k1, k2] = self.intrinsics;
        let (k1, k2) = (k1.zoomed(factor).ok()?, k2.zoomed(factor).ok()?);
        let rays: Vec<[Vector3<f64>; 2]> = (self.pairs.iter())
            .map(|(p1, p2)| [k1.ray(p1).normalize(), k2.ray(p2).normalize()])
            .collect();
        let candidate = |rotation: Matrix3<f64>| {
            let homography = homography_of_rotation(&rotation, [&k1, &k2]);
            Candidate {
                cost: self.cost(&homography),
                rotation,
                homography,
            }
        };
        let all = candidate(align_rays(rays.iter())?);
        // Once more without the outliers, which bias the rotation.
        let near = (rays.iter().zip(&self.pairs))
            .filter(|(_, (p1, p2))| self.options.fits_homography(&all.homography, p1, p2));
        let again = align_rays(near.map(|(rays, _)| rays)).map(candidate);
        again.filter(|again| again.cost < all.cost).or(Some(all))
    }

    /// Returns the factor with the lowest cost; `None` if it is at an end of the range.
    fn best_factor(&self) -> Option<f64> {
        let cost = |log: f64| {
            let found = self.at(libm::exp(log));
            found.map_or(f64::INFINITY, |found| found.cost)
        };
        let widest = libm::log(WIDEST);
        let log = |index: usize| widest * (2.0 * index as f64 / (NUM_TRIED - 1) as f64 - 1.0);
        let costs: Vec<f64> = (0..NUM_TRIED).map(|index| cost(log(index))).collect();
        let best = (0..NUM_TRIED).min_by(|a, b| costs[*a].total_cmp(&costs[*b]))?;
        if best == 0 || best + 1 == NUM_TRIED {
            return None;
        }
        let golden = (5.0_f64.sqrt() - 1.0) / 2.0;
        let (mut low, mut high) = (log(best - 1), log(best + 1));
        let inner = |low: f64, high: f64| {
            let part = golden * (high - low);
            [high - part, low + part]
        };
        let [mut first, mut second] = inner(low, high);
        let [mut of_first, mut of_second] = [cost(first), cost(second)];
        for _ in 0..NUM_NARROWED {
            if of_first < of_second {
                high = second;
                (second, of_second) = (first, of_first);
                first = inner(low, high)[0];
                of_first = cost(first);
            } else {
                low = first;
                (first, of_first) = (second, of_second);
                second = inner(low, high)[1];
                of_second = cost(second);
            }
        }
        Some(libm::exp((low + high) / 2.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Error;
    use crate::camera::Distortion;
    use crate::homography::estimate_homography;
    use crate::math::random::Random;
    use nalgebra::Point3;

    const GUESS_PX: f64 = 600.0;

    fn options() -> TwoViewOptions {
        TwoViewOptions::default().within(1.5)
    }

    fn intrinsics(focal_px: f64) -> Intrinsics {
        Intrinsics::centered(focal_px, 800, 600).unwrap()
    }

    fn camera(focal_px: f64) -> Camera {
        Camera::pinhole(intrinsics(focal_px), 800, 600)
    }

    /// 200 matches in images of 800 × 600, every fifth wrong. `None` if the motion leaves none in
    /// sight.
    ///
    /// * `normal`: of the plane at distance 1; ignored for a rotation
    fn matches(
        random: &mut Random,
        k: &Intrinsics,
        motion: &RigidTransform,
        normal: &Vector3<f64>,
        noise_px: f64,
        bend: &dyn Fn(Point2<f64>) -> Point2<f64>,
    ) -> Option<[Vec<Point2<f64>>; 2]> {
        let place = |random: &mut Random| {
            Point2::new(random.uniform(0.0, 800.0), random.uniform(0.0, 600.0))
        };
        let [mut p1, mut p2] = [Vec::new(), Vec::new()];
        for _ in 0..20_000 {
            let p = place(random);
            if p1.len() % 5 == 4 {
                p1.push(p);
                p2.push(place(random));
            }
            let depth = 1.0 / normal.dot(&k.ray(&p));
            let Ok(q) = k.project(&(motion * Point3::from(k.ray(&p) * depth))) else {
                continue;
            };
            if depth < 0.05 || !(0.0..800.0).contains(&q.x) || !(0.0..600.0).contains(&q.y) {
                continue;
            }
            for (list, pixel) in [(&mut p1, p), (&mut p2, q)] {
                let [du, dv] = [random.normal(), random.normal()];
                list.push(bend(pixel) + noise_px * nalgebra::Vector2::new(du, dv));
            }
            if p1.len() >= 200 {
                return Some([p1, p2]);
            }
        }
        None
    }

    /// Result for matches of a homography with a guessed focal length.
    fn judge([p1, p2]: &[Vec<Point2<f64>>; 2]) -> Option<RotationAndFocal> {
        let (guess, options) = (camera(GUESS_PX), options());
        let h = estimate_homography(p1, p2, &options.in_two_dimensions(), &mut ()).unwrap();
        let pairs = p1.iter().zip(p2);
        let inliers: Vec<bool> = pairs
            .map(|(a, b)| options.fits_homography(&h.model, a, b))
            .collect();
        find_rotation_and_focal(p1, p2, [&guess; 2], &inliers, &options).unwrap()
    }

    fn random_rotation(random: &mut Random) -> Vector3<f64> {
        let angle_rad = random.uniform(4.0, 15.0_f64).to_radians();
        let towards = random.uniform(0.0, core::f64::consts::TAU);
        let (sin, cos) = (libm::sin(towards), libm::cos(towards));
        Vector3::new(angle_rad * cos, angle_rad * sin, random.uniform(-0.1, 0.1))
    }

    #[test]
    fn rotations_are_found_with_their_focal_length() {
        for (noise_px, k1, most_off, least) in [
            (0.0, 0.0, 1e-3, 34),
            (0.3, 0.0, 0.02, 34),
            (0.7, 0.0, 0.05, 34),
            (1.0, 0.0, 0.07, 34),
            // Distortion changes the estimated focal length, but the motion remains a rotation.
            (0.3, -0.04, 0.35, 34),
            (0.7, -0.04, 0.35, 34),
        ] {
            let mut num_found = 0;
            for seed in 0..40 {
                let mut random = Random::new(seed);
                // Up to twice the guess; at the guess itself nothing is wrong.
                let focal_px = GUESS_PX
                    * match seed % 2 {
                        0 => random.uniform(1.15, 2.0),
                        _ => random.uniform(0.6, 0.9),
                    };
                let k = intrinsics(focal_px);
                let rotation_vector =
                    random_rotation(&mut random) * if seed % 2 == 0 { 0.6 } else { 1.5 };
                let motion = RigidTransform::rotation(rotation_vector);
                let lens = Distortion::from_coefficients([k1, 0.0, 0.0, 0.0, 0.0]).unwrap();
                let bend = |p: Point2<f64>| {
                    let ray = k.ray(&p);
                    let distorted = lens.distort(&Point2::new(ray.x, ray.y));
                    k.project(&Point3::new(distorted.x, distorted.y, 1.0))
                        .unwrap()
                };
                let ahead = Vector3::z();
                let both = matches(&mut random, &k, &motion, &ahead, noise_px, &bend).unwrap();
                let Some(found) = judge(&both) else {
                    continue;
                };
                num_found += 1;
                let off = found.focal_factor * GUESS_PX / focal_px - 1.0;
                assert!(off.abs() < most_off, "{noise_px} {k1} {seed}: {off}");
                let truth = motion.rotation;
                let off = found.cam2_from_cam1.rotation.angle_to(&truth) / truth.angle();
                assert!(off < 1.5 * most_off, "{noise_px} {k1} {seed}: {off}");
                assert!(found.num_explained <= found.num_inliers);
            }
            // Small rotations with long focal lengths are ambiguous.
            assert!(num_found >= least, "{noise_px} {k1}: {num_found} of 40");
        }
    }

    /// Planes tilted by up to this angle, seen by cameras that translate and rotate.
    #[test]
    fn planes_are_no_rotations() {
        for noise_px in [0.0, 0.3, 0.7, 1.0] {
            for tilt in [0.1, 0.3, 0.7] {
                let mut num_pairs = 0;
                for seed in 0..60 {
                    let mut random = Random::new(1000 + seed);
                    let k = intrinsics(GUESS_PX * random.uniform(0.6, 2.0));
                    let mut part = |size: f64| random.uniform(-size, size);
                    let normal = Vector3::new(part(tilt), part(tilt), 1.0).normalize();
                    let step = Vector3::new(part(1.0), part(0.6), part(0.5)).normalize();
                    let step = step * random.uniform(0.08, 0.4);
                    let rotation_vector = random_rotation(&mut random) * random.uniform(0.0, 0.8);
                    let motion = RigidTransform::new(step, rotation_vector);
                    let both = matches(&mut random, &k, &motion, &normal, noise_px, &|p| p);
                    let Some(both) = both else {
                        continue;
                    };
                    num_pairs += 1;
                    assert_eq!(judge(&both), None, "{noise_px} {tilt} {seed}");
                }
                assert!(num_pairs > 40, "{noise_px} {tilt}: {num_pairs}");
            }
        }
    }

    /// The image moves uniformly, as for ever smaller rotations with ever longer focal lengths.
    #[test]
    fn a_step_aside_before_a_wall_is_no_rotation() {
        for noise_px in [0.0, 0.3, 0.7] {
            for seed in 0..20 {
                let mut random = Random::new(seed);
                let step = Vector3::new(random.uniform(0.05, 0.3), random.uniform(-0.2, 0.2), 0.0);
                let motion = RigidTransform::new(step, Vector3::zeros());
                let (k, wall) = (intrinsics(GUESS_PX), Vector3::z());
                let [p1, p2] = matches(&mut random, &k, &motion, &wall, noise_px, &|p| p).unwrap();
                let right: Vec<bool> = (0..p1.len()).map(|index| index % 5 != 4).collect();
                let found =
                    find_rotation_and_focal(&p1, &p2, [&camera(GUESS_PX); 2], &right, &options())
                        .unwrap();
                assert_eq!(found, None, "{noise_px} {seed}");
            }
        }
    }

    #[test]
    fn too_few_data_give_none_and_nonsense_an_error() {
        let camera = camera(GUESS_PX);
        let find = |p1: &[Point2<f64>], p2: &[Point2<f64>]| {
            find_rotation_and_focal(p1, p2, [&camera; 2], &vec![true; p1.len()], &options())
        };
        let at = |i: usize| Point2::new((i * 97 % 800) as f64, (i * 61 % 600) as f64);
        let some: Vec<_> = (0..40).map(at).collect();
        let line: Vec<_> = (0..40).map(|i| Point2::new(f64::from(i), 300.0)).collect();
        for (p1, p2) in [
            (&some[..0], &some[..0]),
            (&some[..5], &some[..5]),
            (&[some[0]; 40], &[some[1]; 40]),
            (&line, &line),
            (&some, &line),
        ] {
            assert_eq!(find(p1, p2), Ok(None));
        }
        let error = find(&some, &some[1..]).unwrap_err();
        assert!(matches!(error, Error::SizeMismatch { .. }));
        let mut broken = some.clone();
        broken[3].x = f64::NAN;
        let error = find(&some, &broken).unwrap_err();
        assert!(matches!(error, Error::NotFinite { .. }));
        // A match infinitely far off is left out.
        broken[3].x = f64::INFINITY;
        assert!(find(&some, &broken).is_ok());
    }
}
