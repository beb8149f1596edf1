//! The camera calibrated from photographs of a board: its inputs, the outcome of each photograph,
//! and the photographs that it applies to.

use crate::project::{InputPhoto, Key, Project, Source};
use crate::tasks::{BoardOf, PhotoFile};

/// Outcome for a photograph of a board.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum BoardOutcome {
    /// Not known yet.
    Pending,
    /// Left out by the reader.
    Excluded,
    /// Unreadable, with an error message.
    Unreadable(String),
    /// The board was not found, with the reason.
    NotFound(String),
    /// Its size, and the different size of most others.
    OtherSize((u32, u32), (u32, u32)),
    /// Number of marks found.
    Found(usize),
}

impl Project {
    /// Key of a board's photograph, for texture caches.
    pub fn key_of_board(&self, photo: &InputPhoto) -> Key {
        // Another board has the same pixels.
        Key::of(&("picture of a board", photo.content.0))
    }

    /// Returns the outcome for a photograph of a board.
    pub fn board_outcome(&self, photo: &InputPhoto) -> BoardOutcome {
        if photo.excluded {
            return BoardOutcome::Excluded;
        }
        if let Some(why) = self.failure(BoardOf(photo.id)) {
            return BoardOutcome::Unreadable(why.to_owned());
        }
        let Some(found) = self.get(BoardOf(photo.id)) else {
            return BoardOutcome::Pending;
        };
        if found.marks.is_empty() {
            let mut why = found.problem.clone().unwrap_or_default();
            if let Some((columns, rows)) = found.other_grid {
                why.push_str(&format!(
                    ". Take it again with all of the board in sight; or, if the board has {columns} × {rows} marks, say so"
                ));
            }
            return BoardOutcome::NotFound(why);
        }
        match self.size_of_boards() {
            Some(size) if size != found.picture.full_size => {
                BoardOutcome::OtherSize(found.picture.full_size, size)
            }
            _ => BoardOutcome::Found(found.num_visible()),
        }
    }

    /// Returns the photographs from files, with their sizes as far as they were read.
    pub fn photo_files(&self) -> Vec<PhotoFile> {
        let photos = self.document.photos.iter();
        let files = photos.filter(|photo| matches!(photo.source, Source::File(_)));
        let file = |photo: &InputPhoto| PhotoFile {
            name: photo.name.clone(),
            size: self.shown(photo).map(|pixels| pixels.sensor_size),
        };
        files.map(file).collect()
    }

    /// Returns the photographs from files with this size in the sensor's orientation, as far as
    /// they were read.
    pub fn of_size(&self, size: (u32, u32)) -> Vec<&InputPhoto> {
        let is_file = |photo: &&InputPhoto| matches!(photo.source, Source::File(_));
        let fits = |photo: &&InputPhoto| {
            self.shown(photo)
                .is_some_and(|pixels| pixels.sensor_size == size)
        };
        let photos = self.document.photos.iter();
        photos.filter(is_file).filter(fits).collect()
    }
}
