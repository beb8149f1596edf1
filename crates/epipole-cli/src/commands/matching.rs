//! `epipole match`: features of two photographs that look alike.

use crate::context::Context;
use crate::failure::Failure;
use crate::features::{FeatureArguments, MatchArguments, rows};
use crate::photo::{Photo, Size, SizeArguments};
use crate::report::Report;
use crate::{files, picture};
use clap::Args;
use std::path::PathBuf;

/// Match the features of two photographs.
#[derive(Debug, Args)]
#[command(
    after_help = "Example: epipole match left.jpg right.jpg --ratio 0.8 --mutual --png matches.png\n\n\
    JSON: images (width and height of both), keypoints1 and keypoints2 ([u, v, scale_px, angle_rad,\n\
    response] each), matches ([place in keypoints1, place in keypoints2, distance, ratio] each)."
)]
pub(crate) struct Arguments {
    /// A PNG, JPEG or WebP file.
    first: PathBuf,
    /// A PNG, JPEG or WebP file.
    second: PathBuf,
    #[command(flatten)]
    size: SizeArguments,
    #[command(flatten)]
    features: FeatureArguments,
    #[command(flatten)]
    matching: MatchArguments,
    /// Write both photographs with lines between the matches.
    #[arg(long, value_name = "FILE.png")]
    png: Option<PathBuf>,
}

pub(crate) fn run(arguments: &Arguments, context: &Context) -> Result<Report, Failure> {
    let photos = [
        Photo::prepared(&arguments.first, arguments.size, None)?,
        Photo::prepared(&arguments.second, arguments.size, None)?,
    ];
    let found1 = arguments.features.detect(&photos[0], context)?;
    let found2 = arguments.features.detect(&photos[1], context)?;
    let matches = arguments.matching.run(&found1, &found2)?;
    if let Some(path) = &arguments.png {
        let mut both = picture::side_by_side(&photos[0].color, &photos[1].color);
        let offset = f64::from(photos[0].color.width());
        for (index, found) in matches.iter().enumerate() {
            let (a, b) = (
                &found1.keypoints[found.index1],
                &found2.keypoints[found.index2],
            );
            let hue = picture::HUES[index % picture::HUES.len()];
            picture::line(&mut both, (a.u, a.v), (b.u + offset, b.v), hue);
        }
        files::write(path, &picture::png(&both)?)?;
    }
    let list: Vec<(usize, usize, f32, f32)> = matches
        .iter()
        .map(|m| (m.index1, m.index2, m.distance, m.ratio))
        .collect();
    Ok(Report::default()
        .field(
            "images",
            photos.each_ref().map(|photo| Size::from(&photo.color)),
        )
        .field("keypoints1", rows(&found1.keypoints))
        .field("keypoints2", rows(&found2.keypoints))
        .field("matches", list)
        .row(
            "keypoints",
            format!("{} and {}", found1.keypoints.len(), found2.keypoints.len()),
        )
        .row("matches", matches.len()))
}
