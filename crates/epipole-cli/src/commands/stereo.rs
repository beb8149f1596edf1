//! `epipole stereo`: dense disparity of a rectified pair.

mod cloud;
mod knobs;
mod pair;

use self::cloud::CloudArguments;
use self::knobs::{BmArguments, KeepArguments, SgmArguments};
use crate::context::Context;
use crate::failure::Failure;
use crate::files;
use crate::photo::{Photo, check_same_size};
use crate::progress::Progress;
use crate::reading::ReadArguments;
use crate::report::Report;
use clap::{Args, ValueEnum};
use epipole::stereo::{DisparityImage, fill_gaps};
use epipole_io::disparity::{write_pfm, write_png16};
use std::path::PathBuf;

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Method {
    /// Semi-global matching: better.
    Sgm,
    /// Block matching: faster.
    Bm,
}

/// Compute the disparities of a rectified pair.
#[derive(Debug, Args)]
#[command(
    after_help = "Example: epipole stereo left.png right.png --max-disparity 64 -o disparity.pfm\n\n\
    A .pfm file holds disparities in pixels, NaN where there is none; a .png file holds 256 times the\n\
    disparity in 16 bits, 0 where there is none.\n\n\
    With the Q of a rectification:\n  \
    epipole rectify left.jpg right.jpg --rig rig.json -o rectified --json > q.json\n  \
    epipole stereo rectified/left.png rectified/right.png -o d.pfm --ply cloud.ply --q q.json\n\n\
    JSON: width, height, density (fraction of pixels with a value), min_disparity_px and\n\
    max_disparity_px (null if there is no value)."
)]
pub(crate) struct Arguments {
    /// Left image of a rectified pair.
    left: PathBuf,
    /// Right image.
    right: PathBuf,
    /// Minimum disparity, pixels.
    #[arg(long, default_value_t = 0, value_name = "N", value_parser = clap::value_parser!(i32).range(-8192..=8191), allow_hyphen_values = true)]
    min_disparity: i32,
    /// Maximum disparity, pixels.
    #[arg(long, default_value_t = 64, value_name = "N", value_parser = clap::value_parser!(i32).range(-8191..=8192), allow_hyphen_values = true)]
    max_disparity: i32,
    /// Matcher.
    #[arg(long, value_enum, default_value = "sgm")]
    method: Method,
    /// Fill all pixels (with values from their surroundings).
    #[arg(long)]
    fill: bool,
    /// Disparity file, .pfm or .png.
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    #[command(flatten)]
    cloud: CloudArguments,
    #[command(flatten)]
    keep: KeepArguments,
    #[command(flatten)]
    sgm: SgmArguments,
    #[command(flatten)]
    bm: BmArguments,
    #[command(flatten)]
    reading: ReadArguments,
}

impl Arguments {
    /// Returns the minimum disparity and the number of disparities.
    fn disparities(&self) -> Result<(i32, u32), Failure> {
        let count = self.max_disparity - self.min_disparity + 1;
        match u32::try_from(count) {
            Ok(count @ 2..=4096) => Ok((self.min_disparity, count)),
            _ => Err(Failure::usage(format!(
                "--max-disparity must be 1 to 4095 above --min-disparity, but they are {} and {}",
                self.max_disparity, self.min_disparity
            ))),
        }
    }
}

pub(crate) fn run(arguments: &Arguments, context: &Context) -> Result<Report, Failure> {
    let extension = arguments
        .output
        .extension()
        .and_then(|extension| extension.to_str());
    let as_png = match extension.map(str::to_lowercase).as_deref() {
        Some("pfm") => false,
        Some("png") => true,
        _ => {
            let failure = Failure::usage("the disparities must be a .pfm or .png file");
            return Err(failure.about(&arguments.output));
        }
    };
    let disparities = arguments.disparities()?;
    match arguments.method {
        Method::Sgm => arguments.bm.check_unused()?,
        Method::Bm => arguments.sgm.check_unused()?,
    }
    let photos = [
        Photo::prepared(&arguments.left, arguments.reading, None, context)?,
        Photo::prepared(&arguments.right, arguments.reading, None, context)?,
    ];
    check_same_size(&photos)?;
    let q = arguments.cloud.matrix(photos[0].color.dimensions())?;
    let [left, right] = photos.each_ref().map(Photo::gray_u8);
    let range = (arguments.min_disparity, arguments.max_disparity);
    // The check only warns.
    if !context.quiet {
        pair::check(&photos, range, context)?;
    }
    let progress = Progress::new(context, "stereo");
    let mut watch = |status| progress.show(status);
    let mut disparity = match arguments.method {
        Method::Sgm => {
            let matcher = arguments.sgm.matcher(&arguments.keep, disparities);
            matcher.compute(&left, &right, &mut watch)?
        }
        Method::Bm => {
            let matcher = arguments.bm.matcher(&arguments.keep, disparities);
            matcher.compute(&left, &right, &mut watch)?
        }
    };
    if arguments.fill {
        disparity = fill_gaps(&disparity, &left, &mut watch)?;
    }
    let bytes = if as_png {
        write_png16(&disparity)?
    } else {
        write_pfm(&disparity)
    };
    files::write(&arguments.output, &bytes)?;
    if let Some(q) = &q {
        arguments.cloud.write(&disparity, q, &photos[0].color)?;
    }
    Ok(report(&disparity, arguments))
}

fn report(disparity: &DisparityImage, arguments: &Arguments) -> Report {
    let range = disparity.range_px();
    let (width, height) = (disparity.width(), disparity.height());
    let words = range.map_or_else(
        || "no pixel has a value".to_owned(),
        |(min, max)| format!("{min:.2} to {max:.2} px"),
    );
    Report::default()
        .field("width", width)
        .field("height", height)
        .field("density", disparity.density())
        .field("min_disparity_px", range.map(|(min, _)| min))
        .field("max_disparity_px", range.map(|(_, max)| max))
        .row("size", format!("{width} × {height}"))
        .row(
            "pixels with a value",
            format!("{:.1}%", 100.0 * disparity.density()),
        )
        .row("disparities", words)
        .row("written", arguments.output.display())
}
