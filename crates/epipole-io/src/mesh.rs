//! Triangle meshes: PLY, binary glTF, and OBJ.

use crate::cloud::ply::ply_of;
use crate::gltf::{Buffer, HALF_TURN, TRIANGLES, document};
use epipole::mvs::Mesh;
use serde_json::json;

/// Bytes of a binary little-endian PLY file: as [`write_ply`](crate::cloud::write_ply), and the
/// indices of the vertices of each triangle.
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

/// Bytes of a binary glTF 2.0 file (`.glb`): positions, normals and colors, turned so that a scene
/// whose first camera is upright stands upright.
///
/// Source: Khronos Group, "glTF 2.0 Specification".
pub fn write_mesh_glb(mesh: &Mesh) -> Vec<u8> {
    let mut buffer = Buffer::default();
    let mut nodes = vec![json!({ "name": "world", "rotation": HALF_TURN })];
    let (mut meshes, mut materials) = (Vec::new(), Vec::new());
    if !mesh.triangles.is_empty() {
        let vertices = &mesh.vertices;
        let mut attributes = json!({ "POSITION": buffer.positions(&vertices.points) });
        if vertices.normals.len() == vertices.points.len() {
            attributes["NORMAL"] = buffer.normals(&vertices.normals).into();
        }
        if vertices.colors.len() == vertices.points.len() {
            attributes["COLOR_0"] = buffer.colors(vertices.colors.iter().copied()).into();
        }
        let indices = buffer.indices(mesh.triangles.as_flattened());
        meshes.push(json!({ "name": "surface", "primitives": [{
            "mode": TRIANGLES, "attributes": attributes, "indices": indices, "material": 0,
        }]}));
        // The default is a metal.
        materials.push(json!({ "doubleSided": true, "pbrMetallicRoughness": {
            "metallicFactor": 0, "roughnessFactor": 1,
        }}));
        nodes[0]["children"] = json!([1]);
        nodes.push(json!({ "name": "surface", "mesh": 0 }));
    }
    let lists = [("meshes", meshes), ("materials", materials)];
    document(nodes, lists.into(), buffer)
}

/// Text of a Wavefront OBJ file: vertices with their colors, as most programs read them, and
/// normals.
///
/// Source: Wavefront Technologies, "Object Files (.obj)"; colors as by MeshLab.
pub fn write_mesh_obj(mesh: &Mesh) -> String {
    let mut text = String::new();
    let vertices = &mesh.vertices;
    for (index, point) in vertices.points.iter().enumerate() {
        text.push_str(&format!(
            "v {} {} {}",
            point.x as f32, point.y as f32, point.z as f32
        ));
        for level in vertices.colors.get(index).into_iter().flatten() {
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
    let has_normals = vertices.normals.len() == vertices.points.len();
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cloud::read_ply;
    use epipole::stereo::PointCloud;
    use nalgebra::{Point3, Vector3};

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
