//! `epipole calibrate`: one or two cameras from photos of a board.

mod search;

use self::search::{SearchedPhotos, search};
use crate::context::Context;
use crate::failure::Failure;
use crate::lens::Model;
use crate::listing::{Listed, ListingArguments};
use crate::matrices::{Motion, positive};
use crate::pattern::{PatternArguments, columns_and_rows};
use crate::progress::Progress;
use crate::reading::ReadArguments;
use crate::report::Report;
use clap::Args;
use epipole::calibration::{
    Board, Calibration, CalibrationOptions, RigCalibration, calibrate, calibrate_rig,
};
use epipole_io::camera::{CameraFormat, Cameras, camera_fields, write_cameras};
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};

/// Calibrate a camera or a stereo rig from images of a board.
#[derive(Debug, Args)]
#[command(
    after_help = "Example: epipole calibrate left*.jpg --board 9x6 --square-m 0.025 --right right*.jpg -o camera.json\n\n\
    `epipole board` draws boards. Half of the corners of a chessboard must be visible, at least two in each of\n\
    its outermost rows and columns. Of a ChArUco board or an AprilGrid (of Kalibr, with borders of two bits) any\n\
    part with six corners suffices. ChArUco boards drawn by OpenCV before 4.6 with an even number of rows are\n\
    different. Ten to twenty views are enough, tilted by 30° to 45° about several axes, some of them at the edges\n\
    of the image. The right images must show the same moments in the same order. Images taken upright are of the\n\
    same camera: sizes and pixels are those of the sensor, before images are rotated.\n\n\
    JSON: image (width and height), k (fx, fy, cx, cy), distortion (model and coefficients, in OpenCV's order),\n\
    rms_px, std_dev (of k and of the coefficients), coverage (fraction of the image that boards reach), views\n\
    (name, found, num_marks, rms_px and cam_from_board with rotation and translation, or the problem),\n\
    warnings; with --right also right (the same for the right camera) and stereo (right_from_left,\n\
    std_dev_rotation_rad, std_dev_translation_m, rms_px, baseline_m, pairs_rms_px)."
)]
pub(crate) struct Arguments {
    /// Images of the board, all of one size, or a folder of them.
    #[arg(required = true, value_name = "IMAGES")]
    photos: Vec<PathBuf>,
    /// Columns and rows of the board (inner corners of a chessboard, squares of a ChArUco board,
    /// tags of an AprilGrid, disks).
    #[arg(long, value_name = "COLUMNSxROWS", value_parser = columns_and_rows)]
    board: (usize, usize),
    /// Side of a square or tag [default: 1, so that lengths are in squares]. For circles, the
    /// distance between rows.
    #[arg(long, value_name = "S", value_parser = positive)]
    square_m: Option<f64>,
    /// Side of a ChArUco marker [default: three quarters of a square].
    #[arg(long, value_name = "M", value_parser = positive)]
    marker_m: Option<f64>,
    /// Images of the right camera of a stereo rig.
    #[arg(long, value_name = "IMAGES", num_args = 1..)]
    right: Vec<PathBuf>,
    /// Lens model.
    #[arg(long, value_enum, default_value = "brown")]
    model: Model,
    /// Maximum number of steps.
    #[arg(long, default_value_t = CalibrationOptions::default().max_iterations, value_name = "N")]
    max_iterations: usize,
    /// Camera file: .json, or .yml for OpenCV; - for JSON on standard output.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    pattern: PatternArguments,
    #[command(flatten)]
    listing: ListingArguments,
    #[command(flatten)]
    reading: ReadArguments,
}

/// Ratio of a rig's error to that of its worse camera, above which the rig is wrong.
const MUCH_WORSE: f64 = 4.0;
/// Lower bound of the worse camera's error in that ratio, pixels: noise of corners.
const LEAST_ERROR_PX: f64 = 0.2;

pub(crate) fn run(arguments: &Arguments, context: &Context) -> Result<Report, Failure> {
    let format = arguments.output.as_deref().map(format_of).transpose()?;
    let (columns, rows) = arguments.board;
    let (square_m, unit) = match arguments.square_m {
        Some(square_m) => (square_m, "m"),
        None => (1.0, "squares"),
    };
    let pattern = arguments.pattern.pattern(arguments.marker_m, square_m);
    let board = Board::new(pattern, columns, rows, square_m)
        .map_err(|error| Failure::usage(error.to_string()))?;
    let left_photos = arguments.listing.photos(&arguments.photos, context)?;
    let right_photos = arguments.listing.photos(&arguments.right, context)?;
    if !right_photos.is_empty() && right_photos.len() != left_photos.len() {
        return Err(Failure::usage(format!(
            "--right needs as many images as there are left ones, but there are {} and {}",
            right_photos.len(),
            left_photos.len()
        )));
    }
    let options = CalibrationOptions::default()
        .with_lens(arguments.model.into())
        .with_max_iterations(arguments.max_iterations);
    let left = Side::new(&left_photos, arguments, &board, &options, context)?;
    let mut fields = left.fields();
    let mut report = left.rows(Report::default());
    let mut warnings = left.warnings("");
    let mut cameras = Cameras::of(left.found.camera);
    if !right_photos.is_empty() {
        let right = Side::new(&right_photos, arguments, &board, &options, context)?;
        let both = [left.found.camera, right.found.camera];
        let rig = calibrate_rig(
            &board,
            &both,
            &left.searched.views,
            &right.searched.views,
            &mut (),
        )?;
        cameras = Cameras::of_rig(both, rig.right_from_left);
        warnings.extend(right.warnings("right camera: "));
        let single_px = left.found.rms_px.max(right.found.rms_px);
        if rig.rms_px > MUCH_WORSE * single_px.max(LEAST_ERROR_PX) {
            warnings.push(format!(
                "the two cameras do not agree: {:.2} px together, where each alone has at most {single_px:.2} px. Are the \
                 images of equal moments and in equal order, and did nothing move between the cameras?",
                rig.rms_px
            ));
        }
        fields.insert("right".to_owned(), Value::Object(right.fields()));
        fields.insert("stereo".to_owned(), stereo(&rig));
        report = right.rows(report.row("right camera", ""));
        report = report
            .row("baseline", format!("{:.6} {unit}", rig.baseline_m))
            .row("stereo error", format!("{:.3} px", rig.rms_px));
    }
    fields.insert("warnings".to_owned(), json!(warnings));
    for warning in &warnings {
        context.warn(warning);
    }
    if let (Some(path), Some(format)) = (&arguments.output, format) {
        let text = match format {
            CameraFormat::OpenCv => write_cameras(format, &cameras)?,
            _ => format!("{:#}\n", Value::Object(fields.clone())),
        };
        report = report.file(path, text.into_bytes())?;
        report = report.row("written", path.display());
    }
    for (name, value) in fields {
        report = report.field(&name, value);
    }
    Ok(report)
}

/// Returns the format for a file extension.
///
/// # Errors
/// For other extensions.
fn format_of(path: &Path) -> Result<CameraFormat, Failure> {
    let ending = path.extension().unwrap_or_default().to_ascii_lowercase();
    match ending.to_str() {
        Some("yml" | "yaml") => Ok(CameraFormat::OpenCv),
        Some("json" | "") => Ok(CameraFormat::Epipole),
        _ => Err(Failure::usage(format!(
            "{} must be a .json or .yml file; epipole convert makes others of it",
            path.display()
        ))),
    }
}

/// One camera with its photos.
struct Side {
    searched: SearchedPhotos,
    found: Calibration,
}

impl Side {
    fn new(
        photos: &[Listed],
        arguments: &Arguments,
        board: &Board,
        options: &CalibrationOptions,
        context: &Context,
    ) -> Result<Self, Failure> {
        let searched = search(photos, arguments.reading, board, context)?;
        let progress = Progress::new(context, "calibration");
        let (views, size) = (&searched.views, searched.size);
        let mut watch = |status| progress.show(status);
        let found = calibrate(board, views, size, options, &mut watch);
        drop(progress);
        let found = found.map_err(|error| {
            let failure = Failure::from(error);
            // The failed views explain why there are too few.
            let message = match searched.problems.iter().flatten().next() {
                Some(problem) => format!("{}; {problem}", failure.message),
                None if failure.kind == "too-few" => format!(
                    "{}: ten to twenty do well, the board tilted by 30° to 45°, another way in each",
                    failure.message
                ),
                None => failure.message,
            };
            Failure::new(failure.kind, message)
        })?;
        Ok(Self { searched, found })
    }

    fn fields(&self) -> Map<String, Value> {
        let found = &self.found;
        let mut fields = Map::new();
        for (name, value) in camera_fields(&found.camera) {
            fields.insert(name.to_owned(), value);
        }
        let std_dev = [&found.std_dev_k[..], &found.std_dev_lens].concat();
        fields.insert("rms_px".to_owned(), json!(found.rms_px));
        fields.insert("std_dev".to_owned(), json!(std_dev));
        fields.insert("coverage".to_owned(), json!(found.coverage));
        let mut views = Vec::new();
        for (index, view) in found.views.iter().enumerate() {
            let name = &self.searched.names[index];
            views.push(match view {
                Some(view) => json!({
                    "name": name,
                    "found": true,
                    "num_marks": view.num_marks,
                    "rms_px": view.rms_px,
                    "cam_from_board": Motion::from(&view.cam_from_board),
                }),
                None => json!({
                    "name": name,
                    "found": false,
                    "problem": self.searched.problems[index],
                }),
            });
        }
        fields.insert("views".to_owned(), json!(views));
        fields
    }

    fn rows(&self, report: Report) -> Report {
        let found = &self.found;
        let center = found.camera.intrinsics.principal_point();
        let (fu, fv) = (
            found.camera.intrinsics.fu_px(),
            found.camera.intrinsics.fv_px(),
        );
        let [su, sv, sx, sy] = found.std_dev_k;
        let lens: Vec<String> = found
            .camera
            .lens
            .coefficients()
            .iter()
            .map(|k| format!("{k:.5}"))
            .collect();
        let num_found = found.views.iter().flatten().count();
        report
            .row("boards", format!("{num_found} of {}", found.views.len()))
            .row("error", format!("{:.3} px", found.rms_px))
            .row(
                "focal lengths",
                format!("{fu:.2} ± {su:.2}, {fv:.2} ± {sv:.2} px"),
            )
            .row(
                "principal point",
                format!("{:.2} ± {sx:.2}, {:.2} ± {sy:.2} px", center.x, center.y),
            )
            .row("distortion", lens.join(", "))
            .row(
                "reached by boards",
                format!("{:.0}%", 100.0 * found.coverage),
            )
    }

    fn warnings(&self, whose: &str) -> Vec<String> {
        let problems = self.searched.problems.iter().flatten().cloned();
        let sentences = self.found.warnings.iter().map(ToString::to_string);
        problems
            .chain(sentences)
            .map(|w| format!("{whose}{w}"))
            .collect()
    }
}

fn stereo(rig: &RigCalibration) -> Value {
    json!({
        "right_from_left": Motion::from(&rig.right_from_left),
        "std_dev_rotation_rad": rig.std_dev_rotation_rad,
        "std_dev_translation_m": rig.std_dev_translation_m,
        "rms_px": rig.rms_px,
        "baseline_m": rig.baseline_m,
        "pairs_rms_px": rig.pairs_rms_px,
    })
}
