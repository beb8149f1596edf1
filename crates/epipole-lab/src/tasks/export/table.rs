//! Measures as a table and as JSON.

use super::contents::Export;
use super::frame::file_from_world;
use super::measured::{Measured, MeasuredControl, MeasuredShape};
use nalgebra::Point3;
use serde_json::{Value, json};

/// A row of the table.
struct Row<'a> {
    kind: &'a str,
    name: String,
    value: Option<f64>,
    unit: &'a str,
    sigma: Option<f64>,
    known: Option<f64>,
    points: Vec<[f64; 3]>,
}

/// Returns the position of a point in the files.
fn placed(export: &Export, points: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let frame = file_from_world(export);
    let points = points.iter().map(|point| frame * Point3::from(*point));
    points.map(|point| point.coords.into()).collect()
}

fn rows(export: &Export) -> Vec<Row<'_>> {
    let measures = &export.measures;
    let unit = match export.meters_per_unit {
        Some(_) => "m",
        None => "units",
    };
    let lengths = measures.lengths.iter().enumerate();
    let lengths = lengths.map(|(index, length)| Row {
        kind: "length",
        name: format!("Length {}", index + 1),
        value: Some(length.length),
        unit,
        sigma: Some(length.sigma),
        known: length.typed_m,
        points: placed(export, &length.ends),
    });
    let shapes = measures.shapes.iter().map(|shape| Row {
        kind: &shape.kind,
        name: shape.name.clone(),
        value: Some(shape.value),
        unit: &shape.unit,
        sigma: Some(shape.sigma),
        known: None,
        points: placed(export, &shape.points),
    });
    let control = measures.control_points.iter().map(|control| Row {
        kind: "control point residual",
        name: control.name.clone(),
        value: control.residual_m,
        unit: "m",
        sigma: None,
        known: None,
        points: placed(export, &[control.place])
            .into_iter()
            .chain(control.position_m)
            .collect(),
    });
    lengths.chain(shapes).chain(control).collect()
}

/// Quotes a field of the table if needed.
fn field(text: &str) -> String {
    match text.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.to_owned(),
    }
}

/// Returns all measures as a table. A control point has its position, then its known coordinates.
pub(super) fn csv(export: &Export) -> String {
    let rows = rows(export);
    let most = rows.iter().map(|row| row.points.len()).max().unwrap_or(0);
    let mut text = "kind,name,value,unit,sigma,known".to_owned();
    for number in 1..=most {
        text.push_str(&format!(",x{number},y{number},z{number}"));
    }
    text.push('\n');
    let number = |value: Option<f64>| value.map_or(String::new(), |value| value.to_string());
    for row in rows {
        let mut fields = vec![
            field(row.kind),
            field(&row.name),
            number(row.value),
            field(row.unit),
            number(row.sigma),
            number(row.known),
        ];
        fields.extend(row.points.iter().flatten().map(f64::to_string));
        fields.resize(6 + 3 * most, String::new());
        text.push_str(&fields.join(","));
        text.push('\n');
    }
    text
}

/// Returns the lengths with their ends in the frame of the files.
pub(super) fn lengths(export: &Export) -> Vec<Value> {
    let one = |measure: &Measured| {
        json!({
            "ends": placed(export, &measure.ends),
            "length": measure.length,
            "sigma": measure.sigma,
            "typed_m": measure.typed_m,
        })
    };
    export.measures.lengths.iter().map(one).collect()
}

/// Returns the angles, areas and volumes, likewise.
pub(super) fn shapes(export: &Export) -> Vec<Value> {
    let one = |shape: &MeasuredShape| {
        json!({
            "kind": shape.kind,
            "name": shape.name,
            "points": placed(export, &shape.points),
            "value": shape.value,
            "sigma": shape.sigma,
            "unit": shape.unit,
        })
    };
    export.measures.shapes.iter().map(one).collect()
}

/// Returns the control points, likewise.
pub(super) fn control_points(export: &Export) -> Vec<Value> {
    let one = |control: &MeasuredControl| {
        json!({
            "name": control.name,
            "position": placed(export, &[control.place])[0],
            "known_m": control.position_m,
            "residual_m": control.residual_m,
        })
    };
    export.measures.control_points.iter().map(one).collect()
}
