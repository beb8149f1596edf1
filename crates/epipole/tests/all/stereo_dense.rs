//! Dense stereo where the truth is known exactly, on bad input, and on real photographs.

#![allow(clippy::type_complexity, reason = "tests spell their types out")]

use epipole::Error;
use epipole::math::random::Random;
use epipole::progress::{Stage, Status};
use epipole::stereo::{
    DisparityFilter, DisparityImage, StereoBm, StereoCost, StereoPaths, StereoPrefilter, StereoSgm,
    fill_gaps,
};
use image::{GrayImage, ImageBuffer, Luma};
use std::ops::ControlFlow;

/// Fine texture along each row, averaged over quarter pixels.
struct Texture {
    values: Vec<f64>,
    columns: usize,
}

/// Samples of the texture in one pixel.
const FINE: usize = 4;

impl Texture {
    fn new(columns: usize, rows: usize, seed: u64) -> Self {
        let mut random = Random::new(seed);
        let columns = columns * FINE;
        // Noise at two scales: blobs of a few pixels and detail below.
        let coarse: Vec<f64> = (0..(columns / 10 + 2) * (rows / 3 + 2))
            .map(|_| random.uniform(30.0, 220.0))
            .collect();
        let stride = columns / 10 + 2;
        let values = (0..columns * rows)
            .map(|i| {
                let (u, v) = (i % columns, i / columns);
                let (a, b) = ((u % 10) as f64 / 10.0, (v % 3) as f64 / 3.0);
                let at = |du: usize, dv: usize| coarse[(v / 3 + dv) * stride + u / 10 + du];
                let top = at(0, 0) + a * (at(1, 0) - at(0, 0));
                let bottom = at(0, 1) + a * (at(1, 1) - at(0, 1));
                top + b * (bottom - top) + random.uniform(-20.0, 20.0)
            })
            .collect();
        Self { values, columns }
    }

    /// The pixel whose left end is `u` pixels from the texture's left end.
    fn pixel(&self, u: f64, v: u32) -> f64 {
        let begin = u * FINE as f64;
        let whole = begin.floor();
        let fraction = begin - whole;
        let at = |k: usize| {
            let column = (whole as isize + k as isize).clamp(0, self.columns as isize - 1);
            self.values[v as usize * self.columns + column as usize]
        };
        let sum: f64 =
            (1..FINE).map(at).sum::<f64>() + at(0) * (1.0 - fraction) + at(FINE) * fraction;
        sum / FINE as f64
    }

    fn image(&self, width: u32, height: u32, place: impl Fn(f64) -> f64) -> GrayImage {
        GrayImage::from_fn(width, height, |u, v| {
            Luma([(self.pixel(place(f64::from(u)), v) + 0.5) as u8])
        })
    }
}

/// A wall at one disparity.
fn wall(disparity: f64, width: u32, height: u32) -> (GrayImage, GrayImage) {
    let texture = Texture::new(width as usize + 80, height as usize, 11);
    let left = texture.image(width, height, |u| u + 8.0);
    let right = texture.image(width, height, |u| u + 8.0 + disparity);
    (left, right)
}

fn matchers(
    num_disparities: u32,
) -> Vec<(
    String,
    Box<dyn Fn(&GrayImage, &GrayImage) -> DisparityImage>,
)> {
    let mut all: Vec<(
        String,
        Box<dyn Fn(&GrayImage, &GrayImage) -> DisparityImage>,
    )> = vec![];
    for paths in [StereoPaths::Four, StereoPaths::Five, StereoPaths::Eight] {
        for cost in [
            StereoCost::Census,
            StereoCost::BirchfieldTomasi,
            StereoCost::Both,
        ] {
            let matcher = StereoSgm::default()
                .with_num_disparities(num_disparities)
                .with_paths(paths)
                .with_cost(cost);
            all.push((
                format!("{paths:?} {cost:?}"),
                Box::new(move |a, b| matcher.compute(a, b, &mut ()).unwrap()),
            ));
        }
    }
    for prefilter in [StereoPrefilter::XSobel, StereoPrefilter::LocalMean] {
        let matcher = StereoBm::default()
            .with_num_disparities(num_disparities)
            .with_prefilter(prefilter)
            .with_window_px(11);
        all.push((
            format!("{prefilter:?}"),
            Box::new(move |a, b| matcher.compute(a, b, &mut ()).unwrap()),
        ));
    }
    all
}

/// Share answered, share of these within 1 px, and mean error of those, right of column `first`.
fn score(
    disparity: &DisparityImage,
    first: u32,
    truth: impl Fn(u32, u32) -> Option<f64>,
) -> (f64, f64, f64) {
    let (mut all, mut answered, mut good, mut error) = (0.0, 0.0, 0.0, 0.0);
    for v in 0..disparity.height() {
        for u in first..disparity.width() {
            let Some(truth) = truth(u, v) else { continue };
            all += 1.0;
            if let Some(d) = disparity.get(u, v) {
                answered += 1.0;
                let difference = (f64::from(d) - truth).abs();
                if difference < 1.0 {
                    good += 1.0;
                    error += difference;
                }
            }
        }
    }
    (answered / all, good / answered, error / good)
}

#[test]
fn a_wall_is_found_to_a_fraction_of_a_pixel() {
    // Quarters are the hardest: costs lean towards the nearest whole and half.
    for (disparity, most) in [
        (0.0, 0.01),
        (7.0, 0.13),
        (12.25, 0.2),
        (5.5, 0.15),
        (19.75, 0.2),
    ] {
        let (left, right) = wall(disparity, 160, 60);
        for (name, matcher) in matchers(32) {
            let found = matcher(&left, &right);
            let (answered, good, error) =
                score(&found, disparity as u32 + 3, |_, _| Some(disparity));
            assert!(
                answered > 0.93,
                "{name} at {disparity}: {answered} answered"
            );
            assert!(good > 0.99, "{name} at {disparity}: {good} within 1 px");
            assert!(error < most, "{name} at {disparity}: off by {error}");
            // No disparity reaches beyond the border of the right image.
            for v in 0..60 {
                for u in 0..(disparity as u32).saturating_sub(2) {
                    let value = found.get(u, v);
                    assert!(value.is_none_or(|d| f64::from(d) <= f64::from(u) + 0.5));
                }
            }
        }
    }
}

#[test]
fn a_slanted_plane_is_followed() {
    let texture = Texture::new(300, 60, 4);
    // d = 3 + u / 20, so the left column of right column x is (x + 3) / 0.95.
    let left = texture.image(240, 60, |u| u + 8.0);
    let right = texture.image(240, 60, |x| (x + 3.0) / 0.95 + 8.0);
    for (name, matcher) in matchers(32) {
        let found = matcher(&left, &right);
        let (answered, good, error) = score(&found, 20, |u, _| Some(3.0 + f64::from(u) / 20.0));
        assert!(answered > 0.9, "{name}: {answered} answered");
        assert!(good > 0.99, "{name}: {good} within 1 px");
        assert!(error < 0.2, "{name}: off by {error}");
    }
}

/// A board at disparity 14 before a wall at 4: the left image shows 10 columns of wall beside the
/// board that the right one does not.
#[test]
fn what_is_hidden_gets_no_answer_and_is_filled_with_the_background() {
    let (width, height) = (200, 80);
    let (back, front) = (Texture::new(300, 80, 1), Texture::new(300, 80, 2));
    let on_board = |u: f64, v: u32| (100.0..150.0).contains(&u) && (20..60).contains(&v);
    let left = GrayImage::from_fn(width, height, |u, v| {
        let u = f64::from(u);
        let texture = if on_board(u, v) { &front } else { &back };
        Luma([texture.pixel(u + 10.0, v) as u8])
    });
    let right = GrayImage::from_fn(width, height, |x, v| {
        let x = f64::from(x);
        Luma([if on_board(x + 14.0, v) {
            front.pixel(x + 24.0, v) as u8
        } else {
            back.pixel(x + 14.0, v) as u8
        }])
    });
    let is_hidden = |u: u32, v: u32| (90..100).contains(&u) && (20..60).contains(&v);
    let truth = |u: u32, v: u32| if on_board(f64::from(u), v) { 14.0 } else { 4.0 };
    let matcher = StereoSgm::default()
        .with_num_disparities(32)
        .with_filter(DisparityFilter::default().with_max_gap_px(0));
    let found = matcher.compute(&left, &right, &mut ()).unwrap();
    let visible_truth = |u: u32, v: u32| (!is_hidden(u, v)).then(|| truth(u, v));
    let (answered, good, _) = score(&found, 20, visible_truth);
    assert!(answered > 0.95, "{answered} answered");
    assert!(good > 0.98, "{good} within 1 px");
    let hidden = |u: u32, v: u32| is_hidden(u, v).then(|| truth(u, v));
    let (wrongly, _, _) = score(&found, 20, hidden);
    assert!(wrongly < 0.35, "{wrongly} of the hidden pixels answered");
    let filled = fill_gaps(&found, &left, &mut ()).unwrap();
    let (answered, good, _) = score(&filled, 20, |u, v| Some(truth(u, v)));
    assert_eq!(answered, 1.0);
    assert!(good > 0.97, "{good} within 1 px after filling");
}

#[test]
fn a_range_may_begin_anywhere() {
    let (left, right) = wall(20.0, 160, 50);
    let narrow = StereoSgm::default()
        .with_min_disparity_px(16)
        .with_num_disparities(16);
    let (answered, good, _) = score(
        &narrow.compute(&left, &right, &mut ()).unwrap(),
        24,
        |_, _| Some(20.0),
    );
    assert!(answered > 0.95 && good > 0.99);
    let block = StereoBm::default()
        .with_min_disparity_px(16)
        .with_num_disparities(9);
    let (answered, good, _) = score(
        &block.compute(&left, &right, &mut ()).unwrap(),
        24,
        |_, _| Some(20.0),
    );
    assert!(answered > 0.9 && good > 0.99);
    // Exchanged pictures: disparities are negative, and the right border is the open one.
    let negative = StereoSgm::default()
        .with_min_disparity_px(-24)
        .with_num_disparities(20);
    let found = negative.compute(&right, &left, &mut ()).unwrap();
    let (answered, good, _) = score(&found, 0, |u, _| (u < 160 - 24).then_some(-20.0));
    assert!(answered > 0.95 && good > 0.99, "{answered} {good}");
}

#[test]
fn without_texture_blocks_give_no_answers_and_paths_one_surface() {
    let flat = GrayImage::from_pixel(80, 60, Luma([120]));
    for prefilter in [StereoPrefilter::XSobel, StereoPrefilter::LocalMean] {
        let matcher = StereoBm::default().with_prefilter(prefilter);
        assert_eq!(
            matcher.compute(&flat, &flat, &mut ()).unwrap().density(),
            0.0
        );
    }
    // Smoothness alone answers here, if anything does: with one surface.
    let found = StereoSgm::default().compute(&flat, &flat, &mut ()).unwrap();
    if let Some((low, high)) = found.range_px() {
        assert!(high - low < 1.0);
    }
}

#[test]
fn small_pictures_and_wide_ranges_are_no_trouble() {
    for (width, height) in [(1, 1), (2, 3), (7, 1), (1, 9), (20, 15)] {
        let picture = GrayImage::from_fn(width, height, |u, v| Luma([(u * 37 + v * 91) as u8]));
        for paths in [StereoPaths::Four, StereoPaths::Five, StereoPaths::Eight] {
            for num_disparities in [1, 5, 64, 300] {
                let matcher = StereoSgm::default()
                    .with_num_disparities(num_disparities)
                    .with_paths(paths);
                let found = matcher.compute(&picture, &picture, &mut ()).unwrap();
                assert_eq!((found.width(), found.height()), (width, height));
            }
        }
    }
    let picture = GrayImage::from_fn(20, 15, |u, v| Luma([(u * u * 7 + v * 91) as u8]));
    for num_disparities in [1, 5, 64, 300] {
        let matcher = StereoBm::default().with_num_disparities(num_disparities);
        matcher.compute(&picture, &picture, &mut ()).unwrap();
    }
}

#[test]
fn bad_input_is_refused_in_a_sentence() {
    let picture = GrayImage::new(40, 30);
    let sgm = |matcher: StereoSgm| matcher.compute(&picture, &picture, &mut ()).unwrap_err();
    let bm = |matcher: StereoBm| matcher.compute(&picture, &picture, &mut ()).unwrap_err();
    let out_of_range = |error: Error| {
        assert!(matches!(error, Error::OutOfRange { .. }), "{error:?}");
        assert!(error.to_string().contains(" must be "), "{error}");
    };
    for num_disparities in [0, 5000] {
        out_of_range(sgm(
            StereoSgm::default().with_num_disparities(num_disparities)
        ));
        out_of_range(bm(StereoBm::default().with_num_disparities(num_disparities)));
    }
    for min_disparity_px in [40, -40, i32::MIN, i32::MAX] {
        out_of_range(sgm(
            StereoSgm::default().with_min_disparity_px(min_disparity_px)
        ));
        out_of_range(bm(
            StereoBm::default().with_min_disparity_px(min_disparity_px)
        ));
    }
    for window_px in [0, 1, 4, 31, 33, u32::MAX] {
        out_of_range(bm(StereoBm::default().with_window_px(window_px)));
    }
    for prefilter_cap in [0, 64] {
        out_of_range(bm(StereoBm::default().with_prefilter_cap(prefilter_cap)));
    }
    out_of_range(bm(StereoBm::default().with_min_texture(f32::NAN)));
    out_of_range(bm(StereoBm::default().with_filter(
        DisparityFilter::default().with_uniqueness_percent(100),
    )));
    out_of_range(bm(
        StereoBm::default().with_filter(DisparityFilter::default().with_speckle_range_px(-1.0))
    ));
    out_of_range(sgm(StereoSgm::default().with_filter(
        DisparityFilter::default().with_uniqueness_percent(100),
    )));
    out_of_range(sgm(StereoSgm::default().with_filter(
        DisparityFilter::default().with_speckle_range_px(f32::NAN),
    )));
    out_of_range(sgm(StereoSgm::default().with_gray_cap(0)));
    out_of_range(sgm(StereoSgm::default().with_large_step_penalty(151)));
    out_of_range(sgm(StereoSgm::default().with_small_step_penalty(120)));

    let wider = GrayImage::new(41, 30);
    let higher = GrayImage::new(40, 31);
    for other in [&wider, &higher] {
        for error in [
            StereoSgm::default()
                .compute(&picture, other, &mut ())
                .unwrap_err(),
            StereoBm::default()
                .compute(&picture, other, &mut ())
                .unwrap_err(),
        ] {
            assert!(matches!(error, Error::SizeMismatch { .. }), "{error:?}");
        }
    }
    let empty = GrayImage::new(0, 0);
    assert!(matches!(
        StereoSgm::default().compute(&empty, &empty, &mut ()),
        Err(Error::TooFew { .. })
    ));
    let mut float = ImageBuffer::<Luma<f32>, Vec<f32>>::new(40, 30);
    float.put_pixel(3, 3, Luma([f32::NAN]));
    assert!(matches!(
        StereoSgm::default().compute_f32(&float, &float, &mut ()),
        Err(Error::NotFinite { .. })
    ));
    assert!(
        StereoBm::default()
            .compute_f32(&float, &float, &mut ())
            .is_err()
    );
}

#[test]
fn floats_from_0_to_255_are_the_same_pictures() {
    let (mut left, right) = wall(6.0, 100, 40);
    left.put_pixel(50, 20, Luma([0]));
    left.put_pixel(51, 20, Luma([255]));
    let float = |image: &GrayImage, scale: f32| {
        ImageBuffer::from_fn(image.width(), image.height(), |u, v| {
            Luma([f32::from(image.get_pixel(u, v).0[0]) * scale])
        })
    };
    for scale in [1.0, 1.0 / 256.0] {
        let (a, b) = (float(&left, scale), float(&right, scale));
        let sgm = StereoSgm::default();
        assert_eq!(
            sgm.compute_f32(&a, &b, &mut ()).unwrap(),
            sgm.compute(&left, &right, &mut ()).unwrap()
        );
        let bm = StereoBm::default();
        assert_eq!(
            bm.compute_f32(&a, &b, &mut ()).unwrap(),
            bm.compute(&left, &right, &mut ()).unwrap()
        );
    }
}

#[test]
fn work_can_be_watched_and_stopped() {
    let (left, right) = wall(6.0, 100, 90);
    for paths in [StereoPaths::Four, StereoPaths::Five, StereoPaths::Eight] {
        let matcher = StereoSgm::default().with_paths(paths);
        let mut fractions = vec![];
        let mut watch = |status: Status| {
            assert_eq!(status.stage, Stage::DenseMatching);
            fractions.push(status.fraction);
            ControlFlow::Continue(())
        };
        let watched = matcher.compute(&left, &right, &mut watch).unwrap();
        assert_eq!(watched, matcher.compute(&left, &right, &mut ()).unwrap());
        assert!(fractions.len() > 3);
        assert!(fractions.is_sorted() && fractions.iter().all(|s| (0.0..=1.0).contains(s)));
        for stop_at in [0, 2] {
            let mut calls = 0;
            let mut stop = |_| {
                calls += 1;
                if calls > stop_at {
                    ControlFlow::Break(())
                } else {
                    ControlFlow::Continue(())
                }
            };
            let stopped = matcher.compute(&left, &right, &mut stop);
            assert_eq!(stopped, Err(Error::Canceled));
            assert_eq!(calls, stop_at + 1);
        }
    }
    let stopped = StereoBm::default().compute(&left, &right, &mut |_| ControlFlow::Break(()));
    assert_eq!(stopped, Err(Error::Canceled));
}

/// The same bits with threads and without, on every processor: these fingerprints are checked in
/// every build.
#[test]
fn results_are_the_same_everywhere() {
    let (left, right) = wall(9.5, 173, 131);
    let fingerprint = |disparity: DisparityImage| {
        disparity
            .as_raw()
            .iter()
            .fold(0xcbf29ce484222325u64, |hash, d| {
                let bits = if d.is_nan() { 0 } else { d.to_bits() };
                (hash ^ u64::from(bits)).wrapping_mul(0x100000001b3)
            })
    };
    let found: Vec<String> = matchers(40)
        .iter()
        .map(|(name, matcher)| format!("{name}: {:016x}", fingerprint(matcher(&left, &right))))
        .collect();
    let expected = include_str!("stereo_fingerprints.txt");
    assert_eq!(found.join("\n"), expected.trim());
}

/// Ground truth and images of a real pair, or none without data.
fn real_pair(name: &str) -> Option<(GrayImage, GrayImage, Vec<f32>)> {
    let root = std::env::var("EPIPOLE_DATA").unwrap_or_else(|_| {
        concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data").to_string()
    });
    let directory = std::path::Path::new(&root).join("stereo").join(name);
    if !directory.exists() {
        println!("skipped: no data at {}", directory.display());
        return None;
    }
    let ending = if name == "aloe" { "jpg" } else { "png" };
    let open = |file: &str| image::open(directory.join(file)).unwrap();
    let gray = |file: String| epipole::imaging::rgb_to_gray(&open(&file).into_rgb8());
    let scale = match name {
        "tsukuba" => 16.0,
        "teddy" => 4.0,
        _ => 1.0,
    };
    let truth = open("disp.png").into_luma8();
    Some((
        gray(format!("left.{ending}")),
        gray(format!("right.{ending}")),
        truth
            .as_raw()
            .iter()
            .map(|&d| f32::from(d) / scale)
            .collect(),
    ))
}

/// Percent: more than 2 px off of all (no answer counts), of the answered, and answered.
fn bad_2(disparity: &DisparityImage, truth: &[f32]) -> [f64; 3] {
    let (mut all, mut answered, mut bad_answered) = (0.0, 0.0, 0.0);
    for (d, t) in disparity.as_raw().iter().zip(truth) {
        if *t > 0.0 {
            all += 1.0;
            if !d.is_nan() {
                answered += 1.0;
                bad_answered += f64::from(u8::from((d - t).abs() > 2.0));
            }
        }
    }
    let bad = bad_answered + all - answered;
    [bad / all, bad_answered / answered, answered / all].map(|x| 100.0 * x)
}

/// Beside OpenCV 4.14 on the same pairs: StereoSGBM (block 5, P1 200, P2 800, disp12 1,
/// uniqueness 10, speckle 100/2, all eight directions) and StereoBM (block 15), gaps filled from
/// the row's background.
#[test]
fn real_pairs_are_matched_better_than_by_the_usual_matcher() {
    for (name, num_disparities, sgbm, bm) in [
        ("tsukuba", 16, [4.231, 3.86, 98.23], [6.528, 4.351, 91.39]),
        ("teddy", 64, [14.87, 6.81, 80.67], [21.79, 8.137, 70.04]),
        ("aloe", 224, [15.5, 2.967, 71.84], [23.28, 3.877, 62.31]),
    ] {
        let Some((left, right, truth)) = real_pair(name) else {
            continue;
        };
        let ours = [
            (
                StereoSgm::default()
                    .with_num_disparities(num_disparities)
                    .compute(&left, &right, &mut ())
                    .unwrap(),
                sgbm,
            ),
            (
                StereoBm::default()
                    .with_num_disparities(num_disparities)
                    .compute(&left, &right, &mut ())
                    .unwrap(),
                bm,
            ),
        ];
        for (found, [peer_filled, peer_answered, peer_density]) in ours {
            let [_, bad_answered, density] = bad_2(&found, &truth);
            let [bad_filled, _, filled] =
                bad_2(&fill_gaps(&found, &left, &mut ()).unwrap(), &truth);
            println!(
                "{name}: bad-2 filled {bad_filled:.2} % (peer {peer_filled}), of answered \
                 {bad_answered:.2} % (peer {peer_answered}), density {density:.2} % (peer \
                 {peer_density})"
            );
            assert_eq!(filled, 100.0);
            assert!(bad_filled <= peer_filled);
            assert!(bad_answered <= peer_answered);
            assert!(density >= peer_density);
        }
    }
}
