//! "The same as this command", and as this program: both are run, and give the same bits as the
//! Lab.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

mod common;
#[allow(unreachable_pub, reason = "it is the main file of a program elsewhere")]
#[path = "program/reconstruct.rs"]
#[rustfmt::skip]
mod program;

use common::{finish, jpeg, output, solved};
use epipole::camera::{PosedCamera, look_at};
use epipole_lab::project::{
    Blob, FeatureKind, FeatureOptions, LensCamera, LensModel, Outcome, Project, RefineFocal,
    Sample, Saved, SavedPhoto, VERSION,
};
use epipole_lab::session::Event;
use epipole_lab::tasks::{ExportFormat, MatchesOf, Shows, TwoViewsOf};
use epipole_scenes::{Sampling, Scene, still_life_camera};
use image::RgbImage;
use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};
use serde_json::Value;
use std::io::Cursor;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A folder of one test, removed with it.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("epipole-lab-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap();
        Self(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// The folder of the command line, which is built where it is missing or old.
fn programs() -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let cargo = std::env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned());
    let built = Command::new(cargo)
        .current_dir(root)
        .args(["build", "--locked", "--quiet", "--bin", "epipole"])
        .status()
        .unwrap();
    assert!(built.success());
    // Tests are in target/<profile>/deps.
    let deps = std::env::current_exe().unwrap();
    deps.parent().unwrap().parent().unwrap().to_owned()
}

/// Unpacks what the Lab exports, as a reader would.
fn unpacked(project: &Project, folder: &Path) {
    let mut export = project.export_request(ExportFormat::default()).unwrap();
    let bytes = output(export.clone()).unwrap();
    // Pixels that were let go of are read once more, and are the same.
    for photograph in &mut export.photographs {
        photograph.used.as_mut().unwrap().rgb = Blob::default();
    }
    assert_eq!(output(export), Ok(bytes.clone()));
    let mut archive = zip::ZipArchive::new(Cursor::new(&bytes[..])).unwrap();
    archive.extract(folder).unwrap();
}

fn text(folder: &Path, name: &str) -> String {
    std::fs::read_to_string(folder.join(name)).unwrap()
}

const MODEL: [&str; 3] = [
    "sparse/0/cameras.txt",
    "sparse/0/images.txt",
    "sparse/0/points3D.txt",
];

/// Runs the command that the Lab shows, in the folder that it means, and compares every byte.
fn the_command_gives_the_same(project: &Project, folder: &Path) {
    let expected = MODEL.map(|name| text(folder, name));
    let ply = std::fs::read(folder.join("points.ply")).unwrap();
    let lab: Value = serde_json::from_str(&text(folder, "reconstruction.json")).unwrap();
    std::fs::remove_dir_all(folder.join("sparse")).unwrap();
    let command = project.recipe().unwrap().command;
    assert!(text(folder, "README.txt").contains(&format!("\n    {command}\n")));
    let paths = [
        programs().to_str().unwrap(),
        &std::env::var("PATH").unwrap(),
    ]
    .join(":");
    let output = Command::new("sh")
        .current_dir(folder)
        .env("PATH", paths)
        .args(["-c", &format!("{command} --json --quiet")])
        .output()
        .unwrap();
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command}\n{told}");
    for (name, expected) in MODEL.iter().zip(&expected) {
        assert_eq!(
            text(folder, name).len(),
            expected.len(),
            "{name} of {command}"
        );
        assert!(text(folder, name) == *expected, "{name} of {command}");
    }
    assert!(std::fs::read(folder.join("sparse/0/points.ply")).unwrap() == ply);
    // And it prints what the Lab writes.
    let printed: Value = serde_json::from_slice(&output.stdout).unwrap();
    for (field, value) in printed.as_object().unwrap() {
        match field.as_str() {
            "time_ms" => {}
            "unregistered" => {
                let names = |list: &Value| -> Vec<String> {
                    let list = list.as_array().unwrap().iter();
                    list.map(|one| one["name"].as_str().unwrap().to_owned())
                        .collect()
                };
                assert_eq!(names(value), names(&lab[field]));
            }
            _ => assert_eq!(*value, lab[field], "{field}"),
        }
    }
}

#[test]
fn the_sample_with_other_knobs() {
    let mut project = Project::default();
    project.update(Event::OpenSample(Sample::Table));
    let mut settings = project.document().settings.clone();
    settings.features.max_features = 1500;
    settings.features.contrast = 0.013;
    settings.matching.ratio = 0.77;
    settings.sfm.min_num_inliers = 22;
    settings.sfm.seed = 3;
    settings.refine_focal = RefineFocal::Always;
    settings.sfm.refine_distortion = true;
    project.update(Event::Set(settings));
    // Another order, and without one.
    let photos = &project.document().photos;
    let (third, fifth) = (photos[2].id, photos[4].id);
    project.update(Event::Earlier(third));
    project.update(Event::Exclude(fifth, true));
    finish(&mut project);
    assert_eq!(project.component().unwrap().num_registered(), 8);
    let folder = Folder::new("knobs");
    unpacked(&project, &folder.0);
    the_command_gives_the_same(&project, &folder.0);
}

/// The table from a place on an arc, by a camera that is held upright or not.
fn photograph(degrees: f64, is_upright: bool, size: (u32, u32)) -> RgbImage {
    let middle = Point3::new(0.035, -0.13, 0.05);
    let angle = degrees.to_radians();
    let center = Point3::new(
        middle.x + 1.38 * libm::sin(angle),
        -0.45,
        middle.z - 1.38 * libm::cos(angle),
    );
    let roll = UnitQuaternion::from_axis_angle(
        &Vector3::z_axis(),
        if is_upright {
            std::f64::consts::FRAC_PI_2
        } else {
            0.0
        },
    );
    let camera = PosedCamera {
        cam_from_world: Isometry3::from_parts(Translation3::identity(), roll)
            * look_at(&center, &middle, &Vector3::new(0.0, -1.0, 0.0)).unwrap(),
        ..still_life_camera(size.0, size.1)
    };
    let picture = Scene::still_life().render(&camera, size.0, size.1, Sampling::Full);
    picture.unwrap().image
}

/// Files that are reduced, by a camera that was calibrated, one of them upright, one of another
/// size, one with a focal length that somebody typed.
fn of_files() -> (Project, Vec<(String, Blob)>) {
    let lying = (640, 480);
    let files = vec![
        (
            "b one.jpg".to_owned(),
            jpeg(&photograph(-12.0, false, lying), 1),
        ),
        ("a.jpg".to_owned(), jpeg(&photograph(-4.0, false, lying), 1)),
        // The sensor gives it lying on its side.
        (
            "upright.jpg".to_owned(),
            jpeg(&photograph(4.0, true, lying), 6),
        ),
        (
            "other.jpg".to_owned(),
            jpeg(&photograph(12.0, false, (600, 450)), 1),
        ),
        (
            "typed.jpg".to_owned(),
            jpeg(&photograph(18.0, false, (600, 450)), 1),
        ),
    ];
    let photo = |(name, _): &(String, Blob)| SavedPhoto {
        name: name.clone(),
        rendered: None,
        excluded: false,
        focal_px: (name == "typed.jpg").then_some(750.0),
    };
    let mut saved = Saved {
        version: VERSION,
        photos: files.iter().map(photo).collect(),
        camera: Some(LensCamera {
            size: lying,
            k: [800.0, 801.0, 321.0, 238.5],
            lens: LensModel::Brown,
            coefficients: vec![-0.01, 0.003, 0.0005, -0.0004, 0.0],
        }),
        ..Saved::default()
    };
    saved.settings.max_megapixels = 0.2;
    saved.settings.refine_focal = RefineFocal::Never;
    saved.settings.features.kind = FeatureKind::Sift;
    let mut project = Project::default();
    project.update(Event::OpenProject(Box::new(saved), files.clone()));
    finish(&mut project);
    (project, files)
}

#[test]
fn files_that_are_reduced_and_freed_of_their_lens() {
    let (project, files) = of_files();
    for photo in &project.document().photos {
        let words = project.outcome_words(photo);
        assert!(
            matches!(project.outcome(photo), Outcome::Registered(_)),
            "{}: {words}",
            photo.name
        );
    }
    let used = project.photograph(&project.document().photos[2]).unwrap();
    assert!(used.k.is_some() && used.height > used.width);
    assert_eq!(
        project.recipe().unwrap().command,
        "epipole sfm 'photographs/b one.jpg' photographs/a.jpg photographs/upright.jpg photographs/other.jpg \
         photographs/typed.jpg --max-megapixels 0.2 --camera camera.json --undistort --focals-px=-,-,-,-,750 --max-features 8192 \
         --features sift --keep-focal --seed 0 -o sparse/0"
    );
    let folder = Folder::new("files");
    unpacked(&project, &folder.0);
    std::fs::create_dir_all(folder.0.join("photographs")).unwrap();
    for (name, bytes) in &files {
        std::fs::write(folder.0.join("photographs").join(name), &bytes[..]).unwrap();
    }
    let expected = MODEL.map(|name| text(&folder.0, name));
    the_command_gives_the_same(&project, &folder.0);

    // The program in the archive is the one that was compiled with this test.
    let written = text(&folder.0, "reconstruct.rs");
    let kept = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/program/reconstruct.rs");
    if std::env::var_os("EPIPOLE_BLESS").is_some() {
        std::fs::write(&kept, &written).unwrap();
    }
    assert!(
        std::fs::read_to_string(&kept).unwrap() == written,
        "bless {}",
        kept.display()
    );
    std::fs::remove_dir_all(folder.0.join("sparse")).unwrap();
    // No other test of this file looks at where it runs.
    std::env::set_current_dir(&folder.0).unwrap();
    program::main().unwrap();
    for (name, expected) in MODEL.iter().zip(&expected) {
        assert!(text(&folder.0, name) == *expected, "{name} of the program");
    }
    std::env::set_current_dir(std::env::temp_dir()).unwrap();
}

/// A pair of the sample as `epipole two-view` judges it.
#[test]
fn a_pair_is_what_the_command_line_says_of_it() {
    let project = solved(Sample::Table);
    let folder = Folder::new("pair");
    unpacked(&project, &folder.0);
    let [first, second, ..] = &project.document().photos[..] else {
        panic!("nine photographs");
    };
    let paths = [first, second].map(|photo| folder.0.join("images").join(&photo.name));
    let features = FeatureOptions::default();
    let output = Command::new(programs().join("epipole"))
        .args([
            "two-view",
            "--json",
            "--quiet",
            "--focal-px",
            "600",
            "--max-features",
        ])
        .arg(features.max_features.to_string())
        .args(&paths)
        .output()
        .unwrap();
    let printed: Value = serde_json::from_slice(&output.stdout).unwrap();
    let pair = project.get(TwoViewsOf(first.id, second.id)).unwrap();
    assert_eq!(pair.shows, Shows::Depth);
    assert_eq!(printed["configuration"], "general");
    assert_eq!(printed["num_inliers"], pair.num_inliers);
    assert_eq!(printed["num_matches"], pair.inliers.len());
    let epipole_lab::tasks::ViewModel::Essential(e) = pair.model else {
        panic!("{:?}", pair.model);
    };
    let model: Vec<f64> = (printed["model"].as_array().unwrap().iter())
        .map(|x| x.as_f64().unwrap())
        .collect();
    assert_eq!(model, e);
    // Match for match, whatever their order.
    let places = MatchesOf(first.id, second.id).places(&project).unwrap();
    let mut ours: Vec<String> = (places.iter().zip(&pair.inliers))
        .map(|([u1, v1, u2, v2], is)| format!("{u1} {v1} {u2} {v2} {}", u8::from(*is)))
        .collect();
    let mut theirs: Vec<String> = (printed["matches"].as_array().unwrap().iter())
        .map(|row| {
            let number = |n: usize| row[n].as_f64().unwrap();
            format!(
                "{} {} {} {} {}",
                number(0),
                number(1),
                number(2),
                number(3),
                number(4)
            )
        })
        .collect();
    ours.sort();
    theirs.sort();
    assert_eq!(ours, theirs);
}
