//! Lengths and heights of the sample, against where its cameras were put.

use super::depth::true_camera;
use super::reopened;
use epipole_lab::project::{Measure, Project, Step};
use epipole_lab::session::Event;
use epipole_lab::tasks::FeaturesOf;

/// Distance of the middle of two neighboring places around the table, meters: an arc of 8° at 1.38
/// m, and 0.13 m up.
fn true_step_m() -> f64 {
    let chord = 2.0 * 1.38 * libm::sin(4.0_f64.to_radians());
    (chord * chord + 0.13 * 0.13).sqrt()
}

/// One length is typed; others come out right within a percent.
pub(crate) fn a_known_length_sets_the_scale(project: &mut Project) {
    let component = project.component().unwrap().clone();
    let centers: Vec<_> = (component.cameras.iter())
        .map(|camera| camera.as_ref().unwrap().center())
        .collect();
    let meters = true_step_m() / (centers[1] - centers[0]).norm();
    // Points that many photographs see, far from each other.
    let mut seen: Vec<usize> = (0..component.points.len()).collect();
    seen.sort_by_key(|&point| std::cmp::Reverse(component.points[point].track.len()));
    let place = |point: usize| nalgebra::Vector3::from(component.points[point].position);
    let far_from = |point: usize| {
        let most = seen.iter().take(200).copied();
        most.max_by(|&a, &b| {
            let far = |other: usize| (place(other) - place(point)).norm();
            far(a).total_cmp(&far(b))
        })
        .unwrap()
    };
    let (a, b) = (seen[0], far_from(seen[0]));
    let (c, d) = (far_from(b), seen[1]);
    let ends = |a, b| [project.anchor_of(a).unwrap(), project.anchor_of(b).unwrap()];
    let (first, second) = (ends(a, b), ends(c, d));
    let true_m = |a, b| (place(a) - place(b)).norm() * meters;
    project.update(Event::Show(Step::Measure));
    project.update(Event::Measure(Measure {
        ends: first,
        length_m: None,
    }));
    assert!(project.scale().is_none());
    assert!(
        project.describe().contains("not set"),
        "{}",
        project.describe()
    );
    project.update(Event::Length(0, Some(true_m(a, b))));
    project.update(Event::Measure(Measure {
        ends: second,
        length_m: None,
    }));
    let length = project.length_in_meters(1).unwrap();
    assert!((length.value / true_m(c, d) - 1.0).abs() < 1e-9);
    assert!(
        length.sigma > 0.0 && length.sigma < 0.05 * length.value,
        "{length:?}"
    );
    assert_eq!(project.length_in_meters(0).unwrap().sigma, 0.0);
    // The steps of the camera, which nobody typed, in meters.
    let scale = project.scale().unwrap().meters_per_unit;
    for two in centers.windows(2) {
        let step = (two[1] - two[0]).norm() * scale;
        assert!((step / true_step_m() - 1.0).abs() < 0.01, "{step}");
    }
}

/// Three points of the table's top make it the floor: cameras are as high above it as they were
/// put.
pub(crate) fn three_points_set_the_floor(project: &mut Project) {
    let component = project.component().unwrap().clone();
    let center = |n: usize| component.cameras[n].as_ref().unwrap().center();
    let meters = true_step_m() / (center(1) - center(0)).norm();
    // Which points are on the table is known from where the photographs were rendered: by height
    // below the cameras, in the direction that is down in all of them.
    let truth: Vec<_> = (0..9).map(true_camera).collect();
    let scene = epipole_scenes::Scene::still_life();
    let on_table = |point: usize| {
        let (image, keypoint) = component.points[point].track[0];
        let photo = &project.document().photos[image as usize];
        let feature = &project.get(FeaturesOf(photo.id)).unwrap().list[keypoint as usize];
        let camera = &truth[image as usize];
        let pixel = nalgebra::Point2::new(feature.u, feature.v);
        let from = camera.cam_from_world.inverse() * nalgebra::Point3::origin();
        let hit = scene.cast(&from, &camera.ray_in_world(&pixel))?;
        (hit.point.y.abs() < 0.002).then_some(hit.point)
    };
    let mut table: Vec<(usize, nalgebra::Point3<f64>)> = (0..component.points.len())
        .filter(|point| {
            component.points[*point].track.len() >= 4 && component.points[*point].error_px < 0.5
        })
        .filter_map(|point| Some((point, on_table(point)?)))
        .collect();
    assert!(table.len() > 30, "{}", table.len());
    table.sort_by(|a, b| a.1.x.total_cmp(&b.1.x));
    let far = |list: &[(usize, nalgebra::Point3<f64>)]| {
        list.iter()
            .max_by(|a, b| a.1.z.total_cmp(&b.1.z))
            .unwrap()
            .0
    };
    let three = [
        table[0].0,
        table[table.len() - 1].0,
        far(&table[table.len() / 3..2 * table.len() / 3]),
    ];
    let anchors = three.map(|point| project.anchor_of(point).unwrap());
    project.update(Event::Floor(Some([anchors[0], anchors[0], anchors[1]])));
    assert_eq!(project.document().floor, None, "three points are three");
    project.update(Event::Floor(Some(anchors)));
    project.update(Event::Show(Step::Measure));
    let words = project.describe();
    assert!(words.contains("The floor is set"), "{words}");
    let floor = project.floor().unwrap();
    for (n, height_m) in [(0, 0.43), (1, 0.56), (8, 0.43)] {
        let found = (center(n) - floor.origin).dot(&floor.up) * meters;
        assert!(
            (found / height_m - 1.0).abs() < 0.05,
            "{n}: {found} {height_m}"
        );
    }
    assert!(project.height_in_units(&anchors[0]).unwrap().abs() < 1e-9);
    let words = project.height_words(&project.anchor_of(table[5].0).unwrap());
    assert!(words.ends_with("m above the floor"), "{words}");
    let again = reopened(project);
    assert_eq!(
        again.document().floor.unwrap().map(|end| end.keypoint),
        anchors.map(|end| end.keypoint)
    );
    project.update(Event::Undo);
    assert!(project.floor().is_none());
    project.update(Event::Show(Step::Reconstruction));
}
