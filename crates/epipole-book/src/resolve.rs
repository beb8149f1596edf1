//! Data from the core: figures and their posters, claims, numbers, references.

pub(crate) mod book;
pub(crate) mod cache;
pub mod claims;
pub mod facts;
pub mod figures;
pub mod numbers;
pub(crate) mod posters;
pub mod references;
