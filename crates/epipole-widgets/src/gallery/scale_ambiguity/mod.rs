//! `scale-ambiguity`: a larger house with a longer baseline gives the same two photographs.

mod model;
mod view;
mod words;

pub(super) use view::ScaleAmbiguityView as View;
