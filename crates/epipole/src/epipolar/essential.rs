//! Essential matrices: constraints and decomposition.

use super::from_cameras::unit_norm;
use crate::camera::{Intrinsics, RigidTransform, cross_matrix};
use crate::math::svd3;
use crate::{Error, Result};
use nalgebra::{Matrix3, Point2, Rotation3, UnitQuaternion, Vector3};

/// Returns the nearest essential matrix, in Frobenius norm up to scale: singular values become (1,
/// 1, 0)/√2.
///
/// # Errors
/// [`Error::NotFinite`] for NaN and infinities, [`Error::Degenerate`] for a matrix of rank 1 or 0.
///
/// Source: Hartley & Zisserman 2004, §11.7.3.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::epipolar::project_to_essential;
/// use nalgebra::{Matrix3, Vector3};
/// // Singular values 1.1, 0.9 and 0.2 become equal, equal and 0.
/// let matrix = Matrix3::from_diagonal(&Vector3::new(1.1, -0.9, 0.2));
/// let half = 0.5_f64.sqrt();
/// let nearest = Matrix3::from_diagonal(&Vector3::new(half, -half, 0.0));
/// assert!((project_to_essential(&matrix)? - nearest).norm() < 1e-12);
/// # Ok(()) }
/// ```
pub fn project_to_essential(matrix: &Matrix3<f64>) -> Result<Matrix3<f64>> {
    let unit = unit_norm(matrix)?;
    let svd = svd3(&unit);
    if svd.singular_values[1] <= 1e-12 {
        return Err(Error::Degenerate {
            what: "an essential matrix",
            why: "the matrix has rank 1",
        });
    }
    let half = core::f64::consts::FRAC_1_SQRT_2;
    Ok(svd.u * Matrix3::from_diagonal(&Vector3::new(half, half, 0.0)) * svd.v.transpose())
}

/// Returns the row of the linear system for E of one pair of rays.
#[inline]
pub(crate) fn bearing_row(x1: &Vector3<f64>, x2: &Vector3<f64>) -> [f64; 9] {
    [
        x2.x * x1.x,
        x2.x * x1.y,
        x2.x * x1.z,
        x2.y * x1.x,
        x2.y * x1.y,
        x2.y * x1.z,
        x2.z * x1.x,
        x2.z * x1.y,
        x2.z * x1.z,
    ]
}

/// Decomposes an essential matrix into its four motions: (R₁, t), (R₁, −t), (R₂, t), (R₂, −t), with
/// |t| = 1. Only one puts points in front of both cameras; see [`select_pose`].
///
/// `R₁ = U W Vᵀ`, `R₂ = U Wᵀ Vᵀ` and t is the last column of U.
///
/// # Errors
/// [`Error::NotFinite`] for NaN and infinities, [`Error::Degenerate`] for a matrix of rank 1 or 0.
///
/// Source: Hartley & Zisserman 2004, §9.6.2.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::RigidTransform;
/// use epipole::epipolar::{decompose_essential, essential_from_motion};
/// let e = essential_from_motion(&RigidTransform::translation(0.0, 0.0, 2.0))?;
/// let motions = decompose_essential(&e)?;
/// assert!(motions.iter().any(|m| (m.translation.z - 1.0).abs() < 1e-12 && m.rotation.angle() < 1e-7));
/// # Ok(()) }
/// ```
#[doc(alias = "decomposeEssentialMat")]
pub fn decompose_essential(essential: &Matrix3<f64>) -> Result<[RigidTransform; 4]> {
    let projected = project_to_essential(essential)?;
    let svd = svd3(&projected);
    let proper = |m: &Matrix3<f64>| if m.determinant() < 0.0 { -m } else { *m };
    let (u, v) = (proper(&svd.u), proper(&svd.v));
    #[rustfmt::skip]
    let w = Matrix3::new(
        0.0, -1.0, 0.0,
        1.0,  0.0, 0.0,
        0.0,  0.0, 1.0,
    );
    let direction = u.column(2).into_owned();
    let motion = |rotation: Matrix3<f64>, t: Vector3<f64>| {
        RigidTransform::from_parts(
            t.into(),
            UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(rotation)),
        )
    };
    let (r1, r2) = (u * w * v.transpose(), u * w.transpose() * v.transpose());
    Ok([
        motion(r1, direction),
        motion(r1, -direction),
        motion(r2, direction),
        motion(r2, -direction),
    ])
}

/// Returns the two rotations of an exact essential matrix scaled to Frobenius norm √2, and t.
///
/// Source: Horn 1990, "Recovering baseline and orientation from essential matrix".
#[inline]
pub(crate) fn rotations_and_direction(
    essential: &Matrix3<f64>,
) -> Option<([Matrix3<f64>; 2], Vector3<f64>)> {
    let e = essential * (core::f64::consts::SQRT_2 / essential.norm());
    let columns = [0, 1, 2].map(|i| e.column(i).into_owned());
    // t is perpendicular to all columns; the longest cross product is the most accurate.
    let crosses = [
        columns[1].cross(&columns[2]),
        columns[2].cross(&columns[0]),
        columns[0].cross(&columns[1]),
    ];
    let lengths = [0, 1, 2].map(|i: usize| crosses[i].norm_squared());
    let longest = if lengths[0] >= lengths[1] && lengths[0] >= lengths[2] {
        0
    } else if lengths[1] >= lengths[2] {
        1
    } else {
        2
    };
    if !(lengths[longest] > 0.0 && lengths[longest].is_finite()) {
        return None;
    }
    let direction = crosses[longest] / lengths[longest].sqrt();
    let cofactors = Matrix3::from_columns(&crosses);
    let crossed = cross_matrix(&direction) * e;
    Some(([cofactors - crossed, cofactors + crossed], direction))
}

/// The best motion of [`decompose_essential`] by the number of points in front of both cameras.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SelectedPose {
    /// The motion with the most points in front; |t| = 1.
    pub cam2_from_cam1: RigidTransform,
    /// Number of points in front of both cameras.
    pub num_in_front: usize,
    /// The same number for the second-best motion.
    pub second_num_in_front: usize,
}

/// Selects the motion that puts the most matched points in front of both cameras (cheirality).
///
/// * `motions`: candidates, such as the four of [`decompose_essential`]
/// * `pixels1`, `pixels2`: matches without outliers: all of them count
///
/// # Errors
/// [`Error::TooFew`] without motions or matches, [`Error::SizeMismatch`] for lists of different
/// length, [`Error::NotFinite`] for NaN and infinities.
///
/// Source: Hartley & Zisserman 2004, §9.6.3.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Intrinsics, RigidTransform};
/// use epipole::epipolar::{decompose_essential, essential_from_motion, select_pose};
/// use nalgebra::Point3;
/// let k = Intrinsics::new(700.0, 700.0, 320.0, 240.0)?;
/// let cam2_from_cam1 = RigidTransform::translation(-1.0, 0.0, 0.0);
/// let (mut p1, mut p2) = (Vec::new(), Vec::new());
/// for i in 0..5 {
///     let x = Point3::new(0.2 * f64::from(i), 0.1, 4.0 + f64::from(i));
///     p1.push(k.project(&x)?);
///     p2.push(k.project(&(cam2_from_cam1 * x))?);
/// }
/// let motions = decompose_essential(&essential_from_motion(&cam2_from_cam1)?)?;
/// let selected = select_pose(&motions, &p1, &p2, &k, &k)?;
/// assert_eq!((selected.num_in_front, selected.second_num_in_front), (5, 0));
/// assert!((selected.cam2_from_cam1.translation.x + 1.0).abs() < 1e-12);
/// # Ok(()) }
/// ```
pub fn select_pose(
    motions: &[RigidTransform],
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    k1: &Intrinsics,
    k2: &Intrinsics,
) -> Result<SelectedPose> {
    if pixels1.len() != pixels2.len() {
        return Err(Error::SizeMismatch {
            what: "the two lists of matching pixels",
            first: pixels1.len(),
            second: pixels2.len(),
        });
    }
    if motions.is_empty() || pixels1.is_empty() {
        return Err(Error::TooFew {
            what: "a choice of pose from motions and matches",
            needed: 1,
            got: motions.len().min(pixels1.len()),
        });
    }
    let finite = |x: &f64| x.is_finite();
    let is_motion = |motion: &RigidTransform| {
        motion.translation.vector.iter().all(finite) && motion.rotation.coords.iter().all(finite)
    };
    if !(motions.iter().all(is_motion)
        && pixels1.iter().chain(pixels2).all(|p| p.iter().all(finite)))
    {
        return Err(Error::NotFinite {
            what: "a motion or a matched pixel",
        });
    }
    let rays = pixels1.iter().zip(pixels2);
    Ok(most_in_front(
        motions,
        rays.map(|(p1, p2)| [k1.ray(p1), k2.ray(p2)]),
    ))
}

/// Body of [`select_pose`], from rays of any length.
pub(super) fn most_in_front(
    motions: &[RigidTransform],
    rays: impl Iterator<Item = [Vector3<f64>; 2]> + Clone,
) -> SelectedPose {
    let (mut best, mut best_count, mut second) = (0, 0, 0);
    for (place, motion) in motions.iter().enumerate() {
        let rotation = motion.rotation.to_rotation_matrix().into_inner();
        let in_front = |[x1, x2]: &[Vector3<f64>; 2]| {
            let (d1, d2) = signed_depths(&rotation, &motion.translation.vector, x1, x2);
            d1 > 0.0 && d2 > 0.0
        };
        let count = rays.clone().filter(in_front).count();
        if place == 0 || count > best_count {
            if place > 0 {
                second = best_count;
            }
            (best, best_count) = (place, count);
        } else {
            second = second.max(count);
        }
    }
    SelectedPose {
        cam2_from_cam1: motions[best],
        num_in_front: best_count,
        second_num_in_front: second,
    }
}

/// Returns numbers with the signs of the depths, along both rays, of the point where the rays are
/// closest: `d1 x1` in camera 1, `d2 x2` in camera 2.
#[inline(always)]
pub(crate) fn signed_depths(
    rotation: &Matrix3<f64>,
    t: &Vector3<f64>,
    x1: &Vector3<f64>,
    x2: &Vector3<f64>,
) -> (f64, f64) {
    // Least squares of d1 R x1 − d2 x2 = −t by Cramer's rule; the determinant is never negative.
    let rotated = rotation * x1;
    let (aa, bb, ab) = (rotated.norm_squared(), x2.norm_squared(), rotated.dot(x2));
    let (at, bt) = (rotated.dot(t), x2.dot(t));
    (ab * bt - bb * at, aa * bt - ab * at)
}

#[cfg(test)]
mod tests {
    use super::super::essential_8point;
    use super::super::from_cameras::tests::{random_cameras, random_point};
    use super::super::{RelativePose, essential_from_motion};
    use super::*;
    use crate::camera::relative_motion;
    use crate::math::random::Random;

    #[test]
    fn decomposition_holds_the_motion_and_cheirality_finds_it() {
        let mut random = Random::new(1);
        for _ in 0..100 {
            let (cam1, cam2) = random_cameras(&mut random);
            let mut motion = relative_motion(&cam1.cam_from_world, &cam2.cam_from_world);
            motion.translation.vector.normalize_mut();
            let e = essential_from_motion(&motion).unwrap();
            let motions = decompose_essential(&e).unwrap();
            let off = |m: &RigidTransform| {
                (m.rotation.to_rotation_matrix().into_inner()
                    - motion.rotation.to_rotation_matrix().into_inner())
                .norm()
                    + (m.translation.vector - motion.translation.vector).norm()
            };
            let best = motions.iter().map(off).fold(f64::INFINITY, f64::min);
            assert!(best < 1e-10, "{best}");
            let (p1, p2): (Vec<_>, Vec<_>) = (0..10)
                .map(|_| random_point(&mut random))
                .map(|x| (cam1.project(&x).unwrap(), cam2.project(&x).unwrap()))
                .unzip();
            let chosen = select_pose(
                &motions,
                &p1,
                &p2,
                &cam1.camera.intrinsics,
                &cam2.camera.intrinsics,
            )
            .unwrap();
            assert!(off(&chosen.cam2_from_cam1) < 1e-10);
            assert_eq!(chosen.num_in_front, 10);
            assert_eq!(chosen.second_num_in_front, 0);

            let (rotations, direction) = rotations_and_direction(&e).unwrap();
            let found = rotations
                .iter()
                .any(|r| (r - motion.rotation.to_rotation_matrix().into_inner()).norm() < 1e-10);
            assert!(found && direction.cross(&motion.translation.vector).norm() < 1e-10);
        }
    }

    #[test]
    fn eight_rays_give_the_essential_matrix() {
        let mut random = Random::new(2);
        for trial in 0..100 {
            let (cam1, cam2) = random_cameras(&mut random);
            let motion = relative_motion(&cam1.cam_from_world, &cam2.cam_from_world);
            let truth = essential_from_motion(&motion).unwrap();
            let (r1, r2): (Vec<_>, Vec<_>) = (0..8 + trial)
                .map(|_| random_point(&mut random))
                .map(|x| {
                    (
                        (cam1.cam_from_world * x).coords,
                        (cam2.cam_from_world * x).coords,
                    )
                })
                .unzip();
            let e = essential_8point(&r1, &r2).unwrap();
            let off = (e - truth).norm().min((e + truth).norm());
            assert!(off < 1e-8, "{off}");
        }
    }

    #[test]
    fn bad_input_is_refused() {
        assert!(decompose_essential(&Matrix3::zeros()).is_err());
        assert!(decompose_essential(&Matrix3::from_element(1.0)).is_err());
        assert!(decompose_essential(&Matrix3::from_element(f64::NAN)).is_err());
        let same = vec![Vector3::z(); 9];
        assert!(essential_8point(&same, &same).is_err());
        assert!(essential_8point(&same[..7], &same[..7]).is_err());
        assert!(essential_8point(&vec![Vector3::zeros(); 9], &same).is_err());
        let k = Intrinsics::centered(500.0, 640, 480).unwrap();
        assert!(select_pose(&[], &[], &[], &k, &k).is_err());
        let (o, nan) = (Point2::origin(), Point2::new(0.0, f64::NAN));
        let step = RigidTransform::translation(1.0, 0.0, 0.0);
        let nowhere = RigidTransform::translation(f64::NAN, 0.0, 0.0);
        for (motion, p1, p2) in [(step, nan, o), (step, o, nan), (nowhere, o, o)] {
            let result = select_pose(&[motion], &[p1], &[p2], &k, &k);
            assert!(matches!(result, Err(Error::NotFinite { .. })), "{result:?}");
        }
        // A camera for which F overflows.
        let absurd = Intrinsics::new(1e-300, 1e-300, 1e300, 0.0).unwrap();
        let pose = RelativePose::from((Matrix3::identity(), Vector3::x()));
        let refused = pose.fundamental(&absurd, &k);
        assert!(matches!(refused, Err(Error::NotFinite { .. })));
        // A pure rotation does not determine the direction.
        let mut random = Random::new(3);
        let rays: Vec<_> = (0..20)
            .map(|_| Vector3::new(random.normal(), random.normal(), 3.0))
            .collect();
        let rotation = Rotation3::from_scaled_axis(Vector3::new(0.1, 0.2, -0.1));
        let rotated: Vec<_> = rays.iter().map(|r| rotation * r).collect();
        assert!(matches!(
            essential_8point(&rays, &rotated),
            Err(Error::Degenerate { .. })
        ));
    }
}
