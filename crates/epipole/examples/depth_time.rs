//! Times dense stereo and bundle adjustment, for scripts that set them beside peers.
//!
//! * `depth_time scene FOLDER` renders a rectified pair of 640 × 480 pixels: `left.png`,
//!   `right.png` and the true disparities of the left picture, `truth.pfm`
//! * `depth_time stereo FOLDER ROUNDS` times the matchers on that pair and writes what they find to
//!   `ours_NAME.pfm`; prints `name median_ms min_ms -` a line
//! * `depth_time ba PROBLEM.txt COST ROUNDS` times a bundle adjustment until it reaches a cost, and
//!   prints the same with the cost reached in place of `-`

mod timing;

use epipole::camera::RigidTransform;
use epipole::imaging::rgb_to_gray;
use epipole::optim::{LmOptions, RobustLoss};
use epipole::sfm::adjust_bal;
use epipole::stereo::{DisparityImage, StereoBm, StereoPaths, StereoSgm};
use epipole_io::bundle::read_bal;
use epipole_io::disparity::write_pfm;
use epipole_io::photo::{DecodeOptions, decode_rgb};
use epipole_scenes::{Sampling, Scene, still_life_camera};
use std::path::Path;
use timing::timed;

const SIZE: (u32, u32) = (640, 480);
/// Makes disparities of 16 to 60 pixels.
const BASELINE_M: f64 = 0.06;

type Outcome = Result<(), Box<dyn std::error::Error>>;

fn main() -> Outcome {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words[..] {
        ["scene", folder] => scene(Path::new(folder)),
        ["stereo", folder, rounds] => stereo(Path::new(folder), rounds.parse()?),
        ["ba", problem, cost, rounds] => adjust(problem, cost.parse()?, rounds.parse()?),
        _ => Err("scene FOLDER, stereo FOLDER ROUNDS or ba PROBLEM COST ROUNDS".into()),
    }
}

/// Times work in rounds, and prints `name median_ms min_ms note`.
fn time<T>(name: &str, rounds: usize, work: impl FnMut() -> T, note: impl Fn(&T) -> String) {
    let timed = timed(rounds, work);
    let note = note(&timed.last);
    println!("{name} {:.4} {:.4} {note}", timed.median_ms, timed.least_ms);
}

fn scene(folder: &Path) -> Outcome {
    let camera = still_life_camera(SIZE.0, SIZE.1);
    let mut right = camera;
    right.cam_from_world =
        RigidTransform::translation(-BASELINE_M, 0.0, 0.0) * camera.cam_from_world;
    let still_life = Scene::still_life();
    let left = still_life.render(&camera, SIZE.0, SIZE.1, Sampling::Full)?;
    let right = still_life.render(&right, SIZE.0, SIZE.1, Sampling::Full)?;
    left.image.save(folder.join("left.png"))?;
    right.image.save(folder.join("right.png"))?;
    let focal_px = camera.camera.intrinsics.fu_px();
    let of_depth = |depth: &f32| (focal_px * BASELINE_M / f64::from(*depth)) as f32;
    let values = left.depth_m.iter().map(of_depth).collect();
    let truth = DisparityImage::from_raw(SIZE.0, SIZE.1, values)?;
    std::fs::write(folder.join("truth.pfm"), write_pfm(&truth))?;
    Ok(())
}

fn stereo(folder: &Path, rounds: usize) -> Outcome {
    let read = |name: &str| -> Result<_, Box<dyn std::error::Error>> {
        let bytes = std::fs::read(folder.join(name))?;
        Ok(rgb_to_gray(
            &decode_rgb(&bytes, &DecodeOptions::default())?.image,
        ))
    };
    let (left, right) = (read("left.png")?, read("right.png")?);
    let run = |name: &str, work: &dyn Fn() -> epipole::Result<DisparityImage>| -> Outcome {
        time(name, rounds, work, |_| "-".to_owned());
        std::fs::write(folder.join(format!("ours_{name}.pfm")), write_pfm(&work()?))?;
        Ok(())
    };
    // With the tests that OpenCV's has, and no others.
    let plain = StereoBm::default().with_filter(
        StereoBm::default()
            .filter
            .with_left_right_max_px(None)
            .with_speckle_size(0),
    );
    run("bm_plain", &|| plain.compute(&left, &right, &mut ()))?;
    run("bm", &|| {
        StereoBm::default().compute(&left, &right, &mut ())
    })?;
    for (name, paths) in [
        ("sgm_4", StereoPaths::Four),
        ("sgm_5", StereoPaths::Five),
        ("sgm_8", StereoPaths::Eight),
    ] {
        let matcher = StereoSgm::default().with_paths(paths);
        run(name, &|| matcher.compute(&left, &right, &mut ()))?;
    }
    Ok(())
}

fn adjust(path: &str, cost: f64, rounds: usize) -> Outcome {
    let problem = read_bal(&std::fs::read_to_string(path)?)?;
    let adjust = |max_iterations| {
        let options = LmOptions::default().with_max_iterations(max_iterations);
        adjust_bal(&mut problem.clone(), &options, RobustLoss::Trivial, &mut ())
    };
    // Untimed: how many steps lead to the cost.
    let history = adjust(200)?.history;
    let reached = history.iter().find(|step| step.cost <= cost);
    let max_iterations = reached.map_or(200, |step| step.index);
    let work = || adjust(max_iterations);
    time("ba", rounds, work, |report| match report {
        Ok(report) => format!("{:.3}", report.final_cost),
        Err(error) => format!("{error:?}"),
    });
    Ok(())
}
