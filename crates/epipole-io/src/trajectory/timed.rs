//! Rows of a time, a position and a quaternion: TUM's and EuRoC's files, and similar tables.

use super::columns::Columns;
use super::path::Trajectory;
use super::stamp::{check_order, from_nanoseconds, from_seconds};
use super::words::{pose, words};
use crate::text::lines;
use crate::{Error, Result};

/// Unit of the times.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Unit {
    Seconds,
    Nanoseconds,
}

impl Unit {
    /// Returns nanoseconds if times as seconds would reach 30,000 years, or rows would be over a
    /// day apart.
    pub(super) fn of_times(first: f64, last: f64, num_rows: usize) -> Self {
        let step = (last - first).abs() / num_rows.saturating_sub(1).max(1) as f64;
        match last.abs() >= 1e12 || step >= 1e5 {
            true => Self::Nanoseconds,
            false => Self::Seconds,
        }
    }
}

/// Arrangement of the rows of a file.
#[derive(Debug, Clone, Copy)]
pub(super) struct Layout {
    pub(super) columns: Columns,
    pub(super) unit: Unit,
    /// Lines of names at the start.
    pub(super) num_header: usize,
    /// Largest number of values in a row.
    pub(super) max_width: usize,
    /// The columns in words, for errors.
    pub(super) expected: &'static str,
    /// Note on an assumed order.
    pub(super) note: Option<&'static str>,
}

pub(super) fn read(text: &str, layout: &Layout) -> Result<Trajectory> {
    let columns = &layout.columns;
    let mut stamps = Vec::new();
    let mut world_from_cam = Vec::new();
    for (line, content) in lines(text).skip(layout.num_header) {
        let words = words(content);
        if !(columns.width()..=layout.max_width).contains(&words.len()) {
            let message = format!("not the {}: \"{content:.60}\"", layout.expected);
            return Err(Error::at(line, message));
        }
        let time = words[columns.time];
        let stamp = match layout.unit {
            Unit::Seconds => from_seconds(line, time)?,
            Unit::Nanoseconds => from_nanoseconds(line, time)?,
        };
        stamps.push((line, stamp));
        let position = columns.position.map(|place| words[place]);
        let quaternion = columns.quaternion.map(|place| words[place]);
        world_from_cam.push(pose(line, &position, quaternion)?);
    }
    check_order(&stamps)?;
    Ok(Trajectory {
        stamps_ns: Some(stamps.iter().map(|(_, stamp)| *stamp).collect()),
        world_from_cam,
        notes: layout.note.map(str::to_owned).into_iter().collect(),
    })
}
