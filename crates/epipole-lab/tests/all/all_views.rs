//! The depth of all views against what the photographs were rendered from, in files, and in
//! measures.

use crate::common::depth::{errors, ratio_below};
use crate::common::{computed, exported, files_for, finish, output, reopened, solved};
use epipole_io::cloud::read_ply;
use epipole_io::photo::{DecodeOptions, decode_rgb};
use epipole_lab::project::{Anchor, Blob, Measure, Project, Sample, Step};
use epipole_lab::session::Event;
use epipole_lab::tasks::{
    AllViews, CloudVertex, DenseCloud, ExportFormat, FuseViews, Query, Reduced, ReducedOf, Request,
    Task, compute,
};
use nalgebra::Vector3;
use std::ops::ControlFlow;

/// The solved sample with photographs of 258 × 194 pixels for the depth of all views.
fn sample() -> Project {
    let mut project = solved(Sample::Table);
    resize(&mut project, 0.05);
    project
}

fn resize(project: &mut Project, max_megapixels: f64) {
    let mut settings = project.document().settings.clone();
    settings.all_views.max_megapixels = max_megapixels;
    project.update(Event::Set(settings));
}

/// The same with the depth of all views.
fn dense() -> Project {
    let mut project = sample();
    project.update(Event::AllViews(true));
    assert_eq!(finish(&mut project), 10, "nine are downscaled, then fused");
    project
}

fn cloud(project: &Project) -> DenseCloud {
    project.all_views().expect("it is there").1.clone()
}

fn request(project: &Project) -> FuseViews {
    AllViews.task(project).expect("its inputs are there")
}

/// Relative error of a point's distance, the third smallest of all cameras': three photographs
/// agree on each point, and from the others another surface may hide it.
fn error(project: &Project, point: &CloudVertex) -> Option<f64> {
    let from = |camera: usize| errors(project, camera, [point.position].into_iter());
    let mut errors: Vec<f64> = (0..9).flat_map(from).collect();
    errors.sort_by(f64::total_cmp);
    errors.get(2).copied()
}

#[test]
fn the_cloud_of_all_views_lies_on_the_scene() {
    let project = dense();
    let cloud = cloud(&project);
    assert_eq!((cloud.num_maps, cloud.num_registered), (9, 9));
    assert_eq!(cloud.size, (258, 194));
    assert!((cloud.pixel_px - 480.0 / 258.0).abs() < 1e-12);
    assert!(cloud.len() > 12_000 && cloud.density > 0.4, "{cloud:?}");
    let mut off = Vec::new();
    for point in cloud.points(100) {
        assert!(point.num_views >= 3);
        assert!((Vector3::from(point.normal).norm() - 1.0).abs() < 1e-9);
        off.push(error(&project, &point).unwrap_or(f64::INFINITY));
    }
    let (one, five) = (ratio_below(&off, 0.01), ratio_below(&off, 0.05));
    println!("{one} {five} of {}", off.len());
    assert!(one > 0.9 && five > 0.97, "{one} {five} of {}", off.len());
    let num_triangles = cloud.triangles().len();
    assert!(num_triangles > 5_000, "{num_triangles}");
    let vertices = cloud.vertices().step_by(100);
    let off: Vec<f64> = vertices
        .map(|vertex| error(&project, &vertex).unwrap_or(f64::INFINITY))
        .collect();
    let (one, five) = (ratio_below(&off, 0.01), ratio_below(&off, 0.05));
    println!("{num_triangles} triangles, {one} {five} of {}", off.len());
    assert!(one > 0.9 && five > 0.97, "{one} {five} of {}", off.len());
}

#[test]
fn the_cloud_is_saved_shown_measured_and_exported() {
    let mut project = dense();
    let found = cloud(&project);
    let (key, _) = project.all_views().unwrap();
    let ends = [100, 6_000].map(|index| project.anchor_of_cloud(key, index).unwrap());
    let place = |index: u32| Vector3::from(found.point(index).unwrap().position);
    let apart = (place(100) - place(6_000)).norm();
    let measure = Measure {
        ends,
        length_m: Some(2.0),
    };
    let length = project.length_in_units(&measure).unwrap();
    assert!((length.value - apart).abs() < 1e-12);
    assert!(
        length.sigma > 0.0 && length.sigma < 0.05 * apart,
        "{length:?}"
    );
    project.update(Event::Measure(measure));
    let [a, b] = ends;
    let c = project.anchor_of_cloud(key, 3_000).unwrap();
    project.update(Event::Floor(Some([a, b, c])));
    let (scale, floor) = (project.scale().unwrap(), project.floor().unwrap());
    assert!((scale.meters_per_unit * apart - 2.0).abs() < 1e-9);

    let mut read = exported(&project);
    let (ply, notes) = read_ply(&read("fused.ply")).unwrap();
    assert_eq!((ply.points.len(), notes), (found.len(), vec![]));
    assert!((ply.points[100] - ply.points[6_000]).norm() - 2.0 < 1e-4);
    let height = |index: usize| {
        let up = Vector3::from(found.point(index as u32).unwrap().position) - floor.origin.coords;
        up.dot(&floor.up) * scale.meters_per_unit
    };
    for index in [100, 700, 6_000] {
        assert!((ply.points[index].z - height(index)).abs() < 1e-4);
        let point = found.point(index as u32).unwrap();
        let up = Vector3::from(point.normal).dot(&floor.up);
        assert!((ply.normals[index].z - up).abs() < 1e-4);
        assert_eq!(ply.colors[index], point.color);
        assert_eq!(ply.confidences[index], f32::from(point.num_views));
    }
    let (mesh, notes) = read_ply(&read("mesh.ply")).unwrap();
    let num_vertices = found.vertices().len();
    assert_eq!(mesh.points.len(), num_vertices);
    let num_triangles = found.triangles().len();
    assert_eq!(
        notes,
        [format!(
            "{num_triangles} faces are not read: a mesh becomes points"
        )]
    );
    // The vertices follow the points.
    let vertex = found.point((found.len() + 70) as u32).unwrap();
    let up = (Vector3::from(vertex.position) - floor.origin.coords).dot(&floor.up);
    assert!((mesh.points[70].z - up * scale.meters_per_unit).abs() < 1e-4);
    assert_eq!(mesh.colors[70], vertex.color);
    let readme = String::from_utf8(read("README.txt")).unwrap();
    for file in ["fused.ply", "mesh.ply"] {
        assert!(readme.contains(file), "{readme}");
    }

    let mut read = files_for(&project, ExportFormat::Bundler);
    let text = String::from_utf8(read("mesh.obj").unwrap()).unwrap();
    assert_eq!(
        text.lines().filter(|line| line.starts_with("f ")).count(),
        num_triangles
    );
    assert!(text.starts_with("mtllib mesh.mtl\n"));
    let material = String::from_utf8(read("mesh.mtl").unwrap()).unwrap();
    assert!(material.contains("texture.jpg"), "{material}");
    let texture = decode_rgb(&read("texture.jpg").unwrap(), &DecodeOptions::default());
    let texture = texture.unwrap().image;
    let colored = texture
        .pixels()
        .filter(|pixel| pixel.0.iter().any(|level| *level > 40));
    assert!(
        colored.count() * 5 > texture.pixels().len(),
        "{:?}",
        texture.dimensions()
    );
    let mut read = files_for(&project, ExportFormat::Glb);
    let glb = read("mesh.glb").unwrap();
    assert!(String::from_utf8_lossy(&glb[..4096]).contains("image/jpeg"));
    assert!(read("texture.jpg").is_none());
    project.update(Event::Show(Step::Export));
    let words = format!("{} points from all views", found.len());
    assert!(
        project.describe().contains(&words),
        "{}",
        project.describe()
    );

    // A saved project brings it along: only pixels are read.
    let mut again = reopened(&project);
    while let Some(pending) = again.pending().first().copied() {
        let request = pending.request(&again).unwrap();
        assert!(
            matches!(pending.query, epipole_lab::tasks::AnyQuery::Photograph(_)),
            "{pending:?}"
        );
        again.done(&pending, computed(&request.to_bytes()));
    }
    assert!(cloud(&again) == found);
    assert_eq!(again.length_words(0), project.length_words(0));

    // The same once more, to the last byte.
    let once_more = Request::from(request(&project)).to_bytes();
    let once_more = compute(&once_more, &mut |_| ControlFlow::Continue(()));
    assert!(FuseViews::read(&once_more.unwrap()).unwrap() == found);

    // Another resolution has other points; undo brings the former back.
    resize(&mut project, 0.06);
    assert_eq!(project.pending().len(), 9, "to be downscaled anew");
    let gone = |anchor: &Anchor| project.anchored(anchor).is_none();
    assert!([a, b, c].iter().all(gone));
    project.update(Event::Undo);
    assert!(project.pending().is_empty() && project.anchored(&a).is_some());
    project.update(Event::AllViews(false));
    assert!(project.all_views().is_none() && project.anchored(&a).is_none());
}

#[test]
fn a_missing_cloud_has_its_true_cause() {
    let mut project = sample();
    assert!(
        project
            .all_views_words()
            .starts_with("Finds a depth for each pixel")
    );
    project.update(Event::AllViews(true));
    for photo in project.document().photos.clone() {
        assert!(!ReducedOf(photo.id).is_settled(&project));
    }
    while let Some(pending) = project.pending().first().copied() {
        if matches!(pending.query, epipole_lab::tasks::AnyQuery::Cloud(_)) {
            break;
        }
        let request = pending.request(&project).unwrap();
        project.done(&pending, computed(&request.to_bytes()));
    }
    assert!(project.all_views_words().starts_with("Computing"));
    let task = request(&project);

    let mut still = task.clone();
    let first = still.component.cameras[0];
    still.component.cameras.fill(first);
    let why = output(still).unwrap_err();
    assert!(
        why.contains("from nearly the same place, 0.0° apart"),
        "{why}"
    );

    let mut single = task.clone();
    single.component.cameras[1..].fill(None);
    single.photographs[1..].fill(None);
    let why = output(single).unwrap_err();
    assert!(why.contains("at least 2"), "{why}");

    let mut apart = task.clone();
    for point in &mut apart.component.points {
        point.track.truncate(1);
    }
    let why = output(apart).unwrap_err();
    assert!(why.contains("no two of them show the same points"), "{why}");

    let mut blank = task;
    for photo in blank.photographs.iter_mut().flatten() {
        let gray = Blob::from(vec![128; photo.rgb.len()]);
        *photo = Reduced {
            rgb: gray,
            ..photo.clone()
        };
    }
    let why = output(blank).unwrap_err();
    assert!(why.contains("on which 3 photographs agree"), "{why}");

    let pending = project.pending()[0];
    project.done(&pending, Err(why.clone()));
    let words = project.all_views_words();
    assert_eq!(words, format!("No depth of all views: {why}."));
    assert!(project.all_views().is_none());
}
