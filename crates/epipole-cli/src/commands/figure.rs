//! `epipole figure`: a figure of the book as a picture, in any state.

use crate::context::Context;
use crate::failure::Failure;
use crate::files;
use crate::report::Report;
use clap::Args;
use epipole_widgets::theme::Theme;
use epipole_widgets::{Figure, POSTER_WIDTH};
use image::{Rgba, RgbaImage};
use std::path::PathBuf;

/// Draw a figure of the book, or describe it.
#[derive(Debug, Args)]
#[command(
    after_help = "Example: epipole figure ransac-race --set outliers=0.6 --set seed=3 \
                        --theme dark -o race.png --describe\n\n\
    JSON: name, readouts (label, value and unit of each), description, permalink, and file with -o."
)]
pub(crate) struct Arguments {
    /// The figure's name, as in <epipole-figure name="…">.
    name: String,
    /// Parameter of the figure; repeat for more.
    #[arg(long, value_name = "KEY=VALUE", value_parser = key_value)]
    set: Vec<(String, String)>,
    /// Size in CSS pixels, 760 or 800x600 (one number is the width).
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<Size>,
    /// Device pixels per CSS pixel.
    #[arg(long, default_value_t = 2.0, value_parser = scale)]
    scale: f64,
    /// Theme: light, dark or high-contrast.
    #[arg(long, default_value = "light", value_parser = |name: &str| name.parse::<Theme>())]
    theme: Theme,
    /// PNG file to write.
    #[arg(short, long, value_name = "OUT.png")]
    output: Option<PathBuf>,
    /// Describe the figure in words.
    #[arg(long)]
    describe: bool,
}

#[derive(Debug, Clone, Copy)]
struct Size {
    width: f64,
    height: Option<f64>,
}

fn key_value(text: &str) -> Result<(String, String), String> {
    let (key, value) = text.split_once('=').ok_or("it must be key=value")?;
    Ok((key.to_owned(), value.to_owned()))
}

fn scale(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(scale) if (0.1..=16.0).contains(&scale) => Ok(scale),
        _ => Err(format!("\"{text}\" is not a number from 0.1 to 16")),
    }
}

fn size(text: &str) -> Result<Size, String> {
    let side = |text: &str| match text.parse::<f64>() {
        Ok(side) if (16.0..=8192.0).contains(&side) => Ok(side),
        _ => Err(format!(
            "\"{text}\" is not a number of pixels from 16 to 8192"
        )),
    };
    match text.split_once('x') {
        Some((width, height)) => Ok(Size {
            width: side(width)?,
            height: Some(side(height)?),
        }),
        None => Ok(Size {
            width: side(text)?,
            height: None,
        }),
    }
}

pub(crate) fn run(arguments: &Arguments, context: &Context) -> Result<Report, Failure> {
    let mut figure = Figure::new(&arguments.name)?;
    // A bad value is an error, because the picture would not be the requested one.
    if let Some(problem) = figure.apply(&arguments.set).into_iter().next() {
        return Err(problem.into());
    }
    // The description and the picture need the result of the computation.
    figure.finish_job();
    if let Some(path) = &arguments.output {
        if path
            .extension()
            .is_none_or(|extension| !extension.eq_ignore_ascii_case("png"))
        {
            let message = "the picture must be a .png file";
            return Err(Failure::usage(message).about(path));
        }
        let picture = draw(&mut figure, arguments)?;
        let mut png = Vec::new();
        picture
            .write_to(&mut std::io::Cursor::new(&mut png), image::ImageFormat::Png)
            .map_err(|error| Failure::new("write", error.to_string()).about(path))?;
        files::write(path, &png)?;
    } else if !arguments.describe {
        context.warn("nothing is drawn without -o OUT.png");
    }
    Ok(report(&figure, arguments))
}

fn draw(figure: &mut Figure, arguments: &Arguments) -> Result<RgbaImage, Failure> {
    let size = arguments.size.unwrap_or(Size {
        width: POSTER_WIDTH,
        height: None,
    });
    let mut width = size.width;
    if let Some(height) = size.height {
        // The widest picture within the height.
        while width > 16.0 && figure.layout(width).height > height {
            width -= 1.0;
        }
    }
    let drawn = figure.draw_settled(width, arguments.scale, arguments.theme)?;
    let picture = RgbaImage::from_raw(drawn.width(), drawn.height(), drawn.rgba().to_vec());
    let picture = picture.ok_or_else(|| Failure::new("figure", "the picture is empty"))?;
    let Some(height) = size.height else {
        return Ok(picture);
    };
    let device = |side: f64| (side * arguments.scale).round() as u32;
    let [r, g, b] = arguments
        .theme
        .color(epipole_widgets::theme::Role::Background);
    let mut page = RgbaImage::from_pixel(device(size.width), device(height), Rgba([r, g, b, 255]));
    let middle = |page: u32, picture: u32| i64::from(page.saturating_sub(picture) / 2);
    let (x, y) = (
        middle(page.width(), picture.width()),
        middle(page.height(), picture.height()),
    );
    image::imageops::replace(&mut page, &picture, x, y);
    Ok(page)
}

fn report(figure: &Figure, arguments: &Arguments) -> Report {
    let readouts = figure.readouts();
    let query = figure.query();
    let permalink = match query.is_empty() {
        true => figure.name().to_owned(),
        false => format!("{}?{query}", figure.name()),
    };
    let mut report = Report::default()
        .field("name", figure.name())
        .field("readouts", &readouts)
        .field("description", figure.describe())
        .field("permalink", &permalink)
        .row("figure", figure.title());
    for readout in &readouts {
        report = report.row(readout.label, &readout.text);
    }
    if arguments.describe {
        report = report.row("description", figure.describe());
    }
    if let Some(path) = &arguments.output {
        report = report
            .field("file", path.display().to_string())
            .row("file", path.display());
    }
    report.row("permalink", permalink)
}
