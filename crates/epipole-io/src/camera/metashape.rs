//! Cameras of Agisoft Metashape: XML of a lens calibration or of all cameras of a chunk.
//!
//! A point x = X/Z, y = Y/Z is seen at u = w/2 + cx + (f + b1) x' + b2 y', v = h/2 + cy + f y',
//! with x' = x (1 + k1 r² + k2 r⁴ + k3 r⁶ + k4 r⁸) + p1 (r² + 2x²) + 2 p2 x y, and y' likewise with
//! p1 and p2 exchanged: they are p2 and p1 of OpenCV. A fisheye has the angle instead of r. The
//! center of the first pixel is at (0.5, 0.5), so half a pixel is subtracted. k4 of a frame camera,
//! p3, p4 and b2 must be 0. Old files have `fx`, `fy` and an absolute `cx`, `cy`.
//!
//! Source: Agisoft Metashape Professional user manual, appendix "Camera models".

use super::named::Cameras;
use super::parts::{check_skew, lens};
use crate::Result;
use crate::error::set_aside;
use crate::tree::Field;
use epipole::camera::{Camera, Intrinsics, Lens, LensKind};

/// Elements that lead to cameras.
const FOLDERS: [&str; 4] = ["document", "chunks", "chunk", "sensors"];

pub(super) fn is_it(root: &Field) -> bool {
    let keys = ["calibration", "document", "chunk", "sensors", "sensor"];
    keys.iter().any(|key| root.get(key).is_some())
}

pub(super) fn read(root: &Field) -> Result<Cameras> {
    if let Some(calibration) = root.get("calibration") {
        return Ok(Cameras::of(camera(&calibration, None)?));
    }
    let mut sensors = Vec::new();
    find_sensors(root, &mut sensors);
    let mut cameras = Vec::new();
    for sensor in &sensors {
        let Some(calibration) = calibration_of(sensor) else {
            continue;
        };
        let name = sensor.get("label").or_else(|| sensor.get("id"));
        let name = name.and_then(|name| name.text()).unwrap_or("camera");
        let camera = set_aside(camera(&calibration, Some(sensor)))?;
        cameras.push((name.to_owned(), camera));
    }
    if cameras.is_empty() {
        return Err(root.missing("calibration", "a sensor with a calibration"));
    }
    Cameras::of_list(cameras)
}

fn find_sensors<'a>(field: &Field<'a>, sensors: &mut Vec<Field<'a>>) {
    sensors.extend(field.all("sensor"));
    for folder in FOLDERS {
        for inner in field.all(folder) {
            find_sensors(&inner, sensors);
        }
    }
}

/// Returns the adjusted calibration, or else the first.
fn calibration_of<'a>(sensor: &Field<'a>) -> Option<Field<'a>> {
    let is_adjusted = |field: &Field| field.get("class").and_then(|c| c.text()) == Some("adjusted");
    let mut all = sensor.all("calibration");
    all.find(is_adjusted).or_else(|| sensor.get("calibration"))
}

fn camera(field: &Field, sensor: Option<&Field>) -> Result<Camera> {
    let (width, height) = size(field, sensor)?;
    let number = |key: &str| field.get(key).map(|field| field.number()).transpose();
    let or_zero = |key: &str| number(key).map(|value| value.unwrap_or(0.0));
    let (middle_x, middle_y) = (f64::from(width) / 2.0, f64::from(height) / 2.0);
    let k = match (number("f")?, number("fx")?) {
        (Some(f), _) => {
            let b2 = or_zero("b2")?;
            check_skew(&field.get("b2").unwrap_or_else(|| field.clone()), b2, f)?;
            let (cx, cy) = (middle_x + or_zero("cx")?, middle_y + or_zero("cy")?);
            [f + or_zero("b1")?, f, cx, cy]
        }
        (None, Some(fx)) => {
            let skew = or_zero("skew")?;
            check_skew(
                &field.get("skew").unwrap_or_else(|| field.clone()),
                skew,
                fx,
            )?;
            let center = [number("cx")?, number("cy")?];
            let fy = number("fy")?.unwrap_or(fx);
            [
                fx,
                fy,
                center[0].unwrap_or(middle_x),
                center[1].unwrap_or(middle_y),
            ]
        }
        (None, None) => return Err(field.missing("f", "focal length in pixels")),
    };
    Ok(Camera {
        width,
        height,
        intrinsics: Intrinsics::from_colmap(k)?,
        lens: lens_of(field)?,
    })
}

fn size(field: &Field, sensor: Option<&Field>) -> Result<(u32, u32)> {
    let places = [
        Some(field.clone()),
        field.get("resolution"),
        sensor.and_then(|sensor| sensor.get("resolution")),
    ];
    for place in places.into_iter().flatten() {
        if let (Some(width), Some(height)) = (place.get("width"), place.get("height")) {
            return Ok((width.pixels()?, height.pixels()?));
        }
    }
    Err(field.missing("resolution", "width and height in pixels"))
}

fn lens_of(field: &Field) -> Result<Lens> {
    let number = |key: &str| match field.get(key) {
        Some(field) => field.number(),
        None => Ok(0.0),
    };
    let [k1, k2, k3, k4] = [number("k1")?, number("k2")?, number("k3")?, number("k4")?];
    let [p1, p2, p3, p4] = [number("p1")?, number("p2")?, number("p3")?, number("p4")?];
    let kind = field.get("type").or_else(|| field.get("projection"));
    let name = kind.as_ref().and_then(|kind| kind.text());
    let beyond = |terms: &str| {
        field.unsupported(&format!(
            "has {terms} other than 0, which are not supported"
        ))
    };
    match (name.unwrap_or("frame"), &kind) {
        ("frame", _) if [k4, p3, p4] != [0.0; 3] => Err(beyond("k4, p3 or p4")),
        ("frame", _) => lens(LensKind::Brown, &[k1, k2, p2, p1, k3]),
        ("fisheye" | "equidistant_fisheye", _) if [p1, p2, p3, p4] != [0.0; 4] => {
            Err(beyond("p1 to p4 of a fisheye"))
        }
        ("fisheye" | "equidistant_fisheye", _) => lens(LensKind::Fisheye, &[k1, k2, k3, k4]),
        (other, kind) => Err(kind.as_ref().unwrap_or(field).unsupported(&format!(
            "\"{other:.40}\" is not supported: frame and fisheye are"
        ))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Error;
    use crate::tree::Syntax;
    use nalgebra::Point3;

    fn parse(text: &str) -> Result<Cameras> {
        let node = Syntax::Xml.parse(text).unwrap();
        let root = Field::root(&node);
        assert!(is_it(&root));
        read(&root)
    }

    const CALIBRATION: &str = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>
<calibration>
  <projection>frame</projection>
  <width>640</width>
  <height>480</height>
  <f>500</f>
  <cx>3.5</cx>
  <cy>-2</cy>
  <b1>1.5</b1>
  <k1>-0.1</k1>
  <k2>0.02</k2>
  <k3>0.003</k3>
  <p1>0.004</p1>
  <p2>-0.005</p2>
  <date>2024-01-01T00:00:00Z</date>
</calibration>
";

    /// The manual's equations, by hand.
    #[test]
    fn a_calibration_projects_as_in_its_manual() {
        let camera = parse(CALIBRATION).unwrap().cameras[0].camera;
        let (x, y): (f64, f64) = (0.3, -0.2);
        let r2 = x * x + y * y;
        let radial = 1.0 - 0.1 * r2 + 0.02 * r2 * r2 + 0.003 * r2 * r2 * r2;
        let (p1, p2) = (0.004, -0.005);
        let bent_x = x * radial + p1 * (r2 + 2.0 * x * x) + 2.0 * p2 * x * y;
        let bent_y = y * radial + p2 * (r2 + 2.0 * y * y) + 2.0 * p1 * x * y;
        let u = 320.0 + 3.5 + (500.0 + 1.5) * bent_x - 0.5;
        let v = 240.0 - 2.0 + 500.0 * bent_y - 0.5;
        let projected = camera.project(&Point3::new(x, y, 1.0)).unwrap();
        assert!(
            (projected - nalgebra::Point2::new(u, v)).norm() < 1e-10,
            "{projected}"
        );
        let skewed = CALIBRATION.replace("<b1>1.5</b1>", "<b2>1.5</b2>");
        let error = parse(&skewed).unwrap_err().to_string();
        assert_eq!(
            error,
            "calibration.b2 has a skew of 1.5 pixels: only 0 is supported"
        );
        let error = parse(&CALIBRATION.replace("k3", "k4")).unwrap_err();
        assert!(matches!(error, Error::Unsupported { .. }));
        let error = parse(&CALIBRATION.replace("500", "wide")).unwrap_err();
        assert_eq!(
            error.to_string(),
            "line 6: calibration.f is not a finite number: \"wide\""
        );
        let old = CALIBRATION
            .replace("<f>500</f>", "<fx>501</fx><fy>500</fy>")
            .replace("3.5", "320");
        let old = parse(&old).unwrap().cameras[0].camera.intrinsics;
        assert_eq!((old.fu_px(), old.principal_point().x), (501.0, 319.5));
    }

    #[test]
    fn the_adjusted_calibration_of_each_sensor_is_read() {
        let text = "<document version=\"1.5.0\"><chunk label=\"Chunk 1\" enabled=\"true\">
<sensors next_id=\"2\">
 <sensor id=\"0\" label=\"ILCE-7R, 35 mm\" type=\"frame\">
  <resolution width=\"640\" height=\"480\"/>
  <calibration type=\"frame\" class=\"initial\"><resolution width=\"640\" height=\"480\"/><f>400</f></calibration>
  <calibration type=\"frame\" class=\"adjusted\"><resolution width=\"640\" height=\"480\"/><f>500</f></calibration>
 </sensor>
 <sensor id=\"1\" label=\"wide\" type=\"fisheye\">
  <resolution width=\"320\" height=\"240\"/>
  <calibration type=\"fisheye\" class=\"adjusted\"><f>100</f><k1>0.1</k1><k4>0.01</k4></calibration>
 </sensor>
 <sensor id=\"2\" label=\"none\" type=\"frame\"/>
</sensors></chunk></document>";
        let cameras = parse(text).unwrap();
        assert_eq!(cameras.cameras.len(), 2);
        assert_eq!(
            cameras.named("ILCE-7R, 35 mm").unwrap().intrinsics.fu_px(),
            500.0
        );
        let wide = cameras.named("wide").unwrap();
        assert_eq!(
            (wide.width, wide.lens.coefficients()),
            (320, vec![0.1, 0.0, 0.0, 0.01])
        );
        let other = text.replace("type=\"fisheye\" class", "type=\"spherical\" class");
        let rest = parse(&other).unwrap();
        assert_eq!((rest.cameras.len(), rest.notes.len()), (1, 1));
        assert!(rest.notes[0].starts_with("camera wide is left out"));
        let none = other.replace(
            "type=\"frame\" class=\"adjusted\"",
            "type=\"cylindrical\" class=\"adjusted\"",
        );
        assert!(matches!(parse(&none), Err(Error::Unsupported { .. })));
    }
}
