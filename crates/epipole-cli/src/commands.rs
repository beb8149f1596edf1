//! The commands, one per file. A new command needs a file here and a variant of [`Command`].

mod ba;
mod board;
mod calibrate;
mod compare;
mod convert;
mod detect;
mod figure;
mod fit;
mod frames;
mod inspect;
mod localize;
mod manual;
mod matching;
mod mvs;
mod odometry;
mod pnp;
mod posegraph;
mod rectify;
pub(crate) mod sfm;
mod stereo;
mod stitch;
mod triangulate;
mod two_view;
mod undistort;

use crate::context::Context;
use crate::failure::Failure;
use crate::report::Report;
use clap::Subcommand;

/// Commands of `epipole`.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Detect(detect::Arguments),
    Match(matching::Arguments),
    Fit(fit::Arguments),
    TwoView(two_view::Arguments),
    Pnp(pnp::Arguments),
    Triangulate(triangulate::Arguments),
    Rectify(rectify::Arguments),
    Stereo(stereo::Arguments),
    Sfm(sfm::Arguments),
    Localize(localize::Arguments),
    Mvs(mvs::Arguments),
    Ba(ba::Arguments),
    Posegraph(posegraph::Arguments),
    Odometry(odometry::Arguments),
    Compare(compare::Arguments),
    Board(board::Arguments),
    Stitch(stitch::Arguments),
    Calibrate(calibrate::Arguments),
    Undistort(undistort::Arguments),
    Frames(frames::Arguments),
    Convert(convert::Arguments),
    Inspect(inspect::Arguments),
    Figure(figure::Arguments),
    Manual(manual::Arguments),
}

impl Command {
    pub(crate) fn run(self, context: &Context) -> Result<Report, Failure> {
        match self {
            Self::Detect(arguments) => detect::run(&arguments, context),
            Self::Match(arguments) => matching::run(&arguments, context),
            Self::Fit(arguments) => fit::run(&arguments, context),
            Self::TwoView(arguments) => two_view::run(&arguments, context),
            Self::Pnp(arguments) => pnp::run(&arguments, context),
            Self::Triangulate(arguments) => triangulate::run(&arguments, context),
            Self::Rectify(arguments) => rectify::run(&arguments, context),
            Self::Stereo(arguments) => stereo::run(&arguments, context),
            Self::Sfm(arguments) => sfm::run(&arguments, context),
            Self::Localize(arguments) => localize::run(&arguments, context),
            Self::Mvs(arguments) => mvs::run(&arguments, context),
            Self::Ba(arguments) => ba::run(&arguments, context),
            Self::Posegraph(arguments) => posegraph::run(&arguments, context),
            Self::Odometry(arguments) => odometry::run(&arguments, context),
            Self::Compare(arguments) => compare::run(&arguments, context),
            Self::Board(arguments) => board::run(&arguments, context),
            Self::Stitch(arguments) => stitch::run(&arguments, context),
            Self::Calibrate(arguments) => calibrate::run(&arguments, context),
            Self::Undistort(arguments) => undistort::run(&arguments, context),
            Self::Frames(arguments) => frames::run(&arguments, context),
            Self::Convert(arguments) => convert::run(&arguments, context),
            Self::Inspect(arguments) => inspect::run(&arguments, context),
            Self::Figure(arguments) => figure::run(&arguments, context),
            Self::Manual(arguments) => manual::run(&arguments),
        }
    }
}
