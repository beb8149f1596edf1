//! The model of a figure: state and mathematics, no drawing and no clock.

use super::{
    Asking, Challenge, Compute, Control, Event, FileOffer, Handle, Job, JobResult, PhotoSlot,
    Problem, Space, Symbol, Words,
};
use image::RgbImage;

/// State and mathematics of a figure.
///
/// Units are those of the world (meters, pixels of the photograph), never of the screen.
pub trait Model {
    /// Sliders, toggles, choices and buttons with their present values.
    fn controls(&self) -> Vec<Control>;

    /// The draggable points. A handle's id must not be a control's.
    fn handles(&self) -> Vec<Handle> {
        Vec::new()
    }

    /// What of the book's letters the picture shows: a letter of the prose lights it up.
    fn symbols(&self) -> Vec<Symbol> {
        Vec::new()
    }

    /// What the reader can save besides the picture; `None` where there is nothing to save.
    fn file(&self) -> Option<FileOffer> {
        None
    }

    /// The bytes of what is offered; none if nothing is.
    fn file_bytes(&self) -> Vec<u8> {
        Vec::new()
    }

    /// The only way that state changes. Values of controls arrive unchecked, places of handles
    /// within their ranges and digits, clicks within their panel; a [`Event::Reset`] never
    /// arrives, it makes a new model.
    ///
    /// # Errors
    /// A sentence for the reader; the state is then as it was.
    fn update(&mut self, event: &Event) -> Result<(), Problem>;

    /// Puts back a handle that the reader had added and that the default state lacks, as told by a
    /// permalink; false if this is no such handle or there is no room for it.
    fn restore_handle(&mut self, _id: &str, _x: f64, _y: f64) -> bool {
        false
    }

    /// True while the model wants [`Event::Tick`].
    fn is_running(&self) -> bool {
        false
    }

    /// What the model asks of whoever computes; of several questions, the one that is next.
    fn asking(&mut self) -> Option<&mut dyn Asking> {
        None
    }

    /// An answer has come to what was asked.
    fn answered(&mut self) {}

    /// The computation that the present state waits for; `None` once its result is there.
    fn job(&mut self) -> Option<&dyn Job> {
        self.asking()?.job()
    }

    /// Takes the result of the job that the model waits for; never that of an older one.
    fn job_done(&mut self, result: JobResult) {
        if self.asking().is_some_and(|asking| asking.take(result)) {
            self.answered();
        }
    }

    /// Takes the reader's own photograph for one of [`Declared::PHOTO_SLOTS`]. It is not part of the permalink.
    ///
    /// # Errors
    /// A sentence for the reader if it cannot be used; the state is then as it was.
    fn take_photo(&mut self, _slot: &str, _photo: RgbImage) -> Result<(), Problem> {
        Ok(())
    }

    /// Takes the focal length that the file of a photograph tells, in units of the photograph's
    /// longer side. Comes after [`Model::take_photo`], if at all; always finite and positive.
    fn take_focal(&mut self, _slot: &str, _focal: f64) {}
}

/// What a figure declares of itself before it has any state.
pub trait Declared: Model + Words + Sized + 'static {
    /// Permanent name, as in `<epipole-figure name="…">`.
    const NAME: &'static str;
    /// Title of the figure.
    const TITLE: &'static str;
    /// What a reader can do with it: pointer and keys, one or two sentences.
    const HELP: &'static str;

    /// Carries out a job.
    const COMPUTE: Compute = |_, _| Ok(Vec::new());
    /// Goals for the reader.
    const CHALLENGES: &'static [Challenge<Self>] = &[];
    /// The panels that show things in three dimensions; each is there while its handles are.
    const SPACES: &'static [Space] = &[];
    /// Places for photographs of the reader's own.
    const PHOTO_SLOTS: &'static [PhotoSlot] = &[];

    /// The default state, which must make the figure's point without being touched.
    fn new() -> Self;
}
