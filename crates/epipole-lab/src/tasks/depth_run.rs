//! Code that finds the depth of a pair: rectified, matched along the rows.

use super::camera_found::CameraFound;
use super::convert::sentence;
use super::dense::Dense;
use super::depth::FindDepth;
use super::depth_size::{common_size, reduced_factor, span};
use super::task::{Monitor, Progress, Run, report};
use crate::project::{DepthMethod, DepthOptions};
use epipole::camera::{Camera, Intrinsics, Lens, PosedCamera, RigidTransform};
use epipole::progress::Status;
use epipole::stereo::{
    DisparityImage, Rectification, RectifiedPair, RectifyOptions, StereoBm, StereoSgm,
    rectify_calibrated,
};
use image::imageops::{FilterType, resize};
use image::{GrayImage, RgbImage};
use nalgebra::{Point3, UnitQuaternion};

impl Run for FindDepth {
    /// Rectifies and matches. Photographs of two sizes are resized to one in which a pixel of
    /// either spans as large an angle.
    fn run(self, monitor: Monitor<'_>) -> Result<Dense, String> {
        let options = &self.options;
        report(monitor, 0.02, "rectifying")?;
        let sizes = (self.photographs.each_ref()).map(|photo| [photo.width, photo.height]);
        let camera = |n: usize| {
            let [width, height] = sizes[n];
            self.cameras[n].posed((width, height), Lens::NONE)
        };
        let cameras = [camera(0)?, camera(1)?];
        let size = common_size(
            sizes,
            cameras
                .each_ref()
                .map(|camera| camera.camera.intrinsics.fu_px()),
        );
        // Disparities are positive where the second photograph is the one from the right, or from
        // below.
        let mut order = [0, 1];
        let mut whole = rectify(&self, &cameras, order, size)?;
        if stands_before(&whole, &cameras) {
            order = [1, 0];
            whole = rectify(&self, &cameras, order, size)?;
        }
        let first = &cameras[order[0]].cam_from_world;
        let places = self.points.iter().map(|place| first * Point3::from(*place));
        let proposed_px = whole.disparity_range(&places.collect::<Vec<_>>()).ok();
        let range_px = match (options.range_px, proposed_px) {
            (Some(range), _) | (None, Some(range)) => range,
            (None, None) => {
                return Err(
                    "the two share too few points to propose a range of disparities: type one"
                        .to_owned(),
                );
            }
        };
        let factor = reduced_factor(size, range_px);
        let small = size.map(|side| (side / factor).max(1));
        let rig = match factor {
            1 => whole,
            _ => rectify(&self, &cameras, order, small)?,
        };
        report(monitor, 0.06, "warping the photographs")?;
        let image =
            |index: usize| Ok::<_, String>(resized(self.photographs[index].to_image()?, small));
        let (first, second) = (image(order[0])?, image(order[1])?);
        let redrawn = RectifiedPair::new(&rig, [&first, &second]).map_err(sentence)?;
        let mut disparity = redrawn
            .disparity(|left, right| matched(left, right, options, span(range_px, factor), monitor))
            .map_err(sentence)?;
        if options.fill {
            disparity = redrawn.filled(&disparity).map_err(sentence)?;
        }
        let num_answers = disparity.as_raw().iter().filter(|d| d.is_finite()).count();
        let num_shown = redrawn.num_shown();
        let [left, right] = redrawn.pictures();
        Ok(Dense {
            width: rig.width,
            height: rig.height,
            factor,
            is_vertical: rig.is_vertical,
            is_swapped: order == [1, 0],
            camera: rectified_camera(&rig, &cameras[order[0]]),
            baseline: rig.baseline_m,
            proposed_px,
            range_px,
            num_shown: num_shown as u32,
            density: num_answers as f64 / num_shown.max(1) as f64,
            disparity: (disparity.as_raw().iter())
                .flat_map(|d| d.to_le_bytes())
                .collect::<Vec<u8>>()
                .into(),
            left: left.as_raw().clone().into(),
            right: right.as_raw().clone().into(),
        })
    }
}

/// * `width`, `height`: what both photographs are resized to, pixels
fn rectify(
    pair: &FindDepth,
    cameras: &[PosedCamera; 2],
    [first, second]: [usize; 2],
    [width, height]: [u32; 2],
) -> Result<Rectification, String> {
    let sentence = |error: epipole::Error| format!("these two cannot be rectified: {error}");
    let camera = |index: usize| -> Result<Camera, String> {
        let photograph = &pair.photographs[index];
        let shares = [
            f64::from(width) / f64::from(photograph.width),
            f64::from(height) / f64::from(photograph.height),
        ];
        let k = cameras[index].camera.intrinsics;
        let center = k.principal_point();
        // Pixel centers are whole numbers, so a photograph begins half a pixel before the first.
        let moved = |at: f64, share: f64| (at + 0.5) * share - 0.5;
        Ok(Camera {
            width,
            height,
            intrinsics: Intrinsics::new(
                k.fu_px() * shares[0],
                k.fv_px() * shares[1],
                moved(center.x, shares[0]),
                moved(center.y, shares[1]),
            )
            .map_err(sentence)?,
            lens: pair.lens,
        })
    };
    let cam2_from_cam1: RigidTransform =
        cameras[second].cam_from_world * cameras[first].cam_from_world.inverse();
    // All of both photographs: a camera that rolled a little would leave only a small part without
    // a border.
    let options = RectifyOptions::default().with_alpha(1.0);
    rectify_calibrated(
        &[camera(first)?, camera(second)?],
        &cam2_from_cam1,
        &options,
    )
    .map_err(sentence)
}

/// The photograph in another size, whose sides need not keep their proportion.
fn resized(image: RgbImage, [width, height]: [u32; 2]) -> RgbImage {
    match image.dimensions() == (width, height) {
        true => image,
        false => resize(&image, width, height, FilterType::Triangle),
    }
}

/// The first rectified camera.
fn rectified_camera(rig: &Rectification, first: &PosedCamera) -> CameraFound {
    let k = rig.intrinsics[0];
    let center = k.principal_point();
    let rotation = UnitQuaternion::from_rotation_matrix(&rig.rect_from_cam[0]);
    let rect_from_world = RigidTransform::from_parts(nalgebra::Translation3::identity(), rotation)
        * first.cam_from_world;
    CameraFound {
        intrinsics: [k.fu_px(), k.fv_px(), center.x, center.y],
        rotation: rect_from_world.rotation.coords.into(),
        translation: rect_from_world.translation.vector.into(),
    }
}

/// Whether the second camera stands to the left of the first, or above it.
fn stands_before(rig: &Rectification, cameras: &[PosedCamera; 2]) -> bool {
    let second: Point3<f64> = cameras[1].cam_from_world.inverse() * Point3::origin();
    let in_first = cameras[0].cam_from_world * second;
    let turned = rig.rect_from_cam[0] * in_first;
    match rig.is_vertical {
        true => turned.y < 0.0,
        false => turned.x < 0.0,
    }
}

fn matched(
    left: &GrayImage,
    right: &GrayImage,
    options: &DepthOptions,
    (min_disparity_px, num_disparities): (i32, u32),
    monitor: Monitor<'_>,
) -> Result<DisparityImage, epipole::Error> {
    let mut watch = |status: Status| {
        monitor(Progress::Share(
            0.1 + 0.85 * status.share,
            status.stage.words(),
        ))
    };
    match options.method {
        DepthMethod::SemiGlobal => StereoSgm::default()
            .with_min_disparity_px(min_disparity_px)
            .with_num_disparities(num_disparities)
            .compute(left, right, &mut watch),
        DepthMethod::Block => StereoBm::default()
            .with_min_disparity_px(min_disparity_px)
            .with_num_disparities(num_disparities)
            .compute(left, right, &mut watch),
    }
}
