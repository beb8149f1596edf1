//! Files of cameras: read from other programs, and written for them.

use crate::common::output;
use epipole_lab::project::{Blob, LensCamera, LensModel, Project};
use epipole_lab::session::Event;
use epipole_lab::tasks::{CameraFormat, CamerasRead, PhotoFile, ReadCameras, WriteCamera};

fn photo(size: (u32, u32)) -> PhotoFile {
    PhotoFile {
        name: "photo.jpg".to_owned(),
        size: Some(size),
    }
}

fn read(text: &str, sizes: &[(u32, u32)]) -> Result<LensCamera, String> {
    let read = output(ReadCameras {
        files: vec![("cam.txt".to_owned(), Blob::from(text.as_bytes().to_vec()))],
        photos: sizes.iter().map(|size| photo(*size)).collect(),
    })?;
    match read {
        CamerasRead::Camera(camera) => Ok(camera),
        CamerasRead::Poses(poses) => Err(format!("{} has poses", poses.file)),
    }
}

fn lens_camera(lens: LensModel) -> LensCamera {
    let numbers = [-0.125, 0.03, 0.001, -0.002, 0.01, 0.5, 0.25, 0.125];
    LensCamera {
        size: (640, 480),
        k: [500.5, 501.25, 320.0, 239.5],
        lens,
        coefficients: numbers[..lens.coefficients().len()].to_vec(),
    }
}

#[test]
fn written_cameras_are_read_again() {
    let formats = [
        CameraFormat::OpenCv,
        CameraFormat::Ros,
        CameraFormat::Colmap,
    ];
    for lens in [LensModel::Brown, LensModel::Rational, LensModel::Fisheye] {
        let camera = lens_camera(lens);
        for format in formats {
            let task = WriteCamera {
                camera: camera.clone(),
                format,
            };
            let text = String::from_utf8(output(task).unwrap().to_vec()).unwrap();
            assert_eq!(read(&text, &[]).as_ref(), Ok(&camera), "{format:?}: {text}");
        }
    }
    // OpenCV has no such lens.
    let task = WriteCamera {
        camera: lens_camera(LensModel::Division),
        format: CameraFormat::OpenCv,
    };
    assert!(output(task).is_err());
}

#[test]
fn of_several_cameras_the_size_of_the_photographs_decides() {
    let text = "1 PINHOLE 640 480 500 500 320 240\n2 PINHOLE 300 200 250 250 150 100\n";
    assert_eq!(read(text, &[(200, 300)]).unwrap().size, (300, 200));
    let refused = read(text, &[(1, 1)]).unwrap_err();
    assert_eq!(
        refused,
        "cam.txt: it has 2 cameras, and none has the size of a photograph"
    );
    let refused = read(text, &[]).unwrap_err();
    assert!(refused.contains("add the photographs first"), "{refused}");
    // A file without a size has that of the photographs.
    let text = "camera_matrix: [[500, 0, 320], [0, 500, 240], [0, 0, 1]]\n";
    assert_eq!(read(text, &[(640, 480)]).unwrap().size, (640, 480));
    let refused = read("a shopping list", &[]).unwrap_err();
    assert_eq!(refused, "cam.txt: neither a photograph nor a camera file");
    let refused = read("camera_matrix: 3\n", &[]).unwrap_err();
    assert!(
        refused.starts_with("cam.txt: ") && !refused.contains("neither"),
        "{refused}"
    );
}

#[test]
fn a_camera_is_used_and_given_up() {
    let mut project = Project::default();
    let camera = lens_camera(LensModel::Fisheye);
    project.update(Event::UseCamera(Some(camera.clone())));
    assert_eq!(project.document().camera, Some(camera.clone()));
    assert!(project.use_words().contains("640 × 480 pixels"));
    let mut wrong = camera;
    wrong.k[0] = f64::NAN;
    project.update(Event::UseCamera(Some(wrong)));
    assert_eq!(project.document().camera, None);
    project.update(Event::Undo);
    assert!(project.document().camera.is_some());
}
