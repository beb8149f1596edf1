//! `epipole frames`: the sharpest frames of a video.

use crate::context::Context;
use crate::failure::Failure;
use crate::listing::{Listed, ListingArguments};
use crate::photo::{Photo, bytes};
use crate::progress::Progress;
use crate::reading::ReadArguments;
use crate::report::Report;
use crate::{files, interrupt};
use clap::Args;
use epipole::imaging::sharpness;
use serde_json::json;
use std::path::PathBuf;

/// Choose the sharpest frame of each part of a video.
#[derive(Debug, Args)]
#[command(
    after_help = "Example: epipole frames walk/ --num-frames 20 -o photos, after\n\
    ffmpeg -i walk.mp4 -qscale:v 2 walk/%05d.jpg\n\n\
    The frames, in the order of their names, are divided into --num-frames parts of equal length, and the sharpest\n\
    frame of each part is copied unchanged.\n\n\
    JSON: num_frames (of the input), files (those written), chosen (name and sharpness of each: mean square of its\n\
    details of a few pixels)."
)]
pub(crate) struct Arguments {
    /// Frames of one size, or a folder of them.
    #[arg(required = true, value_name = "FILES|FOLDER")]
    frames: Vec<PathBuf>,
    /// Number of frames to choose.
    #[arg(long, default_value_t = 20, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    num_frames: u32,
    /// Output folder.
    #[arg(short, long, value_name = "FOLDER")]
    output: PathBuf,
    #[command(flatten)]
    listing: ListingArguments,
    #[command(flatten)]
    reading: ReadArguments,
}

pub(crate) fn run(arguments: &Arguments, context: &Context) -> Result<Report, Failure> {
    let listed = arguments.listing.photos(&arguments.frames, context)?;
    let num_parts = (arguments.num_frames as usize).min(listed.len());
    let progress = Progress::new(context, "looking for the sharpest frames");
    // The best of each part so far, the first of equals.
    let mut best: Vec<Option<(usize, f64)>> = vec![None; num_parts];
    for (index, one) in listed.iter().enumerate() {
        if interrupt::requested() {
            return Err(epipole::Error::Canceled.into());
        }
        progress.set(index as f64 / listed.len() as f64);
        let photo = Photo::prepared(&one.path, arguments.reading, None, context)?;
        let value = sharpness(&photo.gray());
        let part = &mut best[index * num_parts / listed.len()];
        if part.is_none_or(|(_, most)| value > most) {
            *part = Some((index, value));
        }
    }
    drop(progress);
    files::make_folder(&arguments.output)?;
    let (mut written, mut chosen) = (Vec::new(), Vec::new());
    for (index, value) in best.into_iter().flatten() {
        let Listed { path, name } = &listed[index];
        let target = arguments.output.join(name);
        files::make_folder_of(&target)?;
        files::write(&target, &bytes(path)?)?;
        written.push(target.display().to_string());
        chosen.push(json!({ "name": name, "sharpness": value }));
    }
    Ok(Report::default()
        .row("frames", listed.len())
        .row("chosen", chosen.len())
        .row("written", written.join(", "))
        .field("num_frames", listed.len())
        .field("files", written)
        .field("chosen", chosen))
}
