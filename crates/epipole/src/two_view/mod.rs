//! Two views, whatever they show.
