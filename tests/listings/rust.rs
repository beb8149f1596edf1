//! Runs the Rust listings of the chapters and compares their output with `content/listings/`.
//! `make bless-listings` records it anew.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use epipole_tests::root;
use std::cell::RefCell;
use std::panic::catch_unwind;
use std::{env, fs};

/// A listing of a chapter.
struct Listing {
    chapter: &'static str,
    /// Empty for a block outside of `{{#listing}}`, whose output is not recorded.
    name: &'static str,
    line: usize,
    run: fn(),
}

/// Return type of a listing's `main`.
trait Ended {
    fn check(self);
}

impl Ended for () {
    fn check(self) {}
}

impl<E: std::fmt::Display> Ended for Result<(), E> {
    fn check(self) {
        if let Err(error) = self {
            panic!("{error}");
        }
    }
}

thread_local! {
    static PRINTED: RefCell<String> = const { RefCell::new(String::new()) };
}

fn print(line: String) {
    PRINTED.with_borrow_mut(|printed| *printed += &(line + "\n"));
}

/// Shadows the standard macro in listings, to record their output.
macro_rules! println {
    ($($words:tt)*) => {
        crate::print(format!($($words)*))
    };
}

include!(concat!(env!("OUT_DIR"), "/listings.rs"));

#[test]
fn rust_listings_run_and_print_what_is_recorded() {
    let bless = env::var_os("EPIPOLE_BLESS").is_some();
    let mut failed = Vec::new();
    for Listing {
        chapter,
        name,
        line,
        run,
    } in LISTINGS
    {
        PRINTED.take();
        if catch_unwind(run).is_err() {
            failed.push(format!("content/{chapter}.md:{line}: it panics, see above"));
            continue;
        }
        let printed = PRINTED.take();
        if name.is_empty() {
            continue;
        }
        let path = root().join(format!("content/listings/{chapter}.{name}.rust.txt"));
        if bless {
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(&path, &printed).unwrap();
        }
        let recorded = fs::read_to_string(&path).unwrap_or_default();
        if recorded != printed {
            failed.push(format!(
                "content/{chapter}.md:{line}: it prints\n{printed}recorded is\n{recorded}"
            ));
        }
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
    assert!(LISTINGS.len() > 6, "{} listings", LISTINGS.len());
}
