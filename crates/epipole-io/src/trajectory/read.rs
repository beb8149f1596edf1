//! Recognition of trajectories.

use super::columns::Columns;
use super::format::TrajectoryFormat;
use super::kitti;
use super::path::Trajectory;
use super::timed::{self, Layout, Unit};
use super::words::words;
use crate::text::{decode, lines};
use crate::{Error, Result};

/// Note on rows of eight values between commas with nanoseconds, but without names.
const W_FIRST: &str = "no line names the columns: quaternions are taken to be w, x, y, z, as EuRoC has them; if w is last, put \
                       the line \"t,x,y,z,qx,qy,qz,qw\" in front";

/// Reads a trajectory, whose format is recognized by its content.
///
/// A first line or a comment may name the columns. Without names, twelve numbers per line are
/// KITTI's; eight or more values are EuRoC's if commas separate them and times are in nanoseconds;
/// otherwise eight are TUM's. The format determines the order of the quaternion. Eight
/// comma-separated values with nanoseconds may be either, and [`Trajectory::notes`] have the
/// choice. Times are in nanoseconds if as seconds they would be beyond 30,000 years, or a day
/// apart. Quaternions are normalized, matrices replaced by the nearest rotation.
///
/// # Errors
/// [`Error::Malformed`] for another file, and with the line for wrong numbers, zero quaternions,
/// matrices that are no rotation, and times that go backwards.
///
/// ```
/// # fn main() -> Result<(), epipole_io::Error> {
/// use epipole_io::trajectory::{TrajectoryFormat, read_trajectory};
/// let text = "# t tx ty tz qx qy qz qw\n1305031102.175304 1.5 0 0 0 0 0 1\n";
/// let (format, trajectory) = read_trajectory(text.as_bytes())?;
/// assert_eq!(format, TrajectoryFormat::Tum);
/// assert_eq!(trajectory.stamps_ns, Some(vec![1_305_031_102_175_304_000]));
/// assert_eq!(trajectory.world_from_cam[0].translation.x, 1.5);
/// # Ok(()) }
/// ```
pub fn read_trajectory(bytes: &[u8]) -> Result<(TrajectoryFormat, Trajectory)> {
    let text = decode(bytes)?;
    decimal_commas(text)?;
    let (format, layout) = recognize(text)?;
    let trajectory = match layout {
        Some(layout) => timed::read(text, &layout),
        None => kitti::read(text),
    }?;
    match trajectory.world_from_cam.is_empty() {
        true => Err(Error::malformed("the trajectory has no poses")),
        false => Ok((format, trajectory)),
    }
}

/// Refuses decimal commas, such as `0,5` between blanks or semicolons.
fn decimal_commas(text: &str) -> Result<()> {
    for (line, content) in lines(text) {
        let fields = content.split(|c: char| c.is_whitespace() || c == ';');
        let is_comma = |word: &&str| {
            word.split_once(',').is_some_and(|(whole, digits)| {
                whole.trim_start_matches('-').parse::<u64>().is_ok()
                    && digits.parse::<u64>().is_ok()
            })
        };
        if fields.clone().filter(|field| !field.is_empty()).count() >= 8
            && let Some(word) = fields.clone().find(is_comma)
        {
            let message = format!("\"{word}\" has a decimal comma: write a point");
            return Err(Error::at(line, message));
        }
    }
    Ok(())
}

/// Returns whether the first line of a file is that of a trajectory, even if the rest is malformed.
pub fn is_trajectory(bytes: &[u8]) -> bool {
    decode(bytes).is_ok_and(|text| recognize(text).is_ok())
}

/// Recognizes the format by column names, the first row and the times. Returns the layout of rows
/// with times.
fn recognize(text: &str) -> Result<(TrajectoryFormat, Option<Layout>)> {
    let is_header = |content: &str| content.starts_with(|c: char| c.is_alphabetic() || c == '%');
    let num_header = lines(text)
        .take_while(|(_, content)| is_header(content))
        .count();
    let mut rows = lines(text).skip(num_header);
    let Some((line, content)) = rows.next() else {
        return Err(without_rows(text));
    };
    let named = (text.lines().take(line - 1))
        .filter_map(Columns::of_names)
        .last();
    let (mut last, mut num_rows) = (content, 1);
    for (_, row) in rows {
        (last, num_rows) = (row, num_rows + 1);
    }
    let place = named.map_or(0, |columns| columns.time);
    let time = |row: &str| {
        let word = words(row).get(place).copied().unwrap_or("");
        word.parse().unwrap_or(0.0)
    };
    let unit = Unit::of_times(time(content), time(last), num_rows);
    let is_euroc = content.contains([',', ';']) && unit == Unit::Nanoseconds;
    let layout = |columns: Columns, max_width: usize, expected: &'static str| {
        let format = match is_euroc && columns == Columns::EUROC {
            true => TrajectoryFormat::EuRoC,
            false => TrajectoryFormat::Tum,
        };
        let is_open = is_euroc && named.is_none() && words(content).len() == 8;
        let layout = Layout {
            columns,
            unit,
            num_header,
            max_width,
            expected,
            note: is_open.then_some(W_FIRST),
        };
        (format, Some(layout))
    };
    match (named, words(content).len()) {
        (Some(columns), _) => Ok(layout(columns, usize::MAX, "values that the header names")),
        (None, 8..) if is_euroc => Ok(layout(
            Columns::EUROC,
            usize::MAX,
            "eight values t, px, py, pz, qw, qx, qy, qz",
        )),
        (None, 12) => Ok((TrajectoryFormat::Kitti, None)),
        (None, 8) => Ok(layout(
            Columns::TUM,
            8,
            "eight values t tx ty tz qx qy qz qw",
        )),
        (None, count) => Err(Error::at(
            line,
            format!(
                "{count} values are no pose: 8 are expected of TUM (t tx ty tz qx qy qz qw) and EuRoC, 12 of KITTI"
            ),
        )),
    }
}

/// Error for a text in which no line begins with a number.
fn without_rows(text: &str) -> Error {
    let mut others = lines(text).filter(|(_, content)| Columns::of_names(content).is_none());
    match others.next() {
        Some((line, content)) => {
            let word = words(content).first().copied().unwrap_or_default();
            Error::at(
                line,
                format!("a pose begins with a number, not with \"{word:.40}\""),
            )
        }
        None => Error::malformed("the trajectory has no poses"),
    }
}

#[cfg(test)]
mod tests {
    use super::super::write_trajectory;
    use super::*;
    use epipole::camera::RigidTransform;
    use nalgebra::Vector3;

    fn read(text: &str) -> Result<(TrajectoryFormat, Trajectory)> {
        read_trajectory(text.as_bytes())
    }

    fn path() -> Trajectory {
        let pose = |i: i64| {
            let i = i as f64;
            let rotation_vector = Vector3::new(0.1 * i, -0.2, 0.05 * i * i);
            RigidTransform::new(Vector3::new(0.1 * i, 1.0 / 3.0, -1e-7 * i), rotation_vector)
        };
        Trajectory {
            stamps_ns: Some(
                (0..20)
                    .map(|i| 1_403_636_579_763_555_584 + i * 50_000_001)
                    .collect(),
            ),
            world_from_cam: (0..20).map(pose).collect(),
            ..Trajectory::default()
        }
    }

    #[test]
    fn what_is_written_is_read() {
        let path = path();
        for format in [
            TrajectoryFormat::Tum,
            TrajectoryFormat::EuRoC,
            TrajectoryFormat::Kitti,
        ] {
            let text = write_trajectory(format, &path).unwrap();
            let (found, again) = read(&text).unwrap();
            assert_eq!(found, format);
            if format != TrajectoryFormat::Kitti {
                assert_eq!(again.stamps_ns, path.stamps_ns);
            }
            for (a, b) in again.world_from_cam.iter().zip(&path.world_from_cam) {
                assert_eq!(a.translation, b.translation);
                assert!((a.to_homogeneous() - b.to_homogeneous()).amax() < 1e-15);
            }
        }
        let (_, kitti) = read(&write_trajectory(TrajectoryFormat::Kitti, &path).unwrap()).unwrap();
        let error = write_trajectory(TrajectoryFormat::Tum, &kitti).unwrap_err();
        assert!(matches!(error, Error::Unsupported { .. }));
    }

    #[test]
    fn the_quaternion_of_euroc_begins_with_w() {
        let text = "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z [], v\n\
            1403636580838555648,4.688319,-1.786938,0.783338,0.534108,-0.153029,-0.827383,-0.082152,-0.027876,0.033207,0.800006,-0.003172,0.021267,0.078502,-0.025266,0.136696,0.075593\r\n";
        let (format, path) = read(text).unwrap();
        assert_eq!(format, TrajectoryFormat::EuRoC);
        let q = path.world_from_cam[0].rotation;
        assert!((q.w - 0.534108).abs() < 1e-6 && (q.j + 0.827383).abs() < 1e-6);
        // Commas alone do not mean EuRoC's format.
        let (format, path) = read("0.5,1,2,3,0,0,0,1\n").unwrap();
        assert_eq!(
            (format, path.world_from_cam[0].rotation.w),
            (TrajectoryFormat::Tum, 1.0)
        );
    }

    #[test]
    fn order_and_unit_follow_from_names_and_times() {
        // Whole seconds between commas are TUM's.
        let (format, path) = read("0,1,2,3,0,0,0.6,0.8\n1,1,2,3,0,0,0,1\n").unwrap();
        assert_eq!(format, TrajectoryFormat::Tum);
        assert_eq!(path.stamps_ns, Some(vec![0, 1_000_000_000]));
        assert!((path.world_from_cam[0].rotation.w - 0.8).abs() < 1e-15);
        // Nanoseconds that begin at 0.
        let (format, path) = read("0,0,0,0,0.8,0,0,0.6\n5000000,0,0,0,1,0,0,0\n").unwrap();
        assert_eq!(format, TrajectoryFormat::EuRoC);
        assert_eq!(path.stamps_ns, Some(vec![0, 5_000_000]));
        assert!((path.world_from_cam[0].rotation.k - 0.6).abs() < 1e-15);
        // The same values in TUM's order: a header decides; without one there is a note.
        assert!(path.notes[0].contains("w, x, y, z"), "{:?}", path.notes);
        let named = "t,x,y,z,qx,qy,qz,qw\n0,0,0,0,0.8,0,0,0.6\n5000000,0,0,0,1,0,0,0\n";
        let (format, path) = read(named).unwrap();
        assert_eq!((format, path.notes.len()), (TrajectoryFormat::Tum, 0));
        assert!((path.world_from_cam[0].rotation.i - 0.8).abs() < 1e-15);
        // Output of ORB-SLAM3 for EuRoC: TUM's columns, nanoseconds.
        let slam = "1403636579763555584.000000 1 2 3 0 0 0.6 0.8\n1403636579813555456.000000 1 2 3 0 0 0.6 0.8\n";
        let (format, path) = read(slam).unwrap();
        assert_eq!(format, TrajectoryFormat::Tum);
        assert_eq!(path.stamps_ns.unwrap()[0], 1_403_636_579_763_555_584);
        assert!((path.world_from_cam[0].rotation.w - 0.8).abs() < 1e-15);
        // A numbered table with w first and velocities at the end.
        let table = "num,t,x,y,z,qw,qx,qy,qz,vx\n1,0.5,1,2,3,0.8,0,0,0.6,9\n";
        let (_, path) = read(table).unwrap();
        assert_eq!(path.stamps_ns, Some(vec![500_000_000]));
        assert_eq!(path.world_from_cam[0].translation.z, 3.0);
        assert!((path.world_from_cam[0].rotation.k - 0.6).abs() < 1e-15);
        // KITTI's matrices between commas.
        let (format, _) = read("1,0,0,0,0,1,0,0,0,0,1,5\n").unwrap();
        assert_eq!(format, TrajectoryFormat::Kitti);
    }

    #[test]
    fn errors_name_the_line() {
        for (text, message) in [
            ("", "the trajectory has no poses"),
            ("t,x,y,z,qx,qy,qz,qw\n", "the trajectory has no poses"),
            (
                "# centers\nframe1.jpg -0.55 0 -0.3\n",
                "line 2: a pose begins with a number, not with \"frame1.jpg\"",
            ),
            (
                "1 2 3\n",
                "line 1: 3 values are no pose: 8 are expected of TUM (t tx ty tz qx qy qz qw) and EuRoC, 12 of KITTI",
            ),
            (
                "# t\n0 0 0 0 0 0 0 1\n1 0 0 0 0 0 1\n",
                "line 3: not the eight values t tx ty tz qx qy qz qw: \"1 0 0 0 0 0 1\"",
            ),
            (
                "0 0 0 0 0 0 0 1\n1 -0,5 0 0 0 0 0 1\n",
                "line 2: \"-0,5\" has a decimal comma: write a point",
            ),
            (
                "0;0,5;0;0;0;0;0;1\n",
                "line 1: \"0,5\" has a decimal comma: write a point",
            ),
            ("0 0 0 x 0 0 0 1\n", "line 1: \"x\" is not a number"),
            (
                "0 0 0 0 0 0 0 0\n",
                "line 1: the quaternion is zero: it is no rotation",
            ),
            (
                "2 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n",
                "line 2: time goes backwards, from 2.0 s to 1.0 s: sort the poses by time",
            ),
            (
                "1 0 0 0 0 1 0 0 0 0 -1 0\n",
                "line 1: columns 1 to 3, 5 to 7 and 9 to 11 are not a rotation",
            ),
            (
                "5.5,0,0,0,1,0,0,0\n5000000000,0,0,0,1,0,0,0\n",
                "line 1: \"5.5\" is not a whole number of nanoseconds",
            ),
            (
                "num t x y z qx qy qz qw\n1 0 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n",
                "line 3: not the values that the header names: \"2 0 0 0 0 0 0 1\"",
            ),
        ] {
            assert_eq!(read(text).unwrap_err().to_string(), message, "{text}");
        }
    }
}
