//! Content-Security-Policies of the pages.

macro_rules! policy {
    ($connect:literal, $worker:literal, $more:literal) => {
        concat!(
            "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; ",
            "img-src 'self' data: blob:; font-src 'self'; connect-src 'self'",
            $connect,
            "; worker-src 'self'",
            $worker,
            "; ",
            "manifest-src 'self'; base-uri 'none'; form-action 'none'",
            $more
        )
    };
}

/// Content-Security-Policy of a page, and part of the others.
pub const CONTENT_SECURITY_POLICY: &str = policy!("", "", "");

/// The same for pages with code that readers edit and run, in a worker whose script is a blob. The
/// worker's script inherits this policy, so it cannot evaluate text or load from other origins.
pub const PROGRAM_POLICY: &str = policy!("", " blob:", "");

/// The same for pages inside frames on other pages. Browsers ignore the last directive in the page
/// itself.
pub const FRAME_POLICY: &str = policy!("", "", "; frame-ancestors *");

/// The same for the Lab, which also opens the reader's own videos, and whose workers check a URL of
/// the page for cancellation.
pub const LAB_POLICY: &str = policy!(" blob:", "", "; media-src blob:");

/// Content-Security-Policy of the manual of the Python package and of the reference of the npm
/// package, whose themes have inline scripts and styles.
pub const MANUAL_POLICY: &str = concat!(
    "default-src 'none'; script-src 'self' 'unsafe-inline'; style-src 'self' 'unsafe-inline'; ",
    "img-src 'self' data:; font-src 'self'; connect-src 'self'; worker-src 'self'; ",
    "base-uri 'none'; form-action 'none'"
);
