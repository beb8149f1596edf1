//! Photographs through lenses of any model.

use super::Folder;
use epipole::calibration::CalibratedCamera;
use epipole::camera::{Camera, Intrinsics, Lens, LensKind, RigidTransform};
use epipole::synthetic::{Sampling, Scene};
use image::{Rgb, RgbImage};
use nalgebra::{Matrix3, Point2, Rotation3, UnitQuaternion, Vector3};
use std::path::PathBuf;

/// Pixels of a side of [`camera`]'s photographs.
pub(crate) const SIZE: u32 = 420;

/// A lens of each model: 175° wide, or as narrow as 36°.
pub(crate) fn camera(kind: LensKind) -> CalibratedCamera {
    let (focal_px, numbers): (f64, &[f64]) = match kind {
        LensKind::Brown => (400.0, &[-0.1, 0.02, 0.001, -0.001, 0.0]),
        LensKind::Rational => (320.0, &[0.3, 0.05, 0.001, -0.001, 0.01, 0.5, 0.1, 0.005]),
        LensKind::Fisheye => (140.0, &[-0.02, 0.006, -0.002, 0.0003]),
        LensKind::Division => (640.0, &[-0.3]),
    };
    CalibratedCamera {
        intrinsics: Intrinsics::new(focal_px, focal_px, 210.5, 208.0).unwrap(),
        lens: Lens::from_coefficients(kind, numbers).unwrap(),
        width: SIZE,
        height: SIZE,
    }
}

/// All of them.
pub(crate) const KINDS: [LensKind; 4] = [
    LensKind::Brown,
    LensKind::Rational,
    LensKind::Fisheye,
    LensKind::Division,
];

/// The file that `--camera` reads.
pub(crate) fn write(folder: &Folder, camera: &CalibratedCamera) -> PathBuf {
    let k = &camera.intrinsics;
    let center = k.principal_point();
    let text = format!(
        r#"{{ "image": {{ "width": {}, "height": {} }}, "k": [{}, {}, {}, {}],
        "distortion": {{ "model": "{}", "coefficients": {:?} }} }}"#,
        camera.width,
        camera.height,
        k.fu_px(),
        k.fv_px(),
        center.x,
        center.y,
        camera.lens.kind().name(),
        camera.lens.coefficients()
    );
    folder.write("camera.json", &text)
}

/// The sides of a cube around the camera that a lens sees: the rows are the axes of each.
fn sides() -> [Matrix3<f64>; 5] {
    let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
    [[x, y, z], [-z, y, x], [z, y, -x], [x, -z, y], [x, z, -y]]
        .map(|axes| Matrix3::from_rows(&axes.map(|axis| axis.transpose())))
}

/// What a camera sees of the still life through its lens: the sides of a cube, each rendered by a pinhole camera, and read where the
/// rays of its pixels meet them.
pub(crate) fn photograph(camera: &CalibratedCamera, cam_from_world: &RigidTransform) -> RgbImage {
    let side = 500;
    let k = Intrinsics::centered(0.48 * f64::from(side), side, side).unwrap();
    let scene = Scene::still_life();
    let shown = sides().map(|axes| {
        let turn = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes));
        let side_camera = Camera {
            intrinsics: k,
            cam_from_world: RigidTransform::from_parts(Vector3::zeros().into(), turn)
                * cam_from_world,
        };
        scene
            .render(&side_camera, side, side, Sampling::Full)
            .unwrap()
            .image
    });
    RgbImage::from_fn(camera.width, camera.height, |u, v| {
        let Ok(ray) = camera.ray(&Point2::new(f64::from(u), f64::from(v))) else {
            return Rgb([0; 3]);
        };
        let turned = sides().map(|axes| axes * ray);
        let facing = |i: &usize| turned[*i].z / turned[*i].amax() > 0.999_999;
        let Some(n) = (0..5).find(facing) else {
            return Rgb([0; 3]);
        };
        let place = k.project(&turned[n].into()).unwrap();
        let (left, top) = (place.x.floor(), place.y.floor());
        let mut color = [0.5; 3];
        for (du, dv) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
            let weight = (1.0 - (place.x - left - du).abs()) * (1.0 - (place.y - top - dv).abs());
            let last = f64::from(side - 1);
            let at = |x: f64| x.clamp(0.0, last) as u32;
            let pixel = shown[n].get_pixel(at(left + du), at(top + dv));
            for (sum, value) in color.iter_mut().zip(pixel.0) {
                *sum += weight * f64::from(value);
            }
        }
        Rgb(color.map(|value: f64| value as u8))
    })
}

/// Gray that changes smoothly with the place, in details of any size: some of it is found again from any distance.
fn gray(x: f64, y: f64) -> f64 {
    let at = |i: i64, j: i64, octave: u64| {
        let mixed = (i as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15)
            ^ (j as u64).wrapping_mul(0xC2B2_AE3D_27D4_EB4F)
            ^ (octave + 1).wrapping_mul(0x1656_67B1_9E37_79F9);
        let mixed = (mixed ^ (mixed >> 29)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        ((mixed ^ (mixed >> 32)) % 1000) as f64 / 1000.0
    };
    let mut sum = 0.0;
    for octave in 0..4u32 {
        let scale = f64::from(4 << octave);
        let (u, v) = (x * scale, y * scale);
        let (i, j) = (u.floor() as i64, v.floor() as i64);
        let (a, b) = (u - u.floor(), v - v.floor());
        for (di, dj) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            let weight = if di == 0 { 1.0 - a } else { a } * if dj == 0 { 1.0 - b } else { b };
            sum += weight * at(i + di, j + dj, octave.into()) / 4.0;
        }
    }
    sum
}

/// What a camera sees through its lens of a wall, the plane z = 0 of the world.
pub(crate) fn wall_photograph(
    camera: &CalibratedCamera,
    cam_from_world: &RigidTransform,
) -> RgbImage {
    let world_from_cam = cam_from_world.inverse();
    let center = world_from_cam.translation.vector;
    RgbImage::from_fn(camera.width, camera.height, |u, v| {
        let ray = camera.ray(&Point2::new(f64::from(u), f64::from(v)));
        let direction = ray.map(|ray| world_from_cam.rotation * ray.normalize());
        match direction {
            Ok(direction) if direction.z > 0.02 => {
                let place = center - direction * (center.z / direction.z);
                Rgb([(255.0 * gray(place.x, place.y)) as u8; 3])
            }
            _ => Rgb([0; 3]),
        }
    })
}
