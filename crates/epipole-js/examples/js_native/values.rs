//! Values of calls, and their text in JSON.

use epipole_js::value::{Key, Value};

pub(crate) fn record<const N: usize>(entries: [(&'static str, Value); N]) -> Value {
    Value::Record(entries.map(|(key, value)| (Key::from(key), value)).into())
}

pub(crate) fn text(text: &str) -> Value {
    Value::Text(text.to_owned())
}

pub(crate) fn get(value: &Value, key: &str) -> Value {
    match value {
        Value::Record(entries) => entries
            .iter()
            .find(|(name, _)| name == key)
            .map_or(Value::Nothing, |(_, value)| value.clone()),
        _ => Value::Nothing,
    }
}

pub(crate) fn doubles(value: &Value) -> Vec<f64> {
    match value {
        Value::Doubles(list) => list.clone(),
        _ => Vec::new(),
    }
}

pub(crate) fn numbers(value: &Value, key: &str) -> f64 {
    match get(value, key) {
        Value::Number(number) => number,
        _ => f64::NAN,
    }
}

pub(crate) fn first(value: &Value, count: usize) -> Value {
    Value::Doubles(doubles(value).into_iter().take(count).collect())
}

/// Gray image of squares of random brightness, moved to the left.
pub(crate) fn texture(width: usize, height: usize, shift: usize) -> Value {
    let gray = |u: usize, v: usize| {
        let (column, row) = ((u + shift) / 7, v / 5);
        let mixed = (column * 7919 + row * 104_729 + column * row * 31) % 251;
        mixed as u8
    };
    let data = (0..width * height).map(|place| gray(place % width, place / width));
    image(width as f64, height as f64, Value::Bytes(data.collect()))
}

pub(crate) fn image(width: f64, height: f64, data: Value) -> Value {
    record([
        ("width", Value::Number(width)),
        ("height", Value::Number(height)),
        ("data", data),
    ])
}

/// The same image with other data.
pub(crate) fn with_data(gray: &Value, data: impl FnOnce(&[u8]) -> Value) -> Value {
    let Value::Bytes(bytes) = get(gray, "data") else {
        return Value::Nothing;
    };
    image(
        numbers(gray, "width"),
        numbers(gray, "height"),
        data(&bytes),
    )
}

/// The same image in floats.
pub(crate) fn floats(gray: &Value) -> Value {
    let float = |&byte: &u8| f32::from(byte) / 255.0;
    with_data(gray, |bytes| {
        Value::Floats(bytes.iter().map(float).collect())
    })
}

/// The same image in color.
pub(crate) fn colors(gray: &Value, channels: usize) -> Value {
    let pixel = |&byte: &u8| [byte, byte / 2, 255 - byte, 255].into_iter().take(channels);
    with_data(gray, |bytes| {
        Value::Bytes(bytes.iter().flat_map(pixel).collect())
    })
}

pub(crate) fn cameras(world: &Value) -> (Value, Value) {
    (get(world, "camera1"), get(world, "camera2"))
}

pub(crate) fn intrinsics(world: &Value) -> Value {
    get(&get(&get(world, "camera1"), "camera"), "intrinsics")
}

/// Direction of gravity, +y of the world, in a camera's frame.
pub(crate) fn gravity(camera: &Value) -> Value {
    let r = doubles(&get(&get(camera, "camFromWorld"), "rotation"));
    Value::Doubles(vec![r[1], r[4], r[7]])
}

/// Rays through pixels, of any length.
pub(crate) fn rays(pixels: &Value, k: &Value) -> Value {
    let of = |key| numbers(k, key);
    let pixels = doubles(pixels);
    let rays = pixels.chunks_exact(2).flat_map(|pixel| {
        let u = (pixel[0] - of("cuPx")) / of("fuPx");
        let v = (pixel[1] - of("cvPx")) / of("fvPx");
        [u, v, 1.0]
    });
    Value::Doubles(rays.collect())
}

/// Pixels of the same camera turned about its x axis: the optical axes meet no more.
pub(crate) fn tilted(pixels: &Value, k: &Value) -> Value {
    let of = |key| numbers(k, key);
    let rays = doubles(&rays(pixels, k));
    let pixels = rays.chunks_exact(3).flat_map(|ray| {
        let (x, y, z) = (ray[0], 0.96 * ray[1] - 0.28, 0.28 * ray[1] + 0.96);
        [
            of("fuPx") * x / z + of("cuPx"),
            of("fvPx") * y / z + of("cvPx"),
        ]
    });
    Value::Doubles(pixels.collect())
}

/// Projection matrix K [R | t].
pub(crate) fn projection(camera: &Value) -> Value {
    let (k, pose) = (
        get(&get(camera, "camera"), "intrinsics"),
        get(camera, "camFromWorld"),
    );
    let (r, t) = (
        doubles(&get(&pose, "rotation")),
        doubles(&get(&pose, "translation")),
    );
    let row = |row: usize| [r[3 * row], r[3 * row + 1], r[3 * row + 2], t[row]];
    let [x, y, z] = [row(0), row(1), row(2)];
    let line =
        |of: [f64; 4], f: f64, c: f64| std::array::from_fn::<f64, 4, _>(|i| f * of[i] + c * z[i]);
    let top = line(x, numbers(&k, "fuPx"), numbers(&k, "cuPx"));
    let middle = line(y, numbers(&k, "fvPx"), numbers(&k, "cvPx"));
    Value::Doubles([top, middle, z].concat())
}

/// Appends a value; numbers are the hexadecimal bytes of arrays in little endian.
pub(crate) fn json(value: &Value, out: &mut String) {
    let bytes = |kind: &str, bytes: Vec<u8>, out: &mut String| {
        *out += &format!("{{\"{kind}\": \"");
        for byte in bytes {
            *out += &format!("{byte:02x}");
        }
        *out += "\"}";
    };
    match value {
        Value::Nothing => *out += "null",
        Value::Flag(flag) => *out += &flag.to_string(),
        Value::Number(number) => bytes("number", number.to_le_bytes().into(), out),
        Value::Text(text) | Value::Other(text) => *out += &format!("{text:?}"),
        Value::Bytes(list) => bytes("Uint8Array", list.clone(), out),
        Value::Indices(list) => {
            let list = list.iter().flat_map(|number| number.to_le_bytes());
            bytes("Uint32Array", list.collect(), out);
        }
        Value::Integers(list) => {
            let list = list.iter().flat_map(|number| number.to_le_bytes());
            bytes("Int32Array", list.collect(), out);
        }
        Value::Floats(list) => {
            let list = list.iter().flat_map(|number| number.to_le_bytes());
            bytes("Float32Array", list.collect(), out);
        }
        Value::Doubles(list) => {
            let list = list.iter().flat_map(|number| number.to_le_bytes());
            bytes("Float64Array", list.collect(), out);
        }
        Value::List(list) => {
            *out += "[";
            for (index, value) in list.iter().enumerate() {
                *out += if index > 0 { ", " } else { "" };
                json(value, out);
            }
            *out += "]";
        }
        Value::Record(entries) => {
            *out += "{\"record\": {";
            for (index, (key, value)) in entries.iter().enumerate() {
                *out += if index > 0 { ", " } else { "" };
                *out += &format!("{key:?}: ");
                json(value, out);
            }
            *out += "}}";
        }
    }
}
