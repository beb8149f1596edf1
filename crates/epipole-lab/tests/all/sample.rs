//! The whole line, from photographs to files, on the sample; and that it is the core's own.

use crate::common::depth::every_pixel_has_its_depth;
use crate::common::formats::every_format_can_be_read_again;
use crate::common::growing::it_grows_as_one_watches;
use crate::common::measured::{a_known_length_sets_the_scale, three_points_set_the_floor};
use crate::common::{exported, finish, sentences, solved, steps_between};
use epipole::camera::{Camera, Intrinsics};
use epipole::sfm::{Photo, PhotoOptions, SfmOptions, reconstruct_photos};
use epipole_lab::project::{FeatureKind, Outcome, Project, RefineFocal, Sample};
use epipole_lab::session::{Event, Pending};
use epipole_lab::tasks::{AnyQuery, Query, Reconstruct, ReconstructionOfAll, Task};
use image::RgbImage;

#[test]
fn the_sample_is_solved_as_the_core_solves_it() {
    let mut project = solved(Sample::Table);
    let found = project.get(ReconstructionOfAll).unwrap();
    assert_eq!(found.components.len(), 1);
    let component = &found.components[0];
    assert_eq!(component.num_registered(), 9);
    assert!(component.points.len() > 800, "{}", component.points.len());
    assert!(found.mean_error_px[0] < 0.6, "{}", found.mean_error_px[0]);

    // Against the truth: neighbors are equally far from each other.
    let steps = steps_between(&component.cameras);
    let mean = steps.iter().sum::<f64>() / 8.0;
    for step in &steps {
        assert!((step / mean - 1.0).abs() < 0.01, "{steps:?}");
    }

    // Bit for bit what the core makes of the same photographs in one go.
    let mut photos = Vec::new();
    let mut cameras = Vec::new();
    for given in &project.document().photos {
        let pixels = project.photograph(given).unwrap();
        let image = RgbImage::from_raw(pixels.width, pixels.height, pixels.rgb.to_vec()).unwrap();
        photos.push(Photo {
            name: given.name.clone(),
            image,
            ..Photo::default()
        });
        let focal_px = pixels.focal_px.unwrap();
        let k = Intrinsics::centered(focal_px, pixels.width, pixels.height).unwrap();
        cameras.push(Camera::pinhole(k, pixels.width, pixels.height));
    }
    let mut how = PhotoOptions::default();
    how.features.max_features = 8192;
    let options = SfmOptions::default();
    let (_, direct) = reconstruct_photos(&photos, &cameras, &how, &options, &mut ()).unwrap();
    assert_eq!(direct.components.len(), 1);
    let places = |points: &[epipole::sfm::ScenePoint]| -> Vec<[f64; 3]> {
        points.iter().map(|p| p.position.coords.into()).collect()
    };
    let ours: Vec<[f64; 3]> = component.points.iter().map(|p| p.position).collect();
    assert_eq!(ours, places(&direct.components[0].points));

    a_known_length_sets_the_scale(&mut project);
    three_points_set_the_floor(&mut project);
    the_files_can_be_read_again(&project);
    every_format_can_be_read_again(&project);
    every_pixel_has_its_depth(&mut project);
    it_grows_as_one_watches(&mut project);
    knobs_recompute_what_follows_and_undo_is_instant(&mut project);
    parts_that_nothing_joins_are_told(&mut project);
}

/// The same reconstruction with its last three photographs in a part of their own.
fn parts_that_nothing_joins_are_told(project: &mut Project) {
    let mut found = project.get(ReconstructionOfAll).unwrap().clone();
    let mut second = found.components[0].clone();
    for image in 0..9 {
        match image {
            0..6 => second.cameras[image] = None,
            _ => found.components[0].cameras[image] = None,
        }
    }
    found.components.push(second);
    found.mean_error_px.push(found.mean_error_px[0]);
    let key = ReconstructionOfAll.key(project).unwrap();
    let query = AnyQuery::Reconstruction(ReconstructionOfAll);
    project.done(&Pending { key, query }, Ok(Reconstruct::write(&found)));
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

fn the_files_can_be_read_again(project: &Project) {
    let mut read = exported(project);
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
        assert!(project.pending().is_empty());
    }
    let third = project.document().photos[2].id;
    project.update(Event::Exclude(third, true));
    assert_eq!(finish(project), 1, "eight photographs, all matched before");
    assert_eq!(project.component().unwrap().num_registered(), 8);
    assert_eq!(
        project.outcome(&project.document().photos[2]),
        Outcome::Excluded
    );
    project.update(Event::Undo);
    assert!(project.pending().is_empty());
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
    project.update(Event::Focal(vec![second], Some(601.5)));
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
