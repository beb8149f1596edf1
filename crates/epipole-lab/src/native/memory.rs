//! Returns freed memory to the system. The allocator of glibc keeps large blocks for reuse, more of
//! them with each one freed: with eleven photographs of 3 megapixels, an idle window held 90 MB of
//! unused memory.

/// Blocks of at least this many bytes are returned as soon as they are freed, see `mallopt(3)`.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const SETTING: (&str, &str) = ("MALLOC_MMAP_THRESHOLD_", "131072");

/// Applies the setting. It is read at program start, so the program first restarts itself in the
/// same process.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
pub(crate) fn give_back() {
    use std::os::unix::process::CommandExt;
    let (name, value) = SETTING;
    if std::env::var_os(name).is_some() {
        return;
    }
    let Ok(program) = std::env::current_exe() else {
        return;
    };
    // Returns only on failure; then the program runs without the setting.
    let _ = std::process::Command::new(program)
        .args(std::env::args_os().skip(1))
        .env(name, value)
        .exec();
}

/// Does nothing: other allocators return memory by themselves.
#[cfg(not(all(target_os = "linux", target_env = "gnu")))]
pub(crate) fn give_back() {}
