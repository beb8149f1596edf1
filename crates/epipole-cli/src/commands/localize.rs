//! `epipole localize`: poses of new photos in a model.

mod arguments;
mod known;
mod photos;

pub(crate) use self::arguments::Arguments;

use self::known::Known;
use self::photos::{Localized, NewPhoto};
use crate::context::Context;
use crate::failure::Failure;
use crate::matrices::Motion;
use crate::model;
use crate::report::Report;
use serde_json::{Value, json};

pub(crate) fn run(arguments: &Arguments, context: &Context) -> Result<Report, Failure> {
    let listed = arguments.listing.photos(&arguments.photos, context)?;
    let model = model::read(&arguments.model)?.model;
    let mut photos = Vec::new();
    for photo in &listed {
        photos.push(NewPhoto::read(arguments, photo, &model.cameras, context)?);
    }
    let known = Known::read(arguments, &model, context)?;
    let mut found = Vec::new();
    for photo in &photos {
        found.push(photo.localize(arguments, &known, context)?);
    }
    let num_localized = found.iter().filter(|found| found.is_ok()).count();
    if let (0, Some(Err(reason))) = (num_localized, found.first()) {
        return Err(Failure::new("no-consensus", reason).about(&listed[0].path));
    }
    let mut report =
        Report::default().row("localized", format!("{num_localized} of {}", found.len()));
    for (photo, found) in photos.iter().zip(&found) {
        let words = match found {
            Ok(found) => {
                let [x, y, z] = found.center();
                format!(
                    "at ({x:.4}, {y:.4}, {z:.4}), {} of {} matches agree",
                    found.num_inliers, found.num_matches
                )
            }
            Err(reason) => reason.clone(),
        };
        report = report.row(&photo.name, words);
    }
    let rows: Vec<Value> = photos
        .iter()
        .zip(&found)
        .map(|(photo, found)| fields(photo, found))
        .collect();
    Ok(report
        .field("photos", rows)
        .field("num_localized", num_localized)
        .field("num_observations", known.num_observations)
        .field("num_found_again", known.num_found_again))
}

fn fields(photo: &NewPhoto, found: &Result<Localized, String>) -> Value {
    let localized = found.as_ref().ok();
    json!({
        "name": photo.name,
        "cam_from_world": localized.map(|found| Motion::from(&found.cam_from_world)),
        "center": localized.map(Localized::center),
        "num_inliers": localized.map_or(0, |found| found.num_inliers),
        "num_matches": localized.map(|found| found.num_matches),
        "focal_px": photo.camera.intrinsics.fu_px(),
        "reason": found.as_ref().err(),
    })
}
