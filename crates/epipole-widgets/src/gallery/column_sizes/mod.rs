//! `column-sizes`: sizes of the nine columns of the equations, in raw pixels and normalized.

mod model;
mod view;
mod words;

pub(super) use view::ColumnSizesView as View;
