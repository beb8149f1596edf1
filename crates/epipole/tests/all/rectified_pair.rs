//! Depth in photographs that are redrawn for a rectified rig, against the truth of a rendered
//! scene.

use epipole::Result;
use epipole::camera::{Camera, PosedCamera, look_at, relative_motion};
use epipole::image::GrayImage;
use epipole::nalgebra::{Point2, Point3, Vector3};
use epipole::stereo::{
    DisparityImage, Rectification, RectifiedPair, RectifyOptions, StereoSgm, point_cloud,
    rectify_calibrated,
};
use epipole_scenes::{Photograph, Sampling, Scene, still_life_camera};

const SIZE: (u32, u32) = (320, 240);

/// The still life from the book's own place and from one beside it, meters.
fn pair(aside: Vector3<f64>) -> ([PosedCamera; 2], [Photograph; 2]) {
    let first = still_life_camera(SIZE.0, SIZE.1);
    let center = first.center_in_world() + aside;
    let target = Point3::new(0.02, -0.16, 0.05);
    let second = PosedCamera {
        cam_from_world: look_at(&center, &target, &Vector3::new(0.0, -1.0, 0.0)).unwrap(),
        ..first
    };
    let cameras = [first, second];
    let scene = Scene::still_life();
    let take = |camera| {
        scene
            .render(&camera, SIZE.0, SIZE.1, Sampling::Full)
            .unwrap()
    };
    (cameras, cameras.map(take))
}

fn rig_of(cameras: &[PosedCamera; 2]) -> Result<Rectification> {
    let motion = relative_motion(&cameras[0].cam_from_world, &cameras[1].cam_from_world);
    let cameras = cameras.map(|camera| Camera::pinhole(camera.camera.intrinsics, SIZE.0, SIZE.1));
    let options = RectifyOptions::default().with_alpha(1.0);
    rectify_calibrated(&cameras, &motion, &options)
}

/// Some true points, in the frame of camera 1.
fn places(camera: &PosedCamera, photo: &Photograph) -> Vec<Point3<f64>> {
    let pixels = (0..SIZE.1)
        .step_by(12)
        .flat_map(|v| (0..SIZE.0).step_by(12).map(move |u| (u, v)));
    let place = |(u, v): (u32, u32)| {
        let pixel = Point2::new(f64::from(u), f64::from(v));
        let depth = f64::from(photo.depth_m.get_pixel(u, v).0[0]);
        Point3::from(camera.camera.intrinsics.ray(&pixel) * depth)
    };
    pixels.map(place).collect()
}

/// Depths against the truth, for cameras beside, on the other side, and above.
#[test]
fn depth_is_the_scene_for_any_second_camera() {
    for aside in [[0.2, 0.0], [-0.2, 0.0], [0.0, -0.2], [0.0, 0.2]] {
        let (cameras, photos) = pair(Vector3::new(aside[0], aside[1], 0.0));
        let rig = rig_of(&cameras).unwrap();
        assert_eq!(rig.is_vertical, aside[0] == 0.0);
        let [first, end] = rig
            .disparity_range(&places(&cameras[0], &photos[0]))
            .unwrap();
        let images = photos.each_ref().map(|photo| &photo.image);
        let redrawn = RectifiedPair::new(&rig, images, &mut ()).unwrap();
        let matcher = StereoSgm::default()
            .with_min_disparity_px(first)
            .with_num_disparities((end - first + 1) as u32);
        let found = redrawn
            .disparity(|left, right| matcher.compute(left, right, &mut ()))
            .unwrap();
        let cloud = point_cloud(&found, &rig.q, None).unwrap();
        let mut errors: Vec<f64> = (cloud.points.iter())
            .map(|point| rig.rect_from_cam[0].inverse() * point)
            .filter_map(|place| {
                let pixel = cameras[0].camera.intrinsics.project(&place).unwrap();
                let (u, v) = (pixel.x.round() as u32, pixel.y.round() as u32);
                let truth = photos[0].depth_m.get_pixel_checked(u, v)?;
                Some((place.z / f64::from(truth.0[0]) - 1.0).abs())
            })
            .collect();
        errors.sort_by(f64::total_cmp);
        let (half, most) = (errors[errors.len() / 2], errors[errors.len() * 9 / 10]);
        assert!(
            errors.len() > redrawn.num_shown() / 3,
            "{aside:?}: {}",
            errors.len()
        );
        assert!(half < 0.01 && most < 0.05, "{aside:?}: {half} {most}");
        // Every pixel that the photograph fills has an answer then, and no other; given ones stay.
        let filled = redrawn.filled(&found, &mut ()).unwrap();
        let answered =
            |image: &DisparityImage| image.as_raw().iter().filter(|d| !d.is_nan()).count();
        assert_eq!(answered(&filled), redrawn.num_shown());
        for (unfilled, value) in found.as_raw().iter().zip(filled.as_raw()) {
            assert!(unfilled.is_nan() || unfilled == value);
        }
    }
}

#[test]
fn borders_and_what_matches_them_have_no_answer() {
    let (cameras, photos) = pair(Vector3::new(0.2, 0.0, 0.0));
    let rig = rig_of(&cameras).unwrap();
    let images = photos.each_ref().map(|photo| &photo.image);
    let redrawn = RectifiedPair::new(&rig, images, &mut ()).unwrap();
    let everywhere = |left: &GrayImage, _: &GrayImage| {
        let number = (left.width() * left.height()) as usize;
        DisparityImage::from_raw(left.width(), left.height(), vec![30.0; number])
    };
    let found = redrawn.disparity(everywhere).unwrap();
    let black =
        |index: usize, u: u32, v: u32| redrawn.pictures()[index].get_pixel(u, v).0 == [0; 3];
    let mut num_valid = 0;
    for (u, v) in (0..rig.height).flat_map(|v| (0..rig.width).map(move |u| (u, v))) {
        if found.get(u, v).is_some() {
            num_valid += 1;
            assert!(
                u >= 30 && !black(0, u, v) && !black(1, u - 30, v),
                "{u} {v}"
            );
        }
    }
    assert!(num_valid > 1000 && num_valid < redrawn.num_shown());
}

#[test]
fn a_point_behind_the_camera_has_no_disparity() {
    let (cameras, _) = pair(Vector3::new(0.2, 0.0, 0.0));
    let rig = rig_of(&cameras).unwrap();
    for place in [
        Point3::new(0.0, 0.0, -1.0),
        Point3::new(f64::NAN, 0.0, 1.0),
        Point3::origin(),
    ] {
        assert_eq!(rig.disparity_of(&place), None);
    }
}
