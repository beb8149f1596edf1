//! Frames of a video, or steps of a computation, on a track below a plot, with a handle and buttons
//! to play them.

use crate::contract::{Control, Event, Handle, round_to_digits};
use crate::kit::running::Running;

/// Frames of a video per second.
const PACE: f64 = 8.0;
/// Decimals of a position between two frames in permalinks.
const DIGITS: usize = 2;

/// Current frame, from 0 to the last.
pub(crate) struct Timeline {
    /// Id of the handle.
    id: &'static str,
    /// Name of one frame or step.
    name: &'static str,
    running: Running,
    /// Position on the track, frames; `None` for the last frame.
    place: Option<f64>,
}

impl Timeline {
    /// Creates a timeline for frames of a video, at the last one.
    pub(crate) fn of_frames() -> Self {
        Self::new("frame", "Frame", PACE)
    }

    /// Creates a timeline at its end.
    ///
    /// * `id`: id of the handle
    /// * `name`: name of one frame or step
    pub(crate) fn new(id: &'static str, name: &'static str, steps_per_second: f64) -> Self {
        Self {
            id,
            name,
            running: Running::at(steps_per_second),
            place: None,
        }
    }

    /// Returns the index of the current frame.
    pub(crate) fn frame(&self, last: usize) -> usize {
        self.place(last).round() as usize
    }

    /// Returns the position of the handle on the track, frames. During a drag it can be between two
    /// frames.
    pub(crate) fn place(&self, last: usize) -> f64 {
        let last = last as f64;
        self.place.unwrap_or(last).clamp(0.0, last)
    }

    pub(crate) fn is_running(&self) -> bool {
        self.running.is_running()
    }

    pub(crate) fn stop(&mut self) {
        self.running.stop();
    }

    /// Returns the buttons.
    pub(crate) fn controls(&self, can_run: bool, last: usize) -> [Control; 3] {
        let frame = self.frame(last);
        self.running.controls(can_run, frame, frame >= last)
    }

    /// Returns the handle, in the panel `track`.
    pub(crate) fn handle(&self, last: usize) -> Handle {
        let frame = self.frame(last);
        let range = [[0.0, last as f64], [0.0; 2]];
        let handle = Handle::new(self.id, "track", self.name, (self.place(last), 0.0), range);
        let name = self.name.to_lowercase();
        let words = format!("{name} {} of {}", frame + 1, last + 1);
        handle.told(words).step([1.0, 0.0], DIGITS)
    }

    /// Applies a button, a tick, the handle or a click; returns whether the event was one of them.
    pub(crate) fn update(&mut self, event: &Event, last: usize) -> bool {
        let frame = self.frame(last);
        if let Some(next) = self.running.update(event, frame, frame >= last) {
            self.go_to(next as f64, last);
            return true;
        }
        match event {
            Event::HandleMoved { x, .. } | Event::Clicked { x, .. } => {
                self.running.stop();
                self.go_to(*x, last);
                true
            }
            _ => false,
        }
    }

    fn go_to(&mut self, place: f64, last: usize) {
        let place = round_to_digits(place, DIGITS);
        let is_before = place < last as f64;
        self.place = is_before.then_some(place);
        self.running.stop_if(!is_before);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_video_runs_to_its_end_and_starts_over() {
        let mut timeline = Timeline::of_frames();
        assert!(timeline.update(&Event::moved("frame", 29.0, 0.0), 31));
        timeline.update(&Event::press("run"), 31);
        for _ in 0..4 {
            timeline.update(&Event::Tick { dt_s: 1.0 / PACE }, 31);
        }
        assert!(timeline.frame(31) == 31 && !timeline.is_running());
        timeline.update(&Event::press("restart"), 31);
        assert_eq!(timeline.frame(31), 0);
    }

    #[test]
    fn a_shorter_video_shows_its_last_frame() {
        let mut timeline = Timeline::of_frames();
        assert_eq!(timeline.frame(31), 31);
        timeline.update(&Event::moved("frame", 20.0, 0.0), 31);
        assert_eq!((timeline.frame(31), timeline.frame(5)), (20, 5));
        timeline.update(&Event::moved("frame", 19.6, 0.0), 31);
        assert_eq!((timeline.frame(31), timeline.place(31)), (20, 19.6));
        timeline.update(&Event::moved("frame", 17.586_775, 0.0), 31);
        assert_eq!(timeline.place(31), 17.59);
    }
}
