//! The whole line, from photographs to files, on the sample; and that it is the core's own.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

mod common;

use common::depth::every_pixel_has_its_depth;
use common::growing::it_grows_as_one_watches;
use common::{answer, finish, reopened, solved};
use epipole::camera::Intrinsics;
use epipole::sfm::{Photo, PhotoOptions, SfmOptions, reconstruct_photos};
use epipole_lab::project::{Event, Fate, Measure, Project, RefineFocal, Step};
use epipole_lab::tasks::{Answer, Blob, FeatureKind, Sample, Source};
use image::RgbImage;
use std::io::{Cursor, Read};
use std::ops::ControlFlow;

/// Distance of the middle of two neighboring places around the table, meters: an arc of 8° at 1.38 m, and
/// 0.13 m up.
fn true_step_m() -> f64 {
    let chord = 2.0 * 1.38 * libm::sin(4.0_f64.to_radians());
    (chord * chord + 0.13 * 0.13).sqrt()
}

#[test]
fn the_sample_is_solved_as_the_core_solves_it() {
    let mut project = solved(Sample::Table);
    let found = project.reconstruction().unwrap();
    assert_eq!(found.components.len(), 1);
    let component = &found.components[0];
    assert_eq!(component.num_registered(), 9);
    assert!(component.points.len() > 800, "{}", component.points.len());
    assert!(found.mean_error_px[0] < 0.6, "{}", found.mean_error_px[0]);

    // Against the truth: neighbors are equally far from each other.
    let centers: Vec<_> = (component.cameras.iter())
        .map(|camera| camera.as_ref().unwrap().center())
        .collect();
    let steps: Vec<f64> = centers
        .windows(2)
        .map(|two| (two[1] - two[0]).norm())
        .collect();
    let mean = steps.iter().sum::<f64>() / 8.0;
    for step in &steps {
        assert!((step / mean - 1.0).abs() < 0.01, "{steps:?}");
    }

    // Bit for bit what the core makes of the same photographs in one go.
    let mut photos = Vec::new();
    let mut intrinsics = Vec::new();
    for given in &project.document().photos {
        let pixels = project.photograph(given).unwrap();
        let image = RgbImage::from_raw(pixels.width, pixels.height, pixels.rgb.to_vec()).unwrap();
        photos.push(Photo {
            name: given.name.clone(),
            image,
            ..Photo::default()
        });
        let focal_px = pixels.focal_px.unwrap();
        intrinsics.push(Intrinsics::centered(focal_px, pixels.width, pixels.height).unwrap());
    }
    let mut how = PhotoOptions::default();
    how.features.max_features = 8192;
    let options = SfmOptions::default();
    let go_on = &mut |_: &_| ControlFlow::Continue(());
    let (_, direct) = reconstruct_photos(&photos, &intrinsics, &how, &options, go_on).unwrap();
    assert_eq!(direct.components.len(), 1);
    let places = |points: &[epipole::sfm::ScenePoint]| -> Vec<[f64; 3]> {
        points.iter().map(|p| p.position.coords.into()).collect()
    };
    let ours: Vec<[f64; 3]> = component.points.iter().map(|p| p.position).collect();
    assert_eq!(ours, places(&direct.components[0].points));

    a_known_length_sets_the_scale(&mut project);
    three_points_set_the_floor(&mut project);
    the_files_can_be_read_again(&project);
    every_pixel_has_its_depth(&mut project);
    it_grows_as_one_watches(&mut project);
    knobs_recompute_what_follows_and_undo_is_instant(&mut project);
    parts_that_nothing_joins_are_told(&mut project);
}

/// The same reconstruction with its last three photographs in a part of their own.
fn parts_that_nothing_joins_are_told(project: &mut Project) {
    let mut found = (**project.reconstruction().unwrap()).clone();
    let mut second = found.components[0].clone();
    for image in 0..9 {
        match image {
            0..6 => second.cameras[image] = None,
            _ => found.components[0].cameras[image] = None,
        }
    }
    found.components.push(second);
    found.mean_error_px.push(found.mean_error_px[0]);
    let key = project.key_of_reconstruction().unwrap();
    project.done(key, Ok(Answer::Reconstruction(found).to_bytes()));
    let (each, all) = sentences(project);
    let of_part = |each: &[String], part: &str| -> usize {
        let words = format!("belongs to part {part}, which nothing joins");
        each.iter()
            .filter(|sentence| sentence.contains(&words))
            .count()
    };
    assert_eq!(of_part(&each, "2"), 3, "{each:?}");
    assert!(
        all.contains("6 of 9") && all.contains("part 1 of 2"),
        "{all}"
    );
    project.update(Event::LookAtComponent(1));
    let (each, _) = sentences(project);
    assert_eq!(of_part(&each, "1"), 6, "{each:?}");
}

/// One length is typed; others come out right within a percent.
fn a_known_length_sets_the_scale(project: &mut Project) {
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

/// Three points of the table's top make it the floor: cameras are as high above it as they were put.
fn three_points_set_the_floor(project: &mut Project) {
    let component = project.component().unwrap().clone();
    let center = |n: usize| component.cameras[n].as_ref().unwrap().center();
    let meters = true_step_m() / (center(1) - center(0)).norm();
    // Which points are on the table is known from where the photographs were rendered: by height below the cameras, in
    // the direction that is down in all of them.
    let truth: Vec<_> = (0..9).map(common::depth::true_camera).collect();
    let scene = epipole::synthetic::Scene::still_life();
    let on_table = |point: usize| {
        let (image, keypoint) = component.points[point].track[0];
        let photo = &project.document().photos[image as usize];
        let feature = &project.features(photo).unwrap().list[keypoint as usize];
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
    assert!(project.height_in_units(three[0]).unwrap().abs() < 1e-9);
    let words = project.height_words(table[5].0);
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

fn the_files_can_be_read_again(project: &Project) {
    let Ok(Answer::Archive(bytes)) = answer(&project.export_request().unwrap()) else {
        panic!("the export is no archive");
    };
    let mut archive = zip::ZipArchive::new(Cursor::new(&bytes[..])).unwrap();
    let mut read = |name: &str| {
        let mut content = Vec::new();
        archive
            .by_name(name)
            .unwrap()
            .read_to_end(&mut content)
            .unwrap();
        content
    };
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    let points = project.component().unwrap().points.len();
    let lines = |text: &str| text.lines().filter(|line| !line.starts_with('#')).count();
    assert_eq!(lines(&text(read("sparse/0/points3D.txt"))), points);
    assert_eq!(lines(&text(read("sparse/0/cameras.txt"))), 1);
    let images = text(read("sparse/0/images.txt"));
    assert_eq!(lines(&images), 18);
    for line in images
        .lines()
        .filter(|line| !line.starts_with('#'))
        .step_by(2)
    {
        let name = line.rsplit(' ').next().unwrap();
        let picture = image::load_from_memory(&read(&format!("images/{name}"))).unwrap();
        assert_eq!((picture.width(), picture.height()), (480, 360));
    }
    let ply = read("points.ply");
    assert!(ply.starts_with(b"ply\n"));
    let json: serde_json::Value = serde_json::from_slice(&read("reconstruction.json")).unwrap();
    assert_eq!(json["num_registered"], 9);
    assert_eq!(json["num_points"], points);
    assert_eq!(json["images"].as_array().unwrap().len(), 9);
    assert!(json["meters_per_unit"].as_f64().unwrap() > 0.0);
    let readme = text(read("README.txt"));
    assert!(
        readme.contains("epipole sfm images/ --focal-px 600"),
        "{readme}"
    );
    assert!(readme.contains("Lengths are in meters"), "{readme}");
}

fn knobs_recompute_what_follows_and_undo_is_instant(project: &mut Project) {
    let mut settings = project.document().settings.clone();
    settings.sfm.refine_distortion = true;
    project.update(Event::Set(settings.clone()));
    assert_eq!(
        finish(project),
        1,
        "nothing before the reconstruction changed"
    );
    settings.pairs.seed = 5;
    project.update(Event::Set(settings.clone()));
    assert_eq!(finish(project), 36, "pairs, and nothing else");
    settings.matching.ratio = 0.7;
    project.update(Event::Set(settings));
    assert_eq!(finish(project), 36 + 36 + 1);
    the_command_says_every_knob(project);
    for _ in 0..3 {
        project.update(Event::Undo);
        assert!(project.wanted().is_empty());
    }
    let third = project.document().photos[2].id;
    project.update(Event::Exclude(third, true));
    assert_eq!(finish(project), 1, "eight photographs, all matched before");
    assert_eq!(project.component().unwrap().num_registered(), 8);
    assert_eq!(project.fate(&project.document().photos[2]), Fate::Excluded);
    project.update(Event::Undo);
    assert!(project.wanted().is_empty());
    assert_eq!(project.component().unwrap().num_registered(), 9);
}

fn the_command_says_every_knob(project: &mut Project) {
    let mut settings = project.document().settings.clone();
    assert_eq!(settings.matching.ratio, 0.7);
    settings.features.kind = FeatureKind::Sift;
    settings.features.contrast = 0.013;
    settings.matching.mutual = false;
    settings.sfm.min_num_inliers = 20;
    settings.refine_focal = RefineFocal::Always;
    project.update(Event::Set(settings));
    assert_eq!(
        project.recipe().unwrap().command,
        "epipole sfm images/ --focal-px 600 --max-features 8192 --features sift --contrast-threshold 0.013 --ratio 0.7 \
         --mutual=false --min-inliers 20 --refine-focal --refine-distortion --seed 0 -o sparse/0"
    );
    // Another order, and one that is left out, are said, too.
    let photos = &project.document().photos;
    let (second, last) = (photos[1].id, photos[8].id);
    project.update(Event::Earlier(second));
    project.update(Event::Exclude(last, true));
    project.update(Event::Focal(second, Some(601.5)));
    let command = project.recipe().unwrap().command;
    assert!(
        command.starts_with(
            "epipole sfm images/table-2.png images/table-1.png images/table-3.png images/table-4.png images/table-5.png \
             images/table-6.png images/table-7.png images/table-8.png --focals-px=601.5,600,600,600,600,600,600,600 "
        ),
        "{command}"
    );
    for _ in 0..4 {
        project.update(Event::Undo);
    }
}

#[test]
fn a_saved_project_comes_back() {
    let mut project = Project::default();
    project.update(Event::OpenSample(Sample::Alone));
    let file = png(40, 30);
    project.update(Event::Add(vec![("my photo.png".to_owned(), file.clone())]));
    let mut settings = project.document().settings.clone();
    settings.refine_focal = RefineFocal::Never;
    settings.matching.ratio = 0.7;
    project.update(Event::Set(settings));
    let id = project.document().photos[1].id;
    project.update(Event::Focal(id, Some(55.0)));
    project.update(Event::Exclude(id, true));

    let again = reopened(&project);
    assert_eq!(again.document().settings, project.document().settings);
    let same = |project: &Project| -> Vec<(String, Source, bool, Option<f64>)> {
        let photos = project.document().photos.iter();
        photos
            .map(|p| (p.name.clone(), p.source.clone(), p.excluded, p.focal_px))
            .collect()
    };
    assert_eq!(same(&again), same(&project));
    assert_eq!(again.document().photos[1].source, Source::File(file));
}

fn png(width: u32, height: u32) -> Blob {
    let image = RgbImage::from_fn(width, height, |u, v| {
        image::Rgb([(u * 7 % 256) as u8, (v * 9 % 256) as u8, 90])
    });
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
    bytes.into_inner().into()
}

/// The beginning of a PNG file of so many pixels.
fn promise(width: u32, height: u32) -> Vec<u8> {
    let mut head = b"IHDR".to_vec();
    head.extend(width.to_be_bytes());
    head.extend(height.to_be_bytes());
    head.extend([8, 0, 0, 0, 0]);
    let mut check = !0_u32;
    for byte in &head {
        check ^= u32::from(*byte);
        for _ in 0..8 {
            check = (check >> 1) ^ if check & 1 == 1 { 0xEDB8_8320 } else { 0 };
        }
    }
    let mut bytes = b"\x89PNG\r\n\x1a\n\0\0\0\x0D".to_vec();
    bytes.extend(head);
    bytes.extend((!check).to_be_bytes());
    // Data of no length: what was promised does not come.
    bytes.extend(b"\0\0\0\0IDAT\x35\xAF\x06\x1E");
    bytes
}

/// The sentence of every photograph, and that of the step "Reconstruction".
fn sentences(project: &mut Project) -> (Vec<String>, String) {
    project.update(Event::Show(Step::Reconstruction));
    let photos = &project.document().photos;
    let words = photos
        .iter()
        .map(|photo| project.fate_words(photo))
        .collect();
    (words, project.describe())
}

#[test]
fn a_camera_that_only_turned_is_told_so() {
    let mut project = solved(Sample::Turned);
    let (each, all) = sentences(&mut project);
    assert!(
        each.iter().all(|words| words.contains("only turned")),
        "{each:?}"
    );
    assert!(all.contains("only turned"), "{all}");
}

#[test]
fn a_turn_is_told_by_a_wrong_focal_length_too_with_the_right_one() {
    for typed_px in [480.0, 1000.0] {
        let mut project = Project::default();
        project.update(Event::OpenSample(Sample::Turned));
        let photos = project.document().photos.iter();
        let ids: Vec<_> = photos.map(|photo| photo.id).collect();
        for id in &ids {
            project.update(Event::Focal(*id, Some(typed_px)));
        }
        finish(&mut project);
        let (each, all) = sentences(&mut project);
        assert!(
            each.iter().all(|words| words.contains("only turned")),
            "{each:?}"
        );
        // Small turns look alike by any focal length; that between the first and the last photograph does not.
        for photo in [0, 3].map(|n| &project.document().photos[n]) {
            let Fate::OnlyTurned(Some(focal_px)) = project.fate(photo) else {
                panic!("{typed_px}: {each:?}");
            };
            // The camera of the sample has 600 px.
            assert!((570..=630).contains(&focal_px), "{typed_px}: {focal_px}");
            let words = format!("if its focal length is near {focal_px} px");
            assert!(project.fate_words(photo).contains(&words), "{each:?}");
        }
        assert!(all.contains("only turned"), "{all}");
        project.update(Event::Show(Step::TwoViews));
        project.update(Event::LookAtPair(ids[0], ids[3]));
        let pair = project.describe();
        let words = format!("px, not {typed_px} px, the camera only turned, by 15.");
        assert!(pair.contains(&words), "{pair}");
    }
}

#[test]
fn a_plane_is_told_so() {
    let mut project = solved(Sample::Plane);
    let (each, all) = sentences(&mut project);
    assert!(
        all.contains("4 of 4 photographs have a camera"),
        "{all} {each:?}"
    );
    assert!(all.contains("Every pair shows a plane"), "{all} {each:?}");
    assert!(all.contains("Type it, calibrate"), "{all}");
    project.update(Event::Show(Step::TwoViews));
    let pair = project.describe();
    assert!(pair.contains("A plane, seen from two places: H"), "{pair}");
}

#[test]
fn two_places_in_one_heap_are_told_apart() {
    let mut project = solved(Sample::Mixed);
    let (each, all) = sentences(&mut project);
    assert!(
        all.contains("3 of 6") && all.contains("part 1 of 2: nothing joins the parts"),
        "{all}"
    );
    let of_other = |words: &String| words.contains("belongs to part 2, which nothing joins");
    assert_eq!(
        each.iter().filter(|words| of_other(words)).count(),
        3,
        "{each:?}"
    );
    // Each part holds the photographs of one place.
    let components = &project.reconstruction().unwrap().components;
    for component in components {
        let places: Vec<bool> = component.cameras.iter().map(Option::is_some).collect();
        assert!(places[..3].iter().all(|is| *is == places[0]), "{places:?}");
        assert!(places[3..].iter().all(|is| *is != places[0]), "{places:?}");
    }
}

#[test]
fn some_upright_and_some_not_go_together_and_that_is_told() {
    let mut project = solved(Sample::Upright);
    let (each, all) = sentences(&mut project);
    assert!(
        all.contains("5 of 5 photographs have a camera"),
        "{all} {each:?}"
    );
    project.update(Event::Show(Step::Photographs));
    let words = project.describe();
    assert!(
        words.contains("2 are upright and 3 are landscape"),
        "{words}"
    );
    // On the arc around the table neighbors are equally far from each other, however the camera was held.
    let component = project.component().unwrap();
    let centers: Vec<_> = (component.cameras.iter())
        .map(|camera| camera.as_ref().unwrap().center())
        .collect();
    let steps: Vec<f64> = centers
        .windows(2)
        .map(|two| (two[1] - two[0]).norm())
        .collect();
    for step in &steps {
        assert!((step / steps[0] - 1.0).abs() < 0.02, "{steps:?}");
    }
}

#[test]
fn one_alone_and_one_twice_are_told_so() {
    let mut alone = solved(Sample::Alone);
    let (each, all) = sentences(&mut alone);
    assert!(each[0].starts_with("alone"), "{each:?}");
    assert!(all.contains("alone"), "{all}");
    let mut twice = solved(Sample::Twice);
    let (each, _) = sentences(&mut twice);
    assert!(each[0].starts_with("alone"), "{each:?}");
    assert!(each[1].contains("the same file as twice-1.png"), "{each:?}");
}

#[test]
fn a_file_that_is_none_leaves_the_others_alone() {
    let mut project = Project::default();
    project.update(Event::Add(vec![
        (
            "broken.jpg".to_owned(),
            vec![0xFF, 0xD8, 0xFF, 0, 1, 2].into(),
        ),
        ("flat.png".to_owned(), png(64, 48)),
        ("flat.png".to_owned(), png(65, 48)),
    ]));
    finish(&mut project);
    // A file that promises more pixels than anybody has memory for.
    let huge = promise(100_000, 90_000);
    project.update(Event::Add(vec![("huge.png".to_owned(), huge.into())]));
    finish(&mut project);
    let words = project.fate_words(&project.document().photos[3]);
    assert!(
        words.starts_with("cannot be read") && words.contains("9000000000"),
        "{words}"
    );
    let (each, all) = sentences(&mut project);
    assert!(each[0].starts_with("cannot be read"), "{each:?}");
    assert!(each[1].contains("features, which is too few"), "{each:?}");
    assert!(all.contains("broken.jpg: cannot be read"), "{all}");
    assert_eq!(project.document().photos[2].name, "flat-2.png");
}
