//! `scale-ambiguity`: a larger house from a longer baseline makes the same two photographs.

mod model;
mod view;
mod words;

pub(super) use view::ScaleAmbiguityView as View;
