//! `epipole undistort`: images without lens distortion.

use crate::context::Context;
use crate::failure::Failure;
use crate::listing::ListingArguments;
use crate::photo::Photo;
use crate::reading::ReadArguments;
use crate::report::Report;
use crate::{files, interrupt, lens, picture};
use clap::{Args, ValueEnum};
use epipole::calibration::{Keep, Undistortion};
use serde_json::json;
use std::path::PathBuf;

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum KeepArgument {
    /// All source pixels, with black borders.
    All,
    /// Only valid pixels: no black borders, but edges are lost.
    Valid,
}

/// Remove the distortion of a calibrated lens from images.
#[derive(Debug, Args)]
#[command(
    after_help = "Example: epipole undistort photos/*.jpg --camera camera.json -o flat\n\n\
    Writes an upright PNG file of the same size for each image. Images taken upright are of the same camera, if\n\
    their EXIF data have their rotation.\n\n\
    JSON: files (those written), k (fx, fy, cx, cy of the new camera, in the orientation of the sensor), valid\n\
    (u, v, width and height of the part in which every pixel is valid)."
)]
pub(crate) struct Arguments {
    /// Images of the calibrated camera, or a folder of them.
    #[arg(required = true, value_name = "IMAGES")]
    photos: Vec<PathBuf>,
    /// Camera file (FILE#NAME: one of several) of `epipole calibrate`, OpenCV, ROS, Kalibr, KITTI,
    /// ORB-SLAM, COLMAP, nerfstudio, Metashape or MATLAB.
    #[arg(long, value_name = "FILE")]
    camera: PathBuf,
    /// Use the right camera of the file.
    #[arg(long)]
    right: bool,
    /// Area to keep.
    #[arg(long, value_enum, default_value = "valid")]
    keep: KeepArgument,
    /// Output folder.
    #[arg(short, long, value_name = "FOLDER")]
    output: PathBuf,
    #[command(flatten)]
    listing: ListingArguments,
    #[command(flatten)]
    reading: ReadArguments,
}

pub(crate) fn run(arguments: &Arguments, context: &Context) -> Result<Report, Failure> {
    let keep = match arguments.keep {
        KeepArgument::All => Keep::All,
        KeepArgument::Valid => Keep::Valid,
    };
    let listed = arguments.listing.photos(&arguments.photos, context)?;
    let first = listed.first().map(|one| one.path.as_path());
    let camera = match arguments.right {
        true => lens::read_right(&arguments.camera, first)?,
        false => lens::read(&arguments.camera, first)?,
    };
    let mut targets = Vec::new();
    for one in &listed {
        let target = arguments.output.join(&one.name).with_extension("png");
        if targets.contains(&target) {
            return Err(Failure::usage(format!(
                "two images would be written to {}",
                target.display()
            )));
        }
        targets.push(target);
    }
    let flat = Undistortion::new(&camera, keep, &mut interrupt::watch)?;
    let mut written = Vec::new();
    for (one, target) in listed.iter().zip(&targets) {
        let path = &one.path;
        if interrupt::requested() {
            context.warn(interrupt::ENDED_EARLY);
            break;
        }
        let photo = Photo::prepared(path, arguments.reading, Some(&flat), context)?;
        if photo.k.is_none() {
            let (width, height) = photo.sensor_size;
            let upright = match (height, width) == (camera.width, camera.height) {
                true => ", and the file has no orientation",
                false => "",
            };
            let message = format!(
                "the image is {width} × {height}, but the camera was calibrated for {} × {}{upright}",
                camera.width, camera.height
            );
            return Err(Failure::new("size-mismatch", message).about(path));
        }
        files::make_folder_of(target)?;
        files::write(target, &picture::png(&photo.color)?)?;
        written.push(target.display().to_string());
    }
    let k = &flat.intrinsics;
    let center = k.principal_point();
    let valid = &flat.valid;
    let (width, height) = (valid.u_max - valid.u_min, valid.v_max - valid.v_min);
    Ok(Report::default()
        .row("written", written.join(", "))
        .row("focal length", format!("{:.2} px", k.fu_px()))
        .row(
            "principal point",
            format!("{:.2}, {:.2} px", center.x, center.y),
        )
        .row(
            "all photographed in",
            format!("{width:.0} × {height:.0} px"),
        )
        .field("files", written)
        .field("k", [k.fu_px(), k.fv_px(), center.x, center.y])
        .field(
            "valid",
            json!({ "u": valid.u_min, "v": valid.v_min, "width": width, "height": height }),
        ))
}
