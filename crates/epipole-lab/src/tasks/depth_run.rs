//! Code that estimates the depth of a pair: rectification, then matching along the rows.

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
    /// Rectifies and matches. Photographs of different sizes are resized to one size in which
    /// pixels of both span equal angles.
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
        // Disparities are positive if the second camera is to the right, or below.
        let mut order = [0, 1];
        let mut whole = rectify(&self, &cameras, order, size)?;
        if stands_before(&whole, &cameras) {
            order = [1, 0];
            whole = rectify(&self, &cameras, order, size)?;
        }
        let first = &cameras[order[0]].cam_from_world;
        let places = self.points.iter().map(|place| first * Point3::from(*place));
        let proposed_px = proposed(&whole, &places.collect::<Vec<_>>());
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
        let mut watch = |status: Status| {
            let share = 0.06 + 0.04 * status.fraction;
            monitor(Progress::Share(share, "warping the photographs"))
        };
        let photographs = [&first, &second];
        let redrawn = RectifiedPair::new(&rig, photographs, &mut watch).map_err(sentence)?;
        let mut disparity = redrawn
            .disparity(|left, right| matched(left, right, options, span(range_px, factor), monitor))
            .map_err(sentence)?;
        disparity = unclamped(&disparity, span(range_px, factor), at_infinity(&rig))?;
        if options.fill {
            let mut watch = |status: Status| {
                let share = 0.95 + 0.05 * status.fraction;
                monitor(Progress::Share(share, "filling the gaps"))
            };
            disparity = (redrawn.filled(&disparity, &mut watch)).map_err(sentence)?;
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

/// Returns the disparity of points at infinity, pixels.
fn at_infinity(rig: &Rectification) -> f64 {
    let axis = usize::from(rig.is_vertical);
    let center = |index: usize| rig.intrinsics[index].principal_point()[axis];
    center(0) - center(1)
}

/// Number of points that may be wrong at the far end. Only few points of a background are there,
/// and a range without them is worse than one with some empty disparities.
const WRONG_AND_FAR: usize = 3;
/// Margin beyond the farthest point, pixels.
const BEYOND_FARTHEST: f64 = 2.0;

/// Returns the range given by the sparse points: that of nearly all of them, and of the background.
///
/// * `places`: points visible in both photographs, in the frame of the first one's camera
fn proposed(rig: &Rectification, places: &[Point3<f64>]) -> Option<[i32; 2]> {
    let [low, high] = rig.disparity_range(places).ok()?;
    let seen = places.iter().filter_map(|place| rig.disparity_of(place));
    let mut disparities: Vec<f64> = seen.map(|(_, disparity)| disparity).collect();
    disparities.sort_by(f64::total_cmp);
    let farthest = disparities.get(WRONG_AND_FAR).copied()?;
    let first = (farthest - BEYOND_FARTHEST).max(at_infinity(rig));
    Some([low.min(first.floor() as i32), high])
}

/// Removes disparities at the ends of the range, to which a surface beyond it is matched. The
/// disparity of infinity is no such end, as nothing is beyond it.
fn unclamped(
    disparity: &DisparityImage,
    (first, count): (i32, u32),
    at_infinity: f64,
) -> Result<DisparityImage, String> {
    let last = f64::from(first) + f64::from(count) - 1.0;
    let lowest = match f64::from(first) > at_infinity {
        true => f64::from(first) + END_PX,
        false => f64::NEG_INFINITY,
    };
    let values = disparity.as_raw().iter().map(|d| {
        let is_inside = f64::from(*d) > lowest && f64::from(*d) < last - END_PX;
        if is_inside { *d } else { f32::NAN }
    });
    DisparityImage::from_raw(disparity.width(), disparity.height(), values.collect())
        .map_err(sentence)
}

/// Distance to an end of the range below which disparities are removed, pixels: subpixel refinement
/// moves them by half a pixel at most.
const END_PX: f64 = 0.5;

/// * `width`, `height`: size that both photographs are resized to, pixels
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
        // Pixel centers are integers, so a photograph begins half a pixel before the first.
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
    // All of both photographs: without a border, a camera that rolled a little would leave only a
    // small part.
    let options = RectifyOptions::default().with_alpha(1.0);
    rectify_calibrated(
        &[camera(first)?, camera(second)?],
        &cam2_from_cam1,
        &options,
    )
    .map_err(sentence)
}

/// Resizes a photograph; its aspect ratio may change.
fn resized(image: RgbImage, [width, height]: [u32; 2]) -> RgbImage {
    match image.dimensions() == (width, height) {
        true => image,
        false => resize(&image, width, height, FilterType::Triangle),
    }
}

/// Returns the first rectified camera.
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

/// Whether the second camera is to the left of the first, or above it.
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
            0.1 + 0.85 * status.fraction,
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn answers_at_the_ends_of_the_range_are_none() {
        let values = vec![5.0, 5.4, 5.6, 8.0, 11.4, 11.6, 12.0, f32::NAN];
        let image = DisparityImage::from_raw(4, 2, values).expect("eight values");
        let kept = |at_infinity| {
            let found = unclamped(&image, (5, 8), at_infinity).expect("eight values");
            let values = found.as_raw().iter().copied();
            values.filter(|d| d.is_finite()).collect::<Vec<f32>>()
        };
        assert_eq!(kept(0.0), [5.6, 8.0, 11.4]);
        assert_eq!(kept(5.0), [5.0, 5.4, 5.6, 8.0, 11.4], "nothing is farther");
    }

    #[test]
    fn the_range_holds_a_background_of_few_points() {
        let k = Intrinsics::centered(500.0, 640, 480).expect("a focal length");
        let camera = Camera::pinhole(k, 640, 480);
        let aside = RigidTransform::translation(-0.1, 0.0, 0.0);
        let rig = rectify_calibrated(&[camera, camera], &aside, &RectifyOptions::default())
            .expect("two cameras side by side");
        // An object at 1 m, 50 px, and a wall at 10 m, 5 px.
        let mut places: Vec<Point3<f64>> = (0..1000)
            .map(|n| Point3::new(0.0003 * f64::from(n), 0.0, 1.0))
            .collect();
        places.extend((0..8).map(|n| Point3::new(0.1 * f64::from(n), 0.5, 10.0)));
        let [low, high] = proposed(&rig, &places).expect("more than eight points");
        assert!((1..=4).contains(&low) && high > 50, "{low} {high}");
        // Three far points may be wrong.
        places.truncate(1003);
        let [low, _] = proposed(&rig, &places).expect("more than eight points");
        assert!(low > 40, "{low}");
    }
}
