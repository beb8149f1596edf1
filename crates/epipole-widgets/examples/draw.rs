//! Draws a figure into a PNG file, to look at it while working on its view.
//!
//! ```text
//! cargo run -p epipole-widgets --example draw -- NAME FILE [QUERY [THEME [WIDTH [SCALE]]]]
//! cargo run -p epipole-widgets --example draw -- stereo-slider out.png baseline=0.2 dark 340 2
//! ```
//!
//! Prints the description, the readouts and the drawing time.

use epipole_widgets::theme::Theme;
use epipole_widgets::{Figure, POSTER_WIDTH};
use std::error::Error;
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let argument = |index: usize| arguments.get(index).map(String::as_str);
    let name = argument(0).ok_or("which figure?")?;
    let file = argument(1).ok_or("into which file?")?;
    let mut figure = Figure::new(name)?;
    for problem in figure.apply_query(argument(2).unwrap_or("")) {
        eprintln!("{problem}");
    }
    let theme: Theme = argument(3).unwrap_or("light").parse()?;
    let width = argument(4).map_or(Ok(POSTER_WIDTH), str::parse)?;
    let scale = argument(5).map_or(Ok(2.0), str::parse)?;

    let begin = Instant::now();
    figure.finish_job();
    println!("computed in {:.1} ms", begin.elapsed().as_secs_f64() * 1e3);
    println!("{}\n", figure.describe());
    for readout in figure.readouts() {
        println!("{:28} {}", readout.label, readout.text);
    }
    let begin = Instant::now();
    figure.draw(width, scale, theme)?;
    println!(
        "\nfirst drawing {:.1} ms",
        begin.elapsed().as_secs_f64() * 1e3
    );
    let begin = Instant::now();
    let mut num_slices = 0;
    while figure.refine() {
        num_slices += 1;
    }
    let elapsed_ms = begin.elapsed().as_secs_f64() * 1e3;
    println!("{num_slices} slices in {elapsed_ms:.1} ms");
    let begin = Instant::now();
    let picture = figure.draw(width, scale, theme)?;
    println!(
        "settled drawing {:.1} ms",
        begin.elapsed().as_secs_f64() * 1e3
    );
    image::save_buffer(
        file,
        picture.rgba(),
        picture.width(),
        picture.height(),
        image::ExtendedColorType::Rgba8,
    )?;
    Ok(())
}
