//! Initialization of a calibration.

use super::closed_form::{focals_from_planes, intrinsics_from_planes};
use super::{Board, BoardView};
use crate::camera::{Camera, Intrinsics, Lens, LensKind, RigidTransform};
use crate::homography::fit_homography;
use crate::math::nearest_orthogonal;
use crate::{Error, Result};
use nalgebra::{Matrix3, Point2, Rotation3, UnitQuaternion, Vector3};

/// Focal lengths of fisheyes, in units of the longer side, for fields of view of about 90° to 250°.
const FISHEYE_FOCALS: [f64; 6] = [0.2, 0.28, 0.36, 0.46, 0.6, 0.8];

/// Returns initial intrinsics, the most likely first; at least one.
pub(super) fn starts(
    board: &Board,
    views: &[&BoardView],
    (width, height): (u32, u32),
    kind: LensKind,
) -> Result<Vec<Intrinsics>> {
    let longer = f64::from(width.max(height));
    if kind == LensKind::Fisheye {
        let start = |ratio: f64| Intrinsics::centered(ratio * longer, width, height);
        return FISHEYE_FOCALS.into_iter().map(start).collect();
    }
    let mut homographies = Vec::new();
    for view in views {
        let (on_board, pixels): (Vec<_>, Vec<_>) = view
            .visible()
            .map(|(mark, pixel)| (board.mark(mark), pixel))
            .unzip();
        homographies.push(fit_homography(&on_board, &pixels)?);
    }
    let middle = Point2::new(
        (f64::from(width) - 1.0) / 2.0,
        (f64::from(height) - 1.0) / 2.0,
    );
    // Distortion may lead closed forms to impossible focal lengths.
    let sane = |k: &Intrinsics| {
        let center = k.principal_point();
        let usual = (0.1 * longer)..(50.0 * longer);
        usual.contains(&k.fu_px())
            && usual.contains(&k.fv_px())
            && (center.x - middle.x).abs() < f64::from(width) / 2.0
            && (center.y - middle.y).abs() < f64::from(height) / 2.0
    };
    let mut starts: Vec<Intrinsics> = [
        intrinsics_from_planes(&homographies),
        focals_from_planes(&homographies, &middle),
    ]
    .into_iter()
    .flatten()
    .filter(sane)
    .collect();
    if starts.is_empty() {
        starts.push(Intrinsics::centered(longer, width, height)?);
    }
    Ok(starts)
}

/// Computes `cam_from_board` from one view and the camera.
///
/// # Errors
/// [`Error::TooFew`] and [`Error::Degenerate`] if too few marks are in front of the camera, or all
/// are on one line.
pub(super) fn board_pose(
    board: &Board,
    view: &BoardView,
    camera: &Camera,
) -> Result<RigidTransform> {
    let (mut on_board, mut directions) = (Vec::new(), Vec::new());
    for (mark, pixel) in view.visible() {
        // Beyond about 80° a plane cannot represent directions.
        if let Ok(ray) = camera.ray(&pixel)
            && ray.z > 0.17 * ray.norm()
        {
            on_board.push(board.mark(mark));
            directions.push(Point2::from(ray.xy() / ray.z));
        }
    }
    let homography = fit_homography(&on_board, &directions)?;
    let columns = [0, 1, 2].map(|i| homography.column(i).into_owned());
    let scale = 2.0 / (columns[0].norm() + columns[1].norm());
    // In front of the camera.
    let scale = scale.copysign(columns[2].z);
    let [r1, r2, t] = columns.map(|column: Vector3<f64>| column * scale);
    if !(scale.is_finite() && t.z > 0.0) {
        return Err(Error::Degenerate {
            what: "a board's pose",
            why: "its marks fit no plane in front of the camera",
        });
    }
    let rotation = nearest_orthogonal(&Matrix3::from_columns(&[r1, r2, r1.cross(&r2)]));
    Ok(RigidTransform::from_parts(
        t.into(),
        UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(rotation)),
    ))
}

/// Returns a camera without distortion.
pub(super) fn plain(intrinsics: Intrinsics, kind: LensKind, (width, height): (u32, u32)) -> Camera {
    Camera {
        intrinsics,
        lens: Lens::of(kind, [0.0; crate::camera::MAX_COEFFICIENTS]),
        width,
        height,
    }
}
