//! `epipole pnp`: the pose of a camera from points of the world and their pixels.

mod arguments;
mod axes;
mod causes;
mod search;

pub(crate) use self::arguments::Arguments;

use self::arguments::View;
use self::search::{Pose, with_focal_length};
use crate::context::Context;
use crate::failure::Failure;
use crate::match_file;
use crate::matrices::Motion;
use crate::report::Report;
use crate::units::warn_of_units;
use epipole_io::camera::camera_fields;
use nalgebra::Point3;
use serde_json::{Value, json};

pub(crate) fn run(arguments: &Arguments, context: &Context) -> Result<Report, Failure> {
    let view = arguments.view()?;
    let (pixels, points) = match_file::points_with_pixels(&arguments.points)?;
    causes::check(&pixels, &points).map_err(|failure| failure.about(&arguments.points))?;
    warn_of_units(&pixels, &view.camera().intrinsics, context);
    let found = match &view {
        View::Camera(camera) => search::with_camera(arguments, context, &points, &pixels, camera),
        View::WithoutFocal(camera) => {
            search::with_focal(arguments, context, &points, &pixels, camera)
        }
    };
    let found = found.map_err(|failure| causes::with_advice(failure, &arguments.points))?;
    let (best, others) = (&found.best, &found.others);
    let num_inliers = found.inliers.iter().filter(|is| **is).count();
    if let View::Camera(camera) = &view {
        let options = arguments.robust.options(context).within(found.max_error_px);
        axes::check(&points, &pixels, camera, num_inliers, &options, context);
    }
    let mask: Vec<u8> = found.inliers.iter().map(|is| u8::from(*is)).collect();
    let center = center(best);
    let mut report = Report::default()
        .row("inliers", format!("{num_inliers} of {}", mask.len()))
        .row(
            "mean error of inliers",
            format!("{:.3} px", best.mean_error_px),
        )
        .row("camera at", words(&center));
    if let Some(focal_px) = best.focal_px {
        let spread = found
            .focal_std_px
            .map_or_else(String::new, |std_px| format!(" ± {std_px:.2}"));
        report = report.row("focal length", format!("{focal_px:.2}{spread} px"));
    }
    for other in others {
        let error = format!(
            "{}, mean error {:.3} px",
            words(&self::center(other)),
            other.mean_error_px
        );
        report = report.row("or camera at", error);
    }
    let others: Vec<Value> = others.iter().map(fields).collect();
    let known = view.camera();
    let camera = match best.focal_px {
        None => *known,
        Some(focal_px) => with_focal_length(known, focal_px)?,
    };
    for (name, value) in camera_fields(&camera) {
        report = report.field(name, value);
    }
    Ok(report
        .field("cam_from_world", Motion::from(&best.cam_from_world))
        .field("center", [center.x, center.y, center.z])
        .field("inliers", mask)
        .field("num_inliers", num_inliers)
        .field("mean_error_px", best.mean_error_px)
        .field("max_error_px", found.max_error_px)
        .field("focal_px", best.focal_px)
        .field("focal_std_px", found.focal_std_px)
        .field("alternatives", others))
}

fn fields(pose: &Pose) -> Value {
    let center = center(pose);
    json!({
        "cam_from_world": Motion::from(&pose.cam_from_world), "center": [center.x, center.y, center.z],
        "mean_error_px": pose.mean_error_px, "focal_px": pose.focal_px,
    })
}

fn center(pose: &Pose) -> Point3<f64> {
    pose.cam_from_world
        .inverse_transform_point(&Point3::origin())
}

fn words(point: &Point3<f64>) -> String {
    format!("({:.4}, {:.4}, {:.4})", point.x, point.y, point.z)
}
