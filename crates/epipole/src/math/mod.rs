//! Small mathematics that every room needs.

pub mod random;
