//! The depth of every pixel of a pair of the sample, against what the photographs were rendered
//! from.

use super::{exported, finish, output};
use epipole::camera::{PosedCamera, look_at};
use epipole_lab::project::{DepthMethod, DepthOptions, Project, Step};
use epipole_lab::session::Event;
use epipole_lab::tasks::{CameraFound, Dense, DepthOf, FindDepth, Photograph};
use epipole_scenes::{Scene, still_life_camera};
use image::{RgbImage, imageops};
use nalgebra::{Matrix3, Point3, Quaternion, UnitQuaternion, Vector3};

/// The camera that a photograph of the table was rendered with.
pub(crate) fn true_camera(index: usize) -> PosedCamera {
    let middle = Point3::new(0.035, -0.13, 0.05);
    let angle = (index as f64 - 4.0) * 8.0_f64.to_radians();
    let height = [-0.43, -0.56][index % 2];
    let center = Point3::new(
        middle.x + 1.38 * libm::sin(angle),
        height,
        middle.z - 1.38 * libm::cos(angle),
    );
    PosedCamera {
        cam_from_world: look_at(&center, &middle, &Vector3::new(0.0, -1.0, 0.0)).unwrap(),
        ..still_life_camera(480, 360)
    }
}

fn rotation(camera: &CameraFound) -> Matrix3<f64> {
    let [i, j, k, w] = camera.rotation;
    *UnitQuaternion::new_normalize(Quaternion::new(w, i, j, k))
        .to_rotation_matrix()
        .matrix()
}

/// Relative errors of the distances of all points, seen from the first camera.
pub(crate) fn errors(
    project: &Project,
    first: usize,
    points: impl Iterator<Item = [f64; 3]>,
) -> Vec<f64> {
    let found = |index: usize| project.component().unwrap().cameras[index].unwrap();
    let truth = true_camera(first);
    let center = |camera: &PosedCamera| camera.cam_from_world.inverse() * Point3::origin();
    // Frames are joined by this camera, and by the distance to the one at the other end.
    let far = if first < 4 { 8 } else { 0 };
    let scale = (center(&true_camera(far)) - center(&truth)).norm()
        / (found(far).center() - found(first).center()).norm();
    let turn = truth
        .cam_from_world
        .rotation
        .inverse()
        .to_rotation_matrix()
        .matrix()
        * rotation(&found(first));
    let scene = Scene::still_life();
    let one = |place: [f64; 3]| {
        let along = turn * (Point3::from(place) - found(first).center()) * scale;
        let hit = scene.cast(&center(&truth), &along.normalize())?;
        Some((along.norm() / hit.distance_along - 1.0).abs())
    };
    points.filter_map(one).collect()
}

/// Errors of every third pixel along rows and columns.
fn errors_of_pair(project: &Project, first: usize, pair: &Dense) -> Vec<f64> {
    errors(project, first, pair.points(3).map(|(place, _)| place))
}

pub(crate) fn ratio_below(errors: &[f64], limit: f64) -> f64 {
    errors.iter().filter(|error| **error < limit).count() as f64 / errors.len().max(1) as f64
}

/// Matches a pair, compares it with the truth, and looks for it in the files.
pub(crate) fn every_pixel_has_its_depth(project: &mut Project) {
    let ids: Vec<u32> = project
        .document()
        .photos
        .iter()
        .map(|photo| photo.id)
        .collect();
    project.update(Event::Show(Step::Depth));
    project.update(Event::LookAtPair(ids[3], ids[4]));
    assert_eq!(finish(project), 1, "depth, and nothing else");
    let pair = depth(project, 3, 4);
    assert_eq!((pair.factor, pair.is_vertical), (1, false));
    assert!(pair.density > 0.6, "{}", pair.density);
    let proposed = pair.proposed_px.unwrap();
    assert_eq!(pair.range_px, proposed);
    assert!(proposed[0] > 0 && proposed[1] < 200, "{proposed:?}");
    let off = errors_of_pair(project, if pair.is_swapped { 4 } else { 3 }, &pair);
    let (one, five) = (ratio_below(&off, 0.01), ratio_below(&off, 0.05));
    assert!(one > 0.8 && five > 0.93, "{one} {five} of {}", off.len());
    let words = project.describe();
    assert!(words.contains("pixels have a depth"), "{words}");

    // The other way round it is the same pair; one above the other share columns.
    project.update(Event::LookAtPair(ids[4], ids[3]));
    assert_eq!(finish(project), 0);
    project.update(Event::LookAtPair(ids[0], ids[8]));
    finish(project);
    assert!(!project.describe().contains("NaN"));

    // Knobs: block matching, all pixels filled, disparities as typed.
    let mut settings = project.document().settings.clone();
    settings.depth.method = DepthMethod::Block;
    settings.depth.fill = true;
    settings.depth.range_px = Some([proposed[0], proposed[1] + 7]);
    project.update(Event::Set(settings));
    project.update(Event::LookAtPair(ids[3], ids[4]));
    finish(project);
    let filled = depth(project, 3, 4);
    assert_eq!(filled.density, 1.0);
    assert_eq!(filled.range_px, [proposed[0], proposed[1] + 7]);
    project.update(Event::Undo);
    assert!(project.pending().is_empty());

    in_the_files(project, [ids[3], ids[4]], &pair);
    sizes_may_differ(project, [3, 4]);
    project.update(Event::LookAtPair(ids[0], ids[1]));
    project.update(Event::Show(Step::Reconstruction));
}

/// The same pair with one photograph half as large again, and with one that stands upright.
fn sizes_may_differ(project: &Project, [first, second]: [usize; 2]) {
    let component = project.component().unwrap();
    let given = &project.document().photos;
    let photographs = [first, second].map(|n| project.photograph(&given[n]).unwrap().clone());
    let cameras = [first, second].map(|n| component.cameras[n].unwrap());
    let is_seen = |index: usize, track: &[(u32, u32)]| track.iter().any(|t| t.0 as usize == index);
    let shared = component.points.iter().filter(|point| {
        [first, second]
            .iter()
            .all(|index| is_seen(*index, &point.track))
    });
    let points: Vec<[f64; 3]> = shared.map(|point| point.position).collect();
    let image = |photograph: &Photograph| {
        let (width, height) = (photograph.width, photograph.height);
        RgbImage::from_raw(width, height, photograph.rgb.to_vec()).unwrap()
    };
    let with = |photograph: &Photograph, image: RgbImage| Photograph {
        width: image.width(),
        height: image.height(),
        full_size: image.dimensions(),
        rgb: image.into_raw().into(),
        ..photograph.clone()
    };
    for (changed, is_upright) in [(0, false), (1, true)] {
        let (mut photographs, mut cameras) = (photographs.clone(), cameras);
        let before = image(&photographs[changed]);
        let [fu, fv, cu, cv] = cameras[changed].intrinsics;
        let after = match is_upright {
            true => {
                cameras[changed].intrinsics = [fu, fv, cu - 110.0, cv];
                imageops::crop_imm(&before, 110, 0, 280, 360).to_image()
            }
            false => {
                let larger = |c: f64| (c + 0.5) * 1.5 - 0.5;
                cameras[changed].intrinsics = [1.5 * fu, 1.5 * fv, larger(cu), larger(cv)];
                imageops::resize(&before, 720, 540, imageops::FilterType::CatmullRom)
            }
        };
        photographs[changed] = with(&photographs[changed], after);
        let task = FindDepth {
            photographs,
            cameras,
            lens: component.lens,
            points: points.clone(),
            options: DepthOptions::default(),
        };
        let pair = output(task).unwrap();
        assert_eq!((pair.width, pair.height, pair.factor), (480, 360, 1));
        let off = errors_of_pair(project, if pair.is_swapped { second } else { first }, &pair);
        let (one, five) = (ratio_below(&off, 0.01), ratio_below(&off, 0.05));
        let expected = if is_upright { 10_000 } else { 12_000 };
        println!("{changed}: {one} {five} of {}", off.len());
        assert!(
            one > 0.75 && five > 0.92 && 9 * off.len() > expected,
            "{one} {five} of {}",
            off.len()
        );
    }
}

fn depth(project: &Project, first: usize, second: usize) -> Dense {
    let photos = &project.document().photos;
    let found = project.get(DepthOf(photos[first].id, photos[second].id));
    found
        .unwrap_or_else(|| panic!("{}", project.describe()))
        .clone()
}

fn in_the_files(project: &mut Project, [a, b]: [u32; 2], pair: &Dense) {
    project.update(Event::Dense(a, b, true));
    let mut read = exported(project);
    let depths = epipole_io::disparity::read_pfm(&read("depth/table-4_table-5.pfm")).unwrap();
    let scale = project.scale().map_or(1.0, |scale| scale.meters_per_unit);
    for (u, v) in [(100, 100), (240, 180), (300, 200)] {
        let expected = pair.depth(u, v).map(|depth| (depth * scale) as f32);
        assert_eq!(depths.get(u, v), expected);
    }
    let picture = image::load_from_memory(&read("depth/table-4_table-5.png")).unwrap();
    assert_eq!(picture.to_rgb8().as_raw()[..], pair.left[..]);
    let ply = read("dense.ply");
    let head = format!("element vertex {}\n", pair.points(1).count());
    assert!(
        String::from_utf8_lossy(&ply[..300]).contains(&head),
        "{head}"
    );
    let json: serde_json::Value = serde_json::from_slice(&read("reconstruction.json")).unwrap();
    assert_eq!(json["depth"][0]["depth"], "depth/table-4_table-5.pfm");
    assert!(
        String::from_utf8(read("README.txt"))
            .unwrap()
            .contains("dense.ply")
    );
    project.update(Event::Undo);
    assert!(project.document().dense.is_empty());
}
