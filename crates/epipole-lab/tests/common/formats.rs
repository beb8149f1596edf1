//! Formats of the export for other programs.

use crate::common::files_for;
use epipole_io::model::read_model_folder;
use epipole_io::trajectory::{TrajectoryFormat, read_trajectory};
use epipole_lab::project::Project;
use epipole_lab::tasks::{ExportFormat, ReconstructionOfAll};
use std::cell::RefCell;

/// Each format holds the cameras and points, beside a page and photographs by their names.
pub(crate) fn every_format_can_be_read_again(project: &Project) {
    let component = &project.get(ReconstructionOfAll).unwrap().components[0];
    for format in ExportFormat::ALL {
        let files = RefCell::new(files_for(project, format));
        let file = |name: &str| (files.borrow_mut())(name);
        let page = String::from_utf8(file("model.html").unwrap()).unwrap();
        let count = component.points.len();
        assert!(page.contains(&format!("9 images, {count} points</title>")));
        let (kind, path) = read_trajectory(&file("trajectory.txt").unwrap()).unwrap();
        assert_eq!(kind, TrajectoryFormat::Kitti);
        assert_eq!(path.world_from_cam.len(), 9);
        let readme = String::from_utf8(file("README.txt").unwrap()).unwrap();
        assert!(
            readme.contains(&format!("\n{:<20} ", format.place())),
            "{readme}"
        );
        if format == ExportFormat::Glb {
            assert!(file("model.glb").unwrap().starts_with(b"glTF"));
            continue;
        }
        let folder = match format.place() {
            "sparse/0/" => "sparse/0/",
            _ => "",
        };
        let beside = |name: &str| match folder {
            "" if name == "points.ply" => None,
            _ => file(&format!("{folder}{name}")),
        };
        let model = read_model_folder(&beside).unwrap().unwrap().model;
        assert_eq!(
            (model.images.len(), model.points.len()),
            (9, count),
            "{format:?}"
        );
        for image in &model.images {
            let inside = if folder.is_empty() { "" } else { "images/" };
            assert!(
                file(&format!("{inside}{}", image.name)).is_some(),
                "{}",
                image.name
            );
        }
    }
}
