//! Loops that the reader runs, steps and restarts: buttons and pace.

use crate::contract::{Button, ButtonRole, Control, Event};

const RUN: Button = Button::new("run", "Run", ButtonRole::Run);
const STEP: Button = Button::new("step", "Step", ButtonRole::Step);
const RESTART: Button = Button::new("restart", "Start over", ButtonRole::Restart);

/// State of a loop's animation; the figure keeps the current step.
pub(crate) struct Running {
    steps_per_second: f64,
    is_running: bool,
    since_step_s: f64,
}

impl Running {
    /// Creates a paused loop that runs at `steps_per_second`.
    pub(crate) fn at(steps_per_second: f64) -> Self {
        Self {
            steps_per_second,
            is_running: false,
            since_step_s: 0.0,
        }
    }

    pub(crate) fn is_running(&self) -> bool {
        self.is_running
    }

    pub(crate) fn stop(&mut self) {
        self.is_running = false;
    }

    pub(crate) fn stop_if(&mut self, is_finished: bool) {
        self.is_running &= !is_finished;
    }

    /// Returns the buttons of a loop after `step` steps.
    pub(crate) fn controls(&self, can_run: bool, step: usize, is_finished: bool) -> [Control; 3] {
        [
            RUN.control(can_run, self.is_running),
            STEP.control(can_run && !is_finished, false),
            RESTART.control(step > 0, false),
        ]
    }

    /// Applies a button; returns the step to go to, if any. Running a finished loop restarts it.
    pub(crate) fn press(&mut self, id: &str, step: usize, is_finished: bool) -> Option<usize> {
        let starts = id == RUN.id && !self.is_running;
        self.is_running = starts;
        if starts {
            self.since_step_s = 0.0;
        }
        match id {
            id if id == RUN.id => (starts && is_finished).then_some(0),
            id if id == STEP.id => Some(step + 1),
            _ => Some(0),
        }
    }

    /// Applies a button or a tick; returns the step to go to, if one is due.
    pub(crate) fn update(
        &mut self,
        event: &Event,
        step: usize,
        is_finished: bool,
    ) -> Option<usize> {
        match event {
            Event::Press { id } if [RUN.id, STEP.id, RESTART.id].contains(&&**id) => {
                self.press(id, step, is_finished)
            }
            Event::Tick { dt_s } => self.tick(*dt_s, step),
            _ => None,
        }
    }

    /// Advances the time; returns the step to go to, if one is due.
    pub(crate) fn tick(&mut self, dt_s: f64, step: usize) -> Option<usize> {
        let pause_s = 1.0 / self.steps_per_second;
        self.since_step_s += dt_s;
        let is_due = self.since_step_s >= pause_s;
        if is_due {
            self.since_step_s -= pause_s;
        }
        is_due.then_some(step + 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_loop_runs_pauses_steps_and_starts_over() {
        let mut running = Running::at(4.0);
        assert_eq!(running.press("run", 7, false), None);
        assert!(running.is_running());
        assert_eq!(
            [0.1, 0.1, 0.1].map(|dt_s| running.tick(dt_s, 7)),
            [None, None, Some(8)]
        );
        // The remaining time counts towards the next step.
        assert_eq!(
            [0.1, 0.1].map(|dt_s| running.tick(dt_s, 8)),
            [None, Some(9)]
        );
        assert_eq!(running.press("run", 9, false), None);
        assert!(!running.is_running());
        assert_eq!(running.press("run", 9, true), Some(0));
        assert_eq!(running.press("step", 3, false), Some(4));
        assert!(!running.is_running());
        running.press("run", 4, false);
        running.stop_if(true);
        assert!(!running.is_running());
        assert_eq!(running.press("restart", 4, false), Some(0));
    }

    #[test]
    fn other_events_are_not_for_the_loop() {
        let mut running = Running::at(4.0);
        assert_eq!(running.update(&Event::press("step"), 3, false), Some(4));
        assert_eq!(running.update(&Event::press("recenter"), 3, false), None);
        assert_eq!(running.update(&Event::press("run"), 3, false), None);
        assert!(running.is_running());
        let tick = Event::Tick { dt_s: 0.3 };
        assert_eq!(running.update(&tick, 3, false), Some(4));
        assert_eq!(running.update(&Event::Reset, 4, false), None);
    }
}
