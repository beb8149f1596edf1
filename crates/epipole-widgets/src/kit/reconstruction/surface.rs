//! Dense points: the pair is rectified with the estimated cameras, and stereo matching finds a
//! point for each pixel of the first photograph.

use crate::contract::{Panel, Progress};
use crate::kit::space::Space;
use epipole::Error;
use epipole::camera::{Camera, RigidTransform};
use epipole::progress::Status;
use epipole::stereo::{
    DisparityFilter, DisparityImage, PointCloud, RectifiedPair, RectifyOptions, StereoSgm,
    point_cloud, rectify_calibrated,
};
use image::RgbImage;
use nalgebra::Point3;
use serde::{Deserialize, Serialize};

/// Longer side of the rectified images, pixels; more has no visible benefit in a figure.
const LONGEST_PX: u32 = 480;
/// Maximum number of disparities, for speed; those of the farthest points are dropped.
const MOST_DISPARITIES: u32 = 192;
/// Minimum size of a consistent region, pixels; smaller ones are matching errors.
const SPECKLE_PX: u32 = 150;

/// The pixels of camera 1 with known depth.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Surface {
    /// Positions in the frame of camera 1, in units of the baseline, and colors. The first quarter
    /// is a regular subsample; both parts are in row order.
    pub(crate) points: Vec<([f32; 3], [u8; 3])>,
    num_coarse: u32,
}

impl Surface {
    /// Returns the regular subsample, dense enough for a figure.
    pub(crate) fn coarse(&self) -> &[([f32; 3], [u8; 3])] {
        &self.points[..(self.num_coarse as usize).min(self.points.len())]
    }

    /// Draws the first `share` of the points, 0 to 1.
    pub(crate) fn draw(&self, space: &mut Space<'_>, share: f64, panel: &Panel) {
        let side = (panel.rect.height / 130.0).clamp(1.6, 3.4);
        let all = self.coarse();
        let shown = (share * all.len() as f64) as usize;
        for (place, color) in &all[..shown] {
            space.speck(&Point3::from(*place).cast(), side, *color);
        }
    }
}

/// Computes the surface by stereo matching.
///
/// * `photographs`, `cameras`: the pair, without distortion; equal sizes
/// * `cam2_from_cam1`: the motion, in units of the baseline
/// * `places`: points visible to both cameras, in the frame of camera 1
///
/// # Errors
/// As [`rectify_calibrated`], `disparity_range` of the rig, [`RectifiedPair::new`] and
/// [`StereoSgm::compute`].
pub(super) fn surface(
    photographs: [&RgbImage; 2],
    cameras: &[Camera; 2],
    cam2_from_cam1: &RigidTransform,
    places: &[Point3<f64>],
    progress: Progress<'_>,
) -> Result<Surface, Error> {
    let (width, height) = photographs[0].dimensions();
    let shrunk = (f64::from(LONGEST_PX) / f64::from(width.max(height))).min(1.0);
    let side = |length: u32| (f64::from(length) * shrunk).round().max(1.0) as u32;
    let options = RectifyOptions::default()
        // Keeps all pixels of the photographs, not only the common rectangle.
        .with_alpha(1.0)
        .with_size(Some((side(width), side(height))));
    let rig = rectify_calibrated(cameras, cam2_from_cam1, &options)?;
    let redrawn = RectifiedPair::new(&rig, photographs, &mut ())?;
    let (min_disparity_px, num_disparities) = searched(rig.disparity_range(places)?);
    let matcher = StereoSgm::default()
        .with_min_disparity_px(min_disparity_px)
        .with_num_disparities(num_disparities)
        .with_filter(DisparityFilter::default().with_speckle_size(SPECKLE_PX));
    let found = redrawn.disparity(|first, second| {
        matcher.compute(first, second, &mut |status: Status| {
            progress(f64::from(status.fraction))
        })
    })?;
    // First every other pixel of every other row, then the rest.
    let part = |is_coarse: bool| -> Result<PointCloud, Error> {
        let value = |index: u32| {
            let (u, v) = (index % found.width(), index / found.width());
            let is_wanted = (u.is_multiple_of(2) && v.is_multiple_of(2)) == is_coarse;
            found.get(u, v).filter(|_| is_wanted).unwrap_or(f32::NAN)
        };
        let values = (0..found.width() * found.height()).map(value).collect();
        let part = DisparityImage::from_raw(found.width(), found.height(), values)?;
        point_cloud(&part, &rig.q, Some(&redrawn.pictures()[0]))
    };
    let (coarse, fine) = (part(true)?, part(false)?);
    let cam1_from_rect = rig.rect_from_cam[0].inverse();
    let places = coarse.points.iter().chain(&fine.points);
    Ok(Surface {
        num_coarse: coarse.points.len() as u32,
        points: places
            .map(|point| cam1_from_rect * point)
            .map(|p| [p.x as f32, p.y as f32, p.z as f32])
            .zip(coarse.colors.iter().chain(&fine.colors).copied())
            .collect(),
    })
}

/// Returns the smallest disparity and the number of disparities to search. If there are too many,
/// keeps those of near points, far from 0.
fn searched([first, last]: [i32; 2]) -> (i32, u32) {
    let count = last.abs_diff(first).saturating_add(1).min(MOST_DISPARITIES);
    match last.unsigned_abs() >= first.unsigned_abs() {
        true => (last - count as i32 + 1, count),
        false => (first, count),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use epipole::camera::{PosedCamera, look_at, relative_motion};
    use epipole_scenes::{Photograph, Sampling, Scene, still_life_camera};
    use nalgebra::Point2;
    use nalgebra::Vector3;
    use std::ops::ControlFlow;

    const SIZE: (u32, u32) = (320, 240);

    /// Renders the still life from the book's own camera and from one shifted by `aside`, meters.
    fn pair(aside: Vector3<f64>) -> ([PosedCamera; 2], [Photograph; 2]) {
        let first = still_life_camera(SIZE.0, SIZE.1);
        let center = first.center_in_world() + aside;
        let target = Point3::new(0.02, -0.16, 0.05);
        let up = Vector3::new(0.0, -1.0, 0.0);
        let second = PosedCamera {
            cam_from_world: look_at(&center, &target, &up).unwrap(),
            ..first
        };
        let scene = Scene::still_life();
        let cameras = [first, second];
        let photographs = cameras.map(|camera| {
            scene
                .render(&camera, SIZE.0, SIZE.1, Sampling::Full)
                .unwrap()
        });
        (cameras, photographs)
    }

    /// Computes the surface of a pair with known cameras and some true points.
    fn found(cameras: &[PosedCamera; 2], photographs: &[Photograph; 2]) -> Result<Surface, Error> {
        let motion = relative_motion(&cameras[0].cam_from_world, &cameras[1].cam_from_world);
        let places: Vec<_> = (0..SIZE.1)
            .step_by(16)
            .flat_map(|v| (0..SIZE.0).step_by(16).map(move |u| (u, v)))
            .map(|(u, v)| {
                let pixel = Point2::new(f64::from(u), f64::from(v));
                let depth = f64::from(photographs[0].depth_m.get_pixel(u, v).0[0]);
                Point3::from(cameras[0].camera.intrinsics.ray(&pixel) * depth)
            })
            .collect();
        let images = photographs.each_ref().map(|photograph| &photograph.image);
        let cameras = cameras.map(|posed| posed.camera);
        let go_on = &mut |_| ControlFlow::Continue(());
        surface(images, &cameras, &motion, &places, go_on)
    }

    #[test]
    fn pixels_stand_where_the_scene_is_and_a_quarter_comes_first() {
        let (cameras, photographs) = pair(Vector3::new(0.2, 0.0, 0.0));
        let surface = found(&cameras, &photographs).unwrap();
        let mut errors: Vec<f64> = (surface.points.iter())
            .filter_map(|(place, _)| {
                let place = Point3::from(*place).cast::<f64>();
                let pixel = cameras[0].camera.intrinsics.project(&place).unwrap();
                let (u, v) = (pixel.x.round() as u32, pixel.y.round() as u32);
                let truth = photographs[0].depth_m.get_pixel_checked(u, v)?;
                Some((place.z / f64::from(truth.0[0]) - 1.0).abs())
            })
            .collect();
        errors.sort_by(f64::total_cmp);
        let (half, most) = (errors[errors.len() / 2], errors[errors.len() * 9 / 10]);
        assert!(
            errors.len() > (SIZE.0 * SIZE.1) as usize / 3,
            "{}",
            errors.len()
        );
        assert!(half < 0.01 && most < 0.05, "{half} {most}");
        let (coarse, all) = (surface.coarse().len(), surface.points.len());
        assert!(coarse > all / 5 && coarse < all / 3, "{coarse} of {all}");
    }

    #[test]
    fn of_too_many_disparities_the_near_ones_are_looked_for() {
        assert_eq!(searched([5, 40]), (5, 36));
        assert_eq!(searched([5, 400]), (209, 192));
        assert_eq!(searched([-400, -5]), (-400, 192));
    }

    #[test]
    fn what_has_no_common_rows_says_so() {
        let (cameras, photographs) = pair(Vector3::new(0.0, 0.0, 0.4));
        assert!(matches!(
            found(&cameras, &photographs),
            Err(Error::Degenerate { .. })
        ));
        let (cameras, mut photographs) = pair(Vector3::new(0.2, 0.0, 0.0));
        photographs[1].image = RgbImage::new(SIZE.0, SIZE.1 - 1);
        assert!(matches!(
            found(&cameras, &photographs),
            Err(Error::SizeMismatch { .. })
        ));
    }
}
