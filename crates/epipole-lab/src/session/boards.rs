//! Photographs of a board, the calibrated camera, and known poses.

use crate::project::{Blob, KnownPoses, LensCamera, Project, Sample, Settings, Source};

impl Project {
    pub(super) fn add_boards(&mut self, files: Vec<(String, Blob)>) {
        for (name, bytes) in files {
            self.give_board(&name, Source::File(bytes));
        }
    }

    pub(super) fn open_boards(&mut self) {
        self.document.boards.clear();
        let sample = Sample::Board;
        for index in 0..sample.len() {
            self.give_board(&sample.name(index), Source::Rendered(sample, index));
        }
        // The board of the sample is the default one.
        self.document.settings.calibration = Settings::default().calibration;
    }

    fn give_board(&mut self, name: &str, source: Source) {
        let given = self.given(&self.document.boards, name, source);
        self.next_id = given.id;
        self.document.boards.push(given);
    }

    /// Uses a calibrated camera, which replaces typed focal lengths.
    pub(super) fn use_camera(&mut self, camera: Option<LensCamera>) {
        let camera = camera.filter(LensCamera::is_finite);
        if let Some(camera) = &camera {
            let of_its_size: Vec<u32> = self.of_size(camera.size).iter().map(|p| p.id).collect();
            for photo in &mut self.document.photos {
                if of_its_size.contains(&photo.id) {
                    photo.focal_px = None;
                }
            }
        }
        self.document.camera = camera;
    }

    /// Uses known poses, whose cameras replace typed focal lengths.
    pub(super) fn use_poses(&mut self, poses: Option<KnownPoses>) {
        let poses = poses.map(KnownPoses::checked);
        if let Some(poses) = &poses {
            for photo in &mut self.document.photos {
                if poses.image_of(&photo.name).is_some() {
                    photo.focal_px = None;
                }
            }
        }
        self.document.poses = poses;
    }
}
