//! Files other than models, cameras and trajectories: photos, disparities, problems, tables.

use crate::failure::Failure;
use crate::report::Report;
use epipole::sfm::PoseGraph;
use epipole_io::Result;
use epipole_io::bundle::{is_bal, read_bal};
use epipole_io::disparity::read_pfm;
use epipole_io::matches::{read_matches, read_points, read_points_with_pixels};
use epipole_io::photo::{DecodeOptions, decode_gray, sensor_size};
use epipole_io::pose_graph::{is_g2o, read_g2o};
use serde_json::{Value, json};
use std::path::Path;

/// Kind, counts and notes of a file.
struct Found {
    kind: &'static str,
    convention: &'static str,
    counts: Value,
    notes: Vec<String>,
}

/// Pixel convention of a table.
const PIXELS: &str = "pixel centers at integers, (u, v) is (column, row)";

impl Found {
    fn report(self) -> Report {
        let mut report = Report::default()
            .field("kind", self.kind)
            .field("convention", self.convention)
            .field("counts", &self.counts)
            .field("notes", &self.notes)
            .row("kind", self.kind)
            .row("convention", self.convention);
        for (name, count) in self.counts.as_object().into_iter().flatten() {
            report = report.row(name, count);
        }
        for note in self.notes {
            report = report.row("note", note);
        }
        report
    }
}

/// Describes a photo, a PFM file, a pose graph or a BAL problem; `None` for another file.
///
/// # Errors
/// A failure that names the path, if the file is malformed.
pub(super) fn by_first_bytes(path: &Path, bytes: &[u8]) -> Option<Described> {
    let text = std::str::from_utf8(bytes).unwrap_or_default();
    let found = if bytes.starts_with(b"Pf\n") || bytes.starts_with(b"PF\n") {
        of_pfm(bytes)
    } else if sensor_size(bytes).is_ok() {
        of_photo(bytes)
    } else if is_g2o(text) {
        of_graph(text)
    } else if is_bal(text) {
        of_bal(text)
    } else {
        return None;
    };
    let about = |error| Failure::from(error).about(path);
    Some(found.map(Found::report).map_err(about))
}

/// A report or a failure.
type Described = std::result::Result<Report, Failure>;

/// Describes a table of points or matches; `None` for another file.
pub(super) fn table(bytes: &[u8]) -> Option<Report> {
    let found = |kind, rows: usize| Found {
        kind,
        convention: PIXELS,
        counts: json!({ "rows": rows }),
        notes: Vec::new(),
    };
    let found = if let Ok((pixels, _)) = read_points_with_pixels(bytes) {
        found(
            "points of the world with their pixels (x y z u v)",
            pixels.len(),
        )
    } else if let Ok([pixels, _]) = read_matches(bytes) {
        found("matches of two images (u1 v1 u2 v2)", pixels.len())
    } else {
        found("points of an image (u v)", read_points(bytes).ok()?.len())
    };
    (found.counts["rows"] != 0).then(|| found.report())
}

fn of_photo(bytes: &[u8]) -> Result<Found> {
    let (width, height) = sensor_size(bytes)?;
    let decoded = decode_gray(bytes, &DecodeOptions::default().with_max_pixels(u64::MAX))?;
    let (upright_width, upright_height) = decoded.image.dimensions();
    let mut notes = Vec::new();
    if (width, height) != (upright_width, upright_height) {
        notes.push(format!(
            "EXIF turns it: it is shown as {upright_width} × {upright_height}"
        ));
    }
    if let Some([low, high]) = decoded.range {
        notes.push(format!(
            "more than 8 bits, of which the values from {low} to {high} are in use"
        ));
    }
    notes.push(match decoded.focal_px {
        Some(focal_px) => format!("EXIF gives a focal length of {focal_px:.1} px"),
        None => match decoded.focal_mm {
            Some(mm) => format!(
                "EXIF gives a focal length of {mm:.1} mm, but not the size of the sensor: give --sensor-width-mm"
            ),
            None => "no EXIF focal length".to_owned(),
        },
    });
    if decoded.place.is_some() {
        notes.push("EXIF gives the position of the camera".to_owned());
    }
    Ok(Found {
        kind: "photograph",
        convention: "pixel centers at integers, as the sensor gives them",
        counts: json!({ "width": width, "height": height }),
        notes,
    })
}

fn of_pfm(bytes: &[u8]) -> Result<Found> {
    let image = read_pfm(bytes)?;
    let known = image.as_raw().iter().filter(|d| d.is_finite()).count();
    Ok(Found {
        kind: "disparities of PFM",
        convention: "the bottom row first; NaN or infinity: no value",
        counts: json!({ "width": image.width(), "height": image.height(), "known": known }),
        notes: Vec::new(),
    })
}

fn of_graph(text: &str) -> Result<Found> {
    let read = read_g2o(text)?;
    let (vertices, edges) = read.graph.size();
    let (kind, fixed) = match &read.graph {
        PoseGraph::Se2(graph) => ("pose graph of g2o, in the plane", graph.fixed.len()),
        PoseGraph::Se3(graph) => ("pose graph of g2o, in space", graph.fixed.len()),
        PoseGraph::Sim3(graph) => ("pose graph of g2o, with scales", graph.fixed.len()),
    };
    let (priors, landmarks) = (read.graph.num_priors(), read.graph.num_landmarks());
    Ok(Found {
        kind,
        convention: "world from vertex; quaternions x, y, z, w",
        counts: json!({
            "vertices": vertices - landmarks, "landmarks": landmarks, "edges": edges,
            "priors": priors, "fixed": fixed,
        }),
        notes: read.notes,
    })
}

fn of_bal(text: &str) -> Result<Found> {
    let problem = read_bal(text)?;
    Ok(Found {
        kind: "bundle adjustment problem of BAL",
        convention: "cameras look along -z, v up, origin in the middle of the image",
        counts: json!({
            "cameras": problem.cameras.len(), "points": problem.points.len(),
            "observations": problem.observations.len(),
        }),
        notes: Vec::new(),
    })
}
