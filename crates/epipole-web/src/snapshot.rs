//! Everything that a page shows beside the picture, as one piece of JSON.

use epipole_widgets::contract::{Control, Handle, Layout, PhotoSlot, Problem, Readout, Space};
use epipole_widgets::{ChallengeStatus, Figure, pointing};
use serde::Serialize;
use serde_json::ser::Formatter;
use std::io::{self, Write};

/// A figure's present state, laid out for a width of the page.
#[derive(Serialize)]
pub(crate) struct Snapshot {
    layout: Layout,
    controls: Vec<Control>,
    handles: Vec<PlacedHandle>,
    spaces: &'static [Space],
    readouts: Vec<Readout>,
    challenges: Vec<ChallengeStatus>,
    description: String,
    running: bool,
    photos: &'static [PhotoSlot],
    /// What to say while the figure waits for a long computation.
    waiting: Option<&'static str>,
}

/// A handle and where it is on the page, CSS pixels.
#[derive(Serialize)]
struct PlacedHandle {
    #[serde(flatten)]
    handle: Handle,
    place: (f64, f64),
}

impl Snapshot {
    pub(crate) fn of(figure: &Figure, width: f64) -> Self {
        let layout = figure.layout(width);
        let place = |handle: Handle| PlacedHandle {
            place: pointing::place_of(&handle, &layout),
            handle,
        };
        Self {
            controls: figure.controls(),
            handles: figure.handles().into_iter().map(place).collect(),
            spaces: figure.spaces(),
            readouts: figure.readouts(),
            challenges: figure.challenges(),
            description: figure.describe(),
            running: figure.is_running(),
            photos: figure.photo_slots(),
            waiting: figure.job().map(|job| job.label),
            layout,
        }
    }
}

/// A figure's entry in the list of all.
#[derive(Serialize)]
pub(crate) struct Listed {
    pub(crate) name: &'static str,
    pub(crate) title: &'static str,
    pub(crate) help: &'static str,
}

/// A parameter that could not be used.
#[derive(Serialize)]
pub(crate) struct Refused {
    /// True if the figure has no such parameter: in a page's address it may be someone else's.
    unknown: bool,
    message: String,
}

impl Refused {
    pub(crate) fn from(problem: &Problem) -> Self {
        Self {
            unknown: matches!(problem, Problem::UnknownParameter { .. }),
            message: problem.to_string(),
        }
    }
}

/// JSON of plain data of this crate.
pub(crate) fn json<T: Serialize>(value: &T) -> String {
    let mut text = Vec::with_capacity(4096);
    let mut serializer = serde_json::Serializer::with_formatter(&mut text, Plain);
    // Only a map with keys that are no strings, or a failing `Serialize`, could fail; there is none.
    let written = value.serialize(&mut serializer);
    debug_assert!(written.is_ok());
    String::from_utf8(text).unwrap_or_default()
}

/// Numbers as the rest of the module writes them: a second printer of floating-point numbers, with
/// its tables, would be a good part of the module.
struct Plain;

impl Formatter for Plain {
    fn write_f64<W: ?Sized + Write>(&mut self, writer: &mut W, value: f64) -> io::Result<()> {
        write!(writer, "{value}")
    }
}
