//! Camera pose and focal length from four points.

mod elimination;
mod plane;

use self::elimination::depth_ratios;
use super::pose_with_focal::{AbsolutePoseWithFocal, PoseFocal};
use super::refine::rigid;
use super::refine_focal::polish_sample;
use crate::math::svd3;
use arrayvec::ArrayVec;
use nalgebra::{Matrix3, Point2, Point3, Vector3, Vector4};

/// Maximum number of solutions: six for points in space, one for points on a plane.
pub(super) const MAX_SOLUTIONS: usize = 7;

/// Maximum width of four points, relative to their length, to count as collinear.
const LINE: f64 = 1e-6;

/// Maximum thickness of four points, relative to their length, to count as coplanar: rounding hides
/// it.
const FLAT: f64 = 1e-7;

/// Maximum thickness of points that are also tried as coplanar.
const THIN: f64 = 0.15;

/// Maximum error of a solution, relative to the extent of the image.
const FAR_OFF: f64 = 0.25;

/// Solves for the poses with focal length, at most seven, that project four known points to four
/// pixels.
///
/// Assumes square pixels without skew. The unknowns are the four depths, up to a common factor, and
/// the focal length. The camera sees a scaled copy of the four points; equal angles and length
/// ratios of their differences are four quadratic equations in three depth ratios, after f is
/// eliminated. Three of their combinations give the squares and the product of two ratios, the
/// fourth is linear in them, and a determinant of degree six in the third ratio remains. Four
/// coplanar points give the ratios directly; nearly coplanar points are tried both ways.
///
/// * `pixels`, `points_in_world`: four pixels and their points
/// * `principal`: principal point, pixels: for most cameras the image center
///
/// Four points give one equation more than there are unknowns: for exact pixels the true solution
/// fits exactly, otherwise solutions fit approximately. They are sorted by error, the best first.
/// Returns an empty list if there is no solution, and for equal points or pixels, three collinear
/// points of a plane, input that is not finite, and a plane parallel to the image, for which every
/// focal length fits at some distance.
///
/// Source: the equations of Bujnak, Kukelova & Pajdla 2008, "A general solution to the P4P problem
/// for camera with unknown focal length"; their elimination as in Kukelova, Heller & Fitzgibbon
/// 2016, "Efficient intersection of three quadrics and applications in computer vision", with the
/// fourth equation in place of an identity.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::absolute_pose::pose_p4pf;
/// use epipole::camera::{Intrinsics, RigidTransform};
/// use nalgebra::{Point3, Vector3};
/// let k = Intrinsics::new(900.0, 900.0, 320.0, 240.0)?;
/// let cam_from_world = RigidTransform::new(Vector3::new(0.1, -0.2, 6.0), Vector3::new(0.1, 0.2, 0.3));
/// let points = [(-1.0, -1.0, 0.5), (1.0, -0.5, -0.7), (0.3, 1.0, 0.0), (-0.8, 0.6, 1.2)]
///     .map(|(x, y, z)| Point3::new(x, y, z));
/// let pixels = points.map(|x| k.project(&(cam_from_world * x)).unwrap());
/// let best = pose_p4pf(&pixels, &points, &k.principal_point())[0];
/// assert!((best.focal_px - 900.0).abs() < 1e-6);
/// assert!(best.cam_from_world.rotation.angle_to(&cam_from_world.rotation) < 1e-9);
/// # Ok(()) }
/// ```
pub fn pose_p4pf(
    pixels: &[Point2<f64>; 4],
    points_in_world: &[Point3<f64>; 4],
    principal: &Point2<f64>,
) -> ArrayVec<AbsolutePoseWithFocal, 7> {
    let about = pixels.map(|p| p - principal.coords);
    let points = points_in_world.map(|x| x.coords);
    let mut solutions = ArrayVec::new();
    solve(&about, &points, &mut solutions);
    let whole = |(rotation, t, focal_px): PoseFocal| AbsolutePoseWithFocal {
        cam_from_world: rigid(&(rotation, t), &points[0]),
        focal_px,
        focal_std_px: None,
    };
    solutions.into_iter().map(whole).collect()
}

/// Solves for pixels relative to the principal point.
pub(super) fn solve(
    about: &[Point2<f64>; 4],
    points: &[Vector3<f64>; 4],
    solutions: &mut ArrayVec<PoseFocal, MAX_SOLUTIONS>,
) {
    let sum_sq: f64 = about.iter().map(|p| p.coords.norm_squared()).sum();
    let unit_px = (0.25 * sum_sq).sqrt();
    let sides = [1, 2, 3].map(|i| points[i] - points[0]);
    let length = sides.iter().fold(0.0_f64, |far, side| far.max(side.amax()));
    if !(unit_px > 0.0 && unit_px.is_finite() && length > 0.0 && length.is_finite()) {
        return;
    }
    let problem = Sample {
        pixels: about.map(|p| p.coords / unit_px),
        sides: Matrix3::from_columns(&sides) / length,
    };
    let svd = svd3(&problem.sides);
    // Collinear points leave the rotation about their line free.
    if svd.singular_values[1] < LINE * svd.singular_values[0] {
        return;
    }
    let thickness = svd.singular_values[2] / svd.singular_values[0];
    let mut found = ArrayVec::<(f64, PoseFocal), MAX_SOLUTIONS>::new();
    let mut push = |depths: &Vector4<f64>| {
        let Some((mut pose, mirrored)) = problem.pose_of(depths) else {
            return;
        };
        // For coplanar points the mirror image is also a rotation.
        if mirrored && thickness > THIN {
            return;
        }
        if thickness <= THIN {
            let Some(better) = polish_sample(&problem.pixels, &problem.points(), &pose) else {
                return;
            };
            pose = better;
        }
        let error = problem.error(&pose);
        if error < FAR_OFF && !found.is_full() {
            found.push((error, pose));
        }
    };
    if thickness > FLAT
        && let Some(inverse) = problem.sides.try_inverse()
    {
        for depths in &depth_ratios(&problem.pixels, &inverse) {
            push(depths);
        }
    }
    if thickness < THIN
        && let Some(depths) = plane::depth_ratios(&problem.pixels, &svd.v.column(2).into_owned())
    {
        push(&depths);
    }
    found.sort_unstable_by(|(a, _), (b, _)| a.total_cmp(b));
    for (_, (rotation, t, focal)) in found {
        let t = t * length - rotation * points[0];
        let known = |other: &PoseFocal| {
            (other.2 / (focal * unit_px) - 1.0).abs() < SAME && (other.0 - rotation).norm() < SAME
        };
        let finite = t.iter().chain(rotation.iter()).all(|x| x.is_finite());
        if finite && !solutions.iter().any(known) {
            solutions.push((rotation, t, focal * unit_px));
        }
    }
}

/// Distance below which solutions are equal.
const SAME: f64 = 1e-7;

/// Maximum squared difference of depths, relative to the first, that leaves the focal length free.
const SAME_DEPTH: f64 = 1e-12;

/// Four points in normalized units, the first at the origin.
struct Sample {
    /// Pixels relative to the principal point.
    pixels: [nalgebra::Vector2<f64>; 4],
    /// Sides from the first point to the others, as columns.
    sides: Matrix3<f64>,
}

impl Sample {
    fn points(&self) -> [Point3<f64>; 4] {
        let at = |i: usize| self.sides.column(i).into_owned();
        [Vector3::zeros(), at(0), at(1), at(2)].map(Point3::from)
    }

    /// Returns the pose, its focal length, and whether the solution is mirrored.
    ///
    /// A distance between two points gives `‖uᵢzᵢ − uⱼzⱼ‖² + f² (zᵢ − zⱼ)² = s² d²`: six equations,
    /// linear in f² and s². Then R is the rotation that aligns the two sets of points.
    ///
    /// Source: Arun, Huang & Blostein 1987, "Least-squares fitting of two 3-D point sets".
    fn pose_of(&self, z: &Vector4<f64>) -> Option<(PoseFocal, bool)> {
        let points = self.points();
        let (mut bb, mut bd, mut dd, mut ab, mut ad) = (0.0, 0.0, 0.0, 0.0, 0.0);
        for i in 0..4 {
            for j in 0..i {
                let a = (self.pixels[i] * z[i] - self.pixels[j] * z[j]).norm_squared();
                let b = (z[i] - z[j]) * (z[i] - z[j]);
                let d = (points[i] - points[j]).norm_squared();
                bb += b * b;
                bd += b * d;
                dd += d * d;
                ab += a * b;
                ad += a * d;
            }
        }
        // a + b f² − d s² = 0 by least squares.
        let determinant = bb * dd - bd * bd;
        let constrains_focal = bb > SAME_DEPTH * SAME_DEPTH && determinant > 1e-14 * bb * dd;
        if !constrains_focal {
            return None;
        }
        let focal_sq = (bd * ad - dd * ab) / determinant;
        let scale_sq = (bb * ad - bd * ab) / determinant;
        let (focal, scale) = (focal_sq.sqrt(), scale_sq.sqrt());
        if !(focal > 0.0 && scale > 0.0 && focal.is_finite() && scale.is_finite()) {
            return None;
        }
        let about = |i: usize| {
            Vector3::new(
                self.pixels[i].x * z[i],
                self.pixels[i].y * z[i],
                focal * z[i],
            ) / scale
        };
        let first = about(0);
        let rotated = Matrix3::from_columns(&[1, 2, 3].map(|i| about(i) - first));
        let mirrored = rotated.determinant() * self.sides.determinant() < 0.0;
        // Align the centroids of both sets, not their first points.
        let middle = |sides: &Matrix3<f64>| sides.column_sum() / 4.0;
        let (m1, m2) = (middle(&self.sides), middle(&rotated));
        let mut sums = m2 * m1.transpose();
        for i in 0..3 {
            sums += (rotated.column(i) - m2) * (self.sides.column(i) - m1).transpose();
        }
        let svd = svd3(&sums);
        let sign = (svd.u.determinant() * svd.v.determinant()).signum();
        let rotation =
            svd.u * Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, sign)) * svd.v.transpose();
        let t = first + m2 - rotation * m1;
        Some(((rotation, t, focal), mirrored))
    }

    /// Returns the root-mean-square distance between projections and pixels; infinite behind the
    /// camera.
    fn error(&self, (rotation, t, focal): &PoseFocal) -> f64 {
        let mut sum = 0.0;
        for (x, pixel) in self.points().iter().zip(&self.pixels) {
            let x = rotation * x.coords + t;
            if x.z <= 0.0 {
                return f64::INFINITY;
            }
            sum += (x.xy() * (focal / x.z) - pixel).norm_squared();
        }
        (0.25 * sum).sqrt()
    }
}

#[cfg(test)]
mod tests;
