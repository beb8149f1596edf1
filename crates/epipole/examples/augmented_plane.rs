//! A box drawn onto a sheet of paper: the camera's pose from marks of the sheet, one of them wrong.
//!
//! `cargo run --release --example augmented_plane`

use epipole::prelude::*;

pub(crate) fn run() -> Result<(), Error> {
    let k = Intrinsics::centered(700.0, 640, 480)?;
    // Corners and middles of an A4 sheet's sides, meters, and where they are seen.
    let (w, h) = (0.297, 0.21);
    let marks = [
        (0.0, 0.0),
        (0.5, 0.0),
        (1.0, 0.0),
        (1.0, 0.5),
        (1.0, 1.0),
        (0.5, 1.0),
        (0.0, 1.0),
        (0.0, 0.5),
    ];
    let sheet = marks.map(|(x, y)| Point3::new(x * w, y * h, 0.0));
    let truth = RigidTransform::new(
        Vector3::new(-0.13, -0.05, 0.6),
        Vector3::new(0.6, 0.1, 0.05),
    );
    let mut pixels = Vec::new();
    for p in &sheet {
        pixels.push(k.project(&(truth * p))?);
    }
    pixels[3].x += 40.0;
    let camera = Camera::pinhole(k, 640, 480);
    let found =
        estimate_absolute_pose(&sheet, &pixels, &camera, &RansacOptions::default(), &mut ())?;
    println!("{} of 8 marks agree", found.num_inliers);
    let cam_from_sheet = found.model;
    // The box is 5 cm high; z points into the table.
    for z in [0.0, -0.05] {
        for (x, y) in [(0.1, 0.1), (0.15, 0.1), (0.15, 0.15), (0.1, 0.15)] {
            let corner = k.project(&(cam_from_sheet * Point3::new(x, y, z)))?;
            println!(
                "({x}, {y}, {z}) m is drawn at ({:.1}, {:.1})",
                corner.x, corner.y
            );
        }
    }
    let off = cam_from_sheet.inverse() * truth;
    assert!(off.rotation.angle() < 1e-6 && off.translation.vector.norm() < 1e-6);
    Ok(())
}

#[allow(dead_code, reason = "the tests call run")]
fn main() -> Result<(), Error> {
    run()
}
