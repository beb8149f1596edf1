//! A reconstruction for other programs: photographs, a model, a page, PLY and JSON.

use super::contents::{Export, ExportFormat};
use super::frame::file_from_world;
use super::{cloud, depth, paper, report, summary, table, texture, trajectory};
use crate::project::{Blob, Source};
use crate::tasks::archive::Archive;
use crate::tasks::photograph::{Photograph, ReadPhotograph};
use crate::tasks::project_file::Packed;
use crate::tasks::reconstruction::{Component, ImagePoints};
use crate::tasks::task::{Monitor, Run};
use epipole_io::model::{Model, ModelFormat};
use epipole_io::photo::encode_jpeg;
use image::{DynamicImage, ImageFormat, RgbImage};
use std::collections::BTreeSet;
use std::io::Cursor;

impl Run for Export {
    fn run(self, monitor: Monitor<'_>) -> Result<Blob, String> {
        let export = &self;
        // Reads the pixels of a photograph that was passed without them.
        let mut read = |photograph: &Packed| {
            let task = ReadPhotograph {
                source: photograph.source.clone(),
                max_pixels: export.max_pixels,
                camera: photograph.camera.clone(),
            };
            task.run(&mut *monitor)
        };
        let found = (export.found.components)
            .get(export.component as usize)
            .ok_or("there is no reconstruction to export")?;
        check_indices(export)?;
        let surface = cloud::surface(export);
        let needs_texture = texture::is_needed(export, &surface);
        let mut photos = Vec::new();
        let mut archive = Archive::new();
        let mut images = export
            .images
            .iter()
            .map(ImagePoints::sfm_image)
            .collect::<Vec<_>>();
        let mut written = BTreeSet::new();
        let chosen = report::chosen_images(export);
        let mut reduced = Vec::new();
        for (index, (photograph, image)) in export.photographs.iter().zip(&mut images).enumerate() {
            let (name, bytes) = picture(photograph, &mut read)?;
            if !written.insert(name.clone()) {
                return Err(format!("two photographs are called {name}"));
            }
            archive.add(&format!("images/{name}"), &bytes)?;
            image.name = name;
            let is_chosen = chosen.contains(&index);
            if needs_texture || is_chosen {
                let pixels = pixels(photograph, &mut read)?;
                if is_chosen {
                    reduced.push((index, report::reduced(&pixels)));
                }
                if needs_texture {
                    photos.push(pixels);
                }
            }
        }
        let sizes = (export.images.iter()).map(|image| (image.camera.width, image.camera.height));
        // Otherwise the files stay identical to those of the command line.
        let is_placed = export.measures.aligned.is_some() || export.floor.is_some();
        let is_moved = export.meters_per_unit.is_some() || is_placed;
        let to_core = |component: &Component| {
            let model = component.to_core(sizes.clone())?;
            Ok::<_, String>(match is_moved {
                true => model.moved(&file_from_world(export)),
                false => model,
            })
        };
        let model = to_core(found)?;
        let files = Model::from_reconstruction(&model, &images);
        add_model(&mut archive, export.format, &files)?;
        let texture = match needs_texture {
            true => {
                let uncropped = export.uncropped.as_ref().map(to_core).transpose()?;
                let views = uncropped.as_ref().unwrap_or(&model);
                texture::texture(views, &surface, &photos, monitor)?
            }
            false => None,
        };
        drop(photos);
        let page = files.to_html(&surface).map_err(|error| error.to_string())?;
        archive.add("model.html", &page)?;
        archive.add("points.ply", &files.to_ply())?;
        for (name, text) in trajectory::files(&files)? {
            archive.add(name, text.as_bytes())?;
        }
        depth::add(&mut archive, export)?;
        cloud::add(&mut archive, export, &surface, texture.as_ref())?;
        let json = summary::json(export, &images, &model);
        archive.add("reconstruction.json", json.as_bytes())?;
        if !export.measures.is_empty() {
            archive.add("measures.csv", table::csv(export).as_bytes())?;
        }
        let mut page = report::paper(export, &model);
        let reduced = reduced.into_iter();
        page.photos = (reduced
            .filter_map(|(index, image)| report::photo(export, &model, index, image)))
        .collect();
        archive.add("report.pdf", &paper::pdf(&page)?)?;
        if let Some(program) = &export.recipe.program {
            archive.add("reconstruct.rs", program.as_bytes())?;
        }
        if let Some(camera) = &export.recipe.camera_json {
            archive.add("camera.json", camera.as_bytes())?;
        }
        archive.add("README.txt", summary::readme(export).as_bytes())?;
        Ok(archive.finish()?.into())
    }
}

/// Adds the model in a format: COLMAP's in a folder, others beside the folder of photographs.
fn add_model(archive: &mut Archive, format: ExportFormat, model: &Model) -> Result<(), String> {
    let (folder, format) = match format {
        ExportFormat::ColmapText => ("sparse/0/", ModelFormat::ColmapText),
        ExportFormat::ColmapBinary => ("sparse/0/", ModelFormat::ColmapBinary),
        ExportFormat::Transforms => ("", ModelFormat::Transforms),
        ExportFormat::Bundler => ("", ModelFormat::Bundler),
        ExportFormat::OpenMvg => ("", ModelFormat::OpenMvg),
        ExportFormat::Glb => ("", ModelFormat::Glb),
    };
    let mut model = model.clone();
    if folder.is_empty() {
        for image in &mut model.images {
            image.name = format!("images/{}", image.name);
        }
    }
    let files = model.to_files(format).map_err(|error| error.to_string())?;
    for file in files {
        archive.add(&format!("{folder}{}", file.name), &file.bytes)?;
    }
    Ok(())
}

/// Checks indices in tracks; invalid ones are a bug of the caller.
fn check_indices(export: &Export) -> Result<(), String> {
    let is_there = |&(image, keypoint): &(u32, u32)| {
        (export.images.get(image as usize))
            .is_some_and(|image| (keypoint as usize) < image.points.len())
    };
    let mut components = (export.found.components.iter()).chain(&export.uncropped);
    let whole = components.all(|component| {
        let mut points = component.points.iter();
        component.cameras.len() == export.images.len()
            && points.all(|point| point.track.iter().all(is_there))
    });
    match whole && export.photographs.len() == export.images.len() {
        true => Ok(()),
        false => Err("the reconstruction and its photographs do not belong together".to_owned()),
    }
}

/// Returns the name and the file of a photograph as it was reconstructed.
fn picture(
    photograph: &Packed,
    read: &mut dyn FnMut(&Packed) -> Result<Photograph, String>,
) -> Result<(String, Vec<u8>), String> {
    if let Source::File(bytes) = &photograph.source
        && used(photograph)?.as_given
    {
        return Ok((photograph.name.clone(), bytes.to_vec()));
    }
    let image = pixels(photograph, read)?;
    match &photograph.source {
        Source::File(_) => {
            let bytes = encode_jpeg(&image).map_err(|error| error.to_string())?;
            Ok((renamed(&photograph.name, "jpg"), bytes))
        }
        Source::Rendered(..) => Ok((photograph.name.clone(), png(image)?)),
    }
}

fn used(photograph: &Packed) -> Result<&Photograph, String> {
    let used = photograph.used.as_ref();
    used.ok_or_else(|| format!("{} has no pixels", photograph.name))
}

/// Returns the pixels of a photograph as it was reconstructed.
fn pixels(
    photograph: &Packed,
    read: &mut dyn FnMut(&Packed) -> Result<Photograph, String>,
) -> Result<RgbImage, String> {
    match used(photograph)? {
        used if used.has_pixels() => used.to_image(),
        _ => read(photograph)?.to_image(),
    }
}

fn renamed(name: &str, extension: &str) -> String {
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    format!("{stem}.{extension}")
}

fn png(image: RgbImage) -> Result<Vec<u8>, String> {
    let mut bytes = Cursor::new(Vec::new());
    DynamicImage::from(image)
        .write_to(&mut bytes, ImageFormat::Png)
        .map_err(|error| error.to_string())?;
    Ok(bytes.into_inner())
}
