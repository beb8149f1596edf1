//! The model of a figure: state and mathematics, no drawing and no clock.

use super::{
    Asking, Challenge, Compute, Control, Data, Event, FileOffer, Handle, Job, JobResult, PhotoSlot,
    Problem, Space, Symbol, Words,
};
use image::RgbImage;

/// State and mathematics of a figure.
///
/// Units are those of the world (meters, pixels of the photograph), never of the screen.
pub trait Model {
    /// Returns sliders, toggles, choices and buttons with their current values.
    fn controls(&self) -> Vec<Control>;

    /// Returns the draggable points. A handle's id must differ from every control's.
    fn handles(&self) -> Vec<Handle> {
        Vec::new()
    }

    /// Returns the chapter's symbols that the picture shows; pointing at one in the text highlights
    /// it.
    fn symbols(&self) -> Vec<Symbol> {
        Vec::new()
    }

    /// Returns values of the state for readers' code. The names are permanent.
    fn data(&self) -> Data {
        Data::new()
    }

    /// Returns the file that the reader can save besides the picture, if any.
    fn file(&self) -> Option<FileOffer> {
        None
    }

    /// Returns the bytes of the offered file; empty without one.
    fn file_bytes(&self) -> Vec<u8> {
        Vec::new()
    }

    /// Applies an event: the only way to change the state. Values of controls arrive unchecked,
    /// positions of handles within their ranges and digits, clicks within their panel.
    /// [`Event::Reset`] never arrives, since it creates a new model.
    ///
    /// # Errors
    /// A message for the reader; the state is unchanged.
    fn update(&mut self, event: &Event) -> Result<(), Problem>;

    /// Restores a handle added by the reader from a permalink; false if the id is not one of these
    /// or there is no room for another.
    fn restore_handle(&mut self, _id: &str, _x: f64, _y: f64) -> bool {
        false
    }

    /// Returns whether the model needs [`Event::Tick`].
    fn is_running(&self) -> bool {
        false
    }

    /// Returns the source of the next job, if any.
    fn asking(&mut self) -> Option<&mut dyn Asking> {
        None
    }

    /// Called when the result of a job has arrived.
    fn answered(&mut self) {}

    /// Returns the pending job of the current state; `None` once its result has arrived.
    fn job(&mut self) -> Option<&dyn Job> {
        self.asking()?.job()
    }

    /// Takes the result of the pending job, never that of an older one.
    fn job_done(&mut self, result: JobResult) {
        if self.asking().is_some_and(|asking| asking.take(result)) {
            self.answered();
        }
    }

    /// Returns whether it needs photographs that the reader has not chosen yet.
    fn wants_photos(&self) -> bool {
        false
    }

    /// Takes the reader's photograph for one of [`Declared::PHOTO_SLOTS`]. It is not part of the
    /// permalink.
    ///
    /// # Errors
    /// A message for the reader if the photograph cannot be used; the state is unchanged.
    fn take_photo(&mut self, _slot: &str, _photo: RgbImage) -> Result<(), Problem> {
        Ok(())
    }

    /// Takes the focal length from a photograph's metadata, in units of the photograph's longer
    /// side. Called after [`Model::take_photo`] if known; always finite and positive.
    fn take_focal(&mut self, _slot: &str, _focal: f64) {}
}

/// Static properties of a figure.
pub trait Declared: Model + Words + Sized + 'static {
    /// Permanent name, as in `<epipole-figure name="…">`.
    const NAME: &'static str;
    /// Title of the figure.
    const TITLE: &'static str;
    /// Instructions for the reader: pointer and keys, in one or two sentences.
    const HELP: &'static str;

    /// Runs a job.
    const COMPUTE: Compute = |_, _| Ok(Vec::new());
    /// Goals for the reader.
    const CHALLENGES: &'static [Challenge<Self>] = &[];
    /// Three-dimensional panels; each is shown while its handles are.
    const SPACES: &'static [Space] = &[];
    /// Slots for photographs of the reader.
    const PHOTO_SLOTS: &'static [PhotoSlot] = &[];

    /// Creates the default state, in which the figure must make its point.
    fn new() -> Self;
}
