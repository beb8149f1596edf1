//! Photographs of a board: adding them, and using the camera that they give.

use crate::project::{Blob, Project, Sample, Settings, Source};
use crate::tasks::CalibrationOfBoards;
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
        // Its board is that of the beginning.
        self.document.settings.calibration = Settings::default().calibration;
    }

    fn give_board(&mut self, name: &str, source: Source) {
        let given = self.given(&self.document.boards, name, source);
        self.next_id = given.id;
        self.document.boards.push(given);
    }

    /// Takes the camera that the boards give, if there is one. Focal lengths that were typed make
    /// room for it.
    pub(super) fn use_calibration(&mut self, is_used: bool) {
        if !is_used {
            self.document.camera = None;
            return;
        }
        let Some(camera) = self
            .get(CalibrationOfBoards)
            .map(|found| found.camera.clone())
        else {
            return;
        };
        let of_its_size: Vec<u32> = self.of_size(camera.size).iter().map(|p| p.id).collect();
        for photo in &mut self.document.photos {
            if of_its_size.contains(&photo.id) {
                photo.focal_px = None;
            }
        }
        self.document.camera = Some(camera);
    }
}
