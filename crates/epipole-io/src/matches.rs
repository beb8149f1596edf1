//! Points and matches: one per line, numbers in columns.

use crate::text::{decode, lines};
use crate::{Result, table};
use nalgebra::{Point2, Point3};
use std::borrow::Cow;
use std::fmt::Display;

/// Reads matches of two images: `u1 v1 u2 v2` per line, pixels.
///
/// Numbers are separated by commas, semicolons, tabs or spaces, and may be in quotes or brackets;
/// decimal commas are read with semicolons or tabs. `#` begins a comment. A header, `u1 v1 u2 v2`
/// or `x1 y1 x2 y2`, allows any order; without one, columns after the fourth are ignored.
///
/// Returns the pixels in the first image and those in the second.
///
/// # Errors
/// [`Error::Malformed`](crate::Error::Malformed) with the line of a missing number, NaN or an
/// ambiguous comma, for a first column that counts the rows, and for a file that is not text.
/// Infinite coordinates are read.
///
/// ```
/// use epipole_io::matches::read_matches;
/// use nalgebra::Point2;
/// let [pixels1, pixels2] = read_matches(b"id;u1;v1;u2;v2\n7;10,5;20;30;40,25\n")?;
/// assert_eq!(pixels1, [Point2::new(10.5, 20.0)]);
/// assert_eq!(pixels2, [Point2::new(30.0, 40.25)]);
/// # Ok::<(), epipole_io::Error>(())
/// ```
pub fn read_matches(bytes: &[u8]) -> Result<[Vec<Point2<f64>>; 2]> {
    let names = [["u1", "v1", "u2", "v2"], ["x1", "y1", "x2", "y2"]];
    let rows = table::read(bytes, &names)?;
    Ok([
        rows.iter().map(|row| Point2::new(row[0], row[1])).collect(),
        rows.iter().map(|row| Point2::new(row[2], row[3])).collect(),
    ])
}

/// Reads points of an image: `u v` per line, pixels. The columns may be named `u v` or `x y`, or as
/// those of matches, of which the first image is read.
///
/// # Errors
/// As [`read_matches`].
pub fn read_points(bytes: &[u8]) -> Result<Vec<Point2<f64>>> {
    let rows = table::read(bytes, &table::PIXELS)?;
    Ok(rows.iter().map(|row| Point2::new(row[0], row[1])).collect())
}

/// Pixels and the world points seen there.
pub type PixelsAndPoints = (Vec<Point2<f64>>, Vec<Point3<f64>>);

/// Reads world points with their pixels: `x y z u v` per line. A header with these names allows any
/// order; a first line of four numbers, such as fx fy cx cy, is skipped.
///
/// Returns pixels and points, in the unit of the file.
///
/// # Errors
/// As [`read_matches`].
///
/// ```
/// use epipole_io::matches::read_points_with_pixels;
/// let (pixels, points) = read_points_with_pixels(b"u,v,X,Y,Z\n320,240,1,2,3\n")?;
/// assert_eq!((pixels[0].x, points[0].z), (320.0, 3.0));
/// assert_eq!(read_points_with_pixels(b"1 2 3 320 240\n")?, (pixels, points));
/// # Ok::<(), epipole_io::Error>(())
/// ```
pub fn read_points_with_pixels(bytes: &[u8]) -> Result<PixelsAndPoints> {
    let text = decode(bytes)?;
    let rows = table::read(
        without_intrinsics(text).as_bytes(),
        &[["x", "y", "z", "u", "v"]],
    )?;
    let point = |row: &[f64; 5]| Point3::new(row[0], row[1], row[2]);
    Ok((
        rows.iter().map(|row| Point2::new(row[3], row[4])).collect(),
        rows.iter().map(point).collect(),
    ))
}

/// Makes the first line a comment, if it has four numbers and the next line has more.
fn without_intrinsics(text: &str) -> Cow<'_, str> {
    let count = |line: &str| {
        let words = line.split(|c: char| c.is_whitespace() || c == ',' || c == ';');
        let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
        let are_numbers = words.iter().all(|word| word.parse::<f64>().is_ok());
        are_numbers.then_some(words.len())
    };
    let mut filled = lines(text);
    match (filled.next(), filled.next()) {
        (Some((number, first)), Some((_, next)))
            if count(first) == Some(4) && count(next).is_some_and(|count| count > 4) =>
        {
            let retained = text.lines().enumerate();
            let retained =
                retained.map(|(index, line)| if index + 1 == number { "#" } else { line });
            retained
                .flat_map(|line| [line, "\n"])
                .collect::<String>()
                .into()
        }
        _ => text.into(),
    }
}

/// Separator and header of a file of matches.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MatchLayout {
    /// Blanks, and the names of the columns in a comment.
    Text,
    /// Commas, and the names of the columns in the first line.
    Csv,
}

/// Writes matches with the distance of their descriptors and its ratio to the second nearest: `u1
/// v1 u2 v2 distance ratio` per line, or `u1 v1 u2 v2` if none are given.
///
/// ```
/// use epipole_io::matches::{MatchLayout, read_matches, write_matches};
/// use nalgebra::Point2;
/// let [a, b] = [[Point2::new(1.5, 2.0)], [Point2::new(3.0, 0.1)]];
/// let text = write_matches(MatchLayout::Csv, [&a, &b], &[[0.25, 0.5]]);
/// assert_eq!(text, "u1,v1,u2,v2,distance,ratio\n1.5,2,3,0.1,0.25,0.5\n");
/// assert_eq!(read_matches(text.as_bytes())?, [a.to_vec(), b.to_vec()]);
/// # Ok::<(), epipole_io::Error>(())
/// ```
pub fn write_matches(
    layout: MatchLayout,
    [pixels1, pixels2]: [&[Point2<f64>]; 2],
    distances_and_ratios: &[[f32; 2]],
) -> String {
    let names = ["u1", "v1", "u2", "v2", "distance", "ratio"];
    let pairs = pixels1.iter().zip(pixels2);
    match distances_and_ratios {
        [] => rows(
            layout,
            &names[..4],
            pairs.map(|(a, b)| vec![&a.x as &dyn Display, &a.y, &b.x, &b.y]),
        ),
        tests => rows(
            layout,
            &names,
            pairs.zip(tests).map(|((a, b), [distance, ratio])| {
                vec![&a.x as &dyn Display, &a.y, &b.x, &b.y, distance, ratio]
            }),
        ),
    }
}

/// Writes points of an image: `u v` per line.
///
/// ```
/// use epipole_io::matches::{MatchLayout, read_points, write_points};
/// let points = vec![nalgebra::Point2::new(1.5, 2.0)];
/// let text = write_points(MatchLayout::Text, &points);
/// assert_eq!(text, "# u v\n1.5 2\n");
/// assert_eq!(read_points(text.as_bytes())?, points);
/// # Ok::<(), epipole_io::Error>(())
/// ```
pub fn write_points(layout: MatchLayout, pixels: &[Point2<f64>]) -> String {
    let points = pixels.iter().map(|p| vec![&p.x as &dyn Display, &p.y]);
    rows(layout, &["u", "v"], points)
}

/// Writes a header and a line per row.
fn rows<'a>(
    layout: MatchLayout,
    names: &[&str],
    values: impl Iterator<Item = Vec<&'a dyn Display>>,
) -> String {
    let (before, separator) = match layout {
        MatchLayout::Text => ("# ", " "),
        MatchLayout::Csv => ("", ","),
    };
    let mut text = format!("{before}{}\n", names.join(separator));
    for row in values {
        let words: Vec<String> = row.iter().map(ToString::to_string).collect();
        text.push_str(&words.join(separator));
        text.push('\n');
    }
    text
}
