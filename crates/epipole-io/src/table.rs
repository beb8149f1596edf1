//! Text files with a row of numbers per line, from text editors, spreadsheets and programs.

#[cfg(feature = "cameras")]
mod json;

use crate::text::{decode, excerpt, lines};
use crate::{Error, Result};

/// Names of the pixel columns, or of those in the first image; every table has one of these pairs.
pub(crate) const PIXELS: [[&str; 2]; 4] = [["u", "v"], ["x", "y"], ["u1", "v1"], ["x1", "y1"]];

/// Minimum number of rows from which a first column that counts them is no coincidence.
const MIN_COUNTED: usize = 3;

/// Reads the rows of a text: numbers separated by commas, semicolons, tabs or spaces, also in
/// quotes or brackets or as 1.5D+02; decimal commas with semicolons or tabs or in quotes. `#`
/// begins a comment. A header, which may be a comment, orders the columns; without one the first
/// columns are read. With the feature `cameras`, JSON lists or objects are also read.
///
/// * `names`: possible names of the columns in a header, in lower case; further columns are ignored
///
/// # Errors
/// [`Error::Malformed`] with the line that has fewer numbers, NaN, or an ambiguous decimal comma;
/// also for a first column that counts the rows. Infinities are kept.
pub(crate) fn read<const N: usize>(bytes: &[u8], names: &[[&str; N]]) -> Result<Vec<[f64; N]>> {
    let text = decode(bytes)?;
    #[cfg(feature = "cameras")]
    let json = json::lines(text, N);
    #[cfg(feature = "cameras")]
    let text = json.as_deref().unwrap_or(text);
    let mut rows = Vec::new();
    let mut header = match commented_header(text) {
        Some((number, fields)) => {
            let header = Header::read(&fields, names).map_err(|error| error.on_line(number))?;
            // A comment may omit columns.
            Some(Header {
                num_fields: usize::MAX,
                ..header
            })
        }
        None => None,
    };
    // First numbers of rows that have more than needed.
    let mut counted = Vec::new();
    let mut num_halved = 0;
    let mut is_first = true;
    for (number, line) in lines(text) {
        let fields = fields(line, N).map_err(|error| error.on_line(number))?;
        if std::mem::take(&mut is_first) && header.is_none() && is_header(&fields) {
            let read = Header::read(&fields, names);
            header = Some(read.map_err(|error| error.on_line(number))?);
            continue;
        }
        let row = match &header {
            Some(header) => (header.pick(&fields)).map_err(|error| error.on_line(number))?,
            None => fields.iter().take(N).collect(),
        };
        let numbers: Vec<f64> = row.iter().map_while(|field| self::number(field)).collect();
        let whole = <[f64; N]>::try_from(numbers);
        let numbers = (whole.ok())
            .filter(|numbers| !numbers.iter().any(|number| number.is_nan()))
            .ok_or_else(|| {
                let expected = match &header {
                    Some(_) => format!("{N} numbers, {}", describe_columns(names)),
                    None => format!("{N} numbers"),
                };
                Error::at(
                    number,
                    format!("here should be {expected}, not \"{}\"", excerpt(line)),
                )
            })?;
        num_halved += usize::from(is_halved(line, &fields, N));
        if header.is_none() && fields.len() > N {
            counted.push(numbers[0]);
        }
        rows.push(numbers);
    }
    if header.is_none() && num_halved == rows.len() && !rows.is_empty() {
        return Err(Error::malformed(format!(
            "each line has {} whole numbers between commas where {N} numbers should be: if they have decimal commas, write points, or separate the numbers by semicolons",
            2 * N
        )));
    }
    let counts = |from: f64| (counted.iter().zip(0..)).all(|(&n, at)| n == from + f64::from(at));
    let is_counted = counted.len() >= MIN_COUNTED && counted.len() == rows.len();
    if is_counted && (counts(0.0) || counts(1.0)) {
        return Err(Error::malformed(format!(
            "the first column counts the rows, so it is no coordinate: remove it, or name the columns in a first line, {}",
            describe_columns(names)
        )));
    }
    Ok(rows)
}

/// A field of a line.
#[derive(Debug, Clone, PartialEq)]
struct Field {
    text: String,
    /// Whether a comma in it can only be a decimal comma, for example in quotes.
    may_have_comma: bool,
}

/// Splits a line at semicolons, or else tabs, or else commas, or else spaces.
fn fields(line: &str, columns: usize) -> Result<Vec<Field>> {
    // A tab among spaces and commas counts as a space.
    let is_table = line.matches('\t').count() + 1 >= columns;
    let separator = [';', '\t', ',']
        .into_iter()
        .find(|&c| outside_quotes(line, c) && (c != '\t' || is_table));
    let words: Vec<&str> = line.split_whitespace().collect();
    if separator == Some(',') && words.len() >= columns {
        let is_decimal = |word: &&&str| {
            let digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
            word.split_once(',')
                .is_some_and(|(a, b)| digits(a.trim_start_matches(['-', '+'])) && digits(b))
        };
        if let Some(word) = words.iter().find(is_decimal) {
            return Err(Error::malformed(format!(
                "decimal comma in \"{word}\": write a point, or separate the numbers by semicolons"
            )));
        }
    }
    let mut fields = Vec::new();
    let mut open = Field {
        text: String::new(),
        may_have_comma: separator.is_some_and(|c| c != ','),
    };
    let blank = open.clone();
    let mut quote = None;
    for c in line.chars() {
        match (quote, c) {
            (Some(end), c) if c == end => quote = None,
            (Some(_), c) => open.text.push(c),
            (None, '"' | '\'') => {
                quote = Some(c);
                open.may_have_comma = true;
            }
            (None, c) if Some(c) == separator => {
                fields.push(std::mem::replace(&mut open, blank.clone()));
            }
            (None, '[' | ']' | '(' | ')') => open.text.push(' '),
            (None, c) => open.text.push(c),
        }
    }
    fields.push(open);
    if separator.is_none_or(|c| c == ',') {
        // Spaces separate too, but not in names between commas.
        fields = fields.into_iter().flat_map(at_spaces).collect();
    }
    fields
        .iter_mut()
        .for_each(|field| field.text = field.text.trim().to_owned());
    while separator.is_some() && fields.last().is_some_and(|field| field.text.is_empty()) {
        fields.pop();
    }
    Ok(fields)
}

/// Returns the words of a field; one empty word if it has none.
fn at_spaces(field: Field) -> Vec<Field> {
    let words: Vec<Field> = (field.text.split_whitespace())
        .map(|word| Field {
            text: word.to_owned(),
            may_have_comma: field.may_have_comma,
        })
        .collect();
    match words.is_empty() {
        true => vec![field],
        false => words,
    }
}

fn outside_quotes(line: &str, wanted: char) -> bool {
    let mut quote = None;
    line.chars().any(|c| {
        match quote {
            Some(end) if c == end => quote = None,
            None if c == '"' || c == '\'' => quote = Some(c),
            _ => (),
        }
        quote.is_none() && c == wanted
    })
}

/// Reads a number, with an unambiguous decimal comma or Fortran's exponents.
fn number(field: &Field) -> Option<f64> {
    let mut text = field.text.clone();
    if field.may_have_comma && !text.contains('.') {
        text = text.replacen(',', ".", 1);
    }
    let is_number = |c: char| c.is_ascii_digit() || "+-.dD".contains(c);
    if text.chars().all(is_number) {
        text = text.replacen(['d', 'D'], "e", 1);
    }
    text.parse().ok()
}

/// Returns whether fields are names: none is a number, at least one begins with a letter.
fn is_header(fields: &[Field]) -> bool {
    let is_name = |field: &Field| field.text.starts_with(|c: char| c.is_alphabetic());
    fields.iter().all(|field| number(field).is_none()) && fields.iter().any(is_name)
}

/// Returns a first comment that names the columns of the first row, as from `numpy.savetxt` and
/// `epipole match`.
fn commented_header(text: &str) -> Option<(usize, Vec<Field>)> {
    let mut filled = (text.lines().zip(1..)).filter(|(line, _)| !line.trim().is_empty());
    let (first, number) = filled.next()?;
    let names = fields(first.trim().strip_prefix('#')?, 2).ok()?;
    let (_, row) = lines(text).next()?;
    let has = |name: &&str| (names.iter()).any(|field| field.text.to_lowercase() == **name);
    let are_known = PIXELS.iter().any(|columns| columns.iter().all(has));
    (are_known && fields(row, names.len()).ok()?.len() == names.len()).then_some((number, names))
}

/// Returns whether a line has twice the numbers, all of them whole, which means decimal commas
/// between commas.
fn is_halved(line: &str, fields: &[Field], columns: usize) -> bool {
    let digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    let are_whole = fields.iter().enumerate().all(|(at, field)| match at % 2 {
        0 => digits(field.text.trim_start_matches(['-', '+'])),
        _ => digits(&field.text),
    });
    line.contains(',') && fields.len() == 2 * columns && are_whole
}

/// Describes the expected columns.
fn describe_columns<const N: usize>(names: &[[&str; N]]) -> String {
    let known: Vec<String> = names.iter().map(|names| names.join(" ")).collect();
    known.join(" or ")
}

/// Places of the numbers in a row.
struct Header<const N: usize> {
    places: [usize; N],
    num_fields: usize,
}

impl<const N: usize> Header<N> {
    fn read(fields: &[Field], known: &[[&str; N]]) -> Result<Self> {
        let names: Vec<String> = fields
            .iter()
            .map(|field| field.text.to_lowercase())
            .collect();
        let find = |wanted: &[&str; N]| -> Option<[usize; N]> {
            let place = |name: &&str| names.iter().position(|other| other == name);
            let places: Option<Vec<usize>> = wanted.iter().map(place).collect();
            places?.try_into().ok()
        };
        match known.iter().find_map(find) {
            Some(places) => Ok(Self {
                places,
                num_fields: fields.len(),
            }),
            None => Err(Error::malformed(format!(
                "the first line names no columns {}, but {}",
                describe_columns(known),
                names.join(" ")
            ))),
        }
    }

    fn pick<'a>(&self, fields: &'a [Field]) -> Result<Vec<&'a Field>> {
        if fields.len() > self.num_fields {
            return Err(Error::malformed(format!(
                "the first line names {} columns, but here are {}",
                self.num_fields,
                fields.len()
            )));
        }
        Ok(self
            .places
            .iter()
            .filter_map(|&place| fields.get(place))
            .collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MATCHES: [[&str; 4]; 2] = [["u1", "v1", "u2", "v2"], ["x1", "y1", "x2", "y2"]];

    fn read(text: &str) -> Result<Vec<[f64; 4]>> {
        super::read(text.as_bytes(), &MATCHES)
    }

    #[test]
    fn numbers_are_read_however_they_are_separated() {
        let expected = [[1.5, -2.0, 300.0, 4.25], [5.0, 6.0, 7.0, 8.5]];
        for text in [
            "1.5 -2 300 4.25\n5 6 7 8.5",
            "1.5,-2,300,4.25\r\n5, 6 , 7,8.5,\r\n",
            "1.5;-2;300;4.25\n5; 6; 7; 8.5;",
            "1,5;-2;300;4,25\n5;6;7;8,5",
            "1,5\t-2\t300\t4,25\n5\t6\t7\t8,5",
            "\"1.5\",\"-2\",\"300\",\"4.25\"\n'5','6','7','8.5'",
            "\"1,5\",\"-2\",\"300\",\"4,25\"\n5,6,7,8.5",
            "1.5D+00 -2d0 3.0D+02 4.25e0\n5 6 7 0.85D1",
            "[1.5 -2] [300 4.25]\n[[5, 6], [7, 8.5]]",
            "(1.5, -2), (300, 4.25) # a comment\n\n# another\n5,6 7,8.5",
            "1.5 -2 300 4.25 0.3 x\n5 6 7 8.5 0.4 y",
            "1.5 -2, 300\t4.25 0.3 x\n5 6, 7\t8.5",
            "[[1.5, -2, 300, 4.25], [5, 6, 7, 8.5]]",
            "[[[1.5, -2], [300, 4.25]],\n [[5, 6], [7, 8.5]]]\n",
            "[{\"X1\": 1.5, \"y1\": -2, \"x2\": 300, \"y2\": 4.25, \"score\": 1},
              {\"X1\": 5, \"y1\": 6, \"x2\": 7, \"y2\": 8.5}]",
        ] {
            assert_eq!(read(text).unwrap(), expected, "{text}");
        }
    }

    #[test]
    fn a_header_names_the_columns() {
        let expected = [[1.0, 2.0, 3.0, 4.0]];
        for text in [
            "u1,v1,u2,v2\n1,2,3,4",
            "X2;Y2;id;X1;Y1\n3;4;a b;1;2",
            ",u1,v1,u2,v2,score\n0,1,2,3,4,",
            "\"x1\" \"y1\" \"x2\" \"y2\"\n1 2 3 4",
            "# x2 y2 x1 y1\n3 4 1 2",
            "# the points x and y of two images\n1 2 3 4",
        ] {
            assert_eq!(read(text).unwrap(), expected, "{text}");
        }
        let points = super::read("id,x,y\n7,1,2".as_bytes(), &[["x", "y"]]).unwrap();
        assert_eq!(points, [[1.0, 2.0]]);
    }

    #[test]
    fn doubtful_columns_and_commas_are_refused_by_line() {
        let ten: String = (0..10).map(|n| format!("{n},1.5,{n},3,4\n")).collect();
        for (text, why) in [
            (
                "1 2 3 4\n1,5 2,5 3,5 4,5",
                "line 2: decimal comma in \"1,5\"",
            ),
            ("1.234,5;2;3;4", "line 1: here should be 4 numbers"),
            (
                "a,b,c,d\n1,2,3,4",
                "names no columns u1 v1 u2 v2 or x1 y1 x2 y2, but a b c d",
            ),
            (
                "u1,v1,u2,v2\n0,1,2,3,4",
                "line 2: the first line names 4 columns, but here are 5",
            ),
            ("1,2,,4,5", "line 1: here should be 4 numbers"),
            (&ten, "the first column counts the rows"),
            (
                "[[0, 1, 2, 3, 4], [1, 5, 6, 7, 8], [2, 9, 1, 2, 3]]",
                "the first column counts the rows",
            ),
            (
                "[[1, 2, null, 4], [5, 6, 7, 8]]",
                "line 1: here should be 4 numbers",
            ),
            ("1 2 3 4\nu1 v1 u2 v2", "line 2: here should be 4 numbers"),
            (
                "1,5,-2,5,300,0,4,25\n5,0,6,0,7,0,8,5",
                "each line has 8 whole numbers between commas",
            ),
            (
                "[[1, 2, 3, 4], [5, 6, 7]]",
                "line 2: here should be 4 numbers, not \"5;6;7\"",
            ),
            (
                "# x y z u v\n1 2 3 4 5",
                "line 1: the first line names no columns u1",
            ),
            (
                "[{\"u1\": 1, \"v1\": 2, \"u2\": 3}]",
                "line 1: the first line names no columns u1 v1 u2 v2 or x1 y1 x2 y2, but u1 u2 v1",
            ),
        ] {
            let message = read(text).unwrap_err().to_string();
            assert!(message.contains(why), "{text}: {message}");
        }
        // The needed columns alone may count.
        let scan: String = (0..10).map(|n| format!("{n} 1.5 {n} 3\n")).collect();
        assert_eq!(read(&scan).unwrap().len(), 10);
    }
}
