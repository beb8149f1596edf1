//! Triangle meshes: PLY, binary glTF, and OBJ, the last two also with a texture.

use crate::cloud::ply::ply_of;
use crate::gltf::{Buffer, HALF_TURN, TRIANGLES, document};
use crate::{Error, Result};
use epipole::mvs::{Mesh, MeshTexture};
use serde_json::{Value, json};
use std::collections::HashMap;
use std::fmt::Write;

/// Name of the material in an OBJ file.
const MATERIAL: &str = "surface";

/// Writes a binary little-endian PLY file: as [`write_ply`](crate::cloud::write_ply), with the
/// vertex indices of each triangle.
///
/// ```
/// use epipole::mvs::Mesh;
/// use epipole::stereo::PointCloud;
/// use epipole_io::mesh::write_mesh_ply;
/// use nalgebra::Point3;
/// let points = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)].map(|(x, y)| Point3::new(x, y, 2.0));
/// let mesh = Mesh {
///     vertices: PointCloud { points: points.into(), ..PointCloud::default() },
///     triangles: vec![[0, 1, 2]],
/// };
/// let ply = write_mesh_ply(&mesh);
/// assert!(ply.ends_with(&[3, 0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0]));
/// ```
pub fn write_mesh_ply(mesh: &Mesh) -> Vec<u8> {
    ply_of(&mesh.vertices, &mesh.triangles)
}

/// Writes a binary glTF 2.0 file (`.glb`): positions, normals and colors, rotated so that a scene
/// whose first camera is upright is upright.
///
/// Source: Khronos Group, "glTF 2.0 Specification".
pub fn write_mesh_glb(mesh: &Mesh) -> Vec<u8> {
    let mut buffer = Buffer::default();
    if mesh.triangles.is_empty() {
        return document(vec![world()], Vec::new(), buffer);
    }
    let vertices = &mesh.vertices;
    let mut attributes = json!({ "POSITION": buffer.positions(&vertices.points) });
    if vertices.normals.len() == vertices.points.len() {
        attributes["NORMAL"] = buffer.normals(&vertices.normals).into();
    }
    if vertices.colors.len() == vertices.points.len() {
        attributes["COLOR_0"] = buffer.colors(vertices.colors.iter().copied()).into();
    }
    let indices = buffer.indices(mesh.triangles.as_flattened());
    surface(attributes, indices, rough(), Vec::new(), buffer)
}

/// Bytes of a binary glTF 2.0 file as of [`write_mesh_glb`], with a texture instead of the colors
/// of vertices.
///
/// * `image`: content of a JPEG or PNG file of the texture's image
///
/// # Errors
/// [`Error::Unsupported`] for another kind of image.
pub fn write_textured_glb(mesh: &Mesh, texture: &MeshTexture, image: &[u8]) -> Result<Vec<u8>> {
    let kinds: [(&str, &[u8]); 2] = [("image/jpeg", b"\xff\xd8"), ("image/png", b"\x89PNG")];
    let kind = kinds.iter().find(|(_, start)| image.starts_with(start));
    let (kind, _) =
        kind.ok_or_else(|| Error::unsupported("glTF has textures as JPEG and PNG only"))?;
    let mut buffer = Buffer::default();
    if mesh.triangles.is_empty() {
        return Ok(document(vec![world()], Vec::new(), buffer));
    }
    let (corners, indices) = distinct_corners(mesh, texture);
    let vertices = &mesh.vertices;
    let of = |corner: &(u32, [f32; 2])| corner.0 as usize;
    let points: Vec<_> = corners
        .iter()
        .map(|corner| vertices.points[of(corner)])
        .collect();
    let mut attributes = json!({ "POSITION": buffer.positions(&points) });
    if vertices.normals.len() == vertices.points.len() {
        let normals: Vec<_> = corners
            .iter()
            .map(|corner| vertices.normals[of(corner)])
            .collect();
        attributes["NORMAL"] = buffer.normals(&normals).into();
    }
    let (width, height) = texture.image.dimensions();
    let places: Vec<[f32; 2]> = (corners.iter())
        .map(|(_, [u, v])| [(u + 0.5) / width as f32, (v + 0.5) / height as f32])
        .collect();
    attributes["TEXCOORD_0"] = buffer.texture_coordinates(&places).into();
    let indices = buffer.indices(&indices);
    let view = buffer.image(image);
    let mut material = rough();
    material["pbrMetallicRoughness"]["baseColorTexture"] = json!({ "index": 0 });
    let lists = vec![
        (
            "images",
            vec![json!({ "bufferView": view, "mimeType": kind })],
        ),
        ("textures", vec![json!({ "source": 0 })]),
    ];
    Ok(surface(attributes, indices, material, lists, buffer))
}

fn world() -> Value {
    json!({ "name": "world", "rotation": HALF_TURN })
}

/// The default material is a metal.
fn rough() -> Value {
    json!({ "doubleSided": true, "pbrMetallicRoughness": {
        "metallicFactor": 0, "roughnessFactor": 1,
    }})
}

/// A file of one mesh with one material.
fn surface(
    attributes: Value,
    indices: usize,
    material: Value,
    mut lists: Vec<(&str, Vec<Value>)>,
    buffer: Buffer,
) -> Vec<u8> {
    let mut world = world();
    world["children"] = json!([1]);
    let nodes = vec![world, json!({ "name": "surface", "mesh": 0 })];
    let mesh = json!({ "name": "surface", "primitives": [{
        "mode": TRIANGLES, "attributes": attributes, "indices": indices, "material": 0,
    }]});
    lists.extend([("meshes", vec![mesh]), ("materials", vec![material])]);
    document(nodes, lists, buffer)
}

/// Vertices with their pixels in the texture, each pair once, and their indices for all corners.
fn distinct_corners(mesh: &Mesh, texture: &MeshTexture) -> (Vec<(u32, [f32; 2])>, Vec<u32>) {
    let (mut corners, mut indices) = (Vec::new(), Vec::new());
    let mut known = HashMap::new();
    for (triangle, pixels) in mesh.triangles.iter().zip(&texture.corners) {
        for (&vertex, pixel) in triangle.iter().zip(pixels) {
            let key = (vertex, pixel.x.to_bits(), pixel.y.to_bits());
            indices.push(*known.entry(key).or_insert_with(|| {
                corners.push((vertex, [pixel.x, pixel.y]));
                corners.len() as u32 - 1
            }));
        }
    }
    (corners, indices)
}

/// Writes a Wavefront OBJ file: vertices with colors, in the form that most programs read, and
/// normals.
///
/// Source: Wavefront Technologies, "Object Files (.obj)"; colors as by MeshLab.
pub fn write_mesh_obj(mesh: &Mesh) -> String {
    let mut text = String::new();
    write_vertices(mesh, true, &mut text);
    let has_normals = mesh.vertices.normals.len() == mesh.vertices.points.len();
    for triangle in &mesh.triangles {
        // Indices begin at 1.
        let corners = triangle.map(|vertex| match has_normals {
            true => format!("{0}//{0}", vertex + 1),
            false => format!("{}", vertex + 1),
        });
        text.push_str(&format!("f {}\n", corners.join(" ")));
    }
    text
}

/// Texts of an OBJ file with a texture, and of its MTL file.
///
/// * `material_file`: name of the MTL file
/// * `image_file`: name of the texture's image file
///
/// Source: Wavefront Technologies, "Object Files (.obj)" and "MTL material format".
pub fn write_textured_obj(
    mesh: &Mesh,
    texture: &MeshTexture,
    [material_file, image_file]: [&str; 2],
) -> [String; 2] {
    let mut text = format!("mtllib {material_file}\n");
    write_vertices(mesh, false, &mut text);
    let (width, height) = texture.image.dimensions();
    let (corners, indices) = distinct_corners(mesh, texture);
    for (_, [u, v]) in &corners {
        let (u, v) = ((u + 0.5) / width as f32, 1.0 - (v + 0.5) / height as f32);
        // Writing to a string cannot fail.
        let _ = writeln!(text, "vt {u:.7} {v:.7}");
    }
    let _ = writeln!(text, "usemtl {MATERIAL}");
    let has_normals = mesh.vertices.normals.len() == mesh.vertices.points.len();
    for (triangle, places) in mesh.triangles.iter().zip(indices.chunks(3)) {
        text.push('f');
        for (vertex, place) in triangle.iter().zip(places) {
            let (vertex, place) = (vertex + 1, place + 1);
            let _ = match has_normals {
                true => write!(text, " {vertex}/{place}/{vertex}"),
                false => write!(text, " {vertex}/{place}"),
            };
        }
        text.push('\n');
    }
    let material =
        format!("newmtl {MATERIAL}\nKa 0 0 0\nKd 1 1 1\nKs 0 0 0\nillum 1\nmap_Kd {image_file}\n");
    [text, material]
}

/// Lines of vertices and normals.
fn write_vertices(mesh: &Mesh, with_colors: bool, text: &mut String) {
    let vertices = &mesh.vertices;
    for (index, point) in vertices.points.iter().enumerate() {
        text.push_str(&format!(
            "v {} {} {}",
            point.x as f32, point.y as f32, point.z as f32
        ));
        let color = vertices.colors.get(index).filter(|_| with_colors);
        for level in color.into_iter().flatten() {
            text.push_str(&format!(" {:.4}", f64::from(*level) / 255.0));
        }
        text.push('\n');
    }
    for normal in &vertices.normals {
        text.push_str(&format!(
            "vn {:.5} {:.5} {:.5}\n",
            normal.x, normal.y, normal.z
        ));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cloud::read_ply;
    use epipole::image::RgbImage;
    use epipole::stereo::PointCloud;
    use nalgebra::{Point2, Point3, Vector3};

    fn mesh() -> Mesh {
        let points = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)].map(|(x, y)| Point3::new(x, y, 2.0));
        Mesh {
            vertices: PointCloud {
                points: points.into(),
                normals: vec![Vector3::new(0.0, 0.0, -1.0); 3],
                colors: vec![[255, 0, 51]; 3],
                confidences: Vec::new(),
            },
            triangles: vec![[0, 2, 1]],
        }
    }

    #[test]
    fn ply_has_its_vertices_and_faces() {
        let ply = write_mesh_ply(&mesh());
        let (cloud, notes) = read_ply(&ply).unwrap();
        assert_eq!(cloud, mesh().vertices);
        assert_eq!(notes, ["1 face is not read: a mesh becomes points"]);
    }

    #[test]
    fn obj_counts_from_one() {
        let text = write_mesh_obj(&mesh());
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines[1], "v 1 0 2 1.0000 0.0000 0.2000");
        assert_eq!(
            lines[3..],
            ["vn 0.00000 0.00000 -1.00000"; 3]
                .into_iter()
                .chain(["f 1//1 3//3 2//2"])
                .collect::<Vec<_>>()
        );
        let mut plain = mesh();
        plain.vertices.normals.clear();
        plain.vertices.colors.clear();
        assert!(write_mesh_obj(&plain).ends_with("v 0 1 2\nf 1 3 2\n"));
    }

    fn texture() -> MeshTexture {
        let corners = [(0.0, 0.0), (1.5, 1.0), (3.0, 0.5)].map(|(u, v)| Point2::new(u, v));
        MeshTexture {
            image: RgbImage::new(4, 2),
            corners: vec![corners],
        }
    }

    #[test]
    fn a_texture_has_its_place_at_each_corner() {
        let files = ["mesh.mtl", "texture.jpg"];
        let [text, material] = write_textured_obj(&mesh(), &texture(), files);
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines[..2], ["mtllib mesh.mtl", "v 0 0 2"]);
        // The center of the first pixel, from the bottom.
        assert_eq!(lines[7], "vt 0.1250000 0.7500000");
        assert_eq!(lines[10..], ["usemtl surface", "f 1/1/1 3/2/3 2/3/2"]);
        assert!(material.ends_with("map_Kd texture.jpg\n"));

        let jpeg = b"\xff\xd8 and more";
        let glb = write_textured_glb(&mesh(), &texture(), jpeg).unwrap();
        let length = u32::from_le_bytes(glb[12..16].try_into().unwrap()) as usize;
        let json: Value = serde_json::from_slice(&glb[20..20 + length]).unwrap();
        assert_eq!(json["images"][0]["mimeType"], "image/jpeg");
        let view = &json["bufferViews"][json["images"][0]["bufferView"].as_u64().unwrap() as usize];
        let start = 28 + length + view["byteOffset"].as_u64().unwrap() as usize;
        assert_eq!(&glb[start..start + jpeg.len()], jpeg);
        let attributes = &json["meshes"][0]["primitives"][0]["attributes"];
        let accessor = attributes["TEXCOORD_0"].as_u64().unwrap() as usize;
        assert_eq!(json["accessors"][accessor]["count"], 3);
        assert!(attributes["COLOR_0"].is_null());
        assert!(write_textured_glb(&mesh(), &texture(), b"GIF89a").is_err());
        assert!(write_textured_glb(&Mesh::default(), &texture(), jpeg).is_ok());
    }

    #[test]
    fn glb_is_whole() {
        let glb = write_mesh_glb(&mesh());
        let word = |at: usize| u32::from_le_bytes(glb[at..at + 4].try_into().unwrap()) as usize;
        assert_eq!((&glb[..4], word(8)), (&b"glTF"[..], glb.len()));
        let json: serde_json::Value = serde_json::from_slice(&glb[20..20 + word(12)]).unwrap();
        let primitive = &json["meshes"][0]["primitives"][0];
        assert_eq!(
            json["accessors"][primitive["indices"].as_u64().unwrap() as usize]["count"],
            3
        );
        let bytes = json["buffers"][0]["byteLength"].as_u64().unwrap();
        assert_eq!(bytes, 3 * (12 + 12 + 8) + 3 * 4);
        let empty = write_mesh_glb(&Mesh::default());
        assert!(!String::from_utf8_lossy(&empty).contains("meshes"));
    }
}
