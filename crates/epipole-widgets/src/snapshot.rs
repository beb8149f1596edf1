//! Everything that a page shows beside the picture, as one piece of plain data: the page in a browser
//! and the builder of pages, which writes it without one, take it from here.

use crate::contract::{
    Aspect, ChallengeStatus, Control, FileOffer, Handle, Layout, PhotoSlot, PlacedSymbol, Readout,
    Space,
};
use crate::{Figure, pointing};
use serde::Serialize;

/// A figure's present state, laid out for a width of the page.
#[derive(Serialize)]
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
    /// What can be saved besides the picture.
    file: Option<FileOffer>,
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
    /// The present state of a figure whose picture is `width` CSS pixels wide.
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
            file: figure.file(),
            waiting: figure.job().map(|job| job.label()),
            layout,
        }
    }
}
