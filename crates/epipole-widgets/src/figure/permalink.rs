//! Conversion between state and parameters, for permalinks, attributes and chapters.

use super::Figure;
use super::untouched::Untouched;
use crate::contract::{ControlKind, Event, Handle, Place, Problem, Value, parse_decimal};

/// Parameter value of a handle that the reader has removed.
const REMOVED: &str = "removed";

impl Figure {
    /// Returns the parameters that differ from the default state.
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
            if control.place != Place::Hidden {
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

    /// Returns the default state with some controls set to values of this figure.
    fn untouched_with(&self, controls: &[(String, String)]) -> Untouched {
        let mut stage = (self.entry.make)();
        for (id, value) in controls {
            let id = id.clone();
            let value = Value::from(&**value);
            // The values come from this figure, so they are valid.
            let _ = stage.model_mut().update(&Event::Set { id, value });
        }
        Untouched {
            controls: controls.to_vec(),
            handles: stage.model().handles(),
        }
    }

    /// Returns the state as the query of a URL; empty in the default state.
    pub fn query(&self) -> String {
        let pairs: Vec<String> = self
            .state()
            .into_iter()
            .map(|(key, value)| format!("{key}={value}"))
            .collect();
        pairs.join("&")
    }

    /// Applies parameters to the current state: controls first, then handles, then hidden controls.
    /// Invalid parameters are skipped; their problems are returned.
    pub fn apply(&mut self, parameters: &[(String, String)]) -> Vec<Problem> {
        let mut problems = Vec::new();
        let rank = |figure: &Self, key: &str| {
            let control = figure
                .controls()
                .into_iter()
                .find(|control| control.id == key);
            control.map_or(
                1,
                |control| if control.place == Place::Hidden { 2 } else { 0 },
            )
        };
        let ranked: Vec<(i32, &(String, String))> = parameters
            .iter()
            .map(|pair| (rank(self, &pair.0), pair))
            .collect();
        let in_turn = (0..3).flat_map(|turn| ranked.iter().filter(move |(rank, _)| *rank == turn));
        for (rank, (key, value)) in in_turn {
            let done = if *rank == 1 {
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
        let place = value
            .split_once(',')
            .and_then(|(x, y)| Some((parse_decimal(x)?, parse_decimal(y)?)));
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
            (false, Some((x, y))) if self.stage.model_mut().restore_handle(id, x, y) => Ok(()),
            (false, _) => Err(self.unknown(id)),
        }
    }
}
