//! A figure as its users see it: a model and its view behind one door.
//!
//! Pages, posters, the command line and the tests all drive figures through [`Figure`]; nothing
//! outside this crate sees a model or a view.

use crate::canvas::{Canvas, Picture};
use crate::contract::{
    Control, ControlKind, Event, Handle, Job, JobResult, Layout, PhotoSlot, Problem, Readout,
    Space, Value,
};
use crate::gallery::{self, Entry};
use crate::stage::Stage;
use crate::theme::Theme;
use image::RgbImage;
use std::cell::RefCell;
use std::ops::ControlFlow;

/// Width of a poster and of a page's figure column, CSS pixels.
pub const POSTER_WIDTH: f64 = 760.0;

/// The value of a handle's parameter after the reader has removed it.
const REMOVED: &str = "removed";

/// A challenge with whether it is solved now.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct ChallengeStatus {
    /// Permanent name.
    pub id: &'static str,
    /// The goal as a request to the reader.
    pub goal: &'static str,
    /// A nudge for a reader who is stuck.
    pub hint: &'static str,
    /// Whether the present state reaches the goal.
    pub solved: bool,
}

/// A figure of the gallery in some state.
pub struct Figure {
    entry: &'static Entry,
    stage: Box<dyn Stage>,
    picture: Picture,
    /// Where the handles are before the reader moves any, for the controls as they last were:
    /// a figure is asked for its state after each frame, and few of them change a control.
    untouched: RefCell<Option<Untouched>>,
}

struct Untouched {
    /// The visible controls that differ from the default state.
    controls: Vec<(String, String)>,
    handles: Vec<Handle>,
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
        self.stage.controls()
    }

    /// The draggable points.
    pub fn handles(&self) -> Vec<Handle> {
        self.stage.handles()
    }

    /// The panels that show things in three dimensions.
    pub fn spaces(&self) -> &'static [Space] {
        self.stage.spaces()
    }

    /// The numbers beside the picture.
    pub fn readouts(&self) -> Vec<Readout> {
        self.stage.readouts()
    }

    /// What the figure shows now, in one or two sentences.
    pub fn describe(&self) -> String {
        self.stage.describe()
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
        self.stage.is_running()
    }

    /// The computation that the figure waits for, if any.
    pub fn job(&self) -> Option<Job> {
        self.stage.job()
    }

    /// Hands the result of the job with this [`key`](Job::key) to the figure. An answer that the
    /// figure no longer waits for is dropped; says whether it was used.
    pub fn job_done(&mut self, key: u64, result: JobResult) -> bool {
        let wanted = self.job().is_some_and(|job| job.key() == key);
        if wanted {
            self.stage.job_done(result);
        }
        wanted
    }

    /// Carries out what the figure waits for, here and now.
    pub fn finish_job(&mut self) {
        // A figure may go through several stages, but not through endlessly many.
        for _ in 0..16 {
            let Some(job) = self.job() else { return };
            let result =
                gallery::compute(
                    self.name(),
                    &job.request,
                    &mut |_| ControlFlow::Continue(()),
                );
            self.stage.job_done(result);
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
        self.stage.take_photo(slot, photo)
    }

    /// Tells the focal length of the photograph in a slot, in units of its longer side, as its
    /// file has it. One that no lens has is ignored.
    pub fn take_focal(&mut self, slot: &str, focal: f64) {
        let is_slot = self.photo_slots().iter().any(|known| known.id == slot);
        if is_slot && (0.1..100.0).contains(&focal) {
            self.stage.take_focal(slot, focal);
        }
    }

    /// Panels and height for a width of the page, CSS pixels.
    pub fn layout(&self, width: f64) -> Layout {
        self.stage.layout(width)
    }

    /// Changes the state. Whatever is wrong with the event, the figure stays as it was.
    ///
    /// # Errors
    /// A sentence for the reader: an unknown name, a bad value, or mathematics that refuses.
    pub fn update(&mut self, event: &Event) -> Result<(), Problem> {
        match event {
            Event::Reset => {
                self.stage = (self.entry.make)();
                Ok(())
            }
            Event::Set { id, .. } => {
                let settable = |control: &Control| {
                    control.id == id && !matches!(control.kind, ControlKind::Button { .. })
                };
                if self.controls().iter().any(settable) {
                    self.stage.update(event)
                } else {
                    Err(self.unknown(id))
                }
            }
            Event::Press { id } => {
                let controls = self.controls();
                let button = controls.iter().find(|control| {
                    control.id == id && matches!(control.kind, ControlKind::Button { .. })
                });
                match button {
                    Some(button) if button.enabled => self.stage.update(event),
                    Some(_) => Ok(()),
                    None => Err(self.unknown(id)),
                }
            }
            Event::HandleMoved { id, x, y } => {
                let handles = self.handles();
                let Some(handle) = handles.iter().find(|handle| handle.id == *id) else {
                    return Err(self.unknown(id));
                };
                let (x, y) = handle
                    .admit(*x, *y)
                    .ok_or_else(|| place_problem(id, *x, *y))?;
                self.stage.update(&Event::HandleMoved {
                    id: id.clone(),
                    x,
                    y,
                })
            }
            Event::HandleRemoved { id } => {
                match self.handles().iter().find(|handle| handle.id == *id) {
                    Some(handle) if handle.removable => self.stage.update(event),
                    Some(_) => Ok(()),
                    None => Err(self.unknown(id)),
                }
            }
            Event::Clicked { panel: id, x, y } => {
                let layout = self.layout(POSTER_WIDTH);
                let Some(panel) = layout.panels.iter().find(|panel| panel.id == id) else {
                    return Err(self.unknown(id));
                };
                if !x.is_finite() || !y.is_finite() {
                    return Err(place_problem(id, *x, *y));
                }
                if !panel.clickable {
                    return Ok(());
                }
                let within = |value: f64, a: f64, b: f64| value.clamp(a.min(b), a.max(b));
                self.stage.update(&Event::Clicked {
                    panel: id.clone(),
                    x: within(*x, panel.x_axis.start, panel.x_axis.end),
                    y: within(*y, panel.y_axis.start, panel.y_axis.end),
                })
            }
            Event::Tick { dt_s } => {
                // A page that was in the background reports minutes; the figure then goes on calmly.
                let dt_s = if dt_s.is_finite() {
                    dt_s.clamp(0.0, 0.1)
                } else {
                    0.0
                };
                if self.is_running() {
                    self.stage.update(&Event::Tick { dt_s })
                } else {
                    Ok(())
                }
            }
        }
    }

    /// The state as parameters: everything that differs from the default state.
    pub fn state(&self) -> Vec<(String, String)> {
        let mut visible = Vec::new();
        let mut hidden = Vec::new();
        for control in self.controls() {
            let value = match &control.kind {
                ControlKind::Slider {
                    value,
                    default,
                    digits,
                    ..
                } if value != default => {
                    format!("{value:.digits$}")
                }
                ControlKind::Toggle { value, default } if value != default => value.to_string(),
                ControlKind::Choice { value, default, .. } if value != default => {
                    (*value).to_owned()
                }
                _ => continue,
            };
            if control.visible {
                visible.push((control.id.to_owned(), value));
            } else {
                hidden.push((control.id.to_owned(), value));
            }
        }
        let mut untouched = self.untouched.borrow_mut();
        let untouched = match &*untouched {
            Some(known) if known.controls == visible => known,
            _ => untouched.insert(self.untouched_with(&visible)),
        };
        let (before, now) = (&untouched.handles, self.handles());
        let mut places = Vec::new();
        for handle in &now {
            let same =
                |old: &&Handle| old.id == handle.id && (old.x, old.y) == (handle.x, handle.y);
            if before.iter().find(same).is_none() {
                let digits = handle.digits;
                places.push((
                    handle.id.clone(),
                    format!("{:.digits$},{:.digits$}", handle.x, handle.y),
                ));
            }
        }
        for handle in before {
            if !now.iter().any(|other| other.id == handle.id) {
                places.push((handle.id.clone(), REMOVED.to_owned()));
            }
        }
        visible.into_iter().chain(places).chain(hidden).collect()
    }

    /// The default state with some controls set to values of this figure's own.
    fn untouched_with(&self, controls: &[(String, String)]) -> Untouched {
        let mut stage = (self.entry.make)();
        for (id, value) in controls {
            let id = id.clone();
            let value = Value::from(&**value);
            // This figure has the same value, so it is accepted.
            let _ = stage.update(&Event::Set { id, value });
        }
        Untouched {
            controls: controls.to_vec(),
            handles: stage.handles(),
        }
    }

    /// The state as the query of a URL; empty in the default state.
    pub fn query(&self) -> String {
        let pairs: Vec<String> = self
            .state()
            .into_iter()
            .map(|(key, value)| format!("{key}={value}"))
            .collect();
        pairs.join("&")
    }

    /// Puts parameters on top of the present state: controls first, then handles, then what is
    /// only in permalinks. A parameter that cannot be used is left out and its problem returned.
    pub fn apply(&mut self, parameters: &[(String, String)]) -> Vec<Problem> {
        let mut problems = Vec::new();
        let rank = |figure: &Self, key: &str| {
            let control = figure
                .controls()
                .into_iter()
                .find(|control| control.id == key);
            control.map_or(1, |control| if control.visible { 0 } else { 2 })
        };
        let mut ranked: Vec<(i32, &(String, String))> = parameters
            .iter()
            .map(|pair| (rank(self, &pair.0), pair))
            .collect();
        ranked.sort_by_key(|(rank, _)| *rank);
        for (rank, (key, value)) in ranked {
            let done = if rank == 1 {
                self.place_handle(key, value)
            } else {
                self.update(&Event::Set {
                    id: key.clone(),
                    value: Value::from(&**value),
                })
            };
            problems.extend(done.err());
        }
        problems
    }

    /// Applies a URL's query, such as `outliers=0.4&seed=7`.
    pub fn apply_query(&mut self, query: &str) -> Vec<Problem> {
        let pairs: Vec<(String, String)> = query
            .trim_start_matches('?')
            .split('&')
            .filter(|pair| !pair.is_empty())
            .map(|pair| pair.split_once('=').unwrap_or((pair, "")))
            .map(|(key, value)| {
                (
                    key.to_owned(),
                    value.replace("%2C", ",").replace("%2c", ","),
                )
            })
            .collect();
        self.apply(&pairs)
    }

    fn place_handle(&mut self, id: &str, value: &str) -> Result<(), Problem> {
        let exists = self.handles().iter().any(|handle| handle.id == id);
        if value == REMOVED && exists {
            return self.update(&Event::HandleRemoved { id: id.to_owned() });
        }
        let number = |text: &str| text.trim().parse::<f64>().ok().filter(|n| n.is_finite());
        let place = value
            .split_once(',')
            .and_then(|(x, y)| Some((number(x)?, number(y)?)));
        match (exists, place) {
            (true, Some((x, y))) => self.update(&Event::HandleMoved {
                id: id.to_owned(),
                x,
                y,
            }),
            (true, None) => Err(Problem::BadValue {
                name: id.to_owned(),
                value: value.to_owned(),
                expected: "two numbers with a comma between them, such as 1.5,2".to_owned(),
            }),
            (false, Some((x, y))) if self.stage.restore_handle(id, x, y) => Ok(()),
            (false, _) => Err(self.unknown(id)),
        }
    }

    fn unknown(&self, name: &str) -> Problem {
        let controls = self
            .controls()
            .into_iter()
            .map(|control| control.id.to_owned());
        let handles = self.handles().into_iter().map(|handle| handle.id);
        let known: Vec<String> = controls.chain(handles.take(12)).collect();
        Problem::UnknownParameter {
            figure: self.entry.name,
            name: name.to_owned(),
            known: known.join(", "),
        }
    }

    /// Draws the present state, `width` CSS pixels wide with `scale` device pixels each.
    ///
    /// # Errors
    /// [`Problem::BadSize`] for a picture without pixels, or too large.
    pub fn draw(&mut self, width: f64, scale: f64, theme: Theme) -> Result<&Picture, Problem> {
        if !(1.0..=Canvas::MAX_SIDE).contains(&width) {
            return Err(Problem::BadSize { width, height: 0.0 });
        }
        let layout = self.stage.layout(width);
        let buffer = std::mem::take(&mut self.picture);
        let mut canvas = Canvas::new(layout.width, layout.height, scale, theme, buffer)?;
        self.stage.draw(&layout, &mut canvas);
        self.picture = canvas.finish();
        Ok(&self.picture)
    }

    /// Does a few milliseconds of work that makes the next drawing better; false when there is
    /// nothing left to do. A page calls it while the reader rests.
    pub fn refine(&mut self) -> bool {
        self.stage.refine()
    }

    /// Finishes the job and draws at full quality: what a poster and the tests show.
    ///
    /// # Errors
    /// As [`Figure::draw`].
    pub fn draw_settled(
        &mut self,
        width: f64,
        scale: f64,
        theme: Theme,
    ) -> Result<&Picture, Problem> {
        self.finish_job();
        self.draw_sharp(width, scale, theme)
    }

    /// Draws at full quality what is known now: the job that the figure may wait for is not done.
    ///
    /// # Errors
    /// As [`Figure::draw`].
    pub fn draw_sharp(
        &mut self,
        width: f64,
        scale: f64,
        theme: Theme,
    ) -> Result<&Picture, Problem> {
        self.draw(width, scale, theme)?;
        while self.refine() {}
        self.draw(width, scale, theme)
    }
}

fn place_problem(name: &str, x: f64, y: f64) -> Problem {
    Problem::BadValue {
        name: name.to_owned(),
        value: format!("{x},{y}"),
        expected: "two finite numbers".to_owned(),
    }
}
