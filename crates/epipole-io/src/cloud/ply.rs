//! PLY: points with colors, ASCII or binary.
//!
//! The reader takes the properties x, y, z and red, green, blue of the element `vertex`, of any
//! type and order. It skips other properties, and notes other elements such as faces.
//!
//! Source: Turk 1994, "The PLY polygon file format".

use super::not_finite;
use crate::bytes::Bytes;
use crate::{Error, Result, text};
use epipole::stereo::PointCloud;
use nalgebra::{Point3, Vector3};
use std::str::SplitAsciiWhitespace;

/// A number type.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    fn from_name(line: usize, name: &str) -> Result<Self> {
        Ok(match name {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return Err(Error::at(line, format!("\"{name}\" is no type of PLY"))),
        })
    }

    fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    /// Returns the factor from a color of this type to 0…255.
    fn color_scale(self) -> f64 {
        match self {
            Self::I8 | Self::U8 | Self::I32 | Self::U32 => 1.0,
            Self::I16 | Self::U16 => 255.0 / 65535.0,
            Self::F32 | Self::F64 => 255.0,
        }
    }
}

struct Property {
    name: String,
    scalar: Scalar,
    /// Type of the length of a list.
    length: Option<Scalar>,
}

struct Element {
    name: String,
    count: u64,
    properties: Vec<Property>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Encoding {
    Ascii,
    LittleEndian,
    BigEndian,
}

struct Header {
    encoding: Encoding,
    elements: Vec<Element>,
    /// Number of its lines.
    num_lines: usize,
    /// Number of its bytes.
    size: usize,
}

fn header(bytes: &[u8]) -> Result<Header> {
    let (mut size, mut line) = (0, 0);
    let mut encoding = None;
    let mut elements: Vec<Element> = Vec::new();
    loop {
        let rest = &bytes[size..];
        let Some(end) = rest.iter().position(|byte| *byte == b'\n') else {
            return Err(Error::malformed("the header of the PLY file does not end"));
        };
        size += end + 1;
        line += 1;
        let text = String::from_utf8_lossy(&rest[..end]);
        let words: Vec<&str> = text.split_ascii_whitespace().collect();
        match words[..] {
            ["ply"] if line == 1 => {}
            _ if line == 1 => return Err(Error::at(line, "a PLY file begins with \"ply\"")),
            ["end_header"] => break,
            ["comment" | "obj_info", ..] | [] => {}
            ["format", name, _] => {
                encoding = Some(match name {
                    "ascii" => Encoding::Ascii,
                    "binary_little_endian" => Encoding::LittleEndian,
                    "binary_big_endian" => Encoding::BigEndian,
                    _ => return Err(Error::at(line, format!("\"{name}\" is no format of PLY"))),
                });
            }
            ["element", name, count] => elements.push(Element {
                name: name.to_owned(),
                count: (count.parse()).map_err(|_| {
                    Error::at(line, format!("\"{count}\" is no number of elements"))
                })?,
                properties: Vec::new(),
            }),
            ["property", ref rest @ ..] => {
                let element = (elements.last_mut())
                    .ok_or_else(|| Error::at(line, "a property before any element"))?;
                let scalar = |name| Scalar::from_name(line, name);
                let (name, kind, length) = match *rest {
                    ["list", length, kind, name] => (name, scalar(kind)?, Some(scalar(length)?)),
                    [kind, name] => (name, scalar(kind)?, None),
                    _ => return Err(Error::at(line, "expected a property's type and name")),
                };
                element.properties.push(Property {
                    name: name.to_owned(),
                    scalar: kind,
                    length,
                });
            }
            _ => return Err(Error::at(line, format!("\"{}\" is unknown", text.trim()))),
        }
    }
    Ok(Header {
        encoding: encoding.ok_or_else(|| Error::malformed("the PLY file names no format"))?,
        elements,
        num_lines: line,
        size,
    })
}

/// Values behind the header, in order.
enum Body<'a> {
    Ascii {
        lines: std::iter::Enumerate<std::str::Lines<'a>>,
        line: usize,
        num_lines: usize,
        words: SplitAsciiWhitespace<'a>,
    },
    Binary(Bytes<'a>, Encoding),
}

impl Body<'_> {
    /// Begins the next element.
    fn begin(&mut self) -> Result<()> {
        if let Self::Ascii {
            lines,
            line,
            num_lines,
            words,
        } = self
        {
            let missing = || Error::malformed("the PLY file has fewer lines than elements");
            let next = lines.find(|(_, text)| !text.trim().is_empty());
            let (index, text) = next.ok_or_else(missing)?;
            *line = index + 1 + *num_lines;
            *words = text.split_ascii_whitespace();
        }
        Ok(())
    }

    fn value(&mut self, scalar: Scalar) -> Result<f64> {
        match self {
            Self::Ascii { line, words, .. } => {
                let word = words.next();
                let word = word.ok_or_else(|| Error::at(*line, "a value is missing"))?;
                // Points with NaN are left out later.
                (word.parse()).map_err(|_| Error::at(*line, format!("\"{word}\" is not a number")))
            }
            Self::Binary(bytes, encoding) => {
                let mut raw = [0; 8];
                let raw = &mut raw[..scalar.size()];
                raw.copy_from_slice(bytes.take(scalar.size())?);
                if *encoding == Encoding::BigEndian {
                    raw.reverse();
                }
                let mut value = Bytes::new(raw);
                Ok(match scalar {
                    Scalar::I8 => f64::from(value.u8()? as i8),
                    Scalar::U8 => f64::from(value.u8()?),
                    Scalar::I16 => f64::from(i16::from_le_bytes([value.u8()?, value.u8()?])),
                    Scalar::U16 => f64::from(u16::from_le_bytes([value.u8()?, value.u8()?])),
                    Scalar::I32 => f64::from(value.i32()?),
                    Scalar::U32 => f64::from(value.u32()?),
                    Scalar::F32 => f64::from(f32::from_bits(value.u32()?)),
                    Scalar::F64 => value.f64()?,
                })
            }
        }
    }

    /// Reads the value of a property; skips a list.
    fn property(&mut self, property: &Property) -> Result<f64> {
        let Some(length) = property.length else {
            return self.value(property.scalar);
        };
        let count = self.value(length)?;
        if !(count >= 0.0 && count == count.trunc()) {
            return Err(Error::malformed(format!(
                "a list {} of {count} values",
                property.name
            )));
        }
        // A wrong length fails at the end of the file.
        let mut left = count;
        while left > 0.0 {
            self.value(property.scalar)?;
            left -= 1.0;
        }
        Ok(0.0)
    }
}

/// Reads the points of a PLY file. Also returns sentences on omitted parts: points with NaN or
/// infinite coordinates, and the faces of a mesh.
///
/// # Errors
/// [`Error::Malformed`] with the line or byte.
///
/// ```
/// use epipole_io::cloud::read_ply;
/// let text = "ply\nformat ascii 1.0\nelement vertex 1\nproperty double x\nproperty double y\n\
///             property double z\nend_header\n1 2 3.5\n";
/// let (cloud, notes) = read_ply(text.as_bytes()).unwrap();
/// assert_eq!(cloud.points, [nalgebra::Point3::new(1.0, 2.0, 3.5)]);
/// assert!(cloud.colors.is_empty() && notes.is_empty());
/// ```
pub fn read_ply(bytes: &[u8]) -> Result<(PointCloud, Vec<String>)> {
    let header = header(bytes)?;
    let mut body = match header.encoding {
        Encoding::Ascii => Body::Ascii {
            lines: text::decode(&bytes[header.size..])?.lines().enumerate(),
            line: header.num_lines,
            num_lines: header.num_lines,
            words: "".split_ascii_whitespace(),
        },
        encoding => Body::Binary(Bytes::new(&bytes[header.size..]), encoding),
    };
    let mut elements = header.elements.iter();
    let vertices = loop {
        match elements.next() {
            None => return Err(Error::malformed("the PLY file has no element vertex")),
            Some(element) if element.name == "vertex" => break element,
            // Without properties it has no bytes, whatever its count.
            Some(element) if element.properties.is_empty() => {}
            Some(element) => {
                for _ in 0..element.count {
                    body.begin()?;
                    for property in &element.properties {
                        body.property(property)?;
                    }
                }
            }
        }
    };
    let place = |names: &[&str]| {
        let mut properties = vertices.properties.iter();
        properties.position(|p| p.length.is_none() && names.contains(&p.name.as_str()))
    };
    let coordinate = |name: &str| {
        place(&[name]).ok_or_else(|| Error::malformed(format!("the vertices have no {name}")))
    };
    let at = [coordinate("x")?, coordinate("y")?, coordinate("z")?];
    let channels = [
        place(&["red", "r", "diffuse_red"]),
        place(&["green", "g", "diffuse_green"]),
        place(&["blue", "b", "diffuse_blue"]),
    ];
    let of_normal = [place(&["nx"]), place(&["ny"]), place(&["nz"])];
    let of_confidence = place(&["confidence"]);
    let mut values = vec![0.0; vertices.properties.len()];
    let has_colors = channels.iter().any(Option::is_some);
    let (mut cloud, mut num_not_finite) = (PointCloud::default(), 0);
    for _ in 0..vertices.count {
        body.begin()?;
        for (value, property) in values.iter_mut().zip(&vertices.properties) {
            *value = body.property(property)?;
        }
        let position = Point3::from(at.map(|place| values[place]));
        if !position.iter().all(|value| value.is_finite()) {
            num_not_finite += 1;
            continue;
        }
        cloud.points.push(position);
        let color = channels.map(|place| match place {
            // A cast saturates; of NaN it is 0.
            Some(place) => {
                let scale = vertices.properties[place].scalar.color_scale();
                (values[place] * scale).round() as u8
            }
            None => 128,
        });
        if has_colors {
            cloud.colors.push(color);
        }
        if let [Some(x), Some(y), Some(z)] = of_normal {
            let normal = Vector3::new(values[x], values[y], values[z]);
            cloud.normals.push(normal);
        }
        if let Some(place) = of_confidence {
            cloud.confidences.push(values[place] as f32);
        }
    }
    let mut notes: Vec<String> = not_finite(num_not_finite).into_iter().collect();
    notes.extend(header.elements.iter().filter_map(left_out));
    Ok((cloud, notes))
}

/// Returns a sentence on an element that is not read, if it has entries.
fn left_out(element: &Element) -> Option<String> {
    match (element.name.as_str(), element.count) {
        ("vertex", _) | (_, 0) => None,
        ("face", 1) => Some("1 face is not read: a mesh becomes points".to_owned()),
        ("face", count) => Some(format!("{count} faces are not read: a mesh becomes points")),
        (name, count) => Some(format!("element {name} is not read, {count} entries")),
    }
}

/// Writes a binary little-endian PLY file: x, y, z as `float`; nx, ny, nz as `float`, red, green,
/// blue as `uchar` and confidence as `float` if all points have them.
///
/// ```
/// use epipole::stereo::PointCloud;
/// use epipole_io::cloud::{read_ply, write_ply};
/// use nalgebra::Point3;
/// let cloud = PointCloud {
///     points: vec![Point3::new(0.5, -1.0, 2.0)],
///     colors: vec![[255, 0, 7]],
///     ..PointCloud::default()
/// };
/// assert_eq!(read_ply(&write_ply(&cloud)).unwrap().0, cloud);
/// ```
pub fn write_ply(cloud: &PointCloud) -> Vec<u8> {
    ply_of(cloud, &[])
}

/// Writes a PLY file with faces, if there are any.
pub(crate) fn ply_of(cloud: &PointCloud, triangles: &[[u32; 3]]) -> Vec<u8> {
    let is_whole = |len: usize| len > 0 && len == cloud.points.len();
    let has_normals = is_whole(cloud.normals.len());
    let has_colors = is_whole(cloud.colors.len());
    let has_confidences = is_whole(cloud.confidences.len());
    let parts = [
        (
            has_normals,
            "property float nx\nproperty float ny\nproperty float nz\n",
        ),
        (
            has_colors,
            "property uchar red\nproperty uchar green\nproperty uchar blue\n",
        ),
        (has_confidences, "property float confidence\n"),
    ];
    let parts = parts.iter().filter(|(has, _)| *has).map(|(_, part)| *part);
    let faces = match triangles.len() {
        0 => String::new(),
        count => format!("element face {count}\nproperty list uchar uint vertex_indices\n"),
    };
    let mut bytes = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\n\
         property float x\nproperty float y\nproperty float z\n{}{faces}end_header\n",
        cloud.points.len(),
        parts.collect::<String>()
    )
    .into_bytes();
    for (index, point) in cloud.points.iter().enumerate() {
        for value in point.iter() {
            bytes.extend((*value as f32).to_le_bytes());
        }
        if has_normals {
            for value in cloud.normals[index].iter() {
                bytes.extend((*value as f32).to_le_bytes());
            }
        }
        if has_colors {
            bytes.extend(cloud.colors[index]);
        }
        if has_confidences {
            bytes.extend(cloud.confidences[index].to_le_bytes());
        }
    }
    for triangle in triangles {
        bytes.push(3);
        bytes.extend(triangle.iter().flat_map(|vertex| vertex.to_le_bytes()));
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_has_fifteen_bytes_with_a_color_and_twelve_without() {
        let mut cloud = PointCloud {
            points: vec![Point3::new(0.0, 0.0, 5.0)],
            colors: vec![[10, 20, 30]],
            ..PointCloud::default()
        };
        let ply = write_ply(&cloud);
        let header = ply.windows(11).position(|w| w == b"end_header\n").unwrap() + 11;
        assert_eq!(ply.len() - header, 15);
        assert_eq!(&ply[header + 8..header + 12], 5f32.to_le_bytes());
        assert_eq!(&ply[header + 12..], [10, 20, 30]);
        let mut whole = cloud.clone();
        whole.normals.push(Vector3::new(0.0, 0.5, -1.0));
        whole.confidences.push(3.0);
        assert_eq!(read_ply(&write_ply(&whole)).unwrap(), (whole, vec![]));
        cloud.colors.clear();
        assert!(write_ply(&cloud).ends_with(&ply[header..header + 12]));
        assert_eq!(read_ply(&write_ply(&cloud)).unwrap(), (cloud, Vec::new()));
    }

    #[test]
    fn other_properties_and_elements_are_skipped() {
        let head = |format: &str| {
            format!(
                "ply\nformat {format} 1.0\ncomment by hand\nelement face 1\n\
                 property list uchar int vertex_indices\nelement vertex 2\nproperty float nx\n\
                 property double z\nproperty double y\nproperty short x\nproperty float red\n\
                 property float green\nproperty float blue\nelement edge 9\nproperty int a\n\
                 end_header\n"
            )
        };
        let text = head("ascii") + "3 0 1 1\n0.5 3 2 1 1 0.5 0\n\n0.5 nan 2 1 0 0 0\n";
        let expected = PointCloud {
            points: vec![Point3::new(1.0, 2.0, 3.0)],
            colors: vec![[255, 128, 0]],
            ..PointCloud::default()
        };
        let notes = [
            "1 point has NaN or infinite coordinates: left out",
            "1 face is not read: a mesh becomes points",
            "element edge is not read, 9 entries",
        ];
        let expected = (expected, notes.map(str::to_owned).to_vec());
        assert_eq!(read_ply(text.as_bytes()).unwrap(), expected);
        let mut big = head("binary_big_endian").into_bytes();
        big.extend([1, 0, 0, 0, 7]);
        for z in [3.0, f64::INFINITY] {
            big.extend(0.5f32.to_be_bytes());
            big.extend(z.to_be_bytes());
            big.extend(2f64.to_be_bytes());
            big.extend(1i16.to_be_bytes());
            big.extend([1f32, 0.5, 0.0].iter().flat_map(|c| c.to_be_bytes()));
        }
        assert_eq!(read_ply(&big).unwrap(), expected);
    }

    #[test]
    fn wrong_files_are_named() {
        let of = |text: &str| read_ply(text.as_bytes()).unwrap_err().to_string();
        assert!(of("ply\n").contains("does not end"));
        assert!(of("ply\nformat ascii 1.0\nend_header\n").contains("vertex"));
        let head = "ply\nformat ascii 1.0\nelement vertex 99999999999\nproperty float x\n";
        let whole = format!("{head}property float y\nproperty float z\nend_header\n");
        assert_eq!(
            of(&(whole.clone() + "1 2 c\n")),
            "line 8: \"c\" is not a number"
        );
        assert!(of(&(whole + "1 2 3\n")).contains("fewer lines"));
        assert!(of(&format!("{head}end_header\n")).contains("no y"));
        assert!(of("ply\nproperty float x\n").contains("before any element"));
        // Elements without bytes take no time.
        let empty = "ply\nformat binary_little_endian 1.0\nelement a 18446744073709551615\n";
        assert!(of(&format!("{empty}end_header\n")).contains("no element vertex"));
    }
}
