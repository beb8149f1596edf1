//! One figure of a page.

use crate::json::{Listed, json};
use epipole_widgets::canvas::Picture;
use epipole_widgets::contract::{Event, Handle, JobResult, Problem, Refused, Value};
use epipole_widgets::pointing::{self, Direction};
use epipole_widgets::theme::Theme;
use epipole_widgets::{Figure as Model, Snapshot, gallery};
use image::RgbImage;
use wasm_bindgen::prelude::wasm_bindgen;

/// Lists all figures as JSON: `[{"name", "title", "help"}]`.
#[wasm_bindgen]
pub fn figures() -> String {
    let listed = |entry: &gallery::Entry| Listed {
        name: entry.name,
        title: entry.title,
        help: entry.help,
    };
    json(&gallery::FIGURES.iter().map(listed).collect::<Vec<_>>())
}

/// A figure in some state, with its last drawn frame.
///
/// Inputs are plain arguments, so that the module contains no JSON parser. Outputs are JSON, which
/// browsers parse faster than many calls across the boundary.
///
/// Widths are in CSS pixels; positions are in CSS pixels from the top left corner of the picture
/// laid out for the given width. Methods that change the state return a message for the reader if
/// the figure refuses, otherwise nothing.
#[wasm_bindgen]
pub struct Figure {
    figure: Model,
    frame: Frame,
}

/// Address and size of the last frame.
struct Frame {
    address: *const u8,
    width: u32,
    height: u32,
    hash: Option<u64>,
}

impl Frame {
    const NONE: Self = Self {
        address: std::ptr::null(),
        width: 0,
        height: 0,
        hash: None,
    };

    fn of(picture: &Picture) -> Self {
        Self {
            address: picture.rgba().as_ptr(),
            width: picture.width(),
            height: picture.height(),
            hash: None,
        }
    }
}

#[wasm_bindgen]
impl Figure {
    /// Creates a figure in its default state.
    ///
    /// # Errors
    /// A message with the names that exist.
    #[wasm_bindgen(constructor)]
    pub fn new(name: &str) -> Result<Figure, String> {
        let figure = Model::new(name).map_err(|problem| problem.to_string())?;
        Ok(Self {
            figure,
            frame: Frame::NONE,
        })
    }

    /// Returns the title.
    pub fn title(&self) -> String {
        self.figure.title().to_owned()
    }

    /// Returns the help for the reader.
    pub fn help(&self) -> String {
        self.figure.help().to_owned()
    }

    /// Applies parameters, given as alternating keys and values, to the state. Returns the invalid
    /// ones, JSON `[{"unknown", "message"}]`.
    pub fn apply(&mut self, parameters: Vec<String>) -> String {
        let pairs: Vec<(String, String)> = parameters
            .chunks_exact(2)
            .map(|pair| (pair[0].clone(), pair[1].clone()))
            .collect();
        let problems = self.figure.apply(&pairs);
        json(&problems.iter().map(Refused::from).collect::<Vec<_>>())
    }

    /// Returns the differences from the default state, JSON `[[key, value]]`.
    pub fn state(&self) -> String {
        json(&self.figure.state())
    }

    /// Sets a slider.
    pub fn set_number(&mut self, id: String, value: f64) -> Option<String> {
        let value = Value::Number(value);
        self.send(&Event::Set { id, value })
    }

    /// Sets a toggle.
    pub fn set_flag(&mut self, id: String, value: bool) -> Option<String> {
        let value = Value::Flag(value);
        self.send(&Event::Set { id, value })
    }

    /// Sets a choice, or any control from its text.
    pub fn set_text(&mut self, id: String, value: String) -> Option<String> {
        let value = Value::Text(value);
        self.send(&Event::Set { id, value })
    }

    /// Presses a button.
    pub fn press(&mut self, id: String) -> Option<String> {
        self.send(&Event::Press { id })
    }

    /// Removes a handle, if the figure allows it.
    pub fn remove(&mut self, id: String) -> Option<String> {
        self.send(&Event::HandleRemoved { id })
    }

    /// Moves a handle to a position in the world units of its panel.
    pub fn place(&mut self, id: &str, x: f64, y: f64) -> Option<String> {
        self.send(&Event::moved(id, x, y))
    }

    /// Clicks in a panel, at a position in its world units.
    pub fn click_in(&mut self, panel: &str, x: f64, y: f64) -> Option<String> {
        self.send(&Event::clicked(panel, x, y))
    }

    /// Returns the events that solve a challenge from the default state, JSON `[{"type", …}]`.
    pub fn solution(&self, challenge: &str) -> String {
        json(&self.figure.solution(challenge).unwrap_or_default())
    }

    /// Restores the default state.
    pub fn reset(&mut self) -> Option<String> {
        self.send(&Event::Reset)
    }

    /// Advances the time by seconds.
    pub fn tick(&mut self, dt_s: f64) -> Option<String> {
        self.send(&Event::Tick { dt_s })
    }

    /// Whether the figure needs [`Figure::tick`].
    pub fn is_running(&self) -> bool {
        self.figure.is_running()
    }

    /// Returns everything to show beside the picture as JSON.
    pub fn snapshot(&mut self, width: f64) -> String {
        json(&Snapshot::of(&mut self.figure, width))
    }

    /// Returns the handle that a press at a position grabs.
    pub fn handle_at(&self, width: f64, x: f64, y: f64) -> Option<String> {
        let (handles, layout) = (self.figure.handles(), self.figure.layout(width));
        pointing::handle_at(&handles, &layout, (x, y)).map(|handle| handle.id.clone())
    }

    /// Moves a handle to a position.
    pub fn drag(&mut self, id: &str, width: f64, x: f64, y: f64) -> Option<String> {
        let layout = self.figure.layout(width);
        let event = pointing::drag(&self.handle(id)?, &layout, (x, y));
        self.send(&event)
    }

    /// Moves a handle by its own step size towards `left`, `right`, `up` or `down`.
    pub fn nudge(&mut self, id: &str, width: f64, towards: &str, steps: f64) -> Option<String> {
        let layout = self.figure.layout(width);
        let event = pointing::nudge(&self.handle(id)?, &layout, direction(towards)?, steps);
        self.send(&event)
    }

    /// Moves a handle to the end of its range.
    pub fn move_to_end(&mut self, id: &str, width: f64, towards: &str) -> Option<String> {
        let layout = self.figure.layout(width);
        let event = pointing::to_the_end(&self.handle(id)?, &layout, direction(towards)?);
        self.send(&event)
    }

    /// Clicks at a position without a handle.
    pub fn click(&mut self, width: f64, x: f64, y: f64) -> Option<String> {
        let event = pointing::click(&self.figure.layout(width), (x, y))?;
        self.send(&event)
    }

    /// Puts a photograph of the reader, rows of red, green, blue, alpha, into a slot.
    pub fn take_photo(
        &mut self,
        slot: &str,
        width: u32,
        height: u32,
        rgba: &[u8],
    ) -> Option<String> {
        let rgb = rgba
            .chunks_exact(4)
            .flat_map(|pixel| [pixel[0], pixel[1], pixel[2]])
            .collect();
        let Some(photo) = RgbImage::from_raw(width, height, rgb) else {
            return Some("the photograph is not complete".to_owned());
        };
        let refused = self.figure.take_photo(slot, photo).err();
        refused.map(|problem| problem.to_string())
    }

    /// Returns values of the state for readers' code, JSON `{name: value}`.
    pub fn data(&self) -> String {
        json(&self.figure.data())
    }

    /// Returns the photograph that a panel shows: rows of red, green, blue. Empty without one.
    pub fn photograph(&mut self, panel: &str) -> Vec<u8> {
        let photograph = self.figure.photograph(panel);
        photograph.map_or_else(Vec::new, RgbImage::into_raw)
    }

    /// Returns the file offered in the snapshot for saving, besides the picture.
    pub fn file(&self) -> Vec<u8> {
        self.figure.file_bytes()
    }

    /// Sets the focal length of the photograph in a slot, in units of its longer side.
    pub fn take_focal(&mut self, slot: &str, focal: f64) {
        self.figure.take_focal(slot, focal);
    }

    /// Returns a unique name of the long computation that the figure waits for.
    pub fn job_key(&mut self) -> Option<String> {
        self.figure.job().map(|job| format!("{:016x}", job.key()))
    }

    /// Returns the input of that computation, the second argument of `compute`.
    pub fn job_request(&mut self) -> Vec<u8> {
        self.figure.job().map_or_else(Vec::new, |job| job.request())
    }

    /// Takes the result of a computation; a result that the figure no longer waits for is dropped.
    pub fn job_done(&mut self, key: &str, result: Vec<u8>) -> bool {
        self.end_job(key, Ok(result))
    }

    /// Reports a failed computation, with its error message.
    pub fn job_failed(&mut self, key: &str, sentence: String) -> bool {
        self.end_job(key, Err(Problem::Elsewhere { sentence }))
    }

    /// Does a few milliseconds of the first frame's preparation; false when done.
    pub fn prepare(&mut self) -> bool {
        self.figure.prepare()
    }

    /// Does a few milliseconds of work that makes the next frame better; false when done.
    pub fn refine(&mut self) -> bool {
        self.figure.refine()
    }

    /// Draws a frame, `width` CSS pixels wide with `scale` device pixels each.
    pub fn draw(&mut self, width: f64, scale: f64, theme: &str) -> Option<String> {
        let theme = theme.parse().unwrap_or(Theme::Light);
        let drawn = self.figure.draw(width, scale, theme).map(Frame::of);
        self.keep(drawn.map_err(|problem| problem.to_string()))
    }

    /// Draws a frame at full quality, however long it takes, except for a pending computation.
    pub fn draw_sharp(&mut self, width: f64, scale: f64, theme: &str) -> Option<String> {
        let theme = theme.parse().unwrap_or(Theme::Light);
        let drawn = self.figure.draw_sharp(width, scale, theme);
        let drawn = drawn.map(|picture| Frame {
            hash: Some(picture.hash()),
            ..Frame::of(picture)
        });
        self.keep(drawn.map_err(|problem| problem.to_string()))
    }

    /// Returns the address of the last frame: rows of opaque red, green, blue, alpha. Valid until
    /// the next call of any method.
    pub fn pixels(&self) -> *const u8 {
        self.frame.address
    }

    /// Returns the width of the last frame, device pixels.
    pub fn pixel_width(&self) -> u32 {
        self.frame.width
    }

    /// Returns the height of the last frame, device pixels.
    pub fn pixel_height(&self) -> u32 {
        self.frame.height
    }

    /// Returns a hash of the last frame drawn at full quality, hexadecimal.
    pub fn frame_hash(&self) -> Option<String> {
        self.frame.hash.map(|hash| format!("{hash:016x}"))
    }

    fn keep(&mut self, drawn: Result<Frame, String>) -> Option<String> {
        match drawn {
            Ok(frame) => {
                self.frame = frame;
                None
            }
            Err(sentence) => {
                self.frame = Frame::NONE;
                Some(sentence)
            }
        }
    }

    fn handle(&self, id: &str) -> Option<Handle> {
        let mut handles = self.figure.handles().into_iter();
        handles.find(|handle| handle.id == id)
    }
}

impl Figure {
    fn end_job(&mut self, key: &str, result: JobResult) -> bool {
        u64::from_str_radix(key, 16).is_ok_and(|key| self.figure.job_done(key, result))
    }

    /// Changes the state by any event. For native callers only, as the module has a method for each
    /// event.
    pub fn send(&mut self, event: &Event) -> Option<String> {
        let refused = self.figure.update(event).err();
        refused.map(|problem| problem.to_string())
    }
}

fn direction(name: &str) -> Option<Direction> {
    match name {
        "left" => Some(Direction::Left),
        "right" => Some(Direction::Right),
        "up" => Some(Direction::Up),
        "down" => Some(Direction::Down),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::Value as Json;

    fn race() -> Figure {
        Figure::new("ransac-race").unwrap()
    }

    fn snapshot(figure: &mut Figure) -> Json {
        serde_json::from_str(&figure.snapshot(760.0)).unwrap()
    }

    #[test]
    fn unknown_figures_are_refused_with_those_that_exist() {
        let sentence = Figure::new("nothing").err().unwrap();
        assert!(sentence.contains("ransac-race"), "{sentence}");
        let listed: Vec<Json> = serde_json::from_str(&figures()).unwrap();
        assert_eq!(listed.len(), gallery::FIGURES.len());
    }

    #[test]
    fn parameters_go_in_pairs_and_the_bad_come_back() {
        let mut figure = race();
        let words = ["outliers", "0.2", "seed", "many", "size", "3"];
        let refused = figure.apply(words.map(str::to_owned).to_vec());
        let refused: Vec<Json> = serde_json::from_str(&refused).unwrap();
        let unknown: Vec<bool> = refused
            .iter()
            .map(|one| one["unknown"] == Json::Bool(true))
            .collect();
        assert_eq!(unknown.iter().filter(|&&unknown| unknown).count(), 1);
        assert_eq!(refused.len(), 2);
        assert_eq!(figure.state(), r#"[["outliers","0.20"]]"#);
        assert_eq!(figure.reset(), None);
        assert_eq!(figure.state(), "[]");
    }

    #[test]
    fn a_handle_is_where_the_snapshot_says_and_goes_where_it_is_dragged() {
        let mut figure = race();
        let before = snapshot(&mut figure);
        let handle = &before["handles"][0];
        let place = |handle: &Json| {
            let at = |index: usize| handle["place"][index].as_f64().unwrap();
            (at(0), at(1))
        };
        let (x, y) = place(handle);
        let id = handle["id"].as_str().unwrap();
        assert!(figure.handle_at(760.0, x, y).is_some());
        assert_eq!(figure.drag(id, 760.0, x + 20.0, y - 10.0), None);
        let (moved_x, moved_y) = place(&snapshot(&mut figure)["handles"][0]);
        // The handle's position has two decimals, which is a fraction of a pixel.
        assert!((moved_x - x - 20.0).abs() < 0.5 && (moved_y - y + 10.0).abs() < 0.5);
        assert_eq!(figure.nudge("no such handle", 760.0, "left", 1.0), None);
        assert_eq!(figure.nudge(id, 760.0, "sideways", 1.0), None);
    }

    #[test]
    fn a_frame_has_the_pixels_of_its_size_and_a_size_without_pixels_has_none() {
        let mut figure = race();
        assert_eq!(figure.draw_sharp(300.0, 2.0, "dark"), None);
        assert_eq!(figure.pixel_width(), 600);
        assert!(figure.pixel_height() > 100 && !figure.pixels().is_null());
        assert_eq!(figure.frame_hash().unwrap().len(), 16);
        let refused = figure.draw(0.0, 1.0, "light");
        assert!(refused.unwrap().contains("cannot be drawn"));
        assert!(figure.pixels().is_null());
    }

    #[test]
    fn photographs_that_do_not_fit_are_refused_in_words() {
        let mut figure = race();
        let incomplete = figure.take_photo("photo", 10, 10, &[0; 12]);
        assert_eq!(
            incomplete.as_deref(),
            Some("the photograph is not complete")
        );
        assert!(figure.take_photo("photo", 1, 1, &[0; 4]).is_some());
        assert_eq!(figure.job_key(), None);
        assert!(!figure.job_done("12ab", Vec::new()));
    }
}
