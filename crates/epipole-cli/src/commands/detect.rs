//! `epipole detect`: the features of a photograph.

use crate::context::Context;
use crate::failure::Failure;
use crate::features::{FeatureArguments, rows};
use crate::photo::{Photo, Size};
use crate::reading::SizeArguments;
use crate::report::Report;
use crate::{files, picture};
use clap::Args;
use std::path::PathBuf;

/// Find features in a photograph.
#[derive(Debug, Args)]
#[command(
    after_help = "Example: epipole detect photo.jpg --features sift --max-features 2000 --png marks.png\n\n\
    JSON: image (width, height), keypoints ([u, v, scale_px, angle_rad, response] each)."
)]
pub(crate) struct Arguments {
    /// A photograph.
    image: PathBuf,
    /// Write the photograph with the features marked.
    #[arg(long, value_name = "FILE.png")]
    png: Option<PathBuf>,
    #[command(flatten)]
    features: FeatureArguments,
    #[command(flatten)]
    size: SizeArguments,
}

pub(crate) fn run(arguments: &Arguments, context: &Context) -> Result<Report, Failure> {
    let photo = Photo::prepared(&arguments.image, arguments.size, None, context)?;
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
