//! Results of every function, computed natively, for the test of the npm package that compares
//! them with WebAssembly bit for bit: `cargo run --example js_native -- OUT.json`.
//!
//! The file is a list of calls: name, arguments, result or error. Numbers are the hexadecimal bytes
//! of arrays in little endian.

mod degeneracies;
mod dense;
mod geometry;
mod motion;
mod panoramas;
mod pictures;
mod scenes;
mod values;

use epipole_js::value::{Value, camel};
use epipole_js::{GROUPS, call};
use std::fmt::Write;
use values::*;

type Failure = Box<dyn std::error::Error>;

fn main() -> Result<(), Failure> {
    let path = std::env::args()
        .nth(1)
        .ok_or("the output file is missing")?;
    let mut calls = Calls::default();
    calls.add_all()?;
    for function in GROUPS.iter().flat_map(|group| group.functions) {
        let name = camel(function.name);
        if !calls.names.contains(&name) {
            return Err(format!("{name} is never called").into());
        }
    }
    std::fs::write(path, format!("[\n{}\n]\n", calls.lines.join(",\n")))?;
    Ok(())
}

/// Calls that were made, as JSON.
#[derive(Default)]
struct Calls {
    names: Vec<String>,
    lines: Vec<String>,
}

impl Calls {
    fn add(&mut self, name: &str, arguments: &[Value]) -> Result<Value, Failure> {
        let outcome = call(name, arguments, &mut ());
        let mut line = format!("{{\"name\": {name:?}, \"given\": ");
        json(&Value::List(arguments.to_vec()), &mut line);
        match &outcome {
            Ok(value) => {
                line += ", \"result\": ";
                json(value, &mut line);
            }
            Err(fault) => write!(line, ", \"fault\": [{:?}, {:?}]", fault.kind, fault.message)?,
        }
        self.lines.push(line + "}");
        self.names.push(name.to_owned());
        Ok(outcome?)
    }

    fn fail(&mut self, name: &str, arguments: &[Value]) -> Result<(), Failure> {
        match self.add(name, arguments) {
            Ok(_) => Err(format!("{name} must fail").into()),
            Err(_) => Ok(()),
        }
    }

    fn add_all(&mut self) -> Result<(), Failure> {
        let world = self.add(
            "twoViewProblem",
            &[record([
                ("numPoints", Value::Number(120.0)),
                ("noisePx", Value::Number(0.5)),
                ("outlierFraction", Value::Number(0.3)),
                ("seed", Value::Number(7.0)),
            ])],
        )?;
        let exact = self.add("twoViewProblem", &[])?;
        let plane = record([("plane", record([("halfSideM", Value::Number(1.0))]))]);
        let wall = self.add(
            "twoViewProblem",
            &[record([
                ("structure", plane),
                ("noisePx", Value::Number(0.5)),
                ("outlierFraction", Value::Number(0.2)),
                ("seed", Value::Number(3.0)),
            ])],
        )?;
        self.add_camera(&exact)?;
        self.add_homography(&wall)?;
        self.add_robust(&world)?;
        self.add_epipolar(&exact)?;
        self.add_triangulation(&exact)?;
        self.add_absolute_pose(&world, &exact)?;
        self.add_lines()?;
        self.add_two_view(&world, &wall, &exact)?;
        self.add_degeneracies(&world, &wall)?;
        self.add_bundle()?;
        self.add_imaging()?;
        self.add_pyramids()?;
        self.add_windows()?;
        self.add_warps(&exact)?;
        self.add_calibration()?;
        self.add_reconstruction()?;
        self.add_graphs()?;
        self.add_motion()?;
        self.add_places()?;
        self.add_panoramas()?;
        self.add_features()?;
        self.add_stereo(&exact)
    }
}
