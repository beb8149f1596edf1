//! Settings shared by all commands.

/// Global options that commands use.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Context {
    /// Whether progress and warnings are suppressed.
    pub(crate) quiet: bool,
    /// Seed of every random choice.
    #[allow(
        dead_code,
        reason = "the figure command has no random choice of its own"
    )]
    pub(crate) seed: u64,
}

impl Context {
    /// Prints a warning, unless `--quiet`.
    pub(crate) fn warn(&self, sentence: &str) {
        if !self.quiet {
            eprintln!("warning: {sentence}");
        }
    }
}
