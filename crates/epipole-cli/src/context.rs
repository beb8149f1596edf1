//! Settings shared by all commands.

/// The global options that commands use.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Context {
    /// No progress and no warnings.
    pub(crate) quiet: bool,
    /// Seed of every random choice.
    #[allow(
        dead_code,
        reason = "the figure command has no random choice of its own"
    )]
    pub(crate) seed: u64,
}

impl Context {
    /// Tells the user something that does not stop the work.
    pub(crate) fn warn(&self, sentence: &str) {
        if !self.quiet {
            eprintln!("warning: {sentence}");
        }
    }
}
