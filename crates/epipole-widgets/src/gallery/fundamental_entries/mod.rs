//! `fundamental-entries`: the nine entries of F, changed one by one, and the epipolar lines.

mod entries;
mod model;
mod view;
mod words;

pub(super) use view::FundamentalEntriesView as View;
