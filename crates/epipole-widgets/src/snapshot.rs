//! Snapshot of everything that a page shows beside the picture, as plain data for pages in the
//! browser and for prerendered pages.

use crate::contract::{
    Aspect, ChallengeStatus, Control, FileOffer, Handle, Layout, PhotoSlot, PlacedSymbol, Readout,
    Space,
};
use crate::{Figure, pointing};
use serde::Serialize;

/// A figure's current state, laid out for a page width.
#[derive(Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Snapshot {
    layout: Layout,
    aspect: Aspect,
    controls: Vec<Control>,
    handles: Vec<PlacedHandle>,
    spaces: Vec<Space>,
    symbols: Vec<PlacedSymbol>,
    readouts: Vec<Readout>,
    challenges: Vec<ChallengeStatus>,
    description: String,
    running: bool,
    photos: &'static [PhotoSlot],
    /// Photographs of the reader's own have still to be chosen.
    wants_photos: bool,
    /// File that can be saved besides the picture.
    file: Option<FileOffer>,
    /// Status while the figure waits for a long computation.
    waiting: Option<&'static str>,
}

/// A handle with its position on the page, CSS pixels.
#[derive(Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[cfg_attr(test, ts(rename = "Handle"))]
pub(crate) struct PlacedHandle {
    #[serde(flatten)]
    handle: Handle,
    place: (f64, f64),
}

impl Snapshot {
    /// Takes a snapshot of a figure whose picture is `width` CSS pixels wide.
    pub fn of(figure: &mut Figure, width: f64) -> Self {
        let layout = figure.layout(width);
        let place = |handle: Handle| PlacedHandle {
            place: pointing::place_of(&handle, &layout),
            handle,
        };
        Self {
            aspect: figure.aspect(),
            controls: figure.controls(),
            handles: figure.handles().into_iter().map(place).collect(),
            spaces: figure.spaces(),
            symbols: figure
                .symbols()
                .iter()
                .filter_map(|symbol| symbol.placed(&layout))
                .collect(),
            readouts: figure.readouts(),
            challenges: figure.challenges(),
            description: figure.describe(),
            running: figure.is_running(),
            photos: figure.photo_slots(),
            wants_photos: figure.wants_photos(),
            file: figure.file(),
            waiting: figure.job().map(|job| job.label()),
            layout,
        }
    }
}
