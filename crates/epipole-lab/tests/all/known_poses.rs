//! Cameras and poses from a model of another program: only points are found.

use crate::common::{exported, files_for, finish, jpeg, output, reopened, solved};
use epipole_lab::project::{Blob, KnownPoses, Outcome, Project, Sample};
use epipole_lab::session::Event;
use epipole_lab::tasks::{
    CameraFound, CamerasRead, ExportFormat, ReadCameras, ReconstructionOfAll,
};

/// Files by their names.
type Files = Vec<(String, Blob)>;

/// The photographs of an exported sample, the first so many.
fn photographs(sample: &Project, count: usize) -> Files {
    let mut file = exported(sample);
    let names = sample.document().photos.iter().take(count);
    names
        .map(|photo| {
            (
                photo.name.clone(),
                file(&format!("images/{}", photo.name)).into(),
            )
        })
        .collect()
}

/// Files of the sample's model.
fn model(sample: &Project, format: ExportFormat, names: &[&str]) -> Files {
    let mut file = files_for(sample, format);
    let content = |name: &str| {
        let colmap = file(&format!("sparse/0/{name}"));
        colmap.or_else(|| file(name)).expect("the file is there")
    };
    let mut content = content;
    (names.iter())
        .map(|name| ((*name).to_owned(), content(name).into()))
        .collect()
}

fn read(files: Files, project: &Project) -> Result<CamerasRead, String> {
    let photos = project.photo_files();
    output(ReadCameras { files, photos })
}

fn poses(files: Files, project: &Project) -> KnownPoses {
    match read(files, project) {
        Ok(CamerasRead::Poses(poses)) => poses,
        other => panic!("no poses: {other:?}"),
    }
}

fn centers(cameras: &[Option<CameraFound>]) -> Vec<nalgebra::Point3<f64>> {
    cameras.iter().flatten().map(CameraFound::center).collect()
}

#[test]
fn points_are_found_where_another_program_put_the_cameras() {
    let sample = solved(Sample::Table);
    let truth = centers(&sample.component().unwrap().cameras);
    let mut project = Project::default();
    project.update(Event::Begin(photographs(&sample, 4)));
    let text = ["cameras.txt", "images.txt"];
    let known = poses(model(&sample, ExportFormat::ColmapText, &text), &project);
    let from_json = model(&sample, ExportFormat::Transforms, &["transforms.json"]);
    assert_eq!(poses(from_json, &project).images.len(), known.images.len());
    project.update(Event::UsePoses(Some(known.clone())));
    assert_eq!(
        project.poses_words(),
        "Cameras of 4 of 4 photographs come from cameras.txt and stay as they are. Only points are found."
    );
    finish(&mut project);
    // Bundler has no sizes: they are those of the photographs, which are read now.
    let mut bundler = model(&sample, ExportFormat::Bundler, &["bundle.out", "list.txt"]);
    bundler[0].0 = "scene.out".to_owned();
    let bundler = poses(bundler, &project);
    for (image, expected) in bundler.images.iter().zip(&known.images).take(4) {
        assert_eq!(image.camera.size, expected.camera.size);
    }
    let component = project.component().expect("points");
    for (found, truth) in centers(&component.cameras).iter().zip(&truth) {
        assert!((found - truth).norm() < 1e-9, "{found} {truth}");
    }
    assert!(component.points.len() > 200, "{}", component.points.len());
    let mean_px = project.get(ReconstructionOfAll).unwrap().mean_error_px[0];
    assert!(mean_px < 1.0, "{mean_px}");
    // The saved project opens with its poses; an export has no program.
    let mut again = reopened(&project);
    assert_eq!(again.document().poses, project.document().poses);
    finish(&mut again);
    assert!(again.component() == Some(component));
    let readme = String::from_utf8(exported(&project)("README.txt")).unwrap();
    assert!(
        readme.contains("epipole sfm photographs/ --poses cameras.txt "),
        "{readme}"
    );
    assert!(
        readme.contains("The unit of length is that of cameras.txt"),
        "{readme}"
    );
    assert!(!readme.contains("reconstruct.rs"), "{readme}");
    // Found anew they stand elsewhere.
    project.update(Event::UsePoses(None));
    assert!(project.component().is_none());
    project.update(Event::Undo);
    assert!(project.component().is_some());
}

#[test]
fn cameras_of_turned_photographs_may_be_the_sensors_or_upright() {
    let sample = solved(Sample::Table);
    let truth = centers(&sample.component().unwrap().cameras);
    let mut project = Project::default();
    let mut files = photographs(&sample, 3);
    for (_, file) in &mut files {
        let upright = image::load_from_memory(&file.0).unwrap().into_rgb8();
        *file = jpeg(&image::imageops::rotate270(&upright), 6);
    }
    project.update(Event::Begin(files));
    let text = ["cameras.txt", "images.txt"];
    let upright = poses(model(&sample, ExportFormat::ColmapText, &text), &project);
    let mut of_sensor = upright.clone();
    for image in &mut of_sensor.images {
        let (width, height) = image.camera.size;
        let [fu, fv, cu, cv] = image.camera.k;
        image.camera.size = (height, width);
        image.camera.k = [fv, fu, cv, f64::from(width) - 1.0 - cu];
        image.pose = image.pose.turned(3);
    }
    let mut found = [upright, of_sensor].map(|known| {
        project.update(Event::UsePoses(Some(known)));
        finish(&mut project);
        let component = project.component().expect("points").clone();
        for (found, truth) in centers(&component.cameras).iter().zip(&truth) {
            assert!((found - truth).norm() < 1e-9, "{found} {truth}");
        }
        component.points.len()
    });
    found.sort_unstable();
    assert!(found[0] > 100 && found[1] - found[0] < 10, "{found:?}");
}

#[test]
fn photographs_without_a_pose_and_wrong_poses_say_so() {
    let sample = solved(Sample::Table);
    let mut project = Project::default();
    let mut files = photographs(&sample, 3);
    files[2].0 = "other.png".to_owned();
    project.update(Event::Begin(files));
    let text = ["cameras.txt", "images.txt"];
    let mut known = poses(model(&sample, ExportFormat::ColmapText, &text), &project);
    project.update(Event::UsePoses(Some(known.clone())));
    finish(&mut project);
    let photo = &project.document().photos[2];
    assert_eq!(project.outcome(photo), Outcome::NoKnownPose);
    assert_eq!(
        project.outcome_words(photo),
        "has no pose in cameras.txt, by its name"
    );
    // Poses that go straight ahead fit a few matches by chance.
    for (n, image) in known.images.iter_mut().enumerate() {
        image.pose.rotation = [0.0, 0.0, 0.0, 1.0];
        image.pose.translation = [0.0, 0.0, -0.1 * n as f64];
    }
    project.update(Event::UsePoses(Some(known.clone())));
    finish(&mut project);
    let words = project.poses_words();
    assert!(words.contains("or world from camera"), "{words}");
    // The same with a camera of another size: then too few are left.
    for image in &mut known.images {
        image.camera.size = (11, 7);
    }
    project.update(Event::UsePoses(Some(known)));
    finish(&mut project);
    let words = project.outcome_words(&project.document().photos[0]);
    assert!(
        words.contains("fewer than two photographs have a pose"),
        "{words}"
    );
}

#[test]
fn files_that_are_no_model_of_these_photographs_are_refused_in_words() {
    let sample = solved(Sample::Table);
    let text = model(
        &sample,
        ExportFormat::ColmapText,
        &["cameras.txt", "images.txt"],
    );
    let empty = Project::default();
    let refused = |files: Files, project: &Project| read(files, project).unwrap_err();
    assert_eq!(
        refused(text.clone(), &empty),
        "cameras.txt: the model has poses of 9 images: add these photographs first"
    );
    let mut others = Project::default();
    let mut files = photographs(&sample, 3);
    for (n, (name, _)) in files.iter_mut().enumerate() {
        *name = format!("else-{n}.png");
    }
    others.update(Event::Begin(files));
    let words = refused(text.clone(), &others);
    assert!(
        words.contains("none of the model's 9 images has the name of a photograph here"),
        "{words}"
    );
    let words = refused(vec![text[1].clone()], &others);
    assert!(
        words.contains("a COLMAP model needs cameras.txt beside images.txt"),
        "{words}"
    );
    let bundler = model(&sample, ExportFormat::Bundler, &["bundle.out", "list.txt"]);
    let words = refused(bundler, &others);
    assert!(
        words.contains("the photographs are still being read"),
        "{words}"
    );
    let two = vec![
        ("a.yml".to_owned(), Blob::from(b"1".to_vec())),
        ("b.yml".to_owned(), Blob::from(b"2".to_vec())),
    ];
    assert_eq!(
        refused(two, &others),
        "a.yml, b.yml: not the files of one model: open one camera file, or the files of one model"
    );
    // Alone, the file of the cameras is a camera file.
    let alone = read(vec![text[0].clone()], &others);
    assert!(matches!(alone, Ok(CamerasRead::Camera(_))), "{alone:?}");
    let mut damaged = text;
    damaged[1].1 = Blob::from(b"1 2 3\n".to_vec());
    assert!(refused(damaged, &others).starts_with("cameras.txt: "));
}
