//! Structure from motion on real photographs with known cameras.

use epipole::camera::{Camera, Intrinsics};
use epipole::sfm::{
    AlignmentKind, Photo, PhotoOptions, SfmOptions, absolute_trajectory_error, reconstruct_photos,
};
use epipole_io::photo::{DecodeOptions, decode_rgb};
use nalgebra::Point3;
use std::ops::ControlFlow;
use std::path::PathBuf;

struct DataSet {
    photos: Vec<Photo>,
    camera: Camera,
    centers: Vec<Point3<f64>>,
}

/// The numbers after `"key":` up to the bracket that closes its list.
fn numbers_after(text: &str, key: &str) -> Vec<f64> {
    let quoted = format!("\"{key}\"");
    let start = text.find(&quoted).expect("the key") + quoted.len();
    let mut depth = 0;
    let mut end = start;
    for (index, c) in text[start..].char_indices() {
        depth += i32::from(c == '[') - i32::from(c == ']');
        if c == ']' && depth == 0 {
            end = start + index;
            break;
        }
    }
    text[start..end]
        .split(|c: char| !(c.is_ascii_digit() || "+-.eE".contains(c)))
        .filter_map(|word| word.parse().ok())
        .collect()
}

fn load(name: &str) -> Option<DataSet> {
    let root = std::env::var_os("EPIPOLE_DATA").map_or_else(
        || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data")),
        PathBuf::from,
    );
    let folder = root.join("multiview").join(name);
    let Ok(text) = std::fs::read_to_string(folder.join("cameras.json")) else {
        println!("skipped: no data at {}", folder.display());
        return None;
    };
    let mut set = DataSet {
        photos: Vec::new(),
        camera: Camera::pinhole(
            Intrinsics::new(1.0, 1.0, 0.0, 0.0).expect("intrinsics"),
            1,
            1,
        ),
        centers: Vec::new(),
    };
    for view in text.split("\"file\"").skip(1) {
        let file = view.split('"').nth(1).expect("a file name");
        let bytes = std::fs::read(folder.join(file)).expect("a photograph");
        let image = decode_rgb(&bytes, &DecodeOptions::default())
            .expect("an image")
            .image;
        let (width, height) = image.dimensions();
        set.photos.push(Photo {
            name: file.to_owned(),
            image,
            ..Photo::default()
        });
        let k = numbers_after(view, "K");
        let k = Intrinsics::new(k[0], k[4], k[2], k[5]).expect("intrinsics");
        set.camera = Camera::pinhole(k, width, height);
        let (r, t) = (numbers_after(view, "R"), numbers_after(view, "t"));
        let r = nalgebra::Matrix3::from_row_slice(&r);
        let t = nalgebra::Vector3::from_row_slice(&t);
        set.centers.push(Point3::from(-(r.transpose() * t)));
    }
    Some(set)
}

/// The number of registered photographs and the root mean square error of their centers.
fn run(set: &DataSet, options: &SfmOptions) -> (usize, f64) {
    let begin = std::time::Instant::now();
    let (input, result) = reconstruct_photos(
        &set.photos,
        &[set.camera],
        &PhotoOptions::default(),
        options,
        &mut |progress| {
            println!("{:?} {progress:?}", begin.elapsed());
            ControlFlow::Continue(())
        },
    )
    .expect("a result");
    let Some(first) = result.components.first() else {
        return (0, f64::INFINITY);
    };
    let (mut found, mut truth) = (Vec::new(), Vec::new());
    for (camera, center) in first.cameras.iter().zip(&set.centers) {
        if let Some(camera) = camera {
            found.push(camera.center_in_world());
            truth.push(*center);
        }
    }
    let (error, _) = absolute_trajectory_error(&found, &truth, AlignmentKind::Similarity)
        .expect("three cameras at least");
    println!(
        "{} of {} registered, {} points, {} observations, mean {:.3} px, centers {error:?}",
        first.num_registered(),
        set.photos.len(),
        first.points.len(),
        first.num_observations(),
        first.mean_reprojection_px(&input.images)
    );
    (first.num_registered(), error.rmse)
}

/// COLMAP registers all eleven with an error of 3.09 mm.
#[test]
fn fountain_is_registered_as_well_as_colmap_does() {
    let Some(set) = load("fountain_p11") else {
        return;
    };
    let (registered, rmse_m) = run(&set, &SfmOptions::default());
    assert_eq!(registered, 11);
    assert!(rmse_m <= 1.5 * 0.00309, "{rmse_m}");
}

/// Sixteen views through a long lens, nearly affine; COLMAP registers six, with 1.57 mm.
#[test]
fn dino_is_registered_as_far_as_colmap_does() {
    let Some(set) = load("dinoSparseRing") else {
        return;
    };
    let (registered, rmse_m) = run(&set, &SfmOptions::default());
    assert!(registered >= 6, "{registered}");
    assert!(rmse_m <= 1.5 * 0.00157, "{rmse_m}");
}
