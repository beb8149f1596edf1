//! Photographs through lenses of any model.

use super::Folder;
use epipole::camera::{Camera, Intrinsics, Lens, LensKind, PosedCamera, RigidTransform};
use epipole_scenes::{Sampling, Scene};
use image::{Rgb, RgbImage};
use nalgebra::{Matrix3, Point2, Rotation3, UnitQuaternion, Vector3};
use serde_json::{Value, json};
use std::cell::OnceCell;
use std::path::PathBuf;

/// Pixels of a side of [`camera`]'s photographs.
pub(crate) const SIZE: u32 = 420;

/// A lens of each model: 175° wide, or as narrow as 36°.
pub(crate) fn camera(kind: LensKind) -> Camera {
    let (focal_px, numbers): (f64, &[f64]) = match kind {
        LensKind::Brown => (400.0, &[-0.1, 0.02, 0.001, -0.001, 0.0]),
        LensKind::Rational => (320.0, &[0.3, 0.05, 0.001, -0.001, 0.01, 0.5, 0.1, 0.005]),
        LensKind::Fisheye => (140.0, &[-0.02, 0.006, -0.002, 0.0003]),
        LensKind::Division => (640.0, &[-0.3]),
    };
    Camera {
        intrinsics: Intrinsics::new(focal_px, focal_px, 210.5, 208.0).unwrap(),
        lens: Lens::from_coefficients(kind, numbers).unwrap(),
        width: SIZE,
        height: SIZE,
    }
}

/// All lens models.
pub(crate) const KINDS: [LensKind; 4] = [
    LensKind::Brown,
    LensKind::Rational,
    LensKind::Fisheye,
    LensKind::Division,
];

/// A camera as in its JSON file.
pub(crate) fn camera_json(camera: &Camera) -> Value {
    let (k, center) = (&camera.intrinsics, camera.intrinsics.principal_point());
    json!({
        "image": { "width": camera.width, "height": camera.height },
        "k": [k.fu_px(), k.fv_px(), center.x, center.y],
        "distortion": { "model": camera.lens.kind().name(), "coefficients": camera.lens.coefficients() },
    })
}

/// The file that `--camera` reads.
pub(crate) fn write(folder: &Folder, camera: &Camera) -> PathBuf {
    folder.write("camera.json", &camera_json(camera).to_string())
}

/// The sides of a cube around the camera that a lens sees: the rows are the axes of each.
fn sides() -> [Matrix3<f64>; 5] {
    let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
    [[x, y, z], [-z, y, x], [z, y, -x], [x, -z, y], [x, z, -y]]
        .map(|axes| Matrix3::from_rows(&axes.map(|axis| axis.transpose())))
}

/// Side of the cube that a pixel sees, and the pixel there.
type Sight = Option<(usize, Point2<f64>)>;

fn sight(camera: &Camera, k: &Intrinsics, pixel: [u32; 2]) -> Sight {
    let ray = camera.unproject(&Point2::from(pixel.map(f64::from))).ok()?;
    let facing = |axes: Matrix3<f64>| {
        let rotated = axes * ray;
        (rotated.z / rotated.amax() > 0.999_999).then_some(rotated)
    };
    let (side, rotated) =
        (sides().into_iter().enumerate()).find_map(|(side, axes)| Some((side, facing(axes)?)))?;
    Some((side, k.project(&rotated.into()).unwrap()))
}

/// Photographs of the still life through a camera's lens from several poses: the sides of a cube,
/// each rendered by a pinhole camera, and sampled where the rays of the camera's pixels meet them.
pub(crate) fn photos<const N: usize>(camera: &Camera, poses: [RigidTransform; N]) -> [RgbImage; N] {
    let side = 500;
    let k = Intrinsics::centered(0.48 * f64::from(side), side, side).unwrap();
    let scene = Scene::still_life();
    let pixels = (0..camera.height).flat_map(|v| (0..camera.width).map(move |u| [u, v]));
    let sights: Vec<Sight> = pixels.map(|pixel| sight(camera, &k, pixel)).collect();
    poses.map(|cam_from_world| {
        let side_photo = |axes: Matrix3<f64>| {
            let rotation = Rotation3::from_matrix_unchecked(axes);
            let rotation = UnitQuaternion::from_rotation_matrix(&rotation);
            let to_side = RigidTransform::from_parts(Vector3::zeros().into(), rotation);
            let side_camera = PosedCamera {
                camera: Camera::pinhole(k, 640, 480),
                cam_from_world: to_side * cam_from_world,
            };
            let shown = scene.render(&side_camera, side, side, Sampling::Full);
            shown.unwrap().image
        };
        // Most lenses see only the front side.
        let shown: [OnceCell<RgbImage>; 5] = Default::default();
        RgbImage::from_fn(camera.width, camera.height, |u, v| {
            let Some((n, place)) = sights[(v * camera.width + u) as usize] else {
                return Rgb([0; 3]);
            };
            let shown = shown[n].get_or_init(|| side_photo(sides()[n]));
            between(shown, place)
        })
    })
}

/// The color between pixels.
fn between(image: &RgbImage, place: Point2<f64>) -> Rgb<u8> {
    let (left, top) = (place.x.floor(), place.y.floor());
    let mut color = [0.5; 3];
    for (du, dv) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
        let weight = (1.0 - (place.x - left - du).abs()) * (1.0 - (place.y - top - dv).abs());
        let at = |x: f64, size: u32| x.clamp(0.0, f64::from(size - 1)) as u32;
        let pixel = image.get_pixel(at(left + du, image.width()), at(top + dv, image.height()));
        for (sum, value) in color.iter_mut().zip(pixel.0) {
            *sum += weight * f64::from(value);
        }
    }
    Rgb(color.map(|value: f64| value as u8))
}

/// Smooth gray pattern with details of all sizes, to have features at any distance.
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

/// Photograph of a wall through a camera's lens; the wall is the plane z = 0 of the world.
pub(crate) fn wall_photo(camera: &Camera, cam_from_world: &RigidTransform) -> RgbImage {
    let world_from_cam = cam_from_world.inverse();
    let center = world_from_cam.translation.vector;
    RgbImage::from_fn(camera.width, camera.height, |u, v| {
        let ray = camera.unproject(&Point2::new(f64::from(u), f64::from(v)));
        let direction = ray.map(|ray| world_from_cam.rotation * ray);
        match direction {
            Ok(direction) if direction.z > 0.02 => {
                let place = center - direction * (center.z / direction.z);
                Rgb([(255.0 * gray(place.x, place.y)) as u8; 3])
            }
            _ => Rgb([0; 3]),
        }
    })
}
