//! `column-sizes`: how large the nine columns of the equations are, in raw pixels and normalized.

mod model;
mod view;
mod words;

pub(super) use view::ColumnSizesView as View;
