//! Focal lengths that photographs tell, and those that they do not.

use epipole::camera::{Camera, Intrinsics, Lens, LensKind, PosedCamera, RigidTransform};
use epipole::feature::Match;
use epipole::math::random::Random;
use epipole::sfm::{PairMatches, Reconstruction, SfmImage, SfmInput, SfmOptions, reconstruct};
use nalgebra::{Point3, Vector2, Vector3};

const TRUE_PX: f64 = 707.0;

/// A drive between two rows of houses, reconstructed from 1.2 times the width as the focal length.
///
/// * `yaw_rad`: turn from photograph to photograph
fn drive(yaw_rad: f64) -> (SfmInput, Reconstruction) {
    let (width, height) = (1241, 376);
    let camera = |focal_px| {
        Camera::pinhole(
            Intrinsics::centered(focal_px, width, height).unwrap(),
            width,
            height,
        )
    };
    let mut random = Random::new(1);
    let points: Vec<Point3<f64>> = (0..900)
        .map(|_| {
            let side = if random.unit() < 0.5 { -1.0 } else { 1.0 };
            let (away, up) = (random.uniform(4.0, 12.0), random.uniform(-4.0, 1.6));
            Point3::new(side * away, up, random.uniform(2.0, 40.0))
        })
        .collect();
    let mut input = SfmInput {
        cameras: vec![camera(1.2 * f64::from(width))],
        ..SfmInput::default()
    };
    let mut keypoint_of = Vec::new();
    let mut center = Vector3::zeros();
    for n in 0..14 {
        let angle_rad = yaw_rad * f64::from(n);
        let rotation = RigidTransform::new(Vector3::zeros(), -angle_rad * Vector3::y()).rotation;
        let posed = PosedCamera {
            camera: camera(TRUE_PX),
            cam_from_world: RigidTransform::from_parts((-(rotation * center)).into(), rotation),
        };
        center += 0.8 * Vector3::new(libm::sin(angle_rad), 0.0, libm::cos(angle_rad));
        let mut image = SfmImage::default();
        let mut keypoints = vec![None; points.len()];
        for (index, point) in points.iter().enumerate() {
            let depth = (posed.cam_from_world * point).z;
            let noise = Vector2::from_fn(|_, _| 0.3 * random.normal());
            let Ok(pixel) = posed.project(point) else {
                continue;
            };
            let [u, v] = [pixel.x + noise.x, pixel.y + noise.y];
            let is_inside =
                (0.0..f64::from(width)).contains(&u) && (0.0..f64::from(height)).contains(&v);
            if is_inside && (3.0..45.0).contains(&depth) {
                keypoints[index] = Some(image.keypoints.len());
                image.keypoints.push([u, v].into());
            }
        }
        keypoint_of.push(keypoints);
        input.images.push(image);
    }
    for image1 in 0..14 {
        for image2 in image1 + 1..14 {
            let both = keypoint_of[image1].iter().zip(&keypoint_of[image2]);
            input.pairs.push(PairMatches {
                image1,
                image2,
                matches: both
                    .filter_map(|(i, j)| Some(Match::new((*i)?, (*j)?)))
                    .collect(),
            });
        }
    }
    let options = SfmOptions::default().with_refine_focal(true);
    let found = reconstruct(&input, &options, &mut ()).unwrap();
    let largest = found.components.into_iter().next().unwrap();
    (input, largest)
}

fn focal_px(found: &Reconstruction) -> f64 {
    let camera = found.cameras.iter().flatten().next().unwrap();
    camera.camera.intrinsics.fu_px()
}

#[test]
fn a_straight_drive_is_reported_not_to_determine_its_focal_length() {
    let (input, found) = drive(0.0);
    // Everything fits, with a focal length far from the true one.
    assert_eq!(found.num_registered(), 14);
    assert!(found.mean_reprojection_px(&input.images) < 0.5);
    assert!((focal_px(&found) / TRUE_PX - 1.0).abs() > 0.3);
    assert_eq!(found.determines_focal(&input.images), Ok(false));
}

#[test]
fn a_drive_around_a_corner_determines_its_focal_length() {
    let (input, found) = drive(0.06);
    assert!(
        (focal_px(&found) / TRUE_PX - 1.0).abs() < 0.02,
        "{}",
        focal_px(&found)
    );
    assert_eq!(found.determines_focal(&input.images), Ok(true));
}

/// The drive around a corner through a lens with radial distortion, its focal length told to be a
/// little longer, as files do.
fn bent(k1: f64) -> (SfmInput, Reconstruction) {
    let (mut input, _) = drive(0.06);
    let k = |focal_px| Intrinsics::centered(focal_px, 1241, 376).unwrap();
    let lens = Lens::from_coefficients(LensKind::Brown, &[k1, 0.0, 0.0, 0.0, 0.0]).unwrap();
    let through = Camera {
        lens,
        ..Camera::pinhole(k(TRUE_PX), 1241, 376)
    };
    let without = Camera::pinhole(k(TRUE_PX), 1241, 376);
    for image in &mut input.images {
        for pixel in &mut image.keypoints {
            *pixel = through
                .project(&without.unproject(pixel).unwrap().into())
                .unwrap();
        }
    }
    input.cameras = vec![Camera::pinhole(k(1.01 * TRUE_PX), 1241, 376)];
    let found = reconstruct(&input, &SfmOptions::default(), &mut ()).unwrap();
    let largest = found.components.into_iter().next().unwrap();
    (input, largest)
}

#[test]
fn a_bent_lens_is_corrected() {
    let (input, mut found) = bent(-0.06);
    let before_px = found.mean_reprojection_px(&input.images);
    assert_eq!(found.refine_lenses(&input.images, &mut ()), Ok(true));
    let after_px = found.mean_reprojection_px(&input.images);
    assert!(
        after_px < 0.4 && after_px < 0.8 * before_px,
        "{before_px} {after_px}"
    );
    let lens = found.cameras.iter().flatten().next().unwrap().camera.lens;
    assert!((lens.coefficients()[0] + 0.06).abs() < 0.01, "{lens:?}");
    assert!(
        (focal_px(&found) / TRUE_PX - 1.0).abs() < 0.01,
        "{}",
        focal_px(&found)
    );
}

#[test]
fn a_correct_initial_lens_stays() {
    let (mut input, _) = drive(0.06);
    input.cameras[0].intrinsics = Intrinsics::centered(TRUE_PX, 1241, 376).unwrap();
    let found = reconstruct(&input, &SfmOptions::default(), &mut ()).unwrap();
    let found = &found.components[0];
    let mut refined = found.clone();
    assert_eq!(refined.refine_lenses(&input.images, &mut ()), Ok(false));
    assert_eq!(&refined, found);
    // A straight drive tells no focal length, whatever it would save.
    let (straight, mut found) = drive(0.0);
    assert_eq!(found.refine_lenses(&straight.images, &mut ()), Ok(false));
}
