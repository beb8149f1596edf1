//! Times the image and feature rooms for `tests/peers/time_features.py`, which sets them beside a
//! peer, and leaves what they found for it to compare.
//!
//! Usage: `features_time FOLDER [ROUNDS] [MAX_FEATURES]`. The folder holds `frame.f32`, 1280 × 720
//! gray values; `a.f32` and `b.f32`, 2048 descriptors of 128 numbers each; and `photograph.png`.
//! Prints `name median_ms min_ms note` a line and writes `name.f32`. With `RAYON_NUM_THREADS=1`
//! the time of long work is that on the processor, where Linux tells it, so that other work on the
//! machine disturbs less; else it is the time that passed.

#[path = "timing/clock.rs"]
mod clock;

use clock::now;
use epipole::feature::{
    Descriptors, OrbOptions, Scaling, SiftOptions, StructureTensorOptions, Window, detect_orb,
    detect_sift, harris_response, nearest_two,
};
use epipole::imaging::{Border, gaussian_kernel, gray_from_values, separable_filter, sobel};
use epipole_io::photo::{DecodeOptions, decode_gray};
use std::path::Path;
use std::time::Instant;

const FRAME: (u32, u32) = (1280, 720);
const DIMENSION: usize = 128;

/// Longer work is interrupted by other work on the machine, so its time on the processor counts.
const LONG_MS: f64 = 20.0;

/// Times some work and returns what it found.
fn time<T>(
    name: &str,
    rounds: usize,
    mut work: impl FnMut() -> T,
    note: impl Fn(&T) -> String,
) -> T {
    let epoch = Instant::now();
    let mut last = work();
    let mut times: Vec<f64> = (0..rounds)
        .map(|_| {
            let (before, start) = (now(&epoch), Instant::now());
            last = work();
            let passed = start.elapsed().as_secs_f64() * 1e3;
            if passed > LONG_MS {
                now(&epoch) - before
            } else {
                passed
            }
        })
        .collect();
    times.sort_by(f64::total_cmp);
    println!(
        "{name} {:.4} {:.4} {}",
        times[times.len() / 2],
        times[0],
        note(&last)
    );
    last
}

fn no_note<T>(_: &T) -> String {
    "-".to_owned()
}

fn read(path: &Path) -> std::io::Result<Vec<f32>> {
    let bytes = std::fs::read(path)?;
    let numbers = bytes.chunks_exact(4);
    Ok(numbers
        .map(|b| f32::from_ne_bytes([b[0], b[1], b[2], b[3]]))
        .collect())
}

fn write(path: &Path, numbers: impl IntoIterator<Item = f32>) -> std::io::Result<()> {
    let bytes: Vec<u8> = numbers.into_iter().flat_map(f32::to_ne_bytes).collect();
    std::fs::write(path, bytes)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let folder = Path::new(arguments.first().ok_or("which folder?")?);
    let rounds: usize = arguments.get(1).map_or(Ok(10), |n| n.parse())?;
    let max_features: usize = arguments.get(2).map_or(Ok(0), |n| n.parse())?;

    let frame = gray_from_values(FRAME.0, FRAME.1, read(&folder.join("frame.f32"))?)?;
    let slopes = || sobel(&frame, Border::Reflect101);
    let gradient = time("sobel", 10 * rounds, slopes, no_note);
    let both = gradient.du.iter().chain(gradient.dv.iter()).copied();
    write(&folder.join("sobel.f32"), both)?;
    let kernel = gaussian_kernel(1.1, 5)?;
    let blur = || separable_filter(&frame, &kernel, &kernel, Border::Reflect101, &mut ());
    let blurred = time("gaussian5", 10 * rounds, blur, no_note)?;
    write(&folder.join("gaussian5.f32"), blurred.into_raw())?;
    let options = StructureTensorOptions::default()
        .with_window(Window::Box(3))
        .with_scaling(Scaling::OpenCv);
    let harris = || harris_response(&frame, 0.04, &options, &mut ());
    let response = time("harris", 5 * rounds, harris, no_note)?;
    write(&folder.join("harris.f32"), response.into_raw())?;

    let bytes = std::fs::read(folder.join("photograph.png"))?;
    let image = decode_gray(&bytes, &DecodeOptions::default())?.image;
    let options = SiftOptions::default().with_max_features(max_features);
    let sift = || detect_sift(&image, &options, &mut ());
    time("sift", rounds, sift, |f| {
        f.as_ref().map_or(0, |f| f.keypoints.len()).to_string()
    })?;
    let orb = || detect_orb(&image, &OrbOptions::default(), &mut ());
    time("orb", rounds, orb, |f| {
        f.as_ref().map_or(0, |f| f.keypoints.len()).to_string()
    })?;

    let lists = [read(&folder.join("a.f32"))?, read(&folder.join("b.f32"))?];
    // Whole numbers are compared in integers, others in floats.
    for (name, scale) in [("match_sift", 1.0), ("match_f32", 0.37)] {
        let list = |values: &[f32]| {
            let values = values.iter().map(|value| value * scale).collect();
            Descriptors::from_floats(DIMENSION, values)
        };
        let (first, second) = (list(&lists[0])?, list(&lists[1])?);
        let near = time(
            name,
            rounds,
            || nearest_two(&first, &second, &mut ()),
            no_note,
        )?;
        let indices = near.iter().map(|near| near.index as f32);
        write(&folder.join(format!("{name}.f32")), indices)?;
    }
    Ok(())
}
