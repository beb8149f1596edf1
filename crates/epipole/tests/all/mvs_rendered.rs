//! Multi-view stereo of rendered photos against their exact depths.

use epipole::Error;
use epipole::camera::{Lens, LensKind, PosedCamera, look_at};
use epipole::math::random::Random;
use epipole::mvs::{
    DepthMap, MvsOptions, MvsView, estimate_depth_maps, fuse_depth_maps, prepare_views,
};
use epipole::progress::Status;
use epipole::sfm::{Reconstruction, ScenePoint, TrackElement};
use epipole_scenes::{Photograph, Sampling, Scene, still_life_camera};
use image::RgbImage;
use nalgebra::{Point2, Point3, Vector3};
use std::ops::ControlFlow;
use std::sync::OnceLock;

const SIZE: (u32, u32) = (240, 180);
const COUNT: usize = 5;

/// A camera on an arc around the table.
fn camera(n: usize) -> PosedCamera {
    let middle = Point3::new(0.035, -0.165, 0.05);
    let angle = 0.12 * (n as f64 - 0.5 * (COUNT - 1) as f64);
    let height = if n.is_multiple_of(2) { -0.43 } else { -0.52 };
    let eye = Point3::new(
        middle.x + 1.35 * libm::sin(angle),
        height,
        middle.z - 1.35 * libm::cos(angle),
    );
    PosedCamera {
        cam_from_world: look_at(&eye, &middle, &Vector3::new(0.0, -1.0, 0.0)).unwrap(),
        ..still_life_camera(SIZE.0, SIZE.1)
    }
}

fn renderings() -> &'static [Photograph] {
    static RENDERINGS: OnceLock<Vec<Photograph>> = OnceLock::new();
    RENDERINGS.get_or_init(|| {
        let scene = Scene::still_life();
        let render = |n| {
            scene
                .render(&camera(n), SIZE.0, SIZE.1, Sampling::Full)
                .unwrap()
        };
        (0..COUNT).map(render).collect()
    })
}

fn photos() -> Vec<RgbImage> {
    renderings()
        .iter()
        .map(|photo| photo.image.clone())
        .collect()
}

fn depth_of(photo: usize, [u, v]: [u32; 2]) -> f64 {
    f64::from(renderings()[photo].depth_m.get_pixel(u, v).0[0])
}

/// Points of the scene, each with the photos that see it.
fn reconstruction() -> Reconstruction {
    let mut random = Random::new(1);
    let mut found = Reconstruction {
        cameras: (0..COUNT).map(|n| Some(camera(n))).collect(),
        ..Reconstruction::default()
    };
    for n in 0..COUNT * 100 {
        let pixel = [SIZE.0, SIZE.1].map(|side| random.below(side as usize) as u32);
        let from = camera(n % COUNT);
        let ray = from
            .camera
            .intrinsics
            .ray(&Point2::from(pixel.map(f64::from)));
        let in_cam = Point3::from(ray * depth_of(n % COUNT, pixel));
        let position = from.cam_from_world.inverse_transform_point(&in_cam);
        let is_visible = |image: &usize| {
            let projected = camera(*image).project(&position).unwrap();
            let (u, v) = (projected.x.round(), projected.y.round());
            let inside = u >= 0.0 && v >= 0.0 && u < f64::from(SIZE.0) && v < f64::from(SIZE.1);
            inside && {
                let depth = (camera(*image).cam_from_world * position).z;
                (depth / depth_of(*image, [u as u32, v as u32]) - 1.0).abs() < 0.005
            }
        };
        let element = |image: usize| TrackElement {
            image: image as u32,
            keypoint: 0,
        };
        let track: Vec<TrackElement> = (0..COUNT).filter(is_visible).map(element).collect();
        if track.len() > 1 {
            found.points.push(ScenePoint {
                position,
                color: [128; 3],
                track,
                error_px: 0.0,
            });
        }
    }
    found
}

fn options() -> MvsOptions {
    MvsOptions::default()
}

fn depth_maps() -> &'static (Vec<MvsView>, Vec<DepthMap>) {
    static MAPS: OnceLock<(Vec<MvsView>, Vec<DepthMap>)> = OnceLock::new();
    MAPS.get_or_init(|| {
        let views = prepare_views(&reconstruction(), &photos(), &options(), &mut ()).unwrap();
        let maps = estimate_depth_maps(&views, &options(), &mut ()).unwrap();
        (views, maps)
    })
}

#[test]
fn depths_are_those_of_the_scene() {
    let (views, maps) = depth_maps();
    assert_eq!(views.len(), COUNT);
    let mut errors = Vec::new();
    for (view, map) in views.iter().zip(maps) {
        assert_eq!(view.neighbors.len(), COUNT - 1);
        let truth = &renderings()[view.photo].depth_m;
        let pairs = map.depth.as_raw().iter().zip(truth.as_raw());
        errors.extend(
            pairs
                .filter(|(z, _)| !z.is_nan())
                .map(|(z, t)| (z / t - 1.0).abs()),
        );
    }
    errors.sort_by(f32::total_cmp);
    let num_pixels = COUNT * SIZE.0 as usize * SIZE.1 as usize;
    let completeness = errors.len() as f64 / num_pixels as f64;
    let median = errors[errors.len() / 2];
    let accuracy = errors.partition_point(|error| *error < 0.01) as f64 / errors.len() as f64;
    println!("{completeness:.3} of pixels, median {median:.5}, {accuracy:.3} within 1 %");
    assert!(completeness > 0.5, "{completeness}");
    // A pixel of disparity is about 1.3 % of the depth here.
    assert!(median < 0.002, "{median}");
    assert!(accuracy > 0.9, "{accuracy}");
}

#[test]
fn points_lie_on_the_scene_with_its_normals() {
    let (views, maps) = depth_maps();
    let cloud = fuse_depth_maps(views, maps, &options(), &mut ()).unwrap();
    let count = cloud.points.len();
    let num_depths: usize = maps.iter().map(|map| map.depth.as_raw().len()).sum();
    assert!(count > 20_000 && count < num_depths / 2, "{count}");
    assert_eq!(
        [
            cloud.normals.len(),
            cloud.colors.len(),
            cloud.confidences.len()
        ],
        [count; 3]
    );
    let scene = Scene::still_life();
    let eye = camera(COUNT / 2).center_in_world();
    let (mut num_near, mut num_facing) = (0, 0);
    for ((point, normal), confidence) in
        (cloud.points.iter().zip(&cloud.normals)).zip(&cloud.confidences)
    {
        assert!((3.0..=COUNT as f32).contains(confidence));
        assert!((normal.norm() - 1.0).abs() < 1e-9);
        let direction = point - eye;
        let hit = scene.cast(&eye, &direction).unwrap();
        // The ray parameter of the point is 1.
        num_near += usize::from((hit.distance_along - 1.0).abs() < 0.01);
        num_facing += usize::from(normal.dot(&direction) < 0.0);
    }
    println!("{count} points, {num_near} near the surface, {num_facing} facing");
    assert!(num_near * 10 > count * 8, "{num_near} of {count}");
    assert!(num_facing * 100 > count * 95, "{num_facing} of {count}");
}

#[test]
fn distortion_is_removed_and_large_photos_are_downscaled() {
    let mut found = reconstruction();
    let kind = LensKind::Brown;
    for camera in found.cameras.iter_mut().flatten() {
        let lens = Lens::from_coefficients(kind, &[-0.1, 0.0, 0.0, 0.0, 0.0]);
        camera.camera.lens = lens.unwrap();
    }
    let small = options().with_max_size_px(120);
    let views = prepare_views(&found, &photos(), &small, &mut ()).unwrap();
    for view in &views {
        assert_eq!(view.image.dimensions(), (120, 90));
        assert!(view.camera.camera.is_pinhole());
        assert_eq!(
            (view.camera.camera.width, view.camera.camera.height),
            (120, 90)
        );
    }
}

#[test]
fn equal_seeds_give_equal_maps_and_work_can_be_canceled() {
    let small = options().with_max_size_px(64);
    let views = prepare_views(&reconstruction(), &photos(), &small, &mut ()).unwrap();
    let mut fractions = Vec::new();
    let mut watch = |status: Status| {
        fractions.push(status.fraction);
        ControlFlow::Continue(())
    };
    let once = estimate_depth_maps(&views, &small, &mut watch).unwrap();
    assert!(
        fractions.is_sorted()
            && fractions
                .iter()
                .all(|fraction| (0.0..=1.0).contains(fraction))
    );
    let again = estimate_depth_maps(&views, &small, &mut ()).unwrap();
    let bits = |maps: &[DepthMap]| -> Vec<u32> {
        let depths = maps.iter().flat_map(|map| map.depth.as_raw());
        depths.map(|z| z.to_bits()).collect()
    };
    assert_eq!(bits(&once), bits(&again));
    let other = estimate_depth_maps(&views, &small.clone().with_seed(1), &mut ()).unwrap();
    assert_ne!(bits(&once), bits(&other));
    for num_reports in [0, 1, 20] {
        let mut left = num_reports;
        let mut stop = |_: Status| {
            left -= 1;
            if left < 0 {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
        let canceled = estimate_depth_maps(&views, &small, &mut stop);
        assert_eq!(canceled, Err(Error::Canceled));
    }
    let canceled = fuse_depth_maps(&views, &once, &small, &mut |_| ControlFlow::Break(()));
    assert_eq!(canceled, Err(Error::Canceled));
    let canceled = prepare_views(&reconstruction(), &photos(), &small, &mut |_| {
        ControlFlow::Break(())
    });
    assert_eq!(canceled, Err(Error::Canceled));
}

#[test]
fn input_that_determines_no_depth_is_rejected() {
    let refused = |found: &Reconstruction, photos: &[RgbImage]| {
        prepare_views(found, photos, &options(), &mut ())
            .unwrap_err()
            .to_string()
    };
    let photos = photos();
    let mut one = reconstruction();
    for camera in &mut one.cameras[1..] {
        *camera = None;
    }
    assert!(refused(&one, &photos).contains("needs at least 2, but there is only 1"));
    let mut empty = reconstruction();
    empty.points.clear();
    assert!(refused(&empty, &photos).contains("there are none"));
    assert!(refused(&reconstruction(), &photos[1..]).contains("same size"));
    let mut other = photos.clone();
    other[2] = RgbImage::new(SIZE.0 + 1, SIZE.1);
    assert!(refused(&reconstruction(), &other).contains("240 and the other 241"));
    let mut apart = reconstruction();
    for (n, point) in apart.points.iter_mut().enumerate() {
        point.track = vec![point.track[n % point.track.len()]];
    }
    assert!(refused(&apart, &photos).contains("no two of them show the same points"));
    let mut still = reconstruction();
    for camera in &mut still.cameras {
        *camera = Some(self::camera(0));
    }
    assert!(refused(&still, &photos).contains("no two of them show the same points"));

    let (views, maps) = depth_maps();
    let change = |change: &dyn Fn(&mut MvsView)| {
        let mut views = views.clone();
        change(&mut views[1]);
        let outcomes = [
            estimate_depth_maps(&views, &options(), &mut ()).map(drop),
            fuse_depth_maps(&views, maps, &options(), &mut ()).map(drop),
        ];
        assert!(outcomes.iter().all(Result::is_err));
    };
    change(&|view| view.neighbors = vec![9]);
    change(&|view| view.neighbors.clear());
    change(&|view| view.depth_range = [0.0, 1.0]);
    change(&|view| view.depth_range = [2.0, f64::INFINITY]);
    change(&|view| view.image = RgbImage::new(0, 0));
    assert!(fuse_depth_maps(views, &maps[1..], &options(), &mut ()).is_err());
}
