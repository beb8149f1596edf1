//! Times the image and feature rooms on one image, for scripts that set them beside peers.
//!
//! Usage: `features_time IMAGE [ROUNDS]`. Prints `name median_ms min_ms note` a line. With
//! `RAYON_NUM_THREADS=1` it is the time that the thread had a processor, where Linux tells it, so
//! that other work on the machine disturbs less; else the time that passed.

mod timing;

use epipole::feature::{
    Descriptors, OrbOptions, SiftOptions, StructureTensorOptions, Window, detect_orb, detect_sift,
    harris_response, nearest_two,
};
use epipole::imaging::{
    Border, DecodeOptions, DerivativeFilter, GrayImage32, decode_gray, derivative_into,
    gaussian_kernel, resize, separable_filter, sobel,
};
use epipole::math::random::Random;
use timing::time;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let bytes = std::fs::read(arguments.first().ok_or("which image?")?)?;
    let rounds: usize = arguments.get(1).map_or(Ok(10), |n| n.parse())?;
    let image = decode_gray(&bytes, &DecodeOptions::default())?.image;
    let frame: GrayImage32 = resize(&image, 1280, 720)?;
    time(
        "sobel",
        10 * rounds,
        || sobel(&frame, Border::Reflect101),
        |_| "-".to_owned(),
    );
    let mut gradient = sobel(&frame, Border::Reflect101);
    let again = || {
        derivative_into(
            &frame,
            DerivativeFilter::Sobel3,
            Border::Reflect101,
            &mut gradient,
        );
    };
    time("sobel_into", 10 * rounds, again, |()| "-".to_owned());
    let kernel = gaussian_kernel(1.1, 5)?;
    let blur = || separable_filter(&frame, &kernel, &kernel, Border::Reflect101);
    time("gaussian5", 10 * rounds, blur, |_| "-".to_owned());
    let options = StructureTensorOptions {
        window: Window::Box(3),
        ..StructureTensorOptions::default()
    };
    time(
        "harris",
        5 * rounds,
        || harris_response(&frame, 0.04, &options),
        |_| "-".to_owned(),
    );
    let sift = || detect_sift(&image, &SiftOptions::default());
    time("sift", rounds, sift, |f| {
        f.as_ref().map_or(0, |f| f.keypoints.len()).to_string()
    });
    let orb = || detect_orb(&image, &OrbOptions::default());
    time("orb", rounds, orb, |f| {
        f.as_ref().map_or(0, |f| f.keypoints.len()).to_string()
    });
    let mut random = Random::new(1);
    let mut list = || -> Vec<u8> { (0..2048 * 128).map(|_| random.below(160) as u8).collect() };
    let (a, b) = (list(), list());
    let floats = |v: &[u8], scale: f32| {
        v.iter()
            .map(|&x| f32::from(x) * scale)
            .collect::<Vec<f32>>()
    };
    let whole = [
        Descriptors::from_floats(128, floats(&a, 1.0))?,
        Descriptors::from_floats(128, floats(&b, 1.0))?,
    ];
    time(
        "match_sift",
        rounds,
        || nearest_two(&whole[0], &whole[1]),
        |_| "-".to_owned(),
    );
    let broken = [
        Descriptors::from_floats(128, floats(&a, 0.37))?,
        Descriptors::from_floats(128, floats(&b, 0.37))?,
    ];
    time(
        "match_f32",
        rounds,
        || nearest_two(&broken[0], &broken[1]),
        |_| "-".to_owned(),
    );
    Ok(())
}
