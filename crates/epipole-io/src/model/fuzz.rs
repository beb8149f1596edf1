//! Round trips of every format, and damaged files: no panic, and every number is finite.

use super::example::{difference, example, in_rigs, lenses};
use super::{Model, ModelFile, ModelFormat, read_model_file, read_model_folder};
use crate::damage::{config, damage_bytes, some_damage};
use epipole::camera::Lens;
use proptest::prelude::*;

const FORMATS: [ModelFormat; 6] = [
    ModelFormat::ColmapText,
    ModelFormat::ColmapBinary,
    ModelFormat::Transforms,
    ModelFormat::Bundler,
    ModelFormat::OpenMvg,
    ModelFormat::Ply,
];

fn find<'a>(files: &'a [ModelFile]) -> impl Fn(&str) -> Option<Vec<u8>> + 'a {
    |name| {
        let file = files.iter().find(|file| file.name == name)?;
        Some(file.bytes.clone())
    }
}

fn back(model: &Model, format: ModelFormat) -> Model {
    let files = model.to_files(format).unwrap();
    let read = read_model_folder(&find(&files)).unwrap().unwrap();
    assert_eq!(read.format, format);
    read.model
}

/// Removes the parts that the format does not keep.
fn representable(format: ModelFormat, mut model: Model) -> Model {
    match format {
        ModelFormat::Transforms => {
            for image in &mut model.images {
                image.keypoints.clear();
            }
            for point in &mut model.points {
                point.track.clear();
                point.error_px = None;
                point.position = point.position.map(|value| f64::from(value as f32));
            }
        }
        ModelFormat::OpenMvg => {
            for point in &mut model.points {
                point.color = [128; 3];
                point.error_px = None;
            }
        }
        _ => {}
    }
    model
}

#[test]
fn a_model_survives_each_format() {
    let all = lenses();
    for (format, lenses, is_square) in [
        (ModelFormat::ColmapText, &all[..], false),
        (ModelFormat::ColmapBinary, &all[..], false),
        (ModelFormat::Transforms, &all[..3], false),
        (ModelFormat::Transforms, &all[1..2], false),
        (ModelFormat::OpenMvg, &all[..3], true),
    ] {
        for lens in 0..lenses.len() {
            let mut rotated = lenses.to_vec();
            rotated.rotate_left(lens);
            let model = example(&rotated, is_square);
            let expected = representable(format, model.clone());
            let read = back(&model, format);
            if matches!(format, ModelFormat::ColmapText | ModelFormat::ColmapBinary) {
                assert_eq!(read.camera_ids, model.camera_ids);
                let ids =
                    |model: &Model| -> Vec<u64> { model.points.iter().map(|p| p.id).collect() };
                assert_eq!(ids(&read), ids(&model));
            }
            let error = difference(&read, &expected);
            assert!(error < 1e-12, "{format:?}: {error}");
        }
    }
}

#[test]
fn rigs_survive_colmap() {
    let model = in_rigs(example(&lenses()[..3], false));
    for format in [ModelFormat::ColmapText, ModelFormat::ColmapBinary] {
        let read = back(&model, format);
        assert_eq!(read.rigs, model.rigs);
        assert!(difference(&read, &model) < 1e-12);
        // A camera and an image without a rig get a rig.
        let mut without = model.clone();
        without.rigs.pop();
        without.rigs[0].frames.pop();
        let read = back(&without, format);
        let [rig, single] = &read.rigs[..] else {
            panic!("two rigs");
        };
        assert_eq!(
            (rig.frames.len(), single.id, single.frames.len()),
            (2, 6, 1)
        );
        assert!(difference(&read, &model) < 1e-12);
    }
}

/// The reference of a rig is a sensor that is no camera, or a camera that is not supported.
#[test]
fn the_first_camera_that_is_there_becomes_the_reference() {
    let model = in_rigs(example(&lenses()[..3], false));
    let mut files = model.to_files(ModelFormat::ColmapText).unwrap();
    let text =
        |files: &[ModelFile], place: usize| String::from_utf8(files[place].bytes.clone()).unwrap();
    let rigs = text(&files, 3);
    files[3].bytes = rigs.replace("5 2 CAMERA 9", "5 2 IMU 9").into_bytes();
    let read = read_model_folder(&find(&files)).unwrap().unwrap();
    // Camera 9 took images 0 and 3.
    assert_eq!(read.model.images.len(), 2);
    let off = read.model.images[0].cam_from_world.to_matrix()
        - model.images[1].cam_from_world.to_matrix();
    assert!(off.amax() < 1e-14, "{off}");
    assert_eq!(read.notes.len(), 2, "{:?}", read.notes);
    files[3].bytes = rigs.into_bytes();
    let cameras = text(&files, 0).replace("9 PINHOLE 640 480 500", "9 FOV 640 480 0.9 500");
    files[0].bytes = cameras.into_bytes();
    let read = read_model_folder(&find(&files)).unwrap().unwrap();
    assert_eq!(read.model.images.len(), 2);
    let off = read.model.images[0].cam_from_world.to_matrix()
        - model.images[1].cam_from_world.to_matrix();
    assert!(off.amax() < 1e-14, "{off}");
    let note = &read.notes[0];
    assert!(
        note.starts_with("camera 9: camera model FOV is not supported"),
        "{note}"
    );
    assert!(
        note.ends_with("left out with its 2 images: \"a b.jpg\", \"plain\""),
        "{note}"
    );
    assert_eq!(read.model.num_observations(), 16);
}

/// Bundler has no principal point, but projections are equal in units of the focal length.
#[test]
fn projections_survive_bundler() {
    let radial = epipole::camera::Distortion {
        k1: -0.1,
        k2: 0.02,
        ..epipole::camera::Distortion::NONE
    };
    let model = example(&[radial.into(), Lens::NONE], false);
    let read = back(&model, ModelFormat::Bundler);
    assert_eq!(read.images[1].name, model.images[1].name);
    assert_eq!(read.points.len(), model.points.len());
    assert!(read.mean_reprojection_px().unwrap().unwrap() < 1e-11);
    for (a, b) in read.images.iter().zip(&model.images) {
        let error = a.cam_from_world.to_matrix() - b.cam_from_world.to_matrix();
        assert!(error.amax() < 1e-14);
        assert_eq!(read.cameras[a.camera].lens, model.cameras[b.camera].lens);
    }
    // Written again it is the same.
    let again = back(&read, ModelFormat::Bundler);
    assert!(difference(&again, &read) < 1e-11);
}

#[test]
fn cameras_that_a_format_lacks_are_named() {
    let of = |lens: Lens, is_square, format| {
        let model = example(&[lens], is_square);
        model.to_files(format).unwrap_err().to_string()
    };
    let [_, brown, fisheye, rational, division] = lenses();
    assert!(of(rational, true, ModelFormat::Transforms).contains("rational"));
    assert!(of(division, true, ModelFormat::OpenMvg).contains("division"));
    assert!(of(brown, false, ModelFormat::OpenMvg).contains("501.25"));
    assert!(of(fisheye, true, ModelFormat::Bundler).contains("fisheye"));
    assert!(of(brown, true, ModelFormat::Bundler).contains("k1 and k2 alone"));
}

#[test]
fn wrong_indices_are_refused_by_every_writer() {
    let good = example(&lenses()[..1], true);
    let mut no_camera = good.clone();
    no_camera.images[0].camera = 1;
    let mut no_keypoint = good.clone();
    no_keypoint.points[0].track[0].1 = 8;
    let mut twice = good;
    twice.images[0].id = twice.images[1].id;
    for model in [no_camera, no_keypoint, twice] {
        for format in [ModelFormat::Glb].into_iter().chain(FORMATS) {
            // A PLY file has points alone.
            assert_eq!(model.to_files(format).is_ok(), format == ModelFormat::Ply);
        }
        assert!(model.oddities().is_err() && model.mean_reprojection_px().is_err());
    }
}

fn check(model: &Model) -> Result<(), TestCaseError> {
    prop_assert!(model.check().is_ok());
    for image in &model.images {
        prop_assert!(
            image
                .cam_from_world
                .to_matrix()
                .iter()
                .all(|x| x.is_finite())
        );
        let mut keypoints = image.keypoints.iter();
        prop_assert!(keypoints.all(|p| p.x.is_finite() && p.y.is_finite()));
    }
    for point in &model.points {
        prop_assert!(point.position.iter().all(|x| x.is_finite()));
    }
    model.oddities().unwrap();
    model.to_reconstruction().unwrap();
    // A model that was read can be written.
    for format in [ModelFormat::ColmapBinary, ModelFormat::Glb] {
        prop_assert!(model.to_files(format).is_ok());
    }
    Ok(())
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn damaged_files(
        format in 0..FORMATS.len(), file in any::<prop::sample::Index>(), changes in some_damage(),
    ) {
        let format = FORMATS[format];
        let [none, brown, fisheye, ..] = lenses();
        let (lenses, is_square) = match format {
            ModelFormat::Bundler => (vec![none], false),
            ModelFormat::OpenMvg => (vec![none, brown], true),
            _ => (vec![none, brown, fisheye], false),
        };
        let model = example(&lenses, is_square);
        let model = match format {
            ModelFormat::ColmapText | ModelFormat::ColmapBinary => in_rigs(model),
            _ => model,
        };
        let mut files = model.to_files(format).unwrap();
        let which = file.index(files.len());
        files[which].bytes = damage_bytes(&files[which].bytes, &changes);
        match read_model_folder(&find(&files)) {
            Ok(Some(read)) => check(&read.model)?,
            Ok(None) => prop_assert!(false, "the files are there"),
            Err(error) => prop_assert!(!error.to_string().is_empty()),
        }
    }

    #[test]
    fn random_bytes(
        bytes in prop::collection::vec(any::<u8>(), 0..300), start in 0..5_usize,
    ) {
        let starts: [&[u8]; 5] = [
            b"", b"ply\nformat binary_big_endian 1.0\n", b"# Bundle file v0.3\n",
            b"{\"frames\": [", b"{\"sfm_data_version\": ",
        ];
        let bytes = [starts[start], &bytes].concat();
        if let Ok(read) = read_model_file("a.out", &bytes, &|_: &str| Some(bytes.clone())) {
            check(&read.model)?;
        }
        for ending in ["bin", "txt"] {
            let file = |name: &str| name.ends_with(ending).then(|| bytes.clone());
            if let Ok(Some(read)) = read_model_folder(&file) {
                check(&read.model)?;
            }
        }
    }
}
