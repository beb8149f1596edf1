//! Content-Security-Policies of the pages.

macro_rules! policy {
    ($connect:literal, $more:literal) => {
        concat!(
            "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; ",
            "img-src 'self' data: blob:; font-src 'self'; connect-src 'self'",
            $connect,
            "; worker-src 'self'; ",
            "manifest-src 'self'; base-uri 'none'; form-action 'none'",
            $more
        )
    };
}

/// What a page may load and do. Sent as a header by `serve`, and part of every page.
pub const CONTENT_SECURITY_POLICY: &str = policy!("", "");

/// The same for pages that stand in frames of other pages. In a page itself browsers would ignore the last part.
pub const FRAME_POLICY: &str = policy!("", "; frame-ancestors *");

/// The same for the Lab, which also opens the reader's own videos, and whose workers learn from an address of the page
/// whether their work is still wanted.
pub const LAB_POLICY: &str = policy!(" blob:", "; media-src blob:");
