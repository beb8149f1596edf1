//! Shared by the tests: a project computed to its end, as by a thread or a worker.

#![allow(dead_code, reason = "each test uses some of it")]

pub(crate) mod depth;
#[cfg(feature = "panels")]
pub(crate) mod desk;
pub(crate) mod formats;
pub(crate) mod growing;
pub(crate) mod measured;
#[cfg(feature = "panels")]
pub(crate) mod raster;
pub(crate) mod truth;

use epipole_lab::project::{Blob, Project, Sample, Step};
use epipole_lab::session::Event;
use epipole_lab::tasks::{CameraFound, ExportFormat, OpenProject, Request, Task, compute};
use image::{ExtendedColorType, ImageEncoder, RgbImage};
use std::collections::HashMap;
use std::io::{Cursor, Read};
use std::ops::ControlFlow;
use std::sync::{Arc, LazyLock, Mutex, OnceLock};

type TaskResult = Result<Vec<u8>, String>;

/// Results by the bytes of their request.
type Results = HashMap<Vec<u8>, Arc<OnceLock<TaskResult>>>;

static RESULTS: LazyLock<Mutex<Results>> = LazyLock::new(Mutex::default);

/// Computes a request to its end, once for all tests: most of them begin with the same sample, and
/// a result depends on its request alone.
pub(crate) fn computed(request: &[u8]) -> TaskResult {
    let known = Arc::clone(RESULTS.lock().unwrap().entry(request.to_vec()).or_default());
    let result = known.get_or_init(|| compute(request, &mut |_| ControlFlow::Continue(())));
    result.clone()
}

/// Computes until nothing is wanted. Returns how many tasks that took.
pub(crate) fn finish(project: &mut Project) -> usize {
    let mut count = 0;
    while let Some(pending) = project.pending().first().copied() {
        let request = pending.request(project).expect("its inputs are there");
        let result = computed(&request.to_bytes());
        project.done(&pending, result);
        count += 1;
    }
    count
}

/// A sample, computed to its end.
pub(crate) fn solved(sample: Sample) -> Project {
    let mut project = Project::default();
    project.update(Event::OpenSample(sample));
    finish(&mut project);
    project
}

/// The output of a task.
pub(crate) fn output<T: Task + Into<Request>>(task: T) -> Result<T::Output, String> {
    let bytes = computed(&task.into().to_bytes())?;
    T::read(&bytes)
}

/// Reads the files of a project's export by their names; `None` if a file is not there.
pub(crate) fn files_for(
    project: &Project,
    format: ExportFormat,
) -> impl FnMut(&str) -> Option<Vec<u8>> + use<> {
    let export = project.export_request(format).expect("there is something");
    let bytes = output(export).unwrap();
    let mut archive = zip::ZipArchive::new(Cursor::new(bytes.to_vec())).expect("it can be read");
    move |name| {
        let mut content = Vec::new();
        let mut file = archive.by_name(name).ok()?;
        file.read_to_end(&mut content).expect("it is whole");
        Some(content)
    }
}

/// The same for files that are there, cameras and points as COLMAP's text.
pub(crate) fn exported(project: &Project) -> impl FnMut(&str) -> Vec<u8> + use<> {
    let mut file = files_for(project, ExportFormat::ColmapText);
    move |name| file(name).expect("the file is there")
}

/// Distances between neighboring cameras, in units of the reconstruction.
pub(crate) fn steps_between(cameras: &[Option<CameraFound>]) -> Vec<f64> {
    let centers: Vec<_> = (cameras.iter().flatten().map(CameraFound::center)).collect();
    assert_eq!(centers.len(), cameras.len());
    let steps = centers.windows(2).map(|two| (two[1] - two[0]).norm());
    steps.collect()
}

/// The project after saving and opening.
pub(crate) fn reopened(project: &Project) -> Project {
    let archive = output(project.save_request()).unwrap();
    let opened = output(OpenProject { archive }).unwrap();
    let mut again = Project::default();
    again.update(Event::OpenProject(Box::new(opened.project), opened.files));
    again.import(opened.computed);
    again
}

/// A JPEG file with an EXIF orientation.
pub(crate) fn jpeg(image: &RgbImage, orientation: u16) -> Blob {
    let mut exif = b"II\x2a\0\x08\0\0\0\x01\0".to_vec();
    for part in [0x0112_u16, 3, 1, 0, orientation, 0, 0, 0] {
        exif.extend(part.to_le_bytes());
    }
    let mut bytes = Vec::new();
    let mut encoder = image::codecs::jpeg::JpegEncoder::new_with_quality(&mut bytes, 92);
    encoder.set_exif_metadata(exif).unwrap();
    let (width, height) = image.dimensions();
    encoder
        .write_image(image.as_raw(), width, height, ExtendedColorType::Rgb8)
        .unwrap();
    bytes.into()
}

/// A PNG file of a picture with colors.
pub(crate) fn png(width: u32, height: u32) -> Blob {
    let image = RgbImage::from_fn(width, height, |u, v| {
        image::Rgb([(u * 7 % 256) as u8, (v * 9 % 256) as u8, 90])
    });
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
    bytes.into_inner().into()
}

/// The sentence of every photograph, and that of the step "Reconstruction".
pub(crate) fn sentences(project: &mut Project) -> (Vec<String>, String) {
    project.update(Event::Show(Step::Reconstruction));
    let photos = &project.document().photos;
    let words = photos
        .iter()
        .map(|photo| project.outcome_words(photo))
        .collect();
    (words, project.describe())
}
