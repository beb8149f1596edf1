//! Synthetic scenes and images: matches with known ground truth.

use epipole::camera::{Camera, Distortion, Intrinsics, PosedCamera, look_at};
use epipole::feature::Match;
use epipole::math::random::Random;
use epipole::sfm::{
    AlignmentKind, PairMatches, SfmImage, SfmInput, SfmOptions, SfmResult, align_points,
    reconstruct,
};
use nalgebra::{Point2, Point3, Vector3};

pub(crate) struct World {
    pub(crate) cameras: Vec<PosedCamera>,
    pub(crate) input: SfmInput,
}

/// Parameters of the synthetic photographs.
#[derive(Clone, Copy)]
pub(crate) struct Making {
    pub(crate) noise_px: f64,
    /// Share of matches that lead to another keypoint.
    pub(crate) wrong: f64,
    pub(crate) distortion: Distortion,
    /// Number of following photographs that each is matched with.
    pub(crate) reach: usize,
}

impl Default for Making {
    fn default() -> Self {
        Self {
            noise_px: 0.0,
            wrong: 0.0,
            distortion: Distortion::NONE,
            reach: usize::MAX,
        }
    }
}

pub(crate) fn observe(
    cameras: Vec<PosedCamera>,
    points: &[Point3<f64>],
    making: Making,
    seed: u64,
) -> World {
    let mut random = Random::new(seed);
    let mut input = SfmInput {
        cameras: vec![cameras[0].camera],
        ..SfmInput::default()
    };
    // The keypoint of each point in each image.
    let mut keypoint_of = Vec::new();
    for (index, camera) in cameras.iter().enumerate() {
        let mut image = SfmImage {
            name: format!("{index}.png"),
            ..SfmImage::default()
        };
        let mut keypoints = vec![None; points.len()];
        for (n, point) in points.iter().enumerate() {
            let p = camera.cam_from_world * point;
            if p.z < 0.1 {
                continue;
            }
            let shown = making
                .distortion
                .distort(&Point2::new(p.x / p.z, p.y / p.z));
            let k = camera.camera.intrinsics;
            let pixel = Point2::new(
                k.fu_px() * shown.x + k.principal_point().x + making.noise_px * random.normal(),
                k.fv_px() * shown.y + k.principal_point().y + making.noise_px * random.normal(),
            );
            if (0.0..639.0).contains(&pixel.x) && (0.0..479.0).contains(&pixel.y) {
                keypoints[n] = Some(image.keypoints.len() as u32);
                image.keypoints.push(pixel);
                image.colors.push([n as u8, 7, 9]);
            }
        }
        keypoint_of.push(keypoints);
        input.images.push(image);
    }
    for a in 0..cameras.len() {
        for b in a + 1
            ..cameras
                .len()
                .min(a.saturating_add(making.reach).saturating_add(1))
        {
            let mut matches = Vec::new();
            for n in 0..points.len() {
                if let (Some(i), Some(j)) = (keypoint_of[a][n], keypoint_of[b][n]) {
                    if random.unit() < making.wrong {
                        let other = random.below(input.images[b].keypoints.len());
                        matches.push(Match::new(i as usize, other));
                    } else {
                        matches.push(Match::new(i as usize, j as usize));
                    }
                }
            }
            input.pairs.push(PairMatches {
                image1: a,
                image2: b,
                matches,
            });
        }
    }
    World { cameras, input }
}

pub(crate) fn intrinsics() -> Intrinsics {
    Intrinsics::centered(700.0, 640, 480).expect("intrinsics")
}

pub(crate) fn ball(count: usize, center: Point3<f64>, seed: u64) -> Vec<Point3<f64>> {
    let mut random = Random::new(seed);
    let mut draw = || random.uniform(-1.2, 1.2);
    (0..count)
        .map(|_| center + Vector3::new(draw(), draw(), draw()))
        .collect()
}

/// Cameras on an arc around `center`.
pub(crate) fn arc(count: usize, center: Point3<f64>) -> Vec<PosedCamera> {
    (0..count)
        .map(|i| {
            let (s, c) = libm::sincos(0.2 * i as f64);
            let eye = center + Vector3::new(5.0 * s, 0.3 * (i % 3) as f64, -5.0 * c);
            let up = Vector3::new(0.0, -1.0, 0.0);
            PosedCamera {
                camera: Camera::pinhole(intrinsics(), 640, 480),
                cam_from_world: look_at(&eye, &center, &up).expect("a view"),
            }
        })
        .collect()
}

pub(crate) fn run(world: &World, options: &SfmOptions) -> SfmResult {
    reconstruct(&world.input, options, &mut ()).expect("a result")
}

/// Largest errors of centers and of rotations in degrees, after the best similarity.
pub(crate) fn errors(world: &World, cameras: &[Option<PosedCamera>]) -> (f64, f64) {
    let (mut found, mut truth) = (Vec::new(), Vec::new());
    for (got, want) in cameras.iter().zip(&world.cameras) {
        if let Some(got) = got {
            found.push(*got);
            truth.push(*want);
        }
    }
    let centers = |list: &[PosedCamera]| -> Vec<_> {
        list.iter().map(PosedCamera::center_in_world).collect()
    };
    let align = align_points(
        &centers(&found),
        &centers(&truth),
        AlignmentKind::Similarity,
    )
    .expect("an alignment");
    let (mut distance, mut angle): (f64, f64) = (0.0, 0.0);
    for (got, want) in found.iter().zip(&truth) {
        let center = align * got.center_in_world();
        distance = distance.max((center - want.center_in_world()).norm());
        let rotation = got.cam_from_world.rotation * align.isometry.rotation.inverse();
        angle = angle.max(
            rotation
                .angle_to(&want.cam_from_world.rotation)
                .to_degrees(),
        );
    }
    (distance, angle)
}
