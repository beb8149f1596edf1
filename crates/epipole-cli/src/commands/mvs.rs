//! `epipole mvs`: depth maps of all photos of a model, and one dense cloud.

mod arguments;
mod input;
mod surface;

pub(crate) use self::arguments::Arguments;

use self::input::Input;
use self::surface::Surface;
use crate::context::Context;
use crate::failure::Failure;
use crate::model;
use crate::output_folder::OutputFolder;
use crate::progress::Progress;
use crate::report::Report;
use epipole::mvs::{DepthMap, MvsView, estimate_depth_maps, fuse_depth_maps, prepare_views};
use epipole::progress::Part;
use epipole::stereo::PointCloud;
use epipole_io::cloud::write_ply;
use epipole_io::depth_map::{write_colmap_depth, write_colmap_normals};
use epipole_io::model::{Model, ModelFormat, ModelImage};
use serde_json::{Value, json};

/// Fractions of the work after which views are prepared, and depth maps estimated and fused.
const PREPARED: f32 = 0.02;
const ESTIMATED: f32 = 0.9;
const FUSED: f32 = 0.94;

pub(crate) fn run(arguments: &Arguments, context: &Context) -> Result<Report, Failure> {
    Surface::check(arguments)?;
    let options = arguments.options(context);
    let model = model::read(&arguments.model)?.model;
    let input = Input::read(arguments, &model, context)?;
    let progress = Progress::new(context, "depth maps");
    let watch = &mut |status| progress.show(status);
    let part = &mut Part::new(watch, 0.0, PREPARED);
    let views = prepare_views(&input.reconstruction, &input.photos, &options, part)?;
    drop(input.photos);
    let part = &mut Part::new(watch, PREPARED, ESTIMATED);
    let maps = estimate_depth_maps(&views, &options, part)?;
    let part = &mut Part::new(watch, ESTIMATED, FUSED);
    let cloud = fuse_depth_maps(&views, &maps, &options, part)?;
    if cloud.points.is_empty() {
        let message = format!(
            "no pixel has a depth on which {} photos agree: are the images those of the model?",
            options.min_views
        );
        return Err(Failure::new("no-consensus", message).about(&arguments.model));
    }
    let part = &mut Part::new(watch, FUSED, 1.0);
    let surface = Surface::of(arguments, &views, &maps, context, part)?;
    drop(progress);
    let name = |view: &MvsView| &*input.names[view.photo];
    let left_out = (0..input.names.len()).filter(|&n| {
        input.reconstruction.cameras[n].is_some() && views.iter().all(|v| v.photo != n)
    });
    let left_out: Vec<&str> = left_out.map(|n| &*input.names[n]).collect();
    if let Some(first) = left_out.first() {
        context.warn(&format!(
            "{} of {} images have no neighbor that shows the same points from another place, such as {first}",
            left_out.len(),
            input.names.len()
        ));
    }
    let mut output = OutputFolder::new(&arguments.output, "mvs");
    let fused = output.write("fused.ply", &write_ply(&cloud))?;
    let mut files = Vec::new();
    for (name, bytes) in surface
        .as_ref()
        .map_or(Ok(Vec::new()), |surface| surface.files(&model))?
    {
        files.push(output.write(name, &bytes)?);
    }
    for file in model_of_views(&views, &name).to_files(ModelFormat::ColmapText)? {
        output.write(&format!("sparse/{}", file.name), &file.bytes)?;
    }
    for (view, map) in views.iter().zip(&maps) {
        let file = |kind: &str| format!("stereo/{kind}/{}.geometric.bin", name(view));
        output.write(&file("depth_maps"), &write_colmap_depth(&map.depth))?;
        let normals = write_colmap_normals(map.depth.dimensions(), &map.normals)?;
        output.write(&file("normal_maps"), &normals)?;
    }
    output.finish()?;
    let rows = views.iter().zip(&maps);
    let rows: Vec<Value> = rows
        .map(|(view, map)| fields(name(view), view, map))
        .collect();
    let mut report = report(&maps, &cloud, input.names.len())
        .field("images", rows)
        .row("written", fused.display())
        .field("file", fused.display().to_string());
    if let Some(surface) = &surface {
        report = surface.report(report, &files);
    }
    Ok(report)
}

/// Returns the cameras of the depth maps as a model without points.
fn model_of_views<'a>(views: &[MvsView], name: &dyn Fn(&MvsView) -> &'a str) -> Model {
    let mut model = Model::default();
    for (index, view) in views.iter().enumerate() {
        model.cameras.push(view.camera.camera);
        model.images.push(ModelImage {
            id: index as u32 + 1,
            name: name(view).to_owned(),
            camera: index,
            cam_from_world: view.camera.cam_from_world,
            keypoints: Vec::new(),
        });
    }
    model
}

fn fields(name: &str, view: &MvsView, map: &DepthMap) -> Value {
    let (width, height) = map.depth.dimensions();
    let range = map.range();
    json!({
        "name": name,
        "width": width,
        "height": height,
        "num_neighbors": view.neighbors.len(),
        "density": map.density(),
        "min_depth": range.map(|(near, _)| near),
        "max_depth": range.map(|(_, far)| far),
    })
}

fn report(maps: &[DepthMap], cloud: &PointCloud, num_images: usize) -> Report {
    let num_points = cloud.points.len();
    let num_known = |map: &DepthMap| map.num_views.iter().filter(|count| **count > 0).count();
    let num_pixels: usize = maps.iter().map(|map| map.num_views.len()).sum();
    let density = maps.iter().map(num_known).sum::<usize>() as f64 / num_pixels.max(1) as f64;
    let total: f64 = cloud
        .confidences
        .iter()
        .map(|count| f64::from(*count))
        .sum();
    let mean_views = total / num_points as f64;
    Report::default()
        .row(
            "depth maps",
            format!("{} of {num_images} images", maps.len()),
        )
        .row("pixels with a depth", format!("{:.1}%", 100.0 * density))
        .row(
            "points",
            format!("{num_points}, each in {mean_views:.1} images on average"),
        )
        .field("num_images", num_images)
        .field("num_depth_maps", maps.len())
        .field("density", density)
        .field("num_points", num_points)
        .field("mean_views", mean_views)
}
