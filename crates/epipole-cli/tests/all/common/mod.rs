//! Shared by the tests of the command line: folders, rendered photographs, runs of the binary.

pub(crate) mod exif;
pub(crate) mod lens;

use epipole::camera::{PosedCamera, RigidTransform};
use epipole_io::model::{Model, ModelFormat};
use epipole_scenes::{Photograph, Sampling, Scene, still_life_camera};
use nalgebra::{Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Number of folders that this process has made.
static NUM_FOLDERS: AtomicUsize = AtomicUsize::new(0);

/// A folder for one test's files, removed with it.
pub(crate) struct Folder(pub(crate) PathBuf);

/// Writes the files of a model into a folder of its own.
pub(crate) fn write_model(model: &Model, format: ModelFormat, folder: &Path) {
    std::fs::create_dir_all(folder).unwrap();
    for file in model.to_files(format).unwrap() {
        std::fs::write(folder.join(&file.name), &file.bytes).unwrap();
    }
}

impl Folder {
    pub(crate) fn new(name: &str) -> Self {
        let (process, n) = (
            std::process::id(),
            NUM_FOLDERS.fetch_add(1, Ordering::Relaxed),
        );
        let path = std::env::temp_dir().join(format!("epipole-{name}-{process}-{n}"));
        std::fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    pub(crate) fn file(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    pub(crate) fn write(&self, name: &str, text: &str) -> PathBuf {
        let path = self.file(name);
        std::fs::write(&path, text).unwrap();
        path
    }

    /// A photograph of the still life as a PNG file, with its depth.
    pub(crate) fn write_photo(
        &self,
        name: &str,
        camera: &PosedCamera,
        size: (u32, u32),
    ) -> Photograph {
        let photo = Scene::still_life()
            .render(camera, size.0, size.1, Sampling::Full)
            .unwrap();
        photo.image.save(self.file(name)).unwrap();
        photo
    }

    /// Photographs of the still life in a folder: 0.png, 1.png …
    pub(crate) fn write_photos(&self, sub: &str, cameras: &[PosedCamera], size: (u32, u32)) {
        std::fs::create_dir_all(self.file(sub)).unwrap();
        for (n, camera) in cameras.iter().enumerate() {
            self.write_photo(&format!("{sub}/{n}.png"), camera, size);
        }
    }

    /// A picture of one gray.
    pub(crate) fn blank(&self, name: &str, size: (u32, u32)) -> PathBuf {
        let path = self.file(name);
        image::GrayImage::from_pixel(size.0, size.1, image::Luma([128]))
            .save(&path)
            .unwrap();
        path
    }

    /// All files and folders in it, however deep.
    pub(crate) fn listing(&self) -> BTreeSet<PathBuf> {
        let mut found = BTreeSet::new();
        let mut open = vec![self.0.clone()];
        while let Some(folder) = open.pop() {
            for entry in std::fs::read_dir(folder).unwrap() {
                let path = entry.unwrap().path();
                if path.is_dir() {
                    open.push(path.clone());
                }
                found.insert(path);
            }
        }
        found
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// A file as people have it, or `None` with a printed line where it is absent.
pub(crate) fn field(relative: &str) -> Option<PathBuf> {
    let data = std::env::var_os("EPIPOLE_DATA").map_or_else(
        || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data")),
        PathBuf::from,
    );
    let path = data.join("../field").join(relative);
    if path.exists() {
        return Some(path);
    }
    println!("skipped: no file at {}", path.display());
    None
}

pub(crate) fn path(path: &Path) -> &str {
    path.to_str().unwrap()
}

pub(crate) fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_epipole"));
    command
        .args(arguments)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    command
}

pub(crate) fn epipole(arguments: &[&str]) -> Output {
    command(arguments).output().unwrap()
}

/// The one object on standard output.
pub(crate) fn parse(output: &Output) -> Value {
    let text = std::str::from_utf8(&output.stdout).unwrap();
    serde_json::from_str(text).unwrap_or_else(|error| panic!("{error}: {text}"))
}

/// The result of a command that must succeed. Its help must name every field.
pub(crate) fn json(arguments: &[&str]) -> Value {
    let output = epipole(&[arguments, &["--json"]].concat());
    let result = parse(&output);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {result}");
    assert!(result["time_ms"].as_f64().unwrap() > 0.0);
    let command = arguments
        .iter()
        .find(|word| !word.starts_with('-'))
        .unwrap();
    let help = String::from_utf8(epipole(&[command, "--help"]).stdout).unwrap();
    let mut words = help.split(|c: char| !c.is_alphanumeric() && c != '_');
    for field in result.as_object().unwrap().keys() {
        let named = field == "time_ms" || words.clone().any(|word| word == field);
        assert!(named, "{command} --help does not name {field}");
    }
    assert!(
        words.any(|word| word == "JSON"),
        "{command} --help has no list"
    );
    result
}

/// Runs a command that must fail with a status and a sentence that contains `expected`, for people
/// and for scripts, and that must leave the folder as it was.
pub(crate) fn fails(folder: &Folder, arguments: &[&str], status: i32, expected: &str) {
    let before = folder.listing();
    let plain = epipole(arguments);
    let sentence = String::from_utf8(plain.stderr).unwrap();
    assert_eq!(
        plain.status.code(),
        Some(status),
        "{arguments:?}: {sentence}"
    );
    assert!(plain.stdout.is_empty(), "{arguments:?} prints no result");
    let error_line = sentence.lines().find(|line| line.starts_with("error: "));
    assert!(
        error_line.is_some() && sentence.contains(expected) && !sentence.contains("panicked"),
        "{arguments:?}: {sentence}"
    );
    let output = epipole(&[arguments, &["--json"]].concat());
    assert_eq!(output.status.code(), Some(status), "{arguments:?}");
    let result = parse(&output);
    let message = result["error"]["message"].as_str().unwrap();
    assert!(message.contains(expected), "{arguments:?}: {message}");
    assert!(!result["error"]["kind"].as_str().unwrap().is_empty());
    assert_eq!(folder.listing(), before, "{arguments:?} leaves something");
}

pub(crate) fn numbers(list: &Value) -> Vec<f64> {
    let list = list.as_array().unwrap_or_else(|| panic!("no list: {list}"));
    list.iter().map(|value| value.as_f64().unwrap()).collect()
}

pub(crate) fn matrix(list: &Value) -> Matrix3<f64> {
    Matrix3::from_row_slice(&numbers(list))
}

/// Reads `{rotation, translation}`.
pub(crate) fn motion(value: &Value) -> RigidTransform {
    let rotation = Rotation3::from_matrix_unchecked(matrix(&value["rotation"]));
    let translation = Vector3::from_row_slice(&numbers(&value["translation"]));
    RigidTransform::from_parts(
        Translation3::from(translation),
        UnitQuaternion::from_rotation_matrix(&rotation),
    )
}

/// The camera of the still life, moved in its own frame: `cam_from_camera0 = motion`.
pub(crate) fn moved(size: (u32, u32), motion: &RigidTransform) -> PosedCamera {
    let camera = still_life_camera(size.0, size.1);
    PosedCamera {
        cam_from_world: motion * camera.cam_from_world,
        ..camera
    }
}

/// `fx,fy,cx,cy`.
pub(crate) fn k(camera: &PosedCamera) -> String {
    let center = camera.camera.intrinsics.principal_point();
    let (fu, fv) = (
        camera.camera.intrinsics.fu_px(),
        camera.camera.intrinsics.fv_px(),
    );
    format!("{fu},{fv},{},{}", center.x, center.y)
}

/// The angle between two directions, degrees.
pub(crate) fn angle_deg(a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
    a.angle(b).to_degrees()
}
