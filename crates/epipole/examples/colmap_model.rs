//! Photographs to a model that COLMAP and its friends read.
//!
//! `cargo run --release --example colmap_model -- out/ 1200 photos/*.jpg`, with the focal length in
//! pixels.

mod common;

use common::{Outcome, photos};
use epipole::prelude::*;
use epipole_io::model::Model;
use std::path::Path;

pub(crate) fn run(arguments: &[String]) -> Outcome<()> {
    let photos = photos(arguments.get(2..).unwrap_or_default())?;
    let focal_px = arguments.get(1).map_or(Ok(400.0), |text| text.parse())?;
    let first = photos.first().ok_or("which photographs?")?;
    let (width, height) = first.image.dimensions();
    let camera = Camera::pinhole(
        Intrinsics::centered(focal_px, width, height)?,
        width,
        height,
    );
    let (features, options) = (PhotoOptions::default(), SfmOptions::default());
    let (input, result) = reconstruct_photos(&photos, &[camera], &features, &options, &mut ())?;
    let model = result
        .components
        .first()
        .ok_or("the photographs do not overlap")?;
    println!(
        "mean error {:.2} px",
        model.mean_reprojection_px(&input.images)
    );
    if let Some(folder) = arguments.first() {
        std::fs::create_dir_all(folder)?;
        for file in Model::from_reconstruction(model, &input.images).to_colmap_text()? {
            std::fs::write(Path::new(folder).join(file.name), file.bytes)?;
        }
    } else {
        assert_eq!(model.num_registered(), 3);
    }
    Ok(())
}

#[allow(dead_code, reason = "the tests call run")]
fn main() -> Outcome<()> {
    run(&common::arguments())
}
