//! An offline page of one file to rotate and measure the model in any browser.

use super::frustum::{FRUSTUM_RATIO, corners, extent};
use super::{Model, ModelImage};
use crate::{Error, Result};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use epipole::mvs::Mesh;
use nalgebra::{Point3, Vector3};
use serde_json::{Value, json};

const VIEWER: &str = include_str!("viewer.html");

/// Returns `3 images` or `1 image`.
fn count(number: usize, noun: &str) -> String {
    let plural = if number == 1 { "" } else { "s" };
    format!("{number} {noun}{plural}")
}

/// Returns the mean direction of an axis of the cameras in the world; `None` if it cancels.
fn mean_direction(images: &[ModelImage], axis: Vector3<f64>) -> Option<Vector3<f64>> {
    let in_world = |image: &ModelImage| image.cam_from_world.rotation.inverse() * axis;
    let sum: Vector3<f64> = images.iter().map(in_world).sum();
    sum.try_normalize(1e-3 * images.len() as f64)
}

fn numbers(vector: Vector3<f64>) -> [f64; 3] {
    vector.into()
}

/// # Errors
/// [`Error::Malformed`] for a missing vertex of a triangle, or a vertex without a color.
fn check_mesh(mesh: &Mesh) -> Result<()> {
    let num_vertices = mesh.vertices.points.len();
    let corners = mesh.triangles.as_flattened();
    if corners
        .iter()
        .any(|&corner| corner as usize >= num_vertices)
    {
        return Err(Error::malformed(
            "a triangle of the surface has a vertex that is not there",
        ));
    }
    match mesh.vertices.colors.len() == num_vertices {
        true => Ok(()),
        false => Err(Error::malformed("the surface needs one color a vertex")),
    }
}

impl Model {
    /// Writes an HTML page that shows points, cameras and surface in 3-D, and measures distances
    /// between points. It has no links and loads nothing.
    ///
    /// * `surface`: in the frame of the model, with a color per vertex; may be empty
    ///
    /// # Errors
    /// [`Error::Malformed`](crate::Error::Malformed) if an index of the model or of the surface is
    /// wrong.
    ///
    /// ```
    /// use epipole::mvs::Mesh;
    /// use epipole_io::model::Model;
    /// let page = String::from_utf8(Model::default().to_html(&Mesh::default())?).unwrap();
    /// assert!(page.contains("<title>3-D model: 0 images, 0 points</title>"));
    /// # Ok::<(), epipole_io::Error>(())
    /// ```
    pub fn to_html(&self, surface: &Mesh) -> Result<Vec<u8>> {
        self.check()?;
        check_mesh(surface)?;
        let mut title = format!(
            "3-D model: {}, {}",
            count(self.images.len(), "image"),
            count(self.points.len(), "point")
        );
        if !surface.triangles.is_empty() {
            title.push_str(&format!(", {}", count(surface.triangles.len(), "triangle")));
        }
        // A closing tag in a name would end the script.
        let model = (self.viewer_data(surface).to_string()).replace('<', "\\u003c");
        let page = VIEWER.replace("{{title}}", &title);
        Ok(page.replace("{{model}}", &model).into_bytes())
    }

    /// Returns the data of the viewer. Positions are relative to the center of the scene, because
    /// `f32` has seven digits.
    fn viewer_data(&self, surface: &Mesh) -> Value {
        let (origin, extent) = extent(self);
        let encoded = |points: &mut dyn Iterator<Item = &Point3<f64>>| {
            let places = points.flat_map(|point| <[f64; 3]>::from(point - origin));
            let bytes: Vec<u8> = places.flat_map(|x| (x as f32).to_le_bytes()).collect();
            STANDARD.encode(bytes)
        };
        let positions = encoded(&mut self.points.iter().map(|point| &point.position));
        let colors: Vec<u8> = self.points.iter().flat_map(|point| point.color).collect();
        let surface = (!surface.triangles.is_empty()).then(|| {
            let corners = surface.triangles.as_flattened().iter();
            let triangles: Vec<u8> = corners.flat_map(|corner| corner.to_le_bytes()).collect();
            json!({
                "positions": encoded(&mut surface.vertices.points.iter()),
                "colors": STANDARD.encode(surface.vertices.colors.as_flattened()),
                "triangles": STANDARD.encode(triangles),
            })
        });
        let camera = |image: &ModelImage| {
            let camera = &self.cameras[image.camera];
            let world_from_cam = image.cam_from_world.inverse();
            let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
            let corner = |corner| numbers(world_from_cam * corner - origin);
            let k = &camera.intrinsics;
            json!({
                "name": image.name,
                "center": numbers(image.center_in_world() - origin),
                "axes": axes.map(|axis| numbers(world_from_cam * axis)),
                "corners": corners(camera, FRUSTUM_RATIO * extent).map(corner),
                "focal": [
                    2.0 * k.fu_px() / f64::from(camera.width),
                    2.0 * k.fv_px() / f64::from(camera.height),
                ],
            })
        };
        let up = mean_direction(&self.images, -Vector3::y());
        let front = mean_direction(&self.images, Vector3::z());
        // Directions of cameras around a scene may cancel.
        let front = front.or_else(|| {
            let image = self.images.first()?;
            Some(image.cam_from_world.rotation.inverse() * Vector3::z())
        });
        json!({
            "origin": numbers(origin.coords),
            "extent": extent,
            "up": up.map(numbers),
            "front": front.map(numbers),
            "positions": positions,
            "colors": STANDARD.encode(colors),
            "surface": surface,
            "cameras": self.images.iter().map(camera).collect::<Vec<_>>(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::example::{example, lenses};
    use super::*;

    fn data(page: &[u8]) -> Value {
        let page = std::str::from_utf8(page).unwrap();
        let start = page.split_once("id=\"model\">").unwrap().1;
        serde_json::from_str(start.split_once("</script>").unwrap().0).unwrap()
    }

    #[test]
    fn a_page_has_points_and_cameras_around_the_middle() {
        let model = example(&lenses(), false);
        let data = data(&model.to_html(&Mesh::default()).unwrap());
        let bytes = STANDARD
            .decode(data["positions"].as_str().unwrap())
            .unwrap();
        assert_eq!(bytes.len(), 12 * model.points.len());
        let origin: Vec<f64> = serde_json::from_value(data["origin"].clone()).unwrap();
        for (point, bytes) in model.points.iter().zip(bytes.chunks_exact(12)) {
            for axis in 0..3 {
                let at = f32::from_le_bytes(bytes[4 * axis..4 * axis + 4].try_into().unwrap());
                assert!((origin[axis] + f64::from(at) - point.position[axis]).abs() < 1e-6);
            }
        }
        let cameras = data["cameras"].as_array().unwrap();
        assert_eq!(cameras.len(), model.images.len());
        for (camera, image) in cameras.iter().zip(&model.images) {
            assert_eq!(camera["name"], *image.name);
            let center: [f64; 3] = serde_json::from_value(camera["center"].clone()).unwrap();
            let there = image.center_in_world() - Point3::from(Vector3::from_vec(origin.clone()));
            assert!((Vector3::from(center) - there).norm() < 1e-12);
        }
        // The cameras are upright along −y.
        assert!(data["up"][1].as_f64().unwrap() < -0.9);
    }

    #[test]
    fn names_cannot_leave_the_data() {
        let mut model = example(&lenses(), false);
        model.images[0].name = "</script><script>alert(1)</script>.jpg".to_owned();
        let page = model.to_html(&Mesh::default()).unwrap();
        assert_eq!(data(&page)["cameras"][0]["name"], *model.images[0].name);
        let text = String::from_utf8(page).unwrap();
        assert_eq!(text.matches("<script").count(), 2);
    }

    #[test]
    fn a_surface_has_its_triangles_and_only_valid_ones() {
        use epipole::stereo::PointCloud;
        let corner = |x: f64| Point3::new(x, 0.0, 2.0);
        let mut surface = Mesh {
            vertices: PointCloud {
                points: [0.0, 1.0, 2.0].map(corner).into(),
                colors: vec![[1, 2, 3]; 3],
                ..PointCloud::default()
            },
            triangles: vec![[0, 2, 1]],
        };
        let model = example(&lenses(), false);
        let page = model.to_html(&surface).unwrap();
        assert!(String::from_utf8_lossy(&page).contains(", 1 triangle</title>"));
        let surface_of = |page: &[u8]| data(page)["surface"].clone();
        let bytes = |value: &Value| STANDARD.decode(value.as_str().unwrap()).unwrap();
        let found = surface_of(&page);
        assert_eq!(
            bytes(&found["triangles"]),
            [0, 0, 0, 0, 2, 0, 0, 0, 1, 0, 0, 0]
        );
        assert_eq!(bytes(&found["colors"]), [1, 2, 3].repeat(3));
        assert_eq!(bytes(&found["positions"]).len(), 36);
        assert!(surface_of(&model.to_html(&Mesh::default()).unwrap()).is_null());
        surface.triangles[0][1] = 3;
        assert!(model.to_html(&surface).is_err());
        surface.triangles[0][1] = 2;
        surface.vertices.colors.pop();
        assert!(model.to_html(&surface).is_err());
    }
}
