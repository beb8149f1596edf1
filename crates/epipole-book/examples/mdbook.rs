//! Builds an mdBook by mdBook's own renderer, as `mdbook build` does: the recipe for mdBook is
//! tested with it.
//!
//! `cargo run --example mdbook -- FOLDER`

use anyhow::{Context, Result};
use mdbook_driver::MDBook;

fn main() -> Result<()> {
    let folder = std::env::args()
        .nth(1)
        .context("name the folder with book.toml")?;
    MDBook::load(folder)?.build()
}
