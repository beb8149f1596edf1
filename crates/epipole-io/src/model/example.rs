//! A small model for tests: points that every image sees exactly.

use super::{Model, ModelImage, ModelPoint, Rig, RigCamera, RigFrame};
use epipole::camera::{Camera, Intrinsics, Lens, LensKind, RigidTransform, look_at};
use nalgebra::{Point3, Vector3};

/// Names that are difficult for files, shells and text models.
const NAMES: [&str; 4] = ["a b.jpg", "Ü/é è.png", "c.d.e f.jpeg", "plain"];

fn lens(kind: LensKind, coefficients: &[f64]) -> Lens {
    Lens::from_coefficients(kind, coefficients).unwrap()
}

/// Returns a lens of each kind.
pub(super) fn lenses() -> [Lens; 5] {
    [
        Lens::NONE,
        lens(LensKind::Brown, &[-0.1, 0.02, 0.001, -0.002, 0.0]),
        lens(LensKind::Fisheye, &[-0.02, 0.008, -0.004, 6e-4]),
        lens(
            LensKind::Rational,
            &[0.4, -0.1, 0.002, -0.001, 0.01, 0.6, 0.05, 0.01],
        ),
        lens(LensKind::Division, &[-0.3]),
    ]
}

/// Returns four images by cameras with these lenses, cyclically; focal lengths are equal if
/// `is_square`.
pub(super) fn example(lenses: &[Lens], is_square: bool) -> Model {
    let fy = if is_square { 500.0 } else { 501.25 };
    let camera = |(n, lens): (usize, &Lens)| Camera {
        width: 640 + 2 * n as u32,
        height: 480,
        intrinsics: Intrinsics::new(500.0, fy, 321.25 + n as f64, 238.5).unwrap(),
        lens: *lens,
    };
    let cameras: Vec<Camera> = lenses.iter().enumerate().map(camera).collect();
    let corner = |n: usize| {
        let axis = |bit: usize| if n >> bit & 1 == 1 { 0.75 } else { -0.8125 };
        Point3::new(axis(0), 0.5 * axis(1), axis(2))
    };
    let mut points: Vec<ModelPoint> = (0..8)
        .map(|n| ModelPoint {
            id: 40 - 3 * n as u64,
            position: corner(n),
            color: [n as u8 * 30, 7, 255],
            error_px: Some(0.125 * n as f64),
            track: Vec::new(),
        })
        .collect();
    let mut images = Vec::new();
    for (n, name) in NAMES.iter().enumerate() {
        let center = Point3::new(n as f64 - 1.5, -0.25 * n as f64, -4.0);
        let up = Vector3::new(0.1, -1.0, 0.05);
        let cam_from_world = look_at(&center, &Point3::origin(), &up).unwrap();
        let camera = n % cameras.len();
        let mut keypoints = Vec::new();
        for point in &mut points {
            let pixel = cameras[camera].project(&(cam_from_world * point.position));
            point.track.push((n, keypoints.len()));
            keypoints.push(pixel.unwrap());
        }
        images.push(ModelImage {
            id: 3 * n as u32 + 2,
            name: (*name).to_owned(),
            camera,
            cam_from_world,
            keypoints,
        });
    }
    Model {
        camera_ids: (0..cameras.len() as u32).map(|n| 9 - 2 * n).collect(),
        cameras,
        images,
        points,
        rigs: Vec::new(),
    }
}

/// Puts the first two cameras in a rig, and the third in a separate one.
pub(super) fn in_rigs(mut model: Model) -> Model {
    let cam_from_rig =
        RigidTransform::new(Vector3::new(0.5, 0.0, 0.1), Vector3::new(0.1, 0.2, 0.3));
    let identity = RigidTransform::identity();
    let poses: Vec<RigidTransform> = model.images.iter().map(|i| i.cam_from_world).collect();
    // Images are by camera 0, 1, 2 and 0.
    model.images[1].cam_from_world = cam_from_rig * poses[0];
    let frame = |id, rig_from_world, images| RigFrame {
        id,
        rig_from_world,
        images,
    };
    let camera = |camera, cam_from_rig| RigCamera {
        camera,
        cam_from_rig,
    };
    model.rigs = vec![
        Rig {
            id: 5,
            cameras: vec![camera(0, identity), camera(1, cam_from_rig)],
            frames: vec![frame(8, poses[0], vec![0, 1]), frame(2, poses[3], vec![3])],
        },
        Rig {
            id: 3,
            cameras: vec![camera(2, identity)],
            frames: vec![frame(4, poses[2], vec![2])],
        },
    ];
    model
}

/// Returns the largest difference of cameras, poses, keypoints and points, and asserts that the
/// rest is equal.
pub(super) fn difference(a: &Model, b: &Model) -> f64 {
    assert_eq!(
        (a.images.len(), a.points.len()),
        (b.images.len(), b.points.len())
    );
    let mut largest = 0.0_f64;
    for (a_image, b_image) in a.images.iter().zip(&b.images) {
        assert_eq!((&a_image.name, a_image.id), (&b_image.name, b_image.id));
        let (c, d) = (&a.cameras[a_image.camera], &b.cameras[b_image.camera]);
        assert_eq!((c.width, c.height), (d.width, d.height));
        assert_eq!(c.lens.kind(), d.lens.kind());
        let k = c.intrinsics.matrix() - d.intrinsics.matrix();
        let lens = c.lens.coefficients().into_iter().zip(d.lens.coefficients());
        let lens = lens.fold(0.0_f64, |most, (x, y)| most.max((x - y).abs()));
        let pose = a_image.cam_from_world.to_matrix() - b_image.cam_from_world.to_matrix();
        largest = largest.max(k.amax()).max(lens).max(pose.amax());
        assert_eq!(a_image.keypoints.len(), b_image.keypoints.len());
        for (p, q) in a_image.keypoints.iter().zip(&b_image.keypoints) {
            largest = largest.max((p - q).amax());
        }
    }
    for (p, q) in a.points.iter().zip(&b.points) {
        assert_eq!((&p.track, p.color), (&q.track, q.color));
        assert_eq!(p.error_px, q.error_px);
        largest = largest.max((p.position - q.position).amax());
    }
    largest
}
