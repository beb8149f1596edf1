//! A figure as its users see it: a model and its view behind one door.
//!
//! Pages, posters, the command line and the tests all drive figures through [`Figure`]; nothing
//! outside this crate sees a model or a view.

mod answers;
mod checks;
mod drawing;
mod permalink;
mod untouched;

use crate::canvas::Picture;
use crate::contract::{
    ChallengeStatus, Control, Event, FileOffer, Handle, Job, JobResult, PhotoSlot, Problem,
    Readout, Space, Symbol,
};
use crate::gallery::{self, Entry};
use crate::stage::Stage;
pub use answers::Answers;
use image::RgbImage;
use std::cell::RefCell;
use std::ops::ControlFlow;
use untouched::Untouched;

/// Width of a poster and of a page's figure column, CSS pixels.
pub const POSTER_WIDTH: f64 = 760.0;

/// A figure of the gallery in some state.
pub struct Figure {
    entry: &'static Entry,
    stage: Box<dyn Stage>,
    picture: Picture,
    /// Where the handles are before the reader moves any, for the controls as they last were:
    /// a figure is asked for its state after each frame, and few of them change a control.
    untouched: RefCell<Option<Untouched>>,
}

impl Figure {
    /// A figure in its default state.
    ///
    /// # Errors
    /// [`Problem::UnknownFigure`], with the names that exist.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole_widgets::contract::Problem> {
    /// let figure = epipole_widgets::Figure::new("ransac-race")?;
    /// assert_eq!(figure.title(), "The race");
    /// assert_eq!(figure.state(), []);
    /// # Ok(()) }
    /// ```
    pub fn new(name: &str) -> Result<Self, Problem> {
        let entry = gallery::find(name)?;
        Ok(Self {
            entry,
            stage: (entry.make)(),
            picture: Picture::default(),
            untouched: RefCell::default(),
        })
    }

    /// Permanent name.
    pub fn name(&self) -> &'static str {
        self.entry.name
    }

    /// Title.
    pub fn title(&self) -> &'static str {
        self.entry.title
    }

    /// What a reader can do with it.
    pub fn help(&self) -> &'static str {
        self.entry.help
    }

    /// Sliders, toggles, choices and buttons with their present values.
    pub fn controls(&self) -> Vec<Control> {
        self.stage.model().controls()
    }

    /// The draggable points.
    pub fn handles(&self) -> Vec<Handle> {
        self.stage.model().handles()
    }

    /// The panels that show things in three dimensions now.
    pub fn spaces(&self) -> Vec<Space> {
        let handles = self.handles();
        let is_shown = |space: &&Space| handles.iter().any(|handle| handle.id == space.orbit);
        let spaces = self.stage.spaces().iter();
        spaces.filter(is_shown).copied().collect()
    }

    /// What of the book's letters the picture shows.
    pub fn symbols(&self) -> Vec<Symbol> {
        self.stage.model().symbols()
    }

    /// What the reader can save besides the picture.
    pub fn file(&self) -> Option<FileOffer> {
        self.stage.model().file()
    }

    /// The bytes of that; none if nothing is offered.
    pub fn file_bytes(&self) -> Vec<u8> {
        self.stage.model().file_bytes()
    }

    /// The numbers beside the picture.
    pub fn readouts(&self) -> Vec<Readout> {
        self.stage.words().readouts()
    }

    /// What the figure shows now, in one or two sentences.
    pub fn describe(&self) -> String {
        self.stage.words().describe()
    }

    /// The goals, and which of them are reached.
    pub fn challenges(&self) -> Vec<ChallengeStatus> {
        self.stage.challenges()
    }

    /// The events that solve a challenge from the default state.
    pub fn solution(&self, challenge: &str) -> Option<Vec<Event>> {
        self.stage.solution(challenge)
    }

    /// True while the figure wants [`Event::Tick`].
    pub fn is_running(&self) -> bool {
        self.stage.model().is_running()
    }

    /// The computation that the figure waits for, if any.
    pub fn job(&mut self) -> Option<&dyn Job> {
        self.stage.model_mut().job()
    }

    /// Hands the result of the job with this [`key`](Job::key) to the figure. An answer that the
    /// figure no longer waits for is dropped; says whether it was used.
    pub fn job_done(&mut self, key: u64, result: JobResult) -> bool {
        let wanted = self.job().is_some_and(|job| job.key() == key);
        if wanted {
            self.stage.model_mut().job_done(result);
        }
        wanted
    }

    /// Carries out what the figure waits for, here and now.
    pub fn finish_job(&mut self) {
        self.finish_job_by(|name, job| {
            gallery::compute(name, &job.request(), &mut |_| ControlFlow::Continue(()))
        });
    }

    /// The same by whoever computes: of the name of the figure and what it waits for.
    fn finish_job_by(&mut self, mut compute: impl FnMut(&'static str, &dyn Job) -> JobResult) {
        // A figure may go through several stages, but not through endlessly many.
        for _ in 0..16 {
            let name = self.entry.name;
            let Some(job) = self.job() else { return };
            let result = compute(name, job);
            self.stage.model_mut().job_done(result);
        }
    }

    /// Places for photographs of the reader's own.
    pub fn photo_slots(&self) -> &'static [PhotoSlot] {
        self.stage.photo_slots()
    }

    /// Puts a photograph of the reader's own into a slot.
    ///
    /// # Errors
    /// [`Problem::UnknownParameter`] for a slot that the figure lacks, or a sentence about the
    /// photograph.
    pub fn take_photo(&mut self, slot: &str, photo: RgbImage) -> Result<(), Problem> {
        if self.photo_slots().iter().all(|known| known.id != slot) {
            return Err(self.unknown(slot));
        }
        self.stage.model_mut().take_photo(slot, photo)
    }

    /// Tells the focal length of the photograph in a slot, in units of its longer side, as its
    /// file has it. One that no lens has is ignored.
    pub fn take_focal(&mut self, slot: &str, focal: f64) {
        let is_slot = self.photo_slots().iter().any(|known| known.id == slot);
        if is_slot && (0.1..100.0).contains(&focal) {
            self.stage.model_mut().take_focal(slot, focal);
        }
    }
}
