//! `epipole stitch`: a panorama of photos from one viewpoint, or of one plane.

mod arguments;
mod input;
mod overlaps;
mod place;

pub(crate) use self::arguments::Arguments;

use self::input::Input;
use self::overlaps::Overlaps;
use crate::context::Context;
use crate::failure::Failure;
use crate::matrices::row_major;
use crate::progress::Progress;
use crate::report::Report;
use crate::{files, picture};
use epipole::stitch::render_panorama;
use epipole_io::photo::encode_jpeg;
use image::RgbImage;
use serde_json::{Value, json};

pub(crate) fn run(arguments: &Arguments, context: &Context) -> Result<Report, Failure> {
    let encode = encoder(arguments)?;
    let input = Input::read(arguments, context)?;
    let overlaps = Overlaps::find(arguments, &input, context)?;
    let panorama = place::photos(arguments, &input, &overlaps.found, context)?;
    let judged = overlaps.judge(&panorama, &input, context);
    let photos: Vec<&RgbImage> = input.photos.iter().map(|photo| &photo.image).collect();
    let progress = Progress::new(context, "blending");
    let options = arguments.render_options();
    let whole = render_panorama(&panorama, &photos, &options, &mut |status| {
        progress.show(status)
    });
    let whole = whole.map_err(|error| with_parallax(error.into(), judged.has_parallax))?;
    drop(progress);
    files::write(&arguments.output, &encode(&whole)?)?;

    let (width, height) = whole.dimensions();
    let has_rotations = panorama.rotations.iter().any(Option::is_some);
    let focal_px = has_rotations.then_some(panorama.scale_px);
    let num_stitched = panorama.pixel_from_direction.iter().flatten().count();
    let file = arguments.output.display().to_string();
    let mut report = Report::default()
        .row("photos", format!("{num_stitched} of {}", photos.len()))
        .row(
            "mean error of inliers",
            format!("{:.3} px", judged.mean_error_px),
        )
        .row("size", format!("{width} × {height}"));
    if let Some(focal_px) = focal_px {
        report = report.row("focal length", format!("{focal_px:.1} px"));
    }
    let rows = input.photos.iter().enumerate().map(|(n, photo)| {
        let rotation = panorama.rotations[n].as_ref().map(row_major);
        let pixel_from_direction = panorama.pixel_from_direction[n].as_ref().map(row_major);
        json!({ "name": photo.name, "rotation": rotation, "pixel_from_direction": pixel_from_direction })
    });
    Ok(report
        .row("written", &file)
        .field("width", width)
        .field("height", height)
        .field("focal_px", focal_px)
        .field("files", [file])
        .field("num_stitched", num_stitched)
        .field("mean_error_px", judged.mean_error_px)
        .field("photos", rows.collect::<Vec<Value>>())
        .field("overlaps", judged.rows))
}

/// The likely cause where rotations of photos that are not from one place cannot be drawn.
fn with_parallax(failure: Failure, has_parallax: bool) -> Failure {
    match failure.kind {
        "degenerate" if has_parallax => Failure {
            message: format!(
                "{failure}. The camera moved between the photos, so their rotations may be wrong; photos of a plane \
                 need --model homography"
            ),
            ..failure
        },
        _ => failure,
    }
}

type Encode = fn(&RgbImage) -> Result<Vec<u8>, Failure>;

fn encoder(arguments: &Arguments) -> Result<Encode, Failure> {
    let ending = arguments
        .output
        .extension()
        .unwrap_or_default()
        .to_ascii_lowercase();
    match ending.to_str() {
        Some("png") => Ok(picture::png),
        Some("jpg" | "jpeg") => Ok(|image| Ok(encode_jpeg(image)?)),
        _ => Err(Failure::usage(format!(
            "{} must be a .png or .jpg file",
            arguments.output.display()
        ))),
    }
}
