//! Plays scripts of events on the native side of the bridge and prints what the figures answer.
//!
//! Standard input: JSON `[{"figure": name, "width": …, "scale": …, "theme": …, "events": [event]}]`,
//! where `null` in place of an event asks for a frame. Standard output: JSON, for each script the
//! list of answers. A browser plays the same scripts through WebAssembly and must answer the same.

use epipole_web::Figure;
use serde::Deserialize;
use std::io::Read;

#[derive(Deserialize)]
struct Script {
    figure: String,
    width: f64,
    scale: f64,
    theme: String,
    events: Vec<serde_json::Value>,
}

fn play(script: &Script) -> Result<Vec<String>, String> {
    let mut figure = Figure::new(&script.figure)?;
    let mut answers = Vec::new();
    for event in &script.events {
        if event.is_null() {
            figure.draw_settled(script.width, script.scale, &script.theme);
            answers.push(format!(
                "{} × {}: {}",
                figure.pixel_width(),
                figure.pixel_height(),
                figure.frame_hash().unwrap_or_default()
            ));
        } else {
            let refused = figure.update(&event.to_string()).unwrap_or_default();
            answers.push(refused + &figure.snapshot(script.width) + &figure.state());
        }
    }
    Ok(answers)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut input = String::new();
    std::io::stdin().read_to_string(&mut input)?;
    let scripts: Vec<Script> = serde_json::from_str(&input)?;
    let answers = scripts.iter().map(play).collect::<Result<Vec<_>, _>>()?;
    println!("{}", serde_json::to_string(&answers)?);
    Ok(())
}
