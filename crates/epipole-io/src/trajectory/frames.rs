//! Times of video frames, from their names.

use super::stamp::{check_order, decimal, from_nanoseconds};

/// Returns the times of frames, nanoseconds, if all names are numbers in non-descending order:
/// `1305031102.175304.png` (seconds, TUM RGB-D), `1403636579763555584.png` (nanoseconds, EuRoC). A
/// number beyond 292 years as seconds is in nanoseconds. Numbers that only count the frames
/// (`000012.png`) become seconds.
///
/// * `names`: names of files; folders are ignored
///
/// ```
/// use epipole_io::trajectory::frame_stamps_ns;
/// let names = ["rgb/1305031102.175304.png", "rgb/1305031102.211214.png"];
/// let stamps = frame_stamps_ns(&names);
/// assert_eq!(stamps, Some(vec![1_305_031_102_175_304_000, 1_305_031_102_211_214_000]));
/// assert_eq!(frame_stamps_ns(&["frame1.png", "frame2.png"]), None);
/// ```
pub fn frame_stamps_ns(names: &[impl AsRef<str>]) -> Option<Vec<i64>> {
    let stamp = |name: &str| {
        let file = name.rsplit(['/', '\\']).next().unwrap_or(name);
        let stem = file.rsplit_once('.').map_or(file, |(stem, _)| stem);
        decimal(stem).or_else(|| from_nanoseconds(0, stem).ok())
    };
    let stamps: Option<Vec<i64>> = names.iter().map(|name| stamp(name.as_ref())).collect();
    let stamps = stamps?;
    let numbered: Vec<(usize, i64)> = stamps.iter().copied().enumerate().collect();
    check_order(&numbered).ok().map(|()| stamps)
}

#[cfg(test)]
mod tests {
    use super::frame_stamps_ns;

    #[test]
    fn names_of_frames_are_their_times() {
        let of = |names: &[&str]| frame_stamps_ns(names);
        let ns = 1_403_636_579_763_555_584;
        assert_eq!(of(&["cam0/1403636579763555584.png"]), Some(vec![ns]));
        let counted = of(&["000009.png", "000010.png"]);
        assert_eq!(counted, Some(vec![9_000_000_000, 10_000_000_000]));
        assert_eq!(of(&["2.png", "1.png"]), None, "time goes backwards");
        assert_eq!(of(&["1.png", "b.png"]), None);
        assert_eq!(of(&["99999999999999999999.png"]), None);
        assert_eq!(of(&[]), Some(Vec::new()));
    }
}
