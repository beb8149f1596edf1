//! `tournament`: six estimators in many seeded runs at every outlier ratio.

mod model;
mod question;
mod rivals;
mod view;
mod words;

pub(super) use view::TournamentView as View;
