//! Scale bars, angles, areas, volumes and control points against the scene that was rendered.

use crate::common::truth::{
    MAX_SPREAD_M, TruePoint, control, corners, length, shape, table_points,
};
use crate::common::{exported, finish, reopened, solved};
use epipole_lab::project::{Sample, Shape, ShapeKind, Step};
use epipole_lab::session::{Disagreement, Event, ScaleSource};
use epipole_scenes::Scene;
use nalgebra::{Point3, Vector3};

/// Area of a polygon on the table, by truth.
fn true_area(points: &[TruePoint]) -> f64 {
    let next = points.iter().cycle().skip(1);
    let normals = points
        .iter()
        .zip(next)
        .map(|(a, b)| a.truth.coords.cross(&b.truth.coords));
    0.5 * normals.sum::<Vector3<f64>>().norm()
}

#[test]
fn several_known_lengths_set_the_scale_and_a_wrong_one_is_named() {
    let mut project = solved(Sample::Table);
    let points = table_points(&project);
    assert!(points.len() > 10, "{}", points.len());
    let [a, b, c, d] = corners(&points);
    length(&mut project, &a, &c, 1.0);
    let single = project.scale().unwrap();
    assert_eq!(single.source, ScaleSource::Lengths(1));
    assert_eq!(project.length_in_meters(0).unwrap().sigma, 0.0);
    assert_eq!(project.residual_words(0), None);

    length(&mut project, &b, &d, 1.0);
    assert_eq!(project.disagreement(), None, "{:?}", project.scale_bars());
    length(&mut project, &a, &b, 1.0);
    length(&mut project, &a, &d, 1.0);
    let scale = project.scale().unwrap();
    assert_eq!(scale.source, ScaleSource::Lengths(4));
    assert!(scale.relative_sigma < single.relative_sigma);
    assert_eq!(project.disagreement(), None, "{:?}", project.scale_bars());
    // Against a length that was not typed.
    let step = (b.found - c.found).norm() * scale.meters_per_unit;
    let expected = (b.truth - c.truth).norm();
    assert!((step / expected - 1.0).abs() < 0.005, "{step} {expected}");
    for index in 0..4 {
        let found = project.length_in_meters(index).unwrap();
        let known = project.document().measures[index].length_m.unwrap();
        // The truth of both ends is that of keypoints, with errors of its own.
        let off_m = (found.value - known).abs();
        assert!(
            off_m < 3.0 * found.sigma && off_m < 2.0 * MAX_SPREAD_M,
            "{found:?} {known}"
        );
        assert!(found.sigma > 0.0 && found.sigma < 0.01 * found.value);
        let words = project.residual_words(index).unwrap();
        assert!(words.contains('%') && words.contains(" mm)"), "{words}");
    }
    project.update(Event::Show(Step::Measure));
    let words = project.describe();
    assert!(
        words.starts_with("The scale is set by 4 known lengths."),
        "{words}"
    );

    // 5 % too long.
    let known = project.document().measures[2].length_m.unwrap();
    let own = project.length_in_meters(2).unwrap().value / known;
    project.update(Event::Length(2, Some(1.05 * known)));
    let Some(Disagreement::One(2, off)) = project.disagreement() else {
        panic!("{:?}", project.disagreement());
    };
    assert!((off - (own / 1.05 - 1.0)).abs() < 0.01, "{off} {own}");
    let words = format!("Length 3 disagrees with the others by {:.2}%", -100.0 * off);
    assert!(
        project.describe().contains(&words),
        "{}",
        project.describe()
    );
    project.update(Event::Undo);
    assert_eq!(project.disagreement(), None);
    project.update(Event::Forget(3));
    project.update(Event::Forget(2));
    project.update(Event::Length(1, Some(1.1 * (b.truth - d.truth).norm())));
    let words = project.disagreement_words().unwrap();
    assert!(words.starts_with("Lengths 1 and 2 disagree by "), "{words}");
}

#[test]
fn angles_and_areas_are_those_of_the_scene() {
    let mut project = solved(Sample::Table);
    let points = table_points(&project);
    let four = corners(&points);
    let [a, b, c, _] = four;
    project.update(Event::MeasureShape(shape(ShapeKind::Angle, &[a, b, c])));
    let angle = project.shape_value(&project.document().shapes[0]).unwrap();
    let expected = (a.truth - b.truth).angle(&(c.truth - b.truth)).to_degrees();
    let off = (angle.value - expected).abs();
    assert!(off < 3.0 * angle.sigma && off < 1.5, "{angle:?} {expected}");
    assert!(angle.sigma > 0.0 && angle.sigma < 0.5, "{angle:?}");

    project.update(Event::MeasureShape(shape(ShapeKind::Area, &four)));
    assert!(
        project.shape_words(1).contains("square units"),
        "{}",
        project.shape_words(1)
    );
    length(&mut project, &a, &c, 1.0);
    let area = project.shape_value(&project.document().shapes[1]).unwrap();
    let expected = true_area(&four);
    assert!(
        (area.value / expected - 1.0).abs() < 0.01,
        "{area:?} {expected}"
    );
    assert!(
        area.sigma > 0.0 && area.sigma < 0.02 * area.value,
        "{area:?}"
    );
    assert!(area.deviation.unwrap() < 0.005, "{area:?}");
    let words = project.shape_words(1);
    assert!(
        words.contains(" m², points within ") && words.contains(" ± "),
        "{words}"
    );
    // A known angle and a known length are independent of each other.
    assert_eq!(
        project.shape_value(&project.document().shapes[0]).unwrap(),
        angle
    );

    // Corners in a wrong order, repeated ones, and too few.
    project.update(Event::MeasureShape(shape(
        ShapeKind::Area,
        &[a, c, b, four[3]],
    )));
    assert!(
        project.shape_words(2).contains("sides cross"),
        "{}",
        project.shape_words(2)
    );
    project.update(Event::ForgetShape(2));
    for bad in [&[a, b][..], &[a, b, a]] {
        project.update(Event::MeasureShape(shape(ShapeKind::Area, bad)));
        project.update(Event::MeasureShape(shape(ShapeKind::Angle, bad)));
    }
    assert_eq!(project.document().shapes.len(), 2);
    project.update(Event::MeasureShape(shape(ShapeKind::Volume, &four)));
    let words = project.shape_words(2);
    assert!(
        words.contains("compute \"Depth of all views\" first"),
        "{words}"
    );
    project.update(Event::Undo);
    project.update(Event::Undo);
    assert_eq!(
        project.document().shapes.len(),
        3,
        "the removed one is back"
    );
    let mut again = reopened(&project);
    finish(&mut again);
    assert_eq!(again.document().shapes.len(), 3);
    assert_eq!(again.shape_words(1), project.shape_words(1));
    let photo = a.anchor.photo;
    project.update(Event::Remove(photo));
    let has = |shape: &Shape| shape.points.iter().any(|point| point.photo == photo);
    assert!(!project.document().shapes.iter().any(has));
}

/// Volume over the table within a polygon, from its true heights.
fn true_volume(points: &[TruePoint]) -> f64 {
    let scene = Scene::still_life();
    let (low, high) = ([-0.6, -0.6], [0.8, 0.8]);
    let (count, mut sum) = (350, 0.0);
    let step = [0, 1].map(|axis| (high[axis] - low[axis]) / f64::from(count));
    for n in 0..count * count {
        let at = [n % count, n / count].map(f64::from);
        let [x, z] = [0, 1].map(|axis| low[axis] + (at[axis] + 0.5) * step[axis]);
        let next = points.iter().cycle().skip(1);
        let crossings = points.iter().zip(next).filter(|(a, b)| {
            let (a, b) = (a.truth, b.truth);
            (a.z > z) != (b.z > z) && x < a.x + (z - a.z) / (b.z - a.z) * (b.x - a.x)
        });
        if crossings.count() % 2 == 1 {
            let hit = scene.cast(&Point3::new(x, -1.0, z), &Vector3::y());
            sum += hit.map_or(0.0, |hit| -hit.point.y);
        }
    }
    sum * step[0] * step[1]
}

#[test]
fn a_volume_over_the_table_is_that_of_what_is_on_it() {
    let mut project = solved(Sample::Table);
    let points = table_points(&project);
    let four = corners(&points);
    let [a, b, c, _] = four;
    length(&mut project, &a, &c, 1.0);
    let mut settings = project.document().settings.clone();
    settings.all_views.max_megapixels = 0.05;
    project.update(Event::Set(settings));
    project.update(Event::AllViews(true));
    finish(&mut project);
    project.update(Event::MeasureShape(shape(
        ShapeKind::VolumeOverFloor,
        &four,
    )));
    assert_eq!(project.shape_words(0), "the floor is not set");
    project.update(Event::Floor(Some([a, b, c].map(|point| point.anchor))));
    project.update(Event::MeasureShape(shape(ShapeKind::Volume, &four)));
    let expected = true_volume(&four);
    for index in 0..2 {
        let found = project
            .shape_value(&project.document().shapes[index])
            .unwrap();
        let words = project.shape_words(index);
        println!("{found:?} {expected} {words}");
        let coverage = found.coverage.unwrap();
        assert!(coverage > 0.5 && coverage < 1.02, "{found:?}");
        // Of what the surface covers.
        assert!(
            (found.value / coverage / expected - 1.0).abs() < 0.2,
            "{found:?} {expected}"
        );
        assert!(
            found.sigma > 0.0 && found.sigma < 0.2 * found.value,
            "{found:?}"
        );
        assert!(
            words.contains(" m³") && words.contains("% of the outline"),
            "{words}"
        );
    }
}

#[test]
fn control_points_place_the_model_and_a_wrong_one_is_named() {
    let mut project = solved(Sample::Table);
    let points = table_points(&project);
    let four = corners(&points);
    control(&four[..2], &mut project);
    project.update(Event::Show(Step::Measure));
    assert!(project.alignment().is_none());
    assert!(
        project
            .describe()
            .contains("2 of 3 control points have coordinates")
    );
    let mut project = solved(Sample::Table);
    control(&four, &mut project);
    let alignment = project.alignment().unwrap();
    assert!(alignment.rms_m() < 0.003, "{}", alignment.rms_m());
    assert_eq!(project.bad_control(), None);
    assert_eq!(project.scale().unwrap().source, ScaleSource::ControlPoints);

    // Cameras of the files are where the photographs were rendered from.
    let mut read = exported(&project);
    let json: serde_json::Value = serde_json::from_slice(&read("reconstruction.json")).unwrap();
    let component = project.component().unwrap();
    for (index, camera) in component.cameras.iter().enumerate() {
        let found = alignment.control_from_world * camera.as_ref().unwrap().center();
        let camera = crate::common::depth::true_camera(index);
        let truth = camera.center_in_world();
        assert!((found - truth).norm() < 0.02, "{index}: {found} {truth}");
        let motion = &json["images"][index]["cam_from_world"];
        let numbers: Vec<f64> = serde_json::from_value(motion["translation"].clone()).unwrap();
        let moved = alignment.control_from_world.isometry.rotation;
        let there = component.cameras[index].as_ref().unwrap();
        let [i, j, k, w] = there.rotation;
        let rotation =
            nalgebra::UnitQuaternion::new_normalize(nalgebra::Quaternion::new(w, i, j, k))
                * moved.inverse();
        let expected = -(rotation * found.coords);
        let off = (Vector3::from_vec(numbers) - expected).norm();
        assert!(off < 1e-9, "{off}");
    }
    let table = String::from_utf8(read("measures.csv")).unwrap();
    assert_eq!(table.lines().count(), 5, "{table}");
    let readme = String::from_utf8(read("README.txt")).unwrap();
    assert!(readme.contains("those of the control points"), "{readme}");
    assert_eq!(json["control_points"].as_array().unwrap().len(), 4);

    let mut again = reopened(&project);
    finish(&mut again);
    assert_eq!(again.control_words(1), project.control_words(1));
    // With four points, one that is 20 cm off is told from the three others.
    let mut wrong: [f64; 3] = four[2].truth.coords.into();
    wrong[1] += 0.2;
    project.update(Event::Show(Step::Measure));
    project.update(Event::ChangeControl(2, "stake".to_owned(), Some(wrong)));
    let (index, off) = project.bad_control().unwrap();
    assert_eq!(index, 2);
    assert!((off - 0.2).abs() < 0.03, "{off}");
    assert!(
        project.describe().contains("stake is "),
        "{}",
        project.describe()
    );
    project.update(Event::Undo);
    assert_eq!(project.bad_control(), None);
    project.update(Event::ChangeControl(0, "line\nbreak".to_owned(), None));
    project.update(Event::ChangeControl(
        0,
        String::new(),
        Some([f64::NAN, 0.0, 0.0]),
    ));
    assert_eq!(project.document().control_points[0].name, "T0");
    project.update(Event::ForgetControl(0));
    project.update(Event::ForgetControl(7));
    assert_eq!(project.document().control_points.len(), 3);
}
