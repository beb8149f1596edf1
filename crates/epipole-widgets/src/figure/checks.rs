//! Validation of events before they reach a model: unknown names, invalid numbers, positions out of
//! range.

use super::{Figure, POSTER_WIDTH};
use crate::contract::{Control, ControlKind, Event, Problem};

impl Figure {
    /// Applies an event. After an error, the figure is unchanged.
    ///
    /// # Errors
    /// A message for the reader: an unknown name, an invalid value, or a failed
    /// computation.
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
                    self.stage.model_mut().update(event)
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
                    Some(button) if button.enabled => self.stage.model_mut().update(event),
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
                self.stage.model_mut().update(&Event::HandleMoved {
                    id: id.clone(),
                    x,
                    y,
                })
            }
            Event::HandleRemoved { id } => {
                match self.handles().iter().find(|handle| handle.id == *id) {
                    Some(handle) if handle.removable => self.stage.model_mut().update(event),
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
                self.stage.model_mut().update(&Event::Clicked {
                    panel: id.clone(),
                    x: within(*x, panel.x_axis.start, panel.x_axis.end),
                    y: within(*y, panel.y_axis.start, panel.y_axis.end),
                })
            }
            Event::Tick { dt_s } => {
                // A page in the background reports minutes when it returns; animations must not
                // jump.
                let dt_s = if dt_s.is_finite() {
                    dt_s.clamp(0.0, 0.1)
                } else {
                    0.0
                };
                if self.is_running() {
                    self.stage.model_mut().update(&Event::Tick { dt_s })
                } else {
                    Ok(())
                }
            }
        }
    }

    pub(super) fn unknown(&self, name: &str) -> Problem {
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
}

fn place_problem(name: &str, x: f64, y: f64) -> Problem {
    Problem::BadValue {
        name: name.to_owned(),
        value: format!("{x},{y}"),
        expected: "two finite numbers".to_owned(),
    }
}
