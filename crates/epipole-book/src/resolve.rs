//! Answers of the core: figures and their posters, numbers, claims, references.

pub mod claims;
pub mod facts;
pub mod figures;
pub mod numbers;
pub(crate) mod posters;
pub mod references;
pub(crate) mod shared;
