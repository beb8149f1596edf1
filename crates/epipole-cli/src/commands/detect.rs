//! `epipole detect`: the features or markers of an image.

use crate::context::Context;
use crate::failure::Failure;
use crate::features::{FeatureArguments, rows};
use crate::pattern::dictionary;
use crate::photo::{Photo, Size};
use crate::progress::Progress;
use crate::reading::SizeArguments;
use crate::report::Report;
use crate::{files, picture};
use clap::Args;
use epipole::calibration::{Marker, MarkerDictionary, MarkerOptions, detect_markers};
use serde_json::json;
use std::path::PathBuf;

/// Find features or markers in an image.
#[derive(Debug, Args)]
#[command(
    after_help = "Example: epipole detect photo.jpg --features sift --max-features 2000 --png marks.png\n\n\
    Markers: epipole detect photo.jpg --markers 36h11 --png marks.png\n\n\
    JSON: image (width, height), keypoints ([u, v, scale_px, angle_rad, response] each). With --markers instead of\n\
    these: markers (id, corners: four [u, v], clockwise from the upper left one of the upright marker, hamming:\n\
    number of wrong bits)."
)]
pub(crate) struct Arguments {
    /// Image file.
    image: PathBuf,
    /// Write the image with the features marked.
    #[arg(long, value_name = "FILE.png")]
    png: Option<PathBuf>,
    /// Find square markers instead of features: 4x4_N, 5x5_N, 6x6_N, 7x7_N (N is 50, 100, 250 or
    /// 1000) or 36h11.
    #[arg(long, value_name = "DICTIONARY", value_parser = dictionary)]
    markers: Option<MarkerDictionary>,
    /// Width of a marker's black border, bits: 2 for an AprilGrid of Kalibr.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u8).range(1..=4), requires = "markers")]
    border_bits: u8,
    #[command(flatten)]
    features: FeatureArguments,
    #[command(flatten)]
    size: SizeArguments,
}

pub(crate) fn run(arguments: &Arguments, context: &Context) -> Result<Report, Failure> {
    let photo = Photo::prepared(&arguments.image, arguments.size, None, context)?;
    if let Some(dictionary) = arguments.markers {
        return markers(arguments, dictionary, &photo, context);
    }
    let found = arguments.features.detect(&photo, context)?;
    let size = Size::from(&photo.color);
    if let Some(path) = &arguments.png {
        let mut marked = photo.color.clone();
        picture::keypoints(&mut marked, &found.keypoints, 0.0);
        files::write(path, &picture::png(&marked)?)?;
    }
    Ok(Report::default()
        .field("image", size)
        .field("keypoints", rows(&found.keypoints))
        .row(
            "image",
            format!("{} × {}", photo.color.width(), photo.color.height()),
        )
        .row("keypoints", found.keypoints.len()))
}

fn markers(
    arguments: &Arguments,
    dictionary: MarkerDictionary,
    photo: &Photo,
    context: &Context,
) -> Result<Report, Failure> {
    let options = MarkerOptions::default().with_border_bits(arguments.border_bits.into());
    let progress = Progress::new(context, "markers");
    let watch = &mut |status| progress.show(status);
    let found = detect_markers(&photo.gray(), dictionary, &options, watch)?;
    drop(progress);
    if let Some(path) = &arguments.png {
        let mut marked = photo.color.clone();
        for (n, marker) in found.iter().enumerate() {
            let corners = marker.corners.map(|p| (p.x, p.y));
            let hue = picture::HUES[n % picture::HUES.len()];
            for side in 0..4 {
                picture::line(&mut marked, corners[side], corners[(side + 1) % 4], hue);
            }
        }
        files::write(path, &picture::png(&marked)?)?;
    }
    let (width, height) = photo.color.dimensions();
    let ids: Vec<String> = found.iter().map(|marker| marker.id.to_string()).collect();
    let fields = |marker: &Marker| {
        let corners = marker.corners.map(|p| [p.x, p.y]);
        json!({ "id": marker.id, "corners": corners, "hamming": marker.hamming })
    };
    let mut report = Report::default()
        .field("image", Size::from(&photo.color))
        .field("markers", found.iter().map(fields).collect::<Vec<_>>())
        .row("image", format!("{width} × {height}"))
        .row("markers", found.len());
    if !ids.is_empty() {
        report = report.row("numbers", ids.join(", "));
    }
    Ok(report)
}
