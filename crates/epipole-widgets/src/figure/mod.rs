//! The public interface of a figure, which combines a model and its view.
//!
//! Pages, posters, the command line and the tests all use figures through [`Figure`]; models and
//! views are private to this crate.

mod answers;
mod checks;
mod drawing;
mod permalink;
mod untouched;

use crate::canvas::Picture;
use crate::contract::{
    ChallengeStatus, Control, Data, Event, FileOffer, Handle, Job, JobResult, PhotoSlot, Problem,
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
    /// Cached handles of the untouched figure for the controls of the last call: pages request the
    /// state after every frame, and controls rarely change.
    untouched: RefCell<Option<Untouched>>,
}

impl Figure {
    /// Creates a figure in its default state.
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

    /// Returns the permanent name.
    pub fn name(&self) -> &'static str {
        self.entry.name
    }

    /// Returns the title.
    pub fn title(&self) -> &'static str {
        self.entry.title
    }

    /// Returns the instructions for the reader.
    pub fn help(&self) -> &'static str {
        self.entry.help
    }

    /// Returns sliders, toggles, choices and buttons with their current values.
    pub fn controls(&self) -> Vec<Control> {
        self.stage.model().controls()
    }

    /// Returns the draggable points.
    pub fn handles(&self) -> Vec<Handle> {
        self.stage.model().handles()
    }

    /// Returns the three-dimensional panels currently shown.
    pub fn spaces(&self) -> Vec<Space> {
        let handles = self.handles();
        let is_shown = |space: &&Space| handles.iter().any(|handle| handle.id == space.orbit);
        let spaces = self.stage.spaces().iter();
        spaces.filter(is_shown).copied().collect()
    }

    /// Returns the chapter's symbols that the picture shows.
    pub fn symbols(&self) -> Vec<Symbol> {
        self.stage.model().symbols()
    }

    /// Returns values of the state for readers' code.
    pub fn data(&self) -> Data {
        self.stage.model().data()
    }

    /// Returns the photograph that a panel shows, in its current quality, for readers' code.
    pub fn photograph(&mut self, panel: &str) -> Option<RgbImage> {
        self.stage.photograph(panel)
    }

    /// Returns the file that can be saved besides the picture, if any.
    pub fn file(&self) -> Option<FileOffer> {
        self.stage.model().file()
    }

    /// Returns the bytes of the offered file; empty without one.
    pub fn file_bytes(&self) -> Vec<u8> {
        self.stage.model().file_bytes()
    }

    /// Returns the numbers beside the picture.
    pub fn readouts(&self) -> Vec<Readout> {
        self.stage.words().readouts()
    }

    /// Describes the current state in one or two sentences.
    pub fn describe(&self) -> String {
        self.stage.words().describe()
    }

    /// Returns the goals with their status.
    pub fn challenges(&self) -> Vec<ChallengeStatus> {
        self.stage.challenges()
    }

    /// Returns the events that solve a challenge from the default state.
    pub fn solution(&self, challenge: &str) -> Option<Vec<Event>> {
        self.stage.solution(challenge)
    }

    /// Returns whether the figure needs [`Event::Tick`].
    pub fn is_running(&self) -> bool {
        self.stage.model().is_running()
    }

    /// Returns the pending job, if any.
    pub fn job(&mut self) -> Option<&dyn Job> {
        self.stage.model_mut().job()
    }

    /// Takes the result of the job with this [`key`](Job::key). Returns false, and drops the
    /// result, if the figure no longer waits for it.
    pub fn job_done(&mut self, key: u64, result: JobResult) -> bool {
        let wanted = self.job().is_some_and(|job| job.key() == key);
        if wanted {
            self.stage.model_mut().job_done(result);
        }
        wanted
    }

    /// Runs the pending jobs on the calling thread.
    pub fn finish_job(&mut self) {
        self.finish_job_by(|name, job| {
            gallery::compute(name, &job.request(), &mut |_| ControlFlow::Continue(()))
        });
    }

    /// Finishes the pending jobs with `compute`, a function of the figure's name and the job.
    fn finish_job_by(&mut self, mut compute: impl FnMut(&'static str, &dyn Job) -> JobResult) {
        // Bounds the number of stages, so that a faulty model cannot loop forever.
        for _ in 0..16 {
            let name = self.entry.name;
            let Some(job) = self.job() else { return };
            let result = compute(name, job);
            self.stage.model_mut().job_done(result);
        }
    }

    /// Returns the slots for the reader's photographs.
    pub fn photo_slots(&self) -> &'static [PhotoSlot] {
        self.stage.photo_slots()
    }

    /// Returns whether the reader has not chosen all photographs yet.
    pub fn wants_photos(&self) -> bool {
        self.stage.model().wants_photos()
    }

    /// Puts a photograph of the reader into a slot.
    ///
    /// # Errors
    /// [`Problem::UnknownParameter`] for an unknown slot, or a message about the
    /// photograph.
    pub fn take_photo(&mut self, slot: &str, photo: RgbImage) -> Result<(), Problem> {
        if self.photo_slots().iter().all(|known| known.id != slot) {
            return Err(self.unknown(slot));
        }
        self.stage.model_mut().take_photo(slot, photo)
    }

    /// Sets the focal length of the photograph in a slot, in units of its longer side, from its
    /// metadata. Implausible values are ignored.
    pub fn take_focal(&mut self, slot: &str, focal: f64) {
        let is_slot = self.photo_slots().iter().any(|known| known.id == slot);
        if is_slot && (0.1..100.0).contains(&focal) {
            self.stage.model_mut().take_focal(slot, focal);
        }
    }
}
