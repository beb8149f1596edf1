//! The camera calibrated from photographs of a board: its inputs, the outcome of each photograph,
//! and the photographs that it applies to.

use super::Project;
use super::document::{Given, Settings};
use super::keys::Key;
use super::wanted::About;
use crate::tasks::{Blob, BoardFound, Calibration, Request, Sample, Source};
use std::rc::Rc;

/// Outcome for a photograph of a board.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum BoardFate {
    /// It is not known yet.
    Open,
    /// The reader left it out.
    Excluded,
    /// It cannot be read.
    Unreadable(String),
    /// The board was not found, and why.
    NotFound(String),
    /// It is of this size, and most others are of another one.
    OtherSize((u32, u32), (u32, u32)),
    /// Number of marks found.
    Found(usize),
}

impl Project {
    pub(super) fn board_key(&self, photo: &Given) -> Key {
        let options = self.document.settings.calibration.board;
        Key::of(&("board", photo.content.0, options))
    }

    /// Key of a board's image, for caches.
    pub fn key_of_board(&self, photo: &Given) -> Key {
        // Another board is looked for in the same pixels.
        Key::of(&("picture of a board", photo.content.0))
    }

    /// The board found in a photograph, if it has been searched.
    pub fn board(&self, photo: &Given) -> Option<&Rc<BoardFound>> {
        self.results.board(self.board_key(photo))
    }

    /// The photographs of a board that take part.
    pub fn boards_taking_part(&self) -> Vec<&Given> {
        let readable = |photo: &&Given| self.failure(self.board_key(photo)).is_none();
        let boards = self.document.boards.iter();
        boards
            .filter(|photo| !photo.excluded)
            .filter(readable)
            .collect()
    }

    /// Width and height that most photographs have in which the board was found; the first of those
    /// with as many.
    pub fn size_of_boards(&self) -> Option<(u32, u32)> {
        let found =
            |photo: &&Given| Some(self.board(photo)?).filter(|found| !found.marks.is_empty());
        let sizes: Vec<(u32, u32)> = (self.boards_taking_part().iter())
            .filter_map(found)
            .map(|found| found.picture.full_size)
            .collect();
        let count = |size: &(u32, u32)| sizes.iter().filter(|other| *other == size).count();
        // The last of equals is the first of the list.
        sizes.iter().rev().max_by_key(|size| count(size)).copied()
    }

    /// The marks of each photograph that takes part, none where the board was not found or the size
    /// is another one; `None` until all were looked through.
    fn views(&self) -> Option<Vec<&[Option<[f64; 2]>]>> {
        let size = self.size_of_boards();
        let marks = |photo: &&Given| {
            let found = self.board(photo)?;
            let fits = Some(found.picture.full_size) == size;
            Some(if fits { &found.marks[..] } else { &[] })
        };
        self.boards_taking_part().iter().map(marks).collect()
    }

    /// The name of the calibration; `None` until all photographs were looked through, and for less
    /// than two boards.
    pub(super) fn calibration_key(&self) -> Option<Key> {
        let views = self.views()?;
        if views.iter().filter(|marks| !marks.is_empty()).count() < 2 {
            return None;
        }
        let boards = self.boards_taking_part();
        let keys: Vec<u64> = boards.iter().map(|photo| self.board_key(photo).0).collect();
        let options = self.document.settings.calibration;
        Some(Key::of(&("calibration", keys, options)))
    }

    /// The camera that the boards give, if it is there.
    pub fn calibration(&self) -> Option<&Rc<Calibration>> {
        self.results.calibration(self.calibration_key()?)
    }

    /// Why they give none, if it is known.
    pub fn calibration_failure(&self) -> Option<&str> {
        self.failure(self.calibration_key()?)
    }

    /// The place of a photograph among those of the calibration.
    pub fn place_of_board(&self, photo: &Given) -> Option<usize> {
        let boards = self.boards_taking_part();
        boards.iter().position(|other| other.id == photo.id)
    }

    /// Outcome for a photograph of a board.
    pub fn board_fate(&self, photo: &Given) -> BoardFate {
        if photo.excluded {
            return BoardFate::Excluded;
        }
        if let Some(why) = self.failure(self.board_key(photo)) {
            return BoardFate::Unreadable(why.to_owned());
        }
        let Some(found) = self.board(photo) else {
            return BoardFate::Open;
        };
        if found.marks.is_empty() {
            let mut why = found.problem.clone().unwrap_or_default();
            if let Some((columns, rows)) = found.other_grid {
                why.push_str(&format!(
                    ". Take it again with all of the board in sight; or, if the board has {columns} × {rows} marks, say so"
                ));
            }
            return BoardFate::NotFound(why);
        }
        match self.size_of_boards() {
            Some(size) if size != found.picture.full_size => {
                BoardFate::OtherSize(found.picture.full_size, size)
            }
            _ => BoardFate::Found(found.num_seen()),
        }
    }

    pub(super) fn wanted_of_boards(&self) -> Vec<(Key, About)> {
        let boards = self.document.boards.iter().filter(|photo| !photo.excluded);
        let search = |photo: &Given| (self.board_key(photo), About::Board(photo.id));
        let solve = self.calibration_key().map(|key| (key, About::Calibration));
        boards.map(search).chain(solve).collect()
    }

    pub(super) fn calibration_request(&self) -> Option<Request> {
        Some(Request::Calibration {
            options: self.document.settings.calibration,
            size: self.size_of_boards()?,
            views: (self.views()?.into_iter()).map(<[_]>::to_vec).collect(),
        })
    }

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
        let Some(camera) = self.calibration().map(|found| found.camera.clone()) else {
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

    /// The files among the photographs that have this size as the sensor gave them, as far as they
    /// were read.
    pub fn of_size(&self, size: (u32, u32)) -> Vec<&Given> {
        let is_file = |photo: &&Given| matches!(photo.source, Source::File(_));
        let fits = |photo: &&Given| {
            self.shown(photo)
                .is_some_and(|pixels| pixels.sensor_size == size)
        };
        let photos = self.document.photos.iter();
        photos.filter(is_file).filter(fits).collect()
    }
}
