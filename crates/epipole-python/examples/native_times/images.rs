//! Functions of images.

use crate::{Outcome, Timers, keep};
use epipole::feature::{
    MatchOptions, detect_orb, detect_sift, good_features_to_track, harris_response,
    match_descriptors, photo_to_gray, track_lucas_kanade,
};
use epipole::image::{GrayImage, Luma, RgbImage};
use epipole::imaging::{
    Border, GrayImage32, WarpOptions, gaussian_blur, gaussian_pyramid, gray_to_f32, gray_to_u8,
    resize, rgb_to_gray, sobel, warp_perspective,
};
use epipole::nalgebra::{Matrix3, Matrix4};
use epipole::stereo::{PixelMap, StereoBm, StereoSgm, depth_image, point_cloud};

const WIDTH: u32 = 1000;
const HEIGHT: u32 = 750;
/// Shift of the right image, pixels.
const SHIFT: u32 = 9;

/// Squares of eight pixels, of gray values that look random.
fn gray(u: u32, v: u32) -> u8 {
    let (u, v) = (u64::from(u / 8), u64::from(v / 8));
    (((u * 73_856_093) ^ (v * 19_349_663)) % 251) as u8
}

pub(crate) fn add(timers: &mut Timers) -> Outcome {
    let bytes = keep(GrayImage::from_fn(WIDTH, HEIGHT, |u, v| Luma([gray(u, v)])));
    let right = keep(GrayImage::from_fn(WIDTH, HEIGHT, |u, v| {
        Luma([gray(u + SHIFT, v)])
    }));
    let color = RgbImage::from_fn(WIDTH, HEIGHT, |u, v| {
        [gray(u, v), gray(v, u), gray(u + 8, v)].into()
    });
    let floats = keep(gray_to_f32(bytes));
    add_filters(timers, bytes, floats, keep(color))?;
    add_features(timers, bytes, right)?;
    add_stereo(timers, bytes, right)
}

fn add_filters(
    timers: &mut Timers,
    bytes: &'static GrayImage,
    floats: &'static GrayImage32,
    color: &'static RgbImage,
) -> Outcome {
    let border = Border::default();
    timers.add("gaussian_blur", move || {
        gaussian_blur(floats, 2.0, border, &mut ())
    });
    timers.add("gaussian_blur, uint8", move || {
        gaussian_blur(&gray_to_f32(bytes), 2.0, border, &mut ()).map(|blurred| gray_to_u8(&blurred))
    });
    timers.add("sobel", move || sobel(floats, border));
    timers.add("resize", move || resize(floats, WIDTH / 2, HEIGHT / 2));
    timers.add("gaussian_pyramid", move || gaussian_pyramid(floats, 5));
    timers.add("rgb_to_gray", move || rgb_to_gray(color));
    timers.add("photo_to_gray", move || photo_to_gray(color));
    timers.add("gray_to_u8", move || gray_to_u8(floats));
    let map = Matrix3::new(1.01, 0.02, -5.0, -0.02, 0.99, 4.0, 1e-5, 0.0, 1.0);
    let options = WarpOptions::new(WIDTH, HEIGHT);
    timers.add("warp_perspective", move || {
        warp_perspective(color, &map, &options, &mut ())
    });
    let map = PixelMap::from_homography(WIDTH, HEIGHT, &map, &mut ())?;
    timers.add("PixelMap.warp", move || map.warp(color, &mut ()));
    Ok(())
}

fn add_features(
    timers: &mut Timers,
    left: &'static GrayImage,
    right: &'static GrayImage,
) -> Outcome {
    let floats = keep(gray_to_f32(left));
    let options = Default::default();
    timers.add("harris_response", move || {
        harris_response(floats, 0.04, &options, &mut ())
    });
    let options = Default::default();
    timers.add("good_features_to_track", move || {
        good_features_to_track(floats, &options, &mut ())
    });
    let points: Vec<_> = good_features_to_track(floats, &options, &mut ())?
        .iter()
        .map(|keypoint| keypoint.point())
        .collect();
    let other = keep(gray_to_f32(right));
    let options = Default::default();
    timers.add("track_lucas_kanade", move || {
        track_lucas_kanade(floats, other, &points, &options, &mut ())
    });
    let (sift, orb) = (Default::default(), Default::default());
    timers.add("detect_sift", move || {
        detect_sift(&gray_to_f32(left), &sift, &mut ())
    });
    timers.add("detect_orb", move || {
        detect_orb(&gray_to_f32(left), &orb, &mut ())
    });
    let matching = MatchOptions::default();
    let first = detect_sift(floats, &sift, &mut ())?.descriptors;
    let second = detect_sift(other, &sift, &mut ())?.descriptors;
    timers.add("match_descriptors, SIFT", move || {
        match_descriptors(&first, &second, &matching, &mut ())
    });
    let first = detect_orb(floats, &orb, &mut ())?.descriptors;
    let second = detect_orb(other, &orb, &mut ())?.descriptors;
    timers.add("match_descriptors, ORB", move || {
        match_descriptors(&first, &second, &matching, &mut ())
    });
    Ok(())
}

fn add_stereo(timers: &mut Timers, left: &'static GrayImage, right: &'static GrayImage) -> Outcome {
    let block = keep(StereoBm::default().with_num_disparities(32));
    timers.add("StereoBm.compute", move || {
        block.compute(left, right, &mut ())
    });
    let semi_global = StereoSgm::default().with_num_disparities(32);
    timers.add("StereoSgm.compute", move || {
        semi_global.compute(left, right, &mut ())
    });
    let disparity = keep(block.compute(left, right, &mut ())?);
    timers.add("depth_image", move || depth_image(disparity, 700.0, 0.2));
    let mut q = Matrix4::identity();
    (q[(0, 3)], q[(1, 3)], q[(2, 3)]) = (-500.0, -375.0, 700.0);
    (q[(2, 2)], q[(3, 2)], q[(3, 3)]) = (0.0, 5.0, 0.0);
    timers.add("point_cloud", move || point_cloud(disparity, &q, None));
    Ok(())
}
