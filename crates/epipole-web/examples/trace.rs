//! Plays scripts of calls on the native side of the bridge and prints what the figures answer.
//!
//! Standard input: JSON `[{"figure", "width", "scale", "theme", "calls": [[method, argument, …]]}]`
//! with the methods of [`Figure`]; `["draw_settled"]` carries out what the figure waits for and
//! draws it sharp, with the size and theme of the script. Standard output: JSON, for each script
//! what [`answer`] says after each call. A browser plays the same scripts through WebAssembly and
//! must answer the same.
//!
//! With `--time` it plays them without asking for answers, and prints the milliseconds of each.

use epipole_web::Figure;
use epipole_widgets::gallery;
use serde::Deserialize;
use serde_json::Value;
use std::collections::HashMap;
use std::io::Read;
use std::ops::ControlFlow;
use std::time::Instant;

#[derive(Deserialize)]
struct Script {
    figure: String,
    width: f64,
    scale: f64,
    theme: String,
    calls: Vec<Vec<Value>>,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let timed = std::env::args().any(|argument| argument == "--time");
    let mut input = String::new();
    std::io::stdin().read_to_string(&mut input)?;
    let scripts: Vec<Script> = serde_json::from_str(&input)?;
    if timed {
        let times = scripts.iter().map(time).collect::<Result<Vec<_>, _>>()?;
        println!("{}", serde_json::to_string(&times)?);
    } else {
        let mut known = Known::new();
        let answers = (scripts.iter().map(|script| play(script, &mut known)))
            .collect::<Result<Vec<_>, _>>()?;
        println!("{}", serde_json::to_string(&answers)?);
    }
    Ok(())
}

/// Results of jobs by figure and key: scripts of one figure begin alike.
type Known = HashMap<(String, String), Result<Vec<u8>, String>>;

fn play(script: &Script, known: &mut Known) -> Result<Vec<String>, String> {
    let mut figure = Figure::new(&script.figure)?;
    let mut answers = Vec::new();
    for words in &script.calls {
        let said = call(&mut figure, script, words, known)?;
        answers.push(answer(&mut figure, script, words, said));
    }
    Ok(answers)
}

fn time(script: &Script) -> Result<f64, String> {
    let mut figure = Figure::new(&script.figure)?;
    let start = Instant::now();
    for words in &script.calls {
        call(&mut figure, script, words, &mut Known::new())?;
    }
    Ok(start.elapsed().as_secs_f64() * 1e3)
}

/// The frame after a drawing; what the call said, everything beside the picture and the state
/// after all else.
fn answer(figure: &mut Figure, script: &Script, words: &[Value], said: Option<String>) -> String {
    if words[0] == "draw_settled" {
        let (width, height) = (figure.pixel_width(), figure.pixel_height());
        format!(
            "{width} × {height}: {}",
            figure.frame_hash().unwrap_or_default()
        )
    } else {
        let snapshot = figure.snapshot(script.width);
        said.unwrap_or_default() + &snapshot + &figure.state()
    }
}

fn call(
    figure: &mut Figure,
    script: &Script,
    words: &[Value],
    known: &mut Known,
) -> Result<Option<String>, String> {
    let text = |index: usize| {
        let word = words.get(index).and_then(Value::as_str);
        word.map(str::to_owned)
            .ok_or(format!("{words:?} lacks a text at {index}"))
    };
    let number = |index: usize| {
        let word = words.get(index).and_then(Value::as_f64);
        word.ok_or(format!("{words:?} lacks a number at {index}"))
    };
    let width = script.width;
    Ok(match text(0)?.as_str() {
        "set_number" => figure.set_number(text(1)?, number(2)?),
        "set_flag" => {
            let flag = words.get(2).and_then(Value::as_bool);
            figure.set_flag(text(1)?, flag.ok_or(format!("{words:?} lacks a flag"))?)
        }
        "set_text" => figure.set_text(text(1)?, text(2)?),
        "press" => figure.press(text(1)?),
        "tick" => figure.tick(number(1)?),
        "remove" => figure.remove(text(1)?),
        "reset" => figure.reset(),
        "drag" => figure.drag(&text(1)?, width, number(3)?, number(4)?),
        "nudge" => figure.nudge(&text(1)?, width, &text(3)?, number(4)?),
        "move_to_end" => figure.move_to_end(&text(1)?, width, &text(3)?),
        "click" => figure.click(width, number(2)?, number(3)?),
        "draw" => figure.draw(width, script.scale, &script.theme),
        "draw_settled" => {
            settle(figure, &script.figure, known);
            figure.draw_sharp(width, script.scale, &script.theme)
        }
        other => return Err(format!("there is no method {other}")),
    })
}

/// Carries out what the figure waits for, as its worker would.
fn settle(figure: &mut Figure, name: &str, known: &mut Known) {
    // A figure may go through several stages, but not through endlessly many.
    for _ in 0..16 {
        let Some(key) = figure.job_key() else { return };
        let result = known
            .entry((name.to_owned(), key.clone()))
            .or_insert_with(|| {
                let go_on = &mut |_| ControlFlow::Continue(());
                gallery::compute(name, &figure.job_request(), go_on)
                    .map_err(|problem| problem.to_string())
            });
        match result.clone() {
            Ok(bytes) => figure.job_done(&key, bytes),
            Err(problem) => figure.job_failed(&key, problem),
        };
    }
}
