//! A few small pictures of every figure, compared with a tolerance.
//!
//! They catch a picture that is empty, shifted or in the wrong colors, not single pixels. After an
//! intended change, `EPIPOLE_BLESS=1 cargo test -p epipole-widgets --test golden` rewrites them.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use epipole_widgets::Figure;
use epipole_widgets::theme::Theme;
use image::{Rgb, RgbImage};
use std::path::PathBuf;

/// Pixels of the picture for each pixel of the golden one, along each side.
const BLOCK: u32 = 8;
/// Largest mean difference of a channel, gray levels.
const MEAN: f64 = 1.5;
/// Largest difference of one channel, gray levels.
const MOST: u8 = 40;

const GOLDEN: &[(&str, &str, &str, Theme)] = &[
    ("epipolar-click", "", "epipolar-click.png", Theme::Light),
    (
        "epipolar-click",
        "baseline=0.10&forward=0.40&turn=0",
        "epipolar-click-inside.png",
        Theme::Dark,
    ),
    (
        "homography-drag",
        "width=62&height=46",
        "homography-drag.png",
        Theme::Light,
    ),
    (
        "plane-or-not",
        "show=warped&many=true",
        "plane-or-not.png",
        Theme::Dark,
    ),
    (
        "flow-window",
        "place=118,74&motion=2,-0.8",
        "flow-window.png",
        Theme::Light,
    ),
    ("track", "frame=10,0", "track.png", Theme::Dark),
    ("odometry", "", "odometry.png", Theme::Light),
    (
        "incremental-sfm",
        "now=3,0",
        "incremental-sfm.png",
        Theme::Light,
    ),
    (
        "optimal-plane",
        "forward=0.6",
        "optimal-plane.png",
        Theme::Dark,
    ),
    ("sub-pixel", "noise=10", "sub-pixel.png", Theme::Light),
    ("three-rays", "", "three-rays.png", Theme::Light),
    ("flat-scene", "spread=0", "flat-scene.png", Theme::Light),
    (
        "fundamental-entries",
        "entry=f11&change=0.20",
        "fundamental-entries.png",
        Theme::Dark,
    ),
    ("ransac-race", "", "ransac-race.png", Theme::Light),
    ("scale-drift", "", "scale-drift.png", Theme::Light),
    ("stereo-slider", "", "stereo-slider.png", Theme::Light),
    (
        "stereo-slider",
        "baseline=0.30&object=-0.4,6",
        "stereo-slider-far.png",
        Theme::HighContrast,
    ),
    (
        "window-search",
        "window=5&place=170,214&candidate=22,0",
        "window-search.png",
        Theme::Dark,
    ),
    (
        "path-costs",
        "place=196,108",
        "path-costs.png",
        Theme::Light,
    ),
    (
        "keypoint-orientation",
        "keypoint=144,96",
        "keypoint-orientation.png",
        Theme::Dark,
    ),
];

#[test]
fn pictures_look_as_before() {
    let folder = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/golden"));
    let is_blessing = std::env::var_os("EPIPOLE_BLESS").is_some();
    let mut wrong = Vec::new();
    for (name, query, file, theme) in GOLDEN {
        let mut figure = Figure::new(name).unwrap();
        assert_eq!(figure.apply_query(query), []);
        let small = reduced(&mut figure, *theme);
        let path = folder.join(file);
        if is_blessing {
            small.save(&path).unwrap();
            let size = std::fs::metadata(&path).unwrap().len();
            assert!(size <= 20 * 1024, "{file} has {size} bytes");
            continue;
        }
        let golden = image::open(&path)
            .unwrap_or_else(|error| panic!("{file}: {error}"))
            .to_rgb8();
        if golden.dimensions() != small.dimensions() {
            wrong.push(format!("{file} has another size"));
            continue;
        }
        let differences: Vec<u8> = golden
            .iter()
            .zip(small.iter())
            .map(|(a, b)| a.abs_diff(*b))
            .collect();
        let sum: f64 = differences.iter().map(|&d| f64::from(d)).sum();
        let mean = sum / differences.len() as f64;
        let most = differences.iter().copied().max().unwrap_or(0);
        if mean > MEAN || most > MOST {
            wrong.push(format!("{file}: mean {mean:.2}, largest {most}"));
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}

/// Returns the settled picture, averaged over blocks.
fn reduced(figure: &mut Figure, theme: Theme) -> RgbImage {
    let drawn = figure.draw_settled(600.0, 1.0, theme);
    let picture = drawn.expect("the size is good");
    let (width, bytes) = (picture.width() as usize, picture.rgba());
    RgbImage::from_fn(picture.width() / BLOCK, picture.height() / BLOCK, |x, y| {
        let mut sums = [0u32; 3];
        for row in y * BLOCK..(y + 1) * BLOCK {
            for column in x * BLOCK..(x + 1) * BLOCK {
                let at = (row as usize * width + column as usize) * 4;
                for channel in 0..3 {
                    sums[channel] += u32::from(bytes[at + channel]);
                }
            }
        }
        Rgb(sums.map(|sum| (sum / (BLOCK * BLOCK)) as u8))
    })
}
