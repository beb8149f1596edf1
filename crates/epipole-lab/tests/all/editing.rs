//! The box and deletions leave points out of what is shown, measured and exported, and compute
//! nothing again.

#![cfg(feature = "compute")]

use crate::common::{exported, files_for, finish, reopened, solved};
use epipole_io::cloud::read_ply;
use epipole_lab::project::{CropBox, Measure, Project, Sample};
use epipole_lab::session::{Event, Layers, Pending};
use epipole_lab::tasks::{
    AnyQuery, ExportFormat, PointFound, Query, Reconstruct, ReconstructionOfAll, Task,
};
use nalgebra::{Point3, Quaternion, UnitQuaternion, Vector3};

fn points(project: &Project) -> Vec<PointFound> {
    project.component().unwrap().points.clone()
}

/// Coordinates in the frame of a box, by quaternions.
fn in_box(crop: &CropBox, place: [f64; 3]) -> [f64; 3] {
    let [i, j, k, w] = crop.rotation;
    let rotation = UnitQuaternion::new_normalize(Quaternion::new(w, i, j, k));
    (rotation * (Vector3::from(place) - Vector3::from(crop.origin))).into()
}

fn is_in(crop: &CropBox, place: [f64; 3]) -> bool {
    let at = in_box(crop, place);
    (0..3).all(|axis| crop.low[axis] <= at[axis] && at[axis] <= crop.high[axis])
}

/// The box of the model without half of its first side.
fn half(project: &Project) -> CropBox {
    let mut crop = project.fitted_crop().unwrap();
    crop.high[0] = 0.5 * (crop.low[0] + crop.high[0]);
    crop
}

#[test]
fn a_fitted_box_has_the_model_without_a_far_outlier() {
    let mut project = solved(Sample::Table);
    let mut found = project.get(ReconstructionOfAll).unwrap().clone();
    let far = PointFound {
        position: [900.0, -700.0, 5000.0],
        ..found.components[0].points[0].clone()
    };
    found.components[0].points.push(far.clone());
    let key = ReconstructionOfAll.key(&project).unwrap();
    let query = AnyQuery::Reconstruction(ReconstructionOfAll);
    project.done(&Pending { key, query }, Ok(Reconstruct::write(&found)));
    let crop = project.fitted_crop().unwrap();
    let all = points(&project);
    let num_in = all
        .iter()
        .filter(|point| is_in(&crop, point.position))
        .count();
    assert!(num_in > all.len() * 9 / 10, "{num_in} of {}", all.len());
    assert!(!is_in(&crop, far.position));
    // No side is farther out than needed: each has a point near.
    for axis in 0..3 {
        let along = all.iter().filter(|point| is_in(&crop, point.position));
        let along: Vec<f64> = along
            .map(|point| in_box(&crop, point.position)[axis])
            .collect();
        let low = along.iter().copied().fold(f64::INFINITY, f64::min);
        let high = along.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let slack = 0.05 * (crop.high[axis] - crop.low[axis]);
        assert!(low - crop.low[axis] < slack && crop.high[axis] - high < slack);
    }
}

#[test]
fn a_box_stands_on_the_floor() {
    let mut project = solved(Sample::Table);
    let anchors = [0, 40, 90].map(|point| project.anchor_of(point).unwrap());
    project.update(Event::Floor(Some(anchors)));
    let floor = project.floor().unwrap();
    let crop = project.fitted_crop().unwrap();
    assert_eq!(Point3::from(crop.origin), floor.origin);
    let above = floor.origin + floor.up;
    let at = in_box(&crop, above.coords.into());
    assert!(
        at[0].abs() < 1e-9 && at[1].abs() < 1e-9 && (at[2] - 1.0).abs() < 1e-9,
        "{at:?}"
    );
}

#[test]
fn a_box_limits_the_files_and_undo_removes_it() {
    let mut project = solved(Sample::Table);
    let crop = half(&project);
    let all = points(&project);
    let inside: Vec<&PointFound> = all.iter().filter(|p| is_in(&crop, p.position)).collect();
    assert!((all.len() / 10..all.len() * 9 / 10).contains(&inside.len()));
    project.update(Event::Crop(Some(crop)));
    assert!(project.pending().is_empty(), "nothing is computed again");
    let mut read = exported(&project);
    let (ply, _) = read_ply(&read("points.ply")).unwrap();
    assert_eq!(ply.points.len(), inside.len());
    for (found, expected) in ply.points.iter().zip(&inside) {
        assert!((found - Point3::from(expected.position)).norm() < 1e-5);
    }
    let json: serde_json::Value = serde_json::from_slice(&read("reconstruction.json")).unwrap();
    assert_eq!(json["num_points"], inside.len());
    assert_eq!(json["num_registered"], 9);
    let whole = project.get(ReconstructionOfAll).unwrap().mean_error_px[0];
    let mean = json["mean_reprojection_px"].as_f64().unwrap();
    assert!(
        mean > 0.5 * whole && mean < 2.0 * whole && mean != whole,
        "{mean} {whole}"
    );
    let readme = String::from_utf8(read("README.txt")).unwrap();
    assert!(readme.contains("outside the box"), "{readme}");

    // Measures across the sides of the box are no longer in the files; the scale stays.
    let place = |is_inside: bool| {
        all.iter()
            .position(|p| is_in(&crop, p.position) == is_inside)
    };
    let [inner, outer] = [true, false].map(|is_inside| place(is_inside).unwrap());
    let ends = [inner, outer].map(|point| project.anchor_of(point).unwrap());
    project.update(Event::Measure(Measure {
        ends,
        length_m: Some(3.0),
    }));
    assert!(project.scale().is_some());
    assert_eq!(ends.map(|end| project.is_remaining(&end)), [true, false]);
    let export = project.export_request(ExportFormat::ColmapText).unwrap();
    assert!(export.measures.is_empty() && export.meters_per_unit.is_some());

    let mut again = reopened(&project);
    finish(&mut again);
    assert_eq!(again.crop(), Some(&crop));
    project.update(Event::Undo);
    project.update(Event::Undo);
    assert_eq!(
        (project.crop(), project.edit_words()),
        (None, String::new())
    );
    let export = project.export_request(ExportFormat::ColmapText).unwrap();
    assert_eq!(export.found.components[0].points, all);
}

#[test]
fn an_impossible_box_is_refused() {
    let mut project = solved(Sample::Table);
    let crop = project.fitted_crop().unwrap();
    for wrong in [
        CropBox {
            low: crop.high,
            ..crop
        },
        CropBox {
            low: [f64::NAN; 3],
            ..crop
        },
        CropBox {
            rotation: [1.0, 2.0, 0.0, 0.0],
            ..crop
        },
    ] {
        project.update(Event::Crop(Some(wrong)));
        assert_eq!(project.document().crop, None);
    }
    // One of another reconstruction has no effect.
    project.update(Event::Crop(Some(CropBox {
        of: crop.of + 1,
        ..crop
    })));
    assert!(project.document().crop.is_some() && project.crop().is_none());
    assert!(project.remaining().is_all());
}

#[test]
fn deleted_points_are_left_out_and_come_back() {
    let mut project = solved(Sample::Table);
    let all = points(&project);
    let bad = |point: &PointFound| point.track.len() < 3 || point.error_px > 0.7;
    let selected = project.select_sparse(bad);
    let num_bad = all.iter().filter(|point| bad(point)).count();
    assert!(num_bad > 10 && num_bad < all.len());
    assert_eq!(project.num_in(&selected), num_bad);
    project.update(Event::Delete(selected.clone()));
    assert!(project.pending().is_empty(), "nothing is computed again");
    let num_kept = |project: &Project| {
        let kept = project.remaining();
        points(project)
            .iter()
            .filter(|point| kept.has_point(point))
            .count()
    };
    assert_eq!(num_kept(&project), all.len() - num_bad);
    assert!(
        project.select_sparse(bad).is_empty(),
        "they cannot be selected again"
    );
    let mut read = exported(&project);
    let (ply, _) = read_ply(&read("points.ply")).unwrap();
    assert_eq!(ply.points.len(), all.len() - num_bad);
    let text = String::from_utf8(read("sparse/0/points3D.txt")).unwrap();
    let rows = text.lines().filter(|line| !line.starts_with('#')).count();
    assert_eq!(rows, all.len() - num_bad);
    let mut again = reopened(&project);
    finish(&mut again);
    assert_eq!(num_kept(&again), all.len() - num_bad);

    // The photographs of the file have other numbers, but the same order.
    let deleted = &again.document().deleted;
    assert_eq!(deleted.keypoints.len(), selected.keypoints.len());

    // In a reconstruction without the last photograph the others still are deleted.
    let last = project.document().photos[8].id;
    project.update(Event::Exclude(last, true));
    finish(&mut project);
    let (kept, now) = (num_kept(&project), points(&project).len());
    assert!(kept < now && kept > now / 3, "{kept} of {now}");
    let words = project.change_words().unwrap();
    let expected = format!("9 to 8 registered, {} to {now} points", all.len());
    assert!(words.contains(&expected), "{words}");
    project.update(Event::Undo);
    let words = project.change_words().unwrap();
    assert!(words.contains("8 to 9 registered"), "{words}");

    project.update(Event::Undo);
    assert_eq!(num_kept(&project), all.len());
    project.update(Event::Redo);
    project.update(Event::Restore);
    assert_eq!(num_kept(&project), all.len());
    project.update(Event::OpenSample(Sample::Plane));
    finish(&mut project);
    assert_eq!(
        project.change_words(),
        None,
        "other photographs have no change"
    );
}

#[test]
fn dense_points_and_triangles_are_left_out() {
    let mut project = solved(Sample::Table);
    let mut settings = project.document().settings.clone();
    settings.all_views.max_megapixels = 0.05;
    project.update(Event::Set(settings));
    project.update(Event::AllViews(true));
    finish(&mut project);
    let (key, cloud) = project.all_views().unwrap();
    let cloud = cloud.clone();
    let crop = half(&project);
    project.update(Event::Crop(Some(crop)));
    let [points, surface] = Layers::ALL;
    // A slab across the box is deleted, of points and of the surface.
    let middle = 0.5 * (crop.low[1] + crop.high[1]);
    let slab = move |place: [f64; 3]| in_box(&crop, place)[1] > middle;
    let selected = [points, surface].map(|layers| project.select(layers, slab));
    project.update(Event::Delete(selected[0].with(&selected[1])));
    assert!(project.pending().is_empty(), "nothing is computed again");
    let stays = |place: [f64; 3]| is_in(&crop, place) && !slab(place);
    let num_points = cloud
        .points(1)
        .filter(|point| stays(point.position))
        .count();
    assert!(
        num_points > 500 && num_points < cloud.len() / 2,
        "{num_points}"
    );
    let vertices: Vec<bool> = cloud
        .vertices()
        .map(|vertex| stays(vertex.position))
        .collect();
    let is_whole = |corners: &[u32; 3]| corners.iter().all(|n| vertices[*n as usize]);
    let num_triangles = cloud.triangles().filter(is_whole).count();
    assert!(num_triangles > 100);

    let mut read = exported(&project);
    let (ply, _) = read_ply(&read("fused.ply")).unwrap();
    assert_eq!(ply.points.len(), num_points);
    assert!(ply.points.iter().all(|point| {
        let at = in_box(&crop, point.coords.into());
        at[1] < middle + 1e-5 && at[0] < crop.high[0] + 1e-5
    }));
    let (mesh, notes) = read_ply(&read("mesh.ply")).unwrap();
    assert_eq!(
        mesh.points.len(),
        vertices.iter().filter(|stays| **stays).count()
    );
    let words = format!("{num_triangles} faces are not read: a mesh becomes points");
    assert_eq!(notes, [words]);
    // The texture needs what photographs see in common, also outside the box.
    let mut read = files_for(&project, ExportFormat::Glb);
    assert!(read("mesh.glb").is_some());

    // Outside the box, everything that is not deleted is selected.
    let outside = project.select_outside();
    let sparse = project.component().unwrap().points.iter();
    let places = sparse.map(|point| point.position);
    let places = places.chain(cloud.points(1).map(|point| point.position));
    let places = places.chain(cloud.vertices().map(|vertex| vertex.position));
    let expected = places.filter(|place| !is_in(&crop, *place)).count();
    assert_eq!(project.num_in(&outside), expected);
    // Another cloud has other points.
    let mut settings = project.document().settings.clone();
    settings.all_views.max_megapixels = 0.06;
    project.update(Event::Set(settings));
    finish(&mut project);
    let (other, _) = project.all_views().unwrap();
    assert!(other != key && project.document().deleted.points_of(other.0).is_none());
    project.update(Event::Undo);
    assert_eq!(project.all_views().unwrap().0, key);
    assert!(project.document().deleted.points_of(key.0).is_some());
}

#[test]
fn pixels_of_a_pair_are_left_out() {
    let mut project = solved(Sample::Table);
    let ids: Vec<u32> = project
        .document()
        .photos
        .iter()
        .map(|photo| photo.id)
        .collect();
    project.update(Event::Dense(ids[3], ids[4], true));
    project.update(Event::Show(epipole_lab::project::Step::Depth));
    project.update(Event::LookAtPair(ids[3], ids[4]));
    finish(&mut project);
    let pair = project.dense_pairs()[0].3.clone();
    let crop = half(&project);
    project.update(Event::Crop(Some(crop)));
    let inside = pair
        .points(1)
        .filter(|(place, _)| is_in(&crop, *place))
        .count();
    assert!(inside > 1000 && inside < pair.points(1).count());
    let mut read = exported(&project);
    let (ply, _) = read_ply(&read("dense.ply")).unwrap();
    assert_eq!(ply.points.len(), inside);
    let depths = epipole_io::disparity::read_pfm(&read("depth/table-4_table-5.pfm")).unwrap();
    let mut num_deep = 0;
    for (index, place) in pair.places(1) {
        let (u, v) = (index % pair.width, index / pair.width);
        let depth = depths.get(u, v);
        assert_eq!(
            depth.is_some_and(f32::is_finite),
            is_in(&crop, place),
            "{u} {v}"
        );
        num_deep += usize::from(is_in(&crop, place));
    }
    assert_eq!(num_deep, inside);
}
