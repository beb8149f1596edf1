//! The contract of a figure: plain data for controls, pages, posters, permalinks, tests and the
//! command line.

mod challenge;
mod control;
mod data;
mod decimal;
mod event;
mod file;
mod handle;
mod job;
mod knob;
mod layout;
mod model;
mod problem;
mod readout;
mod settings;
mod space;
mod symbol;
mod view;
mod words;

pub use challenge::{Challenge, ChallengeStatus};
pub(crate) use control::round_to_digits;
pub use control::{Button, ButtonRole, Choice, Control, ControlKind, Place, Slider, Toggle};
pub(crate) use data::match_data;
pub use data::{CameraData, Data, Datum};
pub(crate) use decimal::parse_decimal;
pub use epipole_canvas::Rect;
pub use event::{Event, Value};
pub use file::FileOffer;
pub use handle::Handle;
pub use job::{Asking, Compute, Job, JobResult, PhotoSlot, Progress};
pub use knob::Knob;
pub(crate) use knob::knobs;
pub use layout::{Axis, Layout, Panel, WIDTHS};
pub use model::{Declared, Model};
pub use problem::{Problem, Refused};
pub use readout::{Readout, ReadoutValue, format_number};
pub use settings::Settings;
pub use space::Space;
pub use symbol::{Mark, PlacedSymbol, Symbol};
pub use view::{Aspect, View};
pub use words::Words;
