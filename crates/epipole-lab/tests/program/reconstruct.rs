//! The Lab's reconstruction, bit for bit. Needs the crates epipole, epipole-io and image 0.25.

use epipole::calibration::{Keep, Undistortion};
use epipole::camera::{Camera, Intrinsics, Lens, LensKind};
use epipole::feature::FeatureKind;
use epipole::sfm::{Photo, PhotoOptions, SfmOptions, reconstruct_photos};
use epipole_io::model::Model;
use epipole_io::photo::{PrepareOptions, prepare_photo};

pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Files, and their focal lengths in pixels where they do not tell it.
    let files: [(&str, Option<f64>); 5] = [
        ("photographs/b one.jpg", None),
        ("photographs/a.jpg", None),
        ("photographs/upright.jpg", None),
        ("photographs/other.jpg", None),
        ("photographs/typed.jpg", Some(750.0)),
    ];
    let lens = Lens::from_coefficients(LensKind::Brown, &[-0.01, 0.003, 0.0005, -0.0004, 0.0])?;
    let camera = Camera {
        intrinsics: Intrinsics::new(800.0, 801.0, 321.0, 238.5)?,
        lens,
        width: 640,
        height: 480,
    };
    let flat = Undistortion::new(&camera, Keep::Valid, &mut ())?;
    let undistortion = Some(&flat);
    let prepare = PrepareOptions::default()
        .with_max_pixels(200000)
        .with_undistortion(undistortion);
    let (mut photos, mut cameras) = (Vec::new(), Vec::new());
    for (path, focal_px) in files {
        let photo = prepare_photo(&std::fs::read(path)?, &prepare)?;
        let (width, height) = photo.image.dimensions();
        let longer = f64::from(width.max(height));
        let told_px = photo.focal_px.unwrap_or(1.2 * longer);
        let k = match (focal_px.map(|f| photo.reduced_focal_px(f)), photo.intrinsics) {
            (Some(f), Some(k)) => Intrinsics::new(f, f, k.principal_point().x, k.principal_point().y)?,
            (Some(f), None) => Intrinsics::centered(f, width, height)?,
            (None, Some(k)) => k,
            (None, None) => Intrinsics::centered(told_px, width, height)?,
        };
        cameras.push(Camera::pinhole(k, width, height));
        let name = path.rsplit('/').next().unwrap_or(path).to_owned();
        photos.push(Photo { name, image: photo.image, ..Photo::default() });
    }
    let mut how = PhotoOptions::default();
    how.features.kind = FeatureKind::Sift;
    how.features.max_features = 8192;
    how.features.contrast_threshold = Some(0.02);
    how.matching.max_ratio = Some(0.8);
    how.matching.mutual = true;
    let options = SfmOptions::default()
        .with_min_num_inliers(15)
        .with_refine_focal(false)
        .with_refine_distortion(false)
        .with_seed(0);
    let (input, found) =
        reconstruct_photos(&photos, &cameras, &how, &options, &mut ())?;
    let largest = found.components.first().ok_or("no two photographs show enough of the same thing")?;
    let model = Model::from_reconstruction(largest, &input.images);
    std::fs::create_dir_all("sparse/0")?;
    for file in model.to_colmap_text()? {
        std::fs::write(format!("sparse/0/{}", file.name), file.bytes)?;
    }
    println!("{} of {} photographs, {} points", largest.num_registered(), photos.len(), largest.points.len());
    Ok(())
}
