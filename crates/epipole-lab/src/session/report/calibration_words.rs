//! Text about boards and the calibrated camera, and the camera as a file and a command for
//! calibration elsewhere.

use super::boards::BoardOutcome;
use super::words::count;
use crate::project::{BoardPattern, InputPhoto, LensCamera, Project, Source};
use crate::tasks::{Calibration, CalibrationOfBoards};

impl Project {
    /// Describes the outcome for a photograph of a board, with advice.
    pub fn board_words(&self, photo: &InputPhoto) -> String {
        match self.board_outcome(photo) {
            BoardOutcome::Pending => "being processed".to_owned(),
            BoardOutcome::Excluded => "left out by you".to_owned(),
            BoardOutcome::Unreadable(why) => format!("cannot be read: {why}"),
            BoardOutcome::NotFound(why) => why,
            BoardOutcome::OtherSize((width, height), (most_width, most_height)) => format!(
                "{width} × {height} pixels, the others {most_width} × {most_height}. A camera is calibrated for one size: \
                 take it again at the size of the others, or remove it"
            ),
            BoardOutcome::Found(marks) => match self.view_of(photo) {
                Some(rms_px) => format!("{marks} marks, error {rms_px:.2} px"),
                None => format!("{marks} marks"),
            },
        }
    }

    /// Returns the root mean square error in a photograph, pixels.
    pub fn view_of(&self, photo: &InputPhoto) -> Option<f64> {
        let place = self.place_of_board(photo)?;
        let views = &self.get(CalibrationOfBoards)?.views;
        Some((*views.get(place)?)?.rms_px)
    }

    pub(super) fn calibrate_words(&self) -> String {
        let mut words = self.calibrate_status();
        if let Some(found) = self.get(CalibrationOfBoards) {
            words.push_str(&self.camera_words(found));
        }
        words.push_str(&self.use_words());
        for photo in &self.document.boards {
            if !matches!(
                self.board_outcome(photo),
                BoardOutcome::Found(_) | BoardOutcome::Pending
            ) {
                words.push_str(&format!(" {}: {}.", photo.name, self.board_words(photo)));
            }
        }
        words
    }

    /// Describes the state of the calibration, with advice if it fails.
    pub fn calibrate_status(&self) -> String {
        let boards = &self.document.boards;
        if boards.is_empty() {
            return "No photographs of a board yet. Print a chessboard, mount it on something flat, and take ten to twenty \
                    photographs of it, tilted by 30° to 45° about different axes, some near the edges of the image. Or \
                    open the sample."
                .to_owned();
        }
        let outcomes: Vec<_> = boards
            .iter()
            .map(|photo| self.board_outcome(photo))
            .collect();
        let all = count(boards.len(), "photograph");
        let num_open = outcomes
            .iter()
            .filter(|outcome| **outcome == BoardOutcome::Pending)
            .count();
        if num_open > 0 {
            let looked = boards.len() - num_open;
            return format!("Looking for the board: {looked} of {all} searched.");
        }
        let is_found = |outcome: &&BoardOutcome| matches!(outcome, BoardOutcome::Found(_));
        let num_found = outcomes.iter().filter(is_found).count();
        let mut words = format!("The board was found in {num_found} of {all}.");
        match self.failure(CalibrationOfBoards) {
            Some(why) => words.push_str(&format!(" Calibration failed: {why}.")),
            None if num_found < 2 => words.push_str(
                " Calibration needs at least two, better ten to twenty: tilt the board by 30° to 45° about different axes in \
                 between.",
            ),
            None if self.get(CalibrationOfBoards).is_none() => words.push_str(" Fitting the camera."),
            None => {}
        }
        words
    }

    fn camera_words(&self, found: &Calibration) -> String {
        let [fu, fv, ..] = found.camera.k;
        let [su, sv, ..] = found.std_dev_k;
        let mut words = format!(
            " Focal lengths {fu:.1} ± {su:.1} and {fv:.1} ± {sv:.1} px, error {:.2} px; the boards cover {:.0}% of the \
             image.",
            found.rms_px,
            100.0 * found.coverage
        );
        for warning in self.calibration_warnings() {
            words.push_str(&format!(" {warning}."));
        }
        words
    }

    /// Lists reasons why the camera is less accurate than the errors suggest, as sentences without
    /// a period.
    pub fn calibration_warnings(&self) -> Vec<String> {
        let Some(found) = self.get(CalibrationOfBoards) else {
            return Vec::new();
        };
        let boards = self.boards_taking_part();
        let sentence = |(place, words): &(Option<u32>, String)| {
            let photo = place.and_then(|place| boards.get(place as usize));
            match photo {
                Some(photo) => format!("{}: {words}", photo.name),
                None => {
                    let mut letters = words.chars();
                    let first = letters.next().map(|c| c.to_uppercase().to_string());
                    first.unwrap_or_default() + letters.as_str()
                }
            }
        };
        found.warnings.iter().map(sentence).collect()
    }

    /// Describes which photographs the camera is used for; empty if it is not used.
    pub fn use_words(&self) -> String {
        let Some(camera) = &self.document.camera else {
            return String::new();
        };
        let (width, height) = camera.size;
        let is_file = |photo: &&InputPhoto| matches!(photo.source, Source::File(_));
        let num_files = self.document.photos.iter().filter(is_file).count();
        let of_it = self.of_size(camera.size).len();
        let newer = match self.get(CalibrationOfBoards) {
            Some(found) if found.camera != *camera => {
                " The boards now give another camera: press the button again to use it."
            }
            _ => "",
        };
        match num_files {
            0 => format!(
                " The camera is used for photographs of {width} × {height} pixels. There are none yet.{newer}"
            ),
            _ if of_it == 0 => format!(
                " The camera was calibrated at {width} × {height} pixels, and none of your photographs has that size: \
                 calibrate at theirs.{}{newer}",
                self.upright_words()
            ),
            _ => format!(
                " The camera is used for {of_it} of {}, and their lens distortion is removed.{}{newer}",
                count(num_files, "photograph"),
                self.upright_words()
            ),
        }
    }

    /// Describes the photographs that would have the calibrated camera's size in the other
    /// orientation.
    fn upright_words(&self) -> String {
        let photos = self.document.photos.iter();
        let silent = photos
            .filter(|photo| self.is_of_unknown_turn(photo))
            .count();
        match silent {
            0 => String::new(),
            1 => " It is not used for 1 photograph in the other orientation, since its file does not say which way it was turned.".to_owned(),
            _ => format!(
                " It is not used for {silent} photographs in the other orientation, since their files do not say which way they were turned."
            ),
        }
    }

    fn is_of_unknown_turn(&self, photo: &InputPhoto) -> bool {
        let (Some(camera), Some(pixels)) = (&self.document.camera, self.shown(photo)) else {
            return false;
        };
        let (width, height) = camera.size;
        let is_file = matches!(photo.source, Source::File(_));
        is_file && width != height && pixels.sensor_size == (height, width)
    }

    /// Explains why the calibrated camera is not used for a photograph; empty if it is, or if there
    /// is none.
    pub fn unused_camera_words(&self, photo: &InputPhoto) -> String {
        if self.known_image(photo).is_some() {
            return String::new();
        }
        let (Some(camera), Some(pixels)) = (&self.document.camera, self.shown(photo)) else {
            return String::new();
        };
        if pixels.k.is_some() {
            return String::new();
        }
        let (width, height) = camera.size;
        let why = match self.is_of_unknown_turn(photo) {
            true => {
                "and this file is in the other orientation without saying which way it was turned, "
            }
            false => "",
        };
        format!(
            "The calibrated camera is for {width} × {height} pixels, {why}so it is not used here."
        )
    }

    /// Returns the camera as written by `epipole calibrate -o` and read by `epipole undistort`;
    /// `None` without one.
    pub fn camera_json(&self) -> Option<String> {
        let found = self.get(CalibrationOfBoards)?;
        let std_dev = [&found.std_dev_k[..], &found.std_dev_lens].concat();
        Some(format!(
            "{{\n{},\n  \"rms_px\": {},\n  \"std_dev\": {},\n  \"coverage\": {}\n}}\n",
            camera_fields(&found.camera),
            found.rms_px,
            listed(&std_dev),
            found.coverage
        ))
    }

    /// Returns the equivalent command of `epipole calibrate`.
    pub fn calibrate_command(&self) -> String {
        let options = self.document.settings.calibration;
        let pattern = match options.board.pattern {
            BoardPattern::Chessboard => "",
            BoardPattern::Circles => " --kind asymmetric-circles",
        };
        format!(
            "epipole calibrate boards/ --board {}x{}{pattern} --square-m {} --model {} -o camera.json",
            options.board.columns,
            options.board.rows,
            options.square_m,
            options.lens.name()
        )
    }
}

/// Formats numbers as a list in JSON and Rust.
pub(super) fn listed(numbers: &[f64]) -> String {
    let numbers: Vec<String> = numbers.iter().map(|x| format!("{x:?}")).collect();
    format!("[{}]", numbers.join(", "))
}

/// Formats the fields of a camera in JSON, as read by `epipole undistort` and `epipole sfm`.
pub(super) fn camera_fields(camera: &LensCamera) -> String {
    let (width, height) = camera.size;
    format!(
        "  \"image\": {{ \"width\": {width}, \"height\": {height} }},\n  \"k\": {},\n  \"distortion\": {{ \"model\": \
         \"{}\", \"coefficients\": {} }}",
        listed(&camera.k),
        camera.lens.name(),
        listed(&camera.coefficients)
    )
}
