//! Renders photographs to measure with: `photographs FOLDER [COUNT] [WIDTH]`, of the still life, on
//! an arc around it.

use epipole::camera::{PosedCamera, look_at};
use epipole_scenes::{Sampling, Scene, still_life_camera};
use image::codecs::jpeg::JpegEncoder;
use nalgebra::{Point3, Vector3};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut words = std::env::args().skip(1);
    let folder = words.next().ok_or("photographs FOLDER [COUNT] [WIDTH]")?;
    let count: u32 = words.next().map_or(Ok(11), |word| word.parse())?;
    let width: u32 = words.next().map_or(Ok(2000), |word| word.parse())?;
    let height = width / 4 * 3;
    std::fs::create_dir_all(&folder)?;
    let middle = Point3::new(0.035, -0.13, 0.05);
    for n in 0..count {
        let angle = (f64::from(n) - f64::from(count - 1) / 2.0) * 7.0_f64.to_radians();
        let up = if n % 2 == 0 { -0.43 } else { -0.56 };
        let center = Point3::new(
            middle.x + 1.38 * libm::sin(angle),
            up,
            middle.z - 1.38 * libm::cos(angle),
        );
        let camera = PosedCamera {
            cam_from_world: look_at(&center, &middle, &Vector3::new(0.0, -1.0, 0.0))?,
            ..still_life_camera(width, height)
        };
        let picture = Scene::still_life().render(&camera, width, height, Sampling::Full)?;
        let file = std::fs::File::create(format!("{folder}/view-{:02}.jpg", n + 1))?;
        JpegEncoder::new_with_quality(file, 92).encode_image(&picture.image)?;
    }
    println!(
        "{count} photographs of {width} × {height}, focal length {} px",
        still_life_camera(width, height).camera.intrinsics.fu_px()
    );
    Ok(())
}
