//! A reconstruction in words and numbers: the command line's JSON, and the command that does the same.

use super::model::Order;
use crate::tasks::{Calibrated, FeatureKind, FeatureOptions, MatchOptions, SfmOptions, Source};
use epipole::camera::RigidTransform;
use epipole::sfm::{Reconstruction, SfmImage};
use serde_json::{Value, json};

/// The object that `epipole sfm --json` prints, without its time.
pub(super) fn json(order: &Order<'_>, images: &[SfmImage], model: &Reconstruction) -> String {
    let motion = |transform: &RigidTransform| {
        let rotation = transform.rotation.to_rotation_matrix();
        json!({
            "rotation": rotation.matrix().transpose().as_slice(),
            "translation": transform.translation.vector.as_slice(),
        })
    };
    let registered: Vec<Value> = (images.iter().zip(&model.cameras))
        .filter_map(|(image, camera)| {
            let camera = camera.as_ref()?;
            Some(json!({
                "name": image.name,
                "focal_px": camera.intrinsics.fu_px(),
                "cam_from_world": motion(&camera.cam_from_world),
            }))
        })
        .collect();
    let components: Vec<Value> = (order.found.components.iter())
        .map(|c| json!({ "num_registered": c.num_registered(), "num_points": c.points.len() }))
        .collect();
    let errors: f64 = (model.points.iter())
        .map(|p| p.error_px * p.track.len() as f64)
        .sum();
    let summary = json!({
        "focal_refined": order.options.refine_focal,
        "num_registered": model.num_registered(),
        "num_images": images.len(),
        "num_points": model.points.len(),
        "mean_reprojection_px": errors / model.num_observations().max(1) as f64,
        "images": registered,
        "components": components,
        "complete": true,
        "meters_per_unit": order.meters_per_unit,
        "depth": super::depth::json(order),
    });
    summary.to_string()
}

/// What the files are, and how to make them by the command line.
pub(super) fn readme(order: &Order<'_>) -> String {
    let unit = match order.meters_per_unit {
        Some(_) => "Lengths are meters, by the length that was measured.",
        None => "The unit of length is arbitrary: nothing was measured.",
    };
    let mut text = String::from(
        "images/              the photographs, as they were reconstructed\n\
         sparse/0/            COLMAP's text model: `colmap gui`, or the import of another program, opens it\n\
         points.ply           the points with their colors\n\
         reconstruction.json  what `epipole sfm --json` prints\n",
    );
    if !order.dense.is_empty() {
        text.push_str(
            "depth/               the depth of every pixel of a rectified photograph, along its camera's axis; the \
             photograph as PNG, and its camera in reconstruction.json\n\
             dense.ply            all of these pixels as points with their colors, in the frame of points.ply\n",
        );
    }
    text.push_str(&format!("\n{unit}\n"));
    let reduced = (order.photographs.iter()).any(|p| {
        matches!(p.source, Source::File(_)) && p.used.as_ref().is_some_and(|used| !used.as_given)
    });
    let lead = match reduced {
        true => {
            "Nearly the same (photographs were reduced, turned or freed of distortion, and written anew) by"
        }
        false => "The same by",
    };
    if let Some(command) = command(order) {
        text.push_str(&format!("\n{lead}\n\n    {command}\n"));
    }
    text
}

/// The command that reconstructs what is in `images/`, if its options can say it.
fn command(order: &Order<'_>) -> Option<String> {
    let first = order.images.first()?.camera;
    let all = |same: &dyn Fn(&Calibrated) -> bool| order.images.iter().all(|i| same(&i.camera));
    let intrinsics = match (first.centered_focal_px(), first.k) {
        (Some(focal_px), _) if all(&|c| c.centered_focal_px() == Some(focal_px)) => {
            format!("--focal-px {focal_px}")
        }
        (None, k) if all(&|camera| camera.k == k) => {
            format!("--k {},{},{},{}", k[0], k[1], k[2], k[3])
        }
        _ => return None,
    };
    let mut command = format!(
        "epipole sfm images/ {intrinsics} --max-features {} --seed {}",
        order.features.max_features, order.options.seed
    );
    let (features, usual) = (order.features, FeatureOptions::default());
    if features.kind == FeatureKind::Sift {
        command.push_str(" --features sift");
    }
    if features.contrast != usual.contrast {
        command.push_str(&format!(" --contrast-threshold {}", features.contrast));
    }
    if order.matching.ratio != MatchOptions::default().ratio {
        command.push_str(&format!(" --ratio {}", order.matching.ratio));
    }
    if !order.matching.mutual {
        command.push_str(" --mutual=false");
    }
    let enough = order.options.min_num_inliers;
    if enough != SfmOptions::default().min_num_inliers {
        command.push_str(&format!(" --min-inliers {enough}"));
    }
    if order.options.refine_focal {
        command.push_str(" --refine-focal");
    }
    if order.options.refine_distortion {
        command.push_str(" --refine-distortion");
    }
    command.push_str(" -o sparse/0");
    Some(command)
}
