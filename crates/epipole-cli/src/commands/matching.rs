//! `epipole match`: matching features of two images.

use crate::camera::{self, CameraArguments};
use crate::context::Context;
use crate::failure::Failure;
use crate::features::{FeatureArguments, MatchArguments, matched_pixels, rows};
use crate::known_camera::CameraFile;
use crate::photo::Size;
use crate::reading::SizeArguments;
use crate::report::Report;
use crate::{files, match_file, picture};
use clap::Args;
use std::path::PathBuf;

/// Match the features of two images.
#[derive(Debug, Args)]
#[command(
    after_help = "Example: epipole match left.jpg right.jpg -o matches.txt --png matches.png\n\
    Piped: epipole match a.jpg b.jpg -o - | epipole fit --model fundamental -\n\n\
    The file of matches has one match per line, least ambiguous first: u1 v1 u2 v2 distance ratio. epipole fit,\n\
    two-view and triangulate read it.\n\n\
    JSON: images (width and height of both), keypoints1 and keypoints2 ([u, v, scale_px, angle_rad, response]\n\
    each), matches ([index in keypoints1, index in keypoints2, distance, ratio] each); with --camera also rays1\n\
    and rays2: the direction of each keypoint (unit vector, x right, y down, z forward), or null where the lens\n\
    model has no ray."
)]
pub(crate) struct Arguments {
    /// First image.
    first: PathBuf,
    /// Second image.
    second: PathBuf,
    /// Write the matches (comma-separated if the name ends in .csv; -: standard output).
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Draw the matches (both images, with lines between them).
    #[arg(long, value_name = "FILE.png")]
    png: Option<PathBuf>,
    #[command(flatten)]
    camera: CameraFile,
    #[command(flatten)]
    features: FeatureArguments,
    #[command(flatten)]
    matching: MatchArguments,
    #[command(flatten)]
    size: SizeArguments,
}

pub(crate) fn run(arguments: &Arguments, context: &Context) -> Result<Report, Failure> {
    let paths = [&*arguments.first, &*arguments.second];
    let photos = arguments.camera.read(paths, arguments.size, context)?;
    let found1 = arguments.features.detect(&photos[0], context)?;
    let found2 = arguments.features.detect(&photos[1], context)?;
    let matches = arguments.matching.run(&found1, &found2)?;
    let mut report = Report::default();
    if let Some(path) = &arguments.output {
        let mut sorted = matches.clone();
        sorted.sort_by(|a, b| a.ratio.total_cmp(&b.ratio));
        let [pixels1, pixels2] = matched_pixels(&sorted, &found1, &found2);
        let tests: Vec<[f32; 2]> = sorted.iter().map(|m| [m.distance, m.ratio]).collect();
        let text = match_file::text(path, [&pixels1, &pixels2], &tests);
        report = report.file(path, text.into_bytes())?;
    }
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
    let nums_keypoints = format!("{} and {}", found1.keypoints.len(), found2.keypoints.len());
    report = report.row("keypoints", nums_keypoints);
    if arguments.camera.is_set() {
        let cameras = CameraArguments::default();
        let mut nums_visible = Vec::new();
        for (name, photo, found) in [
            ("rays1", &photos[0], &found1),
            ("rays2", &photos[1], &found2),
        ] {
            let (k, guess) = cameras.or_guess(photo)?;
            if let Some(sentence) = camera::sentence(guess.as_slice()) {
                context.warn(&sentence);
            }
            let pixels = found.keypoints.iter().map(|keypoint| keypoint.point());
            let camera = photo.camera(k);
            let rays: Vec<Option<[f64; 3]>> = pixels
                .map(|pixel| {
                    camera
                        .observe(&pixel)
                        .ok()
                        .map(|observation| observation.ray().into())
                })
                .collect();
            nums_visible.push(rays.iter().flatten().count().to_string());
            report = report.field(name, rays);
        }
        report = report.row("seen by the lens", nums_visible.join(" and "));
    }
    Ok(report
        .field(
            "images",
            photos.each_ref().map(|photo| Size::from(&photo.color)),
        )
        .field("keypoints1", rows(&found1.keypoints))
        .field("keypoints2", rows(&found2.keypoints))
        .field("matches", list)
        .row("matches", matches.len()))
}
