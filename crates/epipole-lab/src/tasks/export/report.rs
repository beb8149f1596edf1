//! Contents of the report: facts, measures, a picture of the model, and photographs with marks.

use super::contents::Export;
use super::paper::{Paper, Photo};
use epipole::sfm::Reconstruction;
use image::RgbImage;
use nalgebra::Point3;

/// Maximum number of photographs.
const MAX_PHOTOS: usize = 4;
/// Maximum width and height of a photograph, pixels.
const MAX_SIDE_PX: u32 = 640;

/// Chooses the images that show the most measured points, each for the points that those before
/// it do not show; further ones for the most points.
pub(super) fn chosen_images(export: &Export) -> Vec<usize> {
    let marks = &export.measures.marks;
    let mut is_shown = vec![false; marks.len()];
    let mut chosen: Vec<usize> = Vec::new();
    while chosen.len() < MAX_PHOTOS {
        let score = |image: usize| {
            let sees = |n: &usize| marks[*n].images.contains(&(image as u32));
            let all = (0..marks.len()).filter(sees).count();
            let new = (0..marks.len())
                .filter(|n| !is_shown[*n] && sees(n))
                .count();
            (new, all)
        };
        let free = (0..export.images.len()).filter(|image| !chosen.contains(image));
        let scored = free.map(|image| (score(image), std::cmp::Reverse(image)));
        let Some(((_, 1..), std::cmp::Reverse(image))) = scored.max() else {
            break;
        };
        for (shown, mark) in is_shown.iter_mut().zip(marks) {
            *shown |= mark.images.contains(&(image as u32));
        }
        chosen.push(image);
    }
    chosen.sort_unstable();
    chosen
}

/// Returns a photograph reduced for paper.
pub(super) fn reduced(pixels: &RgbImage) -> RgbImage {
    let (width, height) = pixels.dimensions();
    let largest = width.max(height).max(1);
    let reduced = |side: u32| match largest > MAX_SIDE_PX {
        true => (u64::from(side) * u64::from(MAX_SIDE_PX) / u64::from(largest)).max(1) as u32,
        false => side.max(1),
    };
    image::imageops::thumbnail(pixels, reduced(width), reduced(height))
}

/// Returns a reduced photograph with the places of its marks; `None` without a camera.
///
/// * `model`: in the frame of the files
pub(super) fn photo(
    export: &Export,
    model: &Reconstruction,
    index: usize,
    image: RgbImage,
) -> Option<Photo> {
    let camera = model.cameras.get(index)?.as_ref()?;
    let calibrated = &export.images.get(index)?.camera;
    let (width, height) = (calibrated.width, calibrated.height);
    let frame = super::frame::file_from_world(export);
    let marks = export.measures.marks.iter();
    let seen = marks.filter(|mark| mark.images.contains(&(index as u32)));
    let placed = seen.filter_map(|mark| {
        let at = camera.project(&(frame * Point3::from(mark.place))).ok()?;
        let at = [
            (at.x + 0.5) / f64::from(width),
            (at.y + 0.5) / f64::from(height),
        ];
        let is_inside = at.iter().all(|x| (0.0..=1.0).contains(x));
        is_inside.then(|| (at, mark.label.clone()))
    });
    Some(Photo {
        name: export.images.get(index)?.name.clone(),
        marks: placed.collect(),
        image,
    })
}

/// Returns the report without its photographs.
///
/// * `model`: in the frame of the files
pub(super) fn paper(export: &Export, model: &Reconstruction) -> Paper {
    let place = export.component as usize;
    let mut facts = vec![format!(
        "{} of {} photographs registered, {} points",
        model.num_registered(),
        export.images.len(),
        model.points.len()
    )];
    if let Some(error_px) = export.found.mean_error_px.get(place) {
        facts.push(format!("mean reprojection error {error_px:.3} pixels"));
    }
    facts.extend(focal_words(export, model));
    facts.extend(export.measures.findings.iter().cloned());
    if export.measures.is_empty() {
        facts.push("Nothing was measured.".to_owned());
    } else {
        facts.push(
            "± is one standard deviation from the keypoints alone; the cameras are taken as exact."
                .to_owned(),
        );
    }
    let measures = &export.measures;
    let lengths = measures.lengths.iter().enumerate();
    let lengths = |is_known: bool| {
        let lengths = lengths.clone();
        let wanted = lengths.filter(move |(_, length)| length.typed_m.is_some() == is_known);
        wanted.map(|(index, length)| (format!("Length {}", index + 1), length.words.clone()))
    };
    let control = (measures.control_points.iter()).map(|control| {
        let known = control.position_m.map_or(String::new(), |place| {
            format!(" ({} m)", coordinates(place))
        });
        (control.name.clone(), format!("{}{known}", control.words))
    });
    let shapes = (measures.shapes.iter()).map(|shape| (shape.name.clone(), shape.words.clone()));
    Paper {
        title: "Measurement report".to_owned(),
        facts,
        tables: vec![
            ("Known lengths".to_owned(), lengths(true).collect()),
            ("Control points".to_owned(), control.collect()),
            (
                "Measures".to_owned(),
                lengths(false).chain(shapes).collect(),
            ),
        ],
        picture: super::view::picture(export, model),
        photos: Vec::new(),
    }
}

/// Writes coordinates to a tenth of a millimeter, without a sign before zero.
fn coordinates(place_m: [f64; 3]) -> String {
    place_m
        .map(|x| format!("{:.4}", (x * 1e4).round() / 1e4 + 0.0))
        .join(", ")
}

/// Describes the focal lengths of all registered images.
fn focal_words(export: &Export, model: &Reconstruction) -> Option<String> {
    let cameras = model.cameras.iter().flatten();
    let focals = || {
        cameras
            .clone()
            .map(|camera| camera.camera.intrinsics.fu_px())
    };
    let (low, high) = (
        focals().fold(f64::INFINITY, f64::min),
        focals().fold(0.0, f64::max),
    );
    let refined = match export.focal_refined {
        true => ", refined",
        false => "",
    };
    match high - low < 0.05 {
        _ if !low.is_finite() => None,
        true => Some(format!("focal length {low:.1} pixels{refined}")),
        false => Some(format!(
            "focal lengths {low:.1} to {high:.1} pixels{refined}"
        )),
    }
}
