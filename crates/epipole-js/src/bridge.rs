//! The wasm interface: one exported function, and conversion of values.

use crate::fault::Fault;
use crate::value::{Key, Value};
use epipole::progress::Status;
use js_sys::{
    Array, ArrayBuffer, Float32Array, Float64Array, Function, Int32Array, Object, Reflect,
    Uint8Array, Uint8ClampedArray, Uint32Array,
};
use std::ops::ControlFlow;
use wasm_bindgen::prelude::wasm_bindgen;
use wasm_bindgen::{JsCast, JsValue};

/// Maximum depth of nested arrays and objects in an argument.
const MAX_DEPTH: usize = 16;

/// Calls a function by name. `report`, if given, receives the stage and the fraction done, and
/// cancels by returning false.
///
/// # Errors
/// An array of class or code, and message.
#[wasm_bindgen]
pub fn call(name: &str, arguments: &Array, report: Option<Function>) -> Result<JsValue, JsValue> {
    let arguments: Vec<Value> = arguments.iter().map(|value| from_js(&value, 0)).collect();
    let result = match report {
        Some(report) => crate::call(name, &arguments, &mut |status: Status| {
            let words = JsValue::from_str(status.stage.words());
            let fraction = JsValue::from_f64(f64::from(status.fraction));
            match report.call2(&JsValue::NULL, &words, &fraction) {
                Ok(goes_on) if goes_on != JsValue::FALSE => ControlFlow::Continue(()),
                _ => ControlFlow::Break(()),
            }
        }),
        None => crate::call(name, &arguments, &mut ()),
    };
    result.map(to_js).map_err(|Fault { kind, message }| {
        Array::of2(&JsValue::from_str(kind), &JsValue::from_str(&message)).into()
    })
}

fn from_js(value: &JsValue, depth: usize) -> Value {
    if value.is_null() || value.is_undefined() {
        return Value::Nothing;
    }
    if let Some(number) = value.as_f64() {
        return Value::Number(number);
    }
    if let Some(flag) = value.as_bool() {
        return Value::Flag(flag);
    }
    if let Some(text) = value.as_string() {
        return Value::Text(text);
    }
    if depth > MAX_DEPTH {
        return Value::Other("nested too deep".to_owned());
    }
    if let Some(list) = value.dyn_ref::<Array>() {
        return list_from_js(list, depth);
    }
    if let Some(numbers) = typed_from_js(value) {
        return numbers;
    }
    match value.dyn_ref::<Object>() {
        Some(object) if !value.is_function() => record_from_js(object, depth),
        _ => Value::Other(format!(
            "a {}",
            value.js_typeof().as_string().unwrap_or_default()
        )),
    }
}

fn list_from_js(list: &Array, depth: usize) -> Value {
    let numbers: Option<Vec<f64>> = list.iter().map(|value| value.as_f64()).collect();
    match numbers {
        Some(numbers) if !numbers.is_empty() => Value::Doubles(numbers),
        _ => Value::List(
            list.iter()
                .map(|value| from_js(&value, depth + 1))
                .collect(),
        ),
    }
}

fn typed_from_js(value: &JsValue) -> Option<Value> {
    if let Some(list) = value.dyn_ref::<Float64Array>() {
        return Some(Value::Doubles(list.to_vec()));
    }
    if let Some(list) = value.dyn_ref::<Uint8Array>() {
        return Some(Value::Bytes(list.to_vec()));
    }
    if let Some(list) = value.dyn_ref::<Uint8ClampedArray>() {
        return Some(Value::Bytes(list.to_vec()));
    }
    if let Some(list) = value.dyn_ref::<Float32Array>() {
        return Some(Value::Floats(list.to_vec()));
    }
    if let Some(list) = value.dyn_ref::<Uint32Array>() {
        return Some(Value::Indices(list.to_vec()));
    }
    if let Some(list) = value.dyn_ref::<Int32Array>() {
        return Some(Value::Integers(list.to_vec()));
    }
    // Any other typed array is converted to numbers.
    ArrayBuffer::is_view(value).then(|| Value::Doubles(Float64Array::new(value).to_vec()))
}

fn record_from_js(object: &Object, depth: usize) -> Value {
    let get = |key: &JsValue| from_js(&Reflect::get(object, key).unwrap_or_default(), depth + 1);
    // An undefined option takes its default; null is a value.
    let mut entries: Vec<(Key, Value)> = Object::keys(object)
        .iter()
        .filter(|key| !Reflect::get(object, key).unwrap_or_default().is_undefined())
        .map(|key| (Key::from(key.as_string().unwrap_or_default()), get(&key)))
        .collect();
    // The properties of an ImageData belong to its prototype, in Chromium all except for the data.
    if entries.iter().all(|(key, _)| key == "data") {
        for name in ["width", "height", "data"] {
            let is_own = entries.iter().any(|(key, _)| key == name);
            let value = get(&JsValue::from_str(name));
            if !is_own && value != Value::Nothing {
                entries.push((Key::from(name), value));
            }
        }
    }
    Value::Record(entries)
}

fn to_js(value: Value) -> JsValue {
    match value {
        Value::Nothing => JsValue::NULL,
        Value::Flag(flag) => JsValue::from_bool(flag),
        Value::Number(number) => JsValue::from_f64(number),
        Value::Text(text) | Value::Other(text) => JsValue::from_str(&text),
        Value::Bytes(list) => Uint8Array::from(list.as_slice()).into(),
        Value::Indices(list) => Uint32Array::from(list.as_slice()).into(),
        Value::Integers(list) => Int32Array::from(list.as_slice()).into(),
        Value::Floats(list) => Float32Array::from(list.as_slice()).into(),
        Value::Doubles(list) => Float64Array::from(list.as_slice()).into(),
        Value::List(list) => list.into_iter().map(to_js).collect::<Array>().into(),
        Value::Record(entries) => {
            let object = Object::new();
            for (key, value) in entries {
                // A new plain object accepts any property.
                let _ = Reflect::set(&object, &JsValue::from_str(&key), &to_js(value));
            }
            object.into()
        }
    }
}
