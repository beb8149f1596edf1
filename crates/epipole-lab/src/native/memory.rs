//! What is let go of goes back to the system. The allocator of glibc keeps large pieces for the next ones, more of them
//! with each that is freed: with eleven photographs of 3 megapixels, a window at rest held 90 MB that nobody used.

/// Pieces of at least so many bytes are given back as soon as they are freed, as `mallopt(3)` says.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const SETTING: (&str, &str) = ("MALLOC_MMAP_THRESHOLD_", "131072");

/// Sees to that. The setting is read when a program begins, so the first thing that this one does is to begin anew, in the
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
    // Returns only if it fails, and then it goes on without.
    let _ = std::process::Command::new(program)
        .args(std::env::args_os().skip(1))
        .env(name, value)
        .exec();
}

/// Other systems do so by themselves.
#[cfg(not(all(target_os = "linux", target_env = "gnu")))]
pub(crate) fn give_back() {}
